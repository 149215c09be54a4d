# SPDX-License-Identifier: MIT OR Apache-2.0
"""Slicing, and the blocks that it makes, as arrays."""
import dataclasses
import functools
import math
import os
import sys
import typing

import numpy as np

from .._core import _slicing
from ..arguments import LARGE, number, whole, within
from ..progress import Bar, Interrupts
from .domain import Domain, convex
from .joints import Joint, JointSet

# What a face lies on.
OF_DOMAIN, OF_JOINT, OF_REGION = range(3)

# A face, or a part of it, this much smaller than the whole is none.
LEAST_SHARE = 1e-8


@dataclasses.dataclass(frozen=True)
class Block:
    """One block of a RockMass: volume, centroid (3,), inertia (3, 3) about it for density 1, planes (n, 4) with unit
    outward normals and offsets from the origin, corners (m, 3), all in the axes of the domain; the faces are those of
    the mass with these numbers.
    """

    number: int
    volume: float
    centroid: np.ndarray
    inertia: np.ndarray
    planes: np.ndarray
    corners: np.ndarray
    faces: np.ndarray


@dataclasses.dataclass(eq=False)
class RockMass:
    """Blocks and their faces as numpy arrays, one row each; mass[i] is a Block, len(mass) their number.

    blocks: volume, centroid, inertia (xx, yy, zz, xy, yz, zx for density 1), parent, region (-1: none) ...
    faces: block, area, jointed_area (within the true extent of the joint, a disc or polygon; what else of the face was
    rock), plane (unit outward normal, offset), `of` (0: a plane of the domain, 1: a joint, 2: a plane of a region),
    index (of that plane or joint), region (of slice(); 2**32 - 1 for what the domain leaves out) ...
    partners: pairs of faces that lie on each other, with the area that they share.
    joints: the Joints that have cut; set_of_joint: for each, the number of its entry in the `joints` of slice().
    missing: numbers of joints that met no block. too_small, unclosed: cuts that were left out because of the limits, or
        of rounding.
    complete: False if Ctrl-C ended the cuts before the last joint. planes: number of planes of the domain.
    """

    blocks: np.ndarray
    faces: np.ndarray
    corners: np.ndarray
    partners: np.ndarray
    joints: list
    set_of_joint: np.ndarray
    missing: np.ndarray
    too_small: int
    unclosed: int
    complete: bool
    planes: int

    def __len__(self):
        return len(self.blocks)

    def __repr__(self):
        return f"<RockMass: {len(self):,} blocks by {len(self.joints):,} joints, {self.volume:.4g} in volume>"

    def __getitem__(self, number):
        row = self.blocks[number]
        number = int(number) % len(self)
        faces = np.arange(row["first_face"], row["first_face"] + row["face_count"]).astype(int)
        xx, yy, zz, xy, yz, zx = row["inertia"]
        corners = np.concatenate([self.outline(face) for face in faces])
        return Block(number, float(row["volume"]), row["centroid"],
                     np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]), self.faces["plane"][faces],
                     np.unique(corners, axis=0), faces)

    @property
    def volume(self):
        """Of all blocks."""
        return float(self.blocks["volume"].sum())

    def outline(self, face):
        """Corners (n, 3) of a face, counter-clockwise from outside."""
        first = int(self.faces["first_corner"][face])
        return self.corners[first:first + int(self.faces["corner_count"][face])]

    @functools.cached_property
    def set_of_face(self):
        """For each face the number of its joint's entry in the `joints` of slice(), -1 for what is no joint."""
        return np.where(
            self.faces["of"] == OF_JOINT,
            np.append(self.set_of_joint, -1)[np.minimum(self.faces["index"].astype(int), len(self.set_of_joint))], -1)

    def on_domain(self, planes):
        """Which blocks have a face on one of these planes of the domain (numbers; a single one, too), (blocks,) of
        bool.
        """
        return self._blocks_of(self.faces_on(planes))

    def faces_on(self, planes):
        """Which faces lie on one of these planes of the domain, (faces,) of bool."""
        return (self.faces["of"] == OF_DOMAIN) & np.isin(self.faces["index"].astype(int),
                                                         planes_of(self, planes, "planes"))

    def faces_of(self, sets):
        """Which faces are on joints of these entries of the `joints` of slice(), (faces,) of bool."""
        return np.isin(self.set_of_face, np.atleast_1d(sets)) & (self.faces["of"] == OF_JOINT)

    def inside(self, region):
        """Which blocks lie in this region (its number among the `regions` of slice()), (blocks,) of bool."""
        return self.blocks["region"] == whole(region, 0, LARGE, "region")

    @functools.cached_property
    def pieces(self):
        """For each block the number of the piece of rock to which it belongs: blocks that regions alone have parted,
        and that still touch, are one.
        """
        first, second = self._partner_blocks
        parents, regions = self.blocks["parent"], self.blocks["region"]
        of_region = self.faces["of"][self.partners["faces"][:, 0].astype(int)] == OF_REGION
        glued = of_region & (parents[first] == parents[second]) & (regions[first] == regions[second])
        first, second = first[glued], second[glued]
        # Each block takes the least number of those that it is glued to.
        least, before = np.arange(len(self)), None
        while not np.array_equal(least, before):
            before = least.copy()
            np.minimum.at(least, first, least[second])
            np.minimum.at(least, second, least[first])
            least = least[least]
        return np.unique(least, return_inverse=True)[1].ravel()

    @property
    def blocks_of_pieces(self):
        """The numbers of the blocks of each piece, in the order of pieces."""
        order = np.argsort(self.pieces, kind="stable")
        return np.split(order, np.flatnonzero(np.diff(self.pieces[order])) + 1)

    @property
    def _partner_blocks(self):
        return self.faces["block"].astype(int)[self.partners["faces"].astype(int).T]

    def _blocks_of(self, faces):
        marked = np.zeros(len(self), bool)
        marked[self.faces["block"][faces].astype(int)] = True
        return marked

    def _with(self, kept):
        """The same with some of its blocks alone, (blocks,) of bool."""
        new_block = np.cumsum(kept) - 1
        faces = kept[self.faces["block"].astype(int)]
        new_face = np.cumsum(faces) - 1
        blocks, left = self.blocks[kept].copy(), self.faces[faces].copy()
        left["block"] = new_block[left["block"].astype(int)]
        blocks["first_face"] = new_face[blocks["first_face"].astype(int)]
        pairs = self.partners[faces[self.partners["faces"].astype(int)].all(1)].copy()
        pairs["faces"] = new_face[pairs["faces"].astype(int)]
        return dataclasses.replace(self, blocks=blocks, faces=left, partners=pairs)


