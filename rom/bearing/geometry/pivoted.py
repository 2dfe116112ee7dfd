"""Pads that tilt about a pivot: rectangles, and the sectors of thrust bearings."""

import math
from collections.abc import Iterator
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Angle, Length, plain_number
from roughfilm.rom.bearing.geometry.pad import Pad, known_film
from roughfilm.rom.bearing.geometry.rigid import MovingWall, RigidWall
from roughfilm.rom.bearing.geometry.ring import FITTING, Ring
from roughfilm.rom.bearing.geometry.ring import Angle as PositiveAngle
from roughfilm.rom.bearing.geometry.texture import pocketed
from roughfilm.rom.cavitation.shape import Shape

SAMPLES = 721
"""Number of positions along a pad at which its least film is sought."""


def _pivot(given: object) -> tuple[float, float]:
    """The position of the pivot along and across; in the middle of the width by default."""
    values = list(given) if isinstance(given, list | tuple) else [given, 0.5]
    if len(values) != 2:
        raise ValueError(f"got {given!r:.60}; write one or two fractions, such as 0.58 or [0.58, 0.5]")
    numbers = plain_number(values[0]), plain_number(values[1])
    if not all(0 <= number <= 1 for number in numbers):
        raise ValueError(f"got {given!r:.60}; both fractions must be 0 to 1")
    return numbers


