"""Uncertainty of the numbers of a contact by the size of its pixels."""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.mechanics.contact import Contact

AREA_PER_EDGE, AREA_OF_ONE = 0.042, 0.5
"""Uncertainty of the area fraction over the fraction of pixels on both sides of the edge of contact, and that of one
such pixel over its area, which averages over the pixels."""

RIDGE_AREA_PER_EDGE, RIDGE_GAP_FACTOR = 0.25, 3.4
"""The same for ridges along the grid, whose edges all lie in the same part of their pixels, and the factor by which the
uncertainty of the mean gap is larger for them."""

SAME_HEIGHT = 1e-9
"""Difference along a ridge, over that across, that is rounding."""

PLASTIC_AREA_PER_EDGE = 0.2
"""Uncertainty of the plastic fraction over the larger fraction of pixels on one side of the edge of plastic contact."""

GAP_PER_RISE, GAP_OF_ONE = 0.04, 0.3
"""Uncertainty of the mean gap over sqrt(1 − A) times the rms rise of the pixels in contact over their neighbours, and
that of one such pixel, which averages over them."""

GAP_PER_STEP = 0.4
"""The part of plastic contact, over (1 − A)/sqrt(n) times the rms step of height at the n pixels beside contact."""

APPROACH_PER_RISE = 0.4
"""Uncertainty of the approach over the rise of the highest pixel over its neighbours."""

PRESSURE_PER_RISE = 0.46
"""Uncertainty of the largest pressure over its rise over its neighbours."""


def uncertainties(contact: Contact) -> dict[str, float]:
    """The 95 % uncertainty of each number of a contact, against the same surface on ever finer pixels.

    Δv is the rise of a value over the mean of its neighbours, S the fraction of pixels beside the edge of contact.
    The uncertainty of the area fraction A is √((0.042 S)² + 0.25 S/n) on n pixels, that of the approach 0.4 Δz at the
    highest point, and that of the largest pressure 0.46 Δp. The mean gap has three parts, which add in squares: that of
    the deformed contact, 0.04 √(1 − A) times the rms Δz over contact; that of the few highest points in light contact,
    0.3/√k of the same for k pixels in contact; and that of the height of the plane, which in plastic contact follows
    from a number of pixels above it, 0.4 ψ (1 − A) s/√m for m open pixels beside contact, with the rms step of height s
    per pixel there and the plastic share ψ of the contact.

    Parameters
    ----------
    contact : of a surface, shape (nx, ny), nx, ny >= 2, whose waves are longer than two pixels.

    Returns
    -------
    dict
        Of ``area_fraction``, ``plastic_fraction``, ``mean_gap``, m, ``approach``, m, and ``pressure_max``, Pa.

    Notes
    -----
    The factors are fitted to 95 of 100 random surfaces (414, with shortest waves of 2.2 to 20 pixels, loads of 0.0005
    to 1.5 E* g', 60 % of them with a hardness of 0.02 to 5 E* g', a fifth with a lay), solved again on pixels four or
    eight times as fine. On 182 others they cover 94 to 98 %, none was off by more than three times the uncertainty,
    which is 2 to 6 times the error in the median. The mean gap was fitted again to 700 surfaces of 48 x 48 pixels
    (shortest waves of 5 to 20 pixels, 60 % of them with a hardness): of 140 contacts that are plastic to 80 % and
    more, it covers 96 %, and the largest error is 1.6 times it; of elastic ones on 2 and 4 times fewer pixels 99 and
    97 %. For ridges along the grid, whose errors do not average, they cover those of 200 waves of 12 to 200 pixels
    against Westergaard's solution.
    """
    touching, plastic, p = contact.in_contact, contact.plastic, contact.pressure
    across = _axes_across(contact.heights)
    ridges, edge = len(across) == 1, sum(_edges(touching))
    rise = _rise(contact.heights, across)
    copies = p.size // math.prod(p.shape[axis] for axis in across)
    over_contact = float(np.sqrt(np.mean(rise[touching] ** 2) * np.mean(~touching)))
    peak = PRESSURE_PER_RISE * float(_rise(p, across)[p == p.max()].max())
    return {
        "area_fraction": RIDGE_AREA_PER_EDGE * edge
        if ridges
        else math.hypot(AREA_PER_EDGE * edge, AREA_OF_ONE * math.sqrt(edge / p.size)),
        "plastic_fraction": _plastic(contact, plastic, peak),
        "mean_gap": math.hypot(
            (RIDGE_GAP_FACTOR if ridges else 1.0) * GAP_PER_RISE * over_contact,
            GAP_OF_ONE * over_contact / math.sqrt(np.count_nonzero(touching) / copies),
            contact.plasticity_index * _of_plane(contact, across, copies),
        ),
        "approach": APPROACH_PER_RISE * float(rise[contact.heights == contact.heights.max()].max()),
        "pressure_max": 0.0 if plastic.any() else peak,
    }


def _of_plane(contact: Contact, across: tuple[int, ...], copies: int) -> float:
    """The uncertainty of the mean gap by the height of the plane if all contact is plastic, of ``copies`` rows."""
    z, touching = contact.heights, contact.in_contact
    beside = _beside(~touching)
    if not beside.any():
        return 0.0
    square = sum((np.roll(z, -1, axis) - np.roll(z, 1, axis))[beside] ** 2 / 4 for axis in across)
    number = np.count_nonzero(beside) / copies
    return GAP_PER_STEP * float(np.mean(~touching)) * math.sqrt(float(np.mean(square)) / number)


def _plastic(contact: Contact, plastic: Mask, peak: float) -> float:
    """The uncertainty of the plastic fraction; without plastic pixels, the fraction that may reach the hardness."""
    if math.isinf(contact.hardness):
        return 0.0
    if not plastic.any():
        return float(np.count_nonzero(contact.pressure + peak >= contact.hardness)) / plastic.size
    inside, outside = _edges(plastic)
    return PLASTIC_AREA_PER_EDGE * max(inside, outside)


def _edges(mask: Mask) -> tuple[float, float]:
    """The fractions of pixels of a mask beside others, and of others beside the mask."""
    return float(np.mean(_beside(mask))), float(np.mean(_beside(~mask)))


def _beside(mask: Mask) -> Mask:
    """The pixels of a mask beside others."""
    found = np.zeros_like(mask)
    for axis in (0, 1):
        for shift in (1, -1):
            found |= mask & ~np.roll(mask, shift, axis)
    return found


def _axes_across(heights: Array) -> tuple[int, ...]:
    """The axes along which the heights vary: one for ridges along the grid, else both."""
    largest = np.ptp(heights)
    varied = tuple(axis for axis in (0, 1) if np.ptp(heights, axis=axis).max() > SAME_HEIGHT * largest)
    return varied or (0, 1)


def _rise(values: Array, axes: tuple[int, ...]) -> Array:
    """The values minus the mean of their neighbours along the axes."""
    around = sum(np.roll(values, shift, axis) for axis in axes for shift in (1, -1))
    return np.asarray(values - around / (2 * len(axes)))
