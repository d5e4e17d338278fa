#!/usr/bin/env bash
# Draws the pictures of docs/gallery.md anew: the figures, small, those of one kind side by side.
# Look at each before you commit it.
#
#   scenes/gallery.sh
set -euo pipefail
cd "$(dirname "$0")/.."

figures=$(mktemp -d)
trap 'rm -rf "$figures"' EXIT
scenes/figures.sh "$figures" 400 300

# tile NAME COLUMNS PATTERN: docs/gallery/NAME.png from the figures whose names match
tile() {
    # The pattern is to be expanded.
    # shellcheck disable=SC2086
    cargo --quiet xtask sheet "docs/gallery/$1.png" "$2" "$figures"/$3
}

mkdir -p docs/gallery
tile rainbow 1 'nguyen-01*'
tile ship 2 'nguyen-02[a-d]*'
tile ship-colours 3 'nguyen-02[e-z]*'
tile chang-09 2 'chang-09*'
tile chang-10 2 'chang-10-*'
tile lights 2 'chang-1[35]*'
tile street-lights 2 'chang-1[46]*'
tile bands 1 'chang-17*'
tile tunnel 2 'weiskopf*'
tile street 2 'chang-1[12]*'
tile howard 2 'howard*'
tile lattice 2 'lattice*'
tile halves 2 'halves*'
tile dice 1 'dice*'
tile traffic 2 'traffic*'
tile lamp 2 'lamp*'
tile glass 2 'glass*'
