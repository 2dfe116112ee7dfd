"""A pad of finite width whose lubricant heats, by spectral collocation: a second method without code of the models.

Pressure and temperature are polynomials in Chebyshev points. The Reynolds equation is collocated in the plane; the
energy equation between walls that take no heat is integrated along the sliding direction for all points across, by a
Runge-Kutta method of order 8. Both alternate until the temperature stays. The film must narrow, so that it is full and
all lubricant flows onwards.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError

CHANGE, ITERATIONS = 1e-7, 60
"""Change of the temperature, K, at which the iteration stops, and its largest number of steps."""


@dataclass(frozen=True, kw_only=True)
class HotPad:
    """A pad at zero pressure around it, and its lubricant.

    Attributes
    ----------
    length, width : sizes, m.
    film : film(x), the film thickness at distances from the inlet, m.
    speed : sliding speed, m/s.
    viscosity, thinning : η₀, Pa s, and β, 1/K, of η₀ exp(-β (T - T₀)), where T₀ is the temperature at the inlet.
    capacity : ρ c, J/(m³ K).
    """

    length: float
    width: float
    film: Callable[[Array], Array]
    speed: float
    viscosity: float
    thinning: float
    capacity: float


@dataclass(frozen=True, kw_only=True)
class HotFilm:
    """A film that heats.

    Attributes
    ----------
    x : points along, m.
    pressure_per_length : pressure integrated over the width at these points, N/m.
    load, friction : integral of the pressure, and force on the sliding wall, N.
    inlet_flow, side_leakage : flow in at the inlet, and out of both sides, m³/s.
    rise : largest rise of the temperature, K.
    """

    x: Array
    pressure_per_length: Array
    load: float
    friction: float
    inlet_flow: float
    side_leakage: float
    rise: float


@dataclass(frozen=True, kw_only=True)
class _Points:
    """Chebyshev points from 0 to a length, the matrix of the derivative at them, and the weights of the integral."""

    places: Array
    derivative: Array
    weights: Array


def _points(count: int, length: float) -> _Points:
    places = -np.cos(math.pi * np.arange(count) / (count - 1))
    ends = _signs(count, 2.0)
    derivative = np.outer(ends, 1 / ends) / (places[:, None] - places + np.eye(count))
    derivative -= np.diag(derivative.sum(axis=1))
    moments = np.array([0.0 if k % 2 else 2 / (1 - k * k) for k in range(count)])
    weights = np.linalg.solve(np.cos(np.outer(np.arange(count), np.arccos(places))), moments)
    return _Points(places=(places + 1) * length / 2, derivative=derivative * 2 / length, weights=weights * length / 2)


def _signs(count: int, at_ends: float) -> Array:
    """Alternating signs, times a factor at both ends."""
    signs = (-1.0) ** np.arange(count)
    signs[[0, -1]] *= at_ends
    return np.asarray(signs)


def hot_film(pad: HotPad, count: int) -> HotFilm:
    """The film of a pad on ``count`` points along and across.

    Raises
    ------
    ConvergenceError
        If the temperatures do not converge.
    """
    along, across = _points(count, pad.length), _points(count, pad.width)
    film, one = pad.film(along.places)[:, None] * np.ones(count), np.eye(count)
    inner = np.zeros(film.shape, dtype=bool)
    inner[1:-1, 1:-1] = True
    inside = inner.ravel()
    to_x, to_y = np.kron(along.derivative, one), np.kron(one, across.derivative)
    carried = pad.speed * film / 2
    rise, change = np.zeros(film.shape), math.inf
    for _ in range(ITERATIONS):
        eta = pad.viscosity * np.exp(-pad.thinning * rise)
        mobility = film**3 / (12 * eta)
        at_points = mobility.reshape(-1, 1)
        reynolds = to_x @ (at_points * to_x) + to_y @ (at_points * to_y)
        pressure = np.zeros(film.size)
        pressure[inside] = np.linalg.solve(reynolds[np.ix_(inside, inside)], (to_x @ carried.ravel())[inside])
        slope_x, slope_y = (to_x @ pressure).reshape(film.shape), (to_y @ pressure).reshape(film.shape)
        flow_x, flow_y = carried - mobility * slope_x, -mobility * slope_y
        power = eta * pad.speed**2 / film + mobility * (slope_x**2 + slope_y**2)
        following = _rise(along.places, across.derivative, power / (pad.capacity * flow_x), flow_y / flow_x)
        change, rise = float(np.abs(following - rise).max()), following
        if change < CHANGE:
            break
    else:
        raise ConvergenceError(f"temperature: changes by {change:.1e} K after {ITERATIONS} films")
    stress = eta * pad.speed / film + film / 2 * slope_x
    pressures = pressure.reshape(film.shape)
    return HotFilm(
        x=along.places,
        pressure_per_length=pressures @ across.weights,
        load=float(along.weights @ pressures @ across.weights),
        friction=float(along.weights @ stress @ across.weights),
        inlet_flow=float(flow_x[0] @ across.weights),
        side_leakage=float(along.weights @ (flow_y[:, -1] - flow_y[:, 0])),
        rise=float(rise.max()),
    )


def force(film: HotFilm, pad: HotPad, side: Callable[[Array], Array]) -> float:
    """The integral of the pressure times side(x), N."""
    return float(_points(film.x.size, pad.length).weights @ (side(film.x) * film.pressure_per_length))


def _rise(x: Array, across: Array, heating: Array, drift: Array) -> Array:
    """The solution of ∂T/∂x + (q_y/q_x) ∂T/∂y = P/(ρ c q_x) with T = 0 at the inlet, at the points.

    The fields ``heating``, the right-hand side, and ``drift``, q_y/q_x, are interpolated along.
    """
    ends = _signs(x.size, 0.5)

    def at(values: Array, place: float) -> Array:
        difference = place - x
        nearest = int(np.argmin(np.abs(difference)))
        if abs(difference[nearest]) < 1e-12 * x[-1]:
            return np.asarray(values[nearest])
        weights = ends / difference
        return np.asarray(weights @ values / weights.sum())

    def slopes(place: float, now: Array) -> Array:
        return at(heating, place) - at(drift, place) * (across @ now)

    found = solve_ivp(slopes, (0.0, float(x[-1])), np.zeros(x.size), method="DOP853", t_eval=x, rtol=1e-8, atol=1e-8)
    return np.asarray(found.y.T)
