#!/usr/bin/env bash
# Runs a script in YADE on several ranks, without its window, with the potential_particles package at hand:
#   scripts/yade_mpi.sh RANKS -jTHREADS SCRIPT [ARGUMENT...]        (THREADS of each rank)
# Ctrl-C, here or at the terminal, asks the ranks to stop (mpi.interrupted() of the package); a second one ends them.
set -uo pipefail
ranks=${1:-}
if ! [[ $ranks =~ ^[1-9][0-9]*$ ]]; then
    echo "yade_mpi.sh: RANKS=$ranks is no number of ranks: give a whole number of at least 1." >&2
    exit 2
fi
shift
if ! command -v mpirun >/dev/null; then
    echo "yade_mpi.sh: mpirun is missing: run make setup." >&2
    exit 2
fi
# A rank's own standard output is never the terminal, even where mpirun makes it look like one.
if [ -t 1 ]; then export PP_TERMINAL=1; else export PP_TERMINAL=0; fi

# A session of its own: mpirun would answer the terminal's Ctrl-C by ending all ranks at once, where it passes this
# signal on. More ranks than cores are allowed, and none is bound to a core, since rank 0 has little to do.
setsid mpirun --allow-run-as-root --map-by :OVERSUBSCRIBE --bind-to none -np "$ranks" \
    "$(dirname "$0")/yade.sh" "$@" </dev/null &
job=$!
asked=0
stop() {
    asked=$((asked + 1))
    if [ "$asked" -eq 1 ]; then kill -USR1 "$job"; else kill -TERM "$job"; fi
}
trap stop INT
trap 'kill -TERM "$job"' TERM HUP
# A signal ends the waiting, not the job.
while
    wait "$job"
    status=$?
    kill -0 "$job" 2>/dev/null
do :; done 2>/dev/null

if [ "$asked" -gt 0 ]; then exit 130; fi
if [ "$status" -gt 128 ]; then
    echo "yade_mpi.sh: a rank was ended by signal $((status - 128)), and the run with it. What it had saved until then is whole." >&2
fi
exit "$status"
