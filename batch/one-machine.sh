#!/usr/bin/env bash
# Slurm on this machine alone, to try the workflows: see docs/batch.md. It needs the Debian packages
# slurm-wlm and munge, listens on the loopback interface only, and leaves nothing behind.
#
#   batch/one-machine.sh start FOLDER    prints the path of slurm.conf; its files are in FOLDER
#   batch/one-machine.sh stop FOLDER
#
# Snakemake removes SLURM_CONF from the environment of jobs. So as root, where the machine has no
# slurm.conf of its own, start puts a link there, and stop removes it.
set -eu
case ${1:-} in start | stop) ;; *) echo "usage: $0 start|stop FOLDER" >&2; exit 2 ;; esac
folder=$(realpath -m "${2:?give a folder}")
system=/etc/slurm/slurm.conf
export SLURM_CONF=$folder/slurm.conf

start() {
    local host mib
    host=$(hostname -s)
    mib=$(awk '/MemTotal/ {print int(0.9 * $2 / 1024)}' /proc/meminfo)
    mkdir -p "$folder"/munge "$folder"/state "$folder"/spool "$folder"/log
    chmod 755 "$folder"
    chmod 711 "$folder/munge"
    # A key of its own: nothing of the machine's own munge is read.
    (umask 077; head -c 1024 /dev/urandom >"$folder/munge/key")
    munged --force --key-file="$folder/munge/key" --socket="$folder/munge/sock" \
        --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" \
        --seed-file="$folder/munge/seed" --num-threads=2
    cat >"$SLURM_CONF" <<END
ClusterName=single
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$folder/munge/sock
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmctldPort=16817
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/log/slurmctld
SlurmdLogFile=$folder/log/slurmd
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MinJobAge=300
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=16821 CPUs=$(nproc) RealMemory=$mib State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
    if [ "$(id -u)" = 0 ] && [ ! -e "$system" ]; then
        mkdir -p "$(dirname "$system")"
        ln -s "$SLURM_CONF" "$system"
    fi
    # Servers must not hold the pipe of whoever reads the name.
    slurmctld -f "$SLURM_CONF" >&2
    slurmd -f "$SLURM_CONF" -N n1 >&2
    for _ in $(seq 100); do
        [ "$(sinfo -h -N -t idle 2>/dev/null | wc -l)" = 1 ] && break
        sleep 0.2
    done
    [ "$(sinfo -h -N -t idle | wc -l)" = 1 ] || { tail "$folder"/log/* >&2; exit 1; }
    echo "$SLURM_CONF"
}

stop() {
    local pid
    for pid in "$folder/slurmd.pid" "$folder/slurmctld.pid" "$folder/munge/pid"; do
        [ -f "$pid" ] || continue
        pid=$(cat "$pid")
        kill "$pid" || true
        while kill -0 "$pid" 2>/dev/null; do sleep 0.1; done
    done
    [ "$(readlink "$system")" != "$SLURM_CONF" ] || rm "$system"
}

$1
