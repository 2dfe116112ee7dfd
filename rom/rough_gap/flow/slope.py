r"""What the slope of the walls adds to the dissipation of a thin film, to the next order and as an upper bound.

Stokes flow has the least dissipation of all flows with a given mean flux between given walls. Thin-film theory counts
the part ∫\|∂u/∂z\|² of it alone, and so finds too little, whatever the walls. Its own flow, taken as a flow in three
dimensions, has too much: with s = (z - z₁)/h, q the local flux, v = q/h and a wall sliding at U,

    u = 6 v s(1-s) + U (3s² - 2s) e₁,    w from ∇·u + ∂w/∂z = 0.

It differs from Stokes flow by the square of the slope, so that its dissipation does by the fourth power. Over that of
thin-film theory it has, for drives i and j,

    E_ij = <∫ ∇u_i:∇u_j + (∇·u_i)(∇·u_j) dz>   of second order in slope,
    W_ij = <∫ ∇w_i·∇w_j dz>                    of fourth order,

∇ along the film at constant height. Thin film + E is right to second order, thin film + E + W an upper bound.
"""

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

POINTS = 4
"""Of Gauss across the gap: exact for squares of the cubics that ∇w consists of."""


@dataclass(frozen=True, kw_only=True)
class SlopeDissipation:
    """Added to η times the dissipation of thin films, over the drives ∇p = -12η e₁, -12η e₂ (m/s if 1/m) and U = 1.

    All of shape (drives, drives), for lengths over the mean gap; the third drive is there if the upper wall slides.

    Attributes
    ----------
    second : E.
    fourth : W.
    attenuated : E with each of its waves as strong as Stokes flow has it where roughness is low.
    """

    second: Array
    fourth: Array
    attenuated: Array


def local_fluxes(gap: Array, spacing: tuple[float, float], correctors: Array, drives: int) -> Array:
    """Flow per width of each drive in thin-film theory at the nodes, shape (drives, 2, nx, ny)."""
    found = [flux(gap, spacing, correctors[direction], direction) for direction in range(2)]
    if drives > 2:
        found.append(sliding_flux(gap, spacing, correctors[2]) / 2)
    return np.array(found)


def slope_dissipation(walls: Walls, fluxes: Array) -> SlopeDissipation:
    """E, W and E attenuated, from differences between neighbouring nodes.

    Velocities and slopes are taken in the middle of four nodes, where all differences are centred. In contact nothing
    moves; a middle with some of its nodes in contact has the mean gap of all four.

    Parameters
    ----------
    walls : lengths over the mean gap.
    fluxes : as :func:`local_fluxes` gives them.

    Second order in the spacing where the walls are smooth and open.
    """
    h, steps, drives = walls.gap, walls.spacing, len(fluxes)
    second, fourth, attenuated = (np.zeros((drives, drives)) for _ in range(3))
    velocity = np.divide(fluxes, h, out=np.zeros_like(fluxes), where=h > 0)
    normal, filters, weights = _waves(walls)
    gradients = np.empty((drives, 2, 2, *h.shape))
    for part, kind in ((EVEN, filters[:, 0]), (CURVED, filters[:, 0]), (ODD, filters[:, 1])):
        set_gradients(walls.lower, h, velocity, steps, part, gradients)
        add_wave_energies(scipy.fft.rfft2(gradients, norm="ortho"), normal, kind, weights, second, attenuated)
    s, gauss = np.polynomial.legendre.leggauss(POINTS)
    s = (s + 1) / 2
    shapes = np.array([6 * (s - s**2), 6 * (s**2 - s**3), 3 * s**2 - 2 * s, 2 * s**3 - s**2]).T
    steep = np.array([6 - 12 * s, 12 * s - 18 * s**2, 6 * s - 2, 6 * s**2 - 2 * s]).T
    add_rise_energies(walls.lower, h, _rise(walls, velocity), steps, shapes, steep, s, gauss / 2, fourth)
    return SlopeDissipation(second=second / h.size, fourth=fourth / h.size, attenuated=attenuated / h.size)


def _rise(walls: Walls, velocity: Array) -> Array:
    """What w is made of at the nodes: v·∇z₁, v·∇h, U ∂z₁/∂x and U ∂h/∂x, shape (drives, 4, nx, ny)."""
    found = np.zeros((len(velocity), 4, *walls.lower.shape))
    for part, heights in enumerate((walls.lower, walls.gap)):
        for axis, step in enumerate(walls.spacing):
            slope = (np.roll(heights, -1, axis=axis) - np.roll(heights, 1, axis=axis)) / (2 * step)
            found[:, part] += velocity[:, axis] * slope
            if axis == 0:
                found[2:, 2 + part] = slope
    return found


def _waves(walls: Walls) -> tuple[Array, Array, Array]:
    """Directions of the waves of a real transform, roots of their attenuation, and by how many each counts.

    Shapes (2, nx, n), (2, 2, nx, n) and (n,) with n = ny // 2 + 1.
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
