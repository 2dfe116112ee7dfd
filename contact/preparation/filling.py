"""Step 5 of the preparation: fill invalid points with a harmonic function of the valid ones."""

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.surfaces.surface import Surface

RESIDUAL_TOLERANCE = 1e-9
"""Tolerance of the true residual, relative to the right-hand side."""

MAX_ITERATIONS = 20_000
"""Largest number of iterations of the conjugate gradients."""


def fill_invalid(surface: Surface) -> tuple[Surface, float]:
    """Fill invalid points with heights that satisfy ∂²h/∂x² + ∂²h/∂y² = 0; valid points stay fixed.

    The equation is discretised by five-point differences, with no flux through the sides of the surface, so that filled
    heights stay within the range of the valid heights around them. Conjugate gradients with the diagonal as
    preconditioner solve it, starting from the nearest valid heights; the number of iterations grows with the width of
    the widest hole.

    Returns
    -------
    surface : without invalid points.
    residual : ‖b − A h‖ / ‖b‖, recomputed from the filled heights, with b from the valid neighbours; 0 if no point is
        invalid.

    Raises
    ------
    ConvergenceError
        If the residual stays above 1e-9.
    """
    if not surface.invalid.any():
        return surface, 0.0
    _, nearest = scipy.ndimage.distance_transform_edt(surface.invalid, sampling=surface.spacing, return_indices=True)
    start = surface.heights[tuple(nearest)]
    level = float(surface.heights[surface.valid].mean())
    matrix, right = _laplace(surface.heights - level, surface.invalid, surface.spacing)
    scale = float(np.linalg.norm(right)) or 1.0
    diagonal = matrix.diagonal()
    filled, _ = scipy.sparse.linalg.cg(
        matrix,
        right,
        x0=start[surface.invalid] - level,
        rtol=0.5 * RESIDUAL_TOLERANCE,
        maxiter=MAX_ITERATIONS,
        M=scipy.sparse.linalg.LinearOperator(matrix.shape, matvec=lambda residual: residual / diagonal),
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


def _laplace(heights: Array, invalid: Mask, spacing: tuple[float, float]) -> "tuple[scipy.sparse.csr_array, Array]":
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
