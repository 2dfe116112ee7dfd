"""Range of validity of thin-film theory and its slope correction, from the walls alone."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.rough_gap.flow.waves import nearly_smooth_flow
from roughfilm.rom.rough_gap.walls import Walls

ISOTROPIC_EXCESS = 0.9
"""Relative flow error of thin-film theory over the mean square slope of one wall with long, low waves without a lay."""

MIN_FACTOR = 0.1
"""Smallest factor of nearly smooth flow that a change is divided by; with large roughness it may vanish."""

MAX_ADDED_DISSIPATION = 0.25
"""Largest relative dissipation added by slope at which ``slope_corrected`` is valid.

Its uncertainty is then at most 3.1 %; its errors on random ridges are up to 2.4 %.
"""

MAX_ROUGHNESS = 0.3
"""Largest rms of the gap over its mean at which low-roughness theory is valid."""


def allowed_rms_slope(excess: float, *, factor: float = ISOTROPIC_EXCESS) -> float:
    """The rms slope |∇z| = √(excess/c) at which thin-film theory has that relative flow error.

    Parameters
    ----------
    excess : flow error relative to Stokes flow, above 0 and much less than 1.
    factor : c: 0.8 across ridges, 1 along them, 0.9 without a lay, for one rough wall with low waves long compared with
        the gap. High ridges have c = 0.8 <h'²/h³>/(<h'²><1/h³>) across and <h³h'²>/(<h³><h'²>) along: less for
        sinusoids, up to twice as much if deep places are steep. Short waves have a smaller c.

    Examples
    --------
    >>> [round(allowed_rms_slope(excess), 3) for excess in (0.01, 0.05)]
    [0.105, 0.236]
    """
    if not (0 < excess < 1 and factor > 0):
        raise InputError(f"excess: got {excess!r}, factor {factor!r}; give 0 to 1 and above 0")
    return float(np.sqrt(excess / factor))


def change_by_lost_waves(whole: Walls, part: Walls, *, stokes: bool) -> Array:
    """The relative changes of A₁₁, A₂₂, B₁ and friction if the walls lose waves, shape (4,).

    The estimate by :func:`rom.rough_gap.flow.waves.nearly_smooth_flow` is of second order in roughness over gap, and
    only indicative for large roughness.

    Parameters
    ----------
    whole, part : the walls, and the walls without some waves, on any nodes.
    stokes : False for Reynolds' theory.
    """
    rows = [
        np.array([*np.diag(factors.pressure), factors.shear[0], factors.friction])
        for factors in (nearly_smooth_flow(walls, stokes=stokes).relative for walls in (whole, part))
    ]
    return np.asarray(np.abs(rows[0] - rows[1]) / np.maximum(np.abs(rows[1]), MIN_FACTOR))


def change_by_roughness(walls: Walls) -> float:
    """The largest change of A₁₁, A₂₂, B₁ and friction by roughness, relative to a smooth gap of the same mean gap.

    The estimate by :func:`rom.rough_gap.flow.waves.nearly_smooth_flow` is of second order in roughness over gap.
    """
    factors = nearly_smooth_flow(walls).relative
    return float(np.nanmax(np.abs(np.array([*np.diag(factors.pressure), factors.shear[0], factors.friction]) - 1)))


def expected_excess(walls: Walls) -> Array:
    """The relative flow error of thin-film theory along x and y, from the spectra of the walls, shape (2,).

    The estimate by :func:`rom.rough_gap.flow.waves.nearly_smooth_flow` holds for any wavelength, to second order in
    roughness over gap. It is 1.2 to 1.4 times too large for a milled surface whose rms height is a quarter of the gap.

    Raises
    ------
    InputError
        If the gap's rms is above 0.3 of its mean; take :attr:`rom.rough_gap.flow.corrected.SlopeCorrected.excess`.
    """
    ratio = float(walls.gap.std()) / walls.mean_gap
    if not ratio <= MAX_ROUGHNESS:
        raise InputError(
            f"walls: got a gap with rms {ratio:.2g} of its mean; it must be at most {MAX_ROUGHNESS}, take "
            "slope_corrected"
        )
    thin, stokes = (np.diag(nearly_smooth_flow(walls, stokes=way).pressure) for way in (False, True))
    return np.asarray((thin - stokes) / stokes)
