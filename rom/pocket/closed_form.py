r"""Closed forms of the flow in a thin film between a fixed and a sliding wall.

Units are the film thickness Ly, the sliding speed u and the viscous stress η u / Ly. Across a film of thickness h, with
Y = 0 on the fixed wall and Y = 1 on the sliding one, the velocity is

    u(Y) = Y + 6 a Y (1 - Y),    a = q / h - 1/2,

for the volume flow q per width. It is exact for parallel walls, and first-order accurate in slope otherwise.
Source: Reynolds 1886, doi:10.1098/rstl.1886.0005.
"""

import numpy as np

from roughfilm.contact.foundation.arrays import Array


def excess_flow(h: Array, q: float) -> Array:
    """The mean velocity minus that of pure shear, a = q/h - 1/2; shape of ``h``."""
    return np.asarray(q / h - 0.5)


def pressure_gradient(h: Array, q: float) -> Array:
    """The pressure gradient dp/dx = 12 (h/2 - q) / h³ of the Reynolds equation; shape of ``h``."""
    return np.asarray((6 - 12 * q / h) / h**2)


def inertia_pressure(h: Array, q: float) -> Array:
    """The pressure that first-order inertia adds, per Reynolds number; shape of ``h``.

    The x-momentum weighted with Y(1-Y), which removes the unknown first-order profile, gives

        dp/dx = 6/h² - 12 q/h³ - (6 Re/h) N,    N = h' [-(q/h)(1/10 + 36a/140) + 1/60 - a/70].

    The last term has the factor h', so its integral is a function of h alone, zero at h = 1:

        p = -6 Re [ c0 ln h + c1 (1 - 1/h) + c2 (1 - 1/h²)/2 ],   c0 = 1/60 + 1/140,
                                                                  c1 = -q (1/10 - 18/140 + 1/70), c2 = -36 q²/140.

    It is periodic, so first-order inertia changes neither the flow nor the friction. The result is exact to first order
    in Re and to lowest order in slope.
    """
    c0 = 1 / 60 + 1 / 140
    c1 = -q * (1 / 10 - 18 / 140 + 1 / 70)
    c2 = -36 * q**2 / 140
    return np.asarray(-6 * (c0 * np.log(h) + c1 * (1 - 1 / h) + c2 * (1 - 1 / h**2) / 2))


def inertia_pressure_gradient(h: Array, slope: Array, q: float) -> Array:
    """The gradient -(6/h) N of :func:`inertia_pressure` for a film of slope dh/dx; shape of ``h``."""
    a = excess_flow(h, q)
    return np.asarray(-6 / h * slope * (-(q / h) * (1 / 10 + 36 * a / 140) + 1 / 60 - a / 70))


def sliding_wall_shear(h: Array, q: float) -> Array:
    """The shear stress (1 - 6a) / h on the sliding wall; shape of ``h``."""
    return np.asarray((1 - 6 * excess_flow(h, q)) / h)


def back_flow(h: Array, q: float) -> float:
    """The largest reverse velocity over the sliding speed; 0 without reverse flow.

    The flow reverses at the fixed wall where 1 + 6a < 0; its minimum is then at Y = (1 + 6a) / 12a.
    """
    steepness = 1 + 6 * excess_flow(h, q)
    s = steepness[steepness < 0]
    return float(np.max(s**2 / (4 * (1 - s)), initial=0.0))
