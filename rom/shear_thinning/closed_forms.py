"""Closed forms of the flow of shear-thinning lubricants through a straight gap."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array


def eyring_flow(
    viscosity: float, stress: float, thickness: float, speed: float, gradient: Array | float
) -> tuple[Array, Array]:
    """The flow and the stress on the sliding wall of a Ree-Eyring liquid, sheared and driven along x.

    With Σ = h/(2 τ₀) ∂p/∂x and U = η u/(h τ₀) the flow is

        q = u h/2 - h³/(12 η) ∂p/∂x 3 (Σ cosh Σ - sinh Σ)/Σ³ √(1 + (U Σ/sinh Σ)²),

    and the stress against the motion of the sliding wall is τ₀ (arsinh(U Σ/sinh Σ) + Σ).

    Parameters
    ----------
    viscosity : viscosity η at rest, Pa s.
    stress : Eyring stress τ₀, Pa.
    thickness : film thickness h, m.
    speed : sliding speed u along x, m/s.
    gradient : ∂p/∂x, Pa/m, any shape.

    Returns
    -------
    flow, wall_stress
        Flow q, m²/s, and stress, Pa, of the shape of ``gradient``.

    Source: Conry, Wang and Cusano 1987, Journal of Tribology 109, 648.
    """
    sigma = np.asarray(thickness / (2 * stress) * gradient, dtype=float)
    small = np.abs(sigma) < 1e-3
    at = np.where(small, 1.0, sigma)
    factor = np.where(small, 1 + sigma**2 / 10, 3 * (at * np.cosh(at) - np.sinh(at)) / at**3)
    pulled = viscosity * speed / (thickness * stress) * np.where(small, 1 - sigma**2 / 6, at / np.sinh(at))
    driven = thickness**3 / (12 * viscosity) * gradient * factor * np.sqrt(1 + pulled**2)
    return np.asarray(speed * thickness / 2 - driven), np.asarray(stress * (np.arcsinh(pulled) + sigma))


def power_law_flow(consistency: float, index: float, thickness: float, gradient: Array | float) -> Array:
    """The flow of a power-law liquid, τ = K γ̇^n, through a gap at rest.

    It is

        q = -2 n/(2 n + 1) (h/2)² (h/(2 K) |∂p/∂x|)^(1/n) sign(∂p/∂x).

    Parameters
    ----------
    consistency : K, Pa s^n; (η₀ - η∞) λ^(n-1) of a Carreau liquid far above its critical shear rate, where η∞ = 0.
    index : n.
    thickness : film thickness h, m.
    gradient : ∂p/∂x, Pa/m, any shape.

    Returns
    -------
    Array
        Flow q, m²/s, of the shape of ``gradient``.

    Source: Bird, Armstrong and Hassager 1987, Dynamics of Polymeric Liquids, volume 1, section 4.2.
    """
    rate = (thickness / (2 * consistency) * np.abs(gradient)) ** (1 / index)
    return np.asarray(-np.sign(gradient) * 2 * index / (2 * index + 1) * (thickness / 2) ** 2 * rate)
