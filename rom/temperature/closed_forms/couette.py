"""Exact solutions of films of constant thickness that friction heats, without pressure differences."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError

STRESS_CREST = 1.1996786402577338
"""Solution of s tanh s = 1, at which the shear stress of a heated film is greatest."""


def adiabatic_couette(
    position: Array,
    *,
    film: float,
    speed: float,
    viscosity: float,
    temperature: float,
    temperature_coefficient: float,
    heat_per_volume: float,
) -> Array:
    """The temperature along a film between adiabatic walls whose viscosity is η = η0 exp(-β (T - T0)), K.

    The mean temperature obeys ρ c (u h/2) dT/dx = η u²/h, so that

        T = T0 + ln(1 + 2 β η0 u x/(ρ c h²))/β.

    Without pressure differences at the ends the pressure is zero, and the friction on x is ρ c h (T - T0)/2 per width.
    Exact for a uniform temperature across the film.

    Parameters
    ----------
    position : distances x from the inlet, m, at least 0, of any shape.
    film : thickness h, m.
    speed : speed u of the sliding wall, m/s.
    viscosity : viscosity η0 at the temperature of the inlet, Pa s.
    temperature : temperature T0 at the inlet, K.
    temperature_coefficient : temperature coefficient β of the viscosity, 1/K; 0 for a constant viscosity.
    heat_per_volume : heat capacity ρ c of a volume, J/(m³ K).

    Returns
    -------
    array of the shape of ``position``.

    Source: Vogelpohl 1949, VDI-Forschungsheft 425; Pinkus 1990, Thermal Aspects of Fluid Film Tribology.

    Examples
    --------
    >>> import numpy as np
    >>> liquid = {"viscosity": 0.05, "temperature": 313.0, "temperature_coefficient": 0.03, "heat_per_volume": 1.7e6}
    >>> adiabatic_couette(np.array([0.0, 0.1]), film=40e-6, speed=10.0, **liquid).round(3).tolist()
    [313.0, 337.778]
    """
    rise = 2 * viscosity * speed * np.asarray(position) / (heat_per_volume * film**2)
    if temperature_coefficient == 0:
        return temperature + rise
    return temperature + np.log1p(temperature_coefficient * rise) / temperature_coefficient


def conducting_couette(
    height: Array,
    *,
    film: float,
    speed: float,
    viscosity: float,
    conductivity: float,
    fixed: float | None,
    sliding: float | None,
    fixed_resistance: float = 0.0,
    sliding_resistance: float = 0.0,
) -> Array:
    """The temperature across a film of constant viscosity whose friction heat is conducted to its walls, K.

    k T'' = -η u²/h² with k T' = (T - T1)/R1 at the fixed wall, z = 0, and -k T' = (T - T2)/R2 at the sliding one, or
    T' = 0 at an adiabatic one. Walls at given temperatures have T = T1 + (T2 - T1) ζ + (η u²/(2 k)) ζ (1 - ζ), ζ = z/h,
    and an adiabatic fixed wall T = T2 + (η u²/(2 k)) (1 - ζ²).

    Parameters
    ----------
    height : distances z from the fixed wall, m, of any shape.
    film : thickness h, m.
    speed : speed u of the sliding wall, m/s.
    viscosity : viscosity η, Pa s.
    conductivity : thermal conductivity k, W/(m K).
    fixed, sliding : temperatures T1 and T2 at or behind the walls, K; None for an adiabatic wall.
    fixed_resistance, sliding_resistance : thermal resistances R1 and R2 of the walls, m² K/W; 0 for walls at T1 and T2.

    Returns
    -------
    array of the shape of ``height``.

    Raises
    ------
    InputError
        If both walls are adiabatic: no steady temperature exists.

    Source: Brinkman 1951, Applied Scientific Research A 2, 120-124; Bird, Stewart and Lightfoot 2002, Transport
    Phenomena, section 10.4.

    Examples
    --------
    >>> import numpy as np
    >>> film = {"film": 40e-6, "speed": 10.0, "viscosity": 0.05, "conductivity": 0.14}
    >>> conducting_couette(np.array([0.0, 20e-6, 40e-6]), **film, fixed=313.0, sliding=313.0).round(3).tolist()
    [313.0, 317.464, 313.0]
    """
    _one_wall_conducts(fixed, sliding)
    source = viscosity * (speed / film) ** 2
    if fixed is None:
        slope = 0.0
        low = sliding + source * film * (sliding_resistance + film / (2 * conductivity))  # type: ignore[operator]
    elif sliding is None:
        slope = source * film / conductivity
        low = fixed + source * film * fixed_resistance
    else:
        whole = film / conductivity + fixed_resistance + sliding_resistance
        flux = (sliding - fixed + source * film * (film / (2 * conductivity) + sliding_resistance)) / whole
        slope, low = flux / conductivity, fixed + flux * fixed_resistance
    z = np.asarray(height)
    return np.asarray(low + slope * z - source / (2 * conductivity) * z**2)


@dataclass(frozen=True, kw_only=True)
class HeatedCouette:
    """Solution of a film with conduction across it: temperatures, K, shear stress, Pa, and the greatest temperature."""

    temperature: Array
    stress: float
    temperature_max: float


def heated_couette(
    height: Array,
    *,
    film: float,
    speed: float,
    viscosity: float,
    reference: float,
    temperature_coefficient: float,
    conductivity: float,
    fixed: float | None,
    sliding: float | None,
) -> HeatedCouette:
    """The temperature across a film and its shear stress for η = η0 exp(-β (T - T0)) and conduction to the walls.

    The stress τ is uniform, k T'' = -τ²/η, and exp(β (T - T1)) = a/cosh²(A + (B - A) z/h) with a = cosh² A. With
    N² = β η1 u²/(2 k), η1 the viscosity at T1, and E = exp(β (T2 - T1)),

        sinh A = -(N + (E - 1)/N)/2,   √E sinh B = (N - (E - 1)/N)/2,   τ = √(2 k η1/(β a)) (B - A)/h.

    Walls of one temperature have T_max = T1 + ln(1 + Na/8)/β and τ = (η1 u/h) asinh(s)/(s √(1 + s²)), s² = Na/8 with
    the Nahme-Griffith number Na = β η1 u²/k. One adiabatic wall, where A or B is 0, takes Na/2 for Na/8. Each speed has
    one solution; a stress has two or none (:func:`speeds_at_stress`).

    Parameters
    ----------
    height : distances z from the fixed wall, m, of any shape.
    film : thickness h, m.
    speed : speed u of the sliding wall, m/s.
    viscosity : viscosity η0 at the temperature ``reference``, Pa s.
    reference : temperature T0, K.
    temperature_coefficient : temperature coefficient β of the viscosity, 1/K.
    conductivity : thermal conductivity k, W/(m K).
    fixed, sliding : temperatures T1 and T2 of the walls, K; None for an adiabatic wall.

    Raises
    ------
    InputError
        If both walls are adiabatic, or if speed and β are not above 0.

    Source: Nahme 1940, Ingenieur-Archiv 11, 191-209; Gavis and Laurence 1968, Industrial & Engineering Chemistry
    Fundamentals 7, 232-239.

    Examples
    --------
    >>> import numpy as np
    >>> liquid = {"viscosity": 0.05, "reference": 313.0, "temperature_coefficient": 0.03, "conductivity": 0.14}
    >>> heated = heated_couette(np.array([20e-6]), film=40e-6, speed=10.0, **liquid, fixed=313.0, sliding=313.0)
    >>> round(float(heated.temperature[0]), 3), round(heated.temperature_max, 3), round(heated.stress / 12500, 4)
    (317.19, 317.19, 0.9193)
    """
    _one_wall_conducts(fixed, sliding)
    for name, value in (("speed", speed), ("temperature_coefficient", temperature_coefficient)):
        if not value > 0:
            raise InputError(f"{name}: got {value!r}; it must be above 0")
    first = sliding if fixed is None else fixed
    assert first is not None
    at_wall = viscosity * math.exp(-temperature_coefficient * (first - reference))
    n = speed * math.sqrt(temperature_coefficient * at_wall / (2 * conductivity))
    if fixed is None or sliding is None:
        low, high = (0.0, math.asinh(n)) if fixed is None else (-math.asinh(n), 0.0)
        crest = math.hypot(1.0, n)  # cosh of the one that is not 0
    else:
        hotter = math.expm1(temperature_coefficient * (sliding - fixed))
        low = -math.asinh((n + hotter / n) / 2)
        high = math.asinh((n - hotter / n) / (2 * math.sqrt(1 + hotter)))
        crest = math.cosh(low)
    phase = low + (high - low) * np.asarray(height) / film
    top = first + 2 * math.log(crest) / temperature_coefficient
    hottest = top if low <= 0 <= high else max(t for t in (fixed, sliding) if t is not None)
    return HeatedCouette(
        temperature=np.asarray(top - 2 * np.log(np.cosh(phase)) / temperature_coefficient),
        stress=math.sqrt(2 * conductivity * at_wall / temperature_coefficient) * (high - low) / (film * crest),
        temperature_max=hottest,
    )


def speeds_at_stress(
    stress: float,
    *,
    film: float,
    viscosity: float,
    temperature_coefficient: float,
    conductivity: float,
    adiabatic_wall: bool = False,
) -> tuple[float, float]:
    """The two speeds, m/s, at which a film with conduction to its walls transmits one shear stress.

    With sinh² s = Na/8, or Na/2 with one adiabatic wall, the stress of :func:`heated_couette` is
    τ = (c/h) √(k η0/β) s/cosh s, c = √8 or √2. It is greatest at s tanh s = 1, which is a Nahme-Griffith number
    of 18.21 (4.55): c s/cosh s is 1.8745 (0.9373) there. It falls with the speed beyond.

    Parameters
    ----------
    stress : shear stress τ, Pa, above 0.
    film : thickness h, m.
    viscosity : viscosity η0 at the temperature of the walls, Pa s.
    temperature_coefficient : temperature coefficient β of the viscosity, 1/K.
    conductivity : thermal conductivity k, W/(m K).
    adiabatic_wall : whether one of the walls is adiabatic.

    Returns
    -------
    the speeds of the stable and of the falling branch.

    Raises
    ------
    InputError
        If the stress is not above 0, or above the largest one: no steady film exists.

    Source: Gavis and Laurence 1968, Industrial & Engineering Chemistry Fundamentals 7, 232-239.

    Examples
    --------
    >>> film = {"film": 40e-6, "viscosity": 0.05, "temperature_coefficient": 0.03, "conductivity": 0.14}
    >>> [round(speed, 3) for speed in speeds_at_stress(11491.2376, **film)]
    [10.0, 226.858]
    """
    factor = 1.0 if adiabatic_wall else 2.0
    unit = factor * math.sqrt(2 * conductivity * viscosity / temperature_coefficient) / film
    given, largest = stress / unit, STRESS_CREST / math.cosh(STRESS_CREST)
    if not 0 < given <= largest:
        raise InputError(f"stress: got {stress!r} Pa; it must be above 0 and at most {unit * largest!r} Pa")
    high = STRESS_CREST
    while high / math.cosh(high) > given:
        high *= 2
    scale = factor * math.sqrt(2 * conductivity / (temperature_coefficient * viscosity))

    def speed(low: float, high: float) -> float:
        s = brentq(lambda s: s / math.cosh(s) - given, low, high, xtol=1e-15, rtol=1e-14) if low < high else low
        return scale * math.sinh(s)

    return speed(0.0, STRESS_CREST), speed(STRESS_CREST, high)


def _one_wall_conducts(fixed: float | None, sliding: float | None) -> None:
    if fixed is None and sliding is None:
        raise InputError("fixed, sliding: got None and None; one wall must have a temperature, as no heat leaves")
