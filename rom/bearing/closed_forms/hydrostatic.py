"""Closed-form solutions of hydrostatic pads with one recess at a uniform pressure, and of their restrictors."""

import math
from dataclasses import dataclass

from roughfilm.contact.foundation.errors import InputError


@dataclass(frozen=True, kw_only=True)
class HydrostaticSolution:
    """Solution of a hydrostatic pad: load, N (N/m if infinitely wide), and flow out of it, m³/s (m²/s)."""

    load: float
    flow: float


def circular_recess_pad(
    *, film: float, recess_radius: float, radius: float, recess_pressure: float, viscosity: float
) -> HydrostaticSolution:
    """The solution of a circular pad with a circular recess in its middle and parallel walls around it.

    W = π p (R² - r²)/(2 ln(R/r)) and Q = π p h³/(6 η ln(R/r)).

    Parameters
    ----------
    film : film thickness h outside of the recess, m.
    recess_radius, radius : radii r of the recess and R of the pad, m.
    recess_pressure : pressure p in the recess above ambient, Pa.
    viscosity : viscosity η, Pa s.

    Raises
    ------
    InputError
        If the recess is not smaller than the pad.

    Source: Hamrock 1994, Fundamentals of Fluid Film Lubrication, section 13.3.
    """
    if not 0 < recess_radius < radius:
        raise InputError(f"recess_radius: got {recess_radius!r} m; it must be above 0 and below radius, {radius!r} m")
    logarithm = math.log(radius / recess_radius)
    return HydrostaticSolution(
        load=math.pi * recess_pressure * (radius**2 - recess_radius**2) / (2 * logarithm),
        flow=math.pi * recess_pressure * film**3 / (6 * viscosity * logarithm),
    )


def long_recess_pad(
    *, film: float, recess_length: float, length: float, recess_pressure: float, viscosity: float
) -> HydrostaticSolution:
    """The solution per width of an infinitely wide pad with a recess in its middle and parallel walls beside it.

    W = p (L + l)/2 and Q = p h³/(3 η (L - l)), through both ends together.

    Parameters
    ----------
    film : film thickness h outside of the recess, m.
    recess_length, length : lengths l of the recess and L of the pad, m.
    recess_pressure : pressure p in the recess above ambient, Pa.
    viscosity : viscosity η, Pa s.

    Raises
    ------
    InputError
        If the recess is not shorter than the pad.

    Source: Hamrock 1994, Fundamentals of Fluid Film Lubrication, section 13.3.
    """
    if not 0 <= recess_length < length:
        raise InputError(f"recess_length: got {recess_length!r} m; it must be 0 or more and below length, {length!r} m")
    return HydrostaticSolution(
        load=recess_pressure * (length + recess_length) / 2,
        flow=recess_pressure * film**3 / (3 * viscosity * (length - recess_length)),
    )


def behind_capillary(
    *, supply: float, pad_conductance: float, diameter: float, length: float, viscosity: float
) -> float:
    """The pressure, Pa, in a recess behind a capillary, in which the flow is laminar.

    p = p_s/(1 + G/K) with the conductance K = π d⁴/(128 η l) of the capillary.

    Parameters
    ----------
    supply : pressure p_s of the supply above ambient, Pa.
    pad_conductance : flow out of the pad over the pressure in its recess, G, m³/(Pa s).
    diameter, length : diameter d and length l of the capillary, m.
    viscosity : viscosity η, Pa s.

    Source: Hamrock 1994, Fundamentals of Fluid Film Lubrication, section 13.5.
    """
    capillary = math.pi * diameter**4 / (128 * viscosity * length)
    return supply / (1 + pad_conductance / capillary)


def behind_orifice(*, supply: float, pad_conductance: float, area: float, discharge: float, density: float) -> float:
    """The pressure, Pa, in a recess behind an orifice, whose flow is C A √(2 (p_s - p)/ρ).

    p = 2 p_s/(1 + √(1 + 4 p_s G²/k²)) with k² = 2 C² A²/ρ.

    Parameters
    ----------
    supply : pressure p_s of the supply above ambient, Pa, 0 or more.
    pad_conductance : flow out of the pad over the pressure in its recess, G, m³/(Pa s).
    area, discharge : area A of the orifice, m², and its discharge coefficient C, about 0.6.
    density : density ρ, kg/m³.

    Source: Hamrock 1994, Fundamentals of Fluid Film Lubrication, section 13.5, for the flow of an orifice.
    """
    square = 2 * (discharge * area) ** 2 / density
    return 2 * supply / (1 + math.sqrt(1 + 4 * supply * pad_conductance**2 / square))


def compensated_stiffness(*, load: float, film: float, pressure_ratio: float, orifice: bool) -> float:
    """The stiffness -dW/dh, N/m (N/m² if infinitely wide), of a hydrostatic pad behind a restrictor.

    3 W (1 - β)/h behind a capillary, and 6 W (1 - β)/(h (2 - β)) behind an orifice.

    Parameters
    ----------
    load, film : load W, N (N/m), and film thickness h, m.
    pressure_ratio : pressure in the recess over that of the supply, β, 0 to 1.
    orifice : whether the restrictor is an orifice, and not a capillary.

    Raises
    ------
    InputError
        If the pressure ratio is out of range.

    Source: Hamrock 1994, Fundamentals of Fluid Film Lubrication, section 13.5; the derivative of load and flow by h.
    """
    if not 0 <= pressure_ratio <= 1:
        raise InputError(f"pressure_ratio: got {pressure_ratio!r}; it must be 0 to 1")
    steepness = 3 * (1 - pressure_ratio) / ((2 - pressure_ratio) / 2 if orifice else 1.0)
    return load / film * steepness
