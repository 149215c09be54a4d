# SPDX-License-Identifier: MIT OR Apache-2.0
import os
from typing import Optional, Tuple, Union

from numpy.typing import ArrayLike

from ._core import MassProperties, Particle, Pose, Vector

class Shape:
    @property
    def particle(self) -> Particle: ...
    @property
    def mass(self) -> MassProperties: ...
    @property
    def volume(self) -> float: ...
    @property
    def sharp_volume(self) -> float: ...
    @property
    def centroid(self) -> Vector: ...
    @property
    def orientation(self) -> Vector: ...
    @property
    def pose(self) -> Pose: ...


def half_spaces(planes: ArrayLike, *, rounding: Optional[float] = None, k: float = 0.02, r: Optional[float] = None,
                R: Optional[float] = None) -> Shape:
    ...


def hull(points: ArrayLike, *, known: float = 0.0, rounding: Optional[float] = None, k: float = 0.02,
         r: Optional[float] = None, R: Optional[float] = None) -> Shape:
    ...


def surface(points: ArrayLike, triangles: ArrayLike, *, known: float = 0.0, rounding: Optional[float] = None,
            k: float = 0.02, r: Optional[float] = None, R: Optional[float] = None) -> Shape:
    ...


def mesh(file: Union[str, os.PathLike[str]], *, hull: bool = False, scale: float = 1.0,
         rounding: Optional[float] = None, k: float = 0.02, r: Optional[float] = None,
         R: Optional[float] = None) -> Shape:
    ...


def cuboid(edges: ArrayLike, *, rounding: Optional[float] = None, k: float = 0.02, r: Optional[float] = None,
           R: Optional[float] = None) -> Shape:
    ...


def prism(sides: int = 6, radius: float = 0.5, height: float = 1.0, top_radius: Optional[float] = None, *,
          rounding: Optional[float] = None, k: float = 0.02, r: Optional[float] = None,
          R: Optional[float] = None) -> Shape:
    ...


def cylinder(radius: float = 0.5, height: float = 1.0, sides: int = 48, *, rounding: Optional[float] = None,
             k: float = 0.02, r: Optional[float] = None, R: Optional[float] = None) -> Shape:
    ...


def cone(radius: float = 0.5, height: float = 1.0, sides: int = 48, *, rounding: Optional[float] = None,
         k: float = 0.02, r: Optional[float] = None, R: Optional[float] = None) -> Shape:
    ...


def superquadric(axes: ArrayLike, exponents: Tuple[float, float], *, planes: int = 48,
                 rounding: Optional[float] = None, k: float = 0.02, r: Optional[float] = None,
                 R: Optional[float] = None) -> Shape:
    ...


def fitted(points: ArrayLike, planes: int = 60, *, rounding: Optional[float] = None, k: float = 0.02,
           r: Optional[float] = None, R: Optional[float] = None) -> Shape:
    ...


def regular_solid(faces: int, edge: float = 1.0, *, rounding: Optional[float] = None, k: float = 0.02,
                  r: Optional[float] = None, R: Optional[float] = None) -> Shape:
    ...


def sphere(radius: float) -> Shape: ...
def ellipsoid(axes: ArrayLike) -> Shape: ...
def capsule(radius: float, length: float) -> Shape: ...
