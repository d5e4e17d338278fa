#!/usr/bin/env bash
# Running times of the programs, measured by hyperfine, as Markdown. `cargo xtask bench` runs it:
#
#   xtask/bench.sh PROGRAMS XTASK [NAME] [--against FOLDER] [--triangles N] [--runs N]
#
#   pipe          every program of the pipe, relative to `cat` of the same file
#   raster        drawing: sizes, samples, culling, exact pictures
#   rays          rays against triangles, relative to Embree 3; requires g++ and libembree-dev
#   photon        the ray tracer: motion and many bodies, relative to rest
#   warp          panoramas, relative to the filter v360 of ffmpeg, which must be installed
#   film          films, relative to their pipes run by a shell
#   scenes        README's street with its textures, as a film; drafts of two scenes, relative to full size
#   world-lines   bodies that accelerate and spin, relative to inertial ones, by the pipe and by rays
#
# --against: the programs of another commit, measured in turn: `target/release` of its worktree.
# --triangles: of the meshes, roughly, instead of 100000 and then 1000000. --runs: of each command,
# after one that is not measured, instead of 10.
#
# Ratios within a table vary less from machine to machine than times, and processor time varies less
# than elapsed time with what else runs.
set -euo pipefail
here=$(dirname "$(realpath "$0")")
programs=$1 xtask=$(dirname "$2")
shift 2
name=pipe against='' triangles='100000 1000000' runs=10
while [ $# -gt 0 ]; do
    case $1 in
        --against) against=$(realpath "$2"); shift 2 ;;
        --triangles) triangles=$2; shift 2 ;;
        --runs) runs=$2; shift 2 ;;
        -*) echo "bench: there is no option $1" >&2; exit 2 ;;
        *) name=$1; shift ;;
    esac
done
mkdir -p "$programs/../bench"
cd "$programs/../bench"
command -v hyperfine >/dev/null || { echo 'bench: hyperfine is not installed' >&2; exit 1; }

# A command that finds the programs of a folder first and fails with any part of a pipe.
with() { echo "set -euo pipefail; PATH='$1:$xtask':\"\$PATH\"; $2"; }
setup() { bash -c "$(with "$programs" "$1")"; }
# The head of a table.
table() {
    printf '\n| %s | time, ms | processor time, ms | relative |%s\n' "$1" \
        "${against:+ other commit, ms | other / this |}"
    echo "| --- | ---: | ---: | ---: |${against:+ ---: | ---: |}"
    first=
}
# A row of it: its name, and a command. Median elapsed time, mean processor time.
row() {
    hyperfine --shell=bash --style=none --warmup=1 --runs="$runs" --export-csv times.csv \
        "$(with "$programs" "$2")" ${against:+"$(with "$against" "$2")"} >/dev/null
    # Commands contain commas: numbers are counted from the end of a line.
    read -r time processor other < <(awk -F, 'NR > 1 { printf "%.1f %.1f ", 1e3 * $(NF-4), 1e3 * ($(NF-3) + $(NF-2)) }' times.csv |
        awk '{ print $1, $2, $4 }')
    first=${first:-$processor}
    awk -v name="$1" -v t="$time" -v p="$processor" -v f="$first" -v o="$other" 'BEGIN {
        printf "| %s | %.1f | %.1f | %.2f |", name, t, p, p / f
        if (o) printf " %.1f | %.3f |", o, o / p
        print "" }'
}

picture='-qt -sz 1280 720'
camera='l 0.3; l sun 0.7 -1 -2 1.5; cam -ep 0 -6 1 -vc 0 0 0 -ud 0 0 1 -va 30 18;'
# The faces of a mesh as the definition `mesh`.
definition() { echo "echo 'def mesh;'; xtask mesh $1 | grep -v '^l \|^cam '; echo 'end;'"; }

