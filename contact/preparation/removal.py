"""What the removal of spikes does to a surface, and whether they may be a texture: the warnings of step 2."""

import math

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.parameters.bearing_curve import bearing_core, descending
from roughfilm.contact.preparation.spikes import Spikes
from roughfilm.contact.surfaces.surface import Surface

CHANGE = 0.1
"""Relative change of Sq, Spk or Svk above which the removal of spikes causes a warning."""

FRACTION = 0.01
"""Fraction of the points above which their removal causes a warning."""

MIN_ALIKE, HEIGHT_SCATTER, SIZE_SCATTER = 4, 0.15, 0.3
"""Smallest number of spots that can be alike, and the largest relative standard deviations of their heights and of
their numbers of points with which they are."""

MIN_REGULAR, REGULARITY = 9, 1.5
"""Smallest number of spots that can be regular, and the smallest mean distance of nearest neighbours with which they
are, over that of random places; a square lattice has 2."""


def removal_warnings(surface: Surface, spikes: Spikes) -> tuple[str, ...]:
    """A warning where the removal of spikes and rims changes a surface much, or may have removed a texture.

    It is given where the points are more than 1 % of the valid ones, where Sq, Spk or Svk changes by more than 10 %,
    where four or more spots are alike in height and size, or where nine or more are regular: the mean distance R of
    nearest neighbours exceeds 1.5 times that of random places, 1/(2 √(n/A)) for n spots on the area A.

    Parameters
    ----------
    surface : after removal of its form, with the spikes.
    spikes : the points that were found, shape (nx, ny).

    References
    ----------
    P. J. Clark, F. C. Evans, Ecology 35 (1954) 445 (distance of nearest neighbours).
    """
    removed = spikes.points
    if not removed.any():
        return ()
    numbers, count = scipy.ndimage.label(removed, np.ones((3, 3)))
    fraction = float(removed.sum() / surface.valid.sum())
    changes = _changes(surface.heights[surface.valid], surface.heights[surface.valid & ~removed])
    looks = [
        look
        for look, found in (
            ("alike", _are_alike(np.abs(surface.heights), numbers, count)),
            ("regular", _are_regular(removed, surface, numbers, count)),
        )
        if found
    ]
    if fraction <= FRACTION and not changes and not looks:
        return ()
    effect = f", which changes {', '.join(changes)}" if changes else ""
    doubt = f"; the spots are {' and '.join(looks)}, as those of a texture are" if looks else ""
    return (
        f"{100 * fraction:.2g} % of the points, in {count} spots, were taken for spikes or rims of invalid regions, "
        f"and are filled in{effect}{doubt}; look at the measurement: outliers.limit=0 keeps them, a larger limit takes "
        "fewer",
    )


def _changes(before: Array, after: Array) -> list[str]:
    """The parameters that change much, with both values."""
    values = {
        name: (_parameter(name, before), _parameter(name, after)) for name in ("Sq", "Spk", "Svk") if after.size > 1
    }
    return [
        f"{name} from {1e6 * old:.3g} to {1e6 * new:.3g} µm"
        for name, (old, new) in values.items()
        if abs(old - new) > CHANGE * old
    ]


def _parameter(name: str, heights: Array) -> float:
    if np.ptp(heights) == 0:
        return 0.0
    if name == "Sq":
        return float(heights.std())
    core = bearing_core(descending(heights))
    return core.peak if name == "Spk" else core.valley


def _are_alike(size: Array, numbers: Array, count: int) -> bool:
    """Whether the largest sizes of the numbered spots, and their numbers of points, differ little."""
    if count < MIN_ALIKE:
        return False
    extremes = scipy.ndimage.maximum(size, numbers, np.arange(1, count + 1))
    points = np.bincount(numbers.ravel())[1:]
    return bool(
        np.std(extremes) < HEIGHT_SCATTER * np.mean(extremes) and np.std(points) < SIZE_SCATTER * np.mean(points)
    )


def _are_regular(removed: Mask, surface: Surface, numbers: Array, count: int) -> bool:
    """Whether nearest neighbours among the numbered spots are farther apart than at random places."""
    if count < MIN_REGULAR:
        return False
    places = np.array(scipy.ndimage.center_of_mass(removed, numbers, np.arange(1, count + 1))) * surface.spacing
    distances = scipy.spatial.cKDTree(places).query(places, k=2)[0][:, 1]
    at_random = 0.5 * math.sqrt(math.prod(surface.size) / count)
    return bool(distances.mean() > REGULARITY * at_random)
