# SPDX-License-Identifier: GPL-3.0-or-later
# A YADE that does not fit is refused when the plugin is loaded, with the differences listed. (At build time:
# test_abi_probe.py.)
import os
import shutil
import subprocess
import sys
import tempfile

import yade
import yade.config
import yade.system
import yade.wrapper
from harness import *

check = Checks()
GLUE = os.path.join(os.environ["PP_PACKAGE"], "potential_particles")


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
                ["KnKsPhys.kn", "KnKsPhys.ks", "Aabb.min", "Aabb.max", "Scene.trackEnergy", "Scene.doSort"],
                f"differences are listed: {found}")
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
check.true(O.interactions[0, 1].isReal,
           "engines made before the import serve the new shape, the built-in functor included")

# A second copy of the module in the same process finds its names taken.
check.raises(Exception, lambda: module._glue.register_classes(), "second registration", "already has a class")

# Without YADE the package has its own names alone, and a sentence that says what to do for the others.
def outside(program, path=os.environ["PP_PACKAGE"]):
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True,
                          env=dict(os.environ, PYTHONPATH=path))


said = outside("import potential_particles as pp; print(pp.Particle.sphere(2).R, hasattr(pp, 'body'))")
check.equal(said.stdout, "2.0 False\n", f"outside YADE: {said.stderr[-300:]}")
said = outside("import potential_particles.yade").stderr
check.true("needs YADE" in said, f"outside YADE: {said[-300:]}")
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

# A wheel of another version, which comes first on the path, and the plugin refuse each other.
with tempfile.TemporaryDirectory() as folder:
    others = shutil.copytree(GLUE, os.path.join(folder, "potential_particles"),
                             ignore=shutil.ignore_patterns("yade.py", "_glue.so"))
    first = os.path.join(others, "__init__.py")
    text = open(first).read()
    open(first, "w").write(text.replace('__version__ = "', '__version__ = "9.'))
    said = outside(program, f"{folder}:{os.environ['PP_PACKAGE']}").stderr.strip().splitlines()[-1]
    check.true("ImportError" in said and "version 9." in said and "install both of one version" in said,
               f"another wheel: {said}")
    open(first, "w").write(text)
    both = outside(program, f"{folder}:{os.environ['PP_PACKAGE']}")
    check.true((both.stdout.split() or ["nothing"])[-1].startswith("2."), f"a wheel of this version: {both.stderr[-300:]}")

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
    return lambda path: subprocess.run(["gcc", "-shared", "-fPIC", "-x", "c", "-", "-o", path], input=source, text=True,
                                       check=True)


said = import_with(lambda binary: binary.replace(b"libpotential_particles.so", b"libpotential_particles.no"))
check.true("ImportError" in said and "cargo build" in said, f"missing library: {said}")
said = import_with(library=lambda path: open(path, "w").close())
check.true("ImportError" in said and "cargo build" in said, f"empty library: {said}")
said = import_with(library=compiled("int other;"))
check.true("ImportError" in said and "pp_" in said and "build both again" in said,
           f"a library without our functions: {said}")
undefined = subprocess.run(
    ["nm", "-D", "--undefined-only", os.path.join(GLUE, "_glue.so")], capture_output=True, text=True)
called = [word for word in undefined.stdout.split() if word.startswith("pp_") and word != "pp_version"]
said = import_with(library=compiled('const char *pp_version(void) { return "9.8.7"; }\n'
                                    + "".join(f"void {name}(void) {{}}\n" for name in called)))
check.true("ImportError" in said and "9.8.7" in said and "build the plugin again" in said, f"another version: {said}")
others = [name for name in called if name != "pp_abi_version"]
said = import_with(library=compiled('const char *pp_version(void) { return "%s"; }\n' % module.library_version()
                                    + "unsigned pp_abi_version(void) { return 999; }\n"
                                    + "".join(f"void {name}(void) {{}}\n" for name in others)))
check.true("ImportError" in said and "999" in said and "build the plugin again" in said,
           f"another binary interface: {said}")
said = import_with(lambda binary: b"")
check.true("ImportError" in said and "cmake --build" in said, f"empty plugin: {said}")

check.finish()
