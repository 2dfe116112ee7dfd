r"""The first-order force of inertia on a thin film between a fixed and a sliding wall.

With Y from the fixed wall (0) to the sliding one (1), which has the speed U along x, and φ = Y(1 - Y), the velocities
of the Reynolds equation are

    u = U Y + 6 a φ,    v = 6 b φ,

and the flow is h (U/2 + a, b). The acceleration weighted with φ and integrated over the thickness h is

    Cx = ∂x(h (U²/20 + U a/5 + 9 a²/35)) + ∂y(h b (U/10 + 9 a/35)) + U h' (U/60 + a/70),    h' = ∂h/∂x,
    Cy = ∂x(h b (U/10 + 9 a/35)) + ∂y(9 h b²/35) + U h' b/70,

and weighted with Y that along x is

    D = ∂x(h (U²/4 + 3 U a/5 + 3 a²/5)) + ∂y(h b (3 U/10 + 3 a/5)) - U h' (U/20 + a/10).

The functions below are the terms of these sums. The first weight removes the unknown first-order velocity but for its
flow, since φ'' is constant; the second leaves its shear stress on the sliding wall. Velocities may have any unit.
"""

from roughfilm.contact.foundation.arrays import Array


def momentum_along(h: Array, a: Array, speed: float) -> Array:
    """The term of Cx below ∂x, h (U²/20 + U a/5 + 9 a²/35)."""
    return h * (speed**2 / 20 + speed * a / 5 + 9 * a**2 / 35)


def momentum_between(h: Array, a: Array, b: Array, speed: float) -> Array:
    """The term of Cx below ∂y and of Cy below ∂x, h b (U/10 + 9 a/35)."""
    return h * b * (speed / 10 + 9 * a / 35)


def momentum_across(h: Array, b: Array) -> Array:
    """The term of Cy below ∂y, 9 h b²/35."""
    return 9 * h * b**2 / 35


def slope_along(a: Array, speed: float) -> Array:
    """The factor of U h' in Cx, U/60 + a/70."""
    return speed / 60 + a / 70


def slope_across(b: Array) -> Array:
    """The factor of U h' in Cy, b/70."""
    return b / 70


def shear_along(h: Array, a: Array, speed: float) -> Array:
    """The term of D below ∂x, h (U²/4 + 3 U a/5 + 3 a²/5)."""
    return h * (speed**2 / 4 + 3 * speed * a / 5 + 3 * a**2 / 5)


def shear_between(h: Array, a: Array, b: Array, speed: float) -> Array:
    """The term of D below ∂y, h b (3 U/10 + 3 a/5)."""
    return h * b * (3 * speed / 10 + 3 * a / 5)


def shear_slope(a: Array, speed: float) -> Array:
    """The factor of U h' in D, -(U/20 + a/10)."""
    return -(speed / 20 + a / 10)
