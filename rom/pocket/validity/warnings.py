"""Warnings where a pocket leaves the range of validity of a model."""

from roughfilm.rom.advice.laws import table
from roughfilm.rom.cavitation.shape import CELLS_PER_FEATURE
from roughfilm.rom.ladder.model import Effect, Model
from roughfilm.rom.parts.surroundings import rupture_warnings
from roughfilm.rom.pocket.scene import LAWS_IN_PLAN, Pocket
from roughfilm.rom.pocket.validity.numbers import MIN_LOAD_SCALE, numbers

MAX_LOAD_RATIO = 1.3
"""Ratio of the load over the largest pressure to first order in Re to that of a result above which effects cancel.

Of 1200 random pockets 2 % exceed it without another warning; a third of these miss their expected error of the load.
"""

STEEP = 1.0
"""Mean slope of a dimple above which thin films were not compared with Navier-Stokes flow in plan."""

INERTIAL = 1.0
"""Re · 2d/w of a cell in plan above which a film without inertia is out of its range.

In 39 random cells of every shape with lower numbers, full inertia changes the load by up to 5 % of the largest pressure
(11 % over one very shallow dimple), in 21 with higher ones by up to 24 %; 64 were solved by ``film`` on 32 columns.
"""

SECOND_ORDER = 1.0
"""Change of pressure by first-order inertia over the pressure without inertia above which higher orders count.

The load differs from that with full inertia by at most 0.8 % of the largest pressure in 38 of these cells below this
ratio, and by up to 16 % in 18 above it.
"""


UNKNOWN_ERROR = 0.5
"""Error of the lowest pressure over its size that is taken where no law gives it."""


def error_of_lowest(scene: Pocket, model: Model[Pocket]) -> float | None:
    """The error of the lowest pressure of a film that stays whole, by the laws, over its size; None if it is unknown.

    It is 0 for the complete model, whose error is that of its mesh.
    """
    if model.complete and {Effect.INERTIA, Effect.SLOPE} <= model.keeps:
        return 0.0
    laws, own = LAWS_IN_PLAN if scene.in_plan else scene.kind, numbers(scene)
    law = table().promise(laws, model.name).laws.get("pressure_min_plus")
    known = law is not None and law.has_numbers(own) and law.beyond(own) is None
    return law.error(own) if law is not None and known else None


def ruptures(scene: Pocket, model: Model[Pocket], lowest: float) -> tuple[str, ...]:
    """A warning if the film of a model falls below the cavitation pressure.

    ``lowest`` is its lowest pressure above ambient over η u / Ly. The film may rupture if the error of the model
    contains the cavitation pressure.
    """
    if lowest * scene.pressure_unit >= scene.cavitation_pressure:
        return ()
    error = error_of_lowest(scene, model)
    return rupture_words(scene, lowest, abs(lowest) * (UNKNOWN_ERROR if error is None else error))


def rupture_words(scene: Pocket, lowest: float, error: float) -> tuple[str, ...]:
    """A sentence if the film ruptures, or may within the error of its lowest pressure; both over η u / Ly."""
    unit, limit = scene.pressure_unit, scene.cavitation_pressure
    certain = (lowest + error) * unit < limit
    take = "reynolds_cavitating" if certain else "a model with more of inertia and slope"
    return rupture_warnings(
        lowest * unit,
        limit,
        scene.boundary.ambient_pressure,
        error=error * unit,
        left_out_by="this model leaves out",
        remedy=f"take {take}, lower the speed, or raise boundary.ambient_pressure",
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


def steep_warnings(scene: Pocket) -> tuple[str, ...]:
    """The warning where a dimple of a cell in plan is too steep for a thin film."""
    if not scene.slope > STEEP:
        return ()
    return (
        f"the mean slope of the steepest dimple is {scene.slope:.3g}, above {STEEP:g}: the film over it is not thin; "
        "take navier_stokes",
    )


def column_warnings(scene: Pocket, columns: int) -> tuple[str, ...]:
    """The warning where the narrowest dimple of a cell in plan has too few of so many columns along the cell."""
    own = columns * scene.geometry.narrowest / scene.geometry.length
    if own >= CELLS_PER_FEATURE:
        return ()
    return (
        f"the narrowest dimple has {own:.2g} columns, and the uncertainties may be too small; take at least "
        f"{CELLS_PER_FEATURE / own:.2g} times the resolution",
    )


def inertia_warnings(scene: Pocket, *, change: float | None = None) -> tuple[str, ...]:
    """The warning where a model without inertia, or with inertia to first order, leaves its range over a cell in plan.

    ``change`` is the greatest change of pressure by first-order inertia over the range of pressure without it; None
    for a model without inertia.
    """
    inertial = scene.reynolds_number * scene.aspect
    if change is None and inertial > INERTIAL:
        return (
            f"Re · 2d/w = {inertial:.3g} is above {INERTIAL:g}: inertia, which is left out, may change the load by a "
            "quarter of the largest pressure; take film or film_slope",
        )
    if change is not None and change > SECOND_ORDER:
        return (
            f"to first order in Re, inertia changes the pressure by {change:.3g} times its range without inertia: "
            "higher orders are left out and may be as large; take film or film_slope",
        )
    return ()
