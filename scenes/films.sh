#!/usr/bin/env bash
# Draws the sequences of the papers as films, from the scenes in this folder.
#
#   scenes/films.sh [OUTDIR [FRAMES [WIDTH]]]        default: films 120 640
#
# Frames are kept in OUTDIR/NAME/, so an interrupted run goes on where it stopped. Each film is an
# animated PNG, with a contact sheet beside it. On two cores the first eight films take about five
# minutes, the seven set pieces between one and two hours (a rolling wheel and the view all around a
# ship are the longest), and the six clips by rays at the end about twenty minutes.
set -euo pipefail
export LC_ALL=C

out=${1:-films}
frames=${2:-120} width=${3:-640}
mkdir -p "$out"
out=$(cd "$out" && pwd)
cd "$(dirname "$0")/.."

cargo build --release -p ugfilm -p ugphoton -p ugsheet
export PATH="${CARGO_TARGET_DIR:-$PWD/target}/release:$PATH"
cd scenes

# film NAME HEIGHT [ARGUMENT...]: HEIGHT in hundredths of the width
film() {
    local name=$1 height=$((width * $2 / 100))
    shift 2
    mkdir -p "$out/$name"
    ugfilm -look 1988 -qt -frames "$frames" -sz "$width" "$height" "$@" -keep "$out/$name/%05d.png" -fo "$out/$name.apng"
    ugfilm -look 1988 -qt -frames "$frames" -sz $((width / 4)) $((height / 4)) "$@" -sheet 12 -fo "$out/$name-sheet.png"
    printf '%s\n' "$name.apng"
}

# clip NAME MATERIAL X SLOW_VELOCITY SLOW_TIMES VELOCITY TIMES: a clip of Li, Shum and Peng. The cube
# of room.ug, moved to X, slow and fast; the frames of both side by side are OUTDIR/NAME/*.png and,
# where there is ffmpeg, OUTDIR/NAME.mp4.
clip() {
    local name=$1 frame
    mkdir -p "$out/$name"
    half slow "$1" "$2" "$3" "$4" "$5"
    half fast "$1" "$2" "$3" "$6" "$7"
    for frame in $(seq -f %05.0f "$frames"); do
        ugsheet -qt -lb none -gap 4 0 -cols 2 -fo "$out/$name/$frame.png" "$out/$name"/{slow,fast}-"$frame.png"
    done
    # About twelve moments, the slow cube beside the fast one.
    ugsheet -qt -lb none -gap 4 0 -cols 3 -fo "$out/$name-sheet.png" \
        $(seq -f "$out/$name/%05.0f.png" 1 $(((frames + 11) / 12)) "$frames")
    if command -v ffmpeg > /dev/null; then
        ffmpeg -loglevel error -y -framerate 25 -i "$out/$name/%05d.png" -pix_fmt yuv420p \
            -vf 'crop=trunc(iw/2)*2:trunc(ih/2)*2' "$out/$name.mp4"
    fi
    printf '%s\n' "$name"
}

# half SPEED NAME MATERIAL X VELOCITY TIMES: one of the two sides of a clip
half() {
    local scene=$out/$2/$1.ug
    sed "/^i cube/{s/<.*>/<$5>/; s/-ta 0/-ta $4/}; s/white glass/white $3/g" room.ug > "$scene"
    ugfilm -look 1988 -qt -rays -an eye --no-doppler --no-flux -frames "$frames" -sz $((width / 2)) $((width * 3 / 8)) -ti "$6" \
        "$scene" -keep "$out/$2/$1-%05d.png" -fo "$out/$2-$1.apng"
}

# Chang, Lai and Chen 1996, figure 10: a teapot flies past at 0.95c, its shape alone.
film chang-flyby 30 -vel .95 0 0 -ti 3..36 -va 90 --no-doppler --no-flux teapot.ug

