"""The dimples of a scene file, one class for each shape."""

import math
from pathlib import Path
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import BeforeValidator, PlainSerializer, model_validator

from roughfilm.contact.foundation.entries import Angle, Coordinate, InUnit, Length, Part
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import RANGES
from roughfilm.rom.pocket.groove import cylindrical
from roughfilm.rom.pocket.plan import shapes
from roughfilm.rom.pocket.plan.shapes import Depth

MIN_POINTS, MAX_POINTS = 3, 128
"""Smallest and largest number of points of a map along each side."""

MAX_SLOPE = 100.0
"""Largest slope of a ramp: the walls of steeper ones are vertical, and a film over them is not thin."""

MAX_ANGLE = math.radians(80)
"""Largest angle of the arms of a chevron to the direction across the sliding."""

Rounding = Annotated[float, InUnit("m", any_sign=True)]

Depths = tuple[tuple[float, ...], ...]


class Dimple(Part):
    """A dimple with its middle at a place of the cell; lengths in m.

    Attributes
    ----------
    position : distance of its middle from that of the cell along the sliding direction, m.
    """

    position: Coordinate = 0.0

    @property
    def place(self) -> tuple[float, float, float]:
        """The position of its middle along and across the sliding direction, m, and its rotation, rad."""
        return self.position, 0.0, 0.0

    @property
    def extents(self) -> tuple[float, float]:
        """Its extents along and across the sliding direction before rotation, m."""
        raise NotImplementedError

    @property
    def greatest_depth(self) -> float:
        """Its greatest depth, m."""
        raise NotImplementedError

    @property
    def ramp(self) -> float:
        """Distance over which the wall falls from the rim to the greatest depth, m."""
        return min(self.extents) / 2

    @property
    def slope(self) -> float:
        """Mean slope of the wall between the rim and the greatest depth."""
        return self.greatest_depth / self.ramp

    @property
    def smallest(self) -> float:
        """The least of its extents and of the width of its rim, m."""
        return min(*self.extents, self.ramp)

    @property
    def half_spans(self) -> tuple[float, float]:
        """Half of its extents along x and y after rotation, m."""
        (a, b), angle = self.extents, self.place[2]
        c, s = abs(math.cos(angle)), abs(math.sin(angle))
        return (a * c + b * s) / 2, (a * s + b * c) / 2

    @property
    def reach(self) -> tuple[float, float]:
        """Distances along x and y from its middle at which its depth ends, with the rounding of its rim, m."""
        return self.half_spans

    def depth_function(self) -> Depth:
        """The depth over the distances along and across from its middle before rotation."""
        raise NotImplementedError


class _Turned(Dimple):
    """A dimple that may be turned, anywhere in the cell.

    Attributes
    ----------
    position_across : distance of its middle from that of the cell across the sliding direction, m.
    rotation : angle by which it is turned about its middle, from the sliding direction towards y.
    """

    position_across: Coordinate = 0.0
    rotation: Angle = 0.0

    @property
    def place(self) -> tuple[float, float, float]:
        """The position of its middle along and across the sliding direction, m, and its rotation, rad."""
        return self.position, self.position_across, self.rotation


class _Round(_Turned):
    """A dimple with an elliptical outline.

    Attributes
    ----------
    width : extent along the sliding direction before rotation, m.
    depth : greatest depth, m.
    edge : width over which the rim is rounded, m; by default the rim is sharp.
    """

    width: Length
    depth: Length
    edge: Rounding = 0.0

    @property
    def extents(self) -> tuple[float, float]:
        """Its extents along and across the sliding direction before rotation, m."""
        return self.width, getattr(self, "breadth", self.width)

    @property
    def greatest_depth(self) -> float:
        """Its greatest depth, m."""
        return self.depth

    @property
    def smallest(self) -> float:
        """The least of its extents and of the rounding of its rim, m."""
        return min(*self.extents, self.edge or math.inf)

    @property
    def half_spans(self) -> tuple[float, float]:
        """Half of its extents along x and y after rotation, m."""
        (a, b), c, s = self.extents, math.cos(self.rotation), math.sin(self.rotation)
        return math.hypot(a * c, b * s) / 2, math.hypot(a * s, b * c) / 2

    @property
    def reach(self) -> tuple[float, float]:
        """Distances along x and y from its middle at which its depth ends, with the rounding of its rim, m."""
        along, across = self.half_spans
        wider = 1 + self.edge / min(self.extents)
        return along * wider, across * wider

    @property
    def largest_edge(self) -> float:
        """Width of the rounding, m, above which it would make the dimple deeper."""
        return min(self.extents) / 2

    @model_validator(mode="after")
    def _rounding_fits(self) -> Self:
        if not 0 <= self.edge <= self.largest_edge:
            raise ValueError(
                f"edge: got {self.edge!r} m; it must be 0 to {self.largest_edge:.9g} m, a wider rounding would "
                "make the dimple deeper"
            )
        return self


