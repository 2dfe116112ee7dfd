"""Whether the units of a measured surface can be right: its pixel spacing, rms slope, and rms height over pixels."""

import math
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.surface import Surface

SPACINGS = (0.05e-9, 1e-3)
"""Least and largest plausible spacing of pixels, m."""

ROUNDING = 1e-12
"""Relative difference that is rounding, of a spacing from its limit, and of heights from their size."""

SHARED = 10, 1e-3
"""Least number and fraction of points that share one extreme height at which it may mark missing points."""

MORE_THAN_OTHERS = 5
"""Least ratio of that number to the largest number of points that share another height; rounded heights are below."""

MAX_RMS_SLOPE = 3.0
"""Largest plausible rms slope."""

RELATIVE_HEIGHTS = (1e-5, 1e3)
"""Least and largest plausible rms height, in units of the pixel spacing."""

RMS_HEIGHTS = (1e-11, 1e-3)
"""Least and largest rms height, m, beyond which the unit of the heights is the one to doubt."""

MAX_LINES = 128
"""Number of lines in each direction, up to twice of which slopes are taken along."""

STEEPEST = 0.01
"""Fraction of the steepest slopes that the rms slope leaves out, since spikes and steps have any slope."""

IN_RECIPE = "in the recipe of roughfilm surface"


def implausible(surface: Surface, name: str | Path = "") -> tuple[str, ...]:
    """The warnings that a unit of a measured surface may be wrong; empty if none is, or if it is a synthetic surface.

    Plausible are spacings of pixels of 0.05 nm to 1 mm, rms slopes below 3 and rms heights of 10⁻⁵ to 10³ pixels. The
    rms slope is √(⟨(∂h/∂x)²⟩ + ⟨(∂h/∂y)²⟩), from differences of neighbouring valid points on up to 255 lines in each
    direction, without the steepest 1 %. Heights that differ by rounding alone have no rms height. Nothing is altered.

    Parameters
    ----------
    surface : heights as they were read, or after a preparation.
    name : file of the surface, which begins each sentence.

    Returns
    -------
    tuple of str : a sentence for each value, with its range and the key of the recipe that corrects it.
    """
    place = f"{name}: " if name else ""
    return tuple(place + sentence for sentence in _sentences(surface))


def repeated_extreme(surface: Surface, name: str | Path = "") -> tuple[str, ...]:
    """The warning that one extreme height of a measured surface may mark missing points; empty if it does not seem so.

    It is given where 10 points or more, and 0.1 % or more, share the lowest or the highest height to the last bit, five
    times as many as share any other. Saturated points do so as well. Synthetic, prepared and constant surfaces have no
    such warning.

    Parameters
    ----------
    surface : heights as they were read.
    name : file of the surface, which begins the sentence.
    """
    heights = surface.heights[surface.valid]
    if _synthetic(surface) or "prepared_from" in surface.source or np.ptp(heights) == 0:
        return ()
    place = f"{name}: " if name else ""
    found = []
    for word, extreme in (("lowest", float(heights.min())), ("highest", float(heights.max()))):
        count = int((heights == extreme).sum())
        if count >= max(SHARED[0], SHARED[1] * heights.size):
            others = np.unique(heights[heights != extreme], return_counts=True)[1]
            if count >= MORE_THAN_OTHERS * others.max():
                found.append(
                    f"{place}{count} points ({100 * count / heights.size:.2g} %) share the {word} height, "
                    f"{extreme:.6g} m, to the last bit; if it marks missing points, set read.invalid to it, in the "
                    f"unit of the file, {IN_RECIPE}"
                )
    return tuple(found)


def preparation_doubts(surface: Surface, name: str | Path = "") -> tuple[str, ...]:
    """The warnings of a prepared surface that what was removed from it may have been its texture or its summits."""
    place = f"{name}: " if name else ""
    doubts = surface.source.get("record", {}).get("outliers", {}).get("doubts", [])
    return tuple(f"{place}when it was prepared, {doubt}" for doubt in doubts)


def _sentences(surface: Surface) -> tuple[str, ...]:
    if _synthetic(surface):
        return ()
    least, most = SPACINGS
    if not all(least * (1 - ROUNDING) <= step <= most * (1 + ROUNDING) for step in surface.spacing):
        pixel = " x ".join(f"{step:.3g}" for step in surface.spacing)
        return (
            f"the pixel spacing is {pixel} m, outside of the plausible {least:g} to {most:g} m; if the lateral unit of "
            f"the file is wrong, set read.spacing {IN_RECIPE}",
        )
    heights = surface.heights[surface.valid]
    rms = float(heights.std()) if np.ptp(heights) > ROUNDING * np.abs(heights).max() else 0.0
    relative, slope = rms / math.sqrt(math.prod(surface.spacing)), _rms_slope(surface)
    key = "read.spacing, or read.height_unit,"
    if rms > 0 and not RMS_HEIGHTS[0] <= rms <= RMS_HEIGHTS[1]:
        key = "read.height_unit"
    remedy = f"if a unit of the file is wrong, set {key} {IN_RECIPE}"
    warnings = []
    if not slope < MAX_RMS_SLOPE:
        warnings.append(f"the rms slope is {slope:.3g}, not below the plausible {MAX_RMS_SLOPE:g}; {remedy}")
    low, high = RELATIVE_HEIGHTS
    if rms > 0 and not low <= relative <= high:
        warnings.append(
            f"the rms height is {rms:.3g} m, {relative:.3g} pixels, outside of the plausible {low:g} to {high:g} "
            f"pixels; {remedy}"
        )
    return tuple(warnings)


def _synthetic(surface: Surface) -> bool:
    source = surface.source
    while "prepared_from" in source:
        source = source["prepared_from"]
    return "synthetic" in source


def _rms_slope(surface: Surface) -> float:
    squares = 0.0
    for axis, step in enumerate(surface.spacing):
        every = max(1, surface.shape[1 - axis] // MAX_LINES)
        valid = np.moveaxis(surface.valid, axis, 0)[:, ::every]
        heights = np.moveaxis(surface.heights, axis, 0)[:, ::every]
        squares += _gentle_mean((np.diff(heights, axis=0)[valid[1:] & valid[:-1]] / step) ** 2)
    return math.sqrt(squares)


def _gentle_mean(squares: Array) -> float:
    """The mean of the squares without the largest ones; 0 if there are none."""
    kept = squares.size - int(STEEPEST * squares.size)
    return float(np.partition(squares, kept - 1)[:kept].mean()) if kept else 0.0
