# SPDX-License-Identifier: GPL-3.0-or-later
# The table of tested builds: what an import says of the YADE that runs, and what README says of all of them.
import os
import re
import subprocess
import sys

import potential_particles
import yade
import yade.config
from potential_particles import builds
from harness import *

check = Checks()
HERE = os.path.dirname(os.path.abspath(sys.modules["harness"].__file__))
TOP = os.path.join(HERE, os.pardir, os.pardir)
table = builds.tested_builds()
check.true(len(table) >= 3, f"tested builds: {table}")
for build in table:
    check.true(re.fullmatch(r"\d{4}-\d\d-\d\d", build.tested), f"a date: {build}")
check.equal(table, builds.tested_builds(os.path.join(TOP, "yade-glue", "tested_builds.txt")),
            "the package has the table as it is")

# README has the same rows.
rows = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in open(os.path.join(TOP, "README.md"))
        if re.match(r"\|[^|]*\| *20\d\d\.[0-9a-z.]+ *\|", line)]
check.equal(rows, [[f"{b.debian} ({b.suite})", b.yade, b.python, b.boost, b.compiler, b.tested] for b in table],
            "README's table of tested platforms")

# Nothing else names an interpreter or a Boost by its version: what is installed is found.
named = []
NAMED = re.compile(r"python3\.\d|python3\d\d|boost1\.\d")
for folder in ("scripts", "tests", "examples", "studies", "tools", "benches", "yade-glue"):
    for place, folders, names in os.walk(os.path.join(TOP, folder)):
        folders[:] = [name for name in folders if name not in ("build", "__pycache__")]
        for name in sorted(names):
            if name.endswith((".py", ".sh", ".txt", ".cmake", ".hpp", ".cpp", ".md")) and name != "test_builds.py":
                named += [(name, found) for found in NAMED.findall(open(os.path.join(place, name)).read())]
check.equal(named, [], "files that name a version of Python or Boost")

# What is said of which YADE.
version, python = yade.config.version, builds.python_version()
check.equal(potential_particles._glue.built_for_yade, version, "built for the YADE that runs")
here = builds.Build(version, "-", "-", python, "-", "-", "-")
check.equal(builds.remark(version, version, [here]), None, "nothing of a tested one")
for name, tested in (("version", here._replace(yade="1999.1")), ("Python", here._replace(python="2.7"))):
    said = builds.remark(version, version, [tested])
    check.true(said and version in said and "not among" in said, f"another {name}: {said}")
said = builds.remark("2099.1.0", version, [here])
check.true(said and "2099.1.0" in said and version in said and "make build" in said, f"built for another: {said}")


def said_at_import(pretended):
    """Lines about us that a process prints when it imports the package under a YADE that calls itself so."""
    program = ("import sys; sys.path.insert(0, %r); import yade, yade.config; yade.config.version = %r; "
               "import potential_particles; print(ConicPotentialParticle(k=1.0, R=2.0).boundingRadius)")
    done = subprocess.run(
        [sys.executable, "-c", program % (os.path.dirname(os.path.dirname(yade.__file__)), pretended)],
        capture_output=True, text=True, env=dict(os.environ, PYTHONPATH=os.environ["PP_PACKAGE"]))
    check.equal(done.returncode, 0, f"YADE {pretended}: it loads and works\n{done.stderr[-1000:]}")
    return [line for line in done.stderr.splitlines() if "potential_particles" in line or "Untested" in line]


known = any((build.yade, build.python) == (version, python) for build in table)
check.equal(len(said_at_import(version)), 0 if known else 1, f"lines for YADE {version}, Python {python}")
lines = said_at_import("2099.1.0")
check.true(
    len(lines) == 1 and "2099.1.0" in lines[0], f"one line for a YADE that agrees and is not in the table: {lines}")

check.finish()
