# SPDX-License-Identifier: GPL-3.0-or-later
# Files on a disk that is full: an error, and what was there before stays. Mesh files in a locale with a decimal comma,
# which Qt sets; with the marks of Unicode.
import ctypes
import locale
import os
import re
import resource
import subprocess
import tempfile
import threading
import warnings

import numpy as np
import potential_particles
import yade
from harness import *
from potential_particles import rock, shapes
from potential_particles.potential_blocks import BlockGen

check = Checks()
warnings.simplefilter("ignore", potential_particles.SceneWarning)
folder = tempfile.mkdtemp()


def path(name):
    return os.path.join(folder, name)


def limited(size, action):
    """Does something while no file may be longer than that."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        return action()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


def contents():
    return {
        os.path.join(where, name): open(os.path.join(where, name), "rb").read()
        for where, _, names in os.walk(folder)
        for name in names
    }


# A pile of bonded cubes on a facet, with a rock mass of its own joints.
material = yade.ConicJointMat(normalStiffness=1e9, shearStiffness=5e8, frictionAngle=0.5, density=2000.0, cohesion=1e6,
                              tensileStrength=1e6)
joint_scene(yade.InteractionLoop, material, 0.1, (0, 0, -9.81), False, 1e-5, bonds=True)
mass = rock.slice(rock.Domain.box((-1, -1, 0), (1, 1, 2)),
                  [rock.JointSet(0, 0, 0.5), rock.JointSet(90, 90, 0.7)], progress=False)
ids = rock.bodies(mass, fixed=mass.on_domain(rock.Domain.BOTTOM))
run(2)
shape = shapes.random_rock(1)
record, of_joints = potential_particles.Recorder(path("frames")), rock.JointRecorder(mass, ids, path("frames"))
generator = BlockGen(saveBlockGenData=True, outputFile=path("blocks.txt"))
writers = {
    **{
        f"save, {end}": lambda end=end: potential_particles.save(path("scene." + end))
        for end in ("xml", "xml.bz2", "yade.gz", "yade")
    },
    "save_mesh, .stl": lambda: potential_particles.save_mesh(path("mesh.stl"), shape),
    "save_mesh, .vtp": lambda: potential_particles.save_mesh(path("mesh.vtp"), shape),
    "plot": lambda: potential_particles.plot(path("picture.png"), size=(64, 48)),
    "Recorder": record,
    "JointRecorder": of_joints,
    "to_lammps": lambda: potential_particles.to_lammps(path("for_lammps")),
    "BlockGen": lambda: generator._tell([(mass, False)]),
}
for name, write in writers.items():
    there = set(contents())
    write()
    made = {file: content for file, content in contents().items() if file not in there}
    check.true(made, f"{name}: files are there")
    before = contents()
    # The disk is full before the first byte, and at the last one.
    longest = max(map(len, made.values()))
    for size in (0, longest - 1):
        check.raises(OSError, lambda: limited(size, write), f"{name}, {size} of {longest} bytes",
                     "what was there before is left as it was")
        now = contents()
        changed = [file for file in now if now[file] != before.get(file)]
        # Those that have room are written anew: each of them is whole.
        check.true(
            set(now) == set(before) and not [file for file in changed if len(now[file]) < min(len(before[file]), size)],
            f"{name}, {size} of {longest} bytes: {changed} changed")
        check.true(all(now[file] == content for file, content in before.items() if len(content) > size),
                   f"{name}, {size} of {longest} bytes: what was there stays")
    write()

# What was saved is what O.save writes, and can be loaded; a link stays one, permissions stay.
bodies = len(O.bodies)
for end in ("xml.bz2", "yade"):
    O.save(path("own." + end))
    potential_particles.save(path("scene." + end))
    check.true(open(path("own." + end), "rb").read() == open(path("scene." + end), "rb").read(), f"{end}: as O.save")
os.symlink(path("scene.yade"), path("link.yade"))
os.chmod(path("scene.yade"), 0o640)
potential_particles.save(path("link.yade"))
check.true(
    os.path.islink(path("link.yade")) and os.stat(path("scene.yade")).st_mode & 0o777 == 0o640,
    "a link, and permissions")
O.load(path("link.yade"))
check.equal(len(O.bodies), bodies, "loaded")
check.raises(OSError, lambda: potential_particles.save(path("nowhere/scene.xml")), "no folder", "nowhere")
check.raises(OSError, lambda: potential_particles.save(folder), "a folder")

# What lies beside a file is nobody's business: neither a file nor a link of a name like ours is touched, a name may be
# as long as names can be, and of two writers at once one whole file stays.
victim, longest = path("victim.txt"), path("n" * 251 + ".txt")
for name in ("victim.txt", "one.txt.part"):
    with open(path(name), "w") as file:
        file.write("precious")
os.symlink(victim, path("two.txt.part"))
for name in ("one.txt", "two.txt", longest):
    with potential_particles.files.written(path(name), text=True) as file:
        file.write("new")
    check.equal(open(path(name)).read(), "new", f"{name[-20:]}: written")
    check.equal(os.stat(path(name)).st_mode & 0o777, 0o666 & ~os.umask(os.umask(0o022)), "with the permissions of any file")
check.equal([open(name).read() for name in (victim, path("one.txt.part"))], ["precious"] * 2, "what lies beside it")


def write_again(letter):
    for _ in range(100):
        with potential_particles.files.written(path("shared.txt"), text=True) as file:
            for _ in range(10):
                file.write(letter * 1000)
                file.flush()


writing = [threading.Thread(target=write_again, args=letter) for letter in "ab"]
with potential_particles.files.written(path("shared.txt"), text=True) as file:
    file.write("a" * 10_000)
for one in writing:
    one.start()
torn = 0
while any(one.is_alive() for one in writing):
    text = open(path("shared.txt")).read()
    torn += len(text) != 10_000 or len(set(text)) != 1
check.equal(torn, 0, "reads of a file that two write")
check.equal(sorted(name for name in os.listdir(folder) if name.endswith(".part")), ["one.txt.part", "two.txt.part"],
            "nothing is left over")

# Numbers in a file that are none.
potential_particles.save(path("joints.xml"))
text = open(path("joints.xml")).read()
for tag in ("twist", "bondArea", "tangensOfFrictionAngle"):
    old = re.search(f"<{tag}>[^<]*</{tag}>", text)[0]
    with open(path("wrong.xml"), "w") as file:
        file.write(text.replace(old, f"<{tag}>nan</{tag}>", 1))
    check.raises(ValueError, lambda: O.load(path("wrong.xml")), f"{tag} in a file",
                 f"ConicJointPhys: {tag} = nan: it must be finite")
    O.load(path("joints.xml"))

# Marks at the beginning of a text; the ends of lines of other systems.
corners, sides = [(0, 0, 0), (1.5, 0, 0), (0, 1.5, 0), (0, 0, 1.5)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
obj = "".join("v %g %g %g\n" % one for one in corners) + "".join("f %d %d %d\n" % tuple(i + 1 for i in one)
                                                                 for one in sides)
stl = "solid a\n" + "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % corners[i]
                                                                         for i in one) + "endloop\nendfacet\n"
                            for one in sides) + "endsolid a\n"
gts = "4 6 4\n" + "".join("%g %g %g\n" % one
                          for one in corners) + "1 2\n1 3\n1 4\n2 3\n2 4\n3 4\n2 4 1\n1 5 3\n4 6 5\n3 6 2\n"
texts = {"obj": obj, "stl": stl, "gts": gts}


def volume(name, content):
    with open(path(name), "wb") as file:
        file.write(content)
    return shapes.from_mesh(path(name), rounding=1e-4, k=0.0).volume / 1.5**3 * 6


for kind, text in texts.items():
    for how, content in [("", text.encode()), ("a mark", text.encode("utf-8-sig")),
                         ("\\r\\n", text.replace("\n", "\r\n").encode()), ("\\r", text.replace("\n", "\r").encode())]:
        check.close(volume("text." + kind, content), 1.0, 1e-3, f".{kind} {how}")
    check.raises(ValueError, lambda: volume("text." + kind, text.encode("utf-16")), f".{kind} in UTF-16",
                 "UTF-16: save it as UTF-8")

# A decimal comma.
os.makedirs(path("locales"))
made = subprocess.run(
    ["localedef", "-i", "de_DE", "-f", "UTF-8", path("locales/de_DE.UTF-8")], capture_output=True, text=True)
os.environ["LOCPATH"] = path("locales")
try:
    locale.setlocale(locale.LC_NUMERIC, "de_DE.UTF-8")
except locale.Error as error:
    print(f"skipped: no locale with a decimal comma ({error}; {made.stderr})")
else:
    library = ctypes.CDLL(None)
    library.strtod.restype = ctypes.c_double
    check.equal(library.strtod(b"1,5", None), 1.5, "C reads a comma")
    for kind, text in texts.items():
        check.close(volume("comma." + kind, text.encode()), 1.0, 1e-3, f".{kind} under a decimal comma")
    point = {
        name: open(name, "rb").read()
        for name in [path("mesh.stl"), path("mesh.vtp"), path("for_lammps.data"), path("for_lammps.lmp")]
    }
    for name in ("save_mesh, .stl", "save_mesh, .vtp", "to_lammps"):
        writers[name]()
    record()
    check.equal([name for name, content in point.items() if open(name, "rb").read() != content], [],
                "files under a decimal comma")
    check.true(b"," not in open(path("frames.bodies.pvd"), "rb").read(), "the series")
    check.true(np.isfinite(potential_particles.output.vtk_files.read(path("mesh.vtp"))["points"]).all(), "and read")
    table = path("table.csv")
    with open(table, "w") as file:
        file.write("30.5; 90; 2.5\n")
    check.equal(len(rock.read_blockgen(table, "persistent", size=10)), 5, "a table of BlockGen")
    potential_particles.save(path("comma.xml"))
    O.load(path("comma.xml"))
    check.equal(len(O.bodies), bodies, "a scene")
    locale.setlocale(locale.LC_NUMERIC, "C")
check.finish()
