"""A film over a cell in plan that ruptures at the cavitation pressure, at ambient mean pressure over its edges."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.evaluation.filling import density_ratio
from roughfilm.rom.cavitation.evaluation.friction import wall_stress
from roughfilm.rom.cavitation.evaluation.peak import peak_pressure
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Progress, Solution, solve
from roughfilm.rom.ladder.result import Field
from roughfilm.rom.pocket.cavitating.cavities import cavity_quantities
from roughfilm.rom.pocket.plan.quantities import OnSlidingWall, plan_fields, plan_quantities
from roughfilm.rom.pocket.scene import Pocket

LEVEL_TOLERANCE = 1e-6
"""Error of the mean pressure over the edges, over the largest above cavitation pressure, at which it is met."""

MAX_FILMS = 30
"""Largest number of films that are solved on one grid for the mean pressure over the edges."""

EQUAL_PRESSURE = 1e-6
"""Difference of two pressures over the range of the pressure below which they are equal."""

FIRST_COARSENING = 4
"""Cells along a side over those of the grid on which the pressure of the anchor is first sought."""


def cell_problem(scene: Pocket, anchor: tuple[float, float, float] | None) -> Problem:
    """The film over a cell that is periodic in both directions; ``anchor`` is that of :class:`Ends`.

    Without an anchor the ends x = ±length/2 are full of liquid at ambient pressure.
    """
    plan, ambient = scene.plan(), -scene.cavitation_pressure
    half, side = plan.length / 2, plan.breadth / 2
    shape = Shape(
        thickness=plan.thickness,
        breaks=(-half, *_inside(plan.breaks_x, half), half),
        across=(-side, side),
        steps_across=_inside(plan.breaks_y, side),
        wide=False,
        joined=(anchor is not None, True),
        finest=(scene.geometry.narrowest, scene.geometry.narrowest),
    )
    ends = Ends(inlet=ambient, outlet=ambient) if anchor is None else Ends(anchor=anchor)
    return Problem(shape=shape, ends=ends, speed=scene.speed, viscosity=scene.lubricant.viscosity)


def _inside(breaks: tuple[float, ...], half: float) -> tuple[float, ...]:
    """The breaks that are farther than round-off from both ends."""
    return tuple(place for place in breaks if abs(place) < half * (1 - 1e-9))


def edge_mean(solution: Solution) -> float:
    """The length-weighted mean over the edges of the pressure above cavitation pressure, Pa."""
    across = solution.grid.volume_y
    return float(solution.state.pressure[0] @ across / across.sum())


def cell_film(
    scene: Pocket, cells: tuple[int, int], *, tolerance: float, progress: Progress = lambda _fraction, _words: None
) -> Solution:
    """The film whose mean pressure over the edges x = ±length/2 is ambient.

    The flows of a periodic film determine its pressure up to a constant, or up to its content of liquid where it
    ruptures. The pressure of one full node on the edges, the anchor, stands for it. The mean over the edges grows with
    that pressure, which the secant method finds on a coarse grid and then on the given one. The anchor is where a whole
    film has its greatest pressure on the edges, and moves there if another place on them is the last to rupture.

    Raises
    ------
    ConvergenceError
        If a film does not converge, or no pressure of the anchor gives the mean.
    """
    ambient = -scene.cavitation_pressure
    if ambient == 0:
        return solve(cell_problem(scene, None), cells, tolerance=tolerance, progress=progress)
    edge = -scene.plan().length / 2
    coarse = (max(cells[0] // FIRST_COARSENING, min(cells[0], 8)), max(cells[1] // FIRST_COARSENING, min(cells[1], 8)))
    whole = solve(cell_problem(scene, (edge, 0.0, ambient)), coarse, tolerance=tolerance, ruptures=False)
    place, level = _greatest(whole), ambient

    def film(size: tuple[int, int], given: float, before: Solution | None) -> Solution:
        problem, start = cell_problem(scene, (edge, place, given)), None if before is None else before.state
        found = solve(problem, size, tolerance=tolerance, start=start, progress=progress)
        if before is None:
            return found
        return replace(found, levels=(*before.levels, *found.levels), coarser=found.coarser or before.coarser)

    for _ in range(MAX_FILMS):
        level, found = _at_mean(partial(film, coarse), level, ambient)
        if level > 0:
            break
        place, level = _greatest(found), ambient
    return _at_mean(partial(film, cells), level, ambient)[1]


def _greatest(solution: Solution) -> float:
    """The position on the edges where the pressure is greatest, m; of equal ones the nearest to the middle."""
    pressure, places = solution.state.pressure, solution.grid.y
    equal = np.flatnonzero(pressure[0] >= pressure[0].max() - EQUAL_PRESSURE * np.ptp(pressure))
    return float(places[equal[np.abs(places[equal]).argmin()]])


def _at_mean(
    film: Callable[[float, Solution | None], Solution], level: float, ambient: float
) -> tuple[float, Solution]:
    """The pressure of the anchor at which the mean over the edges is ambient, both above cavitation pressure, Pa.

    The pressure is 0 if the mean is above ambient at any, with the film at that pressure. It is sought by the secant
    method between pressures at which the mean is known to be too low and too high, the first step with the slope 1 of a
    whole film.

    Parameters
    ----------
    film : film(pressure, before), the film at a pressure of the anchor, which may start from another film.
    level : pressure of the anchor at which the search begins, Pa.
    ambient : ambient pressure above cavitation pressure, Pa.
    """
    found: Solution | None = None
    low, high, slope, excess = 0.0, float("inf"), 1.0, float("nan")
    before: tuple[float, float] | None = None
    for _ in range(MAX_FILMS):
        found = film(level, found)
        excess = edge_mean(found) - ambient
        if abs(excess) <= LEVEL_TOLERANCE * float(found.state.pressure.max()) or (level == 0 and excess > 0):
            return level, found
        low, high = (max(low, level), high) if excess < 0 else (low, min(high, level))
        if before is not None and level != before[0] and (excess - before[1]) / (level - before[0]) > 0:
            slope = (excess - before[1]) / (level - before[0])
        before, step = (level, excess), level - excess / slope
        inside = low < step < high
        level = step if inside else (low + high) / 2 if low > 0 else max(min(step, high), 0.0)
    raise ConvergenceError(
        "cavitation: no film was found whose mean pressure over the edges of the cell is ambient; the last one differs "
        f"by {excess:.3g} Pa; take more cells",
        outcome=Outcome.UNFINISHED,
    )


def cell_quantities(scene: Pocket, solution: Solution) -> dict[str, Quantity]:
    """The quantities of a cell in plan and those of its cavities; pressures count from their mean over the edges."""
    state, pascal = solution.state, scene.pressure_unit
    return {
        **plan_quantities(
            scene,
            _on_sliding_wall(scene, solution),
            backflow=_backflow(scene, solution),
            pressure_range=(float(state.pressure.min()) / pascal, peak_pressure(solution) / pascal),
        ),
        **cavity_quantities(solution),
    }


def cell_fields(scene: Pocket, solution: Solution) -> dict[str, Field]:
    """The fields on the sliding wall, shape (nx, ny), with the density ratio θ of the film, which is 1 but in cavities.

    Each value is the mean over the four nodes around a column.
    """
    theta = _in_columns(solution, density_ratio(solution))
    return {**plan_fields(scene, _on_sliding_wall(scene, solution)), "density_ratio": Field(values=theta, unit="1")}


def _on_sliding_wall(scene: Pocket, solution: Solution) -> OnSlidingWall:
    """Pressure and shear stress in the columns between the nodes; the nodes x = -length/2 lie on the edge."""
    grid, film, pascal = solution.grid, scene.geometry.film, scene.pressure_unit
    x, y = _with_end(grid.x, grid.spacing_x) / film, _with_end(grid.y, grid.spacing_y) / film
    pressure, stress = solution.state.pressure / pascal, wall_stress(solution) / pascal
    middle_x, middle_y = (x[1:, None] + x[:-1, None]) / 2, (y[1:] + y[:-1]) / 2
    edge = pressure[0]
    return OnSlidingWall(
        x=x,
        y=y,
        thickness=scene.plan().thickness(middle_x * film, middle_y * film) / film,
        pressure=_in_columns(solution, pressure),
        shear_stress=(stress + np.roll(stress, -1, axis=1))[: x.size - 1] / 2,
        on_edge=(edge + np.roll(edge, -1)) / 2,
    )


def _with_end(places: Array, spacing: Array) -> Array:
    """The positions of the nodes with that at the end of the period, which a periodic direction omits."""
    return np.append(places, places[-1] + spacing[-1]) if spacing[-1] else places


def _in_columns(solution: Solution, values: Array) -> Array:
    """The means over the four nodes around each column of values at the nodes."""
    along = (values + np.roll(values, -1, axis=0)) / 2
    along = along if solution.network.periodic[0] else along[:-1]
    return np.asarray((along + np.roll(along, -1, axis=1)) / 2)


def _backflow(scene: Pocket, solution: Solution) -> float:
    """The greatest speed of reverse flow over the sliding speed, from the pressure gradients between nodes of films."""
    last = None if solution.network.periodic[0] else -1
    pressure, cavity = solution.state.pressure / scene.pressure_unit, solution.kind == CAVITY
    film = ~(cavity | np.roll(cavity, -1, axis=0))[:last]
    h = solution.faces.mean[:last] / scene.geometry.film
    rise = (np.roll(pressure, -1, axis=0) - pressure)[:last]
    slope = rise / solution.grid.spacing_x[:last, None] * scene.geometry.film
    steepness = np.where(film, np.minimum(1 - h**2 / 2 * slope, 0.0), 0.0)  # of the velocity at the fixed wall, times h
    return float((steepness**2 / (4 * (1 - steepness))).max())
