r"""The dissipation that the slope of the walls adds to that of a thin film, to second order and as an upper bound.

Stokes flow has the least dissipation of all flows with a given mean flux between given walls. Thin-film theory includes
only the part ∫\|∂u/∂z\|² and underestimates it for all walls. The thin-film flow as a flow in three dimensions
overestimates it: with s = (z - z₁)/h, the local flux q, v = q/h and a wall sliding at U,

    u = 6 v s(1-s) + U (3s² - 2s) e₁,    w from ∇·u + ∂w/∂z = 0.

This differs from Stokes flow in the second order of the slope, and its dissipation in the fourth. The dissipation minus
that of thin-film theory is, for drives i and j,

    E_ij = <∫ ∇u_i:∇u_j + (∇·u_i)(∇·u_j) dz>   of second order in slope,
    W_ij = <∫ ∇w_i·∇w_j dz>                    of fourth order,

with ∇ along the film at constant height. The thin film plus E is exact to second order; with W it is an upper bound.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.flux import flux, sliding_flux
from roughfilm.rom.rough_gap.flow.gradients import (
    CURVED,
    EVEN,
    ODD,
    add_rise_energies,
    add_wave_energies,
    set_gradients,
)
from roughfilm.rom.rough_gap.flow.waves import attenuation
from roughfilm.rom.rough_gap.walls import Walls

GAUSS_POINTS = 4
"""Number of Gauss points across the gap, exact for the squares of the cubics in ∇w."""


@dataclass(frozen=True, kw_only=True)
class SlopeDissipation:
    """Dissipation added to that of thin films, over η, for the drives ∇p = -12η e₁, -12η e₂ and U = 1.

    All have the shape (drives, drives), for lengths over the mean gap; the third drive exists if the upper wall slides.

    Attributes
    ----------
    second : E.
    fourth : W.
    attenuated : E with each wave attenuated as in Stokes flow over low roughness.
    """

    second: Array
    fourth: Array
    attenuated: Array


def local_fluxes(gap: Array, spacing: tuple[float, float], correctors: Array, drives: int) -> Array:
    """The flow per width of each drive in thin-film theory at the nodes, shape (drives, 2, nx, ny)."""
    fluxes = [flux(gap, spacing, correctors[direction], direction) for direction in range(2)]
    if drives > 2:
        fluxes.append(sliding_flux(gap, spacing, correctors[2]) / 2)
    return np.array(fluxes)


def slope_dissipation(walls: Walls, fluxes: Array) -> SlopeDissipation:
    """The dissipations E, W and attenuated E, from differences of neighbouring nodes.

    Velocities and slopes are evaluated at the middles of four nodes, where all differences are centred. The velocity in
    contact is zero; a middle with some nodes in contact has the mean gap of all four. The error is of second order in
    the spacing where the walls are smooth and open.

    Parameters
    ----------
    walls : both walls, lengths over the mean gap.
    fluxes : flows per width of :func:`local_fluxes`.
    """
    h, steps, drives = walls.gap, walls.spacing, len(fluxes)
    second, fourth, attenuated = (np.zeros((drives, drives)) for _ in range(3))
    normal, filters, weights = _waves(walls)
    for part, gradients in _gradients(walls, fluxes):
        kind = filters[:, 1] if part == ODD else filters[:, 0]
        second += _energies(gradients)
        add_wave_energies(scipy.fft.rfft2(gradients, norm="ortho"), normal, kind, weights, attenuated)
    velocity = _velocity(walls, fluxes)
    s, gauss = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    s = (s + 1) / 2
    shapes = np.array([6 * (s - s**2), 6 * (s**2 - s**3), 3 * s**2 - 2 * s, 2 * s**3 - s**2]).T
    steep = np.array([6 - 12 * s, 12 * s - 18 * s**2, 6 * s - 2, 6 * s**2 - 2 * s]).T
    add_rise_energies(walls.lower, h, _rise(walls, velocity), steps, shapes, steep, s, gauss / 2, fourth)
    return SlopeDissipation(second=second / h.size, fourth=fourth / h.size, attenuated=attenuated / h.size)


def second_order_dissipation(walls: Walls, fluxes: Array) -> Array:
    """The dissipation E of :func:`slope_dissipation` alone, shape (drives, drives)."""
    return np.asarray(sum(_energies(gradients) for _, gradients in _gradients(walls, fluxes))) / walls.gap.size


def _velocity(walls: Walls, fluxes: Array) -> Array:
    return np.divide(fluxes, walls.gap, out=np.zeros_like(fluxes), where=walls.gap > 0)


def _gradients(walls: Walls, fluxes: Array) -> Iterator[tuple[int, Array]]:
    """Each part of ∇u over the gap, by :func:`roughfilm.rom.rough_gap.flow.gradients.set_gradients`."""
    velocity = _velocity(walls, fluxes)
    gradients = np.empty((len(fluxes), 2, 2, *walls.gap.shape))
    for part in (EVEN, CURVED, ODD):
        set_gradients(walls.lower, walls.gap, velocity, walls.spacing, part, gradients)
        yield part, gradients


def _energies(gradients: Array) -> Array:
    """The sums of ∇u_i:∇u_j + (∇·u_i)(∇·u_j), shape (drives, drives)."""
    flat = gradients.reshape(len(gradients), -1)
    divergence = (gradients[:, 0, 0] + gradients[:, 1, 1]).reshape(len(gradients), -1)
    return np.asarray(flat @ flat.T + divergence @ divergence.T)


def _rise(walls: Walls, velocity: Array) -> Array:
    """The coefficients v·∇z₁, v·∇h, U ∂z₁/∂x and U ∂h/∂x of w at the nodes, shape (drives, 4, nx, ny)."""
    rise = np.zeros((len(velocity), 4, *walls.lower.shape))
    for part, heights in enumerate((walls.lower, walls.gap)):
        for axis, step in enumerate(walls.spacing):
            slope = (np.roll(heights, -1, axis=axis) - np.roll(heights, 1, axis=axis)) / (2 * step)
            rise[:, part] += velocity[:, axis] * slope
            if axis == 0:
                rise[2:, 2 + part] = slope
    return rise


def _waves(walls: Walls) -> tuple[Array, Array, Array]:
    """The directions of the waves of a real transform, roots of their attenuation, and their multiplicities.

    The shapes are (2, nx, n), (2, 2, nx, n) and (n,) with n = ny // 2 + 1.
    """
    (nx, ny), (dx, dy) = walls.lower.shape, walls.spacing
    x, y = 2 * np.pi * np.fft.fftfreq(nx, dx), 2 * np.pi * np.fft.rfftfreq(ny, dy)
    q = np.array(np.meshgrid(x, y, indexing="ij"))
    length = np.hypot(*q)
    normal = np.divide(q, length, out=np.zeros_like(q), where=length > 0)
    weights = np.full(y.size, 2.0)
    weights[0] = 1.0
    weights[(ny + 1) // 2 :] = 1.0
    return normal, np.sqrt(attenuation(length)), weights
