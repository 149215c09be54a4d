# SPDX-License-Identifier: MIT OR Apache-2.0
"""Running YADE some steps at a time, so that Python can look, draw and be interrupted between."""

import time

from yade import O

POLL_SECONDS = 0.001  # O.wait() looks only every 40 ms, which many short runs would feel


def advance(to_step):
    """Runs until O.iter == to_step; returns the seconds it took.

    On Ctrl-C YADE finishes the step it is in, and KeyboardInterrupt goes on to the caller.
    """
    start = time.perf_counter()
    try:
        O.run(to_step - O.iter)
        while O.running:
            time.sleep(POLL_SECONDS)
    except KeyboardInterrupt:
        # Not O.pause(): after it O.running is false while the last step still moves bodies.
        while O.running:
            O.stopAtIter = O.iter + 1
            time.sleep(POLL_SECONDS)
        raise
    if O.iter < to_step:
        raise SystemExit(f"YADE stopped at step {O.iter:,} of {to_step:,}; its message stands above.")
    return time.perf_counter() - start
