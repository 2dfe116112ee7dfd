"""Steady films, solved on successively finer grids, each of which starts the next."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.discretise import Faces, faces, network
from roughfilm.rom.cavitation.fluid import ViscosityField
from roughfilm.rom.cavitation.grid import Grid, grid
from roughfilm.rom.cavitation.interpolation import carried
from roughfilm.rom.cavitation.network import Network, State
from roughfilm.rom.cavitation.newton import Settled, UnsettledError, settle
from roughfilm.rom.cavitation.pressure_limit import at_constant_viscosity, pressure_limit, reduced_pressure
from roughfilm.rom.cavitation.problem import Inflow, Problem
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.cavitation.restricted import fed, first_pressures
from roughfilm.rom.homogenization.gap_factors import mirrored_factors
from roughfilm.rom.lubricants.compressibility import Incompressible

COARSEST_CELLS = 10
"""Largest number of cells along a side of the coarsest grid, which starts from a full film at cavitation pressure."""

LEAST_CELLS = 8
"""Number of cells along a side below which that side is not coarsened."""

FIRST_COARSENING = 0.62
"""Cells of the second finest grid over those of the finest; those of the grids below it are halved.

Halved cells keep their nodes: a front or a peak then lies at the same place between the same nodes, so that the
difference of the two grids does not show its error.
"""

COARSER_KEPT = 3
"""Number of coarser solutions that are kept."""

COLD_SWEEPS = 400
"""Relaxation sweeps before Newton's method without a start."""

WARM_SWEEPS = 6
"""Relaxation sweeps before Newton's method from the solution of a coarser grid in the plane."""

WARM_SWEEPS_OF_LINE = 1
"""The same for an infinitely wide film, whose Newton step costs no more than a sweep."""

NEAR_PRESSURE_LIMIT = 0.5
"""Reduced pressure on a grid over its limit above which the existence of a solution is checked for the finest grid."""

NEGATIVE_FILL_TOLERANCE = 1e-6
"""Tolerated negative filling fraction (round-off)."""

SUPPLIED_RESIDUAL = 1e-11
"""Largest residual at which a film with inflows is solved, whose flows are sums over many nodes."""

Progress = Callable[[float, str], None]


@dataclass(frozen=True, kw_only=True)
class Level:
    """One grid of a solution: nodes, Newton steps, and the integral of p, N (N/m if infinitely wide)."""

    shape: tuple[int, int]
    iterations: int
    load: float


@dataclass(frozen=True, kw_only=True)
class Solution:
    """A converged film on its grid; pressures are above cavitation pressure, x increases with sliding.

    ``turned`` is true if the wall slides towards decreasing x; ``problem`` is then the mirrored one.
    ``residual`` is the largest net flow into a node over the largest flow through a face, recomputed at the end, and
    ``imbalance`` the relative error of the flow along the film (:class:`roughfilm.rom.cavitation.newton.Settled`).
    ``coarser`` is the solution on the next coarser grid; at most ``COARSER_KEPT`` coarser solutions are kept.
    """

    problem: Problem
    turned: bool
    grid: Grid
    faces: Faces
    network: Network
    state: State
    kind: NDArray[np.int8]
    residual: float
    imbalance: float
    levels: tuple[Level, ...]
    coarser: "Solution | None"


