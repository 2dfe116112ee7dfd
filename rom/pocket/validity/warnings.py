"""Warnings where a pocket leaves the range of validity of a model."""

from roughfilm.rom.parts.laminar import turbulence_warnings
from roughfilm.rom.parts.surroundings import rupture_warnings
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.numbers import MIN_LOAD_SCALE, numbers

MAX_LOAD_RATIO = 1.3
"""Ratio of the load over the largest pressure to first order in Re to that of a result above which effects cancel.

Of 1200 random pockets 2 % exceed it without another warning; a third of these miss their expected error of the load.
"""


def cautions(scene: Pocket) -> tuple[str, ...]:
    """The warnings for every model."""
    return turbulence_warnings(scene.reynolds_number)


def ruptures(scene: Pocket, lowest: float) -> tuple[str, ...]:
    """A warning if the film would cavitate; ``lowest`` is its lowest pressure above ambient over η u / Ly."""
    return rupture_warnings(
        lowest * scene.pressure_unit,
        scene.cavitation_pressure,
        scene.boundary.ambient_pressure,
        left_out_by="this model leaves out",
        remedy="take reynolds_cavitating, lower the speed, or raise boundary.ambient_pressure",
    )


def cancellations(scene: Pocket, *, load: float, lowest: float, highest: float) -> tuple[str, ...]:
    """A warning if effects cancel in the load, in which case its error is larger than the fitted laws expect.

    The laws use the load to first order in Re. ``load`` and the extreme pressures of a result have the same unit.
    """
    expected, largest = numbers(scene)["loaded"], max(abs(lowest), abs(highest))
    if not expected * largest > MAX_LOAD_RATIO * max(abs(load), MIN_LOAD_SCALE * largest):
        return ()
    return (
        f"load is {abs(load) / largest:.2g} of the largest pressure, and {expected:.2g} to first order in Re: effects "
        "cancel, and its relative error may exceed the expected one; take a more complete model or a finer resolution",
    )
