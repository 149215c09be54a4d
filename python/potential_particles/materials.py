# SPDX-License-Identifier: MIT OR Apache-2.0
"""Materials that one can start from: densities, friction and restitution of common grains, and the stiffness, damping
and time step that follow from the largest overlap one bears.
"""
import dataclasses
import math

from .arguments import positive, within

GRAVITY = 9.81
# New contacts of a body that the time step allows for, and the part of the proved limit that is used.
CONTACTS, SAFETY = 3, 0.5


@dataclasses.dataclass(frozen=True)
class Grains:
    """density: kg/m3; friction: coefficient between two grains; restitution: of an impact at a few m/s."""

    density: float
    friction: float
    restitution: float


#: Values to start from, in the middle of what is published; measure your own. Friction of quartz sand: Rowe, Proc. R.
#: Soc. A 269 (1962), 22 to 31 degrees by size; of rock: the basic angle of Barton and Choubey, Rock Mech. 10 (1977),
#: 25 to 35 degrees; ballast is angular rock, of which 31 to 40 degrees are used in simulations; bricks on mortar or
#: dry: 0.6 to 0.75. Restitution of rock on rock: 0.3 to 0.6.
MATERIALS = {
    "rock": Grains(2650.0, math.tan(math.radians(30)), 0.5),
    "ballast": Grains(2700.0, math.tan(math.radians(35)), 0.4),
    "sand": Grains(2650.0, math.tan(math.radians(26)), 0.6),
    "brick": Grains(1900.0, 0.65, 0.3),
}


@dataclasses.dataclass(frozen=True)
class Suggestion:
    """normal_stiffness: k_n of a contact, N/m; young: of a FrictMat that gives it, Pa; density, kg/m3; friction: a
    coefficient, and friction_angle, rad; restitution; damping: of NewtonIntegrator; time_step: s, an estimate, which
    critical_time_step() makes certain in the scene; largest_overlap: m; asked_by: "impact" or "weight", which of them
    asks for this stiffness.
    """

    normal_stiffness: float
    young: float
    density: float
    friction: float
    restitution: float
    damping: float
    time_step: float
    largest_overlap: float
    asked_by: str

    @property
    def friction_angle(self):
        return math.atan(self.friction)

    def frict_mat(self):
        """The arguments of a FrictMat: O.materials.append(FrictMat(**suggestion.frict_mat()))."""
        return dict(young=self.young, poisson=0.3, frictionAngle=self.friction_angle, density=self.density)


def suggest(material="rock", size=None, r=None, fall=0.0, depth=0.0, load=0.0, overlap=0.1, density=None,
            friction=None, energy_matters=False, gravity=GRAVITY):
    """Stiffness, damping and time step for bodies of `size` whose overlaps stay below overlap * r.

    A body of mass m that arrives with the speed v = sqrt(2 g fall) overlaps by v sqrt(m / k_n), under a pile of the
    height `depth` by about rho g depth size^2 / k_n, and by load / k_n under a force. The stiffest counts:

        k_n = max(m v^2 / delta^2, (rho g depth size^2 + load) / delta),    delta = overlap r,    m = rho pi/6 size^3.

    A contact of two equal bodies with springs from FrictMat has k_n = young * bounding radius, so that young =
    k_n / (size / 2). The time step is that of critical_time_step() for a ball of that size with three contacts at the
    corners of its box, dt = 1/2 * 2 / sqrt(2 * 3 * 8.5 k_n / m).

    material: a key of MATERIALS. size: diameter, m. r: rounding radius, m; 0.05 * size, that of the builders, where it
    is None. fall, depth: m. load: the largest force on one contact, N. overlap: share of r. density, friction
    (coefficient): instead of the material's. energy_matters: no damping but that of the contacts; else 0.3, for a pile
    that should come to rest. ValueError that names the argument; at least one of fall, depth and load is above 0.
    """
    if material not in MATERIALS:
        raise ValueError(f"material={material!r}: there are {', '.join(MATERIALS)}; "
                         "give density= and friction= for others")
    if size is None:
        raise ValueError("size=None: give the diameter of the bodies, m")
    grains = MATERIALS[material]
    size = positive(size, "size")
    r = 0.05 * size if r is None else positive(r, "r")
    density = grains.density if density is None else positive(density, "density")
    friction = grains.friction if friction is None else within(friction, 0.0, 3.0, "friction")
    fall, depth, load = (within(value, 0.0, 1e50, name)
                         for value, name in ((fall, "fall"), (depth, "depth"), (load, "load")))
    if fall == depth == load == 0.0:
        raise ValueError("fall=depth=load=0: give the height of the fall or of the pile, m, "
                         "or the force on a contact, N")
    delta = within(overlap, 1e-9, 1.0, "overlap") * r
    gravity = positive(gravity, "gravity")
    mass = density * math.pi / 6 * size**3
    impact = mass * 2 * gravity * fall / delta**2
    weight = (density * gravity * depth * size**2 + load) / delta
    stiffness = max(impact, weight)
    # A ball of the moment of inertia m size^2 / 10, and a corner of its box at the distance sqrt(3)/2 size.
    softness = 1.0 + 0.75 * 10.0
    return Suggestion(normal_stiffness=stiffness, young=stiffness / (0.5 * size), density=density, friction=friction,
                      restitution=grains.restitution, damping=0.0 if energy_matters else 0.3,
                      time_step=SAFETY * 2.0 / math.sqrt(2.0 * CONTACTS * softness * stiffness / mass),
                      largest_overlap=delta, asked_by="impact" if impact >= weight else "weight")
