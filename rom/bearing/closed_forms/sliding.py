"""Closed-form solutions of infinitely wide films of constant density on a wall that slides."""

import math
from dataclasses import dataclass

from roughfilm.contact.foundation.errors import InputError

SMALL_FALL = 1e-2
"""Fall of the film over the film at the outlet below which a series gives the centre of pressure."""


@dataclass(frozen=True, kw_only=True)
class SliderSolution:
    """Solution of a slider bearing: load, N/m, maximum pressure, Pa, and friction on the sliding wall, N/m."""

    load: float
    pressure_max: float
    friction: float


def linear_slider(*, film: float, rise: float, length: float, speed: float, viscosity: float) -> SliderSolution:
    """The solution of a film that narrows linearly from film + rise to film, with zero pressure at both ends.

    With a = 1 + rise/film: W = 6 η u L²/(h² (a-1)²) (ln a - 2 (a-1)/(a+1)), the maximum pressure is
    3 η u L (a-1)/(2 h² a (a+1)), and F = η u L/(h (a-1)) (4 ln a - 6 (a-1)/(a+1)).

    Parameters
    ----------
    film : thickness at the outlet, m.
    rise : thickness at the inlet minus that at the outlet, m.
    length : length along the sliding direction, m.
    speed : speed of the flat wall towards the outlet, m/s.
    viscosity : viscosity, Pa s.

    Raises
    ------
    InputError
        If the film does not narrow (``rise`` is not above 0).

    Source: Reynolds 1886, doi:10.1098/rstl.1886.0005.
    """
    if rise <= 0:
        raise InputError(f"rise: got {rise!r} m; it must be above 0")
    fall = rise / film
    ratio = 1 + fall
    logarithm, fraction = math.log1p(fall), fall / (2 + fall)
    return SliderSolution(
        load=6 * viscosity * speed * (length / rise) ** 2 * (logarithm - 2 * fraction),
        pressure_max=3 * viscosity * speed * length / film**2 * fall / (2 * ratio * (ratio + 1)),
        friction=viscosity * speed * length / rise * (4 * logarithm - 6 * fraction),
    )


def centre_of_pressure(ratio: float) -> float:
    """The distance of the centre of pressure of an infinitely wide flat pad from its inlet, over the length.

    A pad that tilts freely takes the ratio a of its films at the inlet and the outlet at which its pivot is there:

        x/L = ((a² + 2a) ln a - (a - 1) (5a + 1)/2)/((a² - 1) ln a - 2 (a - 1)²),

    which grows from 1/2 at a = 1 to 1.

    Parameters
    ----------
    ratio : film thickness at the inlet over that at the outlet, above 1.

    Raises
    ------
    InputError
        If the film does not narrow.

    Source: Raimondi and Boyd 1955, Transactions of the ASME 77, 321-330; Michell 1905, Zeitschrift für Mathematik und
    Physik 52, 123-137.
    """
    if ratio <= 1:
        raise InputError(f"ratio: got {ratio!r}; it must be above 1")
    fall = ratio - 1
    if fall < SMALL_FALL:  # the terms of the formula cancel
        return 0.5 + fall / 10 - fall**2 / 20 + 11 * fall**3 / 350
    logarithm = math.log1p(fall)
    moment = ratio * (ratio + 2) * logarithm - fall * (5 * ratio + 1) / 2
    return moment / ((ratio + 1) * fall * logarithm - 2 * fall**2)


def rayleigh_step(
    *, film: float, rise: float, length: float, step: float, speed: float, viscosity: float
) -> SliderSolution:
    """The solution of a film with one step, with zero pressure at both ends.

    The pressure at the step is p = 6 η u rise/((film + rise)³/step + film³/(L - step)), the load W = p L/2, and the
    friction F = η u (step/(film + rise) + (L - step)/film) + p rise/2.

    Parameters
    ----------
    film : thickness behind the step, m.
    rise : height of the step, m.
    length : length along the sliding direction, m.
    step : distance of the step from the inlet, m.
    speed : speed of the flat wall towards the outlet, m/s.
    viscosity : viscosity, Pa s.

    Raises
    ------
    InputError
        If the step does not lie between inlet and outlet.

    Source: Rayleigh 1918, doi:10.1080/14786441808635730.
    """
    if not 0 < step < length:
        raise InputError(f"step: got {step!r} m; it must lie between 0 and the length, {length!r} m")
    before, behind = film + rise, length - step
    pressure = 6 * viscosity * speed * rise / (before**3 / step + film**3 / behind)
    drag = viscosity * speed * (step / before + behind / film)
    return SliderSolution(load=pressure * length / 2, pressure_max=pressure, friction=drag + pressure * rise / 2)


def barus_pressure(reduced: float, coefficient: float) -> float:
    """The pressure p, Pa, of a film with η = η0 exp(α p), from the reduced pressure: (1 - exp(-α p))/α = ``reduced``.

    Valid for films of any shape with constant density and p = 0 at the ends.

    Parameters
    ----------
    reduced : pressure of the same film with the constant viscosity η0, Pa.
    coefficient : pressure coefficient α, 1/Pa, at least 0.

    Raises
    ------
    InputError
        If α times ``reduced`` is 1 or more: no solution exists.

    Source: Barus 1893 for the viscosity; Cameron 1966, Principles of Lubrication, for the reduced pressure.
    """
    if coefficient == 0:
        return reduced
    if coefficient * reduced >= 1:
        raise InputError(f"reduced: got {reduced!r} Pa; it must be below 1/α = {1 / coefficient!r} Pa")
    return -math.log1p(-coefficient * reduced) / coefficient
