"""How far a preparation changes a surface: its slopes and heights, and the part of it that is lost."""

import math
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.preparation.form import ORDERS, Form
from roughfilm.contact.surfaces.surface import Surface

SMOOTHED = 0.1
"""Relative fall of the rms slope by smoothing above which a warning is given."""


@dataclass(frozen=True, kw_only=True)
class PreparationChange:
    """The change from the measured points to the cell.

    Attributes
    ----------
    slope : ln(g/g'), with the rms slope g of the measured points and g' of the cell, 0 or more.
    height : ln(Sq/Sq'), with the rms height Sq of the measured points and Sq' of the cell, 0 or more.
    lost : fraction of the surface that the cell does not show: points of the window that are filled, cut off or blended
        at the joint, and terms of the form beyond a plane over the number of waves, as roughness may be taken for form.
    waves : size of the window over λ², with the mean wavelength λ = 2π Sq/g.
    """

    slope: float
    height: float
    lost: float
    waves: float


def change(measured: Surface, cell: Surface, *, kept: float, form: Form) -> PreparationChange:
    """The change by a preparation.

    Parameters
    ----------
    measured : the window after removal of its form; points that are no part of the surface are invalid.
    cell : the cell, with any points.
    kept : fraction of the points of the window that the cell shows as measured.
    form : the form that was removed.
    """
    heights = measured.heights[measured.valid]
    before, after = difference_slope(measured), difference_slope(cell)
    rms, least = float(heights.std()), float(cell.heights.std())
    waves = math.prod(measured.size) * (before / (2 * math.pi * rms)) ** 2 if rms > 0 else 0.0
    order = ORDERS.get(form, 0)
    terms = max((order + 1) * (order + 2) // 2 - 3, 0)
    by_form = 0.0 if terms == 0 else min(terms / waves, 1.0) if waves > 0 else 1.0
    return PreparationChange(
        slope=_fall(before, after),
        height=_fall(rms, least),
        lost=1 - min(kept, 1.0) * (1 - by_form),
        waves=waves,
    )


def difference_slope(surface: Surface) -> float:
    """The rms slope from differences of neighbouring valid points, also across the edges if it is periodic."""
    heights, valid, square = surface.heights, surface.valid, 0.0
    for axis, step in enumerate(surface.spacing):
        steps, both = np.roll(heights, -1, axis) - heights, np.roll(valid, -1, axis) & valid
        if not surface.periodic:
            steps, both = np.delete(steps, -1, axis), np.delete(both, -1, axis)
        if both.any():
            square += float(np.mean((steps[both] / step) ** 2))
    return math.sqrt(square)


def smoothing_warnings(before: Surface, after: Surface, points: int) -> tuple[str, ...]:
    """The warning where a moving average of so many points lowers the rms slope by more than ``SMOOTHED``."""
    slope = difference_slope(before)
    fall = 1 - difference_slope(after) / slope if slope > 0 else 0.0
    if fall <= SMOOTHED:
        return ()
    return (
        f"smoothing over {points} points lowers the rms slope by {100 * fall:.0f} %; contact area rises and peak "
        "pressures fall about as much: unless these waves are noise, take smoothing=1",
    )


def _fall(before: float, after: float) -> float:
    return max(math.log(before / after), 0.0) if before > 0 and after > 0 else 0.0
