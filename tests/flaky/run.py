#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Runs suites again and again, each round in the next of the surroundings below: what fails on some machines only?

    tests/flaky/run.py [--rounds N] [--seed S] [--only WORDS ...] [SUITE ...]        (make test-flaky)

--only: those surroundings whose names hold one of these words.
SUITE: names of stages of scripts/test.py, by default yade, lammps and ranks; what they need is built first. Results,
kept after Ctrl-C: out/flaky/summary.json, a row for each run with its surroundings, and the whole output of each that
failed.
"""
import argparse
import dataclasses
import fcntl
import os
import random
import shutil
import subprocess
import sys
import time
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(TOP / "tests"), str(TOP / "scripts"), str(TOP / "studies")]

import test as stages
from checks import jobs
from summary import write_summary

OUT = TOP / "out" / "flaky"
# A second clone, at a path that is hard to quote.
CLONE = OUT / "zweite Kopie für Tests"
LOCALE = "de_DE.UTF-8"


@dataclasses.dataclass
class Surroundings:
    name: str
    environment: dict = dataclasses.field(default_factory=dict)  # None: unset
    before: tuple = ()  # words before the command
    umask: int = -1
    clone: bool = False  # runs in CLONE
    beside: bool = False  # runs in CLONE and here, at the same time


def surroundings():
    """In the order of rounds; those that this machine cannot give are left out, and named."""
    known = [Surroundings(f"MALLOC_PERTURB_={value}", {"MALLOC_PERTURB_": str(value)}) for value in (1, 85, 170, 254)]
    known += [
        Surroundings("one processor", before=("taskset", "-c", "0")),
        Surroundings("16 processes at once", {"JOBS": "16"}),
        Surroundings(f"locale {LOCALE}", {name: LOCALE for name in ("LANG", "LC_ALL", "LC_NUMERIC")}),
        # Without HOME YADE itself does not start.
        Surroundings("no DISPLAY", {"DISPLAY": None}),
        Surroundings("umask 077", umask=0o077),
        Surroundings("another clone, its path with a space and an umlaut", clone=True),
        Surroundings("two clones at once", beside=True),
    ]
    if os.geteuid() == 0 and shutil.which("runuser"):
        known.append(Surroundings("another user", {"HOME": "/nonexistent"}, ("runuser", "-u", "nobody", "--")))
    else:
        print("left out: another user (it takes root)")
    return known


def prepare():
    """The locale, and the clone with what its suites need."""
    if LOCALE.lower().replace("-", "") not in subprocess.run(["locale", "-a"], text=True,
                                                             stdout=subprocess.PIPE).stdout.lower():
        if not shutil.which("localedef") or not Path("/usr/share/i18n/locales/de_DE").exists():
            subprocess.run(["apt-get", "-qq", "install", "--yes", "locales"], check=False, stdout=subprocess.DEVNULL)
        if subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", LOCALE], check=False,
                          stdout=subprocess.DEVNULL).returncode:
            print(f"the locale {LOCALE} cannot be made here: its rounds run without it")
    # What was built in it before stays.
    if not (CLONE / ".git").exists():
        shutil.rmtree(CLONE, ignore_errors=True)
        CLONE.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["git", "clone", "--quiet", str(TOP), str(CLONE)], check=True)
    subprocess.run(["git", "-C", str(CLONE), "fetch", "--quiet", "origin", "HEAD"], check=True)
    subprocess.run(["git", "-C", str(CLONE), "reset", "--quiet", "--hard", "FETCH_HEAD"], check=True)


def build(names):
    """What the suites need, here and in the clone; False if a build failed."""
    needs = sorted({need for stage in stages.STAGES if stage.name in names for need in stage.needs})
    inherited = ("CARGO_TARGET_DIR", "MAKEFLAGS", "MFLAGS", "MAKELEVEL")
    environment = {key: value for key, value in os.environ.items() if key not in inherited}
    return all(
        subprocess.run([str(top / "scripts" / "test.py"), *needs], env=environment).returncode == 0
        for top in (TOP, CLONE))


def start(command, top, around, shuffle, log):
    environment = {
        key: value
        for key, value in {**os.environ, "SHUFFLE": str(shuffle), **around.environment}.items() if value is not None
    }
    environment.pop("CARGO_TARGET_DIR", None)
    return subprocess.Popen([*around.before, *command], cwd=top, env=environment, umask=around.umask,
                            stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)


def run(stage, around, shuffle):
    """(passed, failed, seconds, output) of a suite in its surroundings."""
    begin, passed, failed, said = time.monotonic(), 0, 0, ""
    tops = [CLONE] if around.clone else [CLONE, TOP] if around.beside else [TOP]
    for command in stage.commands:
        logs = [OUT / f"running-{number}.log" for number in range(len(tops))]
        files = [open(log, "w+", errors="replace") for log in logs]
        processes = [start(command, top, around, shuffle, file) for top, file in zip(tops, files)]
        for process, file, log in zip(processes, files, logs):
            status = process.wait()
            file.close()
            text = log.read_text(errors="replace")
            good, bad = stages.counted(text)
            passed, failed = passed + good, failed + (bad or int(status != 0 or not good))
            said += text
            log.unlink()
    return passed, failed, time.monotonic() - begin, said


def write(rows, names, seed):
    targets = []
    for name in names:
        of_suite = [row for row in rows if row["suite"] == name]
        failures = sum(row["failed"] > 0 for row in of_suite)
        targets.append({
            "name": f"{name}: runs that failed, of {len(of_suite)}", "sense": "<=", "target": 0, "measured": failures,
            "met": failures == 0
        })
    write_summary(OUT / "summary.json", {"seed": seed, "targets": targets, "runs": rows})
    return targets


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--rounds", type=int, default=20)
    arguments.add_argument("--seed", type=int, default=random.randrange(2**31),
                           help="of the order of scripts; drawn if it is not given")
    arguments.add_argument("--only", action="append", default=[], metavar="WORDS",
                           help="surroundings whose names hold these words")
    arguments.add_argument("suites", nargs="*", default=["yade", "lammps", "ranks"], metavar="SUITE")
    options = arguments.parse_args()
    known = {stage.name: stage for stage in stages.STAGES if stage.suite}
    if unknown := [name for name in options.suites if name not in known]:
        sys.exit(f"{', '.join(unknown)}: there is no such suite; there are {', '.join(known)}.")
    around = surroundings()
    if options.only:
        names = [one.name for one in around]
        around = [one for one in around if any(words in one.name for words in options.only)]
        if not around:
            sys.exit(f"--only {', '.join(options.only)}: there are {'; '.join(names)}.")
    OUT.mkdir(parents=True, exist_ok=True)
    lock = open(OUT / "lock", "w")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        sys.exit(f"another run works in {OUT}: wait for it")
    prepare()
    if not build(options.suites):
        sys.exit("what the suites need cannot be built: what failed stands above.")
    print(f"{options.rounds} rounds of {', '.join(options.suites)}; {jobs()} processes at once; seed {options.seed}",
          flush=True)
    rows = []
    try:
        for number in range(options.rounds):
            for name in options.suites:
                here = around[number % len(around)]
                passed, failed, seconds, said = run(known[name], here, options.seed + number)
                rows.append({
                    "round": number + 1, "suite": name, "surroundings": here.name, "passed": passed, "failed": failed,
                    "seconds": round(seconds, 1)
                })
                print(
                    f"{'FAIL' if failed else 'ok  '} {number + 1:3} {name:8} {passed:6} passed {failed:3} failed {seconds:6.1f} s   {here.name}",
                    flush=True)
                if failed:
                    (OUT / f"failed-{number + 1}-{name}.log").write_text(said)
                write(rows, options.suites, options.seed)
    except KeyboardInterrupt:
        print("interrupted: what was run stands in out/flaky/summary.json")
    targets = write(rows, options.suites, options.seed)
    for one in targets:
        print(f"{one['name']}: {one['measured']}")
    print(f"{sum(row['failed'] == 0 for row in rows)} passed, {sum(row['failed'] > 0 for row in rows)} failed")
    sys.exit(any(not one["met"] for one in targets))


if __name__ == "__main__":
    main()
