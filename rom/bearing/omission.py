"""The effects that models of a bearing leave out and the error laws do not count.

These are heating, shear thinning, the length of ridges, and inertia or, of models with it, cavitation and slope.
"""

from functools import lru_cache

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.bearing.effects.inertia import inertia_obstacle
from roughfilm.rom.bearing.effects.viscosity import viscosity_omitted
from roughfilm.rom.bearing.effects.waves import waves_omitted
from roughfilm.rom.bearing.effects.wide_pad import wide_pad
from roughfilm.rom.bearing.equilibrium.expected import expected_film, expected_scene
from roughfilm.rom.bearing.inertia import inertia
from roughfilm.rom.bearing.keyed import KeyedScene, keyed
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.quantities import bearing_quantities
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.kind import Omission, kind_of_scene
from roughfilm.rom.ladder.model import Effect, Model

CELLS = {True: 512, False: 64}
"""Number of cells along a side, for an infinitely wide film (True) and for others."""

FILM_MIN = "film_min"

MIN_STEEPNESS = 0.5
"""Smallest exponent of the load over the film thickness by which a change of the load is divided."""

INERTIA_FIELDS = {"load_per_width": "load", "friction_per_width": "friction"}

SMALLEST_PART = 1e-6
"""Relative change below which an effect is not mentioned."""


def missing(scene: Bearing, model: Model[Bearing]) -> float:
    """The relative change of the load by the effects among inertia, cavitation and heating that a model leaves out.

    It is 0 where inertia is not resolved.
    """
    pad = wide_pad(scene)
    if pad is None:
        return 0.0
    changes = {Effect.INERTIA: pad.by_inertia, Effect.CAVITATION: pad.by_cavitation}
    viscosity = viscosity_omitted(scene, model, "load_per_width")
    of_viscosity = 0.0 if viscosity is None else viscosity.part
    return of_viscosity + sum(
        change("load_per_width") for effect, change in changes.items() if effect not in model.keeps
    )


def omission(scene: Bearing, model: Model[Bearing], quantity: str) -> Omission | None:
    """The relative change of a quantity by the effects that a model leaves out and the error laws do not count.

    Those of models with a uniform viscosity are heating and shear thinning
    (:mod:`roughfilm.rom.bearing.effects.viscosity`), of models with these effects the length of ridges
    (:mod:`roughfilm.rom.bearing.effects.waves`), of models without inertia inertia, of models that resolve the flow
    across the film cavitation, of ``film`` slope, and of ``film_slope`` its higher orders, which are taken to be at
    most the second one. None where they cannot be estimated or are below ``SMALLEST_PART``.
    """
    measured = [one for of in (viscosity_omitted, waves_omitted) if (one := of(scene, model, quantity)) is not None]
    inertia = None if Effect.INERTIA in model.keeps else inertia_omitted(scene, quantity)
    if not measured and not model.keeps & {Effect.INERTIA, Effect.SLOPE}:
        return inertia
    others = [] if not model.keeps & {Effect.INERTIA, Effect.SLOPE} else _of_pad(scene, model, quantity)
    parts = [one for one in (inertia, *others) if one is not None and one.part > SMALLEST_PART]
    parts = [*measured, *parts]
    if not parts:
        return None
    return Omission(
        part=sum(one.part for one in parts),
        reason="; ".join(one.reason for one in parts),
        source=measured[0].source if measured else "",
    )


def _of_pad(scene: Bearing, model: Model[Bearing], quantity: str) -> list[Omission]:
    """The changes by cavitation, and by slope where a model does not keep it in full."""
    pad = wide_pad(scene)
    if pad is None:
        return []
    found = []
    if pad.ruptures:
        part = pad.by_cavitation(quantity)
        reason = f"the film ruptures, and cavitation changes {_named(quantity)} {_by(part)} in the Reynolds equation"
        found.append(Omission(part=part, reason=reason))
    if Effect.SLOPE not in model.keeps or not model.complete:
        part = pad.by_slope(quantity)
        orders = "slope to second order" if Effect.SLOPE not in model.keeps else "slope beyond the second order"
        bound = "" if Effect.SLOPE not in model.keeps else " at most"
        found.append(Omission(part=part, reason=f"{orders} changes {_named(quantity)}{bound} {_by(part)}"))
    return found


def _named(quantity: str) -> str:
    return f"the {INERTIA_FIELDS[quantity]}" if quantity in INERTIA_FIELDS else quantity


def _by(part: float) -> str:
    return f"by about {100 * part:.2g} %"


def _of_film(scene: Bearing) -> Omission | None:
    """The change of the film thickness under a load: that of the load at a given film over the steepness."""
    expected = expected_film(scene)
    of_load = inertia_omitted(scene.at_film(expected.thickness), "load_per_width")
    if of_load is None:
        return None
    part = of_load.part / max(expected.steepness, MIN_STEEPNESS)
    reason = f"{of_load.reason} at a given film, and the film under the load by about {100 * part:.2g} %"
    return Omission(part=part, reason=reason)


def inertia_omitted(scene: Bearing, quantity: str) -> Omission | None:
    """The relative change of load or friction of the smooth film by inertia; None where it cannot be estimated.

    In an infinitely wide pad whose film does not rupture it is that of ``film``, otherwise that of first order.

    Raises
    ------
    ConvergenceError
        If the film does not converge.
    """
    if inertia_obstacle(scene) is not None or quantity not in (*INERTIA_FIELDS, FILM_MIN):
        return None
    if quantity == FILM_MIN:
        return None if scene.load is None else _of_film(scene)
    pad, number = wide_pad(scene), bearing_numbers(scene)["reduced_reynolds_number"]
    resolved = pad is not None and not pad.ruptures
    fraction = pad.by_inertia(quantity) if pad is not None and resolved else _first_order(scene, quantity)
    change = _by(fraction) if resolved or fraction < 1 else "by more than the first-order estimate can predict"
    kept = "which film and film_slope include" if pad is not None else "which no model of this bearing includes"
    return Omission(
        part=fraction,
        reason=f"reduced Reynolds number Re·h/L = {number:.2g}: inertia, {kept}, changes the "
        f"{INERTIA_FIELDS[quantity]} {change}",
    )


def _first_order(scene: Bearing, quantity: str) -> float:
    """The relative change of load or friction by inertia to first order, of the film with cavitation."""
    found = _first_orders(keyed(scene))
    if isinstance(found, ConvergenceError):
        raise found
    return found[quantity]


@lru_cache(maxsize=16)
def _first_orders(question: KeyedScene) -> dict[str, float] | ConvergenceError:
    """The relative changes of load and friction by inertia to first order, from one film; its error if it fails."""
    try:
        scene = expected_scene(question.scene)
        solution = solve(scene.problem(), (CELLS[scene.wide],) * 2)
    except ConvergenceError as error:
        return error
    width = 1.0 if scene.geometry.width is None else scene.geometry.width
    values = {name: one.value for name, one in bearing_quantities(scene, solution).items()}
    kind, found, changes = kind_of_scene(scene), inertia(scene, solution), {}
    for quantity, name in INERTIA_FIELDS.items():
        size = float(kind.scale(values, quantity))
        changes[quantity] = abs(getattr(found, name)) / width / size if size > 0 else 0.0
    return changes
