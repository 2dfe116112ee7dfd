"""Where the supplies of a bearing lie in its film."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.geometry.shapes import AnyShape
from roughfilm.rom.bearing.supply.tables import Groove, Hole, Supply
from roughfilm.rom.cavitation.shape import Shape

AT_EDGE = 1e-9
"""Distance from the edge of a supply, over the length of the film, up to which a position lies in it."""

LEAST_SIDE = 1e-5
"""Smallest side of a supply over the length of the film."""

LEAST_SHARE = 1 / 32
"""Smallest number of cells between the edges of supplies over the number of cells of the grid."""

SYMMETRY = 1e-9
"""Distance of the middle of a supply from that of the width, over the width, up to which it is in the middle."""


@dataclass(frozen=True, kw_only=True)
class Patch:
    """A rectangle of a film, in the coordinates of its shape.

    Attributes
    ----------
    x : where it begins and ends along the sliding, m (rad on a ring); None for the whole circumference.
    y : where it begins and ends across, m; None for the whole of an infinitely wide film.
    period : length of a film that is periodic in x; 0 of another one.
    slack : distance from its edges up to which a position lies in it, along and across.
    """

    x: tuple[float, float] | None
    y: tuple[float, float] | None
    period: float
    slack: tuple[float, float]

    def covers(self, x: Array, y: Array) -> NDArray[np.bool_]:
        """Whether positions lie in it or on its edges."""
        slack = self.slack
        x, y = np.broadcast_arrays(x, y)
        found = np.ones(x.shape, dtype=bool)
        if self.x is not None:
            along = x - self.x[0] + slack[0]
            along = np.mod(along, self.period) if self.period else along
            found &= (along >= 0) & (along <= self.x[1] - self.x[0] + 2 * slack[0])
        if self.y is not None:
            found &= (y >= self.y[0] - slack[1]) & (y <= self.y[1] + slack[1])
        return found

    def meets(self, other: "Patch") -> bool:
        """Whether it has positions in common with another one."""
        across = self.y is None or other.y is None or _meet(self.y, other.y, self.slack[1])
        if self.x is None or other.x is None or not across:
            return across
        turns = (-self.period, 0.0, self.period) if self.period else (0.0,)
        return any(_meet(self.x, (other.x[0] + turn, other.x[1] + turn), self.slack[0]) for turn in turns)


def _meet(one: tuple[float, float], other: tuple[float, float], slack: float) -> bool:
    return one[0] <= other[1] + slack and other[0] <= one[1] + slack


def patches(geometry: AnyShape, supplies: Sequence[Supply]) -> tuple[Patch, ...]:
    """The rectangles of the supplies of a bearing.

    Raises
    ------
    ValueError
        If a supply lies outside of the film, has a position for another shape, or meets another one.
    """
    found = []
    for number, supply in enumerate(supplies):
        try:
            found.append(_patch(geometry, supply))
        except ValueError as error:
            raise ValueError(f"supply.{number}.{error}") from None
    for one, other in combinations(range(len(found)), 2):
        if found[one].meets(found[other]):
            raise ValueError(f"supply.{other}: meets supply.{one}; leave film between them, or give one for both")
    return tuple(found)


def _patch(geometry: AnyShape, supply: Supply) -> Patch:
    ring, shaft = isinstance(geometry, Ring), isinstance(geometry, Shaft)
    wide = geometry.width is None
    allowed = ("angle", "radius") if ring else ("angle", "y") if shaft else ("x", "y")
    for name in ("x", "angle", "y", "radius"):
        if getattr(supply, name) is not None and name not in allowed:
            raise ValueError(
                f"{name}: got one for the shape {geometry.shape}; its positions are {' and '.join(allowed)}"
            )
    along, across = supply.sides
    length = geometry.length
    for name, side in (("length", along), ("extent", across)):
        if side is not None and side < LEAST_SIDE * length and not (side == 0 and isinstance(supply, Groove)):
            shown = (supply.diameter, supply.diameter / side) if isinstance(supply, Hole) else (side, 1.0)
            key = "diameter" if isinstance(supply, Hole) else name
            least = LEAST_SIDE * length * shown[1]
            raise ValueError(f"{key}: got {shown[0]!r} m; it must be at least {least:.2g} m, check the units")
    if wide and (across is not None or supply.y is not None):
        raise ValueError(f"kind: got a {supply.kind} with an extent in an infinitely wide film; give the film a width")
    if wide and supply.restricted:
        raise ValueError("pressure: got a restrictor or a flow for an infinitely wide film; give the film a width")
    if not wide and across is None:
        raise ValueError(f"extent: is missing; the {supply.kind} must end before the sides, give it one")
    radius = _middle(geometry, supply) if ring else 1.0
    shape_length = geometry.turn if isinstance(geometry, Ring) else length
    period = shape_length if _periodic(geometry) else 0.0
    slack = (AT_EDGE * shape_length, AT_EDGE * (geometry.width or 1.0))
    low = geometry.inner_radius if isinstance(geometry, Ring) else 0.0
    y = None
    if across is not None:
        assert geometry.width is not None
        middle = _middle(geometry, supply)
        y = (middle - across / 2, middle + across / 2)
        if y[0] <= low + slack[1] or y[1] >= low + geometry.width - slack[1]:
            raise ValueError(
                f"{'radius' if ring else 'y'}: reaches from {y[0]:.6g} to {y[1]:.6g} m; it must lie inside of the film "
                f"between {low:.6g} and {low + geometry.width:.6g} m"
            )
    x = None if along is None else _range(geometry, supply, along / radius, period, slack[0])
    if along is None and not period:
        raise ValueError("length: is missing; only lobes and joined pads have a groove along all of their film")
    return Patch(x=x, y=y, period=period, slack=slack)


def _periodic(geometry: AnyShape) -> bool:
    return geometry.endless if isinstance(geometry, Ring) else isinstance(geometry, Lobes) and not geometry.single


def _middle(geometry: AnyShape, supply: Supply) -> float:
    """The position of the middle across, m."""
    if isinstance(geometry, Ring):
        return geometry.radius if supply.radius is None else supply.radius
    return (geometry.width or 0.0) / 2 if supply.y is None else supply.y


def _range(geometry: AnyShape, supply: Supply, along: float, period: float, slack: float) -> tuple[float, float]:
    """Where a supply begins and ends along the sliding, m (rad on a ring)."""
    ring, shaft = isinstance(geometry, Ring), isinstance(geometry, Shaft)
    key = "angle" if ring or shaft else "x"
    given = getattr(supply, key)
    if given is None:
        raise ValueError(f"{key}: is missing; give the position of its middle along the sliding")
    unit = geometry.radius if isinstance(geometry, Shaft) else 1.0
    start = geometry.start if isinstance(geometry, Lobes) else 0.0
    middle = (given - start) * unit
    length = geometry.turn if isinstance(geometry, Ring) else geometry.length
    if isinstance(geometry, Shaft):
        middle = math.remainder(middle - length / 2, 2 * math.pi * unit) + length / 2
    first, last = middle - along / 2, middle + along / 2
    if period and along >= period - slack:
        raise ValueError("length: got one as long as the film; leave it out for a groove along all of the film")
    if not period and (first <= slack or last >= length - slack):
        shown = [(place / unit + start) if shaft else place for place in (first, last, 0.0, length)]
        raise ValueError(
            "{}: reaches from {:.6g} to {:.6g} {u}; it must lie inside of the film from {:.6g} to {:.6g} {u}".format(
                key, *shown, u="m" if key == "x" else "rad"
            )
        )
    if period:
        shift = math.floor(first / period + 1e-12) * period
        first, last = first - shift, last - shift
    if isinstance(geometry, Lobes):
        for begin, end in geometry.gaps():
            if any(_meet((first, last), (begin + turn, end + turn), slack) for turn in (0.0, period, -period)):
                raise ValueError("angle: reaches into the gap between two lobes; let it lie inside of a lobe")
    return first, last


def supplied(shape: Shape, found: Sequence[Patch]) -> Shape:
    """The shape of a film with nodes at the edges of its supplies."""
    low, high = shape.breaks[0], shape.breaks[-1]
    along, across = set(shape.breaks), set(shape.steps_across)
    for patch in found:
        for edge in patch.x or ():
            along.add(low + math.fmod(edge - low, patch.period) if patch.period else edge)
        across |= set(patch.y or ())
    slack = AT_EDGE * (high - low)
    side = AT_EDGE * (shape.across[1] - shape.across[0])
    return replace(
        shape,
        breaks=_distinct(sorted(along), slack),
        steps_across=_distinct(sorted(across), side),
        least_share=LEAST_SHARE,
    )


def _distinct(places: Sequence[float], slack: float) -> tuple[float, ...]:
    """Increasing places without those that equal the one before; the last one is kept as it is."""
    kept: list[float] = []
    for place in places:
        if kept and place - kept[-1] <= slack:
            kept[-1] = kept[-1] if len(kept) == 1 else place
        else:
            kept.append(place)
    return tuple(kept)


def in_the_middle(found: Sequence[Patch], across: tuple[float, float]) -> bool:
    """Whether every supply is symmetric about the middle of the width."""
    width = across[1] - across[0]
    return all(one.y is None or abs(sum(one.y) - sum(across)) <= SYMMETRY * width for one in found)
