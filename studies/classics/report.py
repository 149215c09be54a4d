# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a case hands back: rows of a table, targets, and what its picture shows."""

import summary


def row(what, closed_form, found, unit="", relative=False):
    """One line of the table; the error is found less closed form, over that if `relative`."""
    error = (found - closed_form) / (closed_form if relative else 1.0)
    return {"what": what, "closed_form": closed_form, "found": found, "unit": unit, "error": error}


def target(name, limit, measured):
    """A figure that is to stay below a limit."""
    return summary.target(name, "at most", limit, measured)


def worst(rows):
    """The largest error of rows, whatever its sign; NaN if one of them is."""
    errors = [abs(one["error"]) for one in rows]
    return max(errors) if all(error == error for error in errors) else float("nan")
