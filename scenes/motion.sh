#!/usr/bin/env bash
# Draws the films of docs/motion.md, from the scenes in this folder.
#
#   scenes/motion.sh [OUTDIR [FRAMES [WIDTH [NAME...]]]]        default: films 250 1280, all of them
#
# Frames are kept in OUTDIR/NAME/, so an interrupted run goes on where it stopped. Each film is an MP4
# file where there is ffmpeg, otherwise an animated PNG, with a contact sheet beside it. On two cores
# all take about three hours, a sixteenth of that with WIDTH 320.
set -euo pipefail
export LC_ALL=C

out=${1:-films}
frames=${2:-250} width=${3:-1280}
shift $(($# < 3 ? $# : 3))
names=" $* "
mkdir -p "$out"
out=$(cd "$out" && pwd)
cd "$(dirname "$0")/.."

cargo build --release -p ugfilm
export PATH="${CARGO_TARGET_DIR:-$PWD/target}/release:$PATH"
cd scenes
kind=apng
if command -v ffmpeg > /dev/null; then kind=mp4; fi

# film NAME HEIGHT [ARGUMENT...]: HEIGHT in hundredths of the width
film() {
    local name=$1 height=$((width * $2 / 100))
    shift 2
    if [[ $names != "  " && $names != *" $name "* ]]; then return; fi
    mkdir -p "$out/$name"
    ugfilm -qt -frames "$frames" -sz "$width" "$height" "$@" -keep "$out/$name/%05d.png" -fo "$out/$name.$kind"
    ugfilm -qt -frames "$frames" -sz $((width / 4)) $((height / 4)) "$@" -sheet 12 -fo "$out/$name-sheet.png"
    printf '%s\n' "$name.$kind"
}

# Three wheels and their shadows: one stands, one turns, one rolls. From the left, from the front and
# from the right.
film wheels-left 50 -rays -aa 2 -look shape -ti 10.3..15 -ep -7.5 -5 2.6 -vc 1.2 0 .5 -va 40 wheels.ug
film wheels-front 50 -rays -aa 2 -look shape -ti 8.8..13.5 -ep .6 -9 2 -vc 1 0 .6 -va 46 wheels.ug
film wheels-right 50 -rays -aa 2 -look shape -ti 11.4..12.8 -ep 11 -7 3 -vc 1.6 0 .4 -va 38 wheels.ug

# A camera on a circle at 0.8c, among houses and under stars: one revolution.
film carousel 60 -rays -aa 3 -ti 0..18.8496 -loop -ex -2.5 carousel.ug

# The sky ahead of a ship with constant acceleration, up to 0.99c.
film starbow 60 -warp --scene departure.ug -cam bow -ti 0..17.6444 -ex 4 stars.csv

# Clocks that are passed at 0.8c, and clocks at rest.
film ticks 35 -look 1988 -ti 6..24 ticks.ug

# Twins: one goes and comes back.
film twins 50 -look shape -ti 7.5..27 twins.ug

# The ship leaves its street.
film departure 60 -rays -aa 2 -ti 4..64 -ease smooth -ex 1 departure.ug

# A planet and its moon.
film orbit 60 -li -ti 30..92.8 -ex 3 orbit.ug

# A spinning sphere before a mirror, and a disc.
film spinning 60 -rays -aa 2 -look shape -ti 8..14.2832 -loop spinning.ug
film disc 50 -look 1988 -ti 9..15.6139 -loop disc.ug

# Slalom on a path from a table.
film slalom 50 -rays -aa 2 -look shape -ti 12..36 slalom.ug
