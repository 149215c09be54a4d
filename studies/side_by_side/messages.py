# SPDX-License-Identifier: MIT OR Apache-2.0
"""What compiled code prints past Python."""

import contextlib
import os
import sys


@contextlib.contextmanager
def set_aside(path):
    """Within, standard output goes to the end of a file, that of compiled code included."""
    sys.stdout.flush()
    terminal = os.dup(1)
    try:
        with open(path, "a") as file:
            os.dup2(file.fileno(), 1)
            yield
            sys.stdout.flush()
    finally:
        os.dup2(terminal, 1)
        os.close(terminal)
