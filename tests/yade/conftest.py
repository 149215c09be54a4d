# SPDX-License-Identifier: GPL-3.0-or-later
"""The test_*.py of this folder are scripts that YADE runs, each in a process and a folder of its own.

Of its first lines, "# threads" says that a script is about threads: it runs with two, the others with one. "# long"
says that it takes long: --long runs those, and all with the other number of threads. Each prints 'N passed, N failed'
alone on its last line, and a line FAILED for each check that failed.
"""
import os
import re
import subprocess
import tempfile
from pathlib import Path

import pytest

from checks import Checks, short

# What takes longer hangs: on one busy processor each takes below a minute.
SECONDS = 600
SUMMARY = re.compile(r"(\d+) passed, (\d+) failed")


class Failed(Exception):
    pass


def pytest_pycollect_makemodule(module_path, parent):
    return Script.from_parent(parent, path=module_path)


def pytest_configure(config):
    if not Path(config.option.package, "potential_particles/_glue.so").exists():
        raise pytest.UsageError(f"no plugin in {config.option.package}: run make build")


class Script(pytest.File):
    def collect(self):
        marks = [mark for mark in ("threads", "long") if f"# {mark}" in self.path.read_text().splitlines()[:5]]
        usual = 2 if "threads" in marks else 1
        for threads in self.config.option.threads or ([1, 2] if self.config.option.long else [usual]):
            item = Scene.from_parent(self, name=f"j{threads}", threads=threads)
            for mark in marks if threads == usual else {*marks, "long"}:
                item.add_marker(mark)
            yield item


class Scene(pytest.Item):
    """A script with a number of threads."""

    def __init__(self, *, threads, **more):
        super().__init__(**more)
        self.threads = threads

    def runtest(self):
        self.check = Checks()
        package = Path(self.config.option.package).resolve()
        # Passive: threads of OpenMP that wait by spinning crawl when the machine is busy.
        environment = dict(os.environ, PYTHONPATH=os.pathsep.join([str(package), str(self.path.parent)]),
                           PP_PACKAGE=str(package), OMP_WAIT_POLICY="passive")
        with tempfile.TemporaryDirectory() as scratch, open(Path(scratch, "said"), "w+", errors="replace") as said:
            try:
                status = subprocess.run(["yade", "-x", "-n", f"-j{self.threads}", str(self.path)], env=environment,
                                        cwd=scratch, timeout=SECONDS, stdin=subprocess.DEVNULL, stdout=said,
                                        stderr=subprocess.STDOUT).returncode
            except subprocess.TimeoutExpired:
                status = None
            said.seek(0)
            self.judge(said.read(), status)

    def judge(self, text, status):
        """A script that died counts as one failure."""
        lines = text.splitlines()
        if self.config.option.verbose > 0:
            self.add_report_section("call", "stdout", text)
        self.user_properties.append(("skipped", [line for line in lines if line.startswith("skipped")]))
        found = next(filter(None, map(SUMMARY.fullmatch, reversed(lines))), None)
        ended = f"exit status {status}" if status is not None else f"still running after {SECONDS} s"
        faults = list(failed_checks(lines))
        if found and status is not None:
            self.check.passed, self.check.failed = map(int, found.groups())
            if (status == 0) == (self.check.failed == 0) and self.check.passed + self.check.failed > 0:
                ended = None
        if ended:
            self.check.failed += 1
            faults.append(f"FAILED: {ended}, {found[0] if found else 'no summary'}; its last words:\n    {short(text[-2000:], 8)}")
        if self.check.failed:
            raise Failed("\n".join(faults))

    def repr_failure(self, excinfo):
        return str(excinfo.value) if isinstance(excinfo.value, Failed) else super().repr_failure(excinfo)

    def reportinfo(self):
        return self.path, None, f"{self.path.stem} -j{self.threads}"


def failed_checks(lines):
    """Each with the lines that belong to it."""
    taken = False
    for line in lines:
        taken = line.startswith("FAILED") or taken and line.startswith("    ")
        if taken:
            yield line