class _Cap(_Round):
    """A dimple whose wall is a part of an ellipsoid.

    Attributes
    ----------
    width : extent along the sliding direction before rotation, m.
    depth : greatest depth, at most half of the smaller extent, m.
    edge : width over which the rim is rounded, m; by default the rim is sharp.
    """

    @property
    def largest_edge(self) -> float:
        """Width of the rounding above which it would make the cap deeper, (a² - d²)/a with a half of the extent, m."""
        half = min(self.extents) / 2
        return max(0.0, half - self.depth**2 / half)

    @model_validator(mode="after")
    def _at_most_a_half(self) -> Self:
        if self.depth > min(self.extents) / 2:
            raise ValueError(
                f"depth: got {self.depth!r} m; the cap would be more than a half ellipsoid, it must be at most half of "
                f"the smaller extent, {min(self.extents) / 2!r} m"
            )
        return self

    def depth_function(self) -> Depth:
        """The depth over the distances along and across from its middle before rotation."""
        width, breadth = self.extents
        return shapes.ellipsoidal(width=width, breadth=breadth, depth=self.depth, edge=self.edge)


class Spherical(_Cap):
    """A spherical cap.

    Attributes
    ----------
    shape : "spherical".
    """

    shape: Literal["spherical"]


class Ellipsoidal(_Cap):
    """A spherical cap that is stretched to an ellipse as outline.

    Attributes
    ----------
    shape : "ellipsoidal".
    breadth : extent across the sliding direction before rotation, m.
    """

    shape: Literal["ellipsoidal"]
    breadth: Length


class Conical(_Round):
    """A cone.

    Attributes
    ----------
    shape : "conical".
    """

    shape: Literal["conical"]

    def depth_function(self) -> Depth:
        """The depth over the distances along and across from its middle before rotation."""
        return shapes.conical(width=self.width, depth=self.depth, edge=self.edge)


class _Flat(_Turned):
    """A dimple with a flat floor and a ramp inside its outline.

    Attributes
    ----------
    width : extent along the sliding direction before rotation, m.
    breadth : extent across the sliding direction before rotation, m.
    depth : greatest depth, m.
    edge : width of the ramp between the rim and the floor, m; a vertical wall has no thin film.
    """

    width: Length
    breadth: Length
    depth: Length
    edge: Length

    @property
    def extents(self) -> tuple[float, float]:
        """Its extents along and across the sliding direction before rotation, m."""
        return self.width, self.breadth

    @property
    def greatest_depth(self) -> float:
        """Its greatest depth, m."""
        return self.depth

    @property
    def ramp(self) -> float:
        """Width of the ramp, m."""
        return self.edge

    @property
    def narrowest(self) -> float:
        """The extent of the floor and both ramps where it is least, m."""
        return min(self.extents)

    @model_validator(mode="after")
    def _ramp_fits(self) -> Self:
        least, most = self.depth / MAX_SLOPE, self.narrowest / 2
        if not least <= self.edge <= most:
            raise ValueError(
                f"edge: got {self.edge!r} m; it must be {least:.4g} m (a slope of {MAX_SLOPE:g}) to {most:.4g} m, half "
                "of the least extent"
            )
        return self


class Box(_Flat):
    """A rectangle with a flat floor.

    Attributes
    ----------
    shape : "box".
    """

    shape: Literal["box"]

    def depth_function(self) -> Depth:
        """The depth over the distances along and across from its middle before rotation."""
        return shapes.box(width=self.width, breadth=self.breadth, depth=self.depth, edge=self.edge)


class Chevron(_Flat):
    """A V of two arms with a flat floor, whose tip points against the sliding direction.

    Attributes
    ----------
    shape : "chevron".
    width : width of each arm along the sliding direction before rotation, m.
    angle : angle of the arms to the direction across the sliding, at most 80 degrees.
    """

    shape: Literal["chevron"]
    angle: Annotated[float, InUnit("rad")]

    @property
    def extents(self) -> tuple[float, float]:
        """Its extents along and across the sliding direction before rotation, m."""
        return self.width + math.tan(self.angle) * self.breadth / 2, self.breadth

    @property
    def narrowest(self) -> float:
        """The extent of the floor and both ramps where it is least, m."""
        return min(self.width * math.cos(self.angle), self.breadth)

    @model_validator(mode="after")
    def _opens(self) -> Self:
        if self.angle > MAX_ANGLE:
            raise ValueError(f"angle: got {math.degrees(self.angle):.4g} degrees; it must be at most 80 degrees")
        return self

    def depth_function(self) -> Depth:
        """The depth over the distances along and across from its middle before rotation."""
        return shapes.chevron(
            width=self.width, breadth=self.breadth, depth=self.depth, edge=self.edge, angle=self.angle
        )


