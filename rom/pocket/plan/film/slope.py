r"""The second-order effect of the wall's slope on a film over a cell in plan, as forces on its cells.

Compared with the Navier-Stokes equations, the thin-film equations neglect the stresses that the velocity (u, v, w)
causes in the plane. With z upward, the momentum in z gives the pressure across the film from that on the sliding wall,
p(z) - p(1) = ∂w/∂z + Re (∂M_u/∂x + ∂M_v/∂y - w²) with M_u = ∫_z^1 u w dz' and M_v = ∫_z^1 v w dz'. The neglected force
is the divergence of

    T_xx = 2 ∂u/∂x + N,    T_yy = 2 ∂v/∂y + N,    T_xy = ∂u/∂y + ∂v/∂x,    N = Re (w² - ∂M_u/∂x - ∂M_v/∂y).

All derivatives are at constant z. The divergence is tested with the φ_k and integrated by parts, so that no second
derivative of the wall is needed. At a corner of the wall each T is smoothed over the decay length of a disturbance, as
over grooves (:mod:`roughfilm.rom.thin_film.slope`):

    T - (h/π)² ∇²T = T of the thin film.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.film.equations import Film, SheetFlow, Velocities
from roughfilm.rom.pocket.plan.film.sheet import Sheet
from roughfilm.rom.thin_film.slope import DECAY_LENGTH


@dataclass(frozen=True, kw_only=True)
class Slopes:
    """Slopes ∂h/∂x and ∂h/∂y of the film thickness at the places of u and of v, shape (2, nx, ny)."""

    of_u: Array
    of_v: Array

    @classmethod
    def of(cls, sheet: Sheet) -> Self:
        """The slopes over the cells of a sheet."""
        (ahead_x, ahead_y), (around_x, around_y) = sheet.ahead, sheet.around
        nodes, corners = sheet.thickness[2:]
        return cls(
            of_u=np.stack([_rise(nodes, 0) / ahead_x, -_rise(corners, 1, -1) / around_y]),
            of_v=np.stack([-_rise(corners, 0, -1) / around_x, _rise(nodes, 1) / ahead_y]),
        )


def imbalance(film: Film, flow: SheetFlow, velocities: Velocities) -> Array:
    """The imbalance -∫∫ φ_k ∇·T dz dA of every cell, as a flat vector with a flow that is balanced."""
    sheet, basis, slopes = film.sheet, film.basis, Slopes.of(film.sheet)
    (ahead_x, ahead_y), (around_x, around_y) = sheet.ahead, sheet.around
    h_u, h_v, h, h_corner = (one[:, :, None] for one in sheet.thickness)
    u, v, lower = velocities.u, velocities.v, 1 - basis.nodes
    w_u, w_v = vertical(film, velocities)
    steep_u, steep_v = (lower * slopes.of_u[..., None] / h_u, lower * slopes.of_v[..., None] / h_v)
    shear_u, shear_v = 1 + flow.along @ basis.slope, flow.across @ basis.slope
    moment_u, moment_v = h_u * ((u * w_u) @ basis.above), h_v * ((v * w_v) @ basis.above)
    fall_u, fall_v = -h_u * u * w_u, -h_v * v * w_v

    def along(values: Array, by_height: Array) -> Array:
        """The derivative ∂/∂x at constant z, at the nodes, of values at the places of u."""
        return -_rise(values, 0, -1) / around_x[..., None] + _at_nodes(by_height * steep_u[0], ahead_x, 0)

    def across(values: Array, by_height: Array) -> Array:
        """The derivative ∂/∂y at constant z, at the nodes, of values at the places of v."""
        return -_rise(values, 1, -1) / around_y[:, None] + _at_nodes(by_height * steep_v[1], ahead_y, 1)

    square = (_at_nodes(w_u**2, ahead_x, 0) + _at_nodes(w_v**2, ahead_y, 1)) / 2
    normal = film.reynolds_number * (square - along(moment_u, fall_u) - across(moment_v, fall_v))
    at_nodes, at_corners = _smoothers(sheet)
    xx, yy = at_nodes(2 * along(u, shear_u) + normal), at_nodes(2 * across(v, shear_v) + normal)
    xy = _rise(u, 1) / ahead_y[:, None] + _mean(shear_u * steep_u[1], 1)
    xy = at_corners(xy + _rise(v, 0) / ahead_x[..., None] + _mean(shear_v * steep_v[0], 0))

    shape, turned = (basis.weights * basis.shape).T, (basis.weights * lower * basis.slope).T
    area_u, area_v, _ = sheet.areas
    side_xx, side_yy = around_y[:, None] * (h * xx @ shape), around_x[..., None] * (h * yy @ shape)
    side_xy = h_corner * xy @ shape
    inside_u = _mean(xx, 0) * slopes.of_u[0][..., None] + _at_nodes(xy, ahead_y, 1) * slopes.of_u[1][..., None]
    inside_v = _mean(yy, 1) * slopes.of_v[1][..., None] + _at_nodes(xy, ahead_x, 0) * slopes.of_v[0][..., None]
    of_u = area_u[..., None] * (inside_u @ turned) - _rise(side_xx, 0) + ahead_x[..., None] * _rise(side_xy, 1, -1)
    of_v = area_v[..., None] * (inside_v @ turned) - _rise(side_yy, 1) + ahead_y[:, None] * _rise(side_xy, 0, -1)
    return np.concatenate([of_u.ravel(), of_v.ravel(), np.zeros(area_u.size)])


def vertical(film: Film, velocities: Velocities) -> tuple[Array, Array]:
    """The velocity w = m - (1 - Y) (u ∂h/∂x + v ∂h/∂y) across the film at the places of u and of v."""
    sheet, slopes, lower = film.sheet, Slopes.of(film.sheet), 1 - film.basis.nodes
    (ahead_x, ahead_y), (area_u, area_v, _) = sheet.ahead, sheet.areas
    v_there = _at_nodes(_mean(velocities.v, 0), ahead_y, 1)
    u_there = _at_nodes(_mean(velocities.u, 1), ahead_x, 0)
    climb_u = velocities.u * slopes.of_u[0][..., None] + v_there * slopes.of_u[1][..., None]
    climb_v = u_there * slopes.of_v[0][..., None] + velocities.v * slopes.of_v[1][..., None]
    return (
        -velocities.faces[6] / area_u[..., None] - lower * climb_u,
        -velocities.faces[7] / area_v[..., None] - lower * climb_v,
    )


def _rise(values: Array, axis: int, toward: int = 1) -> Array:
    """The values ahead along an axis, or behind for ``toward`` -1, minus the values."""
    return np.roll(values, -toward, axis=axis) - values


def _mean(values: Array, axis: int) -> Array:
    """The mean with the values ahead along an axis."""
    return (values + np.roll(values, -1, axis=axis)) / 2


def _at_nodes(values: Array, ahead: Array, axis: int) -> Array:
    """Values halfway between nodes, interpolated along an axis to the nodes; shape (nx, ny, points)."""
    behind = np.roll(ahead, 1, axis=0)
    weight = (ahead / (ahead + behind)).reshape((-1, 1, 1) if axis == 0 else (1, -1, 1))
    return weight * np.roll(values, 1, axis=axis) + (1 - weight) * values


Smoother = Callable[[Array], Array]
"""Function that smooths values at places, shape (nx, ny, points)."""


def _smoothers(sheet: Sheet) -> tuple[Smoother, Smoother]:
    """The functions that smooth values at the nodes and at the corners of cells over the decay length."""
    (ahead_x, ahead_y), (around_x, around_y) = ((x[:, 0], y) for x, y in (sheet.ahead, sheet.around))
    beyond = np.roll(around_x, -1), np.roll(around_y, -1)
    return (
        _smoother(sheet.thickness[2], (ahead_x, ahead_y), (around_x, around_y)),
        _smoother(sheet.thickness[3], beyond, (ahead_x, ahead_y)),
    )


def _smoother(h: Array, steps: tuple[Array, Array], widths: tuple[Array, Array]) -> Smoother:
    """The function that solves f - (DECAY_LENGTH h)² ∇²f = values at places with these steps ahead and widths."""
    curvatures = [_curvature(step, width) for step, width in zip(steps, widths, strict=True)]
    laplacian = scipy.sparse.kron(curvatures[0], scipy.sparse.eye_array(h.shape[1]))
    laplacian += scipy.sparse.kron(scipy.sparse.eye_array(h.shape[0]), curvatures[1])
    scale = scipy.sparse.diags_array((DECAY_LENGTH * h.ravel()) ** 2)
    matrix = scipy.sparse.eye_array(h.size) - scale @ laplacian
    factors = scipy.sparse.linalg.splu(scipy.sparse.csc_array(matrix))
    return lambda values: np.asarray(factors.solve(values.reshape(h.size, -1))).reshape(values.shape)


def _curvature(step: Array, width: Array) -> Any:
    """The matrix of the second derivative on a periodic row of places with these steps ahead and widths."""
    number = np.arange(step.size)
    places = np.concatenate([number, number]), np.concatenate([number, (number + 1) % step.size])
    rise = scipy.sparse.csr_array((np.concatenate([-1 / step, 1 / step]), places))
    places = np.concatenate([number, number]), np.concatenate([number, (number - 1) % step.size])
    return scipy.sparse.csr_array((np.concatenate([1 / width, -1 / width]), places)) @ rise
