"""Continuation of a flow in the Reynolds number from creeping flow."""

from collections.abc import Callable
from typing import TypeVar

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.ladder.model import Progress

MAX_TOTAL_STEPS = 240
"""Number of Newton steps in all after which the continuation stops."""

MIN_CONTINUATION_STEP = 1e-3
"""Smallest continuation step over the Reynolds number of the scene."""

Flow = TypeVar("Flow")
Linear = TypeVar("Linear")


def continued(
    attempt: Callable[[float, Flow], tuple[Flow, Linear | None, int]],
    creeping: Flow,
    reynolds_number: float,
    progress: Progress,
    *,
    start: Flow | None = None,
    shallower: str = "a shallower groove",
) -> tuple[Flow, Linear, int]:
    """The flow at a Reynolds number, if necessary by continuation from creeping flow in steps of adapted size.

    Parameters
    ----------
    attempt : Newton's method at one Reynolds number from a flow: the flow, its linear equations (None without
        convergence), and the number of steps.
    creeping : a flow without inertia.
    reynolds_number : the Reynolds number that is requested.
    progress : called with the done fraction and a few words.
    start : a flow from which the first attempt starts; by default the creeping one.
    shallower : the remedy in words, beside a better model and a coarser resolution.

    Returns
    -------
    flow, linear, steps
        Those of the last attempt, and the number of steps in all.

    Raises
    ------
    ConvergenceError
        If the steps become too small or too many.
    """
    state, reached, stride, total = start or creeping, 0.0, 1.0, 0
    while True:
        target = min(reached + stride, 1.0)
        progress(reached, f"Re = {target * reynolds_number:.4g}")
        solution, linear, steps = attempt(target * reynolds_number, state)
        total += steps
        if linear is not None and target == 1.0:
            return solution, linear, total
        if linear is not None:
            state, reached, stride = solution, target, 2 * stride
        else:
            state, stride = state if reached else creeping, stride / 4
        if stride < MIN_CONTINUATION_STEP or total > MAX_TOTAL_STEPS:
            raise ConvergenceError(
                f"the film equations did not converge to a steady flow above Re = {reached * reynolds_number:.4g} "
                f"(requested: {reynolds_number:.4g}); take navier_stokes, a coarser resolution or {shallower}",
                outcome=Outcome.STALLED,
            )
