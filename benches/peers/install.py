# SPDX-License-Identifier: MIT OR Apache-2.0
"""Gets and builds the contestants, once; missing ones are left out and reported. The only part that needs the network.
"""

import os
import subprocess
import sys
from pathlib import Path

from contestants import BULLET, COAL, OURS, PARRY, YADE

HERE = Path(__file__).resolve().parent
TOP = HERE.parents[1]
OUT = TOP / "out" / "peers"
COAL_VERSION = "3.0.3"
DEBIAN = ("libbullet-dev", "pkgconf", "python3-venv", "python3-scipy", "python3-matplotlib")
YADE_PROGRAM = Path("/usr/bin/yade")
WARNINGS = ["-O3", "-DNDEBUG", "-std=c++17", "-Wall", "-Wextra"]


class Contestants:
    """Commands of those that are there, why the others are not, and versions."""

    def __init__(self):
        self.commands, self.missing, self.versions = {}, {}, {}

    def add(self, name, prepare):
        """prepare: returns the command and the version; any error is the reason why it is missing."""
        try:
            self.commands[name], self.versions[name] = prepare()
        except (OSError, subprocess.CalledProcessError, LookupError) as error:
            self.missing[name] = _reason(error)
        print(f"  {name:<8} {self.versions.get(name) or 'not to be had: ' + self.missing[name]}", flush=True)


def everybody():
    OUT.mkdir(parents=True, exist_ok=True)
    (OUT / "bin").mkdir(exist_ok=True)
    packages(DEBIAN)
    found = Contestants()
    found.add(OURS, lambda: rust("ours"))
    found.add(PARRY, lambda: rust("parry"))
    found.add(COAL, _coal)
    found.add(BULLET, _bullet)
    found.add(YADE, _yade)
    return found


def program(name):
    """A command of the package `peers`: `placed`, which places potential particles."""
    return _target() / "release" / name


def packages(names):
    """Installs those of Debian's packages that are not there."""
    listed = subprocess.run(["dpkg-query", "--show", "--showformat=${db:Status-Abbrev}${Package}\n", *names],
                            capture_output=True, text=True)
    there = {line[3:] for line in listed.stdout.splitlines() if line[1:2] == "i"}
    absent = [name for name in names if name not in there]
    if absent:
        print(f"  installing with apt: {' '.join(absent)}", flush=True)
        root = [] if os.geteuid() == 0 else ["sudo"]
        apt = [*root, "env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-qq"]
        # Each by itself: what one suite of Debian lacks must not keep the others away.
        subprocess.run([*apt, "update"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for name in absent:
            subprocess.run([*apt, "install", "--yes", "--no-install-recommends", name], stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL)


def _target():
    return Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target")).resolve() / "peers"


def rust(name):
    """Builds a program of the package `peers`: its command and what it is made of."""
    folder = HERE / "rust"
    environment = dict(os.environ, CARGO_TARGET_DIR=str(_target()))
    _run(["cargo", "build", "--release", "--quiet", "--locked"], cwd=folder, env=environment)
    version = _locked("parry3d-f64") if name == PARRY else _locked("potential-particles")
    return [_target() / "release" / name], f"{version}, {_output(['rustc', '--version'])}"


def _locked(package):
    blocks = (HERE / "rust" / "Cargo.lock").read_text().split("[[package]]")
    block = next(block for block in blocks if f'name = "{package}"' in block)
    return f"{package} " + next(line for line in block.splitlines() if line.startswith("version")).split('"')[1]


def _wheel(package, version):
    """The folder of the packages of an environment that has this one, from PyPI."""
    environment = OUT / "venv"
    if not (environment / "bin" / "python").exists():
        _run([sys.executable, "-m", "venv", environment])
    python = environment / "bin" / "python"
    asked = f"import importlib.metadata as m; print(m.version({package!r}))"
    if subprocess.run([python, "-c", asked], capture_output=True, text=True).stdout.strip() != version:
        _run([python, "-m", "pip", "install", "--quiet", "--only-binary", ":all:", f"{package}=={version}"])
    return next(environment.glob("lib/python*/site-packages"))


def _coal():
    prefix = _wheel("coal", COAL_VERSION) / "cmeel.prefix"
    links = [f"-L{prefix}/lib", "-lcoal", f"-Wl,-rpath,{prefix}/lib", f"-Wl,-rpath-link,{prefix}/lib"]
    _compile("coal", [f"-isystem{prefix}/include", "-isystem/usr/include/eigen3"], links)
    return [OUT / "bin" / "coal"], f"Coal {COAL_VERSION}, the wheel's library"


def _bullet():
    flags = _output(["pkg-config", "--cflags", "bullet-float64"]).replace("-I", "-isystem").split()
    links = _output(["pkg-config", "--libs", "bullet-float64"]).split()
    _compile("bullet", flags, links)
    return [OUT / "bin" / "bullet"], f"Bullet {_package('libbullet-dev')}, float64"


def _yade():
    if not YADE_PROGRAM.exists():
        raise LookupError(f"{YADE_PROGRAM} is not installed")
    return [YADE_PROGRAM, "-x", "-n", "-j1", HERE / "yade_pairs.py"], f"YADE {_package('yade')}"


def _compile(name, flags, links):
    """Unless it is there and younger than its sources, and than this file."""
    program, sources = OUT / "bin" / name, [HERE / "cpp" / f"{name}.cpp", HERE / "cpp" / "server.hpp", Path(__file__)]
    if not program.exists() or program.stat().st_mtime < max(source.stat().st_mtime for source in sources):
        _run(["g++", *WARNINGS, *flags, sources[0], "-o", program, *links])


def _package(name):
    return _output(["dpkg-query", "--show", "--showformat=${Version}", name])


def _run(command, **more):
    subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True, **more)


def _output(command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def _reason(error):
    if isinstance(error, subprocess.CalledProcessError) and error.stderr:
        return error.stderr.strip().splitlines()[-1]
    return str(error)
