"""Two surfaces on one grid: resampling to a common pixel spacing, and shifting by a fraction of a pixel."""

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.filling import fill_invalid
from roughfilm.contact.surfaces.surface import Surface

MAX_DRIFT = 0.01
"""Largest difference of two grids at the far end of a surface, pixels, at which their spacings count as equal."""

SPLINE_ORDER = 3
"""Order of the splines that interpolate heights."""

SPLINE_MARGIN = 4
"""Pixels at the sides of a surface that is not periodic where splines between the pixels are inaccurate."""


def common_spacing(first: Surface, second: Surface) -> tuple[Surface, Surface]:
    """Both surfaces on pixels of the larger spacing in each direction; a surface that has them stays as it is.

    Where pixels grow, the heights are averaged by a Gaussian filter of the variance of the new pixel less that of the
    old one, then interpolated by cubic splines. A new pixel is invalid if one of the old pixels beside its centre is.

    Raises
    ------
    InputError
        If fewer than 8 pixels are left in a direction.
    ConvergenceError
        If the filling of invalid points does not converge.
    """
    pairs = zip(first.spacing, second.spacing, strict=True)
    spacing = [max(pair) for pair in pairs]
    one, two = (_resampled(surface, (spacing[0], spacing[1])) for surface in (first, second))
    return one, two


def _resampled(surface: Surface, spacing: tuple[float, float]) -> Surface:
    ratios = [new / old for new, old in zip(spacing, surface.spacing, strict=True)]
    if all((ratio - 1) * n < MAX_DRIFT for ratio, n in zip(ratios, surface.shape, strict=True)):
        return surface
    shape = tuple(int(n / ratio + 1e-9) for n, ratio in zip(surface.shape, ratios, strict=True))
    if min(shape) < 8:
        raise InputError(
            f"registration: {shape[0]} x {shape[1]} pixels are left at the larger spacing of both surfaces; 8 x 8 are "
            "needed; give measurements of similar spacing"
        )
    widths = [np.sqrt(max(ratio**2 - 1, 0.0) / 12) for ratio in ratios]
    heights = scipy.ndimage.gaussian_filter(fill_invalid(surface)[0].heights, widths, mode="nearest")
    offsets = [(ratio - 1) / 2 for ratio in ratios]
    return surface.with_heights(
        _sampled(heights, ratios, offsets, shape, SPLINE_ORDER),
        spacing=spacing,
        invalid=_sampled(surface.invalid.astype(np.float64), ratios, offsets, shape, 1) > 1e-6,
        periodic=False,
    )


class Sampler:
    """The heights of a surface between its pixels, by cubic splines through the heights.

    Invalid points are filled with a harmonic function first; a sample is invalid if one of the pixels around it is.
    """

    def __init__(self, surface: Surface) -> None:
        """Compute the splines; raises ConvergenceError if the filling of invalid points does not converge."""
        self.shape = surface.shape
        heights = fill_invalid(surface)[0].heights
        self.invalid = surface.invalid.astype(np.float64)
        self.level = float(heights.mean())
        self.mode = "grid-wrap" if surface.periodic else "mirror"
        self.splines = scipy.ndimage.spline_filter(heights - self.level, order=SPLINE_ORDER, mode=self.mode)

    def __call__(self, start: tuple[float, float], shape: tuple[int, int]) -> tuple[Array, Mask]:
        """Heights and mask of valid points on ``shape`` pixels, the first of which lies at ``start``, pixels."""
        heights = _sampled(self.splines, [1.0, 1.0], start, shape, SPLINE_ORDER, self.mode, prefilter=False)
        if not self.invalid.any():
            return heights + self.level, np.ones(shape, dtype=bool)
        near = _sampled(self.invalid, [1.0, 1.0], start, shape, 1, self.mode)
        return heights + self.level, near < 1e-6


def _sampled(
    field: Array, ratios: list[float], offsets: object, shape: object, order: int, mode: str = "mirror", **options: bool
) -> Array:
    return np.asarray(
        scipy.ndimage.affine_transform(
            field, np.asarray(ratios), offset=offsets, output_shape=shape, order=order, mode=mode, **options
        )
    )


def overlap(first: tuple[int, int], second: tuple[int, int], shift: tuple[float, float]) -> tuple[slice, slice]:
    """The pixels of the first surface that lie on the second one, whose first pixel is at ``shift``, pixels.

    If the shift is no whole number of pixels, four pixels at the sides of the second one are left out: the splines that
    interpolate its heights are inaccurate there.

    Raises
    ------
    InputError
        If fewer than 8 pixels are left in a direction.
    """
    slices = []
    for axis, (n, m, t) in enumerate(zip(first, second, shift, strict=True)):
        margin = SPLINE_MARGIN if abs(t - round(t)) > 1e-6 else 0
        begin, end = max(0, int(np.ceil(t + margin - 1e-9))), min(n, int(np.floor(m - 1 - margin + t + 1e-9)) + 1)
        if end - begin < 8:
            raise InputError(
                f"registration: the surfaces overlap by {max(end - begin, 0)} pixels along {'xy'[axis]}; 8 are needed; "
                "give a smaller shift"
            )
        slices.append(slice(begin, end))
    return slices[0], slices[1]
