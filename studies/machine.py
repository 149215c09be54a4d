# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a result was computed on and with."""

import datetime
import os
import platform


def machine_line():
    """Processor, cores, memory, system: one line for a reader who compares timings."""
    return f"{_processor()}, {os.cpu_count()} cores, {_memory()}, {_system()}"


def now():
    """Local date and time with its offset, ISO 8601."""
    return datetime.datetime.now().astimezone().isoformat(timespec="seconds")


def _processor():
    for line in _lines("/proc/cpuinfo"):
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def _memory():
    for line in _lines("/proc/meminfo"):
        if line.startswith("MemTotal"):
            return f"{int(line.split()[1]) / 2**20:.0f} GiB"
    return "memory unknown"


def _system():
    for line in _lines("/etc/os-release"):
        if line.startswith("PRETTY_NAME"):
            return line.split("=", 1)[1].strip().strip('"')
    return platform.platform()


def _lines(path):
    try:
        with open(path) as file:
            return file.readlines()
    except OSError:
        return []