def solve(
    problem: Problem,
    cells: tuple[int, int],
    *,
    tolerance: float = RESIDUAL_TOLERANCE,
    start: State | None = None,
    ruptures: bool = True,
    heated: Callable[[Solution], Solution] | None = None,
    progress: Progress = lambda _fraction, _words: None,
) -> Solution:
    """Solve θ ∂h/∂t + (u/2) ∂(θh)/∂x - ∇·(θh³/12η ∇p) = 0 with p > 0 in the film, and p = 0 with θ < 1 in cavities.

    Load and pressure are second-order accurate in the cell size. Sliding towards decreasing x is solved mirrored.

    Parameters
    ----------
    cells : number of cells in x and in y; the latter has no effect on an infinitely wide film.
    start : state on the finest grid from which to start; without one, or if it does not converge, coarser grids provide
        the start.
    ruptures : whether the film cavitates; without cavitation pressures may be negative, and the inlet is full.
    heated : heated(film), called on each grid: the film on that grid with other viscosities, from which the next grid
        starts; None where viscosities do not depend on the film.

    Raises
    ------
    ConvergenceError
        If the residual does not meet the tolerance, a filling fraction is negative, or the viscosity grows so much with
        pressure that there is no steady film.

    Sources: Jakobsson and Floberg 1957; Elrod 1981, doi:10.1115/1.3251669; Sahlin et al. 2007,
    doi:10.1016/j.triboint.2007.02.021.
    """
    turned = problem.speed < 0
    if turned:
        problem = mirrored(problem)
    if problem.speed == 0 and problem.opening is None:
        ruptures = False  # without motion the pressure lies between those of the ends
    if not ruptures or problem.speed == 0:  # without sliding nothing is carried in
        problem = replace(problem, ends=replace(problem.ends, inlet=problem.ends.inlet or 0.0))
    wide = problem.shape.wide
    given = start is not None
    sizes = [cells] if given else coarsening(cells, wide=wide)
    work = [float(nx * (1 if wide else ny)) for nx, ny in sizes]
    finest = grid(problem.shape, cells)
    found: Solution | None = None
    varies = problem.viscosities is not None or heated is not None
    limit = math.inf if varies else pressure_limit(problem)
    exact = isinstance(problem.compressibility, Incompressible)
    unchecked = math.isfinite(limit)
    for number, size in enumerate(sizes):
        if unchecked and exact and found is not None:
            highest = reduced_pressure(problem, float(found.state.pressure.max()))
            if highest > NEAR_PRESSURE_LIMIT * limit:
                unchecked = False
                _check_pressure_limit(problem, cells, limit, ruptures=ruptures)
        progress(sum(work[:number]) / sum(work), " × ".join(map(str, size[:1] if wide else size)) + " cells")
        nodes = finest if size == cells else grid(problem.shape, size)
        before, cold = found, start is None
        try:
            found = on_grid(
                problem,
                nodes,
                start=start,
                sweeps=COLD_SWEEPS if cold else WARM_SWEEPS_OF_LINE if wide else WARM_SWEEPS,
                tolerance=tolerance,
                ruptures=ruptures,
            )
            if heated is not None:
                found = heated(found)
                problem = replace(problem, viscosities=found.problem.viscosities)
        except UnsettledError as error:
            if unchecked:
                unchecked = False
                _check_pressure_limit(problem, cells, limit, ruptures=ruptures)
            if given:
                again = solve(problem, cells, tolerance=tolerance, ruptures=ruptures, heated=heated, progress=progress)
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
            coarser=_kept(before, COARSER_KEPT),
        )
        if nodes is not finest:
            start = carried(found.state, nodes, grid(problem.shape, sizes[number + 1]), problem.shape.joined)
    assert found is not None
    _check_fill(found)
    return found


def _check_pressure_limit(problem: Problem, cells: tuple[int, int], limit: float, *, ruptures: bool) -> None:
    """Raise ConvergenceError if the film at constant viscosity reaches the limit of the reduced pressure, Pa."""
    highest = float(solve(at_constant_viscosity(problem), cells, ruptures=ruptures).state.pressure.max())
    if highest >= limit:
        raise ConvergenceError(
            "lubricant.piezoviscosity: no steady film was found: at constant viscosity its pressure is "
            f"{highest:.4g} Pa, and by the law {problem.piezoviscosity.law} it must be below {limit:.4g} Pa, the "
            "integral of η0/η over pressure; lower the viscosity, its growth with pressure, the speed or the load, or "
            "take another law",
            outcome=Outcome.DIVERGED,
        )


def _kept(solution: Solution | None, count: int) -> Solution | None:
    """The solution with at most ``count`` - 1 coarser ones; None for none."""
    return replace(solution, coarser=_kept(solution.coarser, count - 1)) if solution and count else None


def _check_fill(solution: Solution) -> None:
    """Raise ConvergenceError for a cavity that cannot exist: with negative filling, or one that closes at rest.

    An oblique lay may drain more from a cavity node than flows in. A cavity node whose walls approach each other, and
    which displaces more than sliding carries on, would have to fill; the solver finds such nodes where a compressed
    liquid has no density that does not change in time.
    """
    net, least = solution.network, float(solution.state.fill.min())
    closing = (solution.kind == CAVITY) & (net.storage < 0) & (net.storage + net.couette <= 0)
    if closing.any():
        cause = (
            "no film was found that closes so fast: its liquid would be compressed faster than it flows out while its "
            "density does not change in time; lower motion.approach, or take the model reynolds_incompressible"
        )
    elif least < -NEGATIVE_FILL_TOLERANCE:
        cause = (
            f"a filling fraction is {least:.3g}, because the pressures beside a cavity drive more liquid along the lay "
            "than flows in; take more cells, or the model direct"
        )
    else:
        return
    raise ConvergenceError(
        f"cavitation: {cause}",
        outcome=Outcome.STALLED,
        iterations=sum(level.iterations for level in solution.levels),
    )


