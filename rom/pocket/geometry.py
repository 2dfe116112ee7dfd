"""The scene entries of one period of a film with grooves in its fixed wall."""

from itertools import pairwise
from typing import Annotated, Any, Literal, Self

from pydantic import (
    BeforeValidator,
    Field,
    PlainSerializer,
    SerializerFunctionWrapHandler,
    model_serializer,
    model_validator,
)

from roughfilm.contact.foundation.entries import Coordinate, Length, NamesFile, Part
from roughfilm.rom.pocket import groove
from roughfilm.rom.pocket.profile import Points, checked
from roughfilm.rom.thin_film.gap import Gap

MAX_GROOVES = 100
"""Largest number of grooves in a period."""


class _Placed(Part):
    """A groove at ``position``, m from the middle of the period.

    Attributes
    ----------
    position : distance of the middle of the groove from the middle of the period, m.
    """

    position: Coordinate = 0.0


class _Drawn(_Placed):
    """A groove of given width and depth, m, with its middle at ``position``.

    Attributes
    ----------
    width : width along the sliding direction, m.
    depth : greatest depth, m.
    """

    width: Length
    depth: Length

    @property
    def span(self) -> tuple[float, float]:
        """Its start and end, m from the middle of the period."""
        return self.position - self.width / 2, self.position + self.width / 2

    @property
    def slope(self) -> float:
        """Mean slope of the wall between the lowest point and the nearer edge."""
        return 2 * self.depth / self.width


class Cylindrical(_Drawn):
    """A groove that is a circular arc through both edges.

    Attributes
    ----------
    profile : "cylindrical", "splined" or "points".
    """

    profile: Literal["cylindrical"]

    @model_validator(mode="after")
    def _at_most_a_half_circle(self) -> Self:
        if self.depth > self.width / 2:
            raise ValueError(
                f"depth: got {self.depth!r} m; the arc would be more than a half circle, "
                f"it must be at most width / 2 = {self.width / 2!r} m"
            )
        return self

    def shape(self) -> groove.Groove:
        """The depth along the wall."""
        return groove.cylindrical(width=self.width, depth=self.depth)


class Splined(_Drawn):
    """A groove of two cubics with zero slope at the edges and at the lowest point, ``shift`` ahead of the middle, m.

    Attributes
    ----------
    profile : "cylindrical", "splined" or "points".
    shift : distance of the lowest point from the middle, in the sliding direction, m.
    """

    profile: Literal["splined"]
    shift: Coordinate = 0.0

    @model_validator(mode="after")
    def _lowest_point_inside(self) -> Self:
        if abs(self.shift) >= self.width / 2:
            raise ValueError(
                f"shift: got {self.shift!r} m; the lowest point would lie outside the groove, "
                f"it must be nearer to the middle than width / 2 = {self.width / 2!r} m"
            )
        return self

    @property
    def slope(self) -> float:
        """Mean slope of the wall between the lowest point and the nearer edge."""
        return self.depth / (self.width / 2 - abs(self.shift))

    def shape(self) -> groove.Groove:
        """The depth along the wall."""
        return groove.splined(width=self.width, depth=self.depth, shift=self.shift)


class Through(_Placed):
    """A groove through points (distance from ``position``, depth), m, joined by straight lines or monotone cubics.

    Attributes
    ----------
    profile : "cylindrical", "splined" or "points".
    interpolation : "linear" joins the points by straight lines, "monotone" by cubics.
    points : rows [distance from position, depth], m, or the name of a CSV or NPY file.
    """

    profile: Literal["points"]
    interpolation: Literal["linear", "monotone"] = "linear"
    points: Annotated[
        Points, BeforeValidator(checked), PlainSerializer(lambda points: [list(row) for row in points]), NamesFile()
    ]

    @property
    def span(self) -> tuple[float, float]:
        """Its start and end, m from the middle of the period."""
        return self.position + self.points[0][0], self.position + self.points[-1][0]

    @property
    def width(self) -> float:
        """Distance of the first and the last point, m."""
        return self.points[-1][0] - self.points[0][0]

    @property
    def depth(self) -> float:
        """Depth of the deepest point, m."""
        return max(depth for _, depth in self.points)

    @property
    def slope(self) -> float:
        """Mean slope of the wall between the lowest point and the nearer edge."""
        (first, _), *_, (last, _) = self.points
        lowest = [place for place, depth in self.points if depth == self.depth]
        return self.depth / min(lowest[0] - first, last - lowest[-1])

    def shape(self) -> groove.Groove:
        """The depth along the wall."""
        join = groove.monotone if self.interpolation == "monotone" else groove.polygonal
        return join(points=self.points)


