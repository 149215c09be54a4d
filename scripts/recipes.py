#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Looks whether the recipes under packaging/ can be read: conda's by rattler-build's own parser, which is on PyPI
(py-rattler-build), and Spack's for its syntax, as Spack itself is in no package registry. Called by
"make release-check".
"""
import ast
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]


def conda():
    import rattler_build
    recipe = TOP / "packaging/conda/recipe.yaml"
    stage = rattler_build.Stage0Recipe.from_file(str(recipe))
    platform = rattler_build.PlatformConfig(target_platform="linux-64")
    variants = rattler_build.VariantConfig(
        {"c_compiler": ["gcc"], "rust_compiler": ["rust"], "c_stdlib": ["sysroot"], "python": ["3.12.* *_cpython"]})
    outputs = [one.recipe.package.name for one in stage.render(variants, rattler_build.RenderConfig(platform=platform))]
    return f"{recipe.name}: {', '.join(map(str, outputs))}"


def spack():
    recipe = TOP / "packaging/spack/repo/packages/potential_particles/package.py"
    tree = ast.parse(recipe.read_text())
    classes = [one for one in tree.body if isinstance(one, ast.ClassDef)]
    [package] = classes
    calls = {one.value.func.id for one in package.body if isinstance(one, ast.Expr) and isinstance(one.value, ast.Call)}
    wanted = {"license", "version", "depends_on"}
    if package.name != "PotentialParticles" or not wanted <= calls or not ast.get_docstring(package):
        raise SystemExit(
            f"{recipe}: class {package.name} with {sorted(calls)}, where PotentialParticles with {sorted(wanted)} and a docstring is needed"
        )
    return f"{recipe.name}: {package.name}, syntax alone"


if __name__ == "__main__":
    for check in (conda, spack):
        print("  " + check())
    sys.exit(0)
