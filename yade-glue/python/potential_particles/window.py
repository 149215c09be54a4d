# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's 3-D window (yade.qt): how it comes to draw potential particles.

The window's renderer makes its table of drawing functors when YADE starts: one functor for a class of shape, a row for
each class then known. A class that comes later has no row, and drawing a shape of it ends YADE with an assertion. So
the plugin adds its functor and has the table made anew. A renderer that is made after the import finds the functor by
itself.
"""
import sys
import warnings


def serve(yade, dispatcher_of):
    """Gives the functor to YADE's window, if there is one, be it open or not. dispatcher_of: of shapes, in a renderer.
    """
    window = sys.modules.get("yade.qt")
    if window is None or not hasattr(window, "Renderer"):
        return
    renderer = window.Renderer()
    try:
        dispatcher = dispatcher_of(renderer)
    except RuntimeError as reason:
        renderer.shape, renderer.bound = False, True
        warnings.warn(
            "YADE's 3-D window cannot draw our shapes (%s) and shows boxes: leave yade.qt.Renderer().shape at False and pick no "
            "body by a click, which end YADE; potential_particles.plot draws all bodies" % reason)
        return
    # Setting the list makes the table anew; of two functors for a class the last is taken.
    dispatcher.functors = dispatcher.functors + [yade.wrapper.Gl1_PotentialParticle_Conic()]
