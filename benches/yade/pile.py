# SPDX-License-Identifier: MIT OR Apache-2.0
"""One run for benches/threads.py: lets pyramids fall and saves them, or takes a saved scene further.

    BODIES=200 STEPS=6000 SCENE=pile.yade.gz yade -x -n -j2 benches/yade/pile.py
    SCENE=pile.yade.gz RESULT=result.json yade -x -n -j1 benches/yade/pile.py

The second form steps the scene BLOCKS times by BLOCK_STEPS and writes the times of every block and
the state at the end.
"""

import json
import os
import sys
from pathlib import Path

STUDIES = Path(sys.argv[0]).resolve().parent.parent.parent / "studies"
sys.path.insert(0, str(STUDIES))

import potential_particles
import yade
from yade import O

import pyramids
from bodies import reach
from box import Box
from contact_functor import LIBRARY, ContactFunctor
from loose_grid import loose_grid
from progress import Progress
from pyramid import pyramid
from stepping import advance

# So short that the machine leaves some of them alone.
BLOCKS, BLOCK_STEPS = 300, 2


def settle(count, steps, scene):
    """The pile of studies/pyramids.py with another number of bodies."""
    shape = pyramid(pyramids.SIZE)
    grid = loose_grid(count, reach(shape), pyramids.JITTER, pyramids.SEED)
    half_width = grid.half_width + 0.3 * grid.height
    box = Box(half_width, half_width, grid.height + pyramids.SIZE, thickness=pyramids.SIZE)
    pyramids.build_scene(ContactFunctor(LIBRARY), shape, grid, box)
    progress = Progress(steps)
    for stop in range(min(steps, 100), steps + 1, 100):
        advance(stop)
        progress.update(stop)
    progress.close()
    potential_particles.save(scene)


def measure(scene, result):
    """Times of blocks of steps, counts of the functor, and where everybody is at the end."""
    O.load(scene)
    O.timingEnabled = True
    loop = next(engine for engine in O.engines if isinstance(engine, yade.InteractionLoop))
    functor = loop.geomDispatcher.functors[0]
    advance(O.iter + 20)
    start = O.iter
    blocks = []
    for block in range(BLOCKS):
        functor.resetCounters()
        for engine in O.engines:
            engine.execTime = 0
        advance(start + (block + 1) * BLOCK_STEPS)
        seconds = 1e-9 * sum(engine.execTime for engine in O.engines)
        blocks.append({"steps": seconds, "loop": 1e-9 * loop.execTime, "functor": functor.busiestSeconds})
    bodies = [body.state for body in O.bodies]
    Path(result).write_text(
        json.dumps(
            {
                "threads": O.numThreads,
                "bodies": sum(not state.blockedDOFs for state in bodies),
                "pairs": functor.calls / BLOCK_STEPS,
                "contacts": functor.overlapping / BLOCK_STEPS,
                "skipped": functor.skippedShare,
                "failures": functor.failures,
                "block_steps": BLOCK_STEPS,
                "blocks": blocks,
                "positions": [tuple(state.pos) for state in bodies],
                "orientations": [tuple(state.ori) for state in bodies],
            }
        )
    )


if "RESULT" in os.environ:
    measure(os.environ["SCENE"], os.environ["RESULT"])
else:
    settle(int(os.environ["BODIES"]), int(os.environ["STEPS"]), os.environ["SCENE"])
