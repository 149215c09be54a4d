# SPDX-License-Identifier: GPL-3.0-or-later
"""The C interface of the library, by ctypes, for limit analysis.

Arguments are as in C: float, int (a size), arrays, handles and references.
"""
import ctypes
import functools

import numpy as np

_MESSAGE_SIZE = 512
_SOLVER_FAILED = 8


@functools.lru_cache(maxsize=1)
def _library():
    """The library that the plugin has loaded: its functions are found by way of the plugin."""
    from . import _glue
    loaded = ctypes.CDLL(_glue.__file__)
    loaded.pp_status_message.restype = ctypes.c_char_p
    return loaded


def _given(value):
    if isinstance(value, np.ndarray):
        return ctypes.c_void_p(value.ctypes.data)
    return {float: ctypes.c_double, int: ctypes.c_size_t}.get(type(value), lambda one: one)(value)


def refuse(name, *arguments):
    """ValueError with the sentence of a function that makes nothing, if it writes one; RuntimeError if a solver has no
    answer.
    """
    why = ctypes.create_string_buffer(_MESSAGE_SIZE)
    status = getattr(_library(), name)(*map(_given, arguments), why, ctypes.c_size_t(_MESSAGE_SIZE))
    if status:
        said = why.value.decode() or _library().pp_status_message(status).decode()
        raise (RuntimeError if status == _SOLVER_FAILED else ValueError)(said)
