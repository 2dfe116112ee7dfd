"""The generalised minimal residual method for linear systems that are given as functions."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.film import kernels

RESTART = 60
"""Number of directions after which the method starts again from the solution so far."""


@dataclass(frozen=True, kw_only=True)
class Minimised:
    """A solution with its residual over the right-hand side, and the number of products with the matrix."""

    solution: Array
    residual: float
    products: int


def minimal_residual(
    matrix: Callable[[Array], Array],
    right: Array,
    *,
    preconditioner: Callable[[Array], Array],
    tolerance: float,
    most: int,
) -> Minimised:
    """Solve a linear system so that |right - A x| <= tolerance |right|, or stop after ``most`` products.

    The preconditioner M ≈ A⁻¹ acts from the right, so that the residual is that of the system itself. The residual that
    is returned is computed from the solution.

    Y. Saad and M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869, doi:10.1137/0907058.
    """
    x, rest, products = np.zeros_like(right), right, 0
    size = norm(right)
    if size == 0:
        return Minimised(solution=x, residual=0.0, products=0)
    directions = np.empty((RESTART + 1, right.size))
    while True:
        begin = norm(rest)
        if not begin > tolerance * size or products >= most:
            return Minimised(solution=x, residual=begin / size, products=products)
        np.multiply(rest, 1 / begin, out=directions[0])
        hessenberg, number = np.zeros((RESTART + 1, RESTART)), 0
        target = np.zeros(RESTART + 1)
        target[0] = begin
        weights: Array = np.zeros(0)
        while number < RESTART and products < most:
            product = matrix(preconditioner(directions[number]))
            products, number = products + 1, number + 1
            kernels.orthogonalise(directions, product, hessenberg[:, number - 1], number)
            part, wanted = hessenberg[: number + 1, :number], target[: number + 1]
            weights = np.asarray(np.linalg.lstsq(part, wanted)[0])
            reached = float(np.linalg.norm(part @ weights - wanted))
            if not reached > tolerance * size or hessenberg[number, number - 1] == 0:
                break
        combined = np.empty_like(right)
        kernels.combine(directions, weights, combined)
        x = x + preconditioner(combined)
        rest = right - matrix(x)
        products += 1


def norm(vector: Array) -> float:
    """The Euclidean norm."""
    return float(np.sqrt(kernels.dot(vector, vector)))
