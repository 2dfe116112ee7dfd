"""The solution of a bearing's film as a result, with its uncertainty and warnings."""

import math
import time
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Protocol

import numpy as np

from roughfilm.contact.foundation.timing import working_time
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.corners import unknown_by_infinite_flows
from roughfilm.rom.bearing.equilibrium.balance import SeparableBearing
from roughfilm.rom.bearing.equilibrium.films import ModelFilms
from roughfilm.rom.bearing.equilibrium.grids import FILM_RESIDUAL, FILM_STEP, Search, converted, under_load
from roughfilm.rom.bearing.film import Searched, smooth_films
from roughfilm.rom.bearing.free.evaluated import evaluated
from roughfilm.rom.bearing.free.solve import PlacedFilm, WithField, solve_free
from roughfilm.rom.bearing.geometry.journal import Journal
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.outside import film_outside
from roughfilm.rom.bearing.quantities import EXACT, FILM_OUTPUTS, Fields, Outputs
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.supply.quantities import supply_warnings
from roughfilm.rom.bearing.totals.reported import in_order
from roughfilm.rom.bearing.totals.rounding import NO_LOAD, beyond_rounding
from roughfilm.rom.bearing.totals.whole import whole_bearing
from roughfilm.rom.bearing.uncertainty import POSITIONS, beyond_half_a_turn, uncertainties
from roughfilm.rom.bearing.warnings import (
    pad_warnings,
    pressure_warnings,
    rupture_warnings,
    scene_warnings,
    thickness_warnings,
    window_warnings,
)
from roughfilm.rom.cavitation.evaluation.filling import density_ratio
from roughfilm.rom.cavitation.evaluation.grids import grid_sequence, grid_warnings
from roughfilm.rom.cavitation.evaluation.numerics import numerics_of
from roughfilm.rom.cavitation.motion.contact import ContactLaw
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import Level, Solution
from roughfilm.rom.cavitation.solve import solve as balance
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap
from roughfilm.rom.ladder.model import Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import NO_COARSER_GRID, Field, Result, with_uncertainties

FilmsOnGrid = Callable[[Bearing, int], SeparableBearing[Any]]
"""films(scene, cells), the films of a model on a grid of so many cells along and across."""


class Heat(Protocol):
    """The coupling of the films of one scene with their temperatures."""

    def film(self, *, tolerance: float, ruptures: bool) -> Callable[[Solution], Solution]:
        """heated(solution), the film on a grid with the viscosities of its temperatures."""
        ...

    def loaded(self) -> Callable[[SeparableBearing[Any], Search[Any]], Any]:
        """heated(films, search), the film that carries a load with the viscosities of its temperatures."""
        ...

    def placed(self) -> Callable[[WithField], PlacedFilm]:
        """heated(at), the film of a wall that moves freely with the viscosities of its temperatures."""
        ...


