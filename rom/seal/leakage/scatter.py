"""The scatter of the sealing load between surfaces of equal statistics."""

from collections.abc import Mapping

MEAN_SEALING_LOAD = 0.22
"""Geometric mean of the sealing load W/(E* g') of surfaces without a lay, with E* and the rms slope g'.

It is that of 240 independent random surfaces in two directions each: self-affine ones with Hurst exponents of 0.1 to 1
and roll-offs of 1 to 1/8 of the side, and Gaussian ones with Sal of 1/32 to 1/6 of the side; 64² to 256² nodes.
"""

SEALING_LOADS: Mapping[str, tuple[float, float]] = {
    "without a lay": (0.16, 0.32),
    "skewed, without a lay": (0.11, 0.32),
    "with a lay": (0.11, 0.44),
}
"""Intervals of W/(E* g') that contain 95 of 100 directions of independent surfaces, by group.

Skewed surfaces have Ssk of -1.5 to 1.5. Surfaces with a lay have correlation lengths in a ratio of 2 to 8 and a lay at
any angle to the flow; single ones seal at 0.04 to 0.7. Source: ``scripts/studies/paper_f/scatter.py``.
"""
