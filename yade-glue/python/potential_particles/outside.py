# SPDX-License-Identifier: GPL-3.0-or-later
"""What a script does to a scene while YADE steps it in another thread.

O.run() steps in a thread of its own, and YADE takes no lock: a body that is erased at the prompt in
the meantime may be the one that a step is reading, which ends the process. Engines, PyRunner above
all, run within a step and are free to do so.
"""
import functools
import threading
import time

_BODIES = ("append", "appendClumped", "clump", "addToClump", "releaseFromClump", "replaceByClumps", "insertAtId", "replace",
           "erase", "deleteClumpBody", "deleteClumpMember", "clear")
_INTERACTIONS = ("erase", "eraseNonReal", "clear")
_LISTS = ("a", "b", "c", "d", "vertices")


def guard(yade, set_list):
    """Refuses what would end the process; makes O.pause() wait, and the lists of plain shapes safe to set."""
    wrapper = yade.wrapper
    for container, what, names in ((wrapper.BodyContainer, "O.bodies", _BODIES),
                                   (wrapper.InteractionContainer, "O.interactions", _INTERACTIONS)):
        for name in names:
            setattr(container, name, _refusing(yade, getattr(container, name), f"{what}.{name}"))
    plain = wrapper.PotentialParticle
    for name in _LISTS:
        setattr(plain, name, _list(getattr(plain, name), name, set_list))
    plain.updateAttrs = _updating(plain.updateAttrs, set_list)
    wrapper.Omega.pause = _pausing(yade, wrapper.Omega.pause)
    shape = wrapper.Body.shape
    wrapper.Body.shape = property(shape.fget, _refusing(yade, shape.fset, "a change of Body.shape"), doc=shape.__doc__)


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
            raise RuntimeError(f"{what} while O.run() steps in another thread could end the process: "
                               "call it from a PyRunner engine, or when the run has ended (O.run(steps, wait=True), O.pause())")
        return method(*arguments, **keywords)
    return refusing


def _pausing(yade, pause):
    """O.pause() that waits for the step it is in, which YADE's own leaves to go on unseen: O.running is False by then."""
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
