"""Lines and outlines in a cell in plan, and the values of fields on them."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.pocket.plan.dimples import Dimple
from roughfilm.rom.pocket.plan.geometry import SAME, PlanGeometry
from roughfilm.rom.pocket.scene import Pocket

SAMPLES = 1201
"""Places along the cell at which the edges of dimples are sought."""

MIN_DEPTH = 1e-3
"""Smallest depth that counts as a part of a dimple, over the greatest depth."""


def deepest_dimple(scene: Pocket) -> tuple[Dimple, float, float]:
    """The deepest dimple and the position of its middle in the cell, m; of several the one nearest to y = 0."""
    geometry = scene.geometry
    assert isinstance(geometry, PlanGeometry)
    found = [
        (one, x - geometry.length * round(x / geometry.length), y - geometry.breadth * round(y / geometry.breadth))
        for one, x, y in geometry.places()
        if one.greatest_depth >= (1 - SAME) * geometry.depth
    ]
    return min(found, key=lambda place: (abs(place[2]), abs(place[1])))


def middle_line(scene: Pocket) -> float:
    """The position y, m, of the line along the cell through the middle of the deepest dimple."""
    return deepest_dimple(scene)[2]


def edges_on(scene: Pocket, y: float) -> tuple[float, ...]:
    """The positions x, m, where the line at y enters or leaves a dimple, increasing."""
    plan = scene.plan()
    x = np.linspace(-plan.length / 2, plan.length / 2, SAMPLES)
    inside = plan.thickness(x, np.array(y)) > plan.film + MIN_DEPTH * scene.geometry.depth
    return tuple(float(one) for one in (x[1:] + x[:-1])[inside[1:] != inside[:-1]] / 2)


def along(scene: Pocket, result: Result, field: str, y: float) -> tuple[Array, Array]:
    """The positions x from one end of the cell to the other, m, and the values of a field there on the line at y."""
    length, breadth = scene.geometry.length, scene.plan().breadth
    places, values = result.fields["x"].values[:, 0], result.fields[field].values
    on_line = between(result.fields["y"].values[0], values, y, breadth)
    end = between(places, on_line[None], length / 2, length)
    return np.concatenate([[-length / 2], places, [length / 2]]), np.concatenate([end, on_line, end])


def between(places: Array, values: Array, y: float, period: float) -> Array:
    """Values (nx, ny, ...) at increasing places (ny,), at one place y of the period; linear, shape (nx, ...)."""
    around = np.concatenate([places[-1:] - period, places, places[:1] + period])
    column = np.concatenate([[-1], np.arange(places.size), [0]])
    right = int(np.clip(np.searchsorted(around, y), 1, places.size + 1))
    part = (y - around[right - 1]) / (around[right] - around[right - 1])
    return np.asarray((1 - part) * values[:, column[right - 1]] + part * values[:, column[right]])
