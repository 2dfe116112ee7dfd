"""The generalised minimal residual method for linear systems that are given as functions."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.film import kernels

RESTART = 90
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
        triangle, projections, number = np.zeros((RESTART, RESTART)), np.zeros(RESTART + 1), 0
        rotations, target = np.zeros((RESTART, 2)), np.zeros(RESTART + 1)
        target[0] = begin
        while number < RESTART and products < most and abs(target[number]) > tolerance * size:
            product = matrix(preconditioner(directions[number]))
            kernels.orthogonalise(directions, product, projections, number + 1)
            kernels.rotate(projections, rotations, target, number)
            triangle[:, number] = projections[:RESTART]
            triangle[number + 1 :, number] = 0.0
            products, number = products + 1, number + 1
        weights = scipy.linalg.solve_triangular(triangle[:number, :number], target[:number], check_finite=False)
        combined = np.empty_like(right)
        kernels.combine(directions, np.asarray(weights), combined)
        x = x + preconditioner(combined)
        rest = right - matrix(x)
        products += 1


def norm(vector: Array) -> float:
    """The Euclidean norm."""
    return float(np.sqrt(kernels.dot(vector, vector)))
