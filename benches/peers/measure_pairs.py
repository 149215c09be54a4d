# SPDX-License-Identifier: MIT OR Apache-2.0
"""Time and error of each contestant on the same pairs. All take turns in short batches, and of each the fastest batch
counts.
"""

import json
import os
import subprocess

import install
import pairs
from contestants import BULLET, COAL, CONTESTANTS, OURS, PARRY, YADE, Server
from judge import SETTLED, Judge
from pairs import FAR, LYING, NEAR_BY, OVERLAP, POTENTIAL, ROUNDED, SHARP, TOUCHING

SEED = 2012
PLANES = (4, 5, 12, 20, 100, 1000)
CURVE_GROUPS = ("5-potential-touching", "5-sharp-touching", "100-potential-touching")
CURVES = {
    (OURS, "midway"): ("1e-2", "1e-4", "1e-6", "1e-8", "1e-10", "1e-12", "1e-14"),
    (COAL, "contact"): ("1e-1", "1e-2", "1e-3", "1e-4", "1e-6", "1e-8", "1e-10"),
}


class Effort:
    def __init__(self, quick):
        # Many batches, so short that some of them have a core to themselves.
        self.rounds, self.seconds = (2, 2e-3) if quick else (15, 2e-3)
        self.pairs, self.many = (10, 4) if quick else (100, 30)
        self.planes = (5, 100) if quick else PLANES
        self.slow_rounds = 1 if quick else 2


def named_groups(effort):
    """(planes, edges, place) of every group."""
    wanted = [(n, edges, TOUCHING) for n in effort.planes for edges in (SHARP, ROUNDED, POTENTIAL)]
    wanted += [(n, edges, LYING) for n in effort.planes if n in (5, 12) for edges in (SHARP, ROUNDED, POTENTIAL)]
    wanted += [(n, edges, NEAR_BY) for n in effort.planes if n in (5, 100, 1000) for edges in (SHARP, POTENTIAL)]
    return wanted + [(n, SHARP, FAR) for n in effort.planes if n in (5, 1000)]


class Measurement:
    """The groups, written for both kinds of rounding, and the contestants that are there."""

    def __init__(self, found, effort):
        self.effort = effort
        made = [
            pairs.group(*name, effort.pairs if name[0] < 1000 else effort.many, SEED) for name in named_groups(effort)
        ]
        self.groups = {one.name: one for one in made}
        swept, potential = install.OUT / "pairs.txt", install.OUT / "pairs_potential.txt"
        pairs.write(made, swept)
        lines = subprocess.run([install.program("placed"), swept, repr(OVERLAP)], check=True, capture_output=True,
                               text=True).stdout.splitlines()
        moved = [
            pairs.moved(one, pairs.shifts_of(one, json.loads(line.replace("NaN", "0"))))
            for one, line in zip(made, lines)
        ]
        pairs.write(moved, potential)
        self.servers = {
            name: Server([*found.commands[name], potential if name == OURS else swept])
            for name in (OURS, PARRY, COAL, BULLET)
            if name in found.commands
        }
        if YADE in found.commands:
            environment = {"PAIRS": str(potential), "HERE": str(install.HERE), "OMP_NUM_THREADS": "1"}
            self.servers[YADE] = Server(found.commands[YADE], environment)

    def rows(self):
        """One dictionary for each contestant, group and warmth."""
        rows = []
        for number, group in enumerate(self.groups.values()):
            print(f"  {number + 1:>2} of {len(self.groups)}: {group.name}, {len(group.poses_a)} pairs", flush=True)
            entries = [(one, warmth) for one in self.present() if one.takes(group) for warmth in one.warmths]
            times = self.race(group, entries)
            judge = Judge(group, lambda formulation: self.answers(OURS, group, formulation + SETTLED))
            for (one, warmth), seconds in zip(entries, times):
                rows.append(self.row(group, one, warmth, seconds, judge))
        return rows

    def present(self):
        return [one for one in CONTESTANTS if one.program in self.servers]

    def race(self, group, entries):
        """Seconds a call, the fastest batch of each; None of those that gave no answer."""
        best, self.why = [float("inf")] * len(entries), {}
        for turn in range(self.effort.rounds):
            for index, (one, warmth) in enumerate(entries):
                slow = one.program == YADE or one.way == "cone_program"
                if best[index] is None or slow and turn >= self.effort.slow_rounds:
                    continue
                try:
                    found = self.servers[one.program].ask("time", group.name, one.way, warmth,
                                                                  self.effort.seconds)
                    best[index] = min(best[index], found)
                except (RuntimeError, OSError) as error:
                    print(f"      {one.label}: {error}", flush=True)
                    best[index], self.why[one] = None, str(error)
        return best

    def row(self, group, one, warmth, seconds, judge):
        row = {
            "group": group.name, "planes": group.planes, "edges": group.edges, "place": group.place, "warmth": warmth,
            "program": one.program, "way": one.way, "label": one.label, "work": one.work, "rival": one.rival,
            "microseconds": None if seconds is None else 1e6 * seconds, "why": self.why.get(one),
        }
        if seconds is not None:
            row.update(judge.errors(one, self.answers(one.program, group, one.way, warmth)))
        return row

    def answers(self, program, group, way, warmth="cold"):
        return self.servers[program].ask("answers", group.name, way, warmth)

    def curves(self):
        """Time and error over a tolerance, of those who have one."""
        found = []
        for name in CURVE_GROUPS:
            group = self.groups.get(name)
            if group is None:
                continue
            judge = Judge(group, lambda formulation: self.answers(OURS, group, formulation + SETTLED))
            for (program, way), tolerances in CURVES.items():
                one = next((one for one in self.present() if (one.program, one.way) == (program, way)), None)
                for tolerance in tolerances if one else ():
                    for warmth in ("cold", "warm"):
                        asked = f"{way}@{tolerance}"
                        server = self.servers[program]
                        times = [
                            server.ask("time", name, asked, warmth, self.effort.seconds)
                            for _ in range(self.effort.rounds // 3 + 1)
                        ]
                        errors = judge.errors(one, self.answers(program, group, asked, warmth))
                        found.append({
                            "group": name, "label": one.label, "tolerance": float(tolerance), "warmth": warmth,
                            "microseconds": 1e6 * min(times), **errors,
                        })
        return found

    def stop(self):
        for server in self.servers.values():
            server.stop()


def load():
    """Other work during the measurement: the mean load of a minute over the processors."""
    return os.getloadavg()[0] / (os.cpu_count() or 1)