def slice(domain, joints, regions=(), least_volume=0.0, least_thickness=0.0, least_width=0.0, largest_aspect=math.inf,
          most_blocks=1_000_000, threads=None, progress=True):
    """Cuts a Domain by joints, in their order, into a RockMass (Boon, Houlsby & Utili 2015, Computers and Geotechnics
    65).

    joints: JointSets, Joints and lists of Joints. A joint cuts each block that it meets in two, a disc or polygon all
        of a block that it reaches.
    regions: convex Domains, as the steps of an excavation, that cut the blocks that they meet, after all joints;
    `inside` tells which blocks lie in one. What `domain` leaves out is taken out.
    least_volume: a joint leaves a block whole if a part would be smaller than this (length^3), or thinner than
    least_thickness in the mean, 2V/A of volume and surface (length): of a wide slab its thickness, of a cube a third of
    its edge; or the largest ball in it has a diameter below least_width (length), or its extent along x, y or z is more
    than largest_aspect times that diameter, as the paper has it. Such cuts are counted.
    most_blocks: more are a ValueError. threads: that cut, None for one on each processor; the blocks are the same for
        any number. progress: a bar on a terminal. Ctrl-C ends the cuts, and the blocks made so far are returned.
    """
    if not isinstance(domain, Domain):
        raise ValueError(f"domain is {type(domain).__name__}, not a rock.Domain: Domain.box(lower, upper) makes one")
    regions = convex(regions)
    for region in regions:
        region.ball()  # raises where it is empty or open
    limits = {
        "least_volume": _not_negative(least_volume, "least_volume"),
        "least_thickness": _not_negative(least_thickness, "least_thickness"), "least_width": _not_negative(
            least_width, "least_width"), "largest_aspect": math.inf if largest_aspect == math.inf else within(
                largest_aspect, 1.0, math.inf, "largest_aspect"),
        "threads": len(os.sched_getaffinity(0)) if threads is None else whole(threads, 1, 1024, "threads"),
        "most_blocks": whole(most_blocks, 1, LARGE, "most_blocks")
    }
    centre, reach = domain.ball()
    cutting, numbers = [], []
    for entry, given in enumerate([joints] if isinstance(joints, (JointSet, Joint)) else _listed(joints, "joints")):
        made = _joints_of(given, entry, centre, reach)
        cutting += made
        numbers += [entry] * len(made)
    cuts = [_cut(number, one) for number, one in enumerate(cutting)]
    cut_out = [one.planes for one in (*domain.left_out, *regions)]
    with _Report(len(cutting), progress) as report:
        cut = _slicing.slice(domain.planes, cuts, regions=cut_out, progress=report.told, **limits)
    done = cut.joints
    blocks, faces, partners, corners = cut.arrays()
    mass = RockMass(blocks=blocks, faces=faces, corners=corners, partners=partners, joints=cutting[:done],
                    set_of_joint=np.array(numbers[:done], int), missing=np.array(cut.missing, int),
                    too_small=cut.too_small, unclosed=cut.unclosed, complete=done == len(cutting),
                    planes=len(domain.planes))
    if report.noted and mass.complete:
        print("Ctrl-C came in the last round of cuts, which went on to its end: the blocks are complete",
              file=sys.stderr)
    if not mass.complete:
        print(f"slicing was stopped by Ctrl-C after {done:,} of {len(cutting):,} joints: {len(mass):,} blocks",
              file=sys.stderr)
    count = len(domain.left_out)
    if count:
        blocks = mass.blocks.copy()
        kept = (blocks["region"] < 0) | (blocks["region"] >= count)
        blocks["region"] = np.where(blocks["region"] < 0, -1, blocks["region"] - count)
        faces = mass.faces.copy()
        # What was left out comes before the regions of slice().
        faces["region"] = np.where(faces["region"] >= count, faces["region"] - count, np.iinfo("u4").max)
        mass = dataclasses.replace(mass, blocks=blocks, faces=faces)._with(kept)
    return mass


