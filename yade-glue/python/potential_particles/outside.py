# SPDX-License-Identifier: GPL-3.0-or-later
"""What a script does to a scene while YADE steps it in another thread.

O.run() steps in a thread of its own, and YADE takes no lock: a body that is erased at the prompt in
the meantime may be the one that a step is reading, which ends the process. Engines, PyRunner above
all, run within a step and are free to do so.

At import only the lists of PotentialParticle are made safe to set. protect_runs() refuses the rest, when
a script asks for that.
"""
import functools
import threading
import time

_BODIES = ("append", "appendClumped", "clump", "addToClump", "releaseFromClump", "replaceByClumps", "insertAtId",
           "replace", "erase", "deleteClumpBody", "deleteClumpMember", "clear")
_INTERACTIONS = ("erase", "eraseNonReal", "clear")
_LISTS = ("a", "b", "c", "d", "vertices")


def protect_runs():
    """From now on, refuses what may end the process while O.run() steps in another thread.

    That is, for scenes of any bodies, until YADE ends: O.bodies and O.interactions are not to be changed, and neither
    is Body.shape of a body that is in the scene; each raises RuntimeError that says what to do instead. A
    PyRunner may do all of it, and so may a script after O.pause(), which then waits for the step it is in.
    """
    import yade
    wrapper = yade.wrapper
    if getattr(wrapper.Omega.pause, "protects_runs", False):
        return
    for container, what, names in ((wrapper.BodyContainer, "O.bodies", _BODIES),
                                   (wrapper.InteractionContainer, "O.interactions", _INTERACTIONS)):
        for name in names:
            setattr(container, name, _refusing(yade, getattr(container, name), f"{what}.{name}"))
    shape = wrapper.Body.shape
    in_scene = _refusing(yade, shape.fset, "a change of Body.shape")
    wrapper.Body.shape = property(
        shape.fget, lambda body, value: (shape.fset if body.id < 0 else in_scene)(body, value), doc=shape.__doc__)
    wrapper.Omega.pause = _pausing(yade, wrapper.Omega.pause)
    wrapper.Omega.pause.protects_runs = True


def guard_lists(yade, set_list):
    """Lists of plain shapes are set under the lock under which our functor reads them."""
    plain = yade.wrapper.PotentialParticle
    for name in _LISTS:
        setattr(plain, name, _list(getattr(plain, name), name, set_list))
    plain.updateAttrs = _updating(plain.updateAttrs, set_list)


def _stepped_by_another_thread(yade):
    if not yade.wrapper.Omega().running:
        return False
    # Python did not start YADE's thread: it knows it not at all, or as a dummy.
    here = threading.get_ident()
    return any(thread.ident == here and not isinstance(thread, threading._DummyThread)
               for thread in threading.enumerate())


def _refusing(yade, method, what):
    @functools.wraps(method)
    def refusing(*arguments, **keywords):
        if _stepped_by_another_thread(yade):
            raise RuntimeError(
                f"{what} while O.run() steps in another thread could end the process: "
                "call it from a PyRunner engine, or when the run has ended (O.run(steps, wait=True), O.pause())")
        return method(*arguments, **keywords)
    return refusing


def _pausing(yade, pause):
    """O.pause() that waits for the step it is in, which YADE's own leaves to go on unseen: O.running is False by then.
    """
    @functools.wraps(pause)
    def pausing(omega):
        if _stepped_by_another_thread(yade):
            stop = omega.stopAtIter
            try:
                while omega.running:
                    omega.stopAtIter = omega.iter + 1
                    time.sleep(0.0005)
            finally:
                omega.stopAtIter = stop
                pause(omega)
        else:
            pause(omega)
    return pausing


def _list(yades, name, set_list):
    return property(yades.fget, lambda shape, values: set_list(shape, name, values), doc=yades.__doc__)


def _updating(update, set_list):
    @functools.wraps(update)
    def updating(shape, attributes):
        # Our own class does all of this by itself, and checks the group as a whole.
        if type(shape).__name__ != "PotentialParticle":
            return update(shape, attributes)
        for name in _LISTS:
            if name in attributes:
                set_list(shape, name, attributes[name])
        return update(shape, {name: value for name, value in attributes.items() if name not in _LISTS})
    return updating
