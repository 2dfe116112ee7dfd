"""How steep a surface may be for thin-film theory and for its correction, before anything is solved."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.rough_gap.flow.waves import nearly_smooth_flow
from roughfilm.rom.rough_gap.walls import Walls

ACROSS, ALONG, NO_LAY = 0.8, 1.0, 0.9
"""What thin-film theory lets too much through, over the mean square slope of one wall whose waves are long and low:
across ridges, along them, and over a surface without a lay, in every direction."""

LEAST = 0.1
"""Of a factor of nearly smooth flow: where roughness is large it may vanish, and is nothing to divide by."""

REACH = 0.25
"""Largest part of the dissipation that slope may add: up to there ``slope_corrected`` gives
errors below 13 %; on the ridges and cells on which it was judged they were below 1.8 %."""


ROUGHEST = 0.3
"""Rms of the gap over its mean, up to which low-roughness theory tells anything."""


def allowed_rms_slope(excess: float, *, factor: float = NO_LAY) -> float:
    """The rms slope |∇z| at which thin-film theory lets that part too much through: √(excess/c).

    Parameters
    ----------
    excess : over Stokes flow, above 0, far below 1.
    factor : c: 0.8 across ridges, 1 along them, 0.9 without a lay, for one rough wall, low and long against the gap.
        High ridges have c = 0.8 <h'²/h³>/(<h'²><1/h³>) across and <h³h'²>/(<h³><h'²>) along: less if they are
        sinusoids, up to twice as much if the deep places are the steep ones. Short waves count less.

    Examples
    --------
    >>> [round(allowed_rms_slope(excess), 3) for excess in (0.01, 0.05)]
    [0.105, 0.236]
    """
    if not (0 < excess < 1 and factor > 0):
        raise InputError(f"excess: got {excess!r}, factor {factor!r}; give 0 to 1 and above 0")
    return float(np.sqrt(excess / factor))


def part_of_lost_waves(whole: Walls, part: Walls, *, stokes: bool) -> Array:
    """By what part of themselves A₁₁, A₂₂, B₁ and friction change if the walls lose waves, shape (4,).

    By :func:`rom.rough_gap.flow.waves.nearly_smooth_flow`: a measure of what a grid cannot hold, of second order in
    roughness over gap, and no more than a hint where that is large.

    Parameters
    ----------
    whole, part : the walls, and the same less some waves; on any nodes.
    stokes : False for Reynolds' theory.
    """
    rows = [
        np.array([*np.diag(found.pressure), found.shear[0], found.friction])
        for found in (nearly_smooth_flow(walls, stokes=stokes).relative for walls in (whole, part))
    ]
    return np.asarray(np.abs(rows[0] - rows[1]) / np.maximum(np.abs(rows[1]), LEAST))


def expected_excess(walls: Walls) -> Array:
    """What thin-film theory lets too much through along x and y, over Stokes flow, by the walls' spectra: shape (2,).

    By :func:`rom.rough_gap.flow.waves.nearly_smooth_flow`, for any wavelength, of second order in roughness over gap:
    1.2 to 1.4 times too much for a milled surface whose rms height is a quarter of the gap.

    Raises
    ------
    InputError
        If the gap's rms is above 0.3 of its mean: :attr:`rom.rough_gap.flow.corrected.SlopeCorrected.excess` tells it
        then.
    """
    part = float(walls.gap.std()) / walls.mean_gap
    if not part <= ROUGHEST:
        raise InputError(
            f"walls: the gap's rms is {part:.2g} of its mean; up to {ROUGHEST} can be told without solving"
        )
    thin, stokes = (np.diag(nearly_smooth_flow(walls, stokes=way).pressure) for way in (False, True))
    return np.asarray((thin - stokes) / stokes)
