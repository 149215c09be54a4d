# SPDX-License-Identifier: MIT OR Apache-2.0
"""What Python adds to the library: a batch of 100,000 pairs and a single call, beside the same through the C interface.

    PYTHON benches/wheel/run.py OUT LIBRARY

PYTHON has the wheel; LIBRARY is libpotential_particles.so of the same sources. Writes OUT/summary.json and, with
matplotlib, OUT/overhead.png. Both ways read the same arrays and take turns; the shortest of the rounds count, since
what disturbs a round only adds to it.
"""
import ctypes
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import potential_particles as pp
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "studies"))
from summary import print_targets, target, write_summary

TOP = Path(__file__).resolve().parents[2]
SIDE, ROUNDS, CALLS = 33, 15, 100_000
CUBE = [(1, 0, 0, 0.9), (-1, 0, 0, 0.9), (0, 1, 0, 0.9), (0, -1, 0, 0.9), (0, 0, 1, 0.9), (0, 0, -1, 0.9)]


class Library:
    """The C interface, by ctypes; arrays are handed over by their addresses."""

    def __init__(self, file):
        self.library = ctypes.CDLL(str(file))
        self.library.pp_particle_new.argtypes = [ctypes.c_void_p, ctypes.c_size_t
                                                 ] + 3 * [ctypes.c_double] + 2 * [ctypes.c_void_p] + [ctypes.c_size_t]
        self.library.pp_contact_detect_batch.argtypes = (
            2 * [ctypes.c_void_p]
            + [ctypes.c_size_t, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p, ctypes.c_uint32]
            + 3 * [ctypes.c_void_p])

    def particle(self, planes, r, k, shadow):
        rows, made = np.array(planes, float), ctypes.c_void_p()
        assert self.library.pp_particle_new(rows.ctypes.data, len(rows), r, k, shadow, ctypes.byref(made), None, 0) == 0
        return made.value

    def settings(self, carry):
        """A struct pp_settings with this carry_tolerance, whose fields the library tells."""
        self.library.pp_struct_fields.restype = ctypes.c_char_p
        kinds = {"f8": ctypes.c_double, "i4": ctypes.c_int32, "u4": ctypes.c_uint32}
        rows = [row.split() for row in self.library.pp_struct_fields(b"pp_settings").decode().splitlines()]
        fields = [(name, kinds[kind] * int(count) if count != "1" else kinds[kind]) for name, kind, count, _ in rows]
        settings = type("pp_settings", (ctypes.Structure, ), {"_fields_": fields})()
        self.library.pp_settings_default(ctypes.byref(settings))
        settings.carry_tolerance = carry
        return settings

    def batch(self, particles, poses, pairs, settings, states, contacts, statuses):
        done = self.library.pp_contact_detect_batch(particles.ctypes.data, poses.ctypes.data, len(poses),
                                                    pairs.ctypes.data, len(pairs), ctypes.byref(settings), 1,
                                                    states.ctypes.data, contacts.ctypes.data, statuses.ctypes.data)
        assert done == 0 and not statuses.any()


def scene():
    """A block of cubes that overlap their neighbours, turned at random: poses, pairs."""
    random = np.random.default_rng(1)
    places = np.stack(np.meshgrid(*3 * [np.arange(SIDE)], indexing="ij"), -1).reshape(-1, 3)
    poses = np.zeros(len(places), pp.pose_type)
    poses["position"] = 1.9 * places
    poses["orientation"] = np.column_stack([np.ones(len(places)), random.uniform(-0.1, 0.1, (len(places), 3))])
    number = np.arange(len(places)).reshape(SIDE, SIDE, SIDE)
    pairs = np.vstack([np.column_stack([number[:-1].ravel(), number[1:].ravel()]),
                       np.column_stack([number[:, :-1].ravel(), number[:, 1:].ravel()]),
                       np.column_stack([number[:, :, :-1].ravel(), number[:, :, 1:].ravel()])])
    return poses, np.ascontiguousarray(pairs[:100_000], np.uint32)


def seconds(call):
    begin = time.perf_counter()
    call()
    return time.perf_counter() - begin


