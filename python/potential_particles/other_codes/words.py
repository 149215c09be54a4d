# SPDX-License-Identifier: MIT OR Apache-2.0
"""The words of a text, one after the other; what is wrong with one is said with its file and line."""
import contextlib
import os

import numpy as np

from ..arguments import MOST
from ..mesh_text import numbers, read_text


class Words:
    """Of a file without its comments, which begin with one of `comments` and end with the line."""

    def __init__(self, file, comments=("#", )):
        self.file = os.fspath(file)
        try:
            lines = read_text(file)
        except (OSError, ValueError) as error:
            raise ValueError(f"{self.file} cannot be read: {getattr(error, 'strerror', None) or error}") from None
        self._words = []
        for number, line in enumerate(lines, 1):
            for sign in comments:
                line = line.split(sign)[0]
            self._words += [(number, word) for word in line.split()]
        self._at = 0

    @property
    def next(self):
        """The word that comes next; "" at the end."""
        return self._words[self._at][1] if self._at < len(self._words) else ""

    @property
    def line(self):
        """The number of its line, or of the last one."""
        return self._words[min(self._at, len(self._words) - 1)][0] if self._words else 1

    def word(self):
        """Takes the next word."""
        self._at += 1
        return self._words[self._at - 1][1] if self._at <= len(self._words) else ""

    def row(self):
        """Takes the words of the line of the next one."""
        line, found = self.line, []
        while self.next and self.line == line:
            found.append(self.word())
        return found

    def find(self, *wanted):
        """Goes on to the next of these words, and takes it; "" where there is none."""
        while self.next and self.next not in wanted:
            self._at += 1
        return self.word() if self.next else ""

    def back(self):
        """To the beginning."""
        self._at = 0

    def take(self, kind, count, what):
        """The next `count` words as numbers of a kind, int or float."""
        words = self._words[self._at:self._at + count]
        try:
            found = [kind(word) for _, word in words]
        except ValueError:
            # One by one, for the line of the first that is wrong.
            found = []
            for line, word in words:
                with self.told(line):
                    found += numbers([word], kind, 1, what)
        if len(found) < count:
            raise ValueError(f"{self.file} ends after {len(found)} of the {count} numbers of {what}")
        self._at += count
        return found

    def count(self, what, least=0):
        """The next word as how many of something there are."""
        with self.told():
            found = self.take(int, 1, what)[0]
            if found < least:
                raise ValueError(f"{what}={found} must be at least {least}")
            return found

    def numbers(self, count, what):
        """The next words as an array of numbers that shapes can bear."""
        begin = self._at
        found = np.array(self.take(float, count, what), float)
        fine = np.abs(found) <= MOST
        if not fine.all():
            wrong = int(np.argmin(fine))
            with self.told(self._words[begin + wrong][0]):
                raise ValueError(f"{what}: {found[wrong]:g} must lie between {-MOST:g} and {MOST:g}")
        return found

    def rows(self, count, width, what):
        """So many rows of numbers, an array."""
        return self.numbers(count * width, what).reshape(count, width)

    def named(self, count, of, what, first=0):
        """The next words as indices, from 0, of what there are `of`, counted from `first`."""
        with self.told():
            found = self.take(int, count, f"a list of {what}")
            for one in found:
                if not first <= one < of + first:
                    raise ValueError(f"{what} {one} is named, and there are {first} to {of + first - 1}")
        return [one - first for one in found]

    @contextlib.contextmanager
    def told(self, line=None):
        """ValueErrors of the block say file and line."""
        line = line or self.line
        try:
            yield
        except ValueError as error:
            if str(error).startswith(self.file):
                raise
            raise ValueError(f"{self.file}, line {line}: {error}") from None
