# SPDX-License-Identifier: MIT OR Apache-2.0
"""The examples and studies with few bodies and steps, judged by what they write: judged.py."""
import os
import subprocess
from pathlib import Path

import pytest
from judged import PARTS, Outcome

from checks import short

TOP = Path(__file__).resolve().parents[2]
SECONDS = 600


@pytest.mark.parametrize(
    "part", [pytest.param(part, id=part.name, marks=[pytest.mark.long] * part.is_long) for part in PARTS])
def test_script(part, check, folder):
    environment = {**os.environ, "OUTPUT": str(folder), **{key: str(value) for key, value in part.environment.items()}}
    done = subprocess.run([str(TOP / part.command[0]), *part.command[1:-1], str(TOP / part.command[-1])], cwd=folder,
                          env=environment, text=True, errors="replace", timeout=SECONDS, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if check.equal(done.returncode, part.status, f"exit status; its last words:\n{short(done.stdout[-2000:], 6)}\n"):
        for text, holds in part.judge(Outcome(folder, done.stdout)):
            check.true(holds, text)