# Howard, Dance and Kitchen 1995, figures 4 and 5: towards a grid, from rest to 0.9c and back. Then
# figures 6 to 8: the same towards an infinite plane, away from the grid, and past it.
film howard-grid 84 -cv '0 0 0 .. 0 .9 0 .. 0 0 0' -ease smooth -loop --no-doppler --no-flux grid.ug
eval "$(sed -n 's/^    \(infinite_plane() {.*\)/\1/p' ../docs/gallery.md)"
infinite_plane > "$out/howard-plane.ug"
howard=(75 -ease smooth -loop --no-doppler --no-flux -bg .8 210 .25)
film howard-plane "${howard[@]}" -cv '0 0 0 .. 0 .9 0 .. 0 0 0' "$out/howard-plane.ug"
film howard-behind "${howard[@]}" -cv '0 0 0 .. 0 -.9 0 .. 0 0 0' -ep 0 -14.4 0 grid.ug
film howard-beside "${howard[@]}" -in -vel '0 0 0 .. -.9 0 0 .. 0 0 0' -ep 0 -8 0 -va 80 grid.ug

# Nguyen 1988, figure 2: the ship from rest to 0.99c.
film nguyen-ship 75 -vel '0 0 0 .. .99 0 0' -in --no-doppler --no-flux ship.ug

# The street entered at growing speed under a sky, in spectral colours; the exposure follows.
film street 80 -cv '0 0 0 .. 0 .95 0' -ep 0 -14..6 3 -sp -ex follow -tc filmic -sky day street.ug

# A panorama of the tunnel, with the sky between its plates, seen at growing speed.
ugphoton -look 1988 -qt -pan -sky day --no-sky-light -sz 2048 1024 tunnel.ug -fo "$out/sky.png"
film panorama 75 -warp -cv '0 0 0 .. 0 .9 0' -sp -ex follow -tc filmic -va 100 "$out/sky.png"

# Set pieces of the gallery, ten seconds each. Past Saturn, into a ring of stones, a tram that passes
# over the camera, a jet, a rolling wheel, a city, and all around an accelerating ship (360 degrees).
piece() {
    local name=$1 height=$((width * $2 / 100))
    shift 2
    mkdir -p "$out/$name"
    ugfilm -qt -rays -frames "$frames" -fps $(((frames + 9) / 10)) -sz "$width" "$height" "$@" \
        -keep "$out/$name/%05d.png" -fo "$out/$name.apng"
    printf '%s\n' "$name.apng"
}
piece saturn 60 -look shape -vel .9 0 0 -va 80 -ti 2..20 saturn.ug
piece stones 60 -look shape -sky day --no-sky-light -cv 0 .97 0 -ep 0 -12..12 1.6 -vc 0 99 1.6 -va 120 stones.ug
piece tram 60 -look shape --no-sky-light -ti -6..14 -cam back tram.ug
piece jet 25 -look shape -in -ti 0..1.4 jet.ug
piece rolling 60 --no-flux -ex 1 -ti 0..8 -cam beside rolling.ug
piece city 56 -ex follow --no-sky-light -cv .6 0 0 -ep -40..40 -2 2.2 -vc 16 22 8 -va 104 city.ug
piece around 50 -ex follow --no-sky-light -sky dusk -pan -ti 0..12 -cam bow departure.ug

# Li, Shum and Peng 2001: six clips, of the cubes of figures 5 and 6, each at a hundredth of the speed
# and at full speed. Towards the viewer and away the cube passes beside the camera (X is -0.9). The
# shadow of a fast cube is seen after the cube itself is gone.
for material in glass metal; do
    clip "li-$material-a-right" $material 0 '.0099 0 0' -600..600 '.99 0 0' 1..12
    clip "li-$material-b-near" $material -.9 '0 -.009 0' -420..740 '0 -.9 0' 1.5..9
    clip "li-$material-c-away" $material -.9 '0 .0099 0' -480..620 '0 .99 0' 1..24
done
