# SPDX-License-Identifier: MIT OR Apache-2.0
"""What long calls show: a bar on a terminal, by tqdm where it is installed; Ctrl-C that keeps what there is."""
import signal
import sys
import threading


class Interrupts:
    """While it is entered, Ctrl-C is noted in a list instead of raised."""

    def __enter__(self):
        self.noted = []
        self.before = None
        if threading.current_thread() is threading.main_thread():
            self.before = signal.signal(signal.SIGINT, lambda *_: self.noted.append("Ctrl-C"))
        return self.noted

    def __exit__(self, *_):
        if self.before is not None:
            signal.signal(signal.SIGINT, self.before)


class Bar:
    """Counts up to `total`; nothing is drawn where `shown` is false, without a terminal, or without tqdm."""

    def __init__(self, total, shown, unit, what):
        self._bar = None
        if shown and sys.stderr.isatty():
            try:
                from tqdm import tqdm
            except ImportError:
                return
            self._bar = tqdm(total=total, unit=f" {unit}", desc=what, leave=False, delay=0.5)

    def reached(self, count):
        if self._bar is not None:
            self._bar.update(count - self._bar.n)

    def close(self):
        if self._bar is not None:
            self._bar.close()
