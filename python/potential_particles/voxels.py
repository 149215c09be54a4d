# SPDX-License-Identifier: MIT OR Apache-2.0
"""Grains of a labelled image of voxels (micro-tomography) as particles that stand where the grains are."""
import os
import sys
import time

import numpy as np

from . import fitting
from .arguments import LARGE, needed, positive, whole
from .packing import Placement
from .progress import Bar
from .polyhedron import Polyhedron
from .rounding import SPHERICITY, Rounding


class Grains(list):
    """Placements of the grains of an image, in place; `left_out` says why a label has none: {label: reason}."""

    def __init__(self, placements, left_out):
        super().__init__(placements)
        self.left_out = left_out

    def __repr__(self):
        """One line; the placements are its items."""
        if not self:
            return f"<Grains: none, {len(self.left_out)} labels left out>"
        planes, largest, mean = (np.array(column)
                                 for column in zip(*((len(one.shape.planes), one.shape.fit.largest, one.shape.fit.mean)
                                                     for one in self)))
        return (
            f"<Grains: {len(self)} of {planes.min()} to {planes.max()} planes, off their surfaces by {np.median(mean):.2g} of the diameter in the mean "
            f"(median) and {largest.max():.2g} at most, volume {sum(one.shape.volume for one in self):.4g}, {len(self.left_out)} left out>"
        )


def from_voxels(labels, spacing=1.0, planes=30, error=None, rounding=None, k=SPHERICITY, least=64, border=True,
                progress=True, *, r=None):
    """One particle for each label of an image, in place: a list of Placement for add_packing.

    labels: an array of whole numbers [z, y, x], as stacks of pictures are read, or a .tif file of such pages; 0 is what
    lies between grains. The voxel [0, 0, 0] is a cube of edge `spacing` (length) with a corner at the origin. planes,
    error, rounding, k, r: as for shapes.from_mesh; the volume is that of the voxels. least: labels of fewer voxels are
    left out; border=False: those that touch the border of the image as well. What is left out, or has no convex
    particle near to it, is said with its reason in `left_out`. `shape.fit` of each has its distances from the centres
    of the faces of its voxels. Ctrl-C keeps what is made. About 30 ms for a grain of 30 planes. ValueError for what is
    no such image.
    """
    image = voxel_image(labels)
    spacing, least = positive(spacing, "spacing"), whole(least, 8, LARGE, "least")
    begin, made, left_out, stopped = time.monotonic(), [], {}, ""
    ndimage = needed("scipy.ndimage", "scipy")
    # ndimage.find_objects makes a list as long as the largest label.
    names, shape = None, image.shape
    if image.max() > image.size:
        names, image = np.unique(np.append(image, 0), return_inverse=True)
        image = image[:-1].reshape(shape)
    boxes = [(number + 1, box) for number, box in enumerate(ndimage.find_objects(image)) if box is not None]
    if not boxes:
        raise ValueError("labels holds no grain: all its voxels are 0")
    try:
        for number, box in _with_bar(boxes, progress):
            grain, label = image[box] == number, number if names is None else int(names[number])
            count = int(np.count_nonzero(grain))
            if count < least:
                left_out[label] = f"{count} voxels, fewer than {least}"
            elif not border and any(side.start == 0 or side.stop == length for side, length in zip(box, image.shape)):
                left_out[label] = "touches the border of the image"
            else:
                faces = (_faces(grain) + [side.start for side in box])[:, ::-1] * spacing
                try:
                    shape = fitting.of_surface(Polyhedron.of_points(faces), faces, count * spacing**3,
                                               Rounding(rounding, k, r), f"grain {label}", planes, error)
                    made.append(Placement(shape, 1.0, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)))
                except ValueError as why:
                    left_out[label] = str(why)
    except KeyboardInterrupt:
        stopped = f"; stopped by Ctrl-C before {len(boxes) - len(made) - len(left_out)} of them"
    grains = Grains(made, left_out)
    if progress:
        print(f"{grains} in {time.monotonic() - begin:.1f} s{stopped}", file=sys.stderr)
    return grains


def _with_bar(boxes, progress):
    bar = Bar(len(boxes), progress, "grains", "fitting")
    try:
        for number, box in enumerate(boxes):
            yield box
            bar.reached(number + 1)
    finally:
        bar.close()


def voxel_image(labels):
    """Labels [z, y, x] as an array of 32-bit numbers, from an array or a .tif file; ValueError for what is none."""
    if isinstance(labels, (str, os.PathLike)):
        labels = _pages(os.fspath(labels))
    image = np.asarray(labels)
    if image.ndim != 3 or image.size == 0:
        raise ValueError(f"labels has the shape {image.shape}: an image of voxels has three axes, z, y, x")
    if image.dtype.kind == "f" and (image == np.floor(image)).all() or image.dtype.kind == "b":
        image = image.astype(np.int64)
    if image.dtype.kind not in "iu":
        raise ValueError(
            f"labels holds {image.dtype}: labels are whole numbers, one for each grain (scipy.ndimage.label makes them)"
        )
    if image.min() < 0 or image.max() > 2**31 - 1:
        raise ValueError(f"labels range from {image.min()} to {image.max()}: they must lie between 0 and 2147483647")
    return image.astype(np.int32, copy=False)


def _pages(file):
    """All pages of a .tif file as an array [page, row, column]."""
    Image, ImageSequence = needed("PIL.Image", "pillow"), needed("PIL.ImageSequence", "pillow")
    if not os.path.isfile(file):
        raise ValueError(f"{file} is no file")
    try:
        with Image.open(file) as image:
            if image.format != "TIFF":
                raise ValueError(f"it is a {image.format} picture")
            pages = [np.array(page) for page in ImageSequence.Iterator(image)]
    # Of damaged files Pillow raises what its parts happen to raise: KeyError, struct.error, TypeError, MemoryError ...
    except Exception as error:
        raise ValueError(
            f"{file} cannot be read as .tif: {' '.join(f'{type(error).__name__}: {error}'.split())[:100]}") from None
    shapes = {page.shape for page in pages}
    if len(shapes) > 1 or len(pages[0].shape) != 2:
        raise ValueError(
            f"{file}: its {len(pages)} pages have the shapes {sorted(shapes)}: labels are pages of one size with one number a pixel"
        )
    return np.stack(pages)


def _faces(grain):
    """Centres (n, 3) of the faces of the voxels between a grain and what is none, in voxels from the corner of its box.
    """
    padded = np.pad(grain, 1).astype(np.int8)
    found = []
    for axis in range(3):
        steps = np.argwhere(np.diff(padded, axis=axis))
        # Between voxels i and i + 1 of the padded box: i voxels from the corner of the box itself.
        places = steps - 0.5
        places[:, axis] += 0.5
        found.append(places)
    return np.concatenate(found)
