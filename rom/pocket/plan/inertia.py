"""The change of a film over a cell in plan by inertia, to first order in the Reynolds number."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.balance import outflow
from roughfilm.rom.pocket.plan.reynolds import Lines, PlanFilm, along_lines, flows_at_middles
from roughfilm.rom.thin_film import inertia as terms


@dataclass(frozen=True, kw_only=True)
class Change:
    """The change by inertia, per Reynolds number.

    Attributes
    ----------
    pressure : pressure p₁ at the middles of the columns up to a constant, shape (nx, ny).
    drive : pressure by which inertia would raise a film without flow on the lines from each middle to the next.
    shear_stress : shear stress on the sliding wall over the faces along x, shape (nx, ny).
    residual : the largest net flow out of a column over the largest driven flow through a face; 0 without any.
    """

    pressure: Array
    drive: Array
    shear_stress: Array
    residual: float


def inertia(film: PlanFilm, lines: Lines) -> Change:
    """Solve ∇·q₁ = 0 with q₁ = -h³/12 ∇p₁ - h²/2 C and the force C of :mod:`roughfilm.rom.thin_film.inertia`.

    On a line q₁ raises the pressure by -12 q₁ ∫h⁻³ dx, and inertia by -6 ∫C/h dx. The integrals of derivatives along x
    are sums over the places of the line, which are exact for the rise that is a function of h alone where the film
    varies along x alone. The error is of second order in the size of the columns.
    """
    h, (dx, dy) = film.grid.thickness, film.grid.steps
    flow_x, flow_y = flows_at_middles(film)
    a, b = flow_x / h - 0.5, flow_y / h
    between = terms.momentum_between(h, a, b, 1.0)

    on_line = lines.thickness
    a_line = along_lines(flow_x) / on_line - 0.5
    thicker = np.diff(on_line, axis=1)
    rise = np.diff(terms.momentum_along(on_line, a_line, 1.0), axis=1)
    rise += thicker * _middles(terms.slope_along(a_line, 1.0))
    rise += _middles(along_lines(_central(between, 1) / dy)) * (dx / thicker.shape[1])
    drive = np.concatenate(
        [np.zeros_like(on_line[:, :1]), np.cumsum(-6 * _middles(1 / on_line) * rise, axis=1)], axis=1
    )

    force_y = _next_middles(_central(between, 0) / dx, 1) * dy + _rise(terms.momentum_across(h, b), 1)
    force_y += _next_middles(_central(h, 0) / dx * terms.slope_across(b), 1) * dy
    drive_y = -6 * _next_middles(1 / h, 1) * force_y

    east, north = film.faces.east / 12 * dy / dx, film.faces.north / 12 * dx / dy
    driven = east * drive[:, -1], north * drive_y
    pressure, _ = film.balance.pressure(-outflow(*driven))
    along, across = driven[0] - east * _rise(pressure, 0), driven[1] - north * _rise(pressure, 1)

    sheared = np.diff(terms.shear_along(on_line, a_line, 1.0), axis=1)
    sheared += thicker * _middles(terms.shear_slope(a_line, 1.0))
    by_side = _next_middles(_central(terms.shear_between(h, a, b, 1.0), 1), 0) / dy
    stress = (sheared - 3 * rise).sum(axis=1) / dx + by_side - 6 * along / dy * film.faces.drag / film.faces.east
    largest = max(float(np.abs(one).max()) for one in driven)
    return Change(
        pressure=pressure,
        drive=drive,
        shear_stress=stress,
        residual=float(np.abs(outflow(along, across)).max()) / largest if largest > 0 else 0.0,
    )


def _rise(values: Array, axis: int) -> Array:
    """The rise from each middle to the next along an axis."""
    return np.asarray(np.roll(values, -1, axis=axis) - values)


def _central(values: Array, axis: int) -> Array:
    """Half of the rise from the middle before to the next one along an axis."""
    return np.asarray((np.roll(values, -1, axis=axis) - np.roll(values, 1, axis=axis)) / 2)


def _next_middles(values: Array, axis: int) -> Array:
    """The means of each middle and the next along an axis."""
    return np.asarray((np.roll(values, -1, axis=axis) + values) / 2)


def _middles(values: Array) -> Array:
    """The means of neighbouring places on lines."""
    return np.asarray((values[:, 1:] + values[:, :-1]) / 2)
