# SPDX-License-Identifier: GPL-3.0-or-later
"""The names of YADE's code for potential blocks, for scripts that were written for a YADE with ENABLE_POTENTIAL_BLOCKS.

    import potential_particles.potential_blocks

as the first line of such a script makes its names known everywhere, as those of YADE are; the rest stays as it is.
YADE's own potential_utils finds them, too.

    PotentialBlock                   a ConicPotentialParticle with k = 0 in its principal frame, with volume, inertia,
                                     position, orientation, connectivity
    PotentialBlock2AABB              PotentialParticle2AABB
    Ig2_PB_PB_ScGeom                 Ig2_PP_PP_ScGeom_Conic with patch=True: area and contact point of the patch
    Ip2_FrictMat_FrictMat_KnKsPBPhys Ip2_FrictMat_FrictMat_KnKsPhys_Block
    KnKsPBPhys                       YADE's KnKsPhys
    Law2_SCG_KnKsPBPhys_KnKsPBLaw    YADE's Law2_SCG_KnKsPhys_KnKsLaw
    PotentialBlockVTKRecorder        YADE's PotentialParticleVTKRecorder
    Gl1_PotentialBlock               what draws potential particles in the 3-D window
    BlockGen                         slicing by potential_particles.rock

docs/converting.md says what differs.
"""
import builtins

import yade

from .block import PotentialBlock
from .generation import BlockGen

__all__ = [
    "BlockGen", "Gl1_PotentialBlock", "Ig2_PB_PB_ScGeom", "Ip2_FrictMat_FrictMat_KnKsPBPhys", "KnKsPBPhys",
    "Law2_SCG_KnKsPBPhys_KnKsPBLaw", "PotentialBlock", "PotentialBlock2AABB", "PotentialBlockVTKRecorder"
]

if hasattr(yade.wrapper, "PotentialBlock"):
    raise ImportError(
        "this YADE was built with ENABLE_POTENTIAL_BLOCKS and has a PotentialBlock of its own: leave potential_particles.potential_blocks out"
    )

PotentialBlock2AABB = yade.wrapper.PotentialParticle2AABB
KnKsPBPhys = yade.wrapper.KnKsPhys
Ip2_FrictMat_FrictMat_KnKsPBPhys = yade.wrapper.Ip2_FrictMat_FrictMat_KnKsPhys_Block
Law2_SCG_KnKsPBPhys_KnKsPBLaw = yade.wrapper.Law2_SCG_KnKsPhys_KnKsLaw
PotentialBlockVTKRecorder = getattr(yade.wrapper, "PotentialParticleVTKRecorder", None)
Gl1_PotentialBlock = getattr(yade.wrapper, "Gl1_PotentialParticle", None)


def Ig2_PB_PB_ScGeom(**attributes):
    """Ig2_PP_PP_ScGeom_Conic with patch=True, and further attributes of it."""
    return yade.wrapper.Ig2_PP_PP_ScGeom_Conic(**{"patch": True, **attributes})


def _make_known():
    """In every module, as YADE's own names are."""
    import __main__
    import yade.potential_utils
    for name in __all__:
        for place in (yade, builtins, __main__, yade.potential_utils):
            setattr(place, name, globals()[name])


_make_known()
