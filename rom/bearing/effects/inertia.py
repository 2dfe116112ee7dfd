"""What inertia would add to a composed bearing: to first order over its whole film, and in one pocket by the ladder."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.contact.foundation.units import with_unit
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.bearing.effects.ablation import Amount, Composed, Composition, added, solved_grids
from roughfilm.rom.bearing.effects.under_load import under_load
from roughfilm.rom.bearing.inertia import Inertia, inertia
from roughfilm.rom.bearing.numbers import bearing_numbers, without_texture
from roughfilm.rom.bearing.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.solve import load_loops
from roughfilm.rom.bearing.texture import Texture
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.ladder.model import Model, find, of_kind
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.studies.convergence import converge

FIRST_ORDER = "inertial_reynolds"
"""The rung of pockets that keeps as much of inertia as is kept here; the cheapest that is enough judges it."""

JUDGED_BY, WITHIN = "load_plus", 0.05
"""What of one pocket it must be near in, and how near."""

PERIOD = 2.0
"""Lengths of a pocket from one to the next, where one alone is judged."""

ORDER = 2
"""Of the loads in the cells, where nothing is torn."""

UNITS: Mapping[str, str] = {"load": "N", "friction": "N", "inlet_flow": "m^3/s"}


@dataclass(frozen=True, kw_only=True)
class PocketJudged:
    """One pocket between flat lands: by which model, why, its load over that of first-order inertia, and by which part
    that model may be off.
    """

    model: str
    why: str
    over_first_order: float
    within: float


@dataclass(frozen=True, kw_only=True)
class InertiaAdded:
    """What inertia adds to a film in balance, to first order; never a part of what the film is said to carry.

    Attributes
    ----------
    amounts : of ``load``, ``friction`` and ``inlet_flow``, over the whole bearing (per width if infinitely wide).
    untextured_load : what it adds without the pockets, in the same film; None where ``pocket`` is.
    pocket : what the models of pockets say of one; None without pockets, and where they cannot tell.
    """

    amounts: Mapping[str, Amount]
    untextured_load: float | None
    pocket: PocketJudged | None


def judged(scene: Bearing) -> str | None:
    """Why inertia cannot be judged, in words; None where it can."""
    if scene.lubricant.density is None:
        return "the scene does not say how dense the lubricant is"
    if isinstance(scene.geometry, Ring):
        return "on a ring the liquid also turns, which is not looked at"
    if scene.motion.speed == 0:
        return "nothing slides"
    return None


def inertia_added(taken: Composition, cells: int, models: Sequence[Model]) -> InertiaAdded:
    """First-order inertia of a composition's film, its error by two grids and by the nonlinear film in one pocket.

    ``models`` : of pockets, among others; the cheapest is taken that is enough.

    Raises
    ------
    InputError
        Where it cannot be judged, as :func:`judged` says.
    ConvergenceError
        If a film does not come into balance.
    """
    scene = taken.scene
    load_loops(scene.wide)
    grids = solved_grids(solve(taken.problem(), (cells, cells), ruptures=taken.ruptures))
    found = {grid.grid.x.size: inertia(scene, grid) for grid in reversed(grids)}
    pocket = one_pocket(scene, models)
    number = bearing_numbers(scene)["reduced_reynolds_number"]
    beyond = min(1.0, number) if pocket is None else abs(pocket.over_first_order - 1) + pocket.within
    bare = None
    if pocket is not None:
        smooth = without_texture(scene)
        plain = Composition(scene=smooth, sides=taken.sides, ruptures=taken.ruptures, factors=taken.factors)
        bare = inertia(smooth, solve(plain.problem(), (cells, cells), ruptures=taken.ruptures)).load
    return InertiaAdded(
        amounts={name: _amount(name, found, beyond, wide=scene.wide) for name in UNITS},
        untextured_load=bare,
        pocket=pocket,
    )


def _amount(name: str, found: Mapping[int, Inertia], beyond: float, *, wide: bool) -> Amount:
    """On the finest of some grids; as a film's torn part has an edge of cells, they are not trusted to be ordered."""
    values = [getattr(one, name) for one in found.values()]
    error = converge([*found], values, formal_order=ORDER).uncertainty if len(values) > 1 else math.inf
    unit = {"N": "N/m", "m^3/s": "m^2/s"}[UNITS[name]] if wide else UNITS[name]
    return Amount(value=values[-1], uncertainty=error + beyond * abs(values[-1]), unit=unit)


def one_pocket(scene: Bearing, models: Sequence[Model]) -> PocketJudged | None:
    """A pocket in the middle line of its texture, between flat lands as far apart as the walls are there.

    None for walls without pockets, for pockets that are no scene of their own, such as those deeper than a half circle,
    and where no model knows how near it is. The film is that at the middle of the first column, the thickest and so the
    heaviest of a film that narrows; a flat floor counts as an arc.
    """
    texture, density = getattr(scene.geometry, "texture", None), scene.lubricant.density
    if texture is None or density is None:
        return None
    try:
        return _judged_pocket(scene, texture, density, of_kind(models, "pocket"))
    except (InputError, ConvergenceError, UnavailableError):
        return None


def _judged_pocket(scene: Bearing, texture: Texture, density: float, models: Sequence[Model]) -> PocketJudged | None:
    shape = without_texture(scene).geometry.film_shape()
    place = texture.start + texture.length / 2
    film = float(shape.thickness(np.array([place]), np.array([sum(shape.across) / 2]))[0])
    lengths = {"length": PERIOD * texture.length, "film": film, "width": texture.length, "depth": texture.depth}
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
        }
    )
    found = advise(pocket, models, quantity=JUDGED_BY, within=WITHIN)
    judge = found.chosen or found.nearest
    if judge is None or judge.error is None or judge.error > 1 or not judge.sure:
        return None
    first = find(models, "pocket", FIRST_ORDER).solve(pocket).quantities["load_per_area"].value
    told = found.result or find(models, "pocket", judge.model).solve(pocket, Request(resolution=judge.resolution))
    ratio = told.quantities["load_per_area"].value / first
    return PocketJudged(model=judge.model, why=judge.reason, over_first_order=ratio, within=judge.error)


def under_its_load(
    taken: Composition, whole: Composed, pressure: float, cells: int, models: Sequence[Model]
) -> tuple[InertiaAdded, Amount]:
    """What inertia adds at the film that carries a load, Pa over the nominal area, and how much thicker it makes it, m.

    ``whole`` is the composition under that load; with inertia its film has so much less to carry.
    """
    scene = taken.scene
    there = scene.model_copy(update={"geometry": scene.geometry.at_film(whole.values["film"])})
    found = inertia_added(replace(taken, scene=there), cells, models)
    load = found.amounts["load"]
    part = load.value / whole.values["load_per_width" if scene.wide else "load"]
    relieved = under_load(taken, pressure * (1 - part), cells)
    thicker = added(relieved, whole, "film")
    assert thicker is not None
    relative = load.uncertainty / abs(load.value) if load.value else 0.0
    unsure = abs(thicker.value) * relative + thicker.uncertainty
    return found, Amount(value=thicker.value, uncertainty=unsure, unit="m")
