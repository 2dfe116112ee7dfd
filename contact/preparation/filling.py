"""Step 5 of the preparation: fill invalid points with a harmonic function of the valid ones."""

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.surfaces.surface import Surface

RESIDUAL_TOLERANCE = 1e-9
"""Tolerance of the true residual, relative to the right-hand side."""

MAX_ITERATIONS = 500
"""Largest number of iterations of the conjugate gradients."""

BLOCK = 3
"""Side of the blocks of points that are one unknown of the next coarser level."""

COARSEST = 500
"""Number of unknowns up to which a level is solved directly."""

DAMPING = 2 / 3
"""Factor of the damped Jacobi steps that smooth errors, and the columns of the prolongation."""

if TYPE_CHECKING:
    Matrix: TypeAlias = scipy.sparse.csr_array
    Level: TypeAlias = tuple[Matrix, Array, Matrix]
    """Matrix of a level, damped inverse of its diagonal, and prolongation from the next coarser level."""


def fill_invalid(surface: Surface) -> tuple[Surface, float]:
    """Fill invalid points with heights that satisfy ∂²h/∂x² + ∂²h/∂y² = 0; valid points stay fixed.

    The equation is discretised by five-point differences, with no flux through the sides of the surface, so that filled
    heights stay within the range of the valid heights around them. Conjugate gradients with a cycle of algebraic
    multigrid as preconditioner (smoothed aggregation over blocks of 3 x 3 points) solve it, starting from the nearest
    valid heights: 10 to 40 iterations whatever the width of the holes, at a cost in proportion to the invalid points.

    Returns
    -------
    surface : without invalid points.
    residual : ‖b − A h‖ / ‖b‖, recomputed from the filled heights, with b from the valid neighbours; 0 if no point is
        invalid.

    Raises
    ------
    ConvergenceError
        If the residual stays above 1e-9.

    References
    ----------
    P. Vanek, J. Mandel, M. Brezina, Computing 56 (1996) 179 (smoothed aggregation).
    """
    if not surface.invalid.any():
        return surface, 0.0
    _, nearest = scipy.ndimage.distance_transform_edt(surface.invalid, sampling=surface.spacing, return_indices=True)
    start = surface.heights[tuple(nearest)]
    level = float(surface.heights[surface.valid].mean())
    matrix, right = _laplace(surface.heights - level, surface.invalid, surface.spacing)
    scale = float(np.linalg.norm(right)) or 1.0
    levels, coarsest = _levels(matrix, np.argwhere(surface.invalid))
    filled, _ = scipy.sparse.linalg.cg(
        matrix,
        right,
        x0=start[surface.invalid] - level,
        rtol=0.5 * RESIDUAL_TOLERANCE,
        maxiter=MAX_ITERATIONS,
        M=scipy.sparse.linalg.LinearOperator(matrix.shape, matvec=lambda residual: _cycle(levels, coarsest, residual)),
    )
    residual = float(np.linalg.norm(right - matrix @ filled)) / scale
    if not residual <= RESIDUAL_TOLERANCE:
        raise ConvergenceError(
            f"invalid points: their fill has a residual of {residual:.1e}, above {RESIDUAL_TOLERANCE:.0e}; "
            "choose a window with smaller holes",
            outcome=Outcome.STALLED,
            iterations=MAX_ITERATIONS,
        )
    heights = surface.heights.copy()
    heights[surface.invalid] = filled + level
    return surface.with_heights(heights, invalid=np.zeros(surface.shape, dtype=bool)), residual


def _levels(matrix: "Matrix", places: NDArray[np.intp]) -> "tuple[list[Level], Callable[[Array], Array]]":
    """The levels of the multigrid from the finest, and the solver of the coarsest one; places have shape (n, 2)."""
    levels: list[Level] = []
    while matrix.shape[0] > COARSEST:
        places = places // BLOCK
        blocks, block = np.unique(places, axis=0, return_inverse=True)
        damped = DAMPING / matrix.diagonal()
        members = scipy.sparse.csr_array(
            (np.ones(block.size), block.ravel(), np.arange(block.size + 1)), shape=(block.size, len(blocks))
        )
        prolongation = (members - scipy.sparse.diags_array(damped) @ (matrix @ members)).tocsr()
        levels.append((matrix, damped, prolongation))
        matrix, places = (prolongation.T @ matrix @ prolongation).tocsr(), blocks
    return levels, scipy.sparse.linalg.factorized(matrix.tocsc())


def _cycle(levels: "list[Level]", coarsest: Callable[[Array], Array], right: Array) -> Array:
    """An approximate solution by one symmetric cycle: a damped Jacobi step before and after the coarser levels."""
    if not levels:
        return coarsest(right)
    matrix, damped, prolongation = levels[0]
    found = damped * right
    found += prolongation @ _cycle(levels[1:], coarsest, prolongation.T @ (right - matrix @ found))
    return np.asarray(found + damped * (right - matrix @ found))


def _laplace(heights: Array, invalid: Mask, spacing: tuple[float, float]) -> "tuple[Matrix, Array]":
    """The matrix over the invalid points in row-major order, and the right-hand side from their valid neighbours."""
    number = np.full(invalid.shape, -1)
    count = int(invalid.sum())
    number[invalid] = np.arange(count)
    diagonal, right = np.zeros(count), np.zeros(count)
    rows, columns, values = [], [], []
    shortest = min(spacing)
    for axis, length in enumerate(spacing):
        weight = (shortest / length) ** 2
        for here, there in ((slice(1, None), slice(None, -1)), (slice(None, -1), slice(1, None))):
            mine = (here, slice(None)) if axis == 0 else (slice(None), here)
            other = (there, slice(None)) if axis == 0 else (slice(None), there)
            own, next_ = number[mine], number[other]
            np.add.at(diagonal, own[own >= 0], weight)
            coupled = (own >= 0) & (next_ >= 0)
            rows.append(own[coupled])
            columns.append(next_[coupled])
            values.append(np.full(rows[-1].size, -weight))
            held = (own >= 0) & (next_ < 0)
            np.add.at(right, own[held], weight * heights[other][held])
    entries = (np.concatenate([*values, diagonal]), (np.r_[*rows, :count], np.r_[*columns, :count]))
    return scipy.sparse.coo_array(entries, shape=(count, count)).tocsr(), right
