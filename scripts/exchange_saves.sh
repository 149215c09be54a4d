#!/usr/bin/env bash
# Scenes saved by the YADE of this machine are loaded by the one in the Debian at ROOT, where scripts/debian.sh has
# built the plugin, and the other way round:
#   scripts/exchange_saves.sh ROOT
set -euo pipefail
cd "$(dirname "$0")/.."
root=$1
place=$(mktemp -d "$root/tmp/saves.XXXXXX")
trap 'rm -rf "$place"' EXIT

here() {
    env PYTHONPATH="$PWD/yade-glue/build/python:$PWD/tests/yade" yade -x -n tests/yade/exchange/exchange.py "$@"
}

there() {
    chroot "$root" /usr/bin/env -i HOME=/root TERM=dumb LC_ALL=C.UTF-8 PATH=/usr/bin:/bin \
        PYTHONPATH=/src/yade-glue/build/python:/src/tests/yade yade -x -n /src/tests/yade/exchange/exchange.py "$@"
}

status=0
for kind in builtin plugin; do
    here save "$place/here" $kind || status=1
    there load "${place#"$root"}/here" $kind || status=1
    there save "${place#"$root"}/there" $kind || status=1
    here load "$place/there" $kind || status=1
done
exit $status
