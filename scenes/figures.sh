#!/usr/bin/env bash
# Draws the papers' figures, and some of our own, from the scenes in this folder.
#
#   scenes/figures.sh [--nguyen] [OUTDIR [WIDTH HEIGHT]]        default: figures 640 480
#
# --nguyen: only the figures of Nguyen 1988 that the pipe draws, for which three programs are built.
#
# Every picture is one pipe. Without ugdoppler, only shapes change. Our scenes have z up: motion is
# along +x, and the camera looks along +y, where the papers have y up and look along the z axis.
set -euo pipefail
export LC_ALL=C

programs=(uglorentz ugdoppler ugrainbow) n_figures=8
if [ "${1-}" = --nguyen ]; then
    paper=nguyen
    shift
else
    paper=all
    programs+=(ugphoton ugwarp ugsheet xtask) n_figures=115
fi
out=${1:-figures}
width=${2:-640} height=${3:-480}
mkdir -p "$out/rows"
out=$(cd "$out" && pwd)
cd "$(dirname "$0")/.."

printf 'Builds the programs, then draws %s figures into %s\n\n' "$n_figures" "$out"
cargo build --release "${programs[@]/#/--package=}"
printf '\nDrawing:\n'
export PATH="${CARGO_TARGET_DIR:-$PWD/target}/release:$PATH"
cd scenes

# announce NAME: the progress. Counted in a file, since most figures end in a subshell.
: > "$out/rows/drawn"
announce() {
    printf '%s\n' "$1" >> "$out/rows/drawn"
    printf '%3d of %d  %s.png\n' "$(wc -l < "$out/rows/drawn")" "$n_figures" "$1"
}

# flyby NAME [OPTION...]: four moments of the scene on standard input, later ones below, by rays
flyby() {
    local name=$1 scene=$out/rows/$1.ug rows=() time row
    shift
    cat > "$scene"
    for time in 07 12 17 22; do
        row=$out/rows/$name-$time.png
        ugphoton -look 1988 -qt --no-doppler "${backdrop[@]}" -ti $time -va 90 -sz "$width" $((height / 4 - 3)) "$@" -fo "$row" "$scene"
        rows+=("$row")
    done
    tile "$out/$name.png" 1 "${rows[@]}"
    announce "$name"
}

# tile SHEET COLUMNS PICTURE...: pictures close together, without labels
tile() {
    ugsheet -qt -lb none -gap 4 0 -bg .25 -cols "$2" -fo "$1" "${@:3}"
}

