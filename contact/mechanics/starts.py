"""What a search begins from: the contact at another load, or on a coarser grid, brought within its own bounds."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.contact import Contact

TURN = 0.3
"""A gap of one spacing counts as the pressure −0.3 E*."""

CARRIED = 1e-14
"""The mean is met to this part of it."""

MOST_STEPS = 200


def shifted(pressure: Array, mean: float, most: float) -> Array:
    """clip(p + λ, 0, H) with the mean W: of all pressures within the bounds that carry the load the nearest to p.

    By Newton's method within a bracket: the mean grows with λ, and is straight between kinks.

    Parameters
    ----------
    pressure : p, any shape, finite.
    mean : W, above 0 and at most H.
    most : H, which may be infinite.
    """
    low = -float(pressure.max())
    high = min(mean, most) - float(pressure.min())
    shift = min(max(0.0, low), high)
    for _ in range(MOST_STEPS):
        moved = pressure + shift
        kept = np.clip(moved, 0.0, most)
        missing = mean - float(kept.mean())
        if abs(missing) <= CARRIED * mean or not low < high:
            break
        if missing > 0:
            low = shift
        else:
            high = shift
        inside = np.count_nonzero(kept == moved)
        following = shift + missing * pressure.size / inside if inside else (low + high) / 2
        shift = following if low < following < high else (low + high) / 2
        if shift in (low, high):
            break
    return kept


def signed(contact: Contact, composite_modulus: float) -> Array:
    """One field of what is pressed and what is open, p − 0.3 E* g/d, Pa, with d the shorter spacing.

    It goes through 0 at the edges of contact, so that shifting it moves them.
    """
    shortest = min(d for n, d in zip(contact.gap.shape, contact.spacing, strict=True) if n > 1)
    return contact.pressure - TURN * composite_modulus / shortest * contact.gap


def refined(field: Array) -> Array:
    """A periodic field on a grid twice as fine both ways, linear between its nodes, which it keeps."""
    for axis in (0, 1):
        between = (field + np.roll(field, -1, axis)) / 2
        field = np.stack([field, between], axis + 1).reshape([n * (1 + (k == axis)) for k, n in enumerate(field.shape)])
    return field
