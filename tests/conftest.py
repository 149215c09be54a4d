# SPDX-License-Identifier: MIT OR Apache-2.0
"""What these tests want of pytest:

    pytest tests/yade -k primitives         pytest -n 2 tests/lammps         pytest --long tests/mpi

A fixture `check`, whose checks all count, those that fail too; `folder`, which is gone at the end; tests marked `long`,
left out unless --long asks for them, and for them alone, or they are named. SHUFFLE=SEED: in another order, which must
not matter. The report says how many checks there were.
"""
import os
import random
import tempfile
from pathlib import Path

import pytest

from checks import Checks, jobs


def pytest_addoption(parser):
    group = parser.getgroup("potential particles")
    group.addoption("--long", action="store_true", help="what is left out without it, and no more")
    group.addoption("--threads", type=int, action="append", default=[],
                    help="all scripts of YADE, with so many threads; may be given again")
    group.addoption("--package", default=str(Path(__file__).resolve().parents[1] / "yade-glue/build/python"),
                    help="folder of the package that YADE loads")


def pytest_collection_modifyitems(config, items):
    if seed := os.environ.get("SHUFFLE"):
        random.Random(seed).shuffle(items)
    option = config.option
    if not option.long and (option.threads or option.keyword or option.markexpr or any(".py" in word for word in config.args)):
        return
    left_out = [item for item in items if option.long != bool(item.get_closest_marker("long"))]
    if left_out:
        items[:] = [item for item in items if item not in left_out]
        config.hook.pytest_deselected(items=left_out)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers():
    """Of -n auto: JOBS of the environment goes before the number of processors."""
    return jobs()


@pytest.fixture
def folder():
    with tempfile.TemporaryDirectory() as name:
        yield Path(name)


@pytest.fixture
def check(request):
    request.node.check = Checks()
    return request.node.check


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item, call):
    report = (yield).get_result()
    check = getattr(item, "check", None)
    if report.when != "call" or check is None:
        return
    if report.passed and (check.failed or not check.passed):
        report.outcome, report.longrepr = "failed", f"{check.failed} of {check.passed + check.failed} checks failed"
    if report.failed and not check.failed:
        check.failed = 1
    report.user_properties.append(("checks", (check.passed, check.failed)))


def pytest_terminal_summary(terminalreporter):
    passed = failed = 0
    for outcome in ("passed", "failed", "error"):
        for report in terminalreporter.stats.get(outcome, []):
            found = dict(getattr(report, "user_properties", ()))
            good, bad = found.get("checks", (outcome == "passed", outcome != "passed"))
            passed, failed = passed + good, failed + bad
            for line in found.get("skipped", ()):
                terminalreporter.write_line(f"{report.nodeid}: {line}")
    if passed + failed:
        terminalreporter.write_line(f"{passed:,} checks passed, {failed:,} failed")