def batches(library):
    """Seconds of a batch by C and by Python: from the last solution, and carried on; and what a new list of pairs
    costs.
    """
    poses, pairs = scene()
    own = library.particle(CUBE, 0.1, 0.01, 2.0)
    particles, cube = np.full(len(poses), own, np.uint64), pp.Particle(CUBE, 0.1, 0.01, 2.0)
    found = {}
    for name, carry in (("from the last solution", 0.0), ("carried on", 1e-9)):
        settings = library.settings(carry)
        states, contacts, statuses = np.zeros(
            (len(pairs), 48)), np.zeros(len(pairs), pp.contact_type), np.zeros(len(pairs), np.int32)
        batch = pp.Batch([cube] * len(poses), pp.Settings(carry_tolerance=carry))
        out = np.zeros(len(pairs), pp.contact_type)

        def by_c():
            library.batch(particles, poses, pairs, settings, states, contacts, statuses)

        def by_python():
            batch.detect(poses, pairs, out)
        for _ in range(2):
            by_c(), by_python()
        assert np.array_equal(contacts.view(np.uint64), out.view(np.uint64)), "both ways find the same, to the last bit"
        times = np.array([[seconds(by_c), seconds(by_python)] for _ in range(ROUNDS)])
        found[name] = times.min(0)
    # Half of the pairs are new, and half are known.
    other = np.ascontiguousarray(np.vstack([pairs[::2], pairs[::2, ::-1]]))
    lists = [other, pairs]
    changed = min(seconds(lambda: batch.detect(poses, lists[i % 2], out)) for i in range(4))
    return found, changed, int((out["kind"] == pp.OVERLAPPING).sum()), len(pairs)


def single(library):
    """Seconds of one call from the last solution, by C and by Python."""
    with tempfile.TemporaryDirectory() as folder:
        program, beside = Path(folder, "single"), Path(library).parent
        subprocess.run([
            "cc", "-O2", "-std=c11", "-Wall", "-Werror",
            str(TOP / "benches/wheel/single.c"), f"-I{TOP / 'include'}", f"-L{beside}", "-lpotential_particles",
            f"-Wl,-rpath,{beside}", "-o",
            str(program)
        ], check=True)
        said = subprocess.run([str(program), str(CALLS), str(ROUNDS)], check=True, capture_output=True,
                              text=True).stdout
    by_c = min(map(float, said.split()))
    cube, lower, upper = pp.Particle(CUBE, 0.1, 0.01, 2.0), pp.Pose((0, 0, 0)), pp.Pose((0.3, 0.1, 1.9),
                                                                                        (1, 0.1, 0.05, 0.2))
    settings, state, detect = pp.Settings(), pp.PairState(), pp.detect

    def calls():
        for _ in range(CALLS):
            detect(cube, lower, cube, upper, settings, state)
    return by_c, min(seconds(calls) for _ in range(ROUNDS)) / CALLS


def draw(folder, rows):
    try:
        import matplotlib
    except ImportError:
        print("no picture without matplotlib")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
    places = np.arange(len(rows))
    axes.barh(places - 0.2, [1e6 * row["c"] for row in rows], 0.38, label="C", color="#7a7a7a")
    axes.barh(places + 0.2, [1e6 * row["python"] for row in rows], 0.38, label="Python", color="#2a6fb0")
    axes.set_yticks(places, [row["name"] for row in rows])
    axes.invert_yaxis()
    axes.set_xlabel("µs a pair")
    axes.legend()
    figure.savefig(folder / "overhead.png", dpi=120)


def main():
    folder, file = Path(sys.argv[1]), Path(sys.argv[2]).resolve()
    library = Library(file)
    found, changed, overlapping, count = batches(library)
    by_c, by_python = single(file)
    rows = [{"name": f"batch, {name}", "c": c / count, "python": python / count} for name, (c, python) in found.items()]
    rows.append({"name": "single call", "c": by_c, "python": by_python})
    targets = [
        target(f"time of a batch of {count} pairs, {name}, over C's", "at most", 1.05, python / c)
        for name, (c, python) in found.items()
    ]
    targets.append(target("a single call above C's, us", "at most", 1.0, 1e6 * (by_python - by_c)))
    for row in rows:
        print(f"{row['name']}: C {1e6 * row['c']:.4f} us, Python {1e6 * row['python']:.4f} us")
    print(f"with half of the pairs new: {1e6 * changed / count:.3f} us a pair; {overlapping} of {count} pairs overlap")
    print_targets(targets)
    folder.mkdir(parents=True, exist_ok=True)
    write_summary(folder / "summary.json", {"rows": rows, "changed_list": changed / count, "targets": targets})
    draw(folder, rows)


main()
