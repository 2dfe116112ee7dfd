"""Exact solutions of heat conduction into a stream of fluid and into a wall that slides."""

import math

import numpy as np
from scipy.special import erfc, gamma, gammainc

from roughfilm.contact.foundation.arrays import Array

TERMS = 400
"""Number of terms of the series of a plug flow; the rest is below 1e-6 of T0 - T1 from x = 1e-5 ρ c u h²/k on."""


def plug_flow(
    position: Array,
    height: Array,
    *,
    film: float,
    speed: float,
    diffusivity: float,
    inlet: float,
    fixed: float,
    sliding: float,
) -> Array:
    """The temperature of a slab of fluid that moves as a rod between two walls at given temperatures, K.

    u ∂T/∂x = κ ∂²T/∂z² with T = T0 at x = 0, T = T1 at z = 0 and T = T2 at z = h:

        T = T1 + (T2 - T1) ζ + Σ b_n sin(n π ζ) exp(-n² π² κ x/(u h²)),
        b_n = 2 ((T0 - T1) - (-1)^n (T0 - T2))/(n π),   ζ = z/h,

    with 400 terms. Without friction heat and without conduction along x.

    Parameters
    ----------
    position : distances x from the inlet, m, above 0.
    height : distances z from the first wall, m; with ``position`` broadcast to one shape.
    film : thickness h of the slab, m.
    speed : speed u of the slab, m/s.
    diffusivity : thermal diffusivity κ = k/(ρ c), m²/s.
    inlet : temperature T0 at the inlet, K.
    fixed, sliding : temperatures T1 at z = 0 and T2 at z = h, K.

    Returns
    -------
    array of the shape of both.

    Source: Carslaw and Jaeger 1959, Conduction of Heat in Solids, section 3.4.

    Examples
    --------
    >>> import numpy as np
    >>> x, rod = np.array([0.02]), {"film": 1e-4, "speed": 1.0, "diffusivity": 8e-8, "fixed": 353.0, "sliding": 353.0}
    >>> round(float(plug_flow(x, np.array([5e-5]), **rod, inlet=313.0)[0]), 2)
    342.5
    >>> round(float(plug_flow_mean(x, **rod, inlet=313.0)[0]), 2)
    346.32
    """
    x, zeta = np.broadcast_arrays(position, np.asarray(height) / film)
    temperature = fixed + (sliding - fixed) * zeta
    for n in range(1, TERMS + 1):
        size = 2 * ((inlet - fixed) - (-1) ** n * (inlet - sliding)) / (n * math.pi)
        temperature = temperature + size * np.sin(n * math.pi * zeta) * _decay(n, x, film, speed, diffusivity)
    return np.asarray(temperature)


def plug_flow_mean(
    position: Array,
    *,
    film: float,
    speed: float,
    diffusivity: float,
    inlet: float,
    fixed: float,
    sliding: float,
) -> Array:
    """The mean temperature across the slab of :func:`plug_flow`, K, of the shape of ``position``.

    T = (T1 + T2)/2 + (T0 - (T1 + T2)/2) Σ 8/(n² π²) exp(-n² π² κ x/(u h²)) over odd n.

    Source: Carslaw and Jaeger 1959, Conduction of Heat in Solids, section 3.4.
    """
    x = np.asarray(position)
    last = (fixed + sliding) / 2
    sums = sum(8 / (n * math.pi) ** 2 * _decay(n, x, film, speed, diffusivity) for n in range(1, TERMS + 1, 2))
    return np.asarray(last + (inlet - last) * sums)


def _decay(n: int, position: Array, film: float, speed: float, diffusivity: float) -> Array:
    return np.exp(-((n * math.pi / film) ** 2) * diffusivity * position / speed)


