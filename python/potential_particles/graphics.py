# SPDX-License-Identifier: MIT OR Apache-2.0
"""OpenGL without a display, for VTK: a context of EGL's surfaceless platform, which Mesa has, on the processor if need
be.

Debian's VTK makes contexts on an X display only, up to 9.3. It draws just as well in one that is made here.
"""
import ctypes
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager

REMEDY = "apt install python3-vtk9 libegl1 libgl1-mesa-dri, or pip install vtk"

# Of the EGL and OpenGL registries.
_PLATFORM_SURFACELESS, _OPENGL_API = 0x31DD, 0x30A2
_ANY_SURFACE = (0x3033, 0, 0x3040, 8, 0x3038)  # surface type: any; renderable: OpenGL; end
_OPENGL_3_2 = (0x3098, 3, 0x30FB, 2, 0x30FD, 1, 0x3038)  # major, minor, core profile; end


def with_graphics(draw, *arguments):
    """draw(window, *arguments) with a window of VTK that is nowhere on a screen; RuntimeError where OpenGL is not to be
    had.

    It runs in a thread of its own: a thread may hold one context, and the caller's may hold that of YADE's 3-D window.
    """
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(_draw, draw, arguments).result()


def _draw(draw, arguments):
    try:
        from vtkmodules.vtkCommonCore import vtkObject
        from vtkmodules.vtkRenderingOpenGL2 import vtkGenericOpenGLRenderWindow
    except ImportError as error:
        raise ImportError(f"pictures need VTK's Python modules: {REMEDY} ({error})") from error
    with _context() as make_current:
        window = vtkGenericOpenGLRenderWindow()
        window.AddObserver("WindowMakeCurrentEvent", lambda *_: make_current())
        window.SetReadyForRendering(True)
        window.SetMapped(True)
        window.SetIsCurrent(True)
        window.OffScreenRenderingOn()
        window.SetMultiSamples(0)
        # GLEW, once it has found all functions, reports that there is no X display, upon which VTK leaves out its
        # state.
        shown = vtkObject.GetGlobalWarningDisplay()
        vtkObject.GlobalWarningDisplayOff()
        try:
            window.OpenGLInitContext()
            window.OpenGLInitState()
            return draw(window, *arguments)
        finally:
            window.Finalize()
            vtkObject.SetGlobalWarningDisplay(shown)


@contextmanager
def _context():
    """A context that is current in this thread, as a function that makes it current again."""
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError as error:
        raise RuntimeError(f"pictures need OpenGL, which works without a display: {REMEDY} ({error})") from error
    for name in ("eglGetPlatformDisplay", "eglCreateContext"):
        getattr(egl, name).restype = ctypes.c_void_p
    display = ctypes.c_void_p(_done(egl, egl.eglGetPlatformDisplay(_PLATFORM_SURFACELESS, None, None), "display"))
    _done(egl, egl.eglInitialize(display, None, None), "start")
    _done(egl, egl.eglBindAPI(_OPENGL_API), "OpenGL")
    config, count = ctypes.c_void_p(), ctypes.c_int()
    egl.eglChooseConfig(display, _integers(_ANY_SURFACE), ctypes.byref(config), 1, ctypes.byref(count))
    _done(egl, count.value, "format of pixels")
    context = ctypes.c_void_p(
        _done(egl, egl.eglCreateContext(display, config, None, _integers(_OPENGL_3_2)), "OpenGL 3.2"))
    try:
        def make_current():
            _done(egl, egl.eglMakeCurrent(display, None, None, context), "context")

        make_current()
        yield make_current
    finally:
        egl.eglMakeCurrent(display, None, None, None)
        egl.eglDestroyContext(display, context)


def _done(egl, answer, what):
    if not answer:
        raise RuntimeError(f"pictures need OpenGL, which works without a display: {REMEDY} "
                           f"(EGL has no {what}: error 0x{egl.eglGetError():x})")
    return answer


def _integers(values):
    return (ctypes.c_int * len(values))(*values)
