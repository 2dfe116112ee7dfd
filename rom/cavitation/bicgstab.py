"""Stabilised bi-conjugate gradients for unsymmetric systems with a good preconditioner.

The loops are compiled here because the scalar products of NumPy start threads, which cost more than they save.
"""

import math
from collections.abc import Callable

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import compiled
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.multigrid.gradients import dot

Operator = Callable[[Array], Array]


def bicgstab(product: Operator, inverse: Operator, right_hand_side: Array, *, tolerance: float, limit: int) -> Array:
    """Solve A x = b from zero, until |b - A x| <= ``tolerance``, absolute, in the Euclidean norm.

    Parameters
    ----------
    product, inverse : x ↦ A x, and an approximation of x ↦ A⁻¹ x, of the shape of b, (nx, ny); ``product`` returns a
        new array, and ``inverse`` may overwrite the one that it returned before.

    Raises
    ------
    ConvergenceError
        If ``limit`` iterations do not reach the tolerance, or the method breaks down.

    Source: van der Vorst 1992, doi:10.1137/0913035.
    """
    solution, residual = np.zeros_like(right_hand_side), right_hand_side.copy()
    start = size = math.sqrt(dot(residual, residual))
    if start <= tolerance:
        return solution
    shadow, direction, image = residual.copy(), np.zeros_like(residual), np.zeros_like(residual)
    before = length = part = 1.0
    for _ in range(limit):
        along = dot(shadow, residual)
        if not before * part or not math.isfinite(along):
            break
        turn(residual.ravel(), direction.ravel(), image.ravel(), along / before * length / part, part)
        step = inverse(direction)
        image = product(step)
        length = along / (dot(shadow, image) or math.inf)
        size = math.sqrt(follow(residual.ravel(), image.ravel(), length))
        follow(solution.ravel(), step.ravel(), -length)
        before = along
        if size <= tolerance:
            return solution
        step = inverse(residual)
        second = product(step)
        part = dot(second, residual) / (dot(second, second) or math.inf)
        size = math.sqrt(follow(residual.ravel(), second.ravel(), part))
        follow(solution.ravel(), step.ravel(), -part)
        if size <= tolerance:
            return solution
    raise ConvergenceError(
        f"linear solver: its residual went from {start:.1e} to {size:.1e} instead of {tolerance:.1e} in {limit} "
        "iterations; take other cells",
        outcome=Outcome.STALLED if math.isfinite(size) else Outcome.DIVERGED,
        iterations=limit,
    )


@compiled
def turn(residual, direction, image, length, part):  # type: ignore[no-untyped-def]
    """Compute d = r + length (d - part A d) in place."""
    for place in range(residual.size):
        direction[place] = residual[place] + length * (direction[place] - part * image[place])


@compiled
def follow(values, step, length):  # type: ignore[no-untyped-def]
    """Compute values -= length · step in place; return the squared norm of the values."""
    total = 0.0
    for place in range(values.size):
        value = values[place] - length * step[place]
        values[place] = value
        total += value * value
    return total
