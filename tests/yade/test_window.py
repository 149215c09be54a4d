# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's 3-D window draws potential particles, whenever the plugin is imported; the plugin itself needs no OpenGL."""
import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys
import types
import warnings

import harness
from harness import Checks, O

import potential_particles
import yade

check = Checks()
SCENE = os.path.join(os.path.dirname(os.path.abspath(harness.__file__)), "window", "scene.py")
SECONDS = 300


def needs_opengl(file):
    """Whether a library must have OpenGL to be loaded. (The process has it in any case: YADE's own libraries bring it,
    by way of VTK.)
    """
    known = subprocess.run(["objdump", "-p", "-T", file], capture_output=True, text=True, check=True).stdout
    return bool(re.search(r"NEEDED +lib(GL|OpenGL|Qt|QGL)|\*UND\*.* gl[A-Z]\w*$", known, re.MULTILINE))


@contextlib.contextmanager
def display():
    """The name of a display of its own. The server takes a number that is free: others may start at the same time."""
    told, tells = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(tells), "-screen", "0", "900x700x24", "-nolisten", "tcp"], pass_fds=[tells],
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(tells)
    try:
        with open(told) as number:
            yield f":{number.readline().strip()}"
    finally:
        server.terminate()
        server.wait()


def start(order, shown_on):
    """A YADE on a display. (In the order "first" the script does what YADE's launcher does for a window.)"""
    switches = ["-n"] if order == "first" else []
    # OpenGL of the processor, whatever else there is.
    environment = dict(os.environ, LIBGL_ALWAYS_SOFTWARE="1", QT_QPA_PLATFORM="xcb", DISPLAY=shown_on)
    return subprocess.Popen(["yade", "-x", *switches, f"-j{O.numThreads}", SCENE, order], env=environment, text=True,
                            start_new_session=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT)


check.true(not needs_opengl(potential_particles._glue.__file__), "the plugin loads where there is no OpenGL")
functor = potential_particles.Gl1_PotentialParticle_Conic()
check.equal(functor.bases, ["PotentialParticle"], "what the functor draws")
dispatcher_of = potential_particles._glue.window_dispatcher
check.raises(TypeError, lambda: dispatcher_of(functor), "what is no renderer")
renderer = yade.OpenGLRenderer()
dispatcher = dispatcher_of(renderer)
check.equal((type(dispatcher), dispatcher.functors), (yade.GlShapeDispatcher, []), "the dispatcher of a new renderer")


def serve(dispatcher_of):
    """What the import does where there is a window, for one whose renderer is this one."""
    sys.modules["yade.qt"] = types.SimpleNamespace(Renderer=lambda: renderer)
    try:
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            potential_particles.window.serve(yade, dispatcher_of)
        return [str(one.message) for one in said]
    finally:
        del sys.modules["yade.qt"]


def unknown_renderer(_):
    raise RuntimeError("laid out otherwise")


dispatcher.functors = [yade.Gl1_PotentialParticle(), yade.Gl1_Sphere()]
check.equal((serve(dispatcher_of), renderer.shape, renderer.bound), ([], True, False),
            "a window is served without a word")
for shape, name in ((harness.cube(), "PotentialParticle_Conic"), (yade.PotentialParticle(), "PotentialParticle_Conic"),
                    (yade.Sphere(), "Sphere")):
    check.equal(type(dispatcher.dispFunctor(shape)).__name__, "Gl1_" + name, f"what draws a {type(shape).__name__}")
said = serve(unknown_renderer)
check.true(
    len(said) == 1 and "laid out otherwise" in said[0] and "potential_particles.plot" in said[0],
    f"an unknown renderer: {said}")
check.equal((renderer.shape, renderer.bound), (False, True), "which then shows boxes")

if shutil.which("Xvfb"):
    for order in ("before", "after", "first"):
        with display() as shown_on:
            process = start(order, shown_on)
            try:
                text = process.communicate(timeout=SECONDS)[0]
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                text = process.communicate()[0] + f"\nstill running after {SECONDS} s"
        summary = re.search(r"^(\d+) passed, (\d+) failed$", text, re.MULTILINE)
        ended_well = summary and process.returncode == 0 and summary[2] == "0" and summary[1] != "0"
        check.true(ended_well, f"plugin imported {order}: exit status {process.returncode}\n{text}")
        check.true("not drawn in the window: sphericity k=2.0" in text,
                   f"{order}: the shape that is not drawn is named")
else:
    print("skipped: no window without Xvfb (Debian's package xvfb, which scripts/setup.sh installs)")
check.finish()
