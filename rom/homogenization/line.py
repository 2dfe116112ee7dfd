"""Flow factors of a profile: a periodic gap that varies along the sliding alone, linear between points."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from roughfilm.contact.foundation.arrays import Array, unmasked
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.conductance import faces, straight_inverse
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap, GapFactors, flow_factors_at
from roughfilm.rom.homogenization.grids import coarser_grids
from roughfilm.rom.homogenization.richardson import uncertainty_of


@dataclass(frozen=True, kw_only=True)
class LineFactors:
    """Flow factors of a profile and their uncertainty, in the same units."""

    factors: FlowFactors
    uncertainty: FlowFactors


def line_factors(gap: ArrayLike) -> LineFactors:
    """Homogenized coefficients of a profile, exact for straight lines between its points.

    A₁₁ = 1/<h⁻³>, A₂₂ = <h³>, B = (<h⁻²>/<h⁻³>, 0), d = <h⁻¹>, e = <h⁻¹> - <h⁻²>²/<h⁻³>, where a line from h₁ to h₂
    has <h⁻³> = (h₁ + h₂)/(2 h₁² h₂²), <h⁻²> = 1/(h₁ h₂), <h⁻¹> = ln(h₂/h₁)/(h₂ - h₁) and
    <h³> = (h₁ + h₂)(h₁² + h₂²)/4. The source's φx and φs are A₁₁ and B₁ over those of a smooth film, in ``relative``.

    Parameters
    ----------
    gap : h >= 0, m, shape (n,), n >= 2; one period of evenly spaced points; the spacing has no effect.

    Returns
    -------
    ``uncertainty`` estimates the effect of the smooth gap between the points, from lines through all, every second and
    every fourth point (infinite below 8 points). The lines themselves are integrated exactly.

    If a point touches the wall (h = 0) the gap is sealed along x: A₁₁ = B₁ = 0, ``sealed`` is (True, False), and d and
    e leave out the lines that end there.

    Raises
    ------
    InputError
        If the gap is not an array of at least 2 finite numbers, is negative anywhere or closed everywhere.

    The error is of second order in the spacing where the gap is smooth. Gaps with the same bearing-area curve have the
    same factors.

    Source: Sahlin, Almqvist, Larsson and Glavatskih, Tribol. Int. 40 (2007) 1025 (thesis, Eqs. C.15
    to C.18).
    """
    h = checked_profile(gap)
    factors = [_of_one(points[:, 0]) for points, _ in coarser_grids(h[:, None], (1.0, 1.0))]
    return LineFactors(factors=factors[-1], uncertainty=uncertainty_of(factors))


def profile_over_gap(heights: ArrayLike) -> FactorsOverGap:
    """Factors of h = ĥ - (r - <r>) over the mean gap ĥ, as in :func:`line_factors`.

    Parameters
    ----------
    heights : r of the rough wall, m, shape (n,), n >= 2, positive towards the smooth wall; one period, evenly spaced.

    Raises
    ------
    InputError
        If the heights are not a profile, or when the factors are evaluated at a mean gap not above the highest point.
    """
    r = _numbers(heights, "heights")
    r = r - r.mean()
    highest = float(r.max())

    def factors(mean_gap: Array) -> GapFactors:
        clearance = np.asarray(mean_gap, dtype=np.float64)
        if clearance.size and not clearance.min() > highest:
            raise InputError(
                f"mean_gap: got {clearance.min():.6g} m, where the profile rises to {highest:.6g} m; the walls would "
                "touch, raise it"
            )
        flat = _straight(clearance.ravel() - r[:, None])
        return GapFactors(**{name: values.reshape(clearance.shape) for name, values in vars(flat).items()})

    return factors


def checked_profile(gap: ArrayLike) -> Array:
    """The profile as floats; InputError as in :func:`line_factors`."""
    h = _numbers(gap, "gap")
    if h.min() < 0:
        place = int(h.argmin())
        raise InputError(f"gap: got {h[place]:.6g} m at [{place}]; walls cannot overlap, set contact to 0")
    if not h.any():
        raise InputError("gap: is closed everywhere; there is no film, raise the separation")
    return h


def _numbers(values: ArrayLike, place: str) -> Array:
    found = unmasked(place, values)
    if found.ndim != 1 or found.size < 2:
        raise InputError(f"{place}: got shape {found.shape}; give a profile of at least 2 points")
    if found.dtype.kind not in "fiu":
        raise InputError(f"{place}: got {found.dtype}; give real numbers, in m")
    found = found.astype(np.float64)
    if not np.isfinite(found).all():
        point = int(np.flatnonzero(~np.isfinite(found))[0])
        raise InputError(f"{place}: got {found[point]} at [{point}]; fill such points first")
    return found


def _of_one(points: Array) -> FlowFactors:
    return flow_factors_at(float(points.mean()), lambda _mean: _straight(points[:, None]))


def _straight(gaps: Array) -> GapFactors:
    """Factors of m profiles, shape (n, m), linear between points; arrays of shape (m,)."""
    scale = gaps.mean(axis=0)
    h = gaps / scale
    after = np.roll(h, -1, axis=0)
    lines = faces(h)
    is_open = lines.east.all(axis=0)
    couette = straight_inverse(h).mean(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        along = np.where(is_open, 1 / (1 / lines.east).mean(axis=0), 0.0)
        squared = np.where(is_open, (lines.drag / lines.east).mean(axis=0), 0.0)
    drag = along * squared
    nothing = np.zeros_like(scale)
    return GapFactors(
        along=along * scale**3,
        across=((h + after) * (h * h + after * after)).mean(axis=0) / 4 * scale**3,
        cross=nothing,
        drag=drag * scale,
        drag_across=nothing,
        couette=couette / scale,
        shear_couette=(couette - drag * squared) / scale,
        streaming=drag * squared / scale,
        least=gaps.min(axis=0),
    )
