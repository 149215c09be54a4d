# SPDX-License-Identifier: MIT OR Apache-2.0
"""Checks that count, for every test script in Python: one that fails prints the check, what was found and expected, and
where, in at most ten lines.
"""
import os
import sys
import traceback

LINES, WIDTH = 10, 400


def jobs():
    """How many processes run at once: the processors of this process, or JOBS of the environment."""
    return int(os.environ.get("JOBS") or len(os.sched_getaffinity(0)))


def short(text, lines=LINES):
    """The first lines of a text and its last, which of a traceback or a log says most."""
    kept = [line[:WIDTH] for line in str(text).strip().splitlines()]
    if len(kept) > lines:
        kept = [
            *kept[:lines // 2], f"... {len(kept) - lines + 1} lines ...", *kept[len(kept) - (lines - lines // 2 - 1):]
        ]
    return "\n    ".join(kept)


class Checks:
    """Counts what held and what did not. The last line it prints is what the runner reads."""

    def __init__(self):
        self.passed = self.failed = 0

    def true(self, condition, text):
        if condition:
            self.passed += 1
        else:
            self.failed += 1
            place = next((f for f in reversed(traceback.extract_stack()) if f.filename != __file__), None)
            where = f"{os.path.basename(place.filename)}:{place.lineno}" if place else "?"
            print(f"FAILED {where}: {short(text)}", flush=True)
        return bool(condition)

    def equal(self, found, expected, text):
        return self.true(found == expected, f"{text}: {found!r}, expected {expected!r}")

    def close(self, found, expected, tolerance, text):
        """Numbers or vectors, absolute tolerance."""
        distance = (found - expected).norm() if hasattr(found, "norm") else abs(found - expected)
        return self.true(distance <= tolerance,
                         f"{text}: {found}, expected {expected} within {tolerance:g}, off by {distance:g}")

    def raises(self, kind, action, text, containing=""):
        try:
            action()
        except kind as error:
            return self.true(containing in str(error), f"{text}: says '{error}', without '{containing}'")
        except Exception as error:
            return self.true(False, f"{text}: raised {error!r}, expected {kind.__name__}")
        return self.true(False, f"{text}: raised nothing, expected {kind.__name__}")

    def summary(self):
        """Prints the sum; the exit status that goes with it."""
        print(f"{self.passed} passed, {self.failed} failed", flush=True)
        return 1 if self.failed or not self.passed else 0

    def finish(self):
        sys.exit(self.summary())
