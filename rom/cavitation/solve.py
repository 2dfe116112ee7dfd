"""Steady films: solved on grid after finer grid, each the start of the next."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.discretise import Faces, faces, network
from roughfilm.rom.cavitation.grid import Grid, grid
from roughfilm.rom.cavitation.interpolation import carried, interpolated
from roughfilm.rom.cavitation.line import line_step
from roughfilm.rom.cavitation.network import Network, State
from roughfilm.rom.cavitation.newton import UnsettledError, settle
from roughfilm.rom.cavitation.plane import plane_step
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.homogenization.gap_factors import mirrored_factors

COARSEST = 16
"""Cells along each side where it begins, from a film everywhere at the pressure of cavitation."""

COLD, WARM = 400, 6
"""Sweeps of relaxation before Newton's method, on the coarsest grid and on all others."""

TOLERANCE = 1e-9
"""Of the residual, by default."""

EMPTY = 1e-6
"""A part by which a gap may be emptier than empty, by rounding."""

Progress = Callable[[float, str], None]


@dataclass(frozen=True, kw_only=True)
class Level:
    """What one grid gave: nodes, steps of Newton's method, and the integral of p over the film, N (N/m if wide)."""

    shape: tuple[int, int]
    iterations: int
    load: float


@dataclass(frozen=True, kw_only=True)
class Solution:
    """A film in balance, on its grid; pressures are above that of cavitation, x grows with sliding.

    ``turned`` says that the wall slid towards falling x: ``problem`` is then the mirrored one.
    ``residual`` is the largest net flow into a node over the largest through a face, recomputed at the end.
    ``coarser`` is the solution on the grid before, which has one of its own, and no more.
    """

    problem: Problem
    turned: bool
    grid: Grid
    faces: Faces
    network: Network
    state: State
    kind: NDArray[np.int8]
    residual: float
    levels: tuple[Level, ...]
    coarser: "Solution | None"


def solve(
    problem: Problem,
    cells: tuple[int, int],
    *,
    tolerance: float = TOLERANCE,
    start: State | None = None,
    ruptures: bool = True,
    storage: tuple[float, Array] | None = None,
    progress: Progress = lambda _fraction, _words: None,
) -> Solution:
    """Solve (u/2) ∂(θh)/∂x - ∇·(θh³/12η ∇p) = 0 where p > 0, and its first part alone with p = 0 where θ < 1.

    Load and pressure are of second order in the cells. Sliding towards falling x is solved mirrored.

    Parameters
    ----------
    cells : in x and in y; the latter do not count where the film is infinitely wide.
    start : of another solution, to begin from on the grid asked for; without one, or if it leads nowhere, coarser grids
        give it.
    ruptures : whether the film ruptures; without, it bears any tension, and the inlet is full.
    storage : of a step in time: its length, s, and θh before it at the nodes of the finest grid, m.

    Raises
    ------
    ConvergenceError
        If the residual does not meet the tolerance: no result leaves that does not balance. Or if it does, but with a
        part of the gap filled less than not at all.

    Sources: Jakobsson and Floberg 1957; Elrod 1981, doi:10.1115/1.3251669; Sahlin et al. 2007,
    doi:10.1016/j.triboint.2007.02.021.
    """
    turned = problem.speed < 0
    if turned:
        problem = mirrored(problem)
    if problem.speed == 0 and storage is None:
        ruptures = False  # no film widens, and pressure lies between those of the ends
    if not ruptures:
        problem = replace(problem, ends=replace(problem.ends, inlet=problem.ends.inlet or 0.0))
    wide = problem.shape.wide
    given = start is not None
    sizes = [cells] if given else _coarsening(cells, wide=wide)
    work = [float(nx * (1 if wide else ny)) for nx, ny in sizes]
    finest = grid(problem.shape, cells)
    found: Solution | None = None
    for number, size in enumerate(sizes):
        progress(sum(work[:number]) / sum(work), " × ".join(map(str, size[:1] if wide else size)) + " cells")
        nodes = finest if size == cells else grid(problem.shape, size)
        before, cold = found, start is None
        try:
            found = on_grid(
                problem,
                nodes,
                start=start,
                sweeps=COLD if cold else WARM,
                tolerance=tolerance,
                ruptures=ruptures,
                storage=storage and (storage[0], interpolated(storage[1], finest, nodes, problem.shape.joined)),
            )
        except UnsettledError as error:
            if given:
                again = solve(
                    problem, cells, tolerance=tolerance, ruptures=ruptures, storage=storage, progress=progress
                )
                return replace(again, turned=turned)
            if nodes is finest:
                raise
            next_one, near = grid(problem.shape, sizes[number + 1]), error.state
            sound = bool(np.isfinite(near.pressure).all())
            start = carried(near, nodes, next_one, problem.shape.joined) if sound else None
            continue
        found = replace(
            found,
            turned=turned,
            levels=(*(before.levels if before else ()), *found.levels),
            coarser=before and replace(before, coarser=before.coarser and replace(before.coarser, coarser=None)),
        )
        if nodes is not finest:
            start = carried(found.state, nodes, grid(problem.shape, sizes[number + 1]), problem.shape.joined)
    assert found is not None
    _not_emptier_than_empty(found)
    return found


