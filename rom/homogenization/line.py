"""Flow factors of a profile: a periodic gap that varies along the sliding direction alone, straight between points."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from contact.errors import InputError
from rom.gap import Array
from rom.homogenization.conductance import faces
from rom.homogenization.factors import FlowFactors
from rom.homogenization.flow_factors import coarser_grids, uncertainty_of


@dataclass(frozen=True, kw_only=True)
class LineFactors:
    """Flow factors of a profile and how far off they may be, each in the same units."""

    factors: FlowFactors
    uncertainty: FlowFactors


def line_factors(gap: ArrayLike) -> LineFactors:
    """Homogenized coefficients of a profile, exact for straight lines between its points.

    A₁₁ = 1/<h⁻³>, A₂₂ = <h³>, B = (<h⁻²>/<h⁻³>, 0), d = <h⁻¹>, e = <h⁻¹> - <h⁻²>²/<h⁻³>, where a line from h₁ to h₂
    has <h⁻³> = (h₁ + h₂)/(2 h₁² h₂²), <h⁻²> = 1/(h₁ h₂), <h⁻¹> = ln(h₂/h₁)/(h₂ - h₁) and
    <h³> = (h₁ + h₂)(h₁² + h₂²)/4. The source's φx and φs are A₁₁ and B₁ over those of a smooth film, in ``relative``.

    Parameters
    ----------
    gap : h >= 0, m, shape (n,), n >= 2; one period, evenly spaced (how far apart the points are does not matter).

    Returns
    -------
    ``uncertainty`` tells what the points do not: what a smooth gap through them might do between them, from lines
    through all, every second and every fourth point (infinite below 8 points). The lines themselves are integrated
    exactly, so that there is no number of nodes to choose: the source's study of 2¹⁰ to 2¹⁶ nodes has nothing to show.

    Where a point touches the wall (h = 0) nothing flows along x: A₁₁ = B₁ = 0, ``sealed`` is (True, False), and d and e
    leave out the lines that end there.

    Raises
    ------
    InputError
        For a gap that is no array of at least 2 finite numbers, is below 0 anywhere or closed everywhere.

    Second order in the distance of points where the gap is smooth. Of all gaps, those with the same bearing curve have
    the same factors.

    Source: Sahlin, Almqvist, Larsson and Glavatskih, Tribol. Int. 40 (2007) 1025 (thesis, Eqs. C.15
    to C.18).
    """
    h = checked_profile(gap)
    found = [_straight(points[:, 0]) for points, _ in coarser_grids(h[:, None], (1.0, 1.0))]
    return LineFactors(factors=found[-1], uncertainty=uncertainty_of(found))


def checked_profile(gap: ArrayLike) -> Array:
    """The profile as numbers; InputError as in :func:`line_factors`."""
    h = np.asarray(gap)
    if h.ndim != 1 or h.size < 2:
        raise InputError(f"gap: got shape {h.shape}; give a profile of at least 2 points")
    if h.dtype.kind not in "fiu":
        raise InputError(f"gap: got {h.dtype}; give real numbers, in m")
    h = h.astype(np.float64)
    if not np.isfinite(h).all():
        place = int(np.flatnonzero(~np.isfinite(h))[0])
        raise InputError(f"gap: got {h[place]} at [{place}]; fill such points first")
    if h.min() < 0:
        place = int(h.argmin())
        raise InputError(f"gap: got {h[place]:.6g} m at [{place}]; walls cannot overlap, set contact to 0")
    if not h.any():
        raise InputError("gap: is closed everywhere; there is no film, raise the separation")
    return h


def ridges_across(
    *, mean_gap: float, along_ridges: float, pressure: float, shear: float, couette: float, shear_couette: float
) -> FlowFactors:
    """Factors of a gap that varies along x alone: A₂₂, A₁₁, B₁, d and e; sealed along x where A₁₁ is 0."""
    return FlowFactors(
        mean_gap=mean_gap,
        pressure=np.diag([pressure, along_ridges]),
        shear=np.array([shear, 0.0]),
        couette=couette,
        shear_couette=shear_couette,
        sealed=(pressure == 0, False),
    )


def _straight(points: Array) -> FlowFactors:
    scale = float(points.mean())
    h = points / scale
    after = np.roll(h, -1)
    lines = faces(h[:, None])
    couette = float(lines.inverse.mean())
    pressure = shear = squared = 0.0
    if lines.east.all():
        pressure = float(1 / (1 / lines.east).mean())
        squared = float((lines.drag / lines.east).mean())
        shear = squared * pressure
    return ridges_across(
        mean_gap=1.0,
        along_ridges=float(((h + after) * (h * h + after * after)).mean() / 4),
        pressure=pressure,
        shear=shear,
        couette=couette,
        shear_couette=couette - shear * squared,
    ).scaled(scale)
