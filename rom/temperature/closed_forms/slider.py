"""Exact solutions of an infinitely wide, linearly narrowing film between adiabatic walls."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError

NODES, WEIGHTS = np.polynomial.legendre.leggauss(80)
"""Gauss-Legendre points and weights on (-1, 1); the integrands are smooth in ln h."""


@dataclass(frozen=True, kw_only=True)
class AdiabaticSlider:
    """Solution of a slider between adiabatic walls.

    Attributes
    ----------
    load : load W, N/m.
    friction : friction F on the sliding wall, N/m.
    flow : volume flow q, m²/s.
    outlet_temperature : temperature at the outlet, K; F u = ρ c q (T - T0) there.
    """

    load: float
    friction: float
    flow: float
    outlet_temperature: float


def adiabatic_slider(
    *,
    film: float,
    rise: float,
    length: float,
    speed: float,
    viscosity: float,
    temperature: float,
    temperature_coefficient: float,
    heat_per_volume: float,
) -> AdiabaticSlider:
    """The solution of a film that narrows linearly from film + rise to film and whose friction heats it.

    The temperature is uniform across the film, η = η0 exp(-β (T - T0)), and the pressure is zero at both ends. The mean
    temperature obeys ρ c q dT/dx = η g with g = u²/h + 12 (u h/2 - q)²/h³ (Couette and Poiseuille flow), so that

        exp(β (T - T0)) = 1 + β η0/(ρ c q) ∫ g dx,   ∫ g dx = (L/rise) [4 u² ln(h1/h) - 12 u q/h + 6 q²/h²],

    the bracket taken between h1 and h.

    The flow q is the one at which ∫ 12 η (u h/2 - q)/h³ dx = 0; W = -∫ x p' dx and F = ∫ (η u/h + h p'/2) dx. The
    integrals are taken by Gauss-Legendre quadrature in ln h, to about 1e-13 for β (T - T0) of at most 5.

    Parameters
    ----------
    film : thickness at the outlet, m.
    rise : thickness h1 at the inlet minus that at the outlet, m.
    length : length L along the sliding direction, m.
    speed : speed u of the flat wall towards the outlet, m/s.
    viscosity : viscosity η0 at the temperature of the inlet, Pa s.
    temperature : temperature T0 at the inlet, K.
    temperature_coefficient : temperature coefficient β of the viscosity, 1/K; 0 for a constant viscosity.
    heat_per_volume : heat capacity ρ c of a volume, J/(m³ K).

    Raises
    ------
    InputError
        If the film does not narrow (``rise`` is not above 0).

    Source: Cope 1949, Proceedings of the Royal Society A 197, 201-217, for the equation of the mean
    temperature; Cameron 1966, Principles of Lubrication, for the adiabatic pad.

    Examples
    --------
    >>> pad = {"film": 40e-6, "rise": 40e-6, "length": 0.1, "speed": 10.0}
    >>> liquid = {"viscosity": 0.05, "temperature": 313.0, "temperature_coefficient": 0.03, "heat_per_volume": 1.7e6}
    >>> heated = adiabatic_slider(**pad, **liquid)
    >>> round(heated.load / 1e3, 2), round(heated.friction, 1), round(heated.outlet_temperature, 2)
    (396.27, 751.7, 329.16)
    """
    wedge = _Wedge(film=film, rise=rise, length=length, speed=speed)

    def viscosities(flow: float) -> Array:
        heating = temperature_coefficient * viscosity / (heat_per_volume * flow)
        return np.asarray(viscosity / (1 + heating * wedge.heated(wedge.thickness, flow)))

    def fall_of_pressure(flow: float) -> float:
        return wedge.integral(viscosities(flow) * (speed * wedge.thickness / 2 - flow) / wedge.thickness**3)

    low, high = speed * film / 2, speed * (film + rise) / 2  # between the flows dragged at the outlet and at the inlet
    flow = float(brentq(fall_of_pressure, low, high, xtol=1e-15 * high, rtol=1e-14))
    eta = viscosities(flow)
    load, friction = wedge.forces(eta * 12 * (speed * wedge.thickness / 2 - flow) / wedge.thickness**3, eta)
    heat = viscosity * float(wedge.heated(np.array(film), flow)) / (heat_per_volume * flow)
    return AdiabaticSlider(
        load=load,
        friction=friction,
        flow=flow,
        outlet_temperature=temperature + _over(temperature_coefficient, heat),
    )


@dataclass(frozen=True, kw_only=True)
class SlightlyHeatedSlider:
    """The first change of a slider by heating, in the number A = β η0 u L/(ρ c h²), h the film at the outlet.

    Attributes
    ----------
    number : A; the results are right to terms of A².
    load_change, friction_change, flow_change : relative changes of load, friction and flow.
    outlet_rise : temperature at the outlet above that at the inlet, K, with the viscosity of the inlet.
    """

    number: float
    load_change: float
    friction_change: float
    flow_change: float
    outlet_rise: float


def slightly_heated_slider(
    *,
    film: float,
    rise: float,
    length: float,
    speed: float,
    viscosity: float,
    temperature_coefficient: float,
    heat_per_volume: float,
) -> SlightlyHeatedSlider:
    """The first-order changes of :func:`adiabatic_slider` by its heating, from the solution of constant viscosity.

    With q0 = u h h1/(h + h1) of the outlet film h and the inlet film h1, the temperature rises by
    T1 = η0/(ρ c q0) ∫ g dx at constant viscosity, and η1 = -β η0 T1 changes

        q1 = ∫ η1 (u h/2 - q0)/h³ dx/(η0 ∫ dx/h³),   p1' = 12 (η1 (u h/2 - q0) - η0 q1)/h³.

    It holds for any viscosity law whose slope is -β η0 at the inlet.

    Parameters
    ----------
    film : thickness at the outlet, m.
    rise : thickness at the inlet minus that at the outlet, m.
    length : length L along the sliding direction, m.
    speed : speed u of the flat wall towards the outlet, m/s.
    viscosity : viscosity η0 at the temperature of the inlet, Pa s.
    temperature_coefficient : temperature coefficient β = -(dη/dT)/η0 at the inlet, 1/K.
    heat_per_volume : heat capacity ρ c of a volume, J/(m³ K).

    Raises
    ------
    InputError
        If the film does not narrow (``rise`` is not above 0).

    Examples
    --------
    >>> pad = {"film": 40e-6, "rise": 40e-6, "length": 0.1, "speed": 10.0}
    >>> liquid = {"viscosity": 0.05, "temperature_coefficient": 0.001, "heat_per_volume": 1.7e6}
    >>> heated = slightly_heated_slider(**pad, **liquid)
    >>> round(heated.number, 4), round(heated.load_change, 4), round(heated.friction_change, 4)
    (0.0184, -0.0094, -0.0107)
    """
    wedge = _Wedge(film=film, rise=rise, length=length, speed=speed)
    h = wedge.thickness
    flow = speed * film * (film + rise) / (2 * film + rise)
    dragged = speed * h / 2 - flow
    heating = viscosity / (heat_per_volume * flow)
    changed = -temperature_coefficient * viscosity * heating * wedge.heated(h, flow)
    flow_change = wedge.integral(changed * dragged / h**3) / (viscosity * wedge.integral(h**-3))
    load, friction = wedge.forces(12 * viscosity * dragged / h**3, np.full_like(h, viscosity))
    load_change, friction_change = wedge.forces(12 * (changed * dragged - viscosity * flow_change) / h**3, changed)
    return SlightlyHeatedSlider(
        number=temperature_coefficient * viscosity * speed * length / (heat_per_volume * film**2),
        load_change=load_change / load,
        friction_change=friction_change / friction,
        flow_change=flow_change / flow,
        outlet_rise=heating * float(wedge.heated(np.array(film), flow)),
    )


def _over(coefficient: float, heat: float) -> float:
    """ln(1 + β T)/β of the rise T at constant viscosity."""
    return heat if coefficient == 0 else math.log1p(coefficient * heat) / coefficient


class _Wedge:
    """The quadrature points in ln h of a film that narrows linearly, and its integrals over x."""

    def __init__(self, *, film: float, rise: float, length: float, speed: float) -> None:
        if rise <= 0:
            raise InputError(f"rise: got {rise!r} m; it must be above 0")
        self.speed, self.inlet, self.stretch = speed, film + rise, length / rise
        half = math.log1p(rise / film) / 2
        self.thickness: Array = film * np.exp(half * (1 + NODES))
        self.weights: Array = WEIGHTS * half * self.thickness * self.stretch

    def integral(self, values: Array) -> float:
        """∫ values dx."""
        return float(self.weights @ values)

    def heated(self, thickness: Array, flow: float) -> Array:
        """∫ u²/h + 12 (u h/2 - q)²/h³ dx from the inlet to a thickness."""
        return self.stretch * (self._primitive(thickness, flow) - self._primitive(np.array(self.inlet), flow))

    def _primitive(self, thickness: Array, flow: float) -> Array:
        ratio = flow / thickness
        return 4 * self.speed**2 * np.log(self.inlet / thickness) + 6 * ratio * (ratio - 2 * self.speed)

    def forces(self, slope: Array, viscosity: Array) -> tuple[float, float]:
        """Load and friction on the sliding wall, N/m, of a pressure slope, Pa/m, and viscosities."""
        x = (self.inlet - self.thickness) * self.stretch
        h = self.thickness
        return -self.integral(x * slope), self.integral(viscosity * self.speed / h + h * slope / 2)
