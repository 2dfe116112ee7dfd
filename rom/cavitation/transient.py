"""Films that change with time: squeezed, started, or passing by."""

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.cavitation.discretise import faces
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import TOLERANCE, WARM, Solution, on_grid, solve


def march(
    film: Callable[[float], Problem],
    cells: tuple[int, int],
    times: Sequence[float],
    *,
    start: State | None = None,
    tolerance: float = TOLERANCE,
) -> Iterator[tuple[float, Solution]]:
    """Solve ∂(θh)/∂t + (u/2) ∂(θh)/∂x - ∇·(θh³/12η ∇p) = 0 from time to time, by backward Euler steps.

    Of first order in the steps, of second in the cells where the film is whole; mass is kept to the tolerance, and no
    step is too long for stability.

    Parameters
    ----------
    film : film(t): the film at a time; its breaks, ends in space and sign of speed do not change.
    cells : in x and in y.
    times : increasing, s; the first is that of ``start``, and nothing is solved there.
    start : what the film holds at first; by default it is full, at the pressure of cavitation.

    Yields
    ------
    Each later time with the film then.

    Raises
    ------
    InputError
        If the times do not increase, or the wall slides towards falling x (turn the film round).
    ConvergenceError
        If a step does not come into balance.

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
            found = on_grid(problem, nodes, start=state, sweeps=WARM, tolerance=tolerance, storage=storage)
        except ConvergenceError:  # a film that tears all at once
            found = solve(problem, cells, tolerance=tolerance, storage=storage)
        state, held = found.state, _held(found.problem, found.state, found.faces.thickness)
        yield now, found


def _ahead(problem: Problem) -> Problem:
    if problem.speed < 0:
        raise InputError(f"speed: got {problem.speed!r}; turn the film round, so that it slides towards growing x")
    return problem


def _held(problem: Problem, state: State, thickness: Array) -> Array:
    """θh of the nodes, m, of the film at that time."""
    return np.asarray((state.fill + problem.compression(state.pressure)[0]) * thickness)
