"""Bounds of the errors of films over a cell in plan, by the corrections for slope and for inertia that they make.

Their parts are fitted to plane flow over grooves by finite elements, and hold for Navier-Stokes flow over dimples, both
with d/h = 0.25 to 1 (``docs/validation/coverage.md``).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.result import BOUND
from roughfilm.rom.pocket.plan.quantities import EXTREMES, FRICTION, LOADS, OnSlidingWall
from roughfilm.rom.pocket.scene import Pocket


@dataclass(frozen=True, kw_only=True)
class Correction:
    """The correction of a film by one effect, as p+.

    Attributes
    ----------
    change : magnitude of the change of each quantity, by name.
    mean, greatest : mean and greatest magnitude of the change of the pressure above that on the edge.
    shear : mean magnitude of the change of the shear stress.
    """

    change: Mapping[str, float]
    mean: float
    greatest: float
    shear: float

    @classmethod
    def between(cls, scene: Pocket, one: "Film", other: "Film") -> Self:
        """The correction that leads from one film to another."""
        (before, wall), (after, corrected) = one, other
        pressure = np.abs((corrected.pressure - corrected.edge_mean) - (wall.pressure - wall.edge_mean))
        return cls(
            change={name: abs(after[name].value - before[name].value) for name in (*LOADS, *EXTREMES, FRICTION)},
            mean=scene.plus_factor * wall.mean(pressure),
            greatest=scene.plus_factor * float(pressure.max()),
            shear=scene.plus_factor * wall.mean(np.abs(corrected.shear_stress - wall.shear_stress)),
        )

    def size(self, name: str) -> float:
        """The size of the change of the pressure, or of the shear stress, on which a quantity depends."""
        return self.mean if name in LOADS else self.greatest if name in EXTREMES else self.shear


Film = tuple[Mapping[str, Quantity], OnSlidingWall]
"""The quantities of a film, and its sliding wall."""


@dataclass(frozen=True, kw_only=True)
class Remainder:
    """The parts of a correction for slope that bound the error which remains after it.

    Attributes
    ----------
    own : part of the change of the quantity itself.
    viscous : part of the size of the correction times the root of the slope, without inertia, where Re h/w is small.
    higher : the same over the ratio of the change of pressure to the pressure: the next order.
    least : the same of any flow.
    """

    own: float
    viscous: float
    higher: float
    least: float


REMAINDERS: Mapping[str, Remainder] = {
    **dict.fromkeys(LOADS, Remainder(own=0.2, viscous=0.8, higher=1.5, least=0.02)),
    **dict.fromkeys(EXTREMES, Remainder(own=0.1, viscous=2.0, higher=2.0, least=0.02)),
    FRICTION: Remainder(own=0.0, viscous=0.4, higher=0.5, least=0.08),
}
"""The remainders by quantity, with which 95 of 100 errors of the grooves to fit are below the bound."""

INERTIA_LEFT = 0.2
"""Error of first-order inertia over its size times the relative change of pressure by it."""

SLOPE_OF_LOAD, SLOPE_OF_PRESSURE, SLOPE_OF_EXTREME = 2.0, 0.2, 3.0
"""Errors by slope: of a load over the load, and over the largest pressure, and of an extreme pressure over the latter.

Those over the load and of an extreme pressure are times slope^0.7 h/w with the mean width w of the dimples, that over
the largest pressure times slope^0.7 h/L.
"""


def of_slope(
    scene: Pocket, made: Correction, uncertainties: Mapping[str, float], *, largest: float, kept: bool
) -> dict[str, float]:
    """The bounds of the errors of a film by its correction for slope, as details of its result.

    With the change C of a quantity by the correction, the size S of the change of the pressure (mean for loads,
    greatest for extreme pressures) or of the shear stress (for friction), s = ``scene.slope``, and the numbers a, b,
    c, d of ``REMAINDERS`` in their order, the bound is

        √(E² + u²),    E = a C + √s S [b/(1 + Re h/w) + c max|Δp|/p_max + d],

    and E is C larger for a film that leaves the correction out. Errors of the model and of its grid are independent.
    The form follows from the orders of the errors in slope; the numbers are fitted to plane flow (see the module).

    Parameters
    ----------
    made : the correction for slope, as p+.
    uncertainties : u, the uncertainty of each quantity by the grid, as p+.
    largest : p_max, the largest pressure, as p+.
    kept : whether the film keeps the correction.
    """
    found, ratio = {}, made.greatest / largest if largest > 0 else 0.0
    for name, change in made.change.items():
        part = REMAINDERS[name]
        size = scene.slope**0.5 * made.size(name)
        rest = part.viscous / (1 + scene.reduced_reynolds_number) + part.higher * ratio + part.least
        left = (part.own + (not kept)) * change + rest * size
        found[f"{BOUND}{name}"] = math.hypot(left, uncertainties[name])
    return found


def of_inertia(
    scene: Pocket,
    made: Correction,
    quantities: Mapping[str, Quantity],
    *,
    largest: float,
    relative: float,
) -> dict[str, float]:
    """The bounds of the errors of a film with inertia to first order, as details of its result.

    Higher orders of inertia are ``INERTIA_LEFT`` times the size S of the change of the pressure by the first one times
    r, that change over the pressure without inertia. Slope changes a quantity by E. With s = ``scene.slope``, the mean
    width w of the dimples, and the numbers a, b, c of ``SLOPE_OF_LOAD`` and the two after it, the bound is

        √((0.2 r S + E)² + u²),    E = a s^0.7 (h/w) |load| + b s^0.7 (h/L) p_max of a load,
                                   E = c s^0.7 (h/w) p_max of an extreme pressure.

    Parameters
    ----------
    made : the correction for inertia, as p+.
    quantities : the quantities of the film with their uncertainties u by the grid, as p+.
    largest : p_max, the largest pressure, as p+.
    relative : r.
    """
    thin = scene.slope**0.7 * scene.geometry.film / scene.geometry.length
    narrow = thin / math.sqrt(scene.covered)
    steep = {
        **{
            name: SLOPE_OF_LOAD * narrow * abs(quantities[name].value) + SLOPE_OF_PRESSURE * thin * largest
            for name in LOADS
        },
        **dict.fromkeys(EXTREMES, SLOPE_OF_EXTREME * narrow * largest),
    }
    return {
        f"{BOUND}{name}": math.hypot(
            INERTIA_LEFT * relative * made.size(name) + part, quantities[name].uncertainty or 0.0
        )
        for name, part in steep.items()
    }
