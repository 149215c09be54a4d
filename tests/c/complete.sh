# Names the functions that a library exports and a harness does not call: complete.sh LIBRARY HARNESS
set -eu
names() { nm --dynamic "$1" --format=just-symbols "$2" | grep '^pp_' | sort; }
exported=$(names --defined-only "$1")
called=$(names --undefined-only "$2")
untested=$(for name in $exported; do echo "$called" | grep -qx "$name" || echo "$name: no test calls it"; done)
echo "$untested"
[ -n "$exported" ] && [ -z "$untested" ]