def heated_shear_flow(
    position: Array, height: Array, *, shear_rate: float, diffusivity: float, inlet: float, wall: float
) -> Array:
    """The temperature of a shear flow along a wall whose temperature steps at x = 0, K.

    γ z ∂T/∂x = κ ∂²T/∂z² has the solution T = T_w + (T0 - T_w) P(1/3, γ z³/(9 κ x)) with the regularized incomplete
    gamma function P. The heat flux into the fluid is k (T_w - T0) (γ/(9 κ x))^(1/3)/Γ(4/3). It holds for a
    Couette film near its fixed wall, as long as heat has not reached the other wall: κ x well below γ h³/9.

    Parameters
    ----------
    position : distances x from the step, m, above 0.
    height : distances z from the wall, m; with ``position`` broadcast to one shape.
    shear_rate : shear rate γ at the wall, 1/s.
    diffusivity : thermal diffusivity κ = k/(ρ c), m²/s.
    inlet, wall : temperatures T0 of the fluid that arrives and T_w of the wall behind the step, K.

    Returns
    -------
    array of the shape of both.

    Source: Lévêque 1928, Annales des Mines 13, 201-299.

    Examples
    --------
    >>> import numpy as np
    >>> flow = {"shear_rate": 2.5e5, "diffusivity": 8e-8, "inlet": 313.0, "wall": 353.0}
    >>> heated_shear_flow(np.array([0.01]), np.array([0.0, 10e-6, 40e-6]), **flow).round(2).tolist()
    [353.0, 338.51, 313.77]
    """
    x, z = np.broadcast_arrays(position, height)
    return np.asarray(wall + (inlet - wall) * gammainc(1 / 3, shear_rate * z**3 / (9 * diffusivity * x)))


def heated_shear_flux(
    position: Array, *, shear_rate: float, conductivity: float, diffusivity: float, inlet: float, wall: float
) -> Array:
    """The heat flux from the wall into the flow of :func:`heated_shear_flow`, W/m², of the shape of ``position``.

    q = k (T_w - T0) (γ/(9 κ x))^(1/3)/Γ(4/3), which is infinite at x = 0; exact in the range of that flow.

    Parameters
    ----------
    position : distances x from the step of the temperature, m, above 0, of any shape.
    shear_rate : shear rate γ at the wall, 1/s.
    conductivity : thermal conductivity k, W/(m K).
    diffusivity : thermal diffusivity κ, m²/s.
    inlet, wall : temperatures T0 of the fluid that arrives and T_w of the wall, K.

    Source: Lévêque 1928, Annales des Mines 13, 201-299.
    """
    gradient = (shear_rate / (9 * diffusivity * np.asarray(position))) ** (1 / 3) / gamma(4 / 3)
    return np.asarray(conductivity * (wall - inlet) * gradient)


def moving_half_space(
    position: Array,
    depth: Array,
    *,
    flux: float,
    length: float,
    speed: float,
    conductivity: float,
    heat_per_volume: float,
) -> Array:
    """The temperature rise of a half-space that slides past a source of uniform heat flux, 0 < x < L, K.

    Each point was heated for the time t = x/u: at the depth z,

        ΔT = (q/k) i(t, z),  i = 2 √(κ t/π) exp(-z²/(4 κ t)) - z erfc(z/(2 √(κ t))),

    minus i(t - L/u, z) behind the source, and ΔT = 2 q √(x/(π k ρ c u)) at its surface. Without conduction along x: for
    a large Péclet number u L/κ.

    Parameters
    ----------
    position : distances x from the leading edge of the source, m; the rise is 0 for x <= 0.
    depth : depths z, m, at least 0; with ``position`` broadcast to one shape.
    flux : heat flux q into the half-space, W/m².
    length : length L of the source along the sliding direction, m.
    speed : speed u of the half-space, m/s.
    conductivity : thermal conductivity k of the half-space, W/(m K).
    heat_per_volume : heat capacity ρ c of a volume of it, J/(m³ K).

    Returns
    -------
    array of the shape of both.

    Source: Carslaw and Jaeger 1959, Conduction of Heat in Solids, section 2.9.

    Examples
    --------
    >>> import numpy as np
    >>> steel = {"conductivity": 46.0, "heat_per_volume": 3.6e6}
    >>> wall = moving_half_space(np.array([0.1, 0.2]), np.array([0.0]), flux=1e5, length=0.1, speed=10.0, **steel)
    >>> wall.round(4).tolist()
    [0.8768, 0.3632]
    """
    x, z = np.broadcast_arrays(np.asarray(position, dtype=float), depth)

    def heated_for(distance: Array) -> Array:
        reach = 2 * np.sqrt(conductivity / heat_per_volume * np.maximum(distance, 0.0) / speed)
        safe = np.where(reach > 0, reach, 1.0)
        rise = reach / math.sqrt(math.pi) * np.exp(-((z / safe) ** 2)) - z * erfc(z / safe)
        return np.where(reach > 0, rise, 0.0)

    return np.asarray(flux / conductivity * (heated_for(x) - heated_for(x - length)))
