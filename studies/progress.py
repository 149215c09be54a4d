# SPDX-License-Identifier: MIT OR Apache-2.0
"""Progress on the terminal: a bar with steps per second and time left, or sparse lines elsewhere."""

import sys
import time

BAR_WIDTH = 32
REDRAW_SECONDS = 0.2
MEMORY_SECONDS = 8.0  # the rate is that of the last few seconds: it changes as bodies meet
LINE_PERCENT = 10  # in a file or a pipe, one line per so many percent


class Progress:
    """Counts from 0 to `total` steps, or whatever else the `unit` is."""

    def __init__(self, total, stream=None, clock=time.monotonic, unit="step"):
        self.total, self.stream, self.clock, self.unit = total, stream or sys.stdout, clock, unit
        self.on_terminal = self.stream.isatty()
        self.history = [(clock(), 0)]
        self._drawn_at, self._next_percent = -1e9, LINE_PERCENT
        self._open_line = False

    def update(self, step):
        now = self.clock()
        self.history.append((now, step))
        while len(self.history) > 2 and now - self.history[0][0] > MEMORY_SECONDS:
            self.history.pop(0)
        done = step >= self.total
        if self.on_terminal:
            if done or now - self._drawn_at >= REDRAW_SECONDS:
                self._drawn_at = now
                filled = BAR_WIDTH * step // self.total
                bar = "#" * filled + "." * (BAR_WIDTH - filled)
                self.stream.write(f"\r[{bar}] {self._text(step)}\x1b[K")
                self.stream.flush()
                self._open_line = True
        elif 100 * step // self.total >= self._next_percent:
            self._next_percent = LINE_PERCENT * (100 * step // self.total // LINE_PERCENT + 1)
            self.stream.write(self._text(step) + "\n")
            self.stream.flush()

    def close(self):
        """Ends the line of the bar, so that what follows starts on its own line."""
        if self._open_line:
            self.stream.write("\n")
            self.stream.flush()
            self._open_line = False

    def _text(self, step):
        (then, before), (now, _) = self.history[0], self.history[-1]
        rate = (step - before) / (now - then) if now > then else 0.0
        left = clock_text((self.total - step) / rate) if rate > 0.0 else "?"
        percent = 100 * step // self.total
        speed = f"{rate:,.0f}" if rate >= 10.0 else f"{rate:.1f}"
        return f"{percent:3d}%  {self.unit} {step:,} of {self.total:,}  {speed} {self.unit}s/s  {left} left"


def clock_text(seconds):
    """3725 s as 1:02:05, 65 s as 1:05."""
    seconds = round(seconds)
    hours, minutes = seconds // 3600, seconds // 60 % 60
    return f"{hours}:{minutes:02d}:{seconds % 60:02d}" if hours else f"{minutes}:{seconds % 60:02d}"