AnyGroove = Cylindrical | Splined | Through
PROFILES: dict[str, type[Part]] = {"cylindrical": Cylindrical, "splined": Splined, "points": Through}


class PocketGeometry(Part):
    """One period of a channel whose fixed lower wall has grooves; lengths in m.

    The keys of a single groove may stand beside ``length`` and ``film``; they are then written there too.

    Attributes
    ----------
    length : length of one period along the sliding direction, m.
    film : film thickness outside the grooves, m.
    grooves : the grooves, a table each.
    """

    length: Length
    film: Length
    grooves: tuple[Annotated[AnyGroove, Field(discriminator="profile")], ...]

    @model_validator(mode="before")
    @classmethod
    def _gather_grooves(cls, entries: Any) -> Any:
        if not isinstance(entries, dict):
            return entries
        own = {key: entries[key] for key in ("length", "film") if key in entries}
        single = {key: value for key, value in entries.items() if key not in cls.model_fields}
        if single and "grooves" in entries:
            keys = " and ".join(single)
            raise ValueError(f"got {keys} beside grooves; give either one groove in geometry or geometry.grooves")
        grooves = entries.get("grooves", [single])
        if not isinstance(grooves, list | tuple) or not 1 <= len(grooves) <= MAX_GROOVES:
            raise ValueError(f"grooves: got {grooves!r:.60}; write 1 to {MAX_GROOVES} tables [[geometry.grooves]]")
        return {**own, "grooves": [{"profile": "cylindrical", **g} if isinstance(g, dict) else g for g in grooves]}

    @model_serializer(mode="wrap")
    def _lay_a_single_groove_flat(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        entries: dict[str, Any] = handler(self)
        if len(self.grooves) == 1:
            entries.update(entries.pop("grooves")[0])
        return entries

    @property
    def depth(self) -> float:
        """Depth of the deepest groove, m."""
        return max(groove.depth for groove in self.grooves)

    @property
    def narrowest(self) -> float:
        """Width of the narrowest groove, m."""
        return min(groove.width for groove in self.grooves)

    @property
    def aspect(self) -> float:
        """The largest 2d / w of the grooves: the mean slope of a symmetric one."""
        return max(2 * groove.depth / groove.width for groove in self.grooves)

    @property
    def slope(self) -> float:
        """Mean slope of the steepest groove from its lowest point to the nearer edge; 2d / w if it is symmetric."""
        return max(groove.slope for groove in self.grooves)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        in_film_thicknesses("length", self.length / self.film, 1e-2)
        for number, one in enumerate(self.grooves):
            place = f"grooves.{number}." if len(self.grooves) > 1 else ""
            width, depth = ("points", "points") if isinstance(one, Through) else ("width", "depth")
            if one.width >= self.length:
                raise ValueError(f"{place}{width}: got {one.width!r} m; it must be below length, {self.length!r} m")
            in_film_thicknesses(place + width, one.width / self.film, 1e-2)
            in_film_thicknesses(place + depth, one.depth / self.film, 1e-9)
            beyond = max(abs(end) for end in one.span) - self.length / 2
            if beyond > groove.SAME_PLACE * self.length:
                raise ValueError(
                    f"{place}position: got {one.position!r} m; the groove reaches {beyond:.4g} m over the end of the "
                    "period, move it or make it narrower"
                )
        along = sorted(enumerate(self.grooves), key=lambda pair: pair[1].span)
        for (number, one), (other_number, other) in pairwise(along):
            overlap = min(one.span[1], other.span[1]) - other.span[0]
            if overlap > groove.SAME_PLACE * self.length:
                raise ValueError(
                    f"grooves: got {overlap:.4g} m of overlap between numbers {number} and {other_number}, counted "
                    "from 0; move one or make it narrower"
                )
        return self

    def gap(self) -> Gap:
        """The gap between the grooved wall and the sliding one."""
        grooves = [(one.position, one.shape()) for one in self.grooves]
        return groove.channel(length=self.length, film=self.film, grooves=grooves)


def in_film_thicknesses(place: str, value: float, least: float) -> None:
    """Check that a length over the film thickness is at least ``least`` and at most 100000; ValueError if it is not."""
    if not least <= value <= 1e5:
        raise ValueError(f"{place}: got {value:.3g} film thicknesses; it must be {least:g} to 100000 of them")
