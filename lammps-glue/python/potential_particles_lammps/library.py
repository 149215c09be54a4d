# SPDX-License-Identifier: MIT OR Apache-2.0
"""The library by ctypes: particles, their mass and mesh, and the contact of two."""
import ctypes
import os
from functools import lru_cache
from pathlib import Path

import numpy as np

MESSAGE_SIZE = 512
OVERLAPPING = 2
ABI_VERSION = 3
_TOP = Path(__file__).resolve().parents[3]


class Pose(ctypes.Structure):
    _fields_ = [("position", ctypes.c_double * 3), ("orientation", ctypes.c_double * 4)]


@lru_cache(maxsize=None)
def struct(name):
    """The struct of a name whose fields the library tells, such as "pp_contact"."""
    kinds = {"f8": ctypes.c_double, "i4": ctypes.c_int32, "u4": ctypes.c_uint32}
    rows = [row.split() for row in library().pp_struct_fields(name.encode()).decode().splitlines()]
    fields = [(field, kinds[kind] if count == "1" else kinds[kind] * int(count)) for field, kind, count, _ in rows]
    made = type(name, (ctypes.Structure, ), {"_fields_": fields})
    assert ctypes.sizeof(made) == library().pp_struct_size(name.encode()), name
    return made


class MassProperties(ctypes.Structure):
    _fields_ = [("volume", ctypes.c_double), ("centroid", ctypes.c_double * 3), ("inertia", ctypes.c_double * 6),
                ("error", ctypes.c_double)]


@lru_cache(maxsize=1)
def library():
    """The shared library: $PP_LIBRARY, or target/release of this repository."""
    path = Path(
        os.environ.get("PP_LIBRARY")
        or Path(os.environ.get("CARGO_TARGET_DIR", _TOP / "target")) / "release" / "libpotential_particles.so")
    if not path.exists():
        raise FileNotFoundError(f"{path}: build it with `make library`, or set PP_LIBRARY to where it is")
    loaded = ctypes.CDLL(str(path))
    if loaded.pp_abi_version() != ABI_VERSION:
        raise ImportError(
            f"{path} has interface {loaded.pp_abi_version()}, this module needs {ABI_VERSION}: build the library anew")
    loaded.pp_status_message.restype = loaded.pp_struct_fields.restype = ctypes.c_char_p
    loaded.pp_struct_size.restype = ctypes.c_size_t
    loaded.pp_particle_new.argtypes = [
        ctypes.c_void_p, ctypes.c_size_t, ctypes.c_double, ctypes.c_double, ctypes.c_double, ctypes.c_void_p,
        ctypes.c_char_p, ctypes.c_size_t
    ]
    loaded.pp_particle_free.argtypes = [ctypes.c_void_p]
    loaded.pp_particle_bounding_radius.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    loaded.pp_particle_mass_properties.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_void_p]
    loaded.pp_particle_mesh.argtypes = [ctypes.c_void_p, ctypes.c_double] + [
        ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t,
        ctypes.c_void_p, ctypes.c_void_p
    ]
    loaded.pp_contact_detect.argtypes = [ctypes.c_void_p] * 7
    loaded.pp_contact_plane.argtypes = [ctypes.c_void_p] * 7
    return loaded


def check(status):
    if status:
        raise ValueError(library().pp_status_message(status).decode())


class Particle:
    """planes: (n, 4) rows a, b, c, d; r, k, R as in the library. `volume`, `centroid` and `inertia` (3, 3) are for
    density 1.
    """

    def __init__(self, planes, r, k, R):
        self.planes, self.r, self.k, self.R = np.ascontiguousarray(planes,
                                                                   float).reshape(-1, 4), float(r), float(k), float(R)
        self.handle = ctypes.c_void_p()
        why = ctypes.create_string_buffer(MESSAGE_SIZE)
        if library().pp_particle_new(self.planes.ctypes.data, len(self.planes), self.r, self.k, self.R,
                                     ctypes.byref(self.handle), why, MESSAGE_SIZE):
            raise ValueError(why.value.decode())
        mass, radius = MassProperties(), ctypes.c_double()
        check(library().pp_particle_mass_properties(self.handle, 1e-9, ctypes.byref(mass)))
        check(library().pp_particle_bounding_radius(self.handle, ctypes.byref(radius)))
        xx, yy, zz, xy, yz, zx = mass.inertia
        self.volume, self.radius, self.centroid = mass.volume, radius.value, np.array(mass.centroid)
        # The library gives products of inertia with the sign of the tensor.
        self.inertia = np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])

    def __del__(self):
        if getattr(self, "handle", None):
            library().pp_particle_free(self.handle)

    def mesh(self, tolerance=1e-3):
        """Vertices (n, 3) and triangles (m, 3), local frame; `tolerance` over the bounding radius."""
        counts = ctypes.c_size_t(), ctypes.c_size_t()
        library().pp_particle_mesh(self.handle, tolerance, None, None, 0, ctypes.byref(counts[0]), None, 0,
                                   ctypes.byref(counts[1]), None)
        vertices, triangles = np.empty((counts[0].value, 3)), np.empty((counts[1].value, 3), np.uint32)
        check(library().pp_particle_mesh(self.handle, tolerance, vertices.ctypes.data, None, len(vertices),
                                         ctypes.byref(counts[0]), triangles.ctypes.data, len(triangles),
                                         ctypes.byref(counts[1]), None))
        return vertices, triangles


def pose(position, orientation):
    return Pose(tuple(map(float, position)), tuple(map(float, orientation)))


def detect(a, pose_a, b, pose_b):
    """The contact of two particles, with default settings and no memory: a struct pp_contact."""
    contact = struct("pp_contact")()
    check(library().pp_contact_detect(a.handle, ctypes.byref(pose_a), b.handle, ctypes.byref(pose_b), None, None,
                                      ctypes.byref(contact)))
    return contact


def detect_plane(a, pose_a, point, normal):
    """The contact of a particle with a plane: a struct pp_flat_contact."""
    contact = struct("pp_flat_contact")()
    three = ctypes.c_double * 3
    check(library().pp_contact_plane(a.handle, ctypes.byref(pose_a), three(*point), three(*normal), None, None,
                                     ctypes.byref(contact)))
    return contact
