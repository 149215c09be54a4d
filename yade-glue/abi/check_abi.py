#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the declarations in this folder with YADE's installed libraries.

For each class in probe.cpp: every slot of the virtual table that the compiler made from our
declaration must name the function that the library's own table names; the declared size must be
the one that the library's deleting destructor hands to operator delete. For the plugin: every
undefined YADE symbol must be exported by some library, and each virtual function that it overrides
must sit in the slot of its namesake.

Prints each difference; exit status 1 if there is any, 2 if the check could not be made.
"""
import argparse
import re
import struct
import subprocess
import sys
from pathlib import Path

LIBRARIES = ["libyade.so", "libpkg_common.so", "libpkg_dem.so", "libpkg_potential.so"]
ENTRY = re.compile(r"^PP_(?:CLASS\((\w+), (\w+)|STAND_IN\((\w+))", re.MULTILINE)
WORD = 8
SHT_RELA, SHT_NOBITS, SHT_DYNSYM = 4, 8, 11
SHF_ALLOC, SHF_TLS = 2, 0x400
R_X86_64_64, R_X86_64_RELATIVE = 1, 8


class Elf:
    """The dynamic symbols, relocations and bytes of a 64-bit little-endian shared object."""

    def __init__(self, path):
        self.path = Path(path)
        self.bytes = self.path.read_bytes()
        if self.bytes[:6] != b"\x7fELF\x02\x01":
            raise ValueError(f"{path} is no 64-bit little-endian ELF file")
        table_at, = struct.unpack_from("<Q", self.bytes, 40)
        size, count = struct.unpack_from("<HH", self.bytes, 58)
        self.sections = [struct.unpack_from("<IIQQQQIIQQ", self.bytes, table_at + i * size) for i in range(count)]
        self.symbols, self.defined, self.undefined, self.names_at = [], {}, set(), {}
        for _, kind, _, _, offset, length, link, *_ in self.sections:
            if kind == SHT_DYNSYM:
                self._read_symbols(offset, length, self.sections[link][4])
        self.relocations = {}
        for _, kind, _, _, offset, length, *_ in self.sections:
            if kind == SHT_RELA:
                self._read_relocations(offset, length)

    def _read_symbols(self, offset, length, strings):
        entries = struct.iter_unpack("<IBBHQQ", self.bytes[offset:offset + length])
        for name_at, _info, _other, section, value, size in entries:
            start = strings + name_at
            name = self.bytes[start:self.bytes.index(b"\0", start)].decode()
            self.symbols.append(name)
            if section:
                self.defined[name] = (value, size)
                self.names_at.setdefault(value, []).append(name)
            elif name:
                self.undefined.add(name)

    def _read_relocations(self, offset, length):
        for at, info, addend in struct.iter_unpack("<QQq", self.bytes[offset:offset + length]):
            kind, symbol = info & 0xFFFFFFFF, info >> 32
            if kind == R_X86_64_64:
                self.relocations[at] = (self.symbols[symbol],)
            elif kind == R_X86_64_RELATIVE:
                # A local function: any of its exported names will do; none if it has none.
                self.relocations[at] = tuple(self.names_at.get(addend, ())) or (f"local function at {addend:#x}",)

    def word(self, address):
        for _, kind, flags, start, offset, length, *_ in self.sections:
            # Thread-local sections have addresses that overlap those of others.
            if flags & SHF_ALLOC and not flags & SHF_TLS and start <= address < start + length:
                return 0 if kind == SHT_NOBITS else struct.unpack_from("<q", self.bytes, offset + address - start)[0]
        raise ValueError(f"{self.path}: address {address:#x} lies in no section")

    def virtual_table(self, symbol):
        """Slots of a table: tuples of names for relocated words, numbers for the others."""
        start, size = self.defined[symbol]
        return [self.relocations.get(at) or self.word(at) for at in range(start, start + size, WORD)]


def plugin_classes(table):
    """The classes of the plugin's class table, each with the class of YADE whose virtual table its own continues."""
    bases = {name or f"Ig2_{shape}_ConicPP_ScGeom": base or "Ig2_ConicPP_ConicPP_ScGeom"
             for name, base, shape in ENTRY.findall(table.read_text())}
    roots = dict(bases)
    while ours := [name for name, base in roots.items() if base in bases]:
        roots.update((name, bases[roots[name]]) for name in ours)
    return roots


def mangled(*names):
    return f"N{''.join(f'{len(name)}{name}' for name in names)}E"


def demangle(names):
    names = sorted(set(names))
    text = subprocess.run(["c++filt"], input="\n".join(names), capture_output=True, text=True, check=True).stdout
    return dict(zip(names, text.splitlines()))


def own_part(demangled):
    """A function without its class: 'pyDict() const' of 'yade::Shape::pyDict() const'; '~' for destructors."""
    text = re.sub(r"^(non-virtual|virtual) thunk to ", "", demangled).replace("[abi:cxx11]", "")
    head, depth = len(text), 0
    for i, char in enumerate(text):
        depth += (char == "<") - (char == ">")
        if char == "(" and depth == 0:
            head = i
            break
    name = re.sub(r".*::", "", _without_templates(text[:head]))
    return "~" if name.startswith("~") else name + text[head:]


def _without_templates(text):
    while True:
        shorter = re.sub(r"<[^<>]*>", "", text)
        if shorter == text:
            return text
        text = shorter


