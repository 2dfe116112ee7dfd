"""The truth of a wedge with temperatures: finite differences that share no code with the models, on three grids.

With ζ = z/h from the sliding wall the flow of a cell is that of the velocity ∫ τ/η dz from the wall. The energy of the
cells is marched along the film (implicit, upwind), and the flow q follows from ∫ dp/dx dx = 0.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_banded
from scipy.optimize import brentq

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.ladder import models
from roughfilm.rom.bearing.geometry.shapes import Linear
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.tables import GivenTemperature, Heat
from scripts.studies.coverage.truth import Truth

COLUMNS = (100, 200, 400)
"""Numbers of cells along the film, four times those across it."""

RELAXED, SWEEPS, SETTLED = 0.6, 300, 1e-7
"""Part of a change of temperature that is taken, largest number of marches, and relative change at which they end."""

FLOOR = 5e-4
"""Relative uncertainty besides that of the extrapolation."""


@dataclass(frozen=True, kw_only=True)
class Wedge:
    """A film that narrows linearly, between walls that take no heat (None) or are warmer than the supply, K."""

    length: float
    film: float
    rise: float
    speed: float
    viscosity: float
    thinning: float
    capacity: float
    conductivity: float
    sliding: float | None = None
    fixed: float | None = None


def wedge_of(scene: Bearing) -> Wedge:
    """Return the wedge of a scene with an exponential law of the viscosity."""
    lubricant, heat = scene.lubricant, scene.heat or Heat()
    supplied = np.array([lubricant.liquid.temperature])
    viscosity, slope = (float(one[0]) for one in lubricant.viscosity_at(supplied))
    walls = [
        wall.temperature - float(supplied[0]) if isinstance(wall, GivenTemperature) else None
        for wall in (heat.sliding_wall, heat.fixed_wall)
    ]
    geometry = scene.geometry
    assert lubricant.conductivity is not None
    assert isinstance(geometry, Linear)
    return Wedge(
        length=geometry.length,
        film=geometry.thinnest,
        rise=geometry.rise,
        speed=scene.motion.speed,
        viscosity=viscosity,
        thinning=-slope / viscosity,
        capacity=float(lubricant.heat_at(supplied)[1][0]),
        conductivity=lubricant.conductivity,
        sliding=walls[0],
        fixed=walls[1],
    )


def marched(wedge: Wedge, columns: int) -> dict[str, float]:
    """Return load and friction, N/m, and the highest and the outflow temperature above the supply, K.

    Raises
    ------
    ConvergenceError
        If lubricant flows back, or the temperature does not settle.
    """
    rows = columns // 4
    x = np.linspace(0, wedge.length, columns + 1)
    h = wedge.film + wedge.rise * (1 - x / wedge.length)
    centres = (np.arange(rows) + 0.5) / rows
    z, dz = centres * h[:, None], h[:, None] / rows
    temperature = np.zeros((columns + 1, rows))
    for _ in range(SWEEPS):
        eta = wedge.viscosity * np.exp(-wedge.thinning * temperature)
        f0, f1 = (dz / eta).sum(axis=1), (z * dz / eta).sum(axis=1)
        f2 = ((z**2 + dz**2 / 12) * dz / eta).sum(axis=1)

        def slope(flow: float, f0: Array = f0, f1: Array = f1, f2: Array = f2) -> Array:
            return np.asarray((wedge.speed * f1 - flow * f0) / (f0 * f2 - f1**2))

        flow = float(brentq(lambda q: float(np.trapezoid(slope(q), x)), 0.0, wedge.speed * h[0]))
        gradient = slope(flow)
        wall = (-wedge.speed - gradient * f1) / f0
        stress = wall[:, None] + gradient[:, None] * z
        edges = wedge.speed + np.pad(np.cumsum(stress / eta * dz, axis=1), ((0, 0), (1, 0)))
        through = (edges[:, 1:] + edges[:, :-1]) / 2 * dz
        through *= flow / through.sum(axis=1, keepdims=True)
        heat = stress**2 / eta * dz / wedge.capacity
        found = _carried(wedge, x, h, through, heat, temperature)
        change = float(np.abs(found - temperature).max())
        temperature = temperature + RELAXED * (found - temperature)
        if change < SETTLED * max(float(found.max()), 1e-3):
            break
    else:
        raise ConvergenceError(f"wedge: its temperature still changes by {change:.2g} K")
    if through.min() < 0:
        raise ConvergenceError("wedge: lubricant flows back, against the march")
    pressure = np.concatenate([[0.0], np.cumsum((gradient[1:] + gradient[:-1]) / 2 * np.diff(x))])
    at_walls = [
        1.5 * temperature[:, first] - 0.5 * temperature[:, second]
        for given, first, second in ((wedge.sliding, 0, 1), (wedge.fixed, -1, -2))
        if given is None
    ]
    return {
        "load_per_width": float(np.trapezoid(pressure, x)),
        "friction_per_width": float(-np.trapezoid(wall, x)),
        "temperature_max": max(float(one.max()) for one in (temperature, *at_walls)),
        "outlet_temperature": float(through[-1] @ temperature[-1] / flow),
    }


def _carried(wedge: Wedge, x: Array, h: Array, through: Array, heat: Array, known: Array) -> Array:
    """Return the temperatures of a march along the film, whose heat follows its viscosity from known temperatures."""
    rows = through.shape[1]
    below = np.pad(np.cumsum(through, axis=1), ((0, 0), (1, 0)))
    found = np.zeros_like(through)
    diffusivity = wedge.conductivity / wedge.capacity
    for n in range(1, x.size):
        step, up = x[n] - x[n - 1], below[n - 1] - below[n]
        conducted = np.full(rows + 1, diffusivity * step * rows / h[n])
        conducted[[0, -1]] = [2 * conducted[0] * (given is not None) for given in (wedge.sliding, wedge.fixed)]
        rising, falling = np.maximum(up, 0) + conducted, np.maximum(-up, 0) + conducted
        bands = np.zeros((3, rows))
        bands[0, 1:], bands[2, :-1] = -falling[1:-1], -rising[1:-1]
        follows = wedge.thinning * heat[n] * step
        bands[1] = through[n] + rising[1:] + falling[:-1] + follows
        right = through[n - 1] * found[n - 1] + heat[n] * step + follows * known[n]
        right[0] += rising[0] * (wedge.sliding or 0.0)
        right[-1] += falling[-1] * (wedge.fixed or 0.0)
        found[n] = solve_banded((1, 1), bands, right)
    return found


def truth(scene: Bearing) -> Truth:
    """Return the numbers of a wedge, extrapolated at the first order of the march, in the units of the models.

    Raises
    ------
    ConvergenceError
        If lubricant flows back, or the temperature does not settle.
    """
    wedge = wedge_of(scene)
    coarse, middle, fine = (marched(wedge, columns) for columns in COLUMNS)
    supplied = scene.lubricant.liquid.temperature - ZERO_CELSIUS
    values = {name: 2 * fine[name] - middle[name] for name in fine}
    uncertainty = {
        name: abs(value - (2 * middle[name] - coarse[name])) + FLOOR * abs(value) for name, value in values.items()
    }
    assert all(math.isfinite(value) for value in values.values())
    return Truth(
        values={name: value + (supplied if "temperature" in name else 0.0) for name, value in values.items()},
        uncertainty=uncertainty,
        method=f"finite differences on {COLUMNS[-1]} × {COLUMNS[-1] // 4} cells, extrapolated",
        own={model.name: {} for model in models(scene.kind)},
    )
