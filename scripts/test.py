#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Runs the tests in stages, as many at once as there are processors. Called by make test, test-all and check.

    scripts/test.py [--plan test|all|check] [STAGE ...]

A line for each stage as it ends, with its checks and seconds; of one that fails what failed, and the file of its whole
output. The last line is "N passed, N failed". STAGE: only these, with what they need. VERBOSE=1: the whole output of
every stage. JOBS=N: so many stages at once. Ctrl-C ends everything that was started.
"""
import argparse
import ctypes
import dataclasses
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TOP / "tests"))

from checks import jobs

TARGET = Path(os.path.abspath(os.environ.get("CARGO_TARGET_DIR") or TOP / "target"))
LOGS = TARGET / "test-logs"
GUIDE = TARGET / "guide"
CORE = TARGET / "maturin" / "release" / "lib_core.so"
# A stage that takes longer hangs.
MINUTES = 30
# Of what one stage says of its failures.
LINES = 60
# Sums: of our scripts, in the output of ctest too, and of tests/conftest.py; of cargo; of pytest; of ctest.
OURS = re.compile(r"(?P<within>\d+: )?([\d,]+)(?P<checks> checks)? passed, ([\d,]+) failed")
CARGO = re.compile(r"test result: \w+\. (\d+) passed; (\d+) failed.*")
PYTEST = re.compile(r"(?:=+ )?(\d+ [a-z]+(?:, \d+ [a-z]+)*) in \d[\d.]*s\b.*")
CTEST = re.compile(r"\d+% tests passed, (\d+) tests failed out of (\d+)")
# Targets of benchmarks and studies; they tell of the machine, too, and fail nothing.
MISSED = re.compile(r"^.*\bMISSED\b.*$", re.MULTILINE)
# First lines of a failed check: our scripts, the C harness within ctest, cargo, pytest.
FAULT = re.compile(r"FAIL|ERROR|E   |error|thread '.*panicked|(\d+: )?\S+\.[ch]:\d+: |Traceback")
RUN_PYTEST = ("/usr/bin/python3", "-m", "pytest")
SPREAD = ("-n", "auto")
MAKE = ("make", "--no-print-directory", "--silent")
CARGO_TEST = ("cargo", "test", "--release", "--no-fail-fast", "--quiet")


@dataclasses.dataclass
class Stage:
    """commands: run in turn. needs: stages that must have passed, if they are part of the run; after: that must have
    ended. suite: counts its own checks, of which there must be some; else the stage is one check. plans: of which runs
    it is a part.
    """

    name: str
    title: str
    commands: list
    needs: tuple = ()
    after: tuple = ()
    suite: bool = True
    plans: tuple = ("test", "all")


def check(name, title, *commands, **more):
    return Stage(name, title, list(commands), suite=False, **more)


def suite(name, title, *commands, **more):
    return Stage(name, title, list(commands), **more)


def glue(profile):
    """How the plugin is built. (make glue would ask cargo for the library, and wait while cargo builds tests.)"""
    return (("cmake", "-S", "yade-glue", "-B", "yade-glue/build",
             f"-DPP_LIBRARY={TARGET / profile / 'libpotential_particles.so'}",
             f"-DPP_CORE={TARGET / 'maturin' / profile / 'lib_core.so'}",
             f"-DPP_WERROR={os.environ.get('WERROR') or 0}"), ("cmake", "--build", "yade-glue/build", "--parallel",
                                                               str(jobs())))


def ctest(profile, *more):
    """The C harness, which says how many checks each part has made."""
    build = str(TARGET / "c" / profile)
    return (("cmake", "-S", "tests/c", "-B", build, f"-DPP_LIBRARY={TARGET / profile / 'libpotential_particles.so'}",
             f"-DPP_WERROR={os.environ.get('WERROR') or 0}"), ("cmake", "--build", build, "--parallel", str(jobs())),
            ("ctest", "--test-dir", build, "--parallel", str(jobs()), "--no-tests=error", "--verbose", *more))


def ctest_long(labels):
    return ("ctest", "--test-dir", str(TARGET / "c" / "release"), "--no-tests=error", "--output-on-failure", "-C", "long", "-L", labels)


# In the order in which they start, the longest first; what others need stands at the top.
STAGES = [
    check("lint", "Formatting and warnings of Rust", (*MAKE, "lint"),
          plans=("test", "all") if os.environ.get("WERROR") == "1" else ()),
    check("library", "Library, release build", ("scripts/library.sh", )),
    check("core", "Module of Python, release build", ("scripts/core.sh", )),
    suite("rust", "Rust tests, with the C header", (*CARGO_TEST, "--lib", "--tests"), (*CARGO_TEST, "--doc"),
          needs=("library", )),
    check("yade-build", "YADE plugin, compared with this YADE", *glue("release"),
          needs=("library", "core")),
    suite("yade", "YADE scenes", (*RUN_PYTEST, *SPREAD, "tests/yade"), needs=("yade-build", )),
    check("lammps-build", "LAMMPS and its plugin", ("scripts/lammps_setup.sh", ), needs=("library", "core")),
    suite("examples", "Examples and studies, short", (*RUN_PYTEST, *SPREAD, "tests/examples"), needs=("yade-build", )),
    suite("lammps", "LAMMPS scenes", (*RUN_PYTEST, *SPREAD, "tests/lammps"), needs=("lammps-build", ), after=("yade-build", )),
    suite("ranks", "YADE on 1, 2 and 3 ranks", (*RUN_PYTEST, "tests/mpi"), needs=("yade-build", )),
    suite("wheel", "Wheel for Python, in an environment of its own",
          ("env", "QUICK=1", f"OUTPUT={TARGET / 'wheel'}", "scripts/wheel.sh"), needs=("yade-build", ),
          after=("rust", )),
    suite("blocks", "Code blocks of the guide", (*RUN_PYTEST, "tests/guide"), needs=("yade-build", )),
    check("install", "Library installed, moved, linked and removed", ("env", "PROFILE=dev", f"CORE={CORE}", "scripts/try_install.sh"),
          needs=("core", ),
          after=("library", )),
    suite("c", "C harness and examples, header as C++", *ctest("release"),
          needs=("library", )),
    suite("guide", "Guide as a site, and its links", ("scripts/guide.sh", str(GUIDE)),
          ("tests/guide/links.py", str(GUIDE)), needs=("yade-build", )),
    suite("words", "Words, sentences and constants of the guide; versions; judges of make peers",
          ("tests/guide/words.py", ), ("tests/guide/sentences.py", ), ("tests/guide/constants.py", ),
          ("scripts/versions.py", ), (*RUN_PYTEST, "benches/peers")),
    # What takes long and says little to a user.
    # In a folder of its own: cargo gives the library of other features the same name.
    suite("features", "Rust tests without cone programs",
          ("cargo", "test", "--quiet", "--target-dir", str(
              TARGET / "features"), "--no-default-features", "--features", "capi", "--test", "cone_program_feature"),
          needs=("library", ), plans=("all", )),
    suite("rust-long", "Fuzz targets, ten times as long", ("env", "PP_LONG=1", *CARGO_TEST, "--test", "fuzz_replay"),
          needs=("rust", ), plans=("all", )),
    suite("yade-long", "YADE scenes that take long; all with 2 threads", (*RUN_PYTEST, *SPREAD, "tests/yade", "--long"),
          needs=("yade-build", ), plans=("all", )),
    suite("examples-long", "Examples and studies that take long", (*RUN_PYTEST, *SPREAD, "tests/examples", "--long"),
          needs=("yade-build", ), plans=("all", )),
    suite("kept", "YADE killed and loaded, shaken, started often", ("tests/yade/long/run.py", "--short"),
          needs=("yade-build", ), plans=("all", )),
    suite("lammps-long", "LAMMPS scenes that take long", (*RUN_PYTEST, *SPREAD, "tests/lammps", "--long"), needs=("lammps-build", ), after=("yade-build", ),
          plans=("all", )),
    suite("ranks-long", "YADE on ranks, long", (*RUN_PYTEST, "tests/mpi", "--long"), needs=("yade-build", ), plans=("all", )),
    # Each target that measures, a little of it (side-by-side and classics are among the examples). One that panics or
    # raises fails; what misses its target is printed. Those of make peers only where its contestants are there.
    check("measured", "What make bench, patch, equilibrium and stress measure, a little of each",
          *((*MAKE, target, "QUICK=1") for target in ("bench", "patch", "equilibrium")),
          (*MAKE, "stress", "POSES=10000"), needs=("library", ), after=("rust", "rust-long"), plans=("all", )),
    check("measured-yade", "What is measured in YADE, a little of each",
          *((*MAKE, target, "QUICK=1") for target in ("rock", "scenes", "scale")),
          (*MAKE, "patch-yade", "CASES=face"), ("env", "SCENES=rods", *MAKE, "time-step"),
          *([(*MAKE, "peers", "QUICK=1")] if (TOP / "out" / "peers" / "bin").is_dir() else []), needs=("yade-build", ),
          after=("yade", "examples"), plans=("all", )),
    check("asan", "C harness under AddressSanitizer and UBSan", ctest_long("asan"), needs=("c", ),
          plans=("all", )),
    check("valgrind", "C harness under valgrind", ctest_long("valgrind"), needs=("c", ), plans=("all", )),
    check("tsan", "Threads under ThreadSanitizer and helgrind", ctest_long("tsan|helgrind"),
          needs=("c", ), plans=("all", )),
]

# Before a commit, by the build that is the fastest after a change; what is not installed is left out.
CHECK = [
    check("format", "Formatting of Rust", ("cargo", "fmt", "--all", "--check")),
    suite("constants", "Words of the guide, constants of the theory, versions", ("tests/guide/words.py", ),
          ("tests/guide/constants.py", ), ("scripts/versions.py", )),
    check("library", "Library, quick build",
          ("cargo", "build", "--profile", "quick", "--lib", "--example", "solve_pairs", "--quiet")),
    suite("rust", "Rust tests, with the C header", ("cargo", "test", "--profile", "quick", "--no-fail-fast", "--lib",
                                                    "--tests", "--", "--skip", "stress::", "--skip", "fuzz_replay::"),
          needs=("library", )),
    suite("c", "C harness", *ctest("quick", "-LE", "example"), needs=("library", )),
    check("core", "Module of Python, quick build", ("env", "PROFILE=quick", "scripts/core.sh")),
    check("yade-build", "YADE plugin, compared with this YADE", *glue("quick"),
          needs=("library", "core")),
    suite("yade", "YADE: particles with particles, spheres, boxes, walls and facets", (*RUN_PYTEST, "tests/yade/test_mixed.py"),
          needs=("yade-build", )),
]


def counted(text):
    """(passed, failed) of an output: the checks that are told, and tests of pytest and ctest that tell of none."""
    sums, told = [], False
    for line in text.splitlines():
        if found := OURS.fullmatch(line):
            sums.append([int(found[i].replace(",", "")) for i in (2, 4)])
            told = told or bool(found["within"] or found["checks"])
        elif found := CARGO.fullmatch(line):
            sums.append([int(found[1]), int(found[2])])
        elif found := PYTEST.fullmatch(line) or CTEST.fullmatch(line):
            if not told and found.re is PYTEST:
                of = {word.rstrip("s"): int(number) for number, word in map(str.split, found[1].split(", "))}
                sums.append([of.get("passed", 0), of.get("failed", 0) + of.get("error", 0)])
            elif not told:
                sums.append([int(found[2]) - int(found[1]), int(found[1])])
            told = False
    return [sum(one[i] for one in sums) for i in (0, 1)]


class Run:
    """A stage as it is run: its log, process and outcome."""

    def __init__(self, stage):
        self.stage, self.log = stage, LOGS / f"{stage.name}.log"
        self.state, self.seconds = "waiting", 0.0
        self.passed = self.failed = 0
        self.commands, self.status, self.process = iter(stage.commands), 0, None

    def start(self):
        self.state, self.begin = "running", time.monotonic()
        self.output = open(self.log, "wb")
        self._next()

    def _next(self):
        command = next(self.commands, None)
        if command is None or self.status:
            return self._end()
        # In a session of its own: Ctrl-C is for this script, which then ends what it started. Not the job server of the
        # make above.
        environment = {
            key: value
            for key, value in os.environ.items() if key not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")
        }
        self.process = subprocess.Popen(command, cwd=TOP, env={**environment, "CARGO_TARGET_DIR": str(TARGET)},
                                        start_new_session=True, stdin=subprocess.DEVNULL, stdout=self.output,
                                        stderr=subprocess.STDOUT)

    def look(self):
        """Goes on with what has ended; whether the stage is over."""
        if self.process.poll() is not None:
            self.status = self.process.returncode
            self._next()
        elif time.monotonic() - self.begin > 60 * MINUTES:
            self.output.write(f"\nFAILED: still running after {MINUTES} minutes\n".encode())
            end_all(self.process.pid)
            self.status = self.process.wait()
            self._end()
        return self.state != "running"

    def _end(self):
        self.output.close()
        self.seconds = time.monotonic() - self.begin
        if self.stage.suite:
            self.passed, self.failed = counted(self.text())
            if self.passed + self.failed == 0 or (self.status and not self.failed):
                self.failed += 1
        else:
            self.passed, self.failed = (0, 1) if self.status else (1, 0)
        self.state = "failed" if self.failed else "passed"

    def text(self):
        return self.log.read_text(errors="replace")

    def faults(self):
        """What says why it failed: each fault with the lines that belong to it, or else the end of its output."""
        lines, kept = self.text().splitlines(), []
        starts = [number for number, line in enumerate(lines) if FAULT.match(line.lstrip())]
        for start, following in zip(starts, [*starts[1:], len(lines)]):
            if lines[start].startswith("Traceback"):
                # Its end names the error: the first line that is not indented.
                end = next((number for number in range(start + 1, len(lines)) if not lines[number].startswith(" ")),
                           len(lines) - 1)
                start = max(start, end - 5)
            kept += [
                line[:400] for line in lines[start:min(following, start + 10)]
                if line.strip() and not re.match(r"ok |test .* ok$", line)
            ]
        kept = kept or lines[-10:]
        more = [f"... {len(kept) - LINES} lines more"] if len(kept) > LINES else []
        return [*kept[:LINES], *more, f"exit status {self.status}; the whole output: {os.path.relpath(self.log)}"]


def descendants(of):
    """The processes below one, by /proc; those whose parent has ended belong to this script, see main."""
    children = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                children.setdefault(int((entry / "stat").read_text().rpartition(")")[2].split()[1]),
                                    []).append(int(entry.name))
            except (OSError, IndexError):
                continue
    found, new = [], [of]
    while new:
        new = [child for one in new for child in children.get(one, [])]
        found += new
    return found


def end_all(of):
    """Ends a process with all that it started, those in sessions of their own too; of this script, what it started."""
    for how in (signal.SIGTERM, signal.SIGKILL):
        for process in [*descendants(of), *([of] if of != os.getpid() else [])]:
            try:
                os.kill(process, how)
            except ProcessLookupError:
                pass
        time.sleep(0.5)


class Board:
    """What a reader sees: a line for each stage that has ended, and on a terminal one of what runs."""

    def __init__(self, runs):
        self.runs, self.width, self.live = runs, max(len(run.stage.title) for run in runs), sys.stdout.isatty()

    def now(self):
        running = [
            f"{run.stage.name} {time.monotonic() - run.begin:.0f} s" for run in self.runs if run.state == "running"
        ]
        over = sum(run.state not in ("waiting", "running") for run in self.runs)
        return f"{over} of {len(self.runs)}" + (f"; now {', '.join(running)}" if running else "")

    def show(self):
        if self.live:
            columns = shutil.get_terminal_size().columns
            print(f"\r\x1b[K  {self.now()}"[: columns + 3], end="", flush=True)

    def ended(self, run):
        word, counts = {
            "passed": ("ok  ", ""), "failed": ("FAIL", ""), "left out": ("--  ", "not run: what it needs failed")
        }[run.state]
        counts = counts or f"{run.passed:7,} passed {run.failed:3,} failed {run.seconds:5.0f} s"
        print(
            "\r\x1b[K" * self.live + f"{word} {run.stage.title:{self.width}} {counts}" +
            ("" if self.live else f"   ({self.now()})"), flush=True)
        if run.state == "left out":
            return
        if os.environ.get("VERBOSE") == "1":
            return print(run.text(), flush=True)
        lines = [line.strip() for line in MISSED.findall(run.text())]
        lines += run.faults() if run.state == "failed" else []
        print("".join(f"     {line}\n" for line in lines), end="", flush=True)


def chosen(plan, names):
    """The stages of a run, in their order."""
    stages = CHECK if plan == "check" else [stage for stage in STAGES if plan in stage.plans]
    if plan == "check":
        lacking = {
            name
            for name, program in (("format", "cargo-fmt"), ("core", "yade"), ("yade", "yade"), ("yade-build", "yade"))
            if not shutil.which(program)
        }
        if "yade" in lacking:
            print("YADE is not installed: its plugin is not tried (make setup installs it)")
        stages = [stage for stage in stages if stage.name not in lacking]
    if names:
        known = {stage.name: stage for stage in (CHECK if plan == "check" else STAGES)}
        if unknown := [name for name in names if name not in known]:
            sys.exit(f"STAGE={','.join(unknown)}: there is no such stage; there are {', '.join(known)}.")
        wanted = set()
        new = list(names)
        while new:
            wanted.update(new)
            new = [need for name in new for need in known[name].needs if need not in wanted]
        stages = [stage for stage in known.values() if stage.name in wanted]
    return stages


def ready(run, runs):
    """Whether all that a stage needs has passed; None if something of it never will."""
    needed = [other for other in runs if other.stage.name in run.stage.needs]
    if any(other.state in ("failed", "left out") for other in needed):
        return None
    before = [other for other in runs if other.stage.name in run.stage.after]
    return all(other.state == "passed" for other in needed) and all(other.state not in ("waiting", "running")
                                                                    for other in before)


def go(runs, board):
    while any(run.state in ("waiting", "running") for run in runs):
        for run in runs:
            if run.state == "running" and run.look():
                board.ended(run)
            elif run.state == "waiting" and ready(run, runs) is None:
                run.state = "left out"
                board.ended(run)
            elif run.state == "waiting" and sum(other.state == "running"
                                                for other in runs) < jobs() and ready(run, runs):
                run.start()
        board.show()
        time.sleep(0.1)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--plan", choices=("test", "all", "check"), default="test",
                           help="all: those that take long, too; check: a minute's worth")
    arguments.add_argument("stages", nargs="*", metavar="STAGE", help="only these, with what they need")
    options = arguments.parse_args()
    runs = [Run(stage) for stage in chosen(options.plan, options.stages)]
    LOGS.mkdir(parents=True, exist_ok=True)
    # What outlives its parent becomes a child of this script, so that end_all finds it.
    ctypes.CDLL(None).prctl(36, 1, 0, 0, 0)  # PR_SET_CHILD_SUBREAPER
    for name in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(name, lambda *_: (_ for _ in ()).throw(KeyboardInterrupt()))
    begin, board = time.monotonic(), Board(runs)
    try:
        go(runs, board)
    except KeyboardInterrupt:
        end_all(os.getpid())
        print("\ninterrupted: all that was started has been ended", flush=True)
        sys.exit(130)
    passed, failed = sum(run.passed for run in runs), sum(run.failed for run in runs)
    print("\r\x1b[K" * board.live
          + f"\n{jobs()} at once, {time.monotonic() - begin:.0f} s\n{passed} passed, {failed} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
