"""A pad with one pocket by finite volumes: a second solution that shares no code with ``roughfilm.rom.cavitation``."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome

PRESSURE_UNIT = 1e6
"""Scale of the pressure beside the cavity fraction, Pa."""

TOLERANCE, MAX_STEPS = 1e-9, 200
"""Largest net flow into a cell, over that of a film of 1 µm through its side, and number of Newton's steps."""

LARGEST_STEP = 2e7
"""Largest change of a pressure in a step, Pa."""


Cells = NDArray[np.intp]
"""Numbers of cells."""

Faces = tuple[Cells, Cells, Array]
"""The cells on both sides of faces, and the conductances of these, m³/(Pa s)."""

Ends = tuple[Cells, Array]
"""The cells at an end, and the conductances to the bath, m³/(Pa s)."""


@dataclass(frozen=True, kw_only=True)
class FinitePad:
    """A rigid pad with one rectangular pocket in the middle of its width; pressures are absolute.

    The density over that at the cavitation pressure 0 is (c1 + c2 p)/(c1 + p), the viscosity η exp(α p).

    Attributes
    ----------
    length, width : of the pad, m.
    inlet, outlet : film thickness at both ends, between which it changes linearly, m.
    pocket : where the pocket begins and ends, m from the inlet.
    pocket_width, depth : of the pocket, m.
    speed : of the flat wall, m/s.
    ambient : pressure on all sides, Pa.
    viscosity, barus : η at the cavitation pressure, Pa s, and α, 1/Pa.
    c1, c2 : Dowson and Higginson's constants, Pa and 1.
    """

    length: float
    width: float
    inlet: float
    outlet: float
    pocket: tuple[float, float]
    pocket_width: float
    depth: float
    speed: float
    ambient: float
    viscosity: float
    barus: float
    c1: float
    c2: float

    def thickness(self, x: Array, y: Array) -> Array:
        """The film thickness at positions, m; y from the middle of the width."""
        inside = (x > self.pocket[0]) & (x < self.pocket[1]) & (y < self.pocket_width / 2)
        return np.asarray(self.outlet + (self.inlet - self.outlet) * (1 - x / self.length) + self.depth * inside)

    def density(self, p: Array | float) -> Array:
        """The density over that at the cavitation pressure."""
        return np.asarray((self.c1 + self.c2 * p) / (self.c1 + p))

    def mobility(self, p: Array | float) -> Array:
        """The density over the viscosity, each over that at the cavitation pressure."""
        return np.asarray(self.density(p) * np.exp(-self.barus * np.asarray(p)))


