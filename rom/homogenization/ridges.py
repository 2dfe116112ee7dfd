"""Closed-form flow factors of sinusoidal ridges of any direction."""

from math import cos, sin

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap, GapFactors

MIN_SLOPE_ALONG = 1e-12
"""Ridges with a smaller component of the unit wave vector along the sliding are parallel to it."""


def sinusoidal_ridges(amplitude: float, direction: float) -> FactorsOverGap:
    """Factors of h = ĥ + a sin(k·x) over the mean gap ĥ.

    With n along k, at ``direction`` from the sliding, t along the ridges, r = a/ĥ and b = <h⁻²>/<h⁻³>,

        A = <h⁻³>⁻¹ n nᵀ + <h³> t tᵀ,    B = b n₁ n + ĥ t₁ t,    d = <h⁻¹>,    e = n₁² (<h⁻¹> - b <h⁻²>),

        <h⁻¹> = ĥ⁻¹ (1 - r²)^(-1/2),    <h⁻²> = ĥ⁻² (1 - r²)^(-3/2),    <h⁻³> = ĥ⁻³ (1 + r²/2) (1 - r²)^(-5/2),
        <h³> = ĥ³ (1 + 3r²/2).

    Parameters
    ----------
    amplitude : a, m.
    direction : direction of k, rad; 0 has ridges across the sliding, π/2 along it.

    Raises
    ------
    InputError
        When the factors are evaluated at a mean gap not above the amplitude, where the walls would touch.
    """
    along, across = cos(direction), sin(direction)

    def factors(mean_gap: Array) -> GapFactors:
        h = np.asarray(mean_gap, dtype=float)
        if h.size and not h.min() > amplitude:
            raise InputError(
                f"roughness.amplitude: got {amplitude:.6g} m where the film is {h.min():.6g} m; the walls would touch, "
                "lower it"
            )
        r2 = (amplitude / h) ** 2
        gap = 1 - r2
        inverse, square = gap**-0.5 / h, gap**-1.5 / h**2
        resisting, leading = h**3 * gap**2.5 / (1 + r2 / 2), h**3 * (1 + 1.5 * r2)
        carried = h * gap / (1 + r2 / 2)
        drag = carried * along**2 + h * across**2
        return GapFactors(
            along=resisting * along**2 + leading * across**2,
            across=resisting * across**2 + leading * along**2,
            cross=(resisting - leading) * along * across,
            drag=drag,
            drag_across=(carried - h) * along * across,
            couette=inverse,
            shear_couette=along**2 * (inverse - carried * square),
            streaming=inverse if abs(along) < MIN_SLOPE_ALONG else drag * square,
            least=h - amplitude,
        )

    return factors
