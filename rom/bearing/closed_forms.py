"""Films whose pressure is known in closed form: infinitely wide, of constant density."""

import math
from dataclasses import dataclass

from roughfilm.contact.foundation.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Slider:
    """What a slider carries: load, N/m, greatest pressure, Pa, and friction on the sliding wall, N/m."""

    load: float
    pressure_max: float
    friction: float


def linear_slider(*, film: float, rise: float, length: float, speed: float, viscosity: float) -> Slider:
    """A film that falls evenly from film + rise to film, without pressure at both ends.

    With a = 1 + rise/film: W = 6 η u L²/(h² (a-1)²) (ln a - 2 (a-1)/(a+1)), p = 3 η u L (a-1)/(2 h² a (a+1)) at most,
    F = η u L/(h (a-1)) (4 ln a - 6 (a-1)/(a+1)).

    Parameters
    ----------
    film, rise, length : m; ``film`` is at the outlet.
    speed : of the flat wall towards the outlet, m/s.
    viscosity : Pa s.

    Raises
    ------
    InputError
        If the film does not narrow: the formulas have no limit there that could be computed.

    Source: Reynolds 1886, doi:10.1098/rstl.1886.0005.
    """
    if rise <= 0:
        raise InputError(f"rise: got {rise!r} m; it must be above 0")
    fall = rise / film
    ratio = 1 + fall
    logarithm, part = math.log1p(fall), fall / (2 + fall)
    return Slider(
        load=6 * viscosity * speed * (length / rise) ** 2 * (logarithm - 2 * part),
        pressure_max=3 * viscosity * speed * length / film**2 * fall / (2 * ratio * (ratio + 1)),
        friction=viscosity * speed * length / rise * (4 * logarithm - 6 * part),
    )


def rayleigh_step(*, film: float, rise: float, length: float, step: float, speed: float, viscosity: float) -> Slider:
    """A film of film + rise up to ``step`` from the inlet, of film behind it, without pressure at both ends.

    p = 6 η u rise/((film + rise)³/step + film³/(L - step)) at the step, W = p L/2; both parts' drag less what the
    pressure pushes, F = η u (step/(film + rise) + (L - step)/film) + p rise/2.

    Parameters
    ----------
    film, rise, length, step : m.
    speed : of the flat wall towards the outlet, m/s.
    viscosity : Pa s.

    Raises
    ------
    InputError
        If the step is not inside the length.

    Source: Rayleigh 1918, doi:10.1080/14786441808635730.
    """
    if not 0 < step < length:
        raise InputError(f"step: got {step!r} m; it must lie between 0 and the length, {length!r} m")
    before, behind = film + rise, length - step
    pressure = 6 * viscosity * speed * rise / (before**3 / step + film**3 / behind)
    drag = viscosity * speed * (step / before + behind / film)
    return Slider(load=pressure * length / 2, pressure_max=pressure, friction=drag + pressure * rise / 2)


@dataclass(frozen=True, kw_only=True)
class Bush:
    """What a journal bearing carries: load, N/m, and the angle from the narrowest place to the load line, degrees."""

    load: float
    attitude_angle: float


def sommerfeld(*, radius: float, clearance: float, eccentricity: float, speed: float, viscosity: float) -> Bush:
    """A full journal bearing whose film bears any tension: W = 12 π η u (R/c)² ε/((2 + ε²) √(1 - ε²)), at 90°.

    Parameters
    ----------
    radius, clearance : m.
    eccentricity : ε, 0 <= ε < 1.
    speed : of the surface of the shaft, m/s.
    viscosity : Pa s.

    Raises
    ------
    InputError
        If the shaft touches the bush.

    Source: Sommerfeld 1904, Zeitschrift für Mathematik und Physik 50, 97-155.
    """
    if not 0 <= eccentricity < 1:
        raise InputError(f"eccentricity: got {eccentricity!r}; it must be 0 or more and below 1")
    below = (2 + eccentricity**2) * math.sqrt(1 - eccentricity**2)
    load = 12 * math.pi * viscosity * speed * (radius / clearance) ** 2 * eccentricity / below
    return Bush(load=load, attitude_angle=90.0)


def barus_pressure(reduced: float, coefficient: float) -> float:
    """The pressure p, Pa, of a film with η = η0 exp(α p), from the one with η0: (1 - exp(-α p))/α = ``reduced``.

    Wherever the film is and whatever its shape, as long as its density is constant; the ends are at p = 0.

    Parameters
    ----------
    reduced : what the film would have with η0, Pa.
    coefficient : α, 1/Pa, at least 0.

    Raises
    ------
    InputError
        If α times ``reduced`` is 1 or more, where no pressure exists.

    Source: Barus 1893 for the viscosity; Cameron 1966, Principles of Lubrication, for the reduced pressure.
    """
    if coefficient == 0:
        return reduced
    if coefficient * reduced >= 1:
        raise InputError(f"reduced: got {reduced!r} Pa; it must be below 1/α = {1 / coefficient!r} Pa")
    return -math.log1p(-coefficient * reduced) / coefficient
