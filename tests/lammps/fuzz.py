#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Inputs of LAMMPS with one or two things changed in them: numbers, words, files, the order of commands.

    tests/lammps/fuzz.py [SECONDS] [SEED]      (60 seconds of a fresh seed)

Each must run with finite forces, or end with a sentence of LAMMPS's: no signal, no hang, no words of the compiler's
library. What fails is printed as a test is, with the script as out/fuzz/lammps-SEED-N/in.scene beside its files. The
last line is 'N passed, N failed'.
"""
import random
import re
import shutil
import struct
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "out" / "lammps" / "build" / "python")]

from scene import DEFAULTS, SCRIPT, TOP, lammps, random_bodies, write

CASE_SECONDS = 60
NUMBERS = [
    "0", "-1", "nan", "inf", "1e308", "-1e308", "1e-320", "1e400", "1e16", "2147483648", "0.5", "", "x", "1e", "0x10"
]
FILES = ["missing", "empty", "a folder", "truncated", "damaged", "twice", "no end", "device", "nan", "large"]
# Commands of users that come between two runs.
BETWEEN = [
    "set atom 1 type 2", "set atom 2 d2_orientation[1] 0", "reset_timestep 0", "timestep 2e-5",
    "displace_atoms all move 0 0 0.01", "change_box all x delta -1 1", "pair_coeff * * 1e5 0 0 1", "unfix floor",
    "delete_atoms group all", "delete_atoms random fraction 0.5 yes all NULL 7", "velocity all scale 0",
    "minimize 0 0 5 5", "rerun all.dump dump x y z", "velocity all create 1 8",
    "write_restart f.restart\nclear\nread_restart f.restart", "unfix shapes", "unfix move", "pair_style none",
    "neigh_modify delay 5", "newton on", "set type 1 mass 3", "unfix orientation", "replicate 2 1 1",
    "run_style respa 2 2", "comm_style tiled", "balance 1 rcb", "{walls}", "{style}", "{shapes}",
    "pair_style potential/particle patch 1e-3", "fix d all dt/reset 1 1e-6 1e-4 0.01", "atom_modify sort 0 0",
    "set group all type 1", "run 0"
]
# Those after which LAMMPS itself bears `pre no`.
PLAIN = r"((set|timestep|displace_atoms|change_box|pair_coeff|velocity|reset_timestep|run) .*\n?)*"
WALLS = [
    "fix floor all wall/potential/particle 1e5 6e4 0.4 0.3 plane 0 0 0 0 0 1 linear 0.1 0 0",
    "fix floor all wall/potential/particle 1e5 6e4 0.4 0.3 stl floor.stl scale 1",
    "fix floor all wall/potential/particle 1e5 6e4 0.4 0.3 stl text.stl flat 1e-3 rotate 0 0 0 0 0 1 2.5",
    "fix floor all wall/potential/particle 1e9 6e8 0.4 0.3 plane 0 0 0 0 0 1 patch 1e-3 "
    "cohesion 1e3 residual 0.1 10 whole 5"
]
STYLES = [("pair_style potential/particle carry 1e-9 flat 1e-3 closest threads 2 failures count",
           "pair_coeff * * 1e5 6e4 0.4 0.3"),
          ("pair_style potential/particle patch 1e-3 whole 10 bonds yes",
           "pair_coeff * * 1e9 6e8 0.4 0.3 cohesion 1e4 tension 1e4 residual 0.3 1e2 softening 1e-3")]
TRIANGLES = np.array([[(-1, -1, 0), (1, -1, 0), (1, 1, 0)], [(-1, -1, 0), (-1, 1, 0), (1, 1, 0)]], float)


def mesh(triangles, text=False):
    if text:
        return "".join(["solid t\n"] + [
            "facet normal 0 0 0\nouter loop\n" + "".join("vertex %.9g %.9g %.9g\n" % tuple(v)
                                                         for v in t) + "endloop\nendfacet\n" for t in triangles
        ] + ["endsolid\n"]).encode()
    return b"binary".ljust(80) + struct.pack("<I", len(triangles)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *t.ravel(), 0) for t in triangles)


def other_triangles(draw):
    """One point, a line, slivers, triangles far away, and some that share nothing."""
    triangles = TRIANGLES.copy()
    kind = draw.randrange(6)
    if kind == 0:
        triangles[:] = triangles[0, 0]
    elif kind == 1:
        triangles[1, 1] = 0.5 * (triangles[1, 0] + triangles[1, 2])
    elif kind == 2:
        triangles[1, 1] = triangles[1, 0] + draw.choice([1e-30, 1e-9, 1e-5]) * np.array([0, 1, 0])
    elif kind == 3:
        triangles *= draw.choice([1e30, 1e-30, 3e38, 1e-45])
    elif kind == 4:
        triangles = np.concatenate([triangles, triangles])
    else:
        triangles[0, 0, 0] = draw.choice([np.nan, np.inf, 1e38])
    return triangles


def damaged(draw, path):
    """A file as it must not be."""
    kind, bytes_ = draw.choice(FILES), path.read_bytes()
    path.unlink()
    if kind == "a folder":
        path.mkdir()
    elif kind == "device":
        path.symlink_to("/dev/zero")
    elif kind != "missing":
        at = draw.randrange(len(bytes_))
        path.write_bytes({
            "empty": b"", "truncated": bytes_[:at],
            "damaged": bytes_[:at] + bytes([draw.randrange(256) for _ in range(8)]) + bytes_[at + 8:],
            "twice": 2 * bytes_, "no end": bytes_.replace(b"end", b""), "nan": re.sub(
                rb"[-\d.]+\d\n", b"nan\n", bytes_, count=1), "large": bytes_.replace(b"1.0", b"1e300")
        }[kind])
    return kind


def changed_words(draw, command):
    words = command.split()
    for _ in range(draw.choice([1, 1, 2])):
        at = draw.randrange(1, len(words)) if len(words) > 1 else 0
        kind = draw.randrange(6)
        if kind < 3:
            numbers = [n for n, word in enumerate(words) if re.fullmatch(r"[-+.\deE]*\d", word)]
            words[draw.choice(numbers) if numbers else at] = draw.choice(NUMBERS)
        elif kind == 3:
            other = draw.randrange(len(words))
            words[at], words[other] = words[other], words[at]
        elif kind == 4:
            del words[at:at + draw.choice([1, 1, 2, 9])]
        else:
            words[at:at] = words[at:at + draw.choice([1, 3])]
    return " ".join(words)


def case(draw, folder):
    """A script in a folder with its files, and on how many ranks it runs."""
    bodies = [(b[0], (*np.asarray(b[1])[:2], b[1][2]), *b[2:])
              for b in random_bodies(6, 0.1, seed=draw.randrange(1000), low=(-0.1, -0.1, 0.06), across=2)]
    write(folder, bodies, DEFAULTS["box"], rounded=False)
    (folder / "floor.stl").write_bytes(mesh(TRIANGLES if draw.random() < 0.6 else other_triangles(draw)))
    (folder / "text.stl").write_bytes(mesh(TRIANGLES if draw.random() < 0.6 else other_triangles(draw), text=True))
    parts = dict(DEFAULTS, walls=draw.choice(WALLS), timestep="timestep 1e-5", neighbor="neighbor 0.02 bin")
    parts["style"], parts["coefficients"] = draw.choice(STYLES)
    between = "\n".join(draw.sample(BETWEEN, draw.randrange(3))).format(**parts)
    change = draw.randrange(4)
    if change < 2:
        of = draw.choice(["shapes", "style", "coefficients", "walls", "walls", "timestep"])  # others are LAMMPS's own
        parts[of] = changed_words(draw, parts[of])
    elif change == 2:
        damaged(draw, folder / draw.choice(["shapes.txt", "floor.stl", "text.stl"]))
    parts["run"] = (
        f"run 20\nundump all\n{between}\nrun 20{' pre no' if draw.random() < 0.5 and re.fullmatch(PLAIN, between) else ''}"
    )
    lines = SCRIPT.format(**parts).splitlines()
    if change == 3 and draw.random(
    ) < 0.3:  # not what comes after: LAMMPS's thermo_style reads a compute that is not there
        start = draw.randrange(6, lines.index("compute pp all pair potential/particle"))
        lines[start], lines[start - 4] = lines[start - 4], lines[start]
    return "\n".join(lines) + "\nthermo_style custom step ke pe fmax\nrun 0\n", draw.choice([1, 1, 1, 2])


def judged(status, said, ranks):
    """What is wrong with how LAMMPS ended, or nothing."""
    words = " ".join(said.split())
    if status is None:
        return f"it did not end in {CASE_SECONDS} s"
    if re.search(
            r"std::|terminate called|basic_string|bad_alloc|_M_|[Ss]egmentation|Assertion|panicked|signal \d|SIGSEGV",
            words):
        return "words of the compiler's library or a signal"
    # An error of one rank ends all by MPI_Abort, which may come before its words have.
    if status and "ERROR" not in words and not (ranks > 1 and status == 1):
        return f"it ended with {status} and without an ERROR"
    if status:
        return None
    last = [line.split() for line in said.splitlines() if re.match(r"\s*\d+\s+[-+\d.naif]+", line)]
    if last and not all(
            np.isfinite(float(x)) for x in last[-1] if re.fullmatch(r"[-+]?(nan|inf|[\d.]+(e[-+]?\d+)?)", x)):
        return f"numbers that are not finite: {' '.join(last[-1])}"
    return None


def tried(seed, number, folder):
    """What is wrong with case `number` of a seed, or nothing."""
    script, ranks = case(random.Random(f"{seed}-{number}"), folder)
    wrong = judged(*lammps(folder, script, ranks, seconds=CASE_SECONDS), ranks)
    return wrong and f"{wrong} ({ranks} ranks)"


if __name__ == "__main__":
    seconds, seed = float(sys.argv[1]) if sys.argv[1:] else 60.0, int(
        sys.argv[2]) if sys.argv[2:] else random.randrange(10**6)
    print(f"seed {seed}")
    until, number, failed = time.time() + seconds, 0, 0
    while time.time() < until:
        with tempfile.TemporaryDirectory(prefix="lammps-") as folder:
            folder = Path(folder)
            if wrong := tried(seed, number, folder):
                failed += 1
                kept = TOP / "out" / "fuzz" / f"lammps-{seed}-{number}"
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(folder, kept, symlinks=True)
                print(f"FAILED: {wrong}: {kept}", flush=True)
        number += 1
    print(f"{number - failed} passed, {failed} failed")
    sys.exit(failed > 0)