class Comparison:
    def __init__(self, libraries, probe, plugin):
        self.libraries = [Elf(libraries / name) for name in LIBRARIES]
        self.probe = probe
        self.plugin = plugin
        self.differences = []
        self.slots = 0

    def note(self, text):
        self.differences.append(text)

    def library_with(self, symbol):
        return next((library for library in self.libraries if symbol in library.defined), None)

    def compare_class(self, name):
        symbol = "_ZTV" + mangled("yade", name)
        library = self.library_with(symbol)
        if not library:
            self.note(f"{name}: no library exports its virtual table")
            return
        theirs = library.virtual_table(symbol)
        ours = self.probe.virtual_table("_ZTV" + mangled("yade", "abi_probe", name))
        self.compare_tables(name, ours, theirs, "abi_probe")
        self.compare_size(name, library, theirs)

    def compare_tables(self, name, ours, theirs, own_namespace):
        if len(ours) != len(theirs):
            self.note(f"{name}: virtual table of {len(ours)} words, the library's has {len(theirs)}")
        text = demangle([n for slot in ours + theirs if isinstance(slot, tuple) for n in slot])
        for index, (mine, other) in enumerate(zip(ours, theirs)):
            self.slots += 1
            if not isinstance(mine, tuple) or not isinstance(other, tuple):
                if mine != other:
                    self.note(f"{name}: slot {index} holds {mine}, the library's {other}")
                continue
            if set(mine) & set(other):
                continue
            # What differs must be what the deriving class brings itself: type information,
            # destructors, overrides of the function of the same name.
            mine_text, other_text = text[mine[0]], text[other[0]]
            own = own_namespace + "::" in mine_text
            if own and mine_text.startswith("typeinfo for") and other_text.startswith("typeinfo for"):
                continue
            if own and own_part(mine_text) == own_part(other_text):
                continue
            self.note(f"{name}: slot {index} holds {mine_text}, the library's {other_text}")

    def compare_size(self, name, library, table):
        deleting = next((n for slot in table if isinstance(slot, tuple) for n in slot
                         if n.endswith("D0Ev") and not n.startswith("_ZTh")), None)
        where = library if deleting in library.defined else self.library_with(deleting)
        start, length = where.defined[deleting]
        code = subprocess.run(["objdump", "-d", "--no-show-raw-insn", f"--start-address={start}",
                               f"--stop-address={start + length}", where.path],
                              capture_output=True, text=True, check=True).stdout
        found = re.findall(r"mov\s+\$0x([0-9a-f]+),%esi\n(?:.*\n){0,12}?.*(jmp|call)\s.*<_ZdlPvm", code)
        # What a field frees (nodes of a map) is called; the object itself is mostly freed last, by a jump.
        own = [size for size, how in found if how == "jmp"] or [size for size, _ in found]
        sizes = {int(size, 16) for size in own}
        declared = self.probe.word(self.probe.defined[f"abi_size_{name}"][0])
        if not sizes:
            self.note(f"{name}: no size found in {deleting} of {where.path.name}")
        # What else it frees are nodes of lists, which are smaller.
        elif max(sizes) != declared:
            self.note(f"{name}: declared {declared} bytes, the library frees {', '.join(map(str, sorted(sizes)))}")

    def compare_symbols(self, elf):
        wanted = {s for s in elf.undefined if "4yade" in s or "9SingletonI" in s}
        missing = sorted(s for s in wanted if not self.library_with(s))
        for text in demangle(missing).values() if missing else ():
            self.note(f"{elf.path.name} needs {text}, which no library of YADE exports")
        return len(wanted)

    def compare_plugin_class(self, name, base):
        theirs_symbol = "_ZTV" + mangled("yade", base)
        theirs = self.library_with(theirs_symbol).virtual_table(theirs_symbol)
        ours = self.plugin.virtual_table("_ZTV" + mangled("potential_particles", name))
        # Overriding a function of a second base adds slots before that base's part: they start
        # where the library's table has the second offset.
        primary = next((i for i, slot in enumerate(theirs) if not isinstance(slot, tuple) and slot < 0), len(theirs))
        extra = len(ours) - len(theirs)
        if extra < 0:
            self.note(f"{name}: virtual table of {len(ours)} words, shorter than that of {base} ({len(theirs)})")
            return
        self.compare_tables(name, ours[:primary] + ours[primary + extra:], theirs, "potential_particles")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("--build", default="this YADE",
                           help="what the declarations were compiled for, as messages name it")
    arguments.add_argument("--libraries", type=Path, required=True, help="folder of YADE's libraries")
    arguments.add_argument("--probe", type=Path, required=True, help="probe.cpp, compiled")
    arguments.add_argument("--plugin", type=Path, help="the plugin")
    arguments.add_argument("--table", type=Path, help="its class table, src/registration/class_table.inc")
    options = arguments.parse_args()
    try:
        probe = Elf(options.probe)
        plugin = Elf(options.plugin) if options.plugin else None
        comparison = Comparison(options.libraries, probe, plugin)
        classes = sorted(s.removeprefix("abi_size_") for s in probe.defined if s.startswith("abi_size_"))
        for name in classes:
            comparison.compare_class(name)
        symbols = comparison.compare_symbols(probe)
        if plugin:
            symbols += comparison.compare_symbols(plugin)
            for name, base in plugin_classes(options.table).items():
                comparison.compare_plugin_class(name, base)
    except (OSError, ValueError, KeyError, subprocess.CalledProcessError) as error:
        print(f"check_abi: cannot compare: {error!r}", file=sys.stderr)
        return 2
    for difference in comparison.differences:
        print(f"check_abi: {difference}", file=sys.stderr)
    if comparison.differences:
        print(
            f"check_abi: {len(comparison.differences)} differences between abi/, compiled for {options.build}, and the libraries in "
            f"{options.libraries}: the plugin does not fit this YADE (yade-glue/tested_builds.txt has those that it fits)",
            file=sys.stderr)
        return 1
    print(
        f"check_abi: {options.build}: {len(classes)} classes, {comparison.slots} virtual slots and {symbols} symbols agree"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