class Tilting(MovingWall):
    """A pad that tilts about a pivot, in equilibrium of force and moments or with given slopes.

    With the distances ξ along the sliding and ζ across it from the pivot, the film thickness is

        h = h_p + s_x ξ + s_y ζ + δ ((2 φ - 1)² - (2 φ_p - 1)²)

    with the film h_p at the pivot, the slopes s, the crown δ, and the position φ along the pad, 0 to 1, which is φ_p at
    the pivot.

    Attributes
    ----------
    pivot : position of the pivot along and across the pad, 0 to 1 each, from the inlet and from the first side; a
        single number is that along the pad, in the middle of its width.
    line : whether the pivot is a line across the sliding, about which alone the pad tilts; else it is a point.
    crown : height of the crown: the film at the ends of a pad without slopes minus that in its middle, m.
    slopes : slopes of the pad along and across the sliding, rad; below 0 the film narrows. Without them, under a load,
        the pad is in equilibrium.
    """

    pivot: Annotated[tuple[float, float], BeforeValidator(_pivot)]
    line: Annotated[bool, Field(strict=True)] = False
    crown: Length | None = None
    film: Length | None = None
    slopes: tuple[Angle, Angle] | None = None

    @model_validator(mode="after")
    def _tilts_about_a_line(self) -> Self:
        if self.slopes is not None and self.slopes[1] != 0 and not self.tilts_across:
            raise ValueError(
                f"slopes: got {self.slopes[1]!r} rad across the sliding for a pad that tilts along it alone; take 0"
            )
        return self

    @property
    def tilts_across(self) -> bool:
        """Whether the pad tilts across the sliding too."""
        return not self.line

    @property
    def span(self) -> float:
        """The length of the pad along the sliding, in the unit of x."""
        raise NotImplementedError

    @property
    def sides(self) -> tuple[float, float]:
        """The positions y of both sides, m."""
        raise NotImplementedError

    def offsets(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The distances ξ and ζ from the pivot along and across the sliding, m."""
        raise NotImplementedError

    def _crowned(self, x: Array) -> Array:
        """The thickness that the crown adds to that at the pivot, m."""
        return (self.crown or 0.0) * ((2 * x / self.span - 1) ** 2 - (2 * self.pivot[0] - 1) ** 2)

    def _tilted(self, x: Array, y: Array) -> Array:
        """The film thickness above that at the pivot, m."""
        slopes = self.slopes or (0.0, 0.0)
        along, across = self.offsets(x, y)
        return np.asarray(slopes[0] * along + slopes[1] * across + self._crowned(x))

    @property
    def _lowest(self) -> float:
        """The least film thickness above that at the pivot, m, from samples on both sides and a parabola through them.

        Between the sides the thickness is linear across.
        """
        x, y = np.meshgrid(np.linspace(0, self.span, SAMPLES), np.array(self.sides), indexing="ij")
        h = self._tilted(x, y)
        i, j = np.unravel_index(int(np.argmin(h)), h.shape)
        if not 0 < i < SAMPLES - 1:
            return float(h[i, j])
        before, at, behind = h[i - 1 : i + 2, j]
        return float(at - (behind - before) ** 2 / (8 * (behind - 2 * at + before)))

    @property
    def pivot_film(self) -> float:
        """The film thickness at the pivot, m; InputError if a load determines it."""
        return known_film(self.film) - self._lowest

    def thickness(self, x: Array, y: Array) -> Array:
        """The film thickness h without texture, m."""
        return np.asarray(self.pivot_film + self._tilted(x, y))

    @property
    def _chord(self) -> float:
        """The length of the pad along the sliding, m; of a sector that of the chord of the mean arc."""
        ends, middle = np.array([0.0, self.span]), np.full(2, sum(self.sides) / 2)
        return float(np.ptp(self.offsets(ends, middle)[0]))

    @property
    def wall(self) -> RigidWall:
        """The film thickness at the pivot, m, and the slopes, rad, about the axes about which the pad tilts."""
        film, count = known_film(self.film), 2 + int(self.tilts_across)
        return RigidWall(
            names=("pivot_film", "slope_x", "slope_y")[:count],
            normals=(
                lambda x, y: np.ones(np.broadcast_shapes(x.shape, y.shape)),
                lambda x, y: self.offsets(x, y)[0] + 0 * y,
                lambda x, y: self.offsets(x, y)[1] + 0 * x,
            )[:count],
            unit=np.array([film, film / self._chord, film / self._chord])[:count],
            place=np.array([self.pivot_film, *(self.slopes or (0.0, 0.0))])[:count],
            turns=np.array([False, True, True])[:count],
        )

    def at(self, place: Array) -> Self:
        """The same pad at the coordinates of its wall; without a slope across the pad keeps its own, or 0."""
        film, along, *across = (float(value) for value in place)
        moved = self.model_copy(update={"slopes": (along, across[0] if across else (self.slopes or (0.0, 0.0))[1])})
        return moved.model_copy(update={"film": film + moved._lowest})

    def started(self, film: float, *, reverse: bool) -> Self:
        """The pad from which its equilibrium is sought; without given slopes the film narrows to half along it."""
        least = self.film or film
        slopes = self.slopes or ((1 if reverse else -1) * least / self._chord, 0.0)
        return self.model_copy(update={"film": least, "slopes": slopes})

    @property
    def tilted(self) -> bool:
        """Whether the slopes are given."""
        return self.slopes is not None

    def gaps(self) -> Iterator[tuple[float, float]]:
        """No gaps: the film is one."""
        yield from ()

    def forces(self, size: float, moments: tuple[float, float]) -> Array:
        """The load on each coordinate of the wall, N (N m of a slope; N/m if infinitely wide).

        A moment about y, which turns z towards x, acts against a slope along x, and one about x, which turns y towards
        z, with a slope along y; z points from the sliding wall to the pad.

        Parameters
        ----------
        size : force towards the sliding wall, N (N/m).
        moments : moments about the axes along x and y through the pivot, N m.
        """
        return np.array([-size, -moments[1], moments[0]])[: 2 + int(self.tilts_across)]


class Pivoted(Pad, Tilting):
    """A rectangular pad that tilts about a pivot.

    Attributes
    ----------
    length : length along the sliding direction, m.
    width : width across the sliding direction, m; None if infinitely wide.
    pivot : position of the pivot over the length and the width, 0 to 1; a single number is that over the length.
    line : whether the pivot is a line across the sliding, about which alone the pad tilts.
    crown : film thickness at the ends of a pad without slopes minus that in its middle, m.
    film : minimum film thickness without texture, m; None if a load determines it.
    slopes : slopes along and across the sliding, rad; without them a load determines them.
    texture : pockets in the still wall; None without pockets.
    """

    shape: Literal["pivoted"]

    @property
    def tilts_across(self) -> bool:
        """Whether the pad tilts across the sliding too; not if it is infinitely wide."""
        return not self.line and self.width is not None

    @property
    def span(self) -> float:
        """The length, m."""
        return self.length

    @property
    def sides(self) -> tuple[float, float]:
        """The positions y of both sides, m."""
        return 0.0, self.length if self.width is None else self.width

    def offsets(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The distances from the pivot along and across the sliding, m."""
        return x - self.pivot[0] * self.length, y - self.pivot[1] * self.sides[1]

    @property
    def symmetric(self) -> bool:
        """Whether the film is symmetric about the middle of its width, unless a moment tilts the pad across."""
        return not self.tilts_across or (self.pivot[1] == 0.5 and (self.slopes is None or self.slopes[1] == 0))

    def film_shape(self) -> Shape:
        """The shape of the film, with its texture."""
        smooth = Shape(
            thickness=self.thickness,
            breaks=self.breaks(),
            across=self.sides,
            wide=self.width is None,
        )
        return smooth if self.texture is None else pocketed(smooth, self.texture)


class PivotedSector(Ring, Tilting):
    """One pad of a thrust bearing, a sector of a ring that tilts about a pivot.

    The distances from the pivot are Cartesian, ξ along the tangent at the pivot and ζ along its radius: with the angle
    θ_p and the radius r_p of the pivot they are r sin(θ - θ_p) and r cos(θ - θ_p) - r_p.

    Attributes
    ----------
    inner_radius, outer_radius : radii of the pad, m.
    angle : angle of the pad, rad.
    pivot : position of the pivot over the angle and over the radial width, 0 to 1; a single number is that over the
        angle.
    line : whether the pivot is a radial line, about which alone the pad tilts.
    crown : film thickness at the ends of a pad without slopes minus that in its middle, m.
    film : minimum film thickness, m; None if a load determines it.
    slopes : slopes along the tangent and the radius at the pivot, rad; without them a load determines them.
    pads : number of equal pads of the whole bearing; by default unknown.
    """

    shape: Literal["pivoted_sector"]
    angle: PositiveAngle
    pads: Annotated[int, Field(strict=True, ge=1, le=10_000)] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.angle > math.pi:
            raise ValueError(
                f"angle: got {math.degrees(self.angle):.6g} degrees; it must be at most 180 for a pad that tilts"
            )
        fitting = math.floor(2 * math.pi / self.angle * (1 + FITTING))
        if self.pads is not None and self.pads > fitting:
            raise ValueError(
                f"pads: got {self.pads!r}; at most {fitting} pads of {math.degrees(self.angle):.6g} degrees fit into a "
                "ring; reduce one of the two"
            )
        return self

    @property
    def turn(self) -> float:
        """The angle of the pad, rad."""
        return self.angle

    @property
    def span(self) -> float:
        """The angle of the pad, rad."""
        return self.angle

    @property
    def endless(self) -> bool:
        """False: grooves separate the pads."""
        return False

    @property
    def pieces(self) -> int | None:
        """The number of pads of the whole bearing; None if it is unknown."""
        return self.pads

    @property
    def sides(self) -> tuple[float, float]:
        """The inner and the outer radius, m."""
        return self.inner_radius, self.outer_radius

    def offsets(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The distances from the pivot along its tangent and along its radius, m."""
        turned, radius = x - self.pivot[0] * self.angle, self.inner_radius + self.pivot[1] * self.width
        return y * np.sin(turned), y * np.cos(turned) - radius

    @property
    def symmetric(self) -> bool:
        """False: the film is not symmetric about the middle of its width."""
        return False

    def film_shape(self) -> Shape:
        """The shape of the film over (angle, radius)."""
        return Shape(
            thickness=self.thickness,
            breaks=(0.0, self.angle),
            across=self.sides,
            wide=False,
            polar=True,
        )
