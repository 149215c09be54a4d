# SPDX-License-Identifier: GPL-3.0-or-later
"""Which builds of YADE were tested, and what is said of one that was not.

The table is yade-glue/tested_builds.txt, of which the build puts a copy beside this file. It refuses no YADE: the
comparisons with YADE's libraries and classes do that.
"""
import collections
import os
import sys
import warnings

TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "tested_builds.txt")

Build = collections.namedtuple("Build", "yade debian suite python boost compiler tested")


class UntestedYade(UserWarning):
    """The plugin fits this YADE as far as the comparisons go, but nobody has tested the two together."""


def tested_builds(table=TABLE):
    """The rows of the table."""
    with open(table) as lines:
        return [Build(*line.split()) for line in lines if line.strip() and not line.startswith("#")]


def python_version():
    return "%d.%d" % sys.version_info[:2]


def remark(running, built_for, tested):
    """What an import should say of a YADE that fits, or nothing."""
    name = "YADE %s with Python %s" % (running, python_version())
    if running != built_for:
        return ("the plugin was built for YADE %s and this is %s: it fits as far as can be seen from here; "
                "`make build` compares the two in full" % (built_for, name))
    if not any((build.yade, build.python) == (running, python_version()) for build in tested):
        return (
            "%s is not among the tested builds (%s); the plugin fits it as far as the comparisons at build and at import go"
            % (name, ", ".join("%s of Debian %s" % (build.yade, build.debian) for build in tested)))
    return None


def warn(running, built_for):
    """One line for a YADE that fits and was not tested; nothing for one that was."""
    text = remark(running, built_for, tested_builds())
    if text is not None:
        # Without a place in a source file: the line is about the machine, and stays one line.
        warnings.warn_explicit("potential_particles: " + text, UntestedYade, "potential_particles", 0)
