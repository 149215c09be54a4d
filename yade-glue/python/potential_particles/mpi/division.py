# SPDX-License-Identifier: GPL-3.0-or-later
"""Which worker gets which bodies.

YADE's own decomposition leaves walls, boxes and facets on rank 0 and knows no floor made of a particle, so that
it would give floor and walls to a worker. This one divides the bodies that it is given.
"""
import numpy as np
import yade

from .ranks import ranks


def divide(ids, axes=(0, 1)):
    """Gives all workers equal numbers of the bodies `ids`, to within one, in boxes that lie side by side.

    axes: along which the bodies may be divided. By default not along z: in a pile the upper bodies fall and the lower
    ones carry, and a worker that had only the former would wait for the others. To be called on rank 0. All other
    bodies stay on
    rank 0, which computes nothing but their motion: forces on them come from the workers.
    """
    workers = ranks() - 1
    for body in yade.O.bodies:
        body.subdomain = 0
    if workers == 0:
        return
    if len(ids) < workers:
        raise ValueError(f"{len(ids)} bodies cannot be divided between {workers} workers: start fewer ranks")
    positions = np.array([tuple(yade.O.bodies[i].state.pos) for i in ids])
    for worker, part in enumerate(parts(positions, workers, list(axes)), start=1):
        for index in part:
            yade.O.bodies[ids[index]].subdomain = worker


def parts(positions, count, axes):
    """Indices of the positions in `count` parts: halved, or as near to it as `count` allows, across their widest axis.
    """
    return list(_parts(positions, np.arange(len(positions)), count, axes))


def _parts(positions, indices, count, axes):
    if count == 1:
        yield [int(index) for index in indices]
        return
    here = positions[indices]
    axis = max(axes, key=lambda axis: np.ptp(here[:, axis]))
    order = indices[np.argsort(here[:, axis], kind="stable")]
    low = count // 2
    cut = round(len(order) * low / count)
    yield from _parts(positions, order[:cut], low, axes)
    yield from _parts(positions, order[cut:], count - low, axes)
