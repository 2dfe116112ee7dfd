"""The axis of figures along the film of a bearing, and the gaps, supplies and pivots that are marked on it."""

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from matplotlib.patheffects import withStroke

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.pivoted import Tilting
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.supply.patches import Patch

TICKS, FEW_TICKS = 45.0, 90.0
"""Angle between the ticks of an axis around a shaft, degrees, and on a narrow map."""

ROUNDING = 1e-6
"""Distance from the edge of a gap up to which a place lies on it, degrees."""

GAP_COLOUR = "#d9d9d9"
LOAD_COLOUR = "#b2182b"
LEAST_COLOUR = "#1b7837"
SUPPLY_COLOUR = "#9ecae1"
EDGE_COLOUR = "#252525"

ACROSS = 1e3
"""Positions across in the figures, mm, over those in m."""


@dataclass(frozen=True, kw_only=True)
class Along:
    """The axis along the film.

    Attributes
    ----------
    factor, start : a position x of the fields stands at start + factor x.
    label : label of the axis.
    gaps : where the gaps between lobes begin and end on the axis.
    load : direction of the load on the axis; None without a load on a shaft in lobes.
    around : whether the axis is the angle around a shaft in lobes.
    supplies : where the supplies lie in the film.
    pivots : places of the pivots on the axis and across, mm.
    """

    factor: float
    label: str
    start: float = 0.0
    gaps: tuple[tuple[float, float], ...] = ()
    load: float | None = None
    around: bool = False
    supplies: tuple[Patch, ...] = ()
    pivots: tuple[tuple[float, float], ...] = ()

    def __call__(self, x: Array) -> Array:
        """The places of positions x on the axis."""
        return np.asarray(self.start + self.factor * x)

    def mark(
        self,
        axes: Axes,
        *,
        covered: bool = False,
        named: bool = False,
        at: float | None = None,
        ticks: float = TICKS,
    ) -> None:
        """Mark the gaps between lobes and the direction of the load, and set ticks around a shaft.

        Parameters
        ----------
        covered : whether the gaps cover what is drawn.
        named : whether the direction of the load and the supplies stand in the legend.
        at : position across, m, of a section whose supplies are shaded.
        ticks : angle between the ticks, degrees.
        """
        low, high = axes.get_xlim()
        label = "supply" if named else None
        for patch in self.supplies:
            if at is not None and (patch.y is None or patch.y[0] <= at <= patch.y[1]):
                for begin, end in self._spans(patch, low, high):
                    axes.axvspan(begin, end, color=SUPPLY_COLOUR, alpha=0.35, linewidth=0.8, label=label, zorder=0)
                    label = None
        if self.around:
            for begin, end in self.gaps:
                axes.axvspan(begin, end, color=GAP_COLOUR, linewidth=0, zorder=2 if covered else 0)
            if self.load is not None:
                label = "direction of the load" if named else None
                axes.axvline(self.load, color=LOAD_COLOUR, linewidth=1, linestyle=(0, (6, 3)), label=label, zorder=3)
            axes.set_xticks(np.arange(np.ceil(low / ticks), np.floor(high / ticks) + 1) * ticks)
        axes.set_xlim(low, high)

    def outline(self, axes: Axes) -> None:
        """Draw the edges of the supplies, each with its number, and the pivots, on a map over the film."""
        (low, high), (bottom, top) = axes.get_xlim(), axes.get_ylim()
        for number, patch in enumerate(self.supplies, start=1):
            lower, upper = (bottom, top) if patch.y is None else (ACROSS * patch.y[0], ACROSS * patch.y[1])
            for begin, end in self._spans(patch, low, high):
                edge = [withStroke(linewidth=2.8, foreground=EDGE_COLOUR)]
                axes.add_patch(
                    Rectangle(
                        (begin, lower), end - begin, upper - lower, fill=False, edgecolor="white", path_effects=edge
                    )
                )
                axes.annotate(
                    f"{number}",
                    xy=((max(begin, low) + min(end, high)) / 2, (lower + upper) / 2),
                    ha="center",
                    va="center",
                    fontsize=7,
                    color=EDGE_COLOUR,
                    bbox={
                        "boxstyle": "circle,pad=0.2",
                        "facecolor": "white",
                        "edgecolor": EDGE_COLOUR,
                        "linewidth": 0.6,
                    },
                )
        for pivot in self.pivots:
            axes.plot(*pivot, "^", color="white", markeredgecolor=EDGE_COLOUR, markersize=7, zorder=4)
        axes.set(xlim=(low, high), ylim=(bottom, top))

    def _spans(self, patch: Patch, low: float, high: float) -> list[tuple[float, float]]:
        """The parts of the axis between two places that a supply covers."""
        if patch.x is None:
            return [(low, high)]
        begin, end = self(np.array(patch.x))
        turns = (-self.factor * patch.period, 0.0, self.factor * patch.period) if patch.period else (0.0,)
        moved = [(float(begin + turn), float(end + turn)) for turn in turns]
        return [(first, last) for first, last in moved if first < high and last > low]

    def lobes_only(self, place: Array, values: Array) -> Array:
        """Values along the axis at its places, NaN in the gaps between lobes."""
        inside = np.zeros(place.shape, dtype=bool)
        for begin, end in self.gaps:
            inside |= (place > begin + ROUNDING) & (place < end - ROUNDING)
        return np.where(inside, np.nan, values)


def along_of(scene: Bearing) -> Along:
    """The axis along the film of a scene."""
    geometry, supplies = scene.geometry, scene.supply_patches
    if not isinstance(geometry, Lobes):
        factor, label = 1e3, "position along the sliding, mm"
        if isinstance(geometry, Ring):
            factor, label = float(np.degrees(1.0)), "angle, degrees"
        return Along(factor=factor, label=label, supplies=supplies, pivots=_pivots(scene, factor))
    start, factor = np.degrees(geometry.start), np.degrees(1 / geometry.radius)
    load = None
    if scene.load is not None:
        load = start + np.mod(np.degrees(scene.load.angle) - start, 360.0)
        if geometry.single and load > start + factor * geometry.length:
            load = None
    middle = ACROSS * (geometry.width or 0.0) / 2
    return Along(
        factor=factor,
        start=start,
        label="angle from the x axis, degrees",
        gaps=tuple((start + factor * begin, start + factor * end) for begin, end in geometry.gaps()),
        load=load,
        around=True,
        supplies=supplies,
        pivots=tuple((float(np.degrees(angle)), middle) for angle in geometry.pivots),
    )


def _pivots(scene: Bearing, factor: float) -> tuple[tuple[float, float], ...]:
    """The place of the pivot of a pad on its axis and across, mm; none of another bearing."""
    geometry = scene.geometry
    if not isinstance(geometry, Tilting):
        return ()
    low, high = geometry.sides
    return ((factor * geometry.pivot[0] * geometry.span, ACROSS * (low + geometry.pivot[1] * (high - low))),)
