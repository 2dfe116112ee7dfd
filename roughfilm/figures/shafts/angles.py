"""The axis of figures along the film of a bearing: a position, or the angle around a shaft in lobes."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.result import Result

TICKS = 45.0
"""Angle between the ticks of an axis around a shaft, degrees."""

ROUNDING = 1e-6
"""Distance from the edge of a gap up to which a place lies on it, degrees."""

GAP_COLOUR = "#d9d9d9"
LOAD_COLOUR = "#b2182b"
LEAST_COLOUR = "#1b7837"


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
    """

    factor: float
    label: str
    start: float = 0.0
    gaps: tuple[tuple[float, float], ...] = ()
    load: float | None = None
    around: bool = False

    def __call__(self, x: Array) -> Array:
        """The places of positions x on the axis."""
        return np.asarray(self.start + self.factor * x)

    def mark(self, axes: Axes, *, covered: bool = False, named: bool = False) -> None:
        """Mark the gaps between lobes and the direction of the load, and set ticks of 45 degrees around a shaft.

        Parameters
        ----------
        covered : whether the gaps cover what is drawn.
        named : whether the direction of the load stands in the legend.
        """
        if not self.around:
            return
        low, high = axes.get_xlim()
        for begin, end in self.gaps:
            axes.axvspan(begin, end, color=GAP_COLOUR, linewidth=0, zorder=2 if covered else 0)
        if self.load is not None:
            label = "direction of the load" if named else None
            axes.axvline(self.load, color=LOAD_COLOUR, linewidth=1, linestyle=(0, (6, 3)), label=label, zorder=3)
        axes.set_xticks(np.arange(np.ceil(low / TICKS), np.floor(high / TICKS) + 1) * TICKS)
        axes.set_xlim(low, high)

    def lobes_only(self, place: Array, values: Array) -> Array:
        """Values along the axis at its places, NaN in the gaps between lobes."""
        inside = np.zeros(place.shape, dtype=bool)
        for begin, end in self.gaps:
            inside |= (place > begin + ROUNDING) & (place < end - ROUNDING)
        return np.where(inside, np.nan, values)


def along_of(scene: Bearing, results: Mapping[str, Result]) -> Along:
    """The axis along the film of a scene."""
    geometry = scene.geometry
    if not isinstance(geometry, Lobes):
        angle = next(iter(results.values())).fields["x"].unit == "rad"
        return (
            Along(factor=np.degrees(1.0), label="angle, degrees")
            if angle
            else Along(factor=1e3, label="position along the sliding, mm")
        )
    start, factor = np.degrees(geometry.start), np.degrees(1 / geometry.radius)
    load = None
    if scene.load is not None:
        load = start + np.mod(np.degrees(scene.load.angle) - start, 360.0)
        if geometry.single and load > start + factor * geometry.length:
            load = None
    return Along(
        factor=factor,
        start=start,
        label="angle from the x axis, degrees",
        gaps=tuple((start + factor * begin, start + factor * end) for begin, end in geometry.gaps()),
        load=load,
        around=True,
    )
