# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rock masses: a convex domain cut into blocks by its joints (Boon, Houlsby & Utili 2015). Axes: x east, y north, z up; angles in degrees."""
from ._core import _rock

Joint = _rock.Joint
joint_set = _rock.joint_set
Block = _rock.Block
RockMass = _rock.RockMass
slice = _rock.slice

__all__ = ["Block", "Joint", "RockMass", "joint_set", "slice"]
