"""Closed-form solutions of parallel plates that approach each other, with ambient pressure at their edges."""

import math
from dataclasses import dataclass

from roughfilm.contact.foundation.errors import InputError

TERMS = 40
"""Number of terms of the series of a rectangle; the last one is below 1e-9 of the load, and of the pressure."""


@dataclass(frozen=True, kw_only=True)
class SqueezeSolution:
    """Solution of plates at the distance h that approach each other at the velocity V.

    Attributes
    ----------
    load : load W, N (N/m of infinitely long plates).
    pressure_max : maximum pressure, Pa.
    resistance : W h³/V, N s m² (N s m): it depends on plates and viscosity alone.
    """

    load: float
    pressure_max: float
    resistance: float


def closing_time(resistance: float, load: float, films: tuple[float, float]) -> float:
    """The time, s, in which a constant load closes the film between parallel plates from one thickness to another.

    t = (W h³/V) (h₂⁻² - h₁⁻²)/(2 W), infinite for h₂ = 0.

    Parameters
    ----------
    resistance : W h³/V of the plates (:class:`SqueezeSolution`), N s m² (N s m of infinitely long plates).
    load : constant load W, N (N/m), above 0.
    films : film thicknesses h₁ and h₂ at the beginning and at the end, m, h₁ >= h₂ >= 0.

    Raises
    ------
    InputError
        If the load is not above 0, or the film grows.

    Source: Stefan 1874, Sitzungsberichte der Akademie der Wissenschaften in Wien 69, 713-735.
    """
    first, last = films
    if load <= 0:
        raise InputError(f"load: got {load!r} N; it must be above 0")
    if not 0 <= last <= first or first == 0:
        raise InputError(f"films: got {first!r} m and {last!r} m; the second must be 0 or more and at most the first")
    return math.inf if last == 0 else resistance / (2 * load) * (last**-2 - first**-2)


def squeezed_strip(*, film: float, length: float, approach: float, viscosity: float) -> SqueezeSolution:
    """The solution per width of infinitely long plates.

    W = η V L³/h³ and p = 6 η V (L²/4 - x²)/h³ at the distance x from the middle.

    Parameters
    ----------
    film : film thickness h, m.
    length : length L of the plates along the flow, m.
    approach : velocity V, m/s.
    viscosity : viscosity η, Pa s.

    Source: Reynolds 1886, doi:10.1098/rstl.1886.0005.
    """
    peak = 1.5 * viscosity * approach * length**2 / film**3
    return _solution(viscosity * length**3, peak, film, approach)


def squeezed_disc(*, film: float, radius: float, approach: float, viscosity: float) -> SqueezeSolution:
    """The solution of circular plates.

    W = 3 π η V R⁴/(2 h³) and p = 3 η V (R² - r²)/h³.

    Parameters
    ----------
    film : film thickness h, m.
    radius : radius R, m.
    approach : velocity V, m/s.
    viscosity : viscosity η, Pa s.

    Source: Stefan 1874, Sitzungsberichte der Akademie der Wissenschaften in Wien 69, 713-735; Reynolds 1886.
    """
    peak = 3 * viscosity * approach * radius**2 / film**3
    return _solution(1.5 * math.pi * viscosity * radius**4, peak, film, approach)


def squeezed_annulus(
    *, film: float, inner_radius: float, outer_radius: float, approach: float, viscosity: float
) -> SqueezeSolution:
    """The solution of annular plates with ambient pressure at both radii a < b.

    p = 3 η V (b² - r² - (b² - a²) ln(b/r)/ln(b/a))/h³ and W = 3 π η V (b⁴ - a⁴ - (b² - a²)²/ln(b/a))/(2 h³).

    Parameters
    ----------
    film : film thickness h, m.
    inner_radius, outer_radius : radii a and b, m.
    approach : velocity V, m/s.
    viscosity : viscosity η, Pa s.

    Raises
    ------
    InputError
        If the inner radius is not above 0 and below the outer one.

    Source: Pinkus and Sternlicht 1961, Theory of Hydrodynamic Lubrication, chapter 7.
    """
    a, b = inner_radius, outer_radius
    if not 0 < a < b:
        raise InputError(f"inner_radius: got {a!r} m; it must be above 0 and below outer_radius, {b!r} m")
    logarithm, difference = math.log(b / a), b**2 - a**2
    square = difference / (2 * logarithm)  # of the radius of the maximum pressure
    above = b**2 - square - difference * math.log(b / math.sqrt(square)) / logarithm
    resistance = 1.5 * math.pi * viscosity * (b**4 - a**4 - difference**2 / logarithm)
    return _solution(resistance, 3 * viscosity * approach / film**3 * above, film, approach)


def squeezed_rectangle(
    *, film: float, length: float, width: float, approach: float, viscosity: float
) -> SqueezeSolution:
    """The solution of rectangular plates, by series over odd n.

    W = η V L³ B/h³ (1 - (192/π⁵) (L/B) Σ tanh(n π B/(2 L))/n⁵), and the maximum pressure is
    3 η V L²/(2 h³) (1 - (32/π³) Σ (-1)^((n - 1)/2)/(n³ cosh(n π B/(2 L)))).

    Parameters
    ----------
    film : film thickness h, m.
    length, width : lengths L and B of the sides, m, in any order.
    approach : velocity V, m/s.
    viscosity : viscosity η, Pa s.

    Source: the torsion of a rectangular bar, whose equation is the same: Timoshenko and Goodier 1951, Theory of
    Elasticity, section 109; for plates Archibald 1956, Trans. ASME 78, 29-35.
    """
    length, width = min(length, width), max(length, width)
    odd = range(1, 2 * TERMS, 2)
    ratio = math.pi * width / (2 * length)
    through = 1 - 192 / math.pi**5 * length / width * math.fsum(math.tanh(n * ratio) / n**5 for n in odd)
    middle = 1 - 32 / math.pi**3 * math.fsum(
        (-1) ** (n // 2) * 2 * math.exp(-n * ratio) / (1 + math.exp(-2 * n * ratio)) / n**3 for n in odd
    )
    peak = 1.5 * viscosity * approach * length**2 / film**3 * middle
    return _solution(viscosity * length**3 * width * through, peak, film, approach)


def _solution(resistance: float, pressure_max: float, film: float, approach: float) -> SqueezeSolution:
    return SqueezeSolution(load=resistance * approach / film**3, pressure_max=pressure_max, resistance=resistance)
