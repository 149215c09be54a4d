# SPDX-License-Identifier: GPL-3.0-or-later
# A YADE that does not fit is refused, at load time and at build time, with the differences listed.
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

import yade
import yade.config
import yade.system
import yade.wrapper
from harness import *

check = Checks()
GLUE = os.path.join(os.environ["PP_PACKAGE"], "potential_particles")
HERE = os.path.dirname(os.path.abspath(sys.modules["harness"].__file__))
SOURCE = os.path.join(HERE, os.pardir, os.pardir, "yade-glue", "abi")
LIBRARIES = os.path.dirname(os.path.dirname(os.path.dirname(yade.__file__)))


def import_module():
    sys.modules.pop("potential_particles", None)
    import potential_particles
    return potential_particles


# A YADE whose classes lie otherwise in memory, as Python sees it: refused with each difference, nothing registered, and
# the next try with the true one works.
physics = yade.wrapper.KnKsPhys
kn, ks = yade.wrapper.NormPhys.kn, yade.wrapper.NormShearPhys.ks
physics.kn, physics.ks = ks, kn
bound, scene = yade.wrapper.Bound, yade.wrapper.Scene
lower, upper, sort, track = bound.min, bound.max, scene.doSort, scene.trackEnergy
bound.min, bound.max, scene.doSort, scene.trackEnergy = upper, lower, track, sort
true_version = yade.config.version
yade.config.version = "2099.01a"
try:
    import_module()
    check.true(False, "another layout was accepted")
except ImportError as error:
    check.equal(type(error).__name__, "AbiError", "kind of the refusal")
    check.true("2099.01a" in str(error) and true_version in str(error), f"the refusal names both versions: {error}")
    found = getattr(error, "differences", [])
    check.equal([difference.split(":")[0] for difference in found],
                ["KnKsPhys.kn", "KnKsPhys.ks", "Aabb.min", "Aabb.max", "Scene.trackEnergy", "Scene.doSort"], f"differences are listed: {found}")
check.true(not hasattr(yade.wrapper, "ConicPotentialParticle"), "nothing is registered after a refusal")
check.true("ConicPotentialParticle" not in yade.system._allSerializables, "nor listed")
yade.config.version = true_version
del physics.kn, physics.ks
bound.min, bound.max, scene.doSort, scene.trackEnergy = lower, upper, sort, track
# Engines that exist before the module does: their dispatchers must learn of the new shape.
fresh_scene(yade.Ig2_PP_PP_ScGeom(), dt=1e-9)
module = import_module()
check.true(hasattr(yade.wrapper, "ConicPotentialParticle"), "the true layout is accepted")
check.equal(list(module._glue.differences_of_layout()), [], "no differences of layout")

add(cube(), Vector3(0, 0, 0), fixed=True)
add(cube(), Vector3(0, 0, 0.98), fixed=True)
module.prepare()
run(2)
check.true(O.interactions[0, 1].isReal, "engines made before the import serve the new shape, the built-in functor included")

# A second copy of the module in the same process finds its names taken.
check.raises(Exception, lambda: module._glue.register_classes(), "second registration", "already has a class")

# Without YADE there is a sentence that says what to do.
outside = subprocess.run([sys.executable, "-c", "import potential_particles"], capture_output=True, text=True,
                         env=dict(os.environ, PYTHONPATH=os.environ["PP_PACKAGE"]))
check.true(outside.returncode != 0 and "needs YADE" in outside.stderr, f"outside YADE: {outside.stderr[-300:]}")
# In a plain Python that finds YADE it works like inside.
program = """
import sys
sys.path.insert(0, %r)
import potential_particles
print(potential_particles.ConicPotentialParticle(k=1.0, R=2.0).boundingRadius)
""" % os.path.dirname(os.path.dirname(yade.__file__))
plain_python = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                              env=dict(os.environ, PYTHONPATH=os.environ["PP_PACKAGE"]))
last = (plain_python.stdout.split() or ["nothing"])[-1]
check.true(last.startswith("2."), f"in a plain Python: {last} {plain_python.stderr[-300:]}")

