"""The root mean square gradient Sdq and the developed interfacial area ratio Sdr of a surface."""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.surface import Surface


def rms_gradient(surface: Surface) -> float | None:
    """The root mean square gradient Sdq = √⟨(∂z/∂x)² + (∂z/∂y)²⟩, from differences of neighbouring valid points.

    Each derivative is the difference of two neighbours over their distance; its mean square is taken over all pairs of
    valid neighbours along its axis, which extend across the edges of a periodic surface. An invalid point is in no
    pair.

    Returns
    -------
    float or None : Sdq, m/m; None if no two valid points are neighbours along one of the axes.

    Notes
    -----
    The error is of second order in the spacing: a wave with the wave number q along x has the factor
    sin(q dx/2)/(q dx/2). The value grows with each shorter wave that a finer measurement resolves. Source:
    ISO 25178-2:2021, 4.4.
    """
    (nx, ny), total = surface.shape, 0.0
    along_x, along_y = _slopes(_known_heights(surface), surface)
    for slope in (along_x[:, :ny], along_y[:nx]):
        square = slope * slope
        known = square[np.isfinite(square)]
        if not known.size:
            return None
        total += float(known.mean())
    return math.sqrt(total)


def developed_area(surface: Surface) -> float | None:
    """The developed interfacial area ratio Sdr, the area of the surface over that of its projection, minus 1.

    A cell of four points is split into two triangles along each of its diagonals, and the two areas are averaged. Cells
    with an invalid point are left out of both areas. Cells extend across the edges of a periodic surface.

    Returns
    -------
    float or None : Sdr, m²/m², above or equal to 0; None if no cell has four valid points.

    Notes
    -----
    The error is of second order in the spacing; a plane is exact. Gentle slopes have Sdr = Sdq²/2. Source:
    ISO 25178-2:2021, 4.4.
    """
    along_x, along_y = (slope * slope for slope in _slopes(_known_heights(surface), surface))
    total = np.zeros((along_y.shape[0] - 1, along_x.shape[1] - 1))
    for x in (along_x[:, :-1], along_x[:, 1:]):
        for y in (along_y[:-1], along_y[1:]):
            square = x + y
            total += square / (1 + np.sqrt(1 + square))
    known = total[np.isfinite(total)]
    return float(known.mean()) / 4 if known.size else None


def _known_heights(surface: Surface) -> Array:
    """Heights with NaN where invalid and, of a periodic surface, its first lines again behind the last ones, m."""
    heights = np.where(surface.invalid, np.nan, surface.heights)
    return np.pad(heights, (0, 1), mode="wrap") if surface.periodic else heights


def _slopes(heights: Array, surface: Surface) -> tuple[Array, Array]:
    """Slopes between neighbours along x and along y, NaN beside invalid points."""
    dx, dy = surface.spacing
    return np.diff(heights, axis=0) / dx, np.diff(heights, axis=1) / dy