# sheet NAME TITLE PICTURE...: a contact sheet with the numbers of figures as labels
sheet() {
    local name=$1 title=$2 labels=() picture label number
    shift 2
    for picture; do
        label=$(basename "$picture" .png)
        number=${label#*-}
        number=${number%%-*}
        # A speed is no number of a figure.
        if [[ $number == [0-9]* && $number != *.*c ]]; then
            label=${label#*-"$number"-}
            label="Figure ${number#0}: ${label//-/ }"
        else
            label=${label//-/ }
            label=${label#"$name "}
        fi
        labels+=(-label "$label")
    done
    ugsheet -qt "${labels[@]}" -cap "$title" -bg .25 -cols 4 -fo "$out/sheet-$name.png" "$@"
}

# The colour around bodies.
backdrop=(-bg .8 210 .25)

# in_space COMMAND [ARGUMENT...]: the same before black
in_space() {
    local backdrop=()
    "$@"
}

# draw NAME [OPTION...]: the last stage, to OUTDIR/NAME.png
draw() {
    local name=$1
    shift
    ugrainbow -qt "${backdrop[@]}" -sz "$width" "$height" "$@" -fo "$out/$name.png"
    announce "$name"
}

# trace NAME [OPTION...]: the shape of moving bodies by rays, to OUTDIR/NAME.png
trace() {
    local name=$1
    shift
    ugphoton -look 1988 -qt --no-doppler --no-flux "${backdrop[@]}" -sz "$width" "$height" "$@" -fo "$out/$name.png"
    announce "$name"
}

# shine NAME [OPTION...]: moving bodies by rays with changes of brightness, to OUTDIR/NAME.png
shine() {
    local name=$1
    shift
    ugphoton -look 1988 -qt --no-doppler -tc filmic "${backdrop[@]}" -sz "$width" "$height" "$@" -fo "$out/$name.png"
    announce "$name"
}

# warp NAME [OPTION...]: a view of a panorama or of stars, to OUTDIR/NAME.png
warp() {
    local name=$1
    shift
    ugwarp -look 1988 -qt -sz "$width" "$height" "$@" -fo "$out/$name.png"
    announce "$name"
}

# The functions of the gallery's page write variants of scenes.
eval "$(sed -n 's/^    \([a-z_]*() {.*\)/\1/p' ../docs/gallery.md)"

# Nguyen 1988, figure 1: the rainbow.
in_space draw nguyen-01-rainbow -wi rainbow.ug

# Nguyen 1988, figure 2: the ship at rest and at 0.3, 0.6 and 0.9c. Then in colour: at 0.6c the
# stern still comes nearer while the bow goes away; head-on, much above 0.2c much of the ship
# would shine where no eye sees.
uglorentz ship.ug | draw nguyen-02a-rest -va 46
uglorentz -in -vel .3 0 0 ship.ug | draw nguyen-02b-0.3c -va 46
uglorentz -in -vel .6 0 0 ship.ug | draw nguyen-02c-0.6c -va 46
uglorentz -in -vel .9 0 0 ship.ug | draw nguyen-02d-0.9c -va 46
uglorentz -in -vel .6 0 0 ship.ug | ugdoppler -qt | draw nguyen-02e-0.6c-colours -va 46
uglorentz -in -vel 0 -.2 0 ship.ug | ugdoppler -qt | draw nguyen-02f-approaching-0.2c-colours -va 46
uglorentz -in -vel 0 .2 0 ship.ug | ugdoppler -qt | draw nguyen-02g-receding-0.2c-colours -va 46

if [ $paper = nguyen ]; then
    printf 'The pictures are in %s\n' "$out"
    exit
fi

# Nguyen 1988, figures 3.3.1 and 3.3.2, Chang, Lai and Chen 1996, figure 1, and Howard, Dance and
# Kitchen 1995, figures 2 and 3: plots.
xtask plots "$out"
for plot in nguyen-3.3.1-hues nguyen-3.3.2-attenuation chang-01-aberration \
    howard-02-field-of-view-forward howard-03-field-of-view-backward; do
    announce "$plot"
done

# Chang, Lai and Chen 1996, figure 9: at rest, and at 0.95c when seen at right angles.
uglorentz teapot.ug | draw chang-09a-teapot-rest
uglorentz -in -vel .95 0 0 teapot.ug | draw chang-09b-teapot-0.95c
uglorentz cubes.ug | draw chang-09c-cubes-rest
uglorentz -in -vel .95 0 0 cubes.ug | draw chang-09d-cubes-0.95c
uglorentz sphere.ug | draw chang-09e-sphere-rest
uglorentz -in -vel .95 0 0 sphere.ug | draw chang-09f-sphere-0.95c

# Figure 10: the teapot flies by, seen at equal intervals of time, later ones below. It seems
# to slow down: its approach is seen sped up, its retreat drawn out.
uglorentz teapot.ug | draw chang-10a-rest -va 90
for speed in .95 .999; do
    rows=()
    for time in 07 12 17 22; do
        row=$out/rows/teapot-$speed-$time.png
        uglorentz -vel $speed 0 0 -ti $time teapot.ug | ugrainbow -qt "${backdrop[@]}" -va 90 -sz "$width" $((height / 4 - 3)) -fo "$row"
        rows+=("$row")
    done
    tile "$out/chang-10-0${speed}c.png" 1 "${rows[@]}"
    announce "chang-10-0${speed}c"
done

# Figures 11 and 12: the street at rest, approaching, receding; and in colour. Wavelengths (-gw)
# continue beyond the range of hues, so colours fade evenly at the ends of the visible spectrum. A plain
# reaches to the horizon of the street that recedes.
uglorentz street.ug | draw chang-11-rest
uglorentz -vel 0 -.99 0 -ep 0 40 3 street.ug | draw chang-12a-in-0.99c
on_plain | uglorentz -vel 0 .99 0 -ep 0 -250 3 | draw chang-12b-out-0.99c
uglorentz -vel 0 -.9 0 -ep 0 20 3 street.ug | ugdoppler -qt -gw | draw chang-12c-in-0.9c-colours -wi -va 110

# Figures 13 and 15, with shadows: the teapot's brightness under three distant lights: moving with the
# teapot, at rest with the viewer, and, in the teapot's rest frame, moving towards it. The lights are level
# with the tiles and do not reach them: tiles have a brightness of their own.
pot '' > "$out/rows/pot.ug"
pot '<0 0 0>' > "$out/rows/pot-lights-at-rest.ug"
pot '<-0.95 0 0>' > "$out/rows/pot-lights-coming.ug"
on_tiles .95 "$out/rows/pot.ug" 0 ' .55' | flyby chang-13-lights-along -ex .5 -tc filmic
on_tiles .95 "$out/rows/pot-lights-at-rest.ug" 0 ' .14' | flyby chang-15a-lights-at-rest -ex 4 -tc filmic
shine chang-13-rest -ex .5 "$out/rows/pot.ug"
shine chang-15b-lights-coming -ex -5 "$out/rows/pot-lights-coming.ug"

# Figures 14 and 16, with shadows: the brightness of the street, approaching and receding, under
# lights at rest with the street and with the viewer, all with one exposure. The street that recedes is
# darker by a factor of 14, so it is drawn again seven and a half stops brighter.
sed 's/^\(l .*\);/\1 <0 0 0> ;/' street.ug > "$out/rows/street-lights-at-rest.ug"
shine chang-14a-in-0.99c -vel 0 -.99 0 -ep 0 40 3 -ex -1.55 street.ug
shine chang-14b-out-0.99c -vel 0 .99 0 -ep 0 -250 3 -vc 0 23 10 -ex -1.55 <(on_plain)
shine chang-14c-out-0.99c-brighter -vel 0 .99 0 -ep 0 -250 3 -vc 0 23 10 -ex 6 <(on_plain)
shine chang-16-lights-at-rest -vel 0 -.99 0 -ep 0 40 3 -ex -1.55 "$out/rows/street-lights-at-rest.ug"

# Figure 17: a surface that reflects three narrow bands around 460, 540 and 600 nm, under lamps with
# the same power at every wavelength, at 0.5c from left to right, later
# pictures below: blueshifted when approaching, redshifted when receding. Each row has its own
# exposure.
bands='c_refl 452 0 460 .3 468 0 532 0 540 .7 548 0 592 0 600 1 608 0 ; c_spd even 100 1 10000 1 ;'
rows=()
for time in 02 09 16 22; do
    row=$out/rows/bands-$time.png
    sed "s/^c .*/$bands/; s/^\(l .*\);/\1 even ;/" teapot.ug | uglorentz -vel .5 0 0 -ti $time | ugdoppler -qt -sp -ir |
        ugrainbow -qt -ex auto -sky stars -va 70 -sz "$width" $((height / 4 - 3)) -fo "$row"
    rows+=("$row")
done
tile "$out/chang-17-bands-0.5c.png" 1 "${rows[@]}"
announce chang-17-bands-0.5c

# Howard, Dance and Kitchen 1995, figures 4 and 5: flying towards a grid, and just behind it.
uglorentz grid.ug | draw howard-04a-rest
uglorentz -vel 0 -.5 0 grid.ug | draw howard-04b-0.5c
uglorentz -vel 0 -.9 0 grid.ug | draw howard-04c-0.9c
uglorentz -ep 0 -1.732 0 grid.ug | draw howard-05a-rest
uglorentz -vel 0 -.5 0 -ep 0 -1.732 0 grid.ug | draw howard-05b-0.5c
uglorentz -vel 0 -.9 0 -ep 0 .109 0 grid.ug | draw howard-05c-through-0.9c

# Weiskopf 2000, figure 1: a textured sphere of directions, at rest and at 0.9c. Its texture is made
# of faces.
ugrainbow -qt "${backdrop[@]}" -sz "$width" $((width * 14 / 27)) -fo "$out/weiskopf-01-directions.png" directions.ug
announce weiskopf-01-directions

# Weiskopf 2000, figure 3: a tunnel of black bodies at 3500, 5900 and 10000 K: at rest; flying
# through it at 0.6c with the shape alone, with the Doppler effect, and with the searchlight effect
# as well, at a tenth of the exposure (-3.32 stops).
uglorentz tunnel.ug | ugdoppler -qt -sp | in_space draw weiskopf-03a-rest
uglorentz -cv 0 .6 0 tunnel.ug | ugdoppler -qt -sp --no-doppler --no-flux | in_space draw weiskopf-03b-0.6c-shape
uglorentz -cv 0 .6 0 tunnel.ug | ugdoppler -qt -sp --no-flux | in_space draw weiskopf-03c-0.6c-doppler
uglorentz -cv 0 .6 0 tunnel.ug | ugdoppler -qt -sp | in_space draw weiskopf-03d-0.6c-searchlight -ex -3.32

# The same four from a panorama of the tunnel at rest.
ugphoton -look 1988 -qt -sp -pan -aa 2 -sz 4096 2048 -dt exr tunnel.ug -fo "$out/rows/tunnel.exr"
tunnel_view() { warp "$1" --basis 3500 5900 10000 -va 90 73.74 -aa 2 "${@:2}" "$out/rows/tunnel.exr"; }
tunnel_view weiskopf-03a-warped-rest
tunnel_view weiskopf-03b-warped-0.6c-shape -cv 0 .6 0 --no-doppler --no-flux
tunnel_view weiskopf-03c-warped-0.6c-doppler -cv 0 .6 0 --no-flux
tunnel_view weiskopf-03d-warped-0.6c-searchlight -cv 0 .6 0 -ex -3.32

# Our own: stars ahead of a ship that flies to Orion, and for a dome.
for speed in 0.0 0.5 0.9 0.99; do
    warp "stars-${speed}c" -cv -$speed 0 0 -vc -1 0 0 -va 90 --white .5 --star-width 2.2 stars.csv
    warp "stars-dome-${speed}c" -cv -$speed 0 0 -vc -1 0 0 -fish 180 --white .5 --star-width 2.2 stars.csv
done

# Our own: the lattice in shape and colour, mixed colours at a vertex, five speeds in one picture.
uglorentz -vel 0 -.9 0 lattice.ug | in_space draw lattice-0.9c-shape -va 120
uglorentz -vel 0 -.9 0 lattice.ug | ugdoppler -qt -gw | in_space draw lattice-0.9c-colours -wi -va 120
ugdoppler -qt halves.ug | draw halves-mixed
ugdoppler -qt -vr halves.ug | draw halves-repeated
uglorentz -in dice.ug | draw dice
uglorentz lamp.ug | ugdoppler -qt | in_space draw lamp-at-rest
uglorentz lamp.ug | ugdoppler -qt -li | in_space draw lamp-moving

# With rays, by the gallery's scenes.

# Nguyen 1988, figures 3 and 4: reflections; refractions and reflections.
for speed in 0.0 0.3 0.6 0.9; do
    trace "nguyen-03-reflections-${speed}c" -in <(over_floor_of_ice $speed)
    trace "nguyen-04-refractions-${speed}c" -in <(behind_a_globe $speed)
done

# Chang, Lai and Chen 1996, figures 9 to 12 with shadows, over tiles at rest, and 18: a shadow that lags.
for body in 'teapot.ug 0' 'cubes.ug -1.5' 'sphere.ug -1'; do
    for speed in 0.0 0.95; do trace "chang-09-rays-${body%.ug*}-${speed}c" -in <(on_tiles $speed $body); done
done
for speed in 0.95 0.999; do on_tiles $speed teapot.ug 0 | flyby "chang-10-rays-${speed}c" --no-flux; done
trace chang-11-rays-rest street.ug
trace chang-12a-rays-in-0.99c -vel 0 -.99 0 -ep 0 40 3 street.ug
trace chang-12b-rays-out-0.99c -vel 0 .99 0 -ep 0 -250 3 -vc 0 23 10 <(on_plain)
for speed in 0.0 0.95; do trace "chang-18-shadow-${speed}c" -in <(over_floor $speed); done

# Howard, Dance and Kitchen 1995, figures 6 to 8: an infinite plane ahead; a grid behind and beside.
# Then both shutters.
for speed in 0.0 0.5 0.9; do
    trace "howard-06-plane-${speed}c" -cv 0 $speed 0 <(infinite_plane)
    trace "howard-07-behind-${speed}c" -cv 0 -$speed 0 -ep 0 -14.4 0 grid.ug
    trace "howard-08-beside-${speed}c" -in -vel -$speed 0 0 -ep 0 -8 0 grid.ug
done
trace howard-shutter-pinhole -cv 0 .5 0 -ep 0 -1.5 0 -va 112 grid.ug
trace howard-shutter-film -cv 0 .5 0 -ep 0 -1.5 0 -va 112 --film-shutter 2 grid.ug

# Li, Shum and Peng 2001, figures 5 and 6: glass and metal in a room of letters. Their clips are
# drawn by films.sh.
for material in 05-glass 06-metal; do
    number=${material%-*} material=${material#*-}
    trace "li-${number}a-$material-right-0.99c" -in <($material '.99 0 0')
    trace "li-${number}b-$material-near-0.9c" -in <($material '0 -.9 0')
    trace "li-${number}c-$material-away-0.99c" -in <($material '0 .99 0')
done

# Our own: a glass of water.
trace water-0.8c -in -rd 64 -rc .05 <(water .8)

# Cars at 0.6c, from a camera at rest and from one that moves at 0.5c.
uglorentz -cv 0 0 0 traffic.ug | draw traffic-a-standing
uglorentz traffic.ug | draw traffic-b-driving

# Glass at rest and at 0.9c; edges alone, and both.
draw glass-a-rest glass.ug
uglorentz -in -vel .9 0 0 glass.ug | draw glass-b-0.9c
uglorentz -in -vel .9 0 0 glass.ug | draw glass-c-0.9c-edges -wf -lc 1 -dc 7 12
uglorentz -in -vel .9 0 0 glass.ug | draw glass-d-0.9c-both -ed

# A sheet for each paper, in its order: within a figure its parts before what we add.
shopt -s nullglob
cd "$out"
sheet nguyen 'H. P. Nguyen, Implementation of Two Relativistic Renderers, 1988' \
    nguyen-3.3.*.png nguyen-0{1,2,3,4}{[a-z]-,-}*.png
sheet chang 'M.-C. Chang, F. Lai and W.-C. Chen 1996' \
    chang-01-*.png chang-09-rays-{teapot,cubes,sphere}-{0.0,0.95}c.png chang-10-rays-{0.95,0.999}c.png \
    chang-11-rays-*.png chang-12{a-rays,b-rays,c}-*.png chang-13-{rest,lights-along}.png \
    chang-14{a,b,c}-*.png chang-15{a,b}-*.png chang-1{6,7}-*.png chang-18-shadow-{0.0,0.95}c.png
sheet howard 'A. Howard, S. Dance and L. Kitchen 1995' \
    howard-0{2,3}-*.png howard-0{4,5}{a,b,c}-*.png howard-06-plane-{0.0,0.5,0.9}c.png \
    howard-0{7-behind,8-beside}-{0.5,0.9}c.png howard-shutter-{pinhole,film}.png
sheet weiskopf 'D. Weiskopf 2000' weiskopf-0{1,3}{[a-z]-[0-9r],[a-z]-w,-}*.png
sheet li 'J. Li, H. Shum and Q. Peng 2001' li-0{5,6}{[a-z]-,-}*.png
sheet ours 'Other figures' stars-{0.0,0.5,0.9,0.99}c.png stars-dome-{0.0,0.5,0.9,0.99}c.png {lattice,halves,dice,traffic,lamp,glass,water}*.png
printf 'The pictures are in %s, those of each paper on one sheet, %s/sheet-*.png\n' "$out" "$out"