def solve(
    solver: Model[Bearing],
    scene: Bearing,
    request: CheckedRequest,
    progress: Progress,
    *,
    film: Callable[[Bearing], Problem],
    ruptures: bool,
    outputs: Outputs = FILM_OUTPUTS,
    searched: Callable[[Bearing], Searched] | None = None,
    films: FilmsOnGrid | None = None,
    contact: Callable[[Bearing], ContactLaw] | None = None,
    heat: Heat | None = None,
) -> Result:
    """Solve the film of a bearing on successively finer grids and estimate the uncertainty of its quantities.

    With a load the film thickness is sought at which the film carries it, on each of the grids.

    Parameters
    ----------
    solver : the model.
    film : film(scene), the problem that the model solves.
    ruptures : whether the film cavitates.
    outputs : the functions that evaluate the film.
    searched : searched(scene), the films among which that under a load is sought; by default those of a smooth wall.
    films : films(scene, cells), the films on a grid, of models with a contact load.
    contact : contact(scene), the contact pressure over the film thickness, of these models.
    heat : the coupling of the film with its temperatures; None of isothermal models.

    Raises
    ------
    InputError
        If no film carries the load of the scene.
    ConvergenceError
        If the film or its load does not converge.
    """
    cells = request.resolution
    scene.without_time()  # which refuses a scene that has loads over time alone
    if isinstance(scene.geometry, MovingWall):
        law = None if contact is None else contact(scene)
        among = searched(scene) if searched is not None and scene.load is not None and law is None else None
        wall, cpu = time.perf_counter(), working_time()
        found = _free(
            scene,
            request,
            film if among is None else among.film,
            outputs,
            known_from=None if among is None else among.known_from,
            ruptures=ruptures,
            contact=law,
            heat=heat,
            progress=progress,
        )
    elif scene.load is None:
        problem = film(scene)
        wall, cpu = time.perf_counter(), working_time()
        found = _as_given(scene, problem, request, outputs, ruptures=ruptures, heat=heat, progress=progress)
    else:
        wall, cpu = time.perf_counter(), working_time()
        among = (searched or partial(smooth_films, film=film))(scene)
        if films is None:
            films = partial(_films, among=among, ruptures=ruptures, tolerance=request.tolerance)
        found = _under_load(scene, cells, among, films, outputs, heat, progress)
    solution, quantities = found.levels[0]
    of_factors = found.of_factors
    iterated = outputs.iteration_uncertainties(found.scene, [grid for grid, _ in found.levels], quantities)
    more = {name: of_factors.get(name, 0.0) + iterated.get(name, 0.0) for name in {*of_factors, *iterated}}
    uncertainty = uncertainties(found.levels, more, found.balance, exact=found.exact, apart=found.apart)
    estimated = outputs.of_finest(found.scene, solution)
    warnings = [
        *grid_warnings(solution),
        *thickness_warnings(found.scene, solution),
        *pressure_warnings(solution),
        *rupture_warnings(solution.state.pressure),
        *scene_warnings(scene, solution),
        *window_warnings(found.scene, solution),
        *supply_warnings(found.scene, solution),
        *pad_warnings(found.scene, solution),
        *outputs.warnings(found.scene, solution),
    ]
    if not uncertainty:
        warnings.append(NO_COARSER_GRID)
    explained = unknown_by_infinite_flows(solution) | {*POSITIONS, *outputs.estimates}
    if turned := [name for name in beyond_half_a_turn(uncertainty) if math.isfinite(more.get(name, 0.0))]:
        warnings.append(f"{', '.join(turned)}: unknown uncertainty, as it is more than half a turn; take more cells")
        explained |= {*turned}
    if unknown := [name for name, value in uncertainty.items() if not math.isfinite(value) and name not in explained]:
        warnings.append(f"{', '.join(unknown)}: unknown uncertainty, as the roughness has too few points")
    known = beyond_rounding(found.scene, solution, with_uncertainties(quantities, uncertainty))
    if known["load_per_width"].value == 0:
        warnings.append(NO_LOAD)
    return Result(
        model=solver.name,
        quantities=in_order(scene, whole_bearing(found.scene, {**known, **estimated})),
        fields=_fields(scene, solution, outputs.fields(found.scene, solution)),
        numerics=numerics_of(
            solution,
            found.solved,
            request,
            cpu_s=working_time() - cpu,
            wall_s=time.perf_counter() - wall,
            details={
                **({} if found.balance is None else {"balance": found.balance, "films": float(found.films)}),
                **outputs.details(solution),
            },
        ),
        provenance=provenance(
            scene,
            model=solver.name,
            keeps=tuple(solver.keeps),
            sources=solver.sources,
            **origin_of(solution.problem.shape.roughness),
        ),
        warnings=tuple(warnings),
        outside=(*film_outside(found.scene, solution), *outputs.outside(found.scene, solution)),
    )


@dataclass(frozen=True, kw_only=True)
class _Found:
    """A film on its grids.

    Attributes
    ----------
    scene : the scene at the film thickness of the finest grid.
    levels : the film and its quantities, the finest grid first.
    of_factors : uncertainties that come from flow factors and contact pressures, by quantity.
    solved : cells and iterations of all solves.
    balance : relative error of the load; None if the film was given.
    films : number of films that were solved.
    exact : quantities that have no error of the grid.
    apart : smallest differences of quantities of the place of a wall on two grids.
    """

    scene: Bearing
    levels: tuple[tuple[Solution, Mapping[str, Quantity]], ...]
    of_factors: Mapping[str, float]
    solved: tuple[Level, ...]
    balance: float | None = None
    films: int = 1
    exact: Collection[str] = EXACT
    apart: Mapping[str, float] = field(default_factory=dict)


def _as_given(
    scene: Bearing,
    problem: Problem,
    request: CheckedRequest,
    outputs: Outputs,
    *,
    ruptures: bool,
    heat: Heat | None,
    progress: Progress,
) -> _Found:
    """The film of a given thickness."""
    solution = balance(
        problem,
        (request.resolution, request.resolution),
        tolerance=request.tolerance,
        ruptures=ruptures,
        heated=None if heat is None else heat.film(tolerance=request.tolerance, ruptures=ruptures),
        progress=progress,
    )
    levels = tuple((grid, outputs.quantities(scene, grid)) for grid in grid_sequence(solution))
    averaged = problem.shape.roughness is not None
    return _Found(
        scene=scene,
        levels=levels,
        of_factors=outputs.factor_uncertainties(scene, solution, levels[0][1]) if averaged else {},
        solved=solution.levels,
    )


