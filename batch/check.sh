#!/usr/bin/env bash
# Runs the workflows of this folder on a Slurm of one machine, small, kills a job on the way, and
# compares the films and pictures with those of one process. `cargo xtask cluster` runs it:
#
#   batch/check.sh PROGRAMS      the folder of the programs
#
# Missing Debian packages are installed, and Snakemake in the cache folder of the user.
set -euo pipefail
batch=$(dirname "$(realpath "$0")")
programs=$(realpath "${1:?give the folder of the programs}")
say() { printf '%4s s  %s\n' "$SECONDS" "$*"; }
fail() { echo "error: $*" >&2; exit 1; }

say "tools"
if [ "$(command -v slurmctld slurmd munged parallel | wc -l)" != 4 ] || ! python3 -c 'import ensurepip'; then
    sudo=$([ "$(id -u)" = 0 ] || echo sudo)
    $sudo apt-get update -qq
    $sudo apt-get install -qq -y --no-install-recommends slurm-wlm munge parallel python3-venv >/dev/null
fi
venv=${XDG_CACHE_HOME:-$HOME/.cache}/ug-snakemake
if ! cmp -s "$batch/requirements.txt" "$venv/installed"; then
    python3 -m venv "$venv"
    "$venv/bin/pip" install --quiet --disable-pip-version-check -r "$batch/requirements.txt"
    cp "$batch/requirements.txt" "$venv/installed"
fi
export PATH=$programs:$venv/bin:$PATH

folder=$(mktemp -d)
started=()
end() {
    local status=$?
    [ ${#started[@]} = 0 ] || kill "${started[@]}" 2>/dev/null || true
    "$batch/one-machine.sh" stop "$folder/slurm" || true
    [ "$status" = 0 ] || tail -n 30 "$folder"/*.log >&2 || true
    rm -rf "$folder"
}
trap end EXIT
cp "$batch"/../scenes/street.ug "$batch"/../scenes/room.ug "$folder"
cd "$folder"
SLURM_CONF=$("$batch/one-machine.sh" start slurm)
export SLURM_CONF
[ /etc/slurm/slurm.conf -ef "$SLURM_CONF" ] \
    || fail "this machine has a slurm.conf of its own, or you are not root: jobs would not find ours"

# The pages of batch/, with fewer and smaller frames and tiles. Every change has to be possible.
small() {
    local page=$1 text
    text=$(cat "$batch/$page")
    shift
    while [ $# -gt 0 ]; do
        [[ $text == *"$1"* ]] || fail "$page: no '$1'"
        text=${text//"$1"/"$2"}
        shift 2
    done
    printf '%s\n' "$text" >"$page"
}
small film.yaml 'sz 1280 720' 'sz 320 180' 'frames: 240' 'frames: 12' drive.mp4 drive.apng \
    'frames_per_job: 10' 'frames_per_job: 4' 'threads: 4' 'threads: 1'
small film.sbatch 'sz 1280 720' 'sz 320 180' 240 12 ':10' ':4' '+ 9' '+ 3' task=4 task=1 'nt 4' 'nt 1' \
    drive array
small tiles.yaml 'aa 4' 'aa 2' 16384 200 2048 128 'threads: 4' 'threads: 1'
small tiles.sbatch 'aa 4' 'aa 2' 0-63 0-3 '% 8' '% 2' '/ 8' '/ 2' '16384 16384' '256 256' 2048 128 \
    task=4 task=1 'nt 4' 'nt 1' room/ array-room/

say "one process"
drive=(-frames 12 -cv '0 0 0 .. 0 .99 0' -sp -ex -3.87 -sz 320 180)
mkdir whole drive array array-room
ugfilm "${drive[@]}" -fo whole/frame_%06d.png street.ug
ugfilm "${drive[@]}" -keep whole/frame_%06d.png -fo whole.apng street.ug
ugphoton -ex 0 -aa 2 -sz 200 200 -fo whole.png room.ug
ugphoton -ex 0 -aa 2 -sz 256 256 -fo whole256.png room.ug
! cmp -s whole/frame_000001.png whole/frame_000002.png || fail "all frames are alike"

say "Snakemake: a film, of which a job is killed, and a picture"
# This Slurm has no database of past jobs.
quick=(--latency-wait 5 --slurm-status-command squeue --slurm-no-account
    --slurm-init-seconds-before-status-checks 1 --seconds-between-status-checks 1)
for workflow in film tiles; do
    mkdir -p "$workflow-state"
    cp "$batch/$workflow.smk" .
    timeout -s KILL 300 snakemake -s "$workflow.smk" --configfile "$workflow.yaml" \
        --workflow-profile "$batch/slurm" "${quick[@]}" --nolock >"$workflow.log" 2>&1 &
    started+=($!)
done
victim=
for _ in $(seq 600); do
    # A job that draws frames: one has been drawn, and others are missing.
    if compgen -G 'drive/frame_*.png' >/dev/null; then
        victim=$(squeue -h -t running -o '%A %k' | awk '/part/ {print $1; exit}')
        [ -z "$victim" ] || break
    fi
    sleep 0.05
done
[ -n "$victim" ] || fail "no job was running"
scancel --signal=KILL --full "$victim" || scancel "$victim"
say "killed job $victim after $(ls drive/frame_*.png | wc -l) of 12 frames"
for job in "${started[@]}"; do wait "$job"; done
started=()
grep -q 'Trying to restart job' film.log || fail "no job of the film was tried again"
diff -r --exclude=parts whole drive || fail "the frames of the film differ from those of one process"
cmp whole.apng drive.apng
cmp whole.png room.png

say "Slurm arrays"
sbatch --wait --output=array-film.log film.sbatch >/dev/null &
sbatch --wait --output=array-tiles.log tiles.sbatch >/dev/null
wait
diff -r whole array
ugsheet --tiles array-room/tile_*.png | cmp - whole256.png

say "GNU parallel"
mkdir -p parallel-room parallel
seq 1 4 9 | parallel ugfilm "$(printf "'%s' " "${drive[@]}")" -only '{}..$(({} + 3))' -nt 1 \
    -fo parallel/frame_%06d.png street.ug
diff -r whole parallel
say "the film and the picture of every way are those of one process"
