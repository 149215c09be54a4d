# SPDX-License-Identifier: GPL-3.0-or-later
"""A sentence for a scene that YADE cannot load since another YADE saved it.

YADE's own message is that of its reader ("input stream error", "unsupported version", even a lack of memory). Which Boost wrote a file stands
at its beginning, and each Debian has one of its own, so that another YADE can mostly be told by it.
"""
import bz2
import functools
import gzip
import re

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
                f"{file} was saved by another YADE (its archive is of version {found}; YADE {running} writes {own_version}), and "
                "YADE loads no engines of another version, contacts only if their physics did not change, and no binary files of a "
                "newer one. Load it with the YADE that saved it, set O.engines = [], if that is not enough O.interactions.clear() "
                "too, and save as .xml.bz2; the script that loads that sets its engines anew. "
                f"YADE's own message: {error!r}") from error

    yade.wrapper.Omega.load = loading
