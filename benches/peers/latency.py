# SPDX-License-Identifier: MIT OR Apache-2.0
"""Cycles that a call takes because each result waits for those it needs: gdb steps through calls, llvm-mca follows what
depends on what.

llvm-mca takes every load from the first cache, every branch as foreseen, and no load to wait for a store.
"""

import os
import re
import statistics
import subprocess
import tempfile
from pathlib import Path

# The model of llvm-mca in Debian 12 nearest to this machine.
PROCESSORS = {("AuthenticAMD", 25): "znver3", ("AuthenticAMD", 26): "znver3", ("AuthenticAMD", 23): "znver2"}
OTHERWISE = "skylake"
MOST_STEPS, MOST_CALLS = 60_000, 20
CALLS_BEFORE = 2_500  # those of the untimed walk, which fill the memories, and more
REQUESTS = 6  # of 600 calls or more: enough for those before and those that are followed
# Where gdb, which turns off address randomisation, loads a program.
BASE = 0x555555554000
STEPPER = """
import gdb
gdb.execute("set pagination off")
gdb.execute("set confirm off")
gdb.Breakpoint("*{symbol}").ignore_count = {before}
gdb.execute("run {arguments} < {requests}", to_string=True)
with open("{trace}", "w") as trace:
    for _ in range({steps}):
        trace.write(str(int(gdb.parse_and_eval("(unsigned long)$pc"))) + "\\n")
        gdb.execute("stepi", to_string=True)
gdb.execute("kill")
"""


def cycles(command, request, function, instructions):
    """Mean over some calls of `request`. function: a part of the symbol of what each call runs once; instructions: of a
    call.
    """
    program = str(command[0])
    symbol, begin = _symbol(program, function)
    steps = min(MOST_STEPS, int((MOST_CALLS + 1) * instructions))
    with tempfile.TemporaryDirectory() as folder:
        trace = _trace(Path(folder), program, command[1:], request, symbol, steps)
        text = _disassembly(program)
        return statistics.mean(
            _simulated(Path(folder), [text[address] for address in call if address in text])
            for call in _calls(trace, begin))


def _symbol(program, function):
    """Name and address of the only function that is called so."""
    listing = subprocess.run(["nm", program], check=True, capture_output=True, text=True).stdout
    [(address, name)] = re.findall(rf"^(\w+) t (\w*{function}\w*)$", listing, re.MULTILINE)
    return name, int(address, 16)


def _trace(folder, program, arguments, request, symbol, steps):
    """Addresses in the program of what is run, one after the other."""
    requests, trace, script = folder / "requests", folder / "trace", folder / "step.py"
    requests.write_text(f"{request}\n" * REQUESTS)
    script.write_text(
        STEPPER.format(symbol=symbol, before=CALLS_BEFORE, arguments=" ".join(map(str, arguments)), requests=requests,
                       trace=trace, steps=steps))
    subprocess.run(["gdb", "-batch", "-q", "-x", script, program], check=True, capture_output=True)
    return [int(line) - BASE for line in trace.read_text().split()]


def _calls(trace, begin):
    """The trace, cut where a call begins."""
    cuts = [i for i, address in enumerate(trace) if address == begin]
    return [trace[first:last] for first, last in zip(cuts, cuts[1:])]


def _disassembly(program):
    listing = subprocess.run(["objdump", "--disassemble", "--no-show-raw-insn", program], check=True,
                             capture_output=True, text=True).stdout
    return {
        int(address, 16): _plain(text)
        for address, text in re.findall(r"^\s*([0-9a-f]+):\t(.*)$", listing, re.MULTILINE)
    }


def _plain(text):
    """An instruction as the assembler takes it out of its place."""
    text = re.sub(r"<[^>]*>|#.*", "", text).strip()
    name = text.split()[0]
    if name in ("call", "ret"):
        return "nop"
    return f"{name} 16" if name.startswith("j") else text


def _simulated(folder, instructions):
    source = folder / "call.s"
    source.write_text("\n".join(instructions) + "\n")
    command = ["llvm-mca", f"-mcpu={_processor()}", "-iterations=1", source]
    report = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return int(re.search(r"Total Cycles:\s+(\d+)", report)[1])


def _processor():
    with open("/proc/cpuinfo") as file:
        fields = dict(
            re.findall(r"^(vendor_id|cpu family)\s*: (.*)$", file.read(os.sysconf("SC_PAGESIZE")), re.MULTILINE))
    return PROCESSORS.get((fields.get("vendor_id"), int(fields.get("cpu family", 0))), OTHERWISE)
