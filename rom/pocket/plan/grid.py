"""The columns over a cell in plan, with the film thickness at places between their middles."""

import math
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.cavitation.shape import CELLS_PER_FEATURE
from roughfilm.rom.pocket.plan.plan import Plan
from roughfilm.rom.pocket.scene import Pocket

PARTS = 4
"""Number of parts between the middles of two neighbouring columns at whose ends the film thickness is known; even."""

SIMPSON = (1 / 12, 4 / 12, 2 / 12, 4 / 12, 1 / 12)
"""Weights of Simpson's rule at the ``PARTS`` + 1 places from one middle to the next."""

MIN_ACROSS = 16
"""Smallest number of columns across the cell."""

MAX_COLUMNS = 2**20
"""Largest number of columns of a grid."""


@dataclass(frozen=True, kw_only=True)
class PlanGrid:
    """Equal rectangular columns over a periodic cell, in film thicknesses.

    Attributes
    ----------
    x, y : positions of the faces between the columns, shapes (nx + 1,) and (ny + 1,).
    lattice : film thickness at the middles of the columns and at the places between them, which divide the distance of
        two middles into ``PARTS`` along both directions; shape (PARTS nx, PARTS ny), from the first middle on.
    """

    x: Array
    y: Array
    lattice: Array

    @property
    def steps(self) -> tuple[float, float]:
        """Lengths of a column along and across."""
        return float(self.x[1] - self.x[0]), float(self.y[1] - self.y[0])

    @property
    def thickness(self) -> Array:
        """Film thickness at the middles of the columns, shape (nx, ny)."""
        return self.lattice[::PARTS, ::PARTS]


def columns_across(plan: Plan, resolution: int) -> int:
    """The number of columns across a cell with ``resolution`` columns along it: as many per length.

    Raises
    ------
    InputError
        If the cell is so broad that it needs more than ``MAX_COLUMNS`` columns.
    """
    across = max(MIN_ACROSS, round(resolution * plan.breadth / plan.length))
    if resolution * across > MAX_COLUMNS:
        raise InputError(
            f"resolution: {resolution} columns along a cell of {plan.length:.4g} x {plan.breadth:.4g} m need {across} "
            f"across it, in all more than {MAX_COLUMNS}; take a lower resolution, or a part of the cell as its period"
        )
    return across


def fewest_columns(scene: Pocket) -> int:
    """The number of columns along a cell of which none is wider than its narrowest dimple."""
    return math.ceil(scene.geometry.length / scene.geometry.narrowest)


def require_resolved(scene: Pocket, resolution: int) -> None:
    """Refuse so many columns along a cell if its narrowest dimple is narrower than one, and may lie between them.

    Raises
    ------
    InputError
        If it is.
    """
    least = fewest_columns(scene)
    if resolution < least:
        raise InputError(
            f"resolution: got {resolution} columns along the cell, which are wider than the narrowest dimple, "
            f"{scene.geometry.narrowest:.4g} m; take at least {least}, and {CELLS_PER_FEATURE * least} for accuracy"
        )


def plan_grid(plan: Plan, counts: tuple[int, int]) -> PlanGrid:
    """The grid with so many columns along and across the cell."""
    x, y = (
        np.linspace(-side / 2, side / 2, n + 1) for side, n in zip((plan.length, plan.breadth), counts, strict=True)
    )
    lattice_x, lattice_y = (
        faces[0] + (faces[-1] - faces[0]) * (np.arange(PARTS * n) / PARTS + 0.5) / n
        for faces, n in zip((x, y), counts, strict=True)
    )
    thickness = plan.thickness(lattice_x[:, None], lattice_y) / plan.film
    return PlanGrid(
        x=x / plan.film,
        y=y / plan.film,
        lattice=np.ascontiguousarray(np.broadcast_to(thickness, (lattice_x.size, lattice_y.size))),
    )


def between_middles(values: Array, axis: int) -> Array:
    """The mean values from each middle of a column to the next along an axis, of values on the lattice, periodic."""
    return _means(values, axis)


def within_columns(values: Array, axis: int) -> Array:
    """The mean values from face to face of each column along an axis, of values on the lattice, periodic."""
    return _means(np.roll(values, PARTS // 2, axis=axis), axis)


def _means(values: Array, axis: int) -> Array:
    moved = np.moveaxis(values, axis, 0)
    rows = moved.reshape(-1, PARTS, *moved.shape[1:])
    found = SIMPSON[-1] * np.roll(rows[:, 0], -1, axis=0)
    for number, weight in enumerate(SIMPSON[:-1]):
        found += weight * rows[:, number]
    return np.moveaxis(found, 0, axis)


def places_between(values: Array) -> Array:
    """The values at the places from each middle to the next along the cell, both included, periodic.

    The shape (PARTS nx, ny) becomes (nx, PARTS + 1, ny).
    """
    rows = values.reshape(-1, PARTS, values.shape[1])
    return np.concatenate([rows, np.roll(rows[:, :1], -1, axis=0)], axis=1)


def running_means(values: Array) -> Array:
    """The integrals from each middle to the places up to the next one, over the distance of two middles.

    Parabolas through three places are integrated, so that the last integral is that of Simpson's rule. The shape
    (nx, PARTS + 1, ny) stays.
    """
    found = np.zeros_like(values)
    for place in range(0, PARTS, 2):
        first, middle, last = (values[:, place + number] for number in range(3))
        found[:, place + 1] = found[:, place] + (5 * first + 8 * middle - last) / (12 * PARTS)
        found[:, place + 2] = found[:, place] + (first + 4 * middle + last) / (3 * PARTS)
    return found
