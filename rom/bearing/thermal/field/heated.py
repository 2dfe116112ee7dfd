"""The temperatures of a film and its heat flows, of any model of them."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.thermal.field.nodal import between_nodes
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.temperature.dissipation import flowing

SAME = 1e-4
"""Difference of two temperatures over the rise of the temperature in the film, below which both are the largest."""

ROUNDED = 9
"""Decimals to which distances from the middle of the width are compared."""


@dataclass(frozen=True, kw_only=True)
class Mixture:
    """The lubricant at the inlet.

    Attributes
    ----------
    temperature : temperature at the inlet, K.
    error : difference of the mixture of new and hot lubricant from it, K.
    slope : change of the mixture with the temperature at the inlet, by what returns.
    response : change of ln η_p, ln η_s and s at the nodes with the temperature at the inlet, 1/K, shape (3, nx, ny);
        None if it is not known.
    """

    temperature: float
    error: float
    slope: float
    response: Array | None = None

    @property
    def following(self) -> float:
        """The temperature at the inlet, K, that is expected to be that of its mixture."""
        return self.temperature + self.error / (1 - self.slope)


@dataclass(frozen=True, kw_only=True)
class HeatedFilm:
    """The temperatures of a film; heat flows in W (W/m if infinitely wide).

    generated = to_lubricant + to_fixed_wall + to_sliding_wall, but for ``imbalance``.

    Attributes
    ----------
    grid : the grid of the film.
    temperature : mean temperature of the lubricant across the film at the nodes, K, shape (nx, ny).
    viscosities : viscosities at the nodes.
    highest : largest temperature in the film, K.
    place : position (x, y) of the largest temperature, in the coordinates of the problem.
    inlet : the mixture at the inlet; None of films without an inlet or without returning lubricant.
    outlet : temperature of the lubricant that leaves the film, K; None if none leaves.
    generated : power that becomes heat.
    to_lubricant : heat that the lubricant takes away.
    imbalance : error of the heat balance over the heat flows.
    to_fixed_wall, to_sliding_wall : heat into the walls; None of walls that take no heat.
    shaft : temperature of a turning shaft, K; None of another wall.
    friction : coefficient of boundary friction; None without asperities.
    walls : temperatures of walls at the nodes, K, shape (nx, ny), by the name of the field.
    start : what the next iteration starts from.
    settled : whether the energy equation is solved to its tolerance, and the mixture at the inlet is that of the film.
    slopes : limited slopes of the temperature, of models that keep them.
    films : number of films on this grid up to this one, each with temperatures from those of the one before.
    """

    grid: Grid
    temperature: Array
    viscosities: Viscosities
    highest: float
    place: tuple[float, float]
    inlet: Mixture | None
    outlet: float | None
    generated: float
    to_lubricant: float
    imbalance: float
    to_fixed_wall: float | None = None
    to_sliding_wall: float | None = None
    shaft: float | None = None
    friction: float | None = None
    walls: Mapping[str, Array] = field(default_factory=dict)
    start: object = None
    settled: bool = True
    slopes: tuple[Array, Array] | None = None
    films: int = 1


def hottest(temperature: Array, solution: Solution) -> tuple[float, tuple[float, float]]:
    """The largest temperature where lubricant flows, K, and its position (x, y).

    The position is the first along, and there the nearest to the middle.
    """
    grid, flows = solution.grid, flowing(solution)
    most = float(temperature[flows].max())
    hot = flows & (temperature >= most - SAME * (most - float(temperature.min())))
    i = int(np.argmax(hot.any(axis=1)))
    rows = np.flatnonzero(hot[i])
    middle = float(grid.y[0] + grid.y[-1]) / 2
    j = rows[int(np.argmin(np.round(np.abs(grid.y[rows] - middle) / (abs(middle) or 1.0), ROUNDED)))]
    return most, (float(grid.x[i]), float(grid.y[j]))


def start_of(near: HeatedFilm | None, solution: Solution) -> Array | None:
    """The mean temperatures of a film at the nodes of another one, K; None without a film."""
    if near is None:
        return None
    if near.temperature.shape == solution.grid.shape:
        return near.temperature
    x, y = np.meshgrid(solution.grid.x, solution.grid.y, indexing="ij")
    found = between_nodes(near.temperature, near.grid, solution.problem.shape.joined, x.ravel(), y.ravel())
    return found.reshape(solution.grid.shape)
