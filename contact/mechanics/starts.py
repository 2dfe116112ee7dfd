"""Initial pressures of a contact search from the contact at another load or on a coarser grid."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics import kernels
from roughfilm.contact.mechanics.contact import Contact

GAP_PRESSURE = 0.3
"""Negative pressure assigned to a gap of one spacing, in units of E*."""

MEAN_TOLERANCE = 1e-14
"""Relative tolerance of the mean pressure."""

MAX_STEPS = 200
"""Largest number of Newton steps."""


def shifted(pressure: Array, mean: float, most: float) -> Array:
    """The pressure clip(p + λ, 0, H) with the mean W, the nearest to p within the bounds.

    The shift λ follows from Newton's method within a bracket; the mean is increasing and piecewise linear in λ.

    Parameters
    ----------
    pressure : p, any shape, finite, any unit.
    mean : W, above 0 and at most H.
    most : H, may be infinite.

    Returns
    -------
    Array : same shape as ``pressure``.
    """
    low = -float(pressure.max())
    high = min(mean, most) - float(pressure.min())
    shift = min(max(0.0, low), high)
    flat, out = pressure.reshape(-1), np.empty(2)
    for _ in range(MAX_STEPS):
        kernels.clipped_sum(flat, shift, most, out)
        total, inside = (float(number) for number in out)
        missing = mean - total / pressure.size
        if abs(missing) <= MEAN_TOLERANCE * mean or not low < high:
            break
        if missing > 0:
            low = shift
        else:
            high = shift
        candidate = shift + missing * pressure.size / inside if inside else (low + high) / 2
        shift = candidate if low < candidate < high else (low + high) / 2
        if shift in (low, high):
            break
    moved = pressure + shift
    return np.clip(moved, 0.0, most, out=moved)


def signed(contact: Contact, composite_modulus: float) -> Array:
    """Signed field p − 0.3 E* g/d, shape (nx, ny), Pa, with pressure p, gap g and shorter spacing d.

    It vanishes at the edges of contact, so that a shift moves them.
    """
    shortest = min(d for n, d in zip(contact.gap.shape, contact.spacing, strict=True) if n > 1)
    return contact.pressure - GAP_PRESSURE * composite_modulus / shortest * contact.gap


def refined(field: Array) -> Array:
    """A periodic field interpolated linearly to a grid twice as fine, shape (2 nx, 2 ny)."""
    fine = np.empty([2 * n for n in field.shape])
    kernels.refine(field, fine)
    return fine