def on_grid(
    problem: Problem,
    nodes: Grid,
    *,
    start: State | None,
    sweeps: int,
    tolerance: float,
    ruptures: bool = True,
    sampled: Faces | None = None,
) -> Solution:
    """The solution on one grid, after relaxation sweeps from ``start`` or from a full film at cavitation pressure.

    ``sampled`` is the film thickness on the faces, if it is known.
    """
    problem, sampled = problem.on(nodes), faces(problem.shape, nodes) if sampled is None else sampled
    storage = None
    if problem.opening is not None:
        storage = problem.opening(*np.meshgrid(nodes.x, nodes.y, indexing="ij")) / sampled.thickness, 0.0
    net = network(
        nodes,
        sampled,
        problem.ends,
        speed=problem.speed,
        viscosity=problem.viscosity,
        compressibility=problem.initial_compressibility,
        storage=storage,
        ruptures=ruptures,
        viscosities=problem.at_nodes,
    )
    if problem.shape.wide:  # each step is slow to import
        from roughfilm.rom.cavitation.line import line_step as step
    else:
        from roughfilm.rom.cavitation.plane import plane_step as step
    first = start or State(pressure=np.zeros(net.shape), fill=np.ones(net.shape))

    def settled_from(near: State | None) -> Settled:
        count = sweeps if near is None else min(sweeps, WARM_SWEEPS_OF_LINE if problem.shape.wide else WARM_SWEEPS)
        return settle(net, problem, near or first, step, sweeps=count, tolerance=tolerance, ruptures=ruptures)

    x, y = np.meshgrid(nodes.x, nodes.y, indexing="ij")
    covered = tuple(inflow.covers(x, y) for inflow in problem.inflows)
    if covered:
        tolerance = min(tolerance, SUPPLIED_RESIDUAL)
    pressures = first_pressures(problem.inflows, covered, start)
    with np.errstate(over="ignore", invalid="ignore"):  # an overflow gives a residual that is not finite
        settled = fed(
            net,
            problem,
            problem.inflows,
            covered,
            settled_from,
            step,
            pressures,
            tolerance=tolerance,
            ruptures=ruptures,
        )
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
        imbalance=settled.imbalance,
        levels=(Level(shape=nodes.shape, iterations=settled.iterations, load=load),),
        coarser=None,
    )


def with_viscosities(solution: Solution, viscosities: ViscosityField, *, tolerance: float, ruptures: bool) -> Solution:
    """The film of a solution on its grid with other viscosities, from its state."""
    found = on_grid(
        replace(solution.problem, viscosities=viscosities),
        solution.grid,
        start=solution.state,
        sweeps=0,
        tolerance=tolerance,
        ruptures=ruptures,
        sampled=solution.faces,
    )
    (before,), (after,) = solution.levels[-1:], found.levels
    level = replace(after, iterations=before.iterations + after.iterations)
    return replace(found, turned=solution.turned, levels=(*solution.levels[:-1], level), coarser=solution.coarser)


def coarsening(cells: tuple[int, int], *, wide: bool) -> list[tuple[int, int]]:
    """Cells of the grids from the coarsest to the finest."""
    sizes, ratio = [cells], FIRST_COARSENING
    while max(sizes[-1][:1] if wide else sizes[-1]) > COARSEST_CELLS:
        nx, ny = (max(math.ceil(ratio * count), min(count, LEAST_CELLS)) for count in sizes[-1])
        sizes.append((nx, ny))
        ratio = 0.5
    return sizes[::-1]


def mirrored(problem: Problem) -> Problem:
    """The same film mirrored in x, with the opposite sliding direction."""
    shape = problem.shape
    low, high = shape.breaks[0], shape.breaks[-1]
    breaks = tuple(low + high - place for place in reversed(shape.breaks))
    turned = replace(
        shape,
        breaks=breaks,
        idle=tuple((low + high - end, low + high - begin) for begin, end in reversed(shape.idle)),
        thickness=lambda x, y: shape.thickness(low + high - x, y),
        roughness=None if shape.roughness is None else mirrored_factors(shape.roughness),
    )
    opening = problem.opening
    back = None if opening is None else lambda x, y: opening(low + high - x, y)
    varied = problem.viscosities
    viscosities = None if varied is None else lambda x, y: varied(low + high - x, y)
    inflows = tuple(mirrored_inflow(inflow, low + high) for inflow in problem.inflows)
    return replace(
        problem,
        shape=turned,
        speed=-problem.speed,
        opening=back,
        inflows=inflows,
        viscosities=viscosities,
        at_nodes=None,
    )


def mirrored_inflow(inflow: Inflow, ends: float) -> Inflow:
    """An inflow mirrored in x between two ends with the given sum of their positions, m."""
    return replace(inflow, covers=lambda x, y: inflow.covers(ends - x, y))
