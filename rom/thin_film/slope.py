r"""The second-order effect of the walls' slope on a thin-film flow, as forces on its cells.

Compared with the Navier-Stokes equations, the thin-film equations neglect the stress that the velocity (u, v) causes
along the film. With y upward, M = ∫_y^1 u v dy, and the pressure across the film from the momentum in y, it is

    T = 2 ∂u/∂x + Re v² - Re ∂M/∂x.

Its divergence ∂T/∂x is tested with the φ_k and integrated by parts, so that no second derivative of the wall is needed.
At a corner of the wall the thin film's v jumps, whereas a disturbance really decays over the length h / π of the
slowest mode that vanishes on both walls. T is therefore smoothed over that length:

    T - (h/π)² ∂²T/∂x² = T of the thin film.

Where the wall is smooth this has no effect of second order. At an end the pressure is uniform over the section and the
velocity does not change along the film: there T = 0.
"""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.thin_film import periodic_solve as ring
from roughfilm.rom.thin_film.basis import Basis
from roughfilm.rom.thin_film.thin_film import Strip, StripFlow, all_amplitudes, stream_function, velocity

DECAY_LENGTH = 1 / np.pi
"""Decay length of a disturbance along the film, in film thicknesses: the slowest mode is sin(πY) exp(-πx/h)."""


def velocities(film: Strip, across: Basis, state: StripFlow) -> tuple[Array, Array]:
    """The velocity u along and v = -∂ψ/∂x across the film in each cell, shape (cells, points)."""
    u = velocity(film, across, state)
    psi = stream_function(film, across, state)
    rise = np.diff(psi, axis=0) / film.lengths[:, None]
    return u, np.asarray(-rise - u * (1 - across.nodes) * _wall_slope(film)[:, None])


def imbalance(film: Strip, across: Basis, reynolds_number: float, state: StripFlow) -> Array:
    """The imbalance -∫∫ φ_k ∂T/∂x dy dx of every cell, shape (cells, n), for :func:`rom.thin_film.thin_film.step`."""
    u, v = velocities(film, across, state)
    below, slope = 1 - across.nodes, _wall_slope(film)[:, None]
    h, (left, right) = film.thickness[:, None], film.around[:, 1:3].T
    between = (film.lengths[left] + film.lengths[right])[:, None] / 2
    shear = 1 + all_amplitudes(film, across, state) @ across.slope
    moment = h * ((u * v) @ across.above)

    def along(values: Array, by_height: Array) -> Array:
        """The derivative ∂/∂x at constant y, at the faces, of values whose ∂/∂Y is ``by_height``."""
        return np.asarray((values[right] - values[left]) / between + _at_faces(film, by_height * below * slope / h))

    stress = 2 * along(u, shear) + reynolds_number * (_at_faces(film, v**2) - along(moment, -h * u * v))
    stress = _smoothed(film, film.inside[:, None] * stress)
    through = film.face_thickness[:, None] * (stress @ (across.weights * across.shape).T)
    within = (stress[1:] + stress[:-1]) / 2 * below * (film.lengths[:, None] * slope)
    return np.asarray(-np.diff(through, axis=0) + within @ (across.weights * across.slope).T)


def _wall_slope(film: Strip) -> Array:
    return np.asarray(np.diff(film.face_thickness) / film.lengths)


def _at_faces(film: Strip, values: Array) -> Array:
    return np.asarray(np.einsum("fo,fom->fm", film.middle, values[film.around]))


def _smoothed(film: Strip, values: Array) -> Array:
    """The solution f of f - (DECAY_LENGTH h)² f'' = values at the faces, and of f = values at ends."""
    left, right = film.lengths[film.around[:-1, 1:3]].T
    factor = 2 * (DECAY_LENGTH * film.inside * film.face_thickness)[:-1] ** 2 / (left + right)
    row = np.stack([-factor / left, 1 + factor / left + factor / right, -factor / right], axis=1)
    smooth = ring.solve(row[:, :, None, None], values[:-1, None, :])[:, 0]
    return np.concatenate([smooth, smooth[:1]])
