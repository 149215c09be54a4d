#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""How instructions are told apart and traces are cut, on listings that are short enough to know the answer. Needs no
tool.
"""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import counts
import latency

PROFILE = """\
ob=/program
0x10 5 2
0x14 5
calls=5 0x40
0x18 500 100
0x1c 5
ob=/library
0x10 7 1
"""


class Counts(unittest.TestCase):
    def test_a_called_function_counts_once(self):
        program = counts.Program.__new__(counts.Program)
        program.command, program.kinds = ["/program"], {0x10: "arithmetic", 0x1C: "roots"}
        with tempfile.TemporaryDirectory() as folder:
            profile = Path(folder) / "profile"
            profile.write_text(PROFILE)
            total = program._sum(profile)
        # What stands at the same address of a library is no arithmetic of the program.
        self.assertEqual(dict(total), {"instructions": 22, "loads": 3, "arithmetic": 5, "roots": 5})

    def test_kinds_of_instructions(self):
        for name, pattern in (("mulsd", counts.ARITHMETIC), ("vfmadd231pd", counts.ARITHMETIC),
                              ("subpd", counts.ARITHMETIC), ("divpd", counts.DIVISION), ("sqrtsd", counts.ROOT)):
            self.assertTrue(pattern.match(name), name)
        for name in ("add", "movapd", "unpcklpd", "imul", "comisd"):
            self.assertFalse(any(pattern.match(name) for pattern in (counts.ARITHMETIC, counts.DIVISION, counts.ROOT)),
                             name)


class Latency(unittest.TestCase):
    def test_instructions_out_of_their_place(self):
        self.assertEqual(latency._plain("jne    12f0 <solve+0x40>"), "jne 16")
        self.assertEqual(latency._plain("call   8a0 <solve>"), "nop")
        self.assertEqual(latency._plain("mulsd  0x12(%rip),%xmm0        # 3f0 <limit>"), "mulsd  0x12(%rip),%xmm0")

    def test_a_trace_is_cut_where_calls_begin(self):
        self.assertEqual(latency._calls([3, 1, 2, 3, 1, 2, 2, 1, 3], 1), [[1, 2, 3], [1, 2, 2]])


if __name__ == "__main__":
    unittest.main()
