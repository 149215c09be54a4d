# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of potential particles on several processes, through YADE's own module mpy.

    from potential_particles import mpi

    def main():
        if mpi.rank() == 0:
            ids = build()                       # bodies and O.engines, as for one process
            mpi.safe_boxes(verlet_distance)
            mpi.divide(ids)                     # all others, floor and walls, stay on rank 0
        mpi.run(10_000)
        counters = mpi.counters()
        if mpi.rank() == 0:
            print(counters)

    mpi.launch(main)

Start it with `mpirun -np 3 yade -x -n -j1 script.py`, or scripts/yade_mpi.sh 3 script.py: rank 0 holds the
bodies that do not move, the other ranks, called workers, divide the others between them. Every rank
executes the script; functions marked "collective" must be called by all ranks. With one rank the same script
is an ordinary serial run.

    ranks.py     who is who; the start and the end of a script; gathering
    boxes.py     bounding boxes that stay right while bodies turn
    division.py  which worker gets which bodies
    splitting.py the first division of a scene
    balance.py   bodies that change their worker
    joints.py    what bodies hold by joints, across borders
    stepping.py  steps, and what can go wrong in them
    results.py   bodies, contacts, counters and failures of all workers
    saving.py    one file with the whole scene
"""
from .boxes import safe_boxes
from .division import divide
from .ranks import gather, interrupted, launch, rank, ranks
from .results import counters, failures, owned_bodies, owned_contacts, states
from .saving import load, save
from .stepping import run

__all__ = [
    "counters", "divide", "failures", "gather", "interrupted", "launch", "load", "owned_bodies",
    "owned_contacts", "rank", "ranks", "run", "safe_boxes", "save", "states",
]