def centre_line(pad: FinitePad, cells: tuple[int, int]) -> tuple[Array, Array]:
    """The pressure along the middle of the width, Pa, at the middles of the cells, m.

    The equation is ∂(ρ (1 − c) h u/2)/∂x = ∇·(ρ h³/(12 η) ∇p) with p, c >= 0 and p c = 0 for the cavity fraction c.
    Half of the width has cells of equal size, so that a pocket that begins and ends at their edges is exact. Flow
    between cells has the harmonic mean of h³ and the mean mobility, the flow of sliding that of the upstream cell. The
    balances and p + c − √(p² + c²) = 0 are solved together by Newton's method with a sparse factorisation.
    First-order accurate.

    Parameters
    ----------
    cells : number along the pad and across half of its width, 2 or more across.

    Returns
    -------
    The positions, m, and the pressures, Pa, both of shape (cells along,).

    Raises
    ------
    ConvergenceError
        If Newton's method does not meet ``TOLERANCE``.
    """
    (nx, ny), size = cells, cells[0] * cells[1]
    dx, dy = pad.length / nx, pad.width / 2 / ny
    x, y = (np.arange(nx) + 0.5) * dx, (np.arange(ny) + 0.5) * dy
    h = pad.thickness(*np.meshgrid(x, y, indexing="ij"))
    index = np.arange(size).reshape(nx, ny)
    cube = h**3 / (12 * pad.viscosity)
    ends = (
        (index[0], cube[0] * 2 * dy / dx),
        (index[-1], cube[-1] * 2 * dy / dx),
        (index[:, -1], cube[:, -1] * 2 * dx / dy),
    )
    inner = (
        (index[:-1].ravel(), index[1:].ravel(), _harmonic(cube[:-1], cube[1:]).ravel() * dy / dx),
        (index[:, :-1].ravel(), index[:, 1:].ravel(), _harmonic(cube[:, :-1], cube[:, 1:]).ravel() * dx / dy),
    )
    drift, unit = pad.speed / 2 * dy * h.ravel(), pad.speed / 2 * dy * 1e-6
    p, c = np.full(size, pad.ambient), np.zeros(size)
    for _ in range(MAX_STEPS):
        balance, by_p, by_c = _balances(pad, p, c, inner, ends, drift, index, dy)
        root = np.sqrt((p / PRESSURE_UNIT) ** 2 + c**2 + 1e-24)
        merit = p / PRESSURE_UNIT + c - root
        if max(np.abs(balance).max() / unit, np.abs(merit).max()) < TOLERANCE:
            centre = p.reshape(nx, ny)
            return np.asarray(x, dtype=float), np.asarray((9 * centre[:, 0] - centre[:, 1]) / 8)
        below = scipy.sparse.diags_array((1 - p / PRESSURE_UNIT / root) / PRESSURE_UNIT)
        beside = scipy.sparse.diags_array(1 - c / root)
        matrix = scipy.sparse.block_array([[by_p / unit, by_c / unit], [below, beside]], format="csc")
        change = splu(matrix).solve(-np.concatenate([balance / unit, merit]))
        step = min(1.0, LARGEST_STEP / max(float(np.abs(change[:size]).max()), 1e-300))
        p, c = np.maximum(p + step * change[:size], -pad.ambient), c + step * change[size:]
    raise ConvergenceError(
        f"finite volumes: no balance after {MAX_STEPS} steps; take another grid", outcome=Outcome.UNFINISHED
    )


def _harmonic(first: Array, second: Array) -> Array:
    return np.asarray(2 * first * second / (first + second))


def _balances(
    pad: FinitePad,
    p: Array,
    c: Array,
    inner: Sequence[Faces],
    ends: Sequence[Ends],
    drift: Array,
    index: Cells,
    dy: float,
) -> tuple[Array, Any, Any]:
    """The net flow out of every cell and its derivatives by the pressures and by the cavity fractions."""
    size = p.size
    mobility, density = pad.mobility(p), pad.density(p)
    density_slope = (pad.c2 - 1) * pad.c1 / (pad.c1 + p) ** 2
    mobility_slope = density_slope * np.exp(-pad.barus * p) - pad.barus * mobility
    out = np.zeros(size)
    places: list[tuple[Cells, Cells, Array]] = []
    for a, b, conductance in inner:
        mean, fall = (mobility[a] + mobility[b]) / 2, p[a] - p[b]
        flow = conductance * mean * fall
        by_a = conductance * (mean + mobility_slope[a] / 2 * fall)
        by_b = conductance * (mobility_slope[b] / 2 * fall - mean)
        np.add.at(out, a, flow)
        np.add.at(out, b, -flow)
        places += [(a, a, by_a), (a, b, by_b), (b, a, -by_a), (b, b, -by_b)]
    bath = pad.mobility(pad.ambient)
    for a, conductance in ends:
        mean, fall = (mobility[a] + bath) / 2, p[a] - pad.ambient
        np.add.at(out, a, conductance * mean * fall)
        places.append((a, a, conductance * (mean + mobility_slope[a] / 2 * fall)))
    a, b = index[:-1].ravel(), index[1:].ravel()
    carried = drift * density * (1 - c)
    out += carried
    out[b] -= carried[a]
    out[index[0]] -= pad.speed / 2 * dy * pad.density(pad.ambient) * pad.inlet
    every = index.ravel()
    by_pressure = drift * density_slope * (1 - c)
    places += [(every, every, by_pressure), (b, a, -by_pressure[a])]
    by_cavity = -drift * density
    return out, _matrix(places, size), _matrix([(every, every, by_cavity), (b, a, -by_cavity[a])], size)


def _matrix(places: Sequence[tuple[Cells, Cells, Array]], size: int) -> Any:
    rows, columns, values = (np.concatenate(part) for part in zip(*places, strict=True))
    return scipy.sparse.csc_array((values, (rows, columns)), shape=(size, size))
