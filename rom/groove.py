"""Shapes of a groove in the lower wall, each made into a gap."""

import numpy as np

from rom.gap import Array, Gap


def cylindrical(*, length: float, film: float, width: float, depth: float) -> Gap:
    """Gap with one centred groove whose wall is a circular arc through its two edges.

    With s the distance from the middle and R = (w²/4 + d²) / 2d the radius of the arc,

        h(s) = film + sqrt(R² - s²) - (R - d)   for |s| < w/2,   film elsewhere.

    Parameters
    ----------
    length, film, width, depth
        Period, film thickness outside the groove, width and depth of the groove, m.
        0 < width < length and 0 < depth <= width / 2 (at most a half circle).

    Returns
    -------
    Gap
        With x = 0 in the middle of the groove.

    Notes
    -----
    h - film is computed as (w²/4 - s²) / (sqrt(R² - s²) + R - d), which has no cancellation for shallow grooves.
    Source: Sahlin et al. 2005, doi:10.1115/1.1828067, Fig. 1.

    Examples
    --------
    >>> gap = cylindrical(length=1e-3, film=30e-6, width=0.3e-3, depth=7.5e-6)
    >>> [float(round(h, 9)) for h in gap.thickness(np.array([0.0, 0.15e-3, 0.4e-3]))]
    [3.75e-05, 3e-05, 3e-05]
    """
    radius = (width**2 / 4 + depth**2) / (2 * depth)

    def thickness(x: Array) -> Array:
        s = np.abs(np.asarray(x, dtype=float))
        inside = np.minimum(s, width / 2)
        numerator = width**2 / 4 - inside**2
        denominator = np.sqrt(np.maximum(radius**2 - inside**2, 0)) + radius - depth
        rise = np.divide(numerator, denominator, out=np.zeros_like(s), where=numerator > 0)
        return np.asarray(film + rise)

    return Gap(film=film, breaks=(-length / 2, -width / 2, width / 2, length / 2), thickness=thickness)
