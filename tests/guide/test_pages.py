# SPDX-License-Identifier: MIT OR Apache-2.0
"""Runs every code block of README.md and of the pages under docs/.

Python blocks of a page run one after the other in one YADE, C blocks are compiled and run, cmake blocks build an
example against an installation in a folder of its own. Of a shell block each "make" must be a target and each script
must be there. Rust blocks are doctests of the library; here it is checked that their page is one. Python blocks of
docs/wheel.md, docs/derivatives.md and docs/equilibrium.md run in python/tests/test_blocks.py. Other languages, and blocks
that name none, fail.
"""
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest
from blocks import blocks

TOP = Path(__file__).resolve().parents[2]
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", TOP / "target")).resolve()
RELEASE = TARGET / "release"
SECONDS = 600
# Their Python blocks run where there is no YADE: python/tests/test_blocks.py.
WHEEL = ("wheel.md", "derivatives.md", "equilibrium.md")
# In YADE, and past its exit, which waits for threads that a block may have started. Names are those of scripts: global.
PAGE = """import os, sys, traceback
for _place, _source in %r:
    try:
        exec(compile(_source, _place, "exec"), globals())
    except BaseException:
        traceback.print_exc()
        sys.stdout.flush()
        os._exit(1)
    print("done", _place, flush=True)
os._exit(0)
"""
# What stands around the body of a main function, where a block is one.
C_AROUND = "#include <potential_particles.h>\n#include <stdio.h>\nint main(void) {\n%s\nreturn 0;\n}\n"


def call(command, folder, **more):
    """None if the command ends well, else what it said."""
    try:
        done = subprocess.run(command, cwd=folder, text=True, timeout=SECONDS, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **more)
    except subprocess.TimeoutExpired as late:
        return f"{late.stdout or ''}\nstill running after {SECONDS} s"
    return None if done.returncode == 0 else done.stdout


def run_python(page_blocks, scratch):
    """What each block said that did not run to its end, else None, by their places. A failure ends the page."""
    Path(scratch, "page.py").write_text(PAGE % [(block.place, block.before + block.code) for block in page_blocks])
    said = call([TOP / "scripts/yade.sh", "-j1", "page.py"], scratch)
    return {block.place: None if said is None or f"done {block.place}" in said else said for block in page_blocks}


def run_c(block, scratch):
    source = block.code if "int main(" in block.code else C_AROUND % (block.before + block.code)
    Path(scratch, "block.c").write_text(source)
    return call([
        "cc", "-std=c11", "-Wall", "-Wextra", "-Werror", "block.c", f"-I{TOP / 'include'}", f"-L{RELEASE}",
        "-lpotential_particles", f"-Wl,-rpath,{RELEASE}", "-lm", "-o", "block"
    ], scratch) or call(["./block"], scratch)


def run_cmake(block, scratch):
    installed = Path(scratch, "installed")
    Path(scratch, "CMakeLists.txt").write_text(
        f"cmake_minimum_required(VERSION 3.18)\nproject(guide C)\nadd_executable(mine {TOP}/examples/c/one_pair.c)\n{block.code}"
        "target_link_libraries(mine m)\n")
    built = {"PROFILE": "dev", "CORE": str(RELEASE.parent / "maturin" / "release" / "lib_core.so")}
    return (call(["make", "install", f"PREFIX={installed}"], TOP, env={**os.environ, **built})
            or call(["cmake", "-S", ".", "-B", "build", f"-DCMAKE_PREFIX_PATH={installed}"], scratch)
            or call(["cmake", "--build", "build"], scratch) or call(["build/mine"], scratch))


def check_shell(block):
    """Commands of this project must exist as they are written."""
    for line in block.code.splitlines():
        words = line.split("#")[0].split()
        if not words:
            continue
        if words[0] == "make":
            said = call(["make", "--dry-run", "--silent", *words[1:]], TOP)
            if said is not None:
                return f"{line}\n{said}"
        elif "/" in words[0]:
            if not os.access(TOP / words[0], os.X_OK):
                return f"{line}: there is no program {words[0]}"
        else:
            return f"{line}: nothing says how this is tested (a comment above the block: <!-- tested by: FILE: TEXT -->)"
    return None


def is_doctest(block):
    page = f'include_str!("../{block.page.relative_to(TOP)}")'
    return None if page in (TOP / "src/lib.rs").read_text() else f"src/lib.rs has no {page}"


def elsewhere(block):
    file, text = block.tested_by
    path = TOP / file
    return None if path.is_file() and text in path.read_text() else f"{file} does not hold {text!r}"


def run_block(block):
    if block.tested_by:
        return elsewhere(block)
    with tempfile.TemporaryDirectory() as scratch:
        return {
            "c": lambda: run_c(block, scratch), "cmake": lambda: run_cmake(block, scratch),
            "sh": lambda: check_shell(block), "rust": lambda: is_doctest(block)
        }.get(block.language, lambda: f"language {block.language!r}: not known here")()


def runs_here(block):
    return block.tested_by or block.language != "python" or block.page.name not in WHEEL


PAGES = {page: list(filter(runs_here, blocks(page))) for page in [TOP / "README.md", *sorted((TOP / "docs").glob("*.md"))]}


@pytest.mark.parametrize("found", [pytest.param(found, id=page.name) for page, found in PAGES.items() if found])
def test_page(found, check, folder):
    scripts = [block for block in found if block.language == "python" and not block.tested_by]
    results = {}
    if scripts:
        # Copies, since a block may write a file of the same name.
        shutil.copytree(TOP / "examples/data", folder, dirs_exist_ok=True)
        results = run_python(scripts, folder)
    for block in found:
        said = results[block.place] if block.place in results else run_block(block)
        check.true(said is None, f"{block.place}: {block.language or 'a block without a language'} fails\n{said}")
