"""The changes of a bearing by inertia and slope: in full by models of infinitely wide pads, or inertia to first order.

To first order over the whole film, the effect of higher orders is estimated in one pocket.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.contact.foundation.units import with_unit
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.bearing.effects.ablation import Amount, Variant, VariantSolution, difference
from roughfilm.rom.bearing.effects.under_load import under_load
from roughfilm.rom.bearing.effects.wide_pad import WideFilm, wide_films
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.geometry.texture import Texture
from roughfilm.rom.bearing.inertia import inertia
from roughfilm.rom.bearing.numbers import bearing_numbers, without_texture
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.evaluation.grids import cells_of, grid_sequence, grid_uncertainty
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.model import Model, find, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

FIRST_ORDER = "first order"
"""The model of inertia where no model of the bearing includes it."""

FULL = "film"
"""The model of inertia of an infinitely wide pad."""

POCKET_FIRST_ORDER = "inertial_reynolds"
"""The model of pockets with the same first-order inertia, to which the cheapest sufficient model is compared."""

POCKET_QUANTITY = "load_plus"
"""Quantity of one pocket by which its model is chosen."""

NO_CAVITATION = "1e12 Pa"
"""Ambient pressure of a pocket whose inertia is judged apart from cavitation."""

POCKET_TOLERANCE = 0.05
"""Relative error up to which a model of one pocket is sufficient."""

POCKET_PERIOD_RATIO = 2.0
"""Period over the length of a pocket in the scene of one pocket."""

MAX_REPETITIONS = 5
"""Largest number of repetitions with the inertia of the thicker film."""

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
    """The changes of a converged film by inertia, and by slope; quantities of the film do not include them.

    Attributes
    ----------
    model : ``FULL``, the difference of ``film`` and the same film without density, or ``FIRST_ORDER``.
    amounts : changes of ``load``, ``friction`` and ``inlet_flow`` of the bearing (per width if infinitely wide).
    slope : changes of the same quantities by slope to second order, ``film_slope`` minus ``film``; None at first order.
    untextured_load : change of the load by inertia without the pockets; None where there are none, or if it is unknown.
    pocket : effect of inertia in one pocket; None in full, without pockets, or if no model can solve one.
    """

    model: str
    amounts: Mapping[str, Amount]
    slope: Mapping[str, Amount] | None
    untextured_load: float | None
    pocket: PocketInertia | None


def inertia_obstacle(scene: Bearing) -> str | None:
    """The reason why inertia cannot be estimated; None if it can."""
    if scene.lubricant.density is None:
        return "the scene has no lubricant.density"
    if isinstance(scene.geometry, Ring):
        return "centrifugal forces on rings are not modelled"
    if scene.motion.approach != 0:
        return "inertia of walls that approach each other is not modelled"
    if isinstance(scene.geometry, MovingWall):
        return "it is not modelled where a wall moves freely, as in lobes"
    if scene.supply:
        return "it is not modelled where lubricant is supplied inside of the film"
    if scene.motion.speed == 0:
        return "the sliding speed is zero"
    return None


def inertia_added(variant: Variant, cells: int, models: Sequence[Model]) -> InertiaAdded:
    """Compute the changes by inertia, and by slope where it is resolved, with their uncertainty from coarser grids.

    In an infinitely wide pad to which ``film`` applies, and whose film does not rupture, they are differences of models
    on one grid. Elsewhere inertia is of first order, and its uncertainty includes that of one pocket.

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
    films, smooth = wide_films(scene), without_texture(scene)
    if films:
        plain = () if smooth is scene else wide_films(smooth)
        return InertiaAdded(
            model=FULL,
            amounts=_differences(films, WideFilm.by_inertia),
            slope=_differences(films, WideFilm.by_slope),
            untextured_load=plain[0].by_inertia("load_per_width") if plain else None,
            pocket=None,
        )
    grids = grid_sequence(solve(variant.problem(), (cells, cells), ruptures=variant.ruptures))
    changes = {cells_of(grid): inertia(scene, grid) for grid in grids}
    pocket = pocket_inertia(scene, models)
    number = bearing_numbers(scene)["reduced_reynolds_number"]
    higher_orders = min(1.0, number) if pocket is None else abs(pocket.over_first_order - 1) + pocket.within
    untextured_load = None
    if pocket is not None:
        problem = replace(variant, scene=smooth).problem()
        untextured_load = inertia(smooth, solve(problem, (cells, cells), ruptures=variant.ruptures)).load
    return InertiaAdded(
        model=FIRST_ORDER,
        amounts={
            name: _amount(
                name, {cells: getattr(one, name) for cells, one in changes.items()}, scene.wide, higher_orders
            )
            for name in UNITS
        },
        slope=None,
        untextured_load=untextured_load,
        pocket=pocket,
    )


def _differences(films: Sequence[WideFilm], change: Callable[[WideFilm, str], float]) -> dict[str, Amount]:
    """The changes of an infinitely wide pad between two models."""
    return {
        name: _amount(name, {film.cells: change(film, f"{name}_per_width") for film in films}, wide=True)
        for name in UNITS
    }


def _amount(name: str, changes: Mapping[float, float], wide: bool, higher_orders: float = 0.0) -> Amount:
    """The change on the finest grid, which is the first, with the uncertainty of grids and of higher orders."""
    values = [*changes.values()]
    error = grid_uncertainty([*changes], values) if len(values) > 1 else math.inf
    return Amount(value=values[0], uncertainty=error + higher_orders * abs(values[0]), unit=UNITS[name][wide])


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
    first = find(models, "pocket", POCKET_FIRST_ORDER).solve(pocket).quantities["load_per_area"].value
    request = Request(resolution=verdict.resolution)
    result = advice.result or find(models, "pocket", verdict.model).solve(pocket, request)
    ratio = result.quantities["load_per_area"].value / first
    return PocketInertia(model=verdict.model, why=verdict.why, over_first_order=ratio, within=verdict.error)


def inertia_under_load(
    variant: Variant, whole: VariantSolution, pressure: float, cells: int, models: Sequence[Model]
) -> tuple[InertiaAdded, Amount]:
    """The changes by inertia at the film under a load, and the increase of the film thickness by inertia, m.

    In full, inertia is that of the thicker film, found by repetition, whose last step is part of the uncertainty.

    Parameters
    ----------
    whole : the variant under the load.
    pressure : the load over the nominal area, Pa.
    """
    scene = variant.scene

    def at(film: float) -> tuple[InertiaAdded, Amount]:
        """The changes at a film thickness, and the increase of the film if they are those of the load."""
        changes = inertia_added(replace(variant, scene=scene.at_film(film)), cells, models)
        load = changes.amounts["load"]
        fraction = load.value / whole.values["load_per_width" if scene.wide else "load"]
        thicker = difference(under_load(variant, pressure * (1 - fraction), cells), whole, "film")
        assert thicker is not None
        relative = load.uncertainty / abs(load.value) if load.value else 0.0
        return changes, replace(thicker, uncertainty=abs(thicker.value) * relative + thicker.uncertainty)

    film = whole.values["film"]
    changes, thicker = at(film)
    if changes.model != FULL:
        return changes, thicker
    step = math.inf
    for _ in range(MAX_REPETITIONS):
        before, thicker = thicker, at(film + thicker.value)[1]
        step = abs(thicker.value - before.value)
        if step <= thicker.uncertainty:
            break
    return changes, replace(thicker, uncertainty=thicker.uncertainty + step)
