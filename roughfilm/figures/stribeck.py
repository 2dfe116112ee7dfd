"""The pictures of Stribeck curves: over speed, over the bearing, and what the asperities do over their separation."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.stribeck import StribeckCurve, StribeckPoint
from roughfilm.words.stribeck import SpeedScale

COLOURS = ("#2166ac", "#1a7f37", "#b2182b", "#b07d2b", "#6a51a3", "#444444")
BETWEEN = 400
"""Separations at which what the asperities do is drawn."""

THICKEST = 3.0
"""Times the separation at which they touch, the last that is drawn."""

MOST_PRESSURE = 1e9
"""Of contact, Pa, up to which it is drawn."""

DECADES = 30.0
"""From this ratio of the greatest speed to the least on, speeds are drawn by their logarithms."""

LEAST_PRESSURE = 1e3
"""Of contact, the lowest that is drawn, Pa."""


@dataclass(frozen=True, kw_only=True)
class Drawn:
    """Where a film is drawn: ``x``, ``y`` of its nodes, shape (nx, ny), m, its pressure and that of contact, Pa."""

    title: str
    x: Array
    y: Array
    film: Array
    contact: Array


def curves(found: Sequence[StribeckCurve], scale: SpeedScale, touching: float) -> Figure:
    """Friction, least separation over the first touch, and the contact's share, over speed."""
    figure, (friction, gap, share) = new_figure((11.4, 4.0), 1, 3)
    panels: tuple[tuple[Axes, str, Callable[[StribeckPoint], float], str, float], ...] = (
        (friction, "friction_coefficient", lambda point: point.friction_coefficient, "coefficient of friction", 1),
        (
            gap,
            "separation",
            lambda point: point.separation - touching,
            "least separation over the first touch, µm",
            1e6,
        ),
        (share, "contact_share", lambda point: point.contact_share, "load carried by asperities, %", 100),
    )
    for curve, colour in zip(found, _colours(len(found)), strict=True):
        speeds = np.array([point.speed for point in curve.points]) * scale.factor
        for axes, name, of, label, factor in panels:
            values = factor * np.array([of(point) for point in curve.points])
            doubts = factor * np.array([point.uncertainty.get(name, np.nan) for point in curve.points])
            axes.plot(speeds, values, color=colour, linewidth=1.4, label=f"{curve.pressure / 1e6:.4g} MPa")
            known = np.isfinite(doubts)
            axes.errorbar(
                speeds[known], values[known], doubts[known], fmt="o", markersize=2.5, color=colour, elinewidth=0.9
            )
            axes.set(ylabel=label, xlabel=f"speed, {scale.unit}")
            lift = curve.lift_off.speed * scale.factor
            if np.isfinite(lift) and lift <= speeds.max():
                axes.axvline(lift, color=colour, linewidth=0.8, linestyle=":")
    asked = [point.speed for curve in found for point in curve.points]
    if min(asked) > 0 and max(asked) > DECADES * min(asked):
        for axes in (friction, gap, share):
            axes.set_xscale("log")
    friction.set_yscale("log")
    friction.legend(fontsize=8, title="load", loc="upper right")
    gap.axhline(0, color="black", linewidth=0.8, linestyle="--")
    return figure


def _colours(count: int) -> list[str]:
    return [COLOURS[k % len(COLOURS)] for k in range(count)]


def asperity_table(asperities: Asperities) -> Figure:
    """Contact pressure and area, and the factors over those of a smooth film, over the separation."""
    figure, (contact, pressed, sheared) = new_figure((11.4, 3.9), 1, 3)
    touching = asperities.touching
    lowest = asperities.separation_at(min(asperities.largest_pressure, MOST_PRESSURE))
    near = np.linspace(lowest, touching, BETWEEN)
    alpha = np.linspace(lowest, THICKEST * touching, BETWEEN)
    told, areas = asperities.contact_pressure(near), asperities.area_fraction(near)
    shown = told >= LEAST_PRESSURE
    contact.plot(1e6 * near[shown], told[shown] / 1e6, color=COLOURS[0])
    contact.set_yscale("log")
    contact.set_ylabel("contact pressure, MPa", color=COLOURS[0])
    beside = contact.twinx()
    beside.plot(1e6 * near, 100 * areas, color=COLOURS[2])
    beside.set_ylabel("area in contact, %", color=COLOURS[2])
    beside.grid(visible=False)
    found, mean = asperities(alpha), asperities.mean_gap(alpha)
    pressure = {"A₁₁/ĥ³": found.along, "A₂₂/ĥ³": found.across, "A₁₂/ĥ³": found.cross}
    drag = {"B₁/ĥ": found.drag, "B₂/ĥ": found.drag_across}
    for axes, drawn, power in ((pressed, pressure, 3), (sheared, drag, 1)):
        for (label, values), colour in zip(drawn.items(), COLOURS, strict=False):
            axes.plot(1e6 * alpha, values / mean**power, color=colour, label=label)
        axes.legend(fontsize=8)
        axes.set_ylabel("relative to a smooth film")
        axes.axvline(1e6 * touching, color="black", linewidth=0.8, linestyle="--")
    for axes in (contact, pressed, sheared):
        axes.set_xlabel("separation α, µm")
    return figure


def films(drawn: Sequence[Drawn]) -> Figure:
    """Film pressure and contact pressure over the bearing, a row for each speed."""
    figure, panels = new_figure((11.4, 3.3 * len(drawn)), len(drawn), 2, squeeze=False)
    tops = [max(float(one.max()) for one in each) for each in ([d.film for d in drawn], [d.contact for d in drawn])]
    for row, one in zip(panels, drawn, strict=True):
        for axes, values, top, what, colours in zip(
            row, (one.film, one.contact), tops, ("film", "contact"), ("viridis", "magma"), strict=True
        ):
            if one.x.shape[1] == 1:
                axes.plot(1e3 * one.x, values / 1e6, color=COLOURS[0])
                axes.set_title(f"{one.title}: {what}", fontsize=10)
                axes.set(xlabel="along the sliding, mm", ylabel="pressure, MPa")
                continue
            axes.grid(visible=False)
            axes.set_aspect("equal")
            least = min(0.0, float(values.min()))
            image = axes.pcolormesh(
                1e3 * one.x,
                1e3 * one.y,
                values / 1e6,
                shading="gouraud",
                cmap=mpl.colormaps[colours],
                vmin=least / 1e6,
                vmax=top / 1e6 if top > least else 1.0,
                rasterized=True,
            )
            axes.set_title(f"{one.title}: {what}", fontsize=10)
            axes.set(xlabel="mm", ylabel="mm")
            figure.colorbar(image, ax=axes, label="MPa", shrink=0.85)
    return figure
