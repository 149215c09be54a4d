# SPDX-License-Identifier: GPL-2.0-or-later
"""The LAMMPS plugin against a loop in Python, closed forms, itself on several ranks, and bad input. Needs
scripts/lammps_setup.sh (make lammps), and cc for one test.
"""
import sys
from pathlib import Path

import pytest

BUILD = Path(__file__).resolve().parents[2] / "out/lammps/build"
sys.path.insert(0, str(BUILD / "python"))


def pytest_configure():
    if not (BUILD / "potential_particles_plugin.so").exists():
        raise pytest.UsageError(f"no plugin in {BUILD}: run make lammps")


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport():
    report = (yield).get_result()
    if report.failed:
        import scene
        report.sections.append(("Last words of LAMMPS", scene.last_words()))
