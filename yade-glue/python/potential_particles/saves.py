# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes in files: saved whole or not at all, and a sentence for one that YADE cannot load since another YADE saved it.

YADE's own message is that of its reader ("input stream error", "unsupported version", even a lack of memory). Which
Boost wrote a file stands at its beginning, and each Debian has one of its own, so that another YADE can mostly be told
by it.
"""
import bz2
import errno
import functools
import gzip
import os
import re
import subprocess
import tempfile

from .files import written

_SIGNATURE = b"serialization::archive"


def archive_version(path):
    """Version of Boost's archives in a file saved by YADE; None where there is none to be read."""
    try:
        with open(path, "rb") as file:
            start = file.read(3)
        opener = gzip.open if start[:2] == b"\x1f\x8b" else bz2.open if start == b"BZh" else open
        with opener(path, "rb") as file:
            head = file.read(400)
    except (OSError, EOFError):
        return None
    _, found, rest = head.partition(_SIGNATURE)
    if not found:
        return None
    in_xml = re.match(rb'"\s+version="(\d+)"', rest)
    if in_xml:
        return int(in_xml.group(1))
    return int.from_bytes(rest[:2], "little") if len(rest) >= 2 and not rest.startswith(b'"') else None


def save(file):
    """O.save(file), but for a disk that is full, or a process that ends meanwhile: the file is the whole scene, or what
    it was before with an OSError.

    YADE's own O.save begins by emptying the file, and does not notice all that could not be written.
    """
    import yade
    with written(file) as out, tempfile.TemporaryDirectory() as folder:
        # YADE tells the format by the end of the name. Into a pipe, since what it writes to a file it does not check,
        # and of its binary format nobody could see afterwards whether it is whole.
        pipe = os.path.join(folder, os.path.basename(os.fspath(file)))
        os.mkfifo(pipe)
        # Open on this side, too, so that nobody waits for the other end.
        source = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
        os.set_blocking(source, True)
        begin = os.open(pipe, os.O_WRONLY)
        try:
            # What has no room is read all the same: Boost's filters never end where nothing can be written.
            copying = subprocess.Popen(["sh", "-c", "cat || { cat >/dev/null; false; }"], stdin=source, stdout=out,
                                       stderr=subprocess.PIPE, restore_signals=False, text=True, errors="replace")
        except BaseException:
            os.close(begin)
            raise
        finally:
            os.close(source)
        failed = None
        try:
            yade.wrapper.Omega().save(pipe)
        except RuntimeError as error:
            failed = error
        finally:
            os.close(begin)
            said = copying.communicate()[1]
        if copying.returncode:
            raise OSError(errno.EIO, said.strip().rpartition(": ")[2] or f"the copy ended with {copying.returncode}")
        if failed:
            raise failed


def guard(yade, own_version, running):
    """Lets O.load say what to do about a file of another YADE."""
    load = yade.wrapper.Omega.load

    @functools.wraps(load)
    def loading(omega, file, *arguments, **keywords):
        try:
            return load(omega, file, *arguments, **keywords)
        except (RuntimeError, MemoryError) as error:
            found = archive_version(file)
            if found is None or found == own_version:
                raise
            raise RuntimeError(
                f"{file} was saved by another YADE (archive version {found}; YADE {running} reads {own_version}): load it there, set "
                f"O.engines = [], save as .xml.bz2, and set the engines anew here (docs/yade_versions.md): {error!r}"
            ) from error

    yade.wrapper.Omega.load = loading
