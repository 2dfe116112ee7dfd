"""Pockets in the still wall, in rows and columns."""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Annotated, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Coordinate, Length, Part
from roughfilm.rom.cavitation.shape import Shape

Count = Annotated[int, Field(strict=True, ge=1, le=1000)]


class Texture(Part):
    """Equal pockets in rows and columns.

    Attributes
    ----------
    profile : "box" has a flat floor, "cylindrical" a parabola along the sliding direction, "ellipsoidal" one in both
        directions over an elliptical outline.
    length : length of one pocket along the sliding direction, m.
    depth : depth of one pocket, m.
    width : width of one pocket, m; without it grooves over the whole width.
    start : position where the first column begins, m.
    pitch : distance of the columns from centre to centre, m.
    columns : number of columns along the sliding direction.
    pitch_across : distance of the rows from centre to centre, m.
    rows : number of rows across.
    """

    profile: Literal["box", "cylindrical", "ellipsoidal"] = "cylindrical"
    length: Length
    width: Length | None = None
    depth: Length
    start: Coordinate = 0.0
    pitch: Length | None = None
    columns: Count = 1
    pitch_across: Length | None = None
    rows: Count = 1

    @model_validator(mode="after")
    def _do_not_overlap(self) -> Self:
        if self.profile == "ellipsoidal" and self.width is None:
            raise ValueError("width: is missing; an ellipsoidal pocket needs one")
        if self.columns > 1 and (self.pitch is None or self.pitch < self.length):
            raise ValueError(f"pitch: {_got(self.pitch)}; columns of pockets need a pitch of at least their length")
        if self.rows > 1 and (self.width is None or self.pitch_across is None or self.pitch_across < self.width):
            raise ValueError(f"pitch_across: {_got(self.pitch_across)}; rows need a pitch of at least their width")
        if self.depth > self.length:
            raise ValueError(f"depth: got {self.depth!r} m, more than the length of the pocket; check the units")
        return self

    @property
    def spans(self) -> tuple[tuple[float, float], ...]:
        """The start and the end of each column, m."""
        starts = [self.start + number * (self.pitch or 0.0) for number in range(self.columns)]
        return tuple((start, start + self.length) for start in starts)


def _got(value: float | None) -> str:
    return "is missing" if value is None else f"got {value!r} m"


def pocketed(shape: Shape, texture: Texture) -> Shape:
    """The shape of the film with the depth of the pockets added.

    Both ends of each column are breaks, and so are both sides of each row unless the pockets are ellipsoidal.

    Raises
    ------
    ValueError
        If a pocket extends beyond the film.
    """
    low, high = shape.breaks[0], shape.breaks[-1]
    slack = 1e-9 * (high - low)
    first, last = texture.spans[0][0], texture.spans[-1][1]
    if first < low - slack or last > high + slack:
        raise ValueError(
            f"geometry.texture: extends from {first:.6g} to {last:.6g} m; it must stay between 0 and {high!r} m"
        )
    breaks = [*shape.breaks, *(end for span in texture.spans for end in span)]
    if texture.width is not None:
        rows = (texture.rows - 1) * (texture.pitch_across or 0.0) + texture.width
        if shape.wide or rows > (shape.across[1] - shape.across[0]) * (1 + 1e-9):
            raise ValueError(f"geometry.texture: its rows take {rows:.6g} m; give the film a width of at least that")
    sides = [] if texture.profile == "ellipsoidal" else [side for row in _rows(texture, shape.across) for side in row]
    return replace(
        shape,
        steps_across=_distinct(sides, *shape.across, 1e-9 * (shape.across[1] - shape.across[0]))[1:-1],
        breaks=_distinct(breaks, low, high, slack),
        finest=(min(shape.finest[0], texture.length), shape.finest[1] if texture.width is None else texture.width),
        thickness=lambda x, y: shape.thickness(x, y) + _depth(texture, shape.across, x, y),
    )


def _rows(texture: Texture, across: tuple[float, float]) -> list[tuple[float, float]]:
    """The lowest and the highest y of each row, m; no rows of pockets over the whole width."""
    if texture.width is None:
        return []
    pitch = texture.pitch_across or texture.width
    first = (sum(across) - (texture.rows - 1) * pitch - texture.width) / 2
    return [(first + number * pitch, first + number * pitch + texture.width) for number in range(texture.rows)]


def _distinct(places: list[float], low: float, high: float, slack: float) -> tuple[float, ...]:
    sorted_places = [low, *sorted(place for place in places if low + slack < place < high - slack), high]
    return tuple(b for a, b in pairwise([-math.inf, *sorted_places]) if b - a > slack)


def _depth(texture: Texture, across: tuple[float, float], x: Array, y: Array) -> Array:
    """The depth of the pockets at each position, m."""
    along, inside = _in_pocket(x - texture.start, texture.length, texture.pitch or texture.length, texture.columns)
    if texture.width is None:
        beside = np.zeros_like(along)
    else:
        pitch = texture.pitch_across or texture.width
        beside, between = _in_pocket(y - _rows(texture, across)[0][0], texture.width, pitch, texture.rows)
        inside = inside & between
    if texture.profile == "box":
        floor = np.ones_like(along)
    elif texture.profile == "cylindrical":
        floor = 1 - along**2
    else:
        floor = 1 - along**2 - beside**2
    return np.where(inside, texture.depth * np.maximum(floor, 0.0), 0.0)


def _in_pocket(place: Array, length: float, pitch: float, count: int) -> tuple[Array, NDArray[np.bool_]]:
    """The coordinate from -1 to 1 over the nearest pocket, and whether the position is inside it."""
    number = np.clip(np.floor(place / pitch), 0, count - 1)
    within = 2 * (place - number * pitch) / length - 1
    return within, np.abs(within) <= 1
