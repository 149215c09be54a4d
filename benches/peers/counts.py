# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a program does, by count: instructions, arithmetic, memory accesses and cache misses, from callgrind and a
disassembly.
"""

import re
import subprocess
import tempfile
from collections import Counter
from pathlib import Path

LINE = 64  # bytes that one miss brings
ARITHMETIC = re.compile(r"v?(add|sub|mul|min|max|f?n?m(add|sub))[0-9]*[sp]d$")
DIVISION = re.compile(r"v?div[sp]d$")
ROOT = re.compile(r"v?sqrt[sp]d$")
# Callgrind's events: instructions, loads, stores, and misses of the first level: of instructions, of loads and of
# stores.
EVENTS = ("instructions", "loads", "stores", "code misses", "load misses", "store misses")
CALLGRIND = [
    "valgrind", "--tool=callgrind", "--cache-sim=yes", "--dump-instr=yes", "--dump-line=no", "--compress-pos=no",
    "--compress-strings=no"
]


class Program:
    """A program that answers requests from stdin, one a line, and costs as much for each of the same."""

    def __init__(self, command):
        self.command = [str(part) for part in command]
        self.kinds = _kinds(self.command[0])

    def of_request(self, request):
        """Counter of EVENTS, 'arithmetic', 'divisions' and 'roots' of one request: that of two less that of one."""
        one, two = (self._run(request, times) for times in (1, 2))
        two.subtract(one)
        return two

    def _run(self, request, times):
        with tempfile.TemporaryDirectory() as folder:
            profile = Path(folder) / "profile"
            command = [*CALLGRIND, f"--callgrind-out-file={profile}", *self.command]
            subprocess.run(command, input=f"{request}\n" * times, check=True, capture_output=True, text=True)
            return self._sum(profile)

    def _sum(self, profile):
        total, own, skip = Counter(), False, False
        for words in map(str.split, profile.read_text().splitlines()):
            if not words or not words[0].startswith("0x"):
                if words and words[0].startswith("ob="):
                    own = words[0] == f"ob={Path(self.command[0]).resolve()}"
                # The line after 'calls=' repeats what the called function counts by itself.
                skip = bool(words) and words[0].startswith("calls=")
                continue
            if not skip:
                total.update(dict(zip(EVENTS, map(int, words[1:]))))
                kind = self.kinds.get(int(words[0], 16)) if own else None
                if kind:
                    total[kind] += int(words[1])
            skip = False
        return total


def _kinds(program):
    """Address -> 'arithmetic', 'divisions' or 'roots', of the instructions that are one."""
    listing = subprocess.run(["objdump", "--disassemble", "--no-show-raw-insn", program], check=True,
                             capture_output=True, text=True).stdout
    found = {}
    for address, name in re.findall(r"^\s*([0-9a-f]+):\s+(\w+)", listing, re.MULTILINE):
        for kind, pattern in (("arithmetic", ARITHMETIC), ("divisions", DIVISION), ("roots", ROOT)):
            if pattern.match(name):
                found[int(address, 16)] = kind
    return found


def of_functions(command, environment, toggle, wanted):
    """Counter of EVENTS, callees included, of each of `wanted` = {name: how its line in the annotation looks}, while
    `toggle` runs.
    """
    with tempfile.TemporaryDirectory() as folder:
        profile = Path(folder) / "profile"
        plain = [option for option in CALLGRIND if not option.startswith(("--dump", "--compress"))]
        subprocess.run([*plain, f"--toggle-collect={toggle}", f"--callgrind-out-file={profile}", *command],
                       env=environment, stdin=subprocess.DEVNULL, check=True, capture_output=True)
        annotate = [
            "callgrind_annotate", "--inclusive=yes", "--threshold=100",
            f"--show={','.join(('Ir', 'Dr', 'Dw', 'I1mr', 'D1mr', 'D1mw'))}"
        ]
        listing = subprocess.run([*annotate, profile], check=True, capture_output=True, text=True).stdout
    found = {}
    for line in listing.splitlines():
        numbers = re.findall(r"([0-9,]+|\.)\s*(?:\([^)]*%\)|\s)", line[:140])
        for name, look in wanted.items():
            if name not in found and re.search(look, line):
                found[name] = Counter({
                    event: int(number.replace(",", "").replace(".", "0") or 0)
                    for event, number in zip(EVENTS, numbers)
                })
    return found
