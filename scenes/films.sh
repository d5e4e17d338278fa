#!/usr/bin/env bash
# Draws the sequences of the papers as films, from the scenes in this folder.
#
#   scenes/films.sh [OUTDIR [FRAMES [WIDTH]]]        default: films 120 640
#
# Frames are kept in OUTDIR/NAME/, so an interrupted run goes on where it stopped. Each film is an
# animated PNG, with a contact sheet beside it.
set -euo pipefail
export LC_ALL=C

out=${1:-films}
frames=${2:-120} width=${3:-640}
mkdir -p "$out"
out=$(cd "$out" && pwd)
cd "$(dirname "$0")/.."

cargo build --release -p ugfilm -p ugphoton
export PATH="${CARGO_TARGET_DIR:-$PWD/target}/release:$PATH"
cd scenes

# film NAME HEIGHT [ARGUMENT...]: HEIGHT in hundredths of the width
film() {
    local name=$1 height=$((width * $2 / 100))
    shift 2
    mkdir -p "$out/$name"
    ugfilm -qt -frames "$frames" -sz "$width" "$height" "$@" -keep "$out/$name/%05d.png" -fo "$out/$name.apng"
    ugfilm -qt -frames "$frames" -sz $((width / 4)) $((height / 4)) "$@" -sheet 12 -fo "$out/$name-sheet.png"
    printf '%s\n' "$name.apng"
}

# Chang, Lai and Chen 1996, figure 10: a teapot flies past at 0.95c, its shape alone.
film chang-flyby 30 -vel .95 0 0 -ti 3..36 -va 90 --no-doppler --no-flux teapot.ug

# Howard, Dance and Kitchen 1995, figures 4 and 5: towards a grid, from rest to 0.9c and back.
film howard-grid 84 -cv '0 0 0 .. 0 .9 0 .. 0 0 0' -ease smooth -loop --no-doppler --no-flux grid.ug

# Nguyen 1988, figure 2: the ship from rest to 0.99c.
film nguyen-ship 75 -vel '0 0 0 .. .99 0 0' -in --no-doppler --no-flux ship.ug

# The street entered at growing speed, in spectral colours.
film street 80 -cv '0 0 0 .. 0 .99 0' -ep 0 -14..6 3 -sp -ex auto street.ug

# A panorama of the tunnel, seen at growing speed.
ugphoton -qt -pan -sz 2048 1024 tunnel.ug -fo "$out/sky.png"
film panorama 75 -warp -cv '0 0 0 .. 0 .95 0' -sp -ex auto -va 100 "$out/sky.png"
