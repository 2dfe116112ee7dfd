"""The scene entries of a periodic cell with dimples in its fixed wall."""

import math
from functools import lru_cache
from itertools import pairwise, product
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Length, Part
from roughfilm.rom.pocket.geometry import in_film_thicknesses
from roughfilm.rom.pocket.plan.dimples import AnyDimple, Dimple
from roughfilm.rom.pocket.plan.plan import Plan

MAX_DIMPLES = 100
"""Largest number of dimples in a cell."""

SAME = 1e-9
"""Distance over the cell, or difference of depth over the depth, below which two values are equal."""

SAMPLES = (193, 180)
"""Numbers of places along and across at which a cell is compared with its mirror image and its covered area counted."""


class PlanGeometry(Part):
    """A periodic cell of a film whose fixed wall has dimples; lengths in m.

    Where dimples overlap, the deeper one counts.

    Attributes
    ----------
    length : length of the cell along the sliding direction, m.
    breadth : breadth of the cell across the sliding direction, m.
    film : film thickness outside of the dimples, m.
    arrangement : "aligned", or "staggered" for a copy of every dimple half a cell further along and across.
    dimples : the dimples, a table each.
    """

    length: Length
    breadth: Length
    film: Length
    arrangement: Literal["aligned", "staggered"] = "aligned"
    dimples: Annotated[
        tuple[Annotated[AnyDimple, Field(discriminator="shape")], ...], Field(min_length=1, max_length=MAX_DIMPLES)
    ]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        in_film_thicknesses("length", self.length / self.film, 1e-2)
        in_film_thicknesses("breadth", self.breadth / self.film, 1e-2)
        for number, one in enumerate(self.dimples):
            place = f"dimples.{number}."
            for extent, (axis, side) in zip(
                one.half_spans, (("length", self.length), ("breadth", self.breadth)), strict=True
            ):
                if math.isfinite(extent) and 2 * extent > side * (1 + SAME):
                    raise ValueError(
                        f"{place}width: got an extent of {2 * extent:.4g} m along the {axis} of the cell; it must "
                        f"be at most {side!r} m, make it smaller or the cell larger"
                    )
            in_film_thicknesses(f"{place}width", min(one.extents) / self.film, 1e-2)
            in_film_thicknesses(f"{place}depth", one.greatest_depth / self.film, 1e-9)
        return self

    @property
    def depth(self) -> float:
        """Depth of the deepest dimple, m."""
        return max(one.greatest_depth for one in self.dimples)

    @property
    def narrowest(self) -> float:
        """The least extent of a dimple, m."""
        return min(min(one.extents) for one in self.dimples)

    @property
    def aspect(self) -> float:
        """The largest ratio of depth to half of the least extent of the dimples."""
        return max(2 * one.greatest_depth / min(one.extents) for one in self.dimples)

    @property
    def slope(self) -> float:
        """Mean slope of the steepest dimple between its rim and its greatest depth."""
        return max(one.slope for one in self.dimples)

    @property
    def covered(self) -> float:
        """The part of the cell that dimples cover, from the depths at 193 x 180 places."""
        return float((self._sampled() > 0).mean())

    def places(self) -> tuple[tuple[Dimple, float, float], ...]:
        """Every dimple of the cell with the position of its middle, m."""
        shifts = [(0.0, 0.0)]
        if self.arrangement == "staggered":
            shifts.append((self.length / 2, self.breadth / 2))
        return tuple((one, one.place[0] + dx, one.place[1] + dy) for dx, dy in shifts for one in self.dimples)

    def depth_at(self, x: Array, y: Array) -> Array:
        """Depth below the land, m, at places in any period; ``x`` and ``y`` in m are broadcast."""
        x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        deepest = np.zeros(np.broadcast_shapes(x.shape, y.shape))
        for one, middle_x, middle_y in self.places():
            rotation, depth = one.place[2], one.depth_function()
            near_x = x - middle_x - self.length * np.round((x - middle_x) / self.length)
            near_y = y - middle_y - self.breadth * np.round((y - middle_y) / self.breadth)
            c, s = math.cos(rotation), math.sin(rotation)
            for dx, dy in self._shifts(one):
                along, across = near_x + dx, near_y + dy
                if rotation:
                    along, across = c * along + s * across, c * across - s * along
                np.maximum(deepest, depth(along, across), out=deepest)
        return deepest

    def _shifts(self, one: Dimple) -> tuple[tuple[float, float], ...]:
        """Shifts from the nearest copy of a dimple to those that may reach the same place, m."""

        def along(side: float, reach: float) -> tuple[float, ...]:
            return (-side, 0.0, side) if math.isfinite(reach) and 2 * reach > side * (1 + SAME) else (0.0,)

        reach = one.reach
        return tuple(product(along(self.length, reach[0]), along(self.breadth, reach[1])))

    def plan(self) -> Plan:
        """The gap between the wall with dimples and the sliding one."""
        return _plan_of(self)

    def breaks(self, axis: int) -> tuple[float, ...]:
        """The edges and middles of the dimples along an axis, moved into the period, increasing."""
        side = (self.length, self.breadth)[axis]
        found = []
        for one, *middle in self.places():
            half = one.half_spans[axis]
            if math.isfinite(half):
                found += [middle[axis] + part * half for part in (-1, 0, 1)]
        moved = sorted(place - side * round(place / side) for place in found)
        apart = [place for before, place in pairwise([-math.inf, *moved]) if place - before > SAME * side]
        if len(apart) > 1 and apart[0] + side - apart[-1] <= SAME * side:
            apart.pop()
        return tuple(apart)

    def _sampled(self, sign: int = 1) -> Array:
        """Depths at places of the cell, or of its mirror image for ``sign`` -1; m."""
        x, y = ((np.arange(number) + 0.37) / number - 0.5 for number in SAMPLES)
        return self.depth_at(self.length * x[:, None], sign * self.breadth * y)

    def is_mirrored(self) -> bool:
        """Whether the cell is its own mirror image about y = 0."""
        return bool(np.abs(self._sampled() - self._sampled(-1)).max() <= SAME * self.depth)


@lru_cache(maxsize=8)
def _plan_of(geometry: PlanGeometry) -> Plan:
    return Plan(
        length=geometry.length,
        breadth=geometry.breadth,
        film=geometry.film,
        thickness=lambda x, y: geometry.film + geometry.depth_at(x, y),
        breaks_x=geometry.breaks(0),
        breaks_y=geometry.breaks(1),
        mirrored=geometry.is_mirrored(),
        smallest=min(one.smallest for one in geometry.dimples),
    )
