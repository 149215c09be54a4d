# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE on one, two and three ranks: the same results, one set of files, and a clear end when something fails. Starts
scene.py and the pile of examples/ through scripts/yade_mpi.sh, and judges what they write.
"""
import json
import os
import signal
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).resolve().parent
TOP = HERE.parent.parent
SECONDS = 300


def command(ranks, *words):
    return [str(TOP / "scripts" / "yade_mpi.sh"), str(ranks), "-j1", *map(str, words)]


ENVIRONMENT = dict(os.environ, PYTHONPATH=str(TOP / "tests" / "yade"))


def run(ranks, *words, **environment):
    """(exit status, output) of a script on so many ranks."""
    done = subprocess.run(command(ranks, *words), env={**ENVIRONMENT, **environment}, text=True, timeout=SECONDS,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


def scene(ranks, case, folder, *more):
    return run(ranks, HERE / "scene.py", case, folder, *more)


def sound(check, ranks, case, folder, *more):
    status, text = scene(ranks, case, folder, *more)
    check.true(status == 0, f"{case} on {ranks} ranks ends with {status}:\n{text}")


def report(folder, name):
    return json.loads((folder / f"{name}.json").read_text())


def same(check, folder, expected, found):
    """States of two runs, in sizes and seconds of the scene; it is short enough for rounding not to grow. A contact
    that comes to another rank is solved anew, with the regularisation of flat faces, which moves a point by up to 1e-10
    of the size and is left off while a contact is carried on: spins see it.
    """
    first, second = (np.load(folder / f"{name}.npz") for name in (expected, found))
    for what in ("position", "orientation", "velocity", "angular_velocity"):
        difference = float(np.abs(first[what] - second[what]).max())
        most = 1e-10 if what == "angular_velocity" else 1e-11
        check.true(difference < most, f"{found}: {what} differs from that of {expected} by {difference:.1e}")


@pytest.fixture(scope="module")
def whole():
    """(folder, how each run ended): one scene on 1, 2 and 3 ranks, from which others go on."""
    with tempfile.TemporaryDirectory() as name:
        yield Path(name), [scene(ranks, "whole", Path(name)) for ranks in (1, 2, 3)]


def test_equal_runs(check, whole):
    folder, ends = whole
    for ranks, (status, text) in enumerate(ends, 1):
        check.true(status == 0, f"whole on {ranks} ranks ends with {status}:\n{text}")
    serial = report(folder, "whole1")
    for ranks in (2, 3):
        name = f"whole{ranks}"
        same(check, folder, "whole1", name)
        found = report(folder, name)
        check.true(found["failures"] == [] and found["counters"]["failures"] == 0,
                   f"{name}: failures {found['failures']}")
        contacts = [sum(part[1] for part in run["parts"]) for run in (serial, found)]
        check.true(contacts[0] == contacts[1] > 20, f"{name}: contacts of one process and of all ranks: {contacts}")
        check.true(
            sum(found["counters"]["answers"].values()) == found["counters"]["calls"],
            f"{name}: answers do not add up to calls")
        check.true(
            len(found["full"]) == ranks
            and all("what was there before is left as it was" in told and stays for told, stays in found["full"]),
            f"{name}: what each rank says of a full disk, and whether the file stays: {found['full']}")
    check.true(found["across"] > 20, f"too few contacts across borders for a test of them: {found['across']}")
    # 27 and 9 at the start.
    check.true([part[0] for part in found["parts"]] == [1, 18, 18], f"bodies were not shared out: {found['parts']}")
    check.true(serial["counters"]["calls"] < found["counters"]["calls"], "counters of several workers are not summed")


def test_saved_scenes(check, whole):
    folder = whole[0]
    for ranks, of in ((1, 3), (3, 1)):
        sound(check, ranks, "resumed", folder, of, "whole")
        same(check, folder, "whole1", f"whole_resumed{ranks}_of_{of}")


def test_joints(check, folder):
    for ranks in (1, 2, 3):
        sound(check, ranks, "joints", folder)
    serial = report(folder, "joints1")
    first, last = serial["bonds"][0], serial["bonds"][-1]
    check.true(first[0] > 20 and 0 < last[0] < first[0], f"bonds and broken joints as it goes: {serial['bonds']}")
    for ranks in (2, 3):
        same(check, folder, "joints1", f"joints{ranks}")
        found = report(folder, f"joints{ranks}")
        check.true(found["bonds"] == serial["bonds"],
                   f"bonds on {ranks} ranks: {found['bonds']}, on one {serial['bonds']}")
        check.true(found["failures"] == [], f"joints on {ranks} ranks: failures {found['failures']}")
    check.true(found["across"] > 20, f"too few joints across borders for a test of them: {found['across']}")
    for ranks, of in ((1, 3), (3, 1)):
        sound(check, ranks, "resumed", folder, of, "joints")
        same(check, folder, "joints1", f"joints_resumed{ranks}_of_{of}")
        check.true(
            report(folder, f"joints_resumed{ranks}_of_{of}")["bonds"] == last, f"bonds after a save on {of} ranks")


def test_lonely_workers(check, folder):
    status, text = scene(3, "apart", folder)
    check.true(status == 0 and text.count("meets no other worker") == 2, f"workers apart end with {status}:\n{text}")
    sound(check, 1, "apart", folder)
    same(check, folder, "apart1", "apart3")
    for ranks in (1, 3):
        found = report(folder, f"apart{ranks}")
        pairs, walls = (sum(calls[i] for calls in found["calls"]) for i in (0, 1))
        check.true(found["counters"]["calls"] == pairs + walls and walls > 0,
                   f"counters of {ranks} ranks leave a functor out: {found}")


def test_recorders(check, folder):
    sound(check, 3, "recorders", folder)
    names = {path.name for path in folder.glob("*own-*.vtp")}
    check.true(
        len(names) == 3 and {name[:6]
                             for name in names} == {"rank0.", "rank1.", "rank2."}, f"files of the ranks: {names}")


def test_failures(check, folder):
    for case, words in (("raising", ("rank 1: Traceback", "this worker has had enough")),
                        ("raising_in_step", ("division by zero",))):
        status, text = scene(2, case, folder)
        check.true(status == 1 and all(word in text for word in words),
                   f"{case} ends with {status}, without {words}:\n{text}")
    sound(check, 3, "refusals", folder)
    said = report(folder, "refusals")
    expected = ("1 bodies cannot be divided between 2 workers", "must be above 0",
                "body 36 is free to move and on rank 0")
    check.true(len(said) == 3 and all(words in text for words, text in zip(expected, said)), f"refusals: {said}")


def started(case, folder):
    """A run in the background, once all its ranks have written their process ids."""
    for old in folder.glob("pid*"):
        old.unlink()
    process = subprocess.Popen(command(3, HERE / "scene.py", case, folder), env=ENVIRONMENT, text=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               # Tests in the background of a shell would hand on that they ignore it, which no shell
                               # can undo.
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    end = time.monotonic() + SECONDS
    while time.monotonic() < end and len(list(folder.glob("pid*"))) < 3 and process.poll() is None:
        time.sleep(0.05)
    return process


def test_killed_rank(check, folder):
    """What was saved before is whole, and a run goes on from it."""
    process = started("killed", folder)
    os.kill(int((folder / "pid2").read_text()), signal.SIGKILL)
    text, _ = process.communicate(timeout=SECONDS)
    check.true(process.returncode == 137, f"a run with a killed rank ends with {process.returncode}:\n{text}")
    check.true("rank 2" in text and "ended by signal 9" in text, f"what is said of a killed rank:\n{text}")
    (folder / "killed.yade.gz").rename(folder / "killed_half4.yade.gz")
    sound(check, 3, "resumed", folder, 4, "killed")
    check.true(report(folder, "killed_resumed3_of_4")["step"] == 20 + 200, "the saved scene is that of step 20")


def test_asked_to_stop(check, folder):
    process = started("interrupted", folder)
    process.send_signal(signal.SIGINT)
    text, _ = process.communicate(timeout=SECONDS)
    check.true(process.returncode == 130, f"an interrupted run ends with {process.returncode}:\n{text}")
    check.true((folder / "interrupted.npz").exists(), "an interrupted run writes its results")


@pytest.mark.long
def test_pile(check, folder):
    """A pile is chaotic: what does not depend on how each body fell is compared; the files are those of one process."""
    summaries = []
    for ranks in (1, 3):
        out = folder / f"pile{ranks}"
        status, text = run(ranks, TOP / "examples" / "mpi_pile.py", OUTPUT=str(out), BODIES="30", STEPS="2400")
        check.true(status == 0, f"the pile on {ranks} ranks ends with {status}:\n{text}")
        summary = json.loads((out / "summary.json").read_text())
        check.true(all(row["met"] for row in summary["targets"]), f"the pile on {ranks} ranks: {summary['targets']}")
        check.true(
            sorted(path.name for path in out.glob("*.bodies.*.vtp")) == [
                f"rocks.bodies.{step:07d}.vtp" for step in range(0, 2401, 240)
            ], f"frames of {ranks} ranks: {list(out.glob('*.vtp'))}")
        check.true((out / "rocks.png").stat().st_size > 10_000, "the picture")
        summaries.append(summary)
    one, three = summaries
    for what, tolerance in (("mean_height_m", 0.1), ("contacts", 0.5)):
        check.true(
            abs(one[what] - three[what]) < tolerance * one[what], f"{what} of a pile: {one[what]} and {three[what]}")
    status, text = run(3, TOP / "examples" / "mpi_pile.py", OUTPUT=str(folder / "pile3"), BODIES="30", STEPS="2450",
                       RESUME="1")
    resumed = json.loads((folder / "pile3" / "summary.json").read_text())
    check.true(status == 0 and (resumed["first_step"], resumed["steps"]) == (2400, 2450),
               f"a resumed pile ends with {status}:\n{text}")