pipe() {
    moved='uglorentz -qt -vel .3 0 0' drawn="ugrainbow $picture -aa 1"
    setup "xtask mesh $1 > mesh.ug; xtask mesh --each $1 > each.ug
        $moved mesh.ug > seen.ug; $moved each.ug > each-seen.ug; ugdoppler -qt seen.ug > coloured.ug"
    table "the pipe, $1 triangles"
    row '`cat`' 'cat mesh.ug'
    row '`ugparse flatten`' 'ugparse flatten mesh.ug'
    row '`uglorentz -vel .3 0 0`' "$moved mesh.ug"
    row '`ugdoppler`' 'ugdoppler -qt seen.ug'
    row '`ugdoppler -sp`' 'ugdoppler -qt -sp seen.ug'
    row '`ugdoppler`, own colours' 'ugdoppler -qt each-seen.ug'
    row '`ugdoppler -sp`, own colours' 'ugdoppler -qt -sp each-seen.ug'
    row '`ugrainbow -sz 1280 720 -aa 1`' "$drawn coloured.ug"
    row 'the whole pipe' "$moved mesh.ug | ugdoppler -qt | $drawn"
}
raster() {
    setup "xtask mesh $1 > mesh.ug"
    table "\`ugrainbow\`, $1 triangles"
    row '`-sz 16 9 -aa 1`, mostly reading' 'ugrainbow -qt -sz 16 9 -aa 1 mesh.ug'
    for options in '1280 720 -aa 1' '1280 720 -aa 1 -cb' '1280 720 -aa 4' '1280 720 -aa 4 -fl spline' \
        '1280 720 -aa 1 -xc' '1920 1080 -aa 1' '8192 8192 -aa 1'; do
        row "\`-sz $options\`" "ugrainbow -qt -sz $options mesh.ug"
    done
}
rays() {
    setup "g++ -O3 -march=native -pthread '$here/embree.cpp' -o embree -lembree3
        xtask trace-rays mesh $1 > rays.bin"
    for work in build single packet; do
        table "$work, 20 times, $1 triangles, 2 threads"
        row Embree "./embree rays.bin $work 20"
        row '`ugbvh`' "RAYON_NUM_THREADS=2 xtask trace-rays $work $1 20"
    done
}
photon() {
    # Places and velocities spread evenly by multiples of irrational numbers.
    many="awk 'BEGIN { for (i = 0; i < 100; i++) printf \"i (mesh -sa .15 -tx %f -ty %f -tz %f) <%f %f 0>;\\n\",
        i*.819%1-.5, i*.671%1-.5, i*.550%1-.5, i*.857%1*.8-.4, i*.734%1*.8-.4 }'"
    setup "{ $(definition "$1"); echo 'i (mesh); $camera'; } > rest.ug
        { $(definition "$1"); echo 'i (mesh) <.5 0 0>; $camera'; } > moving.ug
        { $(definition $(($1 > 3600 ? $1 / 100 : 36))); $many; echo '$camera'; } > many.ug"
    table "\`ugphoton\`, $1 triangles"
    row 'a body at rest' "ugphoton $picture -aa 1 rest.ug"
    row 'a body at 0.5c' "ugphoton $picture -aa 1 -in moving.ug"
    row 'a body at 0.5c, no shadows' "ugphoton $picture -aa 1 -in --no-shadows moving.ug"
    row '100 bodies with velocities of their own' "ugphoton $picture -aa 1 -in many.ug"
}
world_lines() {
    # The body is at the origin at time 0, and light takes 6 to the camera.
    for program in "uglorentz -qt -an 0 0 0 -ti 6 body.ug | ugdoppler -qt | ugrainbow $picture -aa 1" \
        "ugphoton $picture -an 0 0 0 -ti 6 --no-shadows -aa 1 body.ug"; do
        table "${program%% *}, $1 triangles"
        for motion in '-vel .8 0 0' '-acc .5 0 0 -9 9' '-spin 0 0 .8'; do
            setup "{ echo 'motion m $motion;'; $(definition "$1"); echo 'i (mesh) <m>; $camera'; } > body.ug"
            row "\`$motion\`" "$program"
        done
    done
}
scenes() {
    scenes="$here/../scenes"
    film="ugfilm -qt -nt 1 --frames 8 -aa 1 -ti 0..1 -ep 0 20 3 -va 110 -ex -1.6 -sz 640 360 -dt y4m"
    table '8 frames of 640 × 360 of `town.ug`, one thread'
    for speed in 0 .5 .9; do row "\`-cv 0 $speed 0\`" "$film -cv 0 $speed 0 '$scenes/town.ug'"; done
    row '`-cv 0 .9 0 -rays`, with shadows' "$film -rays -cv 0 .9 0 '$scenes/town.ug'"
    for scene in street lattice; do
        table "\`$scene.ug\` at 0.9c, the pipe"
        for size in '640 480' '160 120 -se .15px -sc 1'; do
            row "\`-sz $size\`" "uglorentz -qt -cv 0 .9 0 -va 120 -sz $size '$scenes/$scene.ug' |
                ugdoppler -qt | ugrainbow -qt -aa 1 -va 120 -sz ${size%% -*}"
        done
    done
}
warp() {
    # A fractal with noise, which has detail at every size.
    setup "[ -e panorama.png ] || ffmpeg -nostdin -v error -f lavfi -i mandelbrot=size=2048x1024:rate=1 \
        -frames:v 1 -vf scale=8192:4096:flags=bicubic,noise=alls=8 -pix_fmt rgb24 panorama.png"
    table '1920 × 1080 of a panorama of 8192 × 4096 pixels'
    row '`v360` of ffmpeg, lanczos' "ffmpeg -nostdin -v error -i panorama.png -vf \
        v360=e:flat:h_fov=90:v_fov=58.715507:w=1920:h=1080:interp=lanczos -frames:v 1 -f null -"
    row '`ugwarp -sz 16 9 -va .5`, mostly reading' 'ugwarp -qt -va .5 -sz 16 9 panorama.png'
    for options in '--no-doppler --no-flux' '-look 1988' '-sp' '-look light'; do
        row "\`ugwarp $options\`" "ugwarp -qt -cv 0 .5 0 -va 90 -sz 1920 1080 $options panorama.png"
    done
}
film() {
    film="ugfilm -qt --frames 24 -vel 0 0 0..0.9 -in -sz 1280 720 -aa $1 mesh.ug"
    setup "xtask mesh 100000 > mesh.ug; $film -fo 'pipe_%04d.png' --print > pipes.sh"
    table "24 frames of 1280 × 720, \`-aa $1\`"
    row 'the pipes, one after the other' 'sh pipes.sh'
    # Frames that are there would not be drawn again.
    row '`ugfilm`, files of frames' "rm -f f_*.png; $film -fo 'f_%04d.png'"
    row '`ugfilm`, one file (Y4M)' "$film -dt y4m"
    row '`ugfilm -look 1988`, one file' "$film -look 1988 -dt y4m"
}

echo "$(sed -n 's/^model name[ \t]*: //p;T;q' /proc/cpuinfo), $(nproc) threads, $(rustc --version)"
case $name in
    pipe | raster | rays | photon | world-lines) for n in $triangles; do "${name/-/_}" "$n"; done ;;
    warp) warp ;;
    film) film 1; film 4 ;;
    scenes) scenes ;;
    *) echo "bench: there is no benchmark $name" >&2; exit 2 ;;
esac
