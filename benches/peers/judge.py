# SPDX-License-Identifier: MIT OR Apache-2.0
"""Errors of answers, each against the exact answer of the contestant's own problem."""

import numpy as np

from pairs import LYING, NEAR_BY, TOUCHING, exact

SETTLED = "@1e-14"  # our own answers in extended precision, whose bound is proved
DOUBTFUL = 1e-7  # of the size: an overlap below it is no contact that must be found


class Judge:
    """Of one group; `settled(formulation)` gives our extended answers."""

    def __init__(self, group, settled):
        self.group, self.settled = group, settled
        self.kept = {}

    def errors(self, contestant, answers):
        """Counts of pairs, failures and wrong answers, median and worst error of the rest, and what that error is of.
        """
        errors, failed, wrong = [], 0, 0
        for pair, answer in enumerate(answers):
            if answer is None or any(value is None for value in answer) and contestant.way != "intersection":
                failed += 1
                continue
            truth = self.truth(contestant, pair)
            if contestant.work == "contact" and bool(answer) != (truth > 0):
                wrong += abs(truth) > DOUBTFUL
                continue
            if answer and contestant.way != "intersection":
                errors.append(abs(answer[0] - truth))
        return {
            "pairs": len(answers),
            "failed": failed,
            "wrong": int(wrong),
            "median_error": float(np.median(errors)) if errors else None,
            "worst_error": float(max(errors)) if errors else None,
            "error_of": "distance" if contestant.work == "distance" else "overlap",
        }

    def truth(self, contestant, pair):
        """Overlap, or minus the distance; 0 or less: apart."""
        if contestant.ours or contestant.way == "potential":
            if self.group.place not in (TOUCHING, LYING):
                return -1.0
            formulation = "closest" if contestant.way == "closest" else "midway"
            if formulation not in self.kept:
                self.kept[formulation] = self.settled(formulation)
            answer = self.kept[formulation][pair]
            return answer[0] if answer else -1.0
        if pair not in self.kept:
            self.kept[pair] = self.depth(pair)
        return self.kept[pair]

    def depth(self, pair):
        return exact(self.group, pair) if self.group.place in (TOUCHING, LYING, NEAR_BY) else -1.0
