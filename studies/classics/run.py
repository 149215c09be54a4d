#!/usr/bin/python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""The classics of blocks: cases with a closed form, each in YADE, two at a time.

    make classics            (or: studies/classics/run.py)

Environment: CASES (all, short for a little of each, or names, separated by commas), OUTPUT (out/classics), LAW (point,
or joint: contact patches). Results: a table on the terminal and in table.md; classics.png; summary.json.
docs/classics.md explains them. Ctrl-C keeps what is done.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import settings
from pictures import draw
from progress import Progress
from summary import made, write_summary
from table import markdown, print_all

# In the order of the page and the table: about how many seconds each takes.
SECONDS = {
    "incline": 25,
    "sliding": 3,
    "newmark": 8,
    "rocking": 6,
    "arch": 200,
    "overhang": 100,
    "toppling": 80,
    "key_block": 20,
    "rolling": 4,
    "tumbling": 15,
    "twist": 2,
}  # fmt: skip
SHORT_SECONDS = 3
AT_ONCE = 2
PART = re.compile(r"part (\w+) ([\d.]+)")


class Run:
    """Processes of YADE, two at a time: one a case, the longest first; or two for all, if a little of each is enough.
    """

    def __init__(self, names, short, scratch):
        self.names, self.short, self.scratch = names, short, scratch
        self.seconds = {name: SHORT_SECONDS if short else SECONDS[name] for name in names}
        self.done = dict.fromkeys(names, 0.0)
        self.results, self.failures, self.processes = {}, {}, []
        self.lock, self.stopped = threading.Lock(), False
        self.progress = Progress(1000, unit="part")

    def go(self):
        """True if Ctrl-C came before the end."""
        pool = ThreadPoolExecutor(AT_ONCE)
        longest = sorted(self.names, key=lambda name: -SECONDS[name])
        groups = [longest[i::AT_ONCE] for i in range(AT_ONCE)] if self.short else [[name] for name in longest]
        jobs = [pool.submit(self._cases, group) for group in groups if group]
        try:
            while not all(job.done() for job in jobs):
                time.sleep(0.2)
                self._show()
        except KeyboardInterrupt:
            self.stop()
        finally:
            pool.shutdown(cancel_futures=True)
            self._show()
            self.progress.close()
        for job in jobs:
            if not job.cancelled():
                job.result()
        return self.stopped

    def stop(self):
        """Ends the processes that run; the rest does not start."""
        with self.lock:
            self.stopped = True
            for process in self.processes:
                process.terminate()

    def _show(self):
        whole = sum(self.seconds.values())
        self.progress.update(int(1000 * sum(self.done[name] * self.seconds[name] for name in self.names) / whole))

    def _cases(self, names):
        environment = dict(os.environ, CASES=",".join(names), OUTPUT=self.scratch, SHORT="1" if self.short else "0")
        command = [str(HERE.parents[1] / "scripts" / "yade.sh"), "-j1", str(HERE / "one.py")]
        with self.lock:
            if self.stopped:
                return
            # In a session of its own: Ctrl-C is for this program, which ends it.
            process = subprocess.Popen(
                command, env=environment, text=True, cwd=self.scratch, start_new_session=True,
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            )  # fmt: skip
            self.processes.append(process)
        said = []
        for line in process.stdout:
            if found := PART.match(line):
                self.done[found[1]] = min(1.0, float(found[2]))
            else:
                said.append(line)
        process.wait()
        for name in names:
            output = Path(self.scratch) / f"{name}.json"
            if output.exists():
                self.done[name] = 1.0
                self.results[name] = json.loads(output.read_text())
            elif not self.stopped:
                self.failures[name] = "".join(said[-30:])


def main():
    """From environment to summary."""
    started = time.perf_counter()
    names, short = chosen()
    out = settings.folder("OUTPUT", HERE.parents[1] / "out" / "classics").resolve()
    out.mkdir(parents=True, exist_ok=True)
    for old in ("classics.png", "table.md", "summary.json"):
        (out / old).unlink(missing_ok=True)
    print(f"{len(names)} cases of blocks, each against its closed form", flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        run = Run(names, short, scratch)
        interrupted = run.go()
    if interrupted:
        print("interrupted: drawing and summing up what there is", flush=True)
    results = {name: run.results[name] for name in names if name in run.results}
    summary = summed_up(results, run.failures, interrupted, time.perf_counter() - started)
    write_summary(out / "summary.json", summary)
    (out / "table.md").write_text(markdown(results, summary))
    if results:
        draw(out / "classics.png", results)
    print_all(results, summary, out)
    for name, said in run.failures.items():
        print(f"\n{name} ended without a result:\n{said}")
    if interrupted:
        raise SystemExit(130)
    if run.failures:
        raise SystemExit(f"Without a result: {', '.join(run.failures)}.")


def chosen():
    """Names of the cases, and whether a little of each is enough."""
    text = os.environ.get("CASES", "").strip() or "all"
    if text in ("all", "short"):
        return list(SECONDS), text == "short"
    names = [name.strip() for name in text.split(",")]
    if unknown := [name for name in names if name not in SECONDS]:
        raise SystemExit(f"CASES={text}: there is no {unknown[0]!r}; give all, short, or some of {', '.join(SECONDS)}.")
    return [name for name in SECONDS if name in names], False


def summed_up(results, failures, interrupted, seconds):
    """What summary.json holds."""
    targets = [one for result in results.values() for one in result["targets"]]
    return {
        "interrupted": interrupted,
        "targets": targets,
        "all_met": bool(targets) and not failures and all(one["met"] for one in targets),
        "cases": {
            name: {key: result[key]
                   for key in ("title", "rows", "wall_seconds")}
            for name, result in results.items()
        },
        "failed": failures,
        "wall_seconds": seconds,
        "processes": AT_ONCE,
        "versions": next((result["versions"] for result in results.values()), {}),
        **made("make classics"),
    }


if __name__ == "__main__":
    main()