def _joints_of(given, entry, centre, reach) -> typing.List[Joint]:
    if isinstance(given, JointSet):
        return given.joints(centre, reach)
    made = [given] if isinstance(given, Joint) else _listed(given, f"joints[{entry}]")
    for one in made:
        if not isinstance(one, Joint):
            raise ValueError(
                f"joints[{entry}] holds {type(one).__name__}: give a JointSet, a Joint or a list of Joints")
    return made


def _cut(number, joint):
    """A Joint for _core."""
    if not joint.outline:
        return _slicing.Joint.of_normal(*joint[:3])
    try:
        return _slicing.Joint.of_corners(joint.outline)
    except ValueError as error:
        raise ValueError(str(error).replace("a joint", f"joint {number}", 1)) from None


def _listed(given, name):
    try:
        return list(given)
    except TypeError:
        raise ValueError(f"{name} is {type(given).__name__}: give a JointSet, a Joint or a list of them") from None


def planes_of(mass, planes, name):
    """Numbers of planes of the domain as an array; ValueError for what is no such number."""
    planes = np.atleast_1d(planes)
    if planes.dtype == bool or planes.size and not np.array_equal(planes, np.floor(planes)):
        raise ValueError(f"{name} must be numbers of planes of the domain, such as rock.Domain.TOP")
    strange = planes[(planes < 0) | (planes >= mass.planes)]
    if strange.size:
        raise ValueError(f"{name} holds {strange[0]}: the domain has the planes 0 to {mass.planes - 1}")
    return planes.astype(int)


def marked(chosen, count, name):
    """(count,) of bool from numbers or from that."""
    given = np.asarray(chosen)
    if given.dtype == bool and given.shape == (count,):
        return given
    marked = np.zeros(count, bool)
    try:
        numbers = given.astype(int)
        if given.dtype == bool or given.size and (numbers.min() < 0 or not np.array_equal(numbers, given)):
            raise ValueError
        marked[numbers] = True
    except (IndexError, ValueError, TypeError):
        raise ValueError(f"{name} must be numbers from 0 to {count - 1}, or {count} of bool") from None
    return marked


def _not_negative(value, name):
    found = number(value, name)
    if found < 0.0:
        raise ValueError(f"{name}={found:g} must be 0 or above")
    return found


class _Report:
    """A bar, and Ctrl-C that is noted."""

    def __init__(self, total, shown):
        self.bar, self.interrupts = Bar(total, shown, "joints", "slicing"), Interrupts()

    def __enter__(self):
        self.noted = self.interrupts.__enter__()
        return self

    def told(self, joints, blocks):
        self.bar.reached(joints)
        return not self.noted

    def __exit__(self, *error):
        self.bar.close()
        self.interrupts.__exit__(*error)
