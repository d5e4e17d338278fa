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
export PATH="${CARGO_TARGET_DIR:-$PWD/target}/release:$PATH"

# tile NAME COLUMNS PATTERN: docs/gallery/NAME.png from the figures whose names match
tile() {
    # Unquoted, so that the shell expands the pattern.
    # shellcheck disable=SC2086
    ugsheet -qt -lb none -gap 4 0 -bg .25 -cols "$2" -fo "docs/gallery/$1.png" "$figures"/$3
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

# The one with labels, and the annotated one, as the page says.
cd scenes
shape() { ugdoppler -qt --no-doppler --no-flux; }
passing() { uglorentz -in -vel "$1" 0 0 ship.ug | shape | ugrainbow -qt -sz 400 300; }
caption='Passing from left to right, each time seen in the same place: the faster, the more it seems turned away.'
ugsheet -lt -cap "$caption" <(passing 0) <(passing .5) <(passing .9) <(passing .99) > ../docs/gallery/sheet.png
pot='A teapot at 0.95c, and its outline at rest'
uglorentz -in -vel .95 0 0 teapot.ug | shape |
    ugrainbow -qt -sz 640 480 -bg 1 -dl -gr -lg -cap "$pot" > ../docs/gallery/annotated.png
