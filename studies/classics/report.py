# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a case hands back: rows of a table, targets, and what its picture shows."""

import numpy as np
import summary


def row(what, closed_form, found, unit="", relative=False):
    """One line of the table; the error is found less closed form, over that if `relative`."""
    error = (found - closed_form) / (closed_form if relative else 1.0)
    return {"what": what, "closed_form": closed_form, "found": found, "unit": unit, "error": error}


def target(name, limit, measured):
    """A figure that is to stay below a limit."""
    return summary.target(name, "at most", limit, measured)


def halved(low, high, bracket, is_above, look=lambda part: None):
    """(low, high) about where `is_above` begins to be true, halved until they are no wider than `bracket`."""
    trials = int(np.ceil(np.log2((high - low) / bracket)))
    for trial in range(1, trials + 1):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if is_above(middle) else (middle, high)
        look(trial / trials)
    return low, high


def worst(rows):
    """The largest error of rows, whatever its sign; NaN if one of them is."""
    errors = [abs(one["error"]) for one in rows]
    return max(errors) if all(error == error for error in errors) else float("nan")