def _not_emptier_than_empty(found: Solution) -> None:
    """ConvergenceError where a slanting lay takes more out of a node that is not full than there is in it."""
    least = float(found.state.fill.min())
    if least < -EMPTY:
        raise ConvergenceError(
            f"cavitation: the balance wants a node filled to {least:.3g}, as pressures beside it drive more along the "
            "lay than flows in; take more cells, or direct, which follows every wave",
            outcome=Outcome.STALLED,
            iterations=sum(level.iterations for level in found.levels),
        )


def on_grid(
    problem: Problem,
    nodes: Grid,
    *,
    start: State | None,
    sweeps: int,
    tolerance: float,
    ruptures: bool = True,
    storage: tuple[float, Array] | None = None,
) -> Solution:
    """Solve on one grid, after some sweeps of relaxation from ``start``, or from a film at the pressure of cavitation.

    ``storage``: of transient flow, as :func:`roughfilm.rom.cavitation.discretise.network` takes it.
    """
    sampled = faces(problem.shape, nodes)
    net = network(
        nodes,
        sampled,
        problem.ends,
        speed=problem.speed,
        viscosity=problem.viscosity,
        compressibility=problem.initial_compressibility,
        storage=storage,
        ruptures=ruptures,
    )
    state = start or State(pressure=np.zeros(net.shape), fill=np.ones(net.shape))
    step = line_step if problem.shape.wide else plane_step
    with np.errstate(over="ignore", invalid="ignore"):  # numbers that overflow are told as a residual that is none
        settled = settle(net, problem, state, step, sweeps=sweeps, tolerance=tolerance, ruptures=ruptures)
    load = float((nodes.areas * settled.state.pressure).sum())
    return Solution(
        problem=problem,
        turned=False,
        grid=nodes,
        faces=sampled,
        network=net,
        state=settled.state,
        kind=settled.kind,
        residual=settled.residual,
        levels=(Level(shape=nodes.shape, iterations=settled.iterations, load=load),),
        coarser=None,
    )


def _coarsening(cells: tuple[int, int], *, wide: bool) -> list[tuple[int, int]]:
    """From the coarsest grid to the one that is asked for, each side about doubled at a time."""
    sizes = [cells]
    while max(sizes[-1][:1] if wide else sizes[-1]) > COARSEST:
        nx, ny = sizes[-1]
        sizes.append((max(-(-nx // 2), min(nx, COARSEST)), max(-(-ny // 2), min(ny, COARSEST))))
    return sizes[::-1]


def mirrored(problem: Problem) -> Problem:
    """The same film with x turned round; it slides the other way."""
    shape = problem.shape
    low, high = shape.breaks[0], shape.breaks[-1]
    breaks = tuple(low + high - place for place in reversed(shape.breaks))
    turned = replace(
        shape,
        breaks=breaks,
        thickness=lambda x, y: shape.thickness(low + high - x, y),
        roughness=None if shape.roughness is None else mirrored_factors(shape.roughness),
    )
    return replace(problem, shape=turned, speed=-problem.speed)
