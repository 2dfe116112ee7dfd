"""The changes of a bearing by inertia: to first order over the whole film, and fully in one pocket."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.contact.foundation.units import with_unit
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.bearing.effects.ablation import Amount, Variant, VariantSolution, difference
from roughfilm.rom.bearing.effects.under_load import under_load
from roughfilm.rom.bearing.inertia import Inertia, inertia
from roughfilm.rom.bearing.numbers import bearing_numbers, without_inertia, without_texture
from roughfilm.rom.bearing.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.texture import Texture
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.evaluation.grids import cells_of, grid_sequence, grid_uncertainty
from roughfilm.rom.cavitation.solve import load_loops, solve
from roughfilm.rom.ladder.model import Model, find, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

FIRST_ORDER = "inertial_reynolds"
"""The model of pockets with the same first-order inertia, to which the cheapest sufficient model is compared."""

RESOLVED = "film"
"""The model of wide pads with all of inertia, to which the first order is compared."""

POCKET_QUANTITY = "load_plus"
"""Quantity of one pocket by which its model is chosen."""

NO_CAVITATION = "1e12 Pa"
"""Ambient pressure of a pocket whose inertia is judged apart from cavitation."""

POCKET_TOLERANCE = 0.05
"""Relative error up to which a model of one pocket is sufficient."""

POCKET_PERIOD_RATIO = 2.0
"""Period over the length of a pocket in the scene of one pocket."""

UNITS: Mapping[str, tuple[str, str]] = {
    "load": ("N", "N/m"),
    "friction": ("N", "N/m"),
    "inlet_flow": ("m^3/s", "m^2/s"),
}
"""Units of the changes by inertia, of bearings with a width and of infinitely wide ones."""


@dataclass(frozen=True, kw_only=True)
class PocketInertia:
    """The effect of inertia in one pocket between flat lands.

    Attributes
    ----------
    model : model of the pocket.
    why : reason for the model.
    over_first_order : load of the pocket over its load with first-order inertia.
    within : relative error of the model.
    """

    model: str
    why: str
    over_first_order: float
    within: float


@dataclass(frozen=True, kw_only=True)
class InertiaAdded:
    """The changes of a converged film by inertia, to first order; quantities of the film do not include them.

    Attributes
    ----------
    amounts : changes of ``load``, ``friction`` and ``inlet_flow`` of the bearing (per width if infinitely wide).
    untextured_load : change of the load without the pockets; None where ``pocket`` is None.
    pocket : effect of inertia in one pocket; None without pockets, or if no model can solve one.
    """

    amounts: Mapping[str, Amount]
    untextured_load: float | None
    pocket: PocketInertia | None


def inertia_obstacle(scene: Bearing) -> str | None:
    """The reason why inertia cannot be estimated; None if it can."""
    if scene.lubricant.density is None:
        return "the scene has no lubricant.density"
    if isinstance(scene.geometry, Ring):
        return "centrifugal forces on rings are not modelled"
    if scene.motion.speed == 0:
        return "the sliding speed is zero"
    return None


def inertia_added(variant: Variant, cells: int, models: Sequence[Model]) -> InertiaAdded:
    """Compute the first-order changes by inertia, with their uncertainty from coarser grids and from one pocket.

    Parameters
    ----------
    cells : number of cells along a side.
    models : models, among them those of pockets, of which the cheapest sufficient one is used.

    Raises
    ------
    InputError
        If inertia cannot be estimated (:func:`inertia_obstacle`).
    ConvergenceError
        If a film does not converge.
    """
    scene = variant.scene
    load_loops(scene.wide)
    grids = grid_sequence(solve(variant.problem(), (cells, cells), ruptures=variant.ruptures))
    changes = {cells_of(grid): inertia(scene, grid) for grid in grids}
    pocket = pocket_inertia(scene, models)
    number = bearing_numbers(scene)["reduced_reynolds_number"]
    higher_orders = min(1.0, number) if pocket is None else abs(pocket.over_first_order - 1) + pocket.within
    untextured_load = None
    if pocket is not None:
        smooth = without_texture(scene)
        problem = replace(variant, scene=smooth).problem()
        untextured_load = inertia(smooth, solve(problem, (cells, cells), ruptures=variant.ruptures)).load
    amounts = {name: _amount(name, changes, higher_orders, wide=scene.wide) for name in UNITS}
    whole = not (grids[0].kind == CAVITY).any()
    return InertiaAdded(
        amounts=_with_full_inertia(scene, amounts, models) if whole else amounts,
        untextured_load=untextured_load,
        pocket=pocket,
    )


def _amount(name: str, changes: Mapping[float, Inertia], higher_orders: float, *, wide: bool) -> Amount:
    """The change on the finest grid, which is the first, with the uncertainty of grids and of higher orders."""
    values = [getattr(change, name) for change in changes.values()]
    error = grid_uncertainty([*changes], values) if len(values) > 1 else math.inf
    return Amount(value=values[0], uncertainty=error + higher_orders * abs(values[0]), unit=UNITS[name][wide])


def _with_full_inertia(scene: Bearing, amounts: Mapping[str, Amount], models: Sequence[Model]) -> dict[str, Amount]:
    """The changes to first order, whose uncertainty contains that by the model ``film`` of wide pads if it applies.

    The film must not rupture.
    """
    film = next((model for model in of_kind(models, "bearing") if model.name == RESOLVED), None)
    if film is None or not film.applies(scene).applies:
        return dict(amounts)
    try:
        one, other = film.solve(scene), film.solve(without_inertia(scene))
    except ConvergenceError:
        return dict(amounts)
    found = {}
    for name, amount in amounts.items():
        quantity = f"{name}_per_width"
        change = one[quantity].value - other[quantity].value
        uncertainty = abs(change - amount.value) + (one[quantity].uncertainty or 0.0)
        found[name] = replace(amount, uncertainty=max(amount.uncertainty, uncertainty))
    return found


def pocket_inertia(scene: Bearing, models: Sequence[Model]) -> PocketInertia | None:
    """The effect of inertia in a cylindrical pocket of the first column between flat lands.

    None without pockets, for pockets outside the range of the models (such as those deeper than a half circle), and if
    no model has a known error. The lands have the film thickness at the centre of the first column, where inertia is
    strongest in a film that narrows.
    """
    texture, density = getattr(scene.geometry, "texture", None), scene.lubricant.density
    if texture is None or density is None:
        return None
    try:
        return _solved_pocket(scene, texture, density, of_kind(models, "pocket"))
    except (InputError, ConvergenceError, UnavailableError):
        return None


def _solved_pocket(scene: Bearing, texture: Texture, density: float, models: Sequence[Model]) -> PocketInertia | None:
    shape = without_texture(scene).geometry.film_shape()
    centre = texture.start + texture.length / 2
    film = float(shape.thickness(np.array([centre]), np.array([sum(shape.across) / 2]))[0])
    lengths = {
        "length": POCKET_PERIOD_RATIO * texture.length,
        "film": film,
        "width": texture.length,
        "depth": texture.depth,
    }
    pocket = read_scene(
        {
            "name": f"a pocket of {scene.name}"[:200],
            "kind": "pocket",
            "geometry": {"profile": "cylindrical", **{name: with_unit(value, "m") for name, value in lengths.items()}},
            "lubricant": {
                "viscosity": with_unit(scene.lubricant.viscosity, "Pa*s"),
                "density": with_unit(density, "kg/m^3"),
            },
            "motion": {"speed": with_unit(abs(scene.motion.speed), "m/s")},
            "boundary": {"ambient_pressure": NO_CAVITATION},
        }
    )
    advice = advise(pocket, models, quantity=POCKET_QUANTITY, within=POCKET_TOLERANCE)
    verdict = advice.chosen or advice.nearest
    if verdict is None or verdict.error is None or verdict.error > 1 or not verdict.sure:
        return None
    first = find(models, "pocket", FIRST_ORDER).solve(pocket).quantities["load_per_area"].value
    request = Request(resolution=verdict.resolution)
    result = advice.result or find(models, "pocket", verdict.model).solve(pocket, request)
    ratio = result.quantities["load_per_area"].value / first
    return PocketInertia(model=verdict.model, why=verdict.why, over_first_order=ratio, within=verdict.error)


def inertia_under_load(
    variant: Variant, whole: VariantSolution, pressure: float, cells: int, models: Sequence[Model]
) -> tuple[InertiaAdded, Amount]:
    """The changes by inertia at the film under a load, and the increase of the film thickness by inertia, m.

    Parameters
    ----------
    whole : the variant under the load.
    pressure : the load over the nominal area, Pa.
    """
    scene = variant.scene
    loaded = scene.at_film(whole.values["film"])
    changes = inertia_added(replace(variant, scene=loaded), cells, models)
    load = changes.amounts["load"]
    fraction = load.value / whole.values["load_per_width" if scene.wide else "load"]
    relieved = under_load(variant, pressure * (1 - fraction), cells)
    thicker = difference(relieved, whole, "film")
    assert thicker is not None
    relative = load.uncertainty / abs(load.value) if load.value else 0.0
    uncertainty = abs(thicker.value) * relative + thicker.uncertainty
    return changes, Amount(value=thicker.value, uncertainty=uncertainty, unit="m")