def checked(depths: object) -> Depths:
    """The map of depths from rows of numbers in m, or from the file of that name.

    Raises
    ------
    ValueError
        If the map is no rectangle of 3 to 128 points along each side, a depth is negative or not finite, one on the
        border is not 0, or the file cannot be read.
    """
    if isinstance(depths, str):
        from roughfilm.contact.surfaces.files import read_surface  # slow to import

        try:
            return checked(read_surface(Path(depths), spacing=(1.0, 1.0), height_unit="m", lists=False).heights)
        except (InputError, ValueError) as error:
            raise ValueError(f"file {depths!r:.200}: {error}") from error
    try:
        values = np.array(depths, dtype=float)
    except (TypeError, ValueError):
        raise ValueError(f"got {depths!r:.60}; name a file, or give rows of depths in m, all of one length") from None
    if values.ndim != 2 or not all(MIN_POINTS <= number <= MAX_POINTS for number in values.shape):
        raise ValueError(
            f"got an array of shape {values.shape}; a map has {MIN_POINTS} to {MAX_POINTS} points along each side"
        )
    if not (np.isfinite(values).all() and values.min() >= 0 < values.max() and values.max() in RANGES["m"]):
        raise ValueError(
            f"got depths from {values.min():.4g} to {values.max():.4g} m; depth counts downward and is never negative, "
            f"and the greatest must be {RANGES['m']}"
        )
    border = max(values[[0, -1]].max(), values[:, [0, -1]].max())
    if border > 0:
        raise ValueError(f"got a depth of {border:.4g} m on the border of the map; a dimple ends with depth 0")
    return tuple(tuple(map(float, row)) for row in values)


class Mapped(_Turned):
    """A map of depths at points, bilinear between them.

    Attributes
    ----------
    shape : "points".
    width : extent of the map along the sliding direction before rotation, m.
    breadth : extent of the map across the sliding direction before rotation, m.
    points : depths in m, a row for each place along the sliding direction, evenly spaced from border to border, or the
        name of an NPY or CSV file; 0 on the border.
    """

    shape: Literal["points"]
    width: Length
    breadth: Length
    points: Annotated[Depths, BeforeValidator(checked), PlainSerializer(lambda rows: [list(row) for row in rows])]

    @property
    def extents(self) -> tuple[float, float]:
        """Its extents along and across the sliding direction before rotation, m."""
        return self.width, self.breadth

    @property
    def greatest_depth(self) -> float:
        """Its greatest depth, m."""
        return max(map(max, self.points))

    @property
    def slope(self) -> float:
        """The greatest slope between neighbouring points along one of its sides."""
        values = np.array(self.points)
        steps = self.width / (values.shape[0] - 1), self.breadth / (values.shape[1] - 1)
        return float(max(np.abs(np.diff(values, axis=axis)).max() / step for axis, step in enumerate(steps)))

    def depth_function(self) -> Depth:
        """The depth over the distances along and across from its middle before rotation."""
        return shapes.mapped(width=self.width, breadth=self.breadth, depths=self.points)


class Groove(Dimple):
    """A groove over the whole breadth of the cell, whose wall is a circular arc.

    Attributes
    ----------
    shape : "groove".
    width : width along the sliding direction, m.
    depth : greatest depth, at most half of the width, m.
    """

    shape: Literal["groove"]
    width: Length
    depth: Length

    @property
    def extents(self) -> tuple[float, float]:
        """Its extents along and across the sliding direction, m."""
        return self.width, math.inf

    @property
    def half_spans(self) -> tuple[float, float]:
        """Half of its extents along and across the sliding direction, m."""
        return self.width / 2, math.inf

    @property
    def greatest_depth(self) -> float:
        """Its greatest depth, m."""
        return self.depth

    @model_validator(mode="after")
    def _at_most_a_half_circle(self) -> Self:
        if self.depth > self.width / 2:
            raise ValueError(
                f"depth: got {self.depth!r} m; the arc would be more than a half circle, it must be at most "
                f"width / 2 = {self.width / 2!r} m"
            )
        return self

    def depth_function(self) -> Depth:
        """The depth over the distances along and across from its middle."""
        arc = cylindrical(width=self.width, depth=self.depth)
        return lambda s, t: arc.depth(s) + 0 * t


AnyDimple = Spherical | Ellipsoidal | Conical | Box | Chevron | Groove | Mapped
SHAPES: dict[str, type[Part]] = {
    "spherical": Spherical,
    "ellipsoidal": Ellipsoidal,
    "conical": Conical,
    "box": Box,
    "chevron": Chevron,
    "groove": Groove,
    "points": Mapped,
}
