"""The friction of a film on its sliding wall."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.averaged import Averaged
from roughfilm.rom.cavitation.balance import CAVITY, FILM
from roughfilm.rom.cavitation.evaluation.filling import carried
from roughfilm.rom.cavitation.evaluation.flows import flow_along
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.oblique import wetness
from roughfilm.rom.cavitation.problem import Inflow
from roughfilm.rom.cavitation.solve import Solution

RECESS_FRICTION = 4.0
"""Friction of a closed recess over ηu/(h + d): a pressure gradient drives back what the sliding wall carries along."""


def friction(solution: Solution) -> float:
    """The force on the sliding wall against its motion, N (N/m if infinitely wide)."""
    drag = drag_of_rows(solution)
    return float(drag.rows.sum() + drag.between.sum())


@dataclass(frozen=True, kw_only=True)
class Drag:
    """The force of the liquid on the sliding wall against its motion, N (N/m if infinitely wide).

    Attributes
    ----------
    rows : the part of the shear and of the pressure gradient along the sliding, for each row of nodes, shape (ny,).
    between : that of the pressure gradient across the sliding, between neighbouring rows, shape (ny - 1,); only an
        averaged oblique lay has one.
    """

    rows: Array
    between: Array


def drag_of_rows(solution: Solution, *, halved: bool = False) -> Drag:
    """The friction of the liquid, row by row.

    Parameters
    ----------
    halved : whether the lowest row is the middle of a symmetric film, whose other half is not counted.
    """
    grid, rough = solution.grid, solution.faces.averaged
    along = (grid.volume_y * pull_along(solution, halved=halved)).sum(axis=0)
    if rough is None or grid.shape[1] == 1:
        return Drag(rows=along, between=np.zeros(grid.shape[1] - 1))
    return Drag(rows=along, between=pull_across(solution, rough).sum(axis=0))


def wall_stress(solution: Solution) -> Array:
    """The stress on the sliding wall against its motion at the faces towards i + 1, Pa; 0 behind the last node."""
    pull, lengths = pull_along(solution), solution.grid.spacing_x[:, None] * solution.grid.radius
    return np.divide(pull, lengths, out=np.zeros_like(pull), where=lengths > 0)


def pull_across(solution: Solution, rough: Averaged) -> Array:
    """The force on the sliding wall by the pressure gradient across the faces towards j + 1, N, shape (nx, ny - 1)."""
    grid, pressure = solution.grid, solution.state.pressure
    climb = pressure[:, 1:] - pressure[:, :-1]
    return np.asarray(grid.volume_x[:, None] * radius_between(grid) * rough.drag_across[:, :-1] / 2 * climb)


def pull_along(solution: Solution, *, halved: bool = False) -> Array:
    """The force per width on the sliding wall between the nodes of each face towards i + 1, N/m, shape (nx, ny)."""
    grid, mean, problem = solution.grid, solution.faces.mean, solution.problem
    fluidity, own = problem.fluidity(solution.state.pressure)[0], problem.at_nodes
    viscosity = problem.viscosity if own is None else _between(own.shear)
    carries = 1.0 if own is None else _between(own.carried)
    stretch = grid.spacing_x[:, None] * grid.radius
    speed = problem.speed * (grid.radius if problem.shape.polar else 1.0)
    fill = carried(solution)
    if problem.ends.sides is not None:  # the outermost lines belong to the bath
        inner = fill[:, :-1] if halved else fill[:, 1:-1]
        fill = np.pad(inner, ((0, 0), (0 if halved else 1, 1)), mode="edge")
    rough = solution.faces.averaged
    with np.errstate(divide="ignore", invalid="ignore"):
        gradient = fill / mean if rough is None else _shear_factor(solution, rough, fill)
        shear = np.where(mean > 0, viscosity * speed * gradient, 0.0)
    thicker = _between(1 / fluidity)
    rise = np.roll(solution.state.pressure, -1, axis=0) - solution.state.pressure
    pull = np.asarray(shear * thicker * stretch + carries * (mean / 2 * rise))
    for inflow in problem.inflows:
        share = _share_inside(solution, inflow)
        recess = RECESS_FRICTION * viscosity * speed * thicker / (solution.faces.thickness + inflow.depth)
        pull += share * (recess * stretch - pull)
    if problem.shape.idle:
        pull[problem.shape.is_idle(grid.x + grid.spacing_x / 2)] = 0.0
    return pull


def _between(values: Array) -> Array:
    """The mean of values at the nodes at the faces towards i + 1."""
    return np.asarray((values + np.roll(values, -1, axis=0)) / 2)


def _share_inside(solution: Solution, inflow: Inflow) -> Array:
    """The part of the width of each face towards i + 1 that lies in an inflow, shape (nx, ny)."""
    grid, net = solution.grid, solution.network
    covered = inflow.covers(*np.meshgrid(grid.x, grid.y, indexing="ij"))
    cells = covered & np.roll(covered, -1, axis=0)
    if not net.periodic[0]:
        cells[-1] = False
    if grid.shape[1] == 1:
        return cells.astype(float)
    cells = cells & np.roll(cells, -1, axis=1)
    if not net.periodic[1]:
        cells[:, -1] = False
    halves = cells * grid.spacing_y / 2
    return np.asarray((halves + np.roll(halves, 1, axis=1)) / grid.volume_y)


def _shear_factor(solution: Solution, rough: Averaged, fill: Array) -> Array:
    """Friction over ηu of averaged roughness, 1/m: d + 3e in a film, that of streamers where the tips are dry."""
    return np.asarray(fill * rough.streaming + _wetness(solution, rough, fill) * (rough.wet - rough.streaming))


def _wetness(solution: Solution, rough: Averaged, fill: Array) -> Array:
    """The wetness g of the tips at the faces towards i + 1, where a film begins the mean over cavity and film."""
    couette, kind = solution.network.couette, solution.kind
    inflow = np.roll(flow_along(solution), 1, axis=0)
    if solution.network.supplied.size:
        inflow[0] = solution.network.supplied
    empty = np.clip(np.divide(inflow, couette, out=np.zeros_like(couette), where=couette > 0), 0.0, fill)
    film = np.divide(fill - empty, 1 - empty, out=np.zeros_like(fill), where=empty < 1)
    begins = (kind == CAVITY) & (np.roll(kind, -1, axis=0) == FILM)
    of_cavity = wetness(np.where(begins, empty, fill), rough.threshold)
    return np.where(begins, film + (1 - film) * of_cavity, of_cavity)


def radius_between(grid: Grid) -> Array:
    """The radius at the faces towards j + 1, shape (ny - 1,)."""
    return (grid.radius[1:] + grid.radius[:-1]) / 2
