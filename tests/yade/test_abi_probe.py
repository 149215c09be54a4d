# SPDX-License-Identifier: GPL-3.0-or-later
# long
# A YADE that does not fit is refused by the build, with the differences listed: every build compares the true
# declarations.
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

import potential_particles
import yade
from harness import *

check = Checks()
HERE = os.path.dirname(os.path.abspath(sys.modules["harness"].__file__))
SOURCE = os.path.join(HERE, os.pardir, os.pardir, "yade-glue", "abi")
LIBRARIES = os.path.dirname(os.path.dirname(os.path.dirname(yade.__file__)))

# The build-time check, with declarations that are wrong on purpose.
def build_check(edits, number=potential_particles._glue.built_for_yade_number):
    """Exit status and messages of check_abi.py for a copy of abi/ with edits {file: (old, new)}, as for that build of
    YADE.
    """
    with tempfile.TemporaryDirectory() as folder:
        abi = os.path.join(folder, "abi")
        shutil.copytree(SOURCE, abi)
        for name, (old, new) in edits.items():
            path = os.path.join(abi, name)
            text = open(path).read()
            check.true(old in text, f"{name} holds what the test changes")
            open(path, "w").write(text.replace(old, new, 1))
        # The assertions would stop the compiler first; here the comparison itself is on trial.
        path = os.path.join(abi, "base.hpp")
        text = open(path).read().replace("static_assert(condition, what)", "static_assert(true, what)")
        open(path, "w").write(text)
        probe = os.path.join(folder, "probe.so")
        compiled = subprocess.run([
            "g++", "-std=c++17", "-O0", "-fPIC", "-shared", "-w", "-DEIGEN_DONT_ALIGN", "-DEIGEN_DONT_VECTORIZE",
            "-DBOOST_BIND_GLOBAL_PLACEHOLDERS", "-DBOOST_ALLOW_DEPRECATED_HEADERS", "-I/usr/include/eigen3",
            f"-DPP_YADE_VERSION={number}", "-I" + sysconfig.get_paths()["include"],
            os.path.join(abi, "probe.cpp"), "-o", probe
        ], capture_output=True, text=True)
        if not check.equal(compiled.returncode, 0, f"probe compiled\n{compiled.stderr[-2000:]}"):
            return None, ""
        done = subprocess.run(
            [sys.executable,
             os.path.join(abi, "check_abi.py"), "--libraries", LIBRARIES, "--probe", probe], capture_output=True,
            text=True)
        return done.returncode, done.stdout + done.stderr


declared = sum(
    len(re.findall(r"^PP_ABI_SIZE\(", path.read_text(), re.MULTILINE)) for path in Path(SOURCE).glob("*.hpp"))
status, text = build_check({})
check.true(status == 0 and f"{declared} classes" in text, f"the true declarations: {status} {text}")
dict_, custom = ("    virtual boost::python::dict %s() const;\n" % name for name in ("pyDict", "pyDictCustom"))
status, text = build_check({
    "knksphys.hpp": ("    Real ks;\n", "    Real ks;\n    Real extra;\n"),
    "serializable.hpp": (dict_ + custom, custom + dict_),
    "functor.hpp": ("virtual void preStep();", "virtual void beforeStep();")})
check.equal(status, 1, "wrong declarations: exit status")
for expected in ("NormShearPhys: declared 104 bytes, the library frees 96", "Serializable: slot 8",
                 "IGeomFunctor: slot 17", "beforeStep"):
    check.true(expected in text, f"the report has '{expected}':\n{text[-3000:]}")

# The declarations for a build on the other side of the one change that there was: refused with what builds.hpp has for
# it.
status, text = build_check({}, 202601 if potential_particles._glue.built_for_yade_number < 202601 else 202502)
check.equal(status, 1, "declarations for another build: exit status")
for expected in ("Shape: virtual table of", "PotentialParticle: virtual table of", "FrictPhys: declared",
                 "KnKsPhys: declared"):
    check.true(expected in text, f"the report has '{expected}':\n{text[-3000:]}")

check.finish()