def _free(
    scene: Bearing,
    request: CheckedRequest,
    film: Callable[[Bearing], Problem],
    outputs: Outputs,
    *,
    known_from: float | None,
    ruptures: bool,
    contact: ContactLaw | None,
    heat: Heat | None,
    progress: Progress,
) -> _Found:
    """The film of a bearing whose wall moves freely."""
    free = solve_free(
        scene,
        request.resolution,
        film=film,
        ruptures=ruptures,
        contact=contact,
        tolerance=min(request.tolerance, FILM_RESIDUAL),
        heated=None if heat is None else heat.placed(),
        progress=progress,
    )
    found = evaluated(free, outputs, known_from=known_from)
    return _Found(
        scene=free.scenes[0],
        levels=found.levels,
        of_factors=found.of_factors,
        solved=free.solved,
        balance=free.balance,
        films=len(free.solved),
        exact=EXACT if free.balance is None else (),
        apart=free.apart,
    )


def _films(scene: Bearing, cells: int, *, among: Searched, ruptures: bool, tolerance: float) -> ModelFilms:
    return ModelFilms(
        scene=scene,
        film=among.film,
        ruptures=ruptures,
        cells=cells,
        closest=among.closest,
        touching=among.first,
        residual=min(tolerance, FILM_RESIDUAL),
    )


def _under_load(
    scene: Bearing,
    cells: int,
    among: Searched,
    films: FilmsOnGrid,
    outputs: Outputs,
    heat: Heat | None,
    progress: Progress,
) -> _Found:
    """The film that carries the load of the scene."""
    assert scene.load_pressure is not None
    found = under_load(
        partial(films, scene),
        scene.load_pressure,
        cells,
        speed=scene.motion.speed,
        guess=among.first,
        sensitive=scene.roughness is not None and among.averaged,
        heated=None if heat is None else heat.loaded(),
        progress=progress,
    )
    levels = tuple((state.solution, _loaded(state.scene, state.solution, outputs)) for state in found.states)
    of_factors: Mapping[str, float] = {}
    if found.thicker is not None:
        state, thicker = found.states[found.compared], found.thicker
        solution, quantities = levels[found.compared]
        known = state.scene if among.known_from is None else state.scene.at_film(among.known_from)
        others = _loaded(thicker.scene, thicker.solution, outputs)
        of_factors = converted(
            outputs.factor_uncertainties(known, solution, quantities),
            {name: one.value for name, one in quantities.items()},
            {name: one.value for name, one in others.items()},
            FILM_STEP * state.scene.geometry.thinnest,
        )
    return _Found(
        scene=found.states[0].scene,
        levels=levels,
        of_factors=of_factors,
        solved=found.solved,
        balance=found.balance,
        films=sum(found.films),
    )


def _loaded(scene: Bearing, solution: Solution, outputs: Outputs) -> dict[str, Quantity]:
    """The quantities of a film whose thickness was sought, with the eccentricity of a journal bearing."""
    quantities = outputs.quantities(scene, solution)
    geometry = scene.geometry
    if not isinstance(geometry, Journal):
        return quantities
    return quantities | {"eccentricity": Quantity(value=1 - geometry.thinnest / geometry.clearance, unit="1")}


def origin_of(roughness: FactorsOverGap | None) -> dict[str, Any]:
    """The entry "table" of provenance for flow factors of a table that was made for the result or kept from others."""
    origin = getattr(roughness, "origin", None)
    return {"table": dict(origin)} if origin else {}


def _fields(scene: Bearing, solution: Solution, more: Fields) -> dict[str, Field]:
    """The fields over the grid, shape (nx, ny), with x in the coordinates of the scene for either sliding direction."""
    shape = solution.problem.shape
    x, y = np.meshgrid(solution.grid.x, solution.grid.y, indexing="ij")
    values: Fields = {
        "x": (x, "rad" if shape.polar else "m"),
        "y": (y, "m"),
        "film_thickness": (solution.faces.thickness, "m"),
        "pressure": (solution.state.pressure + scene.lubricant.cavitation_pressure, "Pa"),
        "density_ratio": (density_ratio(solution), "1"),
        **more,
    }
    if solution.turned:
        values = {name: (field[::-1], unit) for name, (field, unit) in values.items()}
        mirrored, unit = values["x"]
        values["x"] = (shape.breaks[0] + shape.breaks[-1] - mirrored, unit)
    return {name: Field(values=np.ascontiguousarray(field), unit=unit) for name, (field, unit) in values.items()}
