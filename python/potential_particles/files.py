# SPDX-License-Identifier: MIT OR Apache-2.0
"""The one way in which files are written: whole, or not at all."""
import contextlib
import json
import math
import os
import stat


@contextlib.contextmanager
def written(file, text=False):
    """An open file, of bytes or of text in UTF-8, that takes the name `file` when the block has ended without an error
    and all of it is on the disk.

    Until then it lies beside it under a name that nothing else has, made for this writer alone. OSError where anything
    could not be written, and what was there stays. A link to a file stays a link; a device or pipe is written as it is.
    """
    mode, encoding = ("w", "utf-8") if text else ("wb", None)
    place = os.path.realpath(os.fspath(file))
    try:
        if os.path.exists(place) and not stat.S_ISREG(os.stat(place).st_mode):
            with open(place, mode, encoding=encoding) as out:
                yield out
            return
        part = _made_beside(place)
        try:
            with open(part, mode, encoding=encoding) as out:
                if os.path.exists(place):
                    os.chmod(part, stat.S_IMODE(os.stat(place).st_mode))
                yield out
                out.flush()
                os.fsync(out.fileno())
            os.replace(part, place)
        finally:
            with contextlib.suppress(OSError):
                os.remove(part)
    except OSError as error:
        raise OSError(error.errno, f"{error.strerror or error}; what was there before is left as it was",
                      os.fspath(file)) from error
    _flush_folder(os.path.dirname(place))


def _made_beside(place):
    """An empty file with a name that nothing had, not even a link. The name is short: that of the file may be as long as
    names can be.
    """
    while True:
        part = os.path.join(os.path.dirname(place), f".{os.urandom(8).hex()}.part")
        with contextlib.suppress(FileExistsError):
            os.close(os.open(part, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
            return part


def _flush_folder(folder):
    """So that the new name is on the disk, too. Not all file systems have it."""
    with contextlib.suppress(OSError):
        opened = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(opened)
        finally:
            os.close(opened)


def write_summary(file, summary):
    """A dictionary of plain values as JSON, for programs; what is not a number becomes null."""
    with written(file, text=True) as out:
        json.dump(_plain(summary), out, indent=2)
        out.write("\n")


def _plain(value):
    if isinstance(value, dict):
        return {key: _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