# A library that is missing, broken, or of another version: a sentence with the remedy, and no class registered.
def import_with(glue=lambda binary: binary, library=None):
    """What importing says, with the plugin's file changed, or another library ahead of the right one."""
    with tempfile.TemporaryDirectory() as folder:
        package = shutil.copytree(GLUE, os.path.join(folder, "potential_particles"))
        name = os.path.join(package, "_glue.so")
        binary = open(name, "rb").read()
        open(name, "wb").write(glue(binary))
        if library is not None:
            library(os.path.join(folder, "libpotential_particles.so"))
        environment = dict(os.environ, PYTHONPATH=folder, LD_LIBRARY_PATH=folder)
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, env=environment)
        check.equal(done.returncode, 1, f"an error of Python, not of the process: {done.stderr[-500:]}")
        return done.stderr.strip().splitlines()[-1]


def compiled(source):
    return lambda path: subprocess.run(["gcc", "-shared", "-fPIC", "-x", "c", "-", "-o", path], input=source, text=True, check=True)


said = import_with(lambda binary: binary.replace(b"libpotential_particles.so", b"libpotential_particles.no"))
check.true("ImportError" in said and "cargo build" in said, f"missing library: {said}")
said = import_with(library=lambda path: open(path, "w").close())
check.true("ImportError" in said and "cargo build" in said, f"empty library: {said}")
said = import_with(library=compiled("int other;"))
check.true("ImportError" in said and "pp_" in said and "build both again" in said, f"a library without our functions: {said}")
undefined = subprocess.run(["nm", "-D", "--undefined-only", os.path.join(GLUE, "_glue.so")], capture_output=True, text=True)
called = [word for word in undefined.stdout.split() if word.startswith("pp_") and word != "pp_version"]
said = import_with(library=compiled('const char *pp_version(void) { return "9.8.7"; }\n'
                                    + "".join(f"void {name}(void) {{}}\n" for name in called)))
check.true("ImportError" in said and "9.8.7" in said and "build the plugin again" in said, f"another version: {said}")
others = [name for name in called if name != "pp_abi_version"]
said = import_with(library=compiled('const char *pp_version(void) { return "%s"; }\n' % module.library_version()
                                    + "unsigned pp_abi_version(void) { return 999; }\n"
                                    + "".join(f"void {name}(void) {{}}\n" for name in others)))
check.true("ImportError" in said and "999" in said and "build the plugin again" in said, f"another binary interface: {said}")
said = import_with(lambda binary: b"")
check.true("ImportError" in said and "cmake --build" in said, f"empty plugin: {said}")

# The build-time check, with declarations that are wrong on purpose.
def build_check(edits, number=module._glue.built_for_yade_number):
    """Exit status and messages of check_abi.py for a copy of abi/ with edits {file: (old, new)}, as for that build of YADE."""
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
        compiled = subprocess.run(
            ["g++", "-std=c++17", "-O0", "-fPIC", "-shared", "-w", "-DEIGEN_DONT_ALIGN", "-DEIGEN_DONT_VECTORIZE",
             "-DBOOST_BIND_GLOBAL_PLACEHOLDERS", "-DBOOST_ALLOW_DEPRECATED_HEADERS", "-I/usr/include/eigen3",
             f"-DPP_YADE_VERSION={number}", "-I" + sysconfig.get_paths()["include"], os.path.join(abi, "probe.cpp"), "-o", probe],
            capture_output=True, text=True)
        if not check.equal(compiled.returncode, 0, f"probe compiled\n{compiled.stderr[-2000:]}"):
            return None, ""
        done = subprocess.run([sys.executable, os.path.join(abi, "check_abi.py"), "--libraries", LIBRARIES, "--probe", probe],
                              capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr


declared = sum(len(re.findall(r"^PP_ABI_SIZE\(", path.read_text(), re.MULTILINE)) for path in Path(SOURCE).glob("*.hpp"))
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

# The declarations for a build on the other side of the one change that there was: refused with what builds.hpp has for it.
status, text = build_check({}, 202601 if module._glue.built_for_yade_number < 202601 else 202502)
check.equal(status, 1, "declarations for another build: exit status")
for expected in ("Shape: virtual table of", "PotentialParticle: virtual table of", "FrictPhys: declared", "KnKsPhys: declared"):
    check.true(expected in text, f"the report has '{expected}':\n{text[-3000:]}")

check.finish()
