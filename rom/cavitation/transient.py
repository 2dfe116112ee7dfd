"""Transient films, for example squeezed or accelerated ones."""

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.cavitation.discretise import faces
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.cavitation.solve import WARM_SWEEPS, Solution, on_grid, solve


def march(
    film: Callable[[float], Problem],
    cells: tuple[int, int],
    times: Sequence[float],
    *,
    start: State | None = None,
    tolerance: float = RESIDUAL_TOLERANCE,
) -> Iterator[tuple[float, Solution]]:
    """Solve ∂(θh)/∂t + (u/2) ∂(θh)/∂x - ∇·(θh³/12η ∇p) = 0 at successive times by backward Euler steps.

    The method is first-order accurate in time and second-order in space where the film is full; mass is conserved to
    the tolerance, and steps of any length are stable.

    Parameters
    ----------
    film : film(t), the film at a time; its breaks, ends and sign of speed are constant.
    cells : number of cells in x and in y.
    times : increasing times, s; the first is that of ``start``, at which nothing is solved.
    start : initial state; by default a full film at the cavitation pressure.

    Yields
    ------
    Each later time and the film at it.

    Raises
    ------
    InputError
        If the times do not increase, or the wall slides towards decreasing x (mirror the film).
    ConvergenceError
        If a step does not converge.

    Source: Elrod 1981, doi:10.1115/1.3251669.
    """
    if len(times) < 2 or not np.isfinite(times).all() or min(np.diff(times)) <= 0:
        raise InputError(f"times: got {[*times][:4]!r:.80}; give two or more, finite and increasing")
    problem = _ahead(film(times[0]))
    nodes = grid(problem.shape, cells)
    state = start or State(pressure=np.zeros(nodes.shape), fill=np.ones(nodes.shape))
    held = _held(problem, state, faces(problem.shape, nodes).thickness)

    for before, now in pairwise(times):
        problem, storage = _ahead(film(now)), (now - before, held)
        try:
            solution = on_grid(problem, nodes, start=state, sweeps=WARM_SWEEPS, tolerance=tolerance, storage=storage)
        except ConvergenceError:  # the film ruptures everywhere in one step
            solution = solve(problem, cells, tolerance=tolerance, storage=storage)
        state = solution.state
        held = _held(solution.problem, state, solution.faces.thickness)
        yield now, solution


def _ahead(problem: Problem) -> Problem:
    if problem.speed < 0:
        raise InputError(f"speed: got {problem.speed!r}; mirror the film, so that it slides towards increasing x")
    return problem


def _held(problem: Problem, state: State, thickness: Array) -> Array:
    """θh at the nodes, m."""
    return np.asarray((state.fill + problem.compression(state.pressure)[0]) * thickness)
