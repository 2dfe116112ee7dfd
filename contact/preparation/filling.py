"""Step 2: invalid points filled as smoothly as their surroundings allow."""

import numpy as np
import scipy

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.surfaces.surface import Array, Mask, Surface

TOLERANCE = 1e-9
"""Of the true residual, relative to the right-hand side."""

MOST_ITERATIONS = 20_000


def fill_invalid(surface: Surface) -> tuple[Surface, float]:
    """Give every invalid point a height that is harmonic: ∂²h/∂x² + ∂²h/∂y² = 0 with the valid points held fixed.

    Five-point differences with the true spacings; no flux through the sides of the surface. So a filled height never
    leaves the range of the valid heights around it, and valid points stay untouched. Conjugate gradients with the
    diagonal as preconditioner, from the nearest valid heights on: iterations grow with the width of the widest hole.

    Returns
    -------
    surface
        Without invalid points.
    residual
        ‖b − A h‖ / ‖b‖ recomputed from the heights returned, with b from the valid neighbours; 0 where nothing is
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
    found, _ = scipy.sparse.linalg.cg(
        matrix,
        right,
        x0=start[surface.invalid] - level,
        rtol=0.5 * TOLERANCE,
        maxiter=MOST_ITERATIONS,
        M=scipy.sparse.linalg.LinearOperator(matrix.shape, matvec=lambda residual: residual / diagonal),
    )
    residual = float(np.linalg.norm(right - matrix @ found)) / scale
    if not residual <= TOLERANCE:
        raise ConvergenceError(
            f"invalid points: their fill has a residual of {residual:.1e}, above {TOLERANCE:.0e}; "
            "choose a window with smaller holes",
            outcome=Outcome.STALLED,
            iterations=MOST_ITERATIONS,
        )
    heights = surface.heights.copy()
    heights[surface.invalid] = found + level
    return surface.with_heights(heights, invalid=np.zeros(surface.shape, dtype=bool)), residual


def _laplace(heights: Array, invalid: Mask, spacing: tuple[float, float]) -> "tuple[scipy.sparse.csr_array, Array]":
    """Matrix over the invalid points in row-major order, and what their valid neighbours add to the right-hand side."""
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
