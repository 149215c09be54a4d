#!/usr/bin/env bash
# Runs a script in YADE, without its window, with the potential_particles package at hand:
#   scripts/yade.sh -j2 SCRIPT [ARGUMENT...]
set -euo pipefail
package=$(cd "$(dirname "$0")/.." && pwd)/yade-glue/build/python
if [ ! -d "$package/potential_particles" ]; then
    echo "yade.sh: the YADE plugin is not built: run make build." >&2
    exit 1
fi
export PYTHONPATH=$package${PYTHONPATH:+:$PYTHONPATH}
# Threads of YADE that wait should not keep the cores from those that work.
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY:-passive}
# In the place of this shell, so that Ctrl-C and the exit code are the script's own. Debian's YADE by
# its full name: the plugin fits no other that may come first on PATH.
exec /usr/bin/yade -x -n "$@"
