"""Figures of Stribeck curves, of the pressures over the bearing, and of the asperities over their separation."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure
from roughfilm.figures.sets.bands import MEAN_ALPHA, WINDOW_ALPHA
from roughfilm.figures.shafts.angles import Along
from roughfilm.figures.ticks import plain_logarithmic
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.stribeck import StribeckCurve
from roughfilm.words.stribeck import SpeedScale

COLOURS = ("#2166ac", "#1a7f37", "#b2182b", "#b07d2b", "#6a51a3", "#444444")
DRAWN_SEPARATIONS = 400
"""Number of separations at which the properties of the asperities are drawn."""

MAX_SEPARATION = 3.0
"""Largest separation that is drawn, over that of the first touch."""

MAX_CONTACT_PRESSURE = 1e9
"""Largest contact pressure that is drawn, Pa."""

LOGARITHMIC_RATIO = 30.0
"""Ratio of the largest speed to the lowest above which the axis of speeds is logarithmic."""

MIN_CONTACT_PRESSURE = 1e3
"""Lowest contact pressure that is drawn, Pa."""


@dataclass(frozen=True, kw_only=True)
class Drawn:
    """A film that is drawn: ``x``, ``y`` of its nodes, shape (nx, ny), m, its pressure and that of contact, Pa.

    ``along`` is the axis along the film; None of a ring, which is drawn in its plane.
    """

    title: str
    x: Array
    y: Array
    film: Array
    contact: Array
    along: Along | None = None


def curves(drawn: Sequence[StribeckCurve], scale: SpeedScale, touching: float | None, own: float) -> Figure:
    """Friction coefficient, separation over that of the first touch, and load on the asperities, over speed.

    Without asperities, ``touching`` is None, and the panels show the least film and the peak pressure. Films with a
    temperature have a panel for it. ``own`` is the speed of the scene, m/s.
    """
    heated = all(point.temperature is not None for curve in drawn for point in curve.points)
    figure, every = new_figure((14.4 if heated else 11.4, 4.4), 1, 4 if heated else 3)
    friction, gap, share, *others = every
    panels: list[tuple[Axes, str, float, str, float]] = [
        (friction, "friction_coefficient", 0.0, "coefficient of friction", 1)
    ]
    if touching is None:
        panels.append((gap, "separation", 0.0, "least film thickness, µm", 1e6))
        panels.append((share, "pressure_max", 0.0, "peak pressure, MPa", 1e-6))
    else:
        panels.append((gap, "separation", touching, "least separation over the first touch, µm", 1e6))
        panels.append((share, "contact_share", 0.0, "load carried by asperities, %", 100))
    panels += [(axes, "temperature", 0.0, "temperature of the film, °C", 1) for axes in others]
    for curve, colour in zip(drawn, itertools.cycle(COLOURS), strict=False):
        speeds = np.array([point.speed for point in curve.points]) * scale.factor
        for axes, name, zero, label, factor in panels:
            values = factor * np.array([getattr(point, name) - zero for point in curve.points])
            errors = factor * np.array([point.uncertainty.get(name, np.nan) for point in curve.points])
            axes.plot(speeds, values, color=colour, linewidth=1.4, label=f"load {curve.pressure / 1e6:.4g} MPa")
            _draw_scatter(axes, curve, name, zero, factor, scale, colour)
            known = np.isfinite(errors)
            axes.errorbar(
                speeds[known],
                values[known],
                errors[known],
                fmt="o",
                markersize=2.5,
                color=colour,
                elinewidth=0.9,
            )
            axes.set(ylabel=label, xlabel=f"speed, {scale.unit}")
            lift = curve.lift_off.speed * scale.factor
            if touching is not None and np.isfinite(lift) and lift <= speeds.max():
                axes.axvline(lift, color=colour, linewidth=0.8, linestyle=":")
    swept = [point.speed for curve in drawn for point in curve.points]
    if min(swept) > 0 and max(swept) > LOGARITHMIC_RATIO * min(swept):
        for axes in every:
            axes.set_xscale("log")
            plain_logarithmic(axes.xaxis)
    friction.set_yscale("log")
    plain_logarithmic(friction.yaxis)
    if min(swept) <= own <= max(swept):
        for axes in every:
            axes.axvline(own * scale.factor, color="0.35", linewidth=1, linestyle="--", zorder=0)
    figure.legend(*friction.get_legend_handles_labels(), fontsize=9, loc="outside upper center", ncols=6)
    if touching is not None:
        gap.axhline(0, color="black", linewidth=0.8, linestyle="--")
    return figure


def _draw_scatter(
    axes: Axes, curve: StribeckCurve, name: str, zero: float, factor: float, scale: SpeedScale, colour: str
) -> None:
    """Draw the bands of a curve over windows: light the interval for one window, darker the scatter of the mean."""
    some = [point for point in curve.points if name in point.scatter]
    if not some:
        return
    speeds = [scale.factor * point.speed for point in some]
    values, halves = (
        np.array([float(one) for one in column])
        for column in zip(*((getattr(point, name) - zero, point.scatter[name]) for point in some), strict=True)
    )
    ends = np.array([point.window_interval.get(name, (np.nan, np.nan)) for point in some]) - zero
    for low, high, alpha in (
        (ends[:, 0], ends[:, 1], WINDOW_ALPHA),
        (np.maximum(values - halves, min(0.0, values.min())), values + halves, MEAN_ALPHA),
    ):
        axes.fill_between(speeds, factor * low, factor * high, color=colour, alpha=alpha, linewidth=0)


def asperity_table(asperities: Asperities) -> Figure:
    """Contact pressure, contact area and flow factors of the asperities over the separation."""
    figure, (contact, pressed, sheared) = new_figure((11.4, 4.3), 1, 3)
    touching = asperities.touching
    lowest = asperities.separation_at(min(asperities.largest_pressure, MAX_CONTACT_PRESSURE))
    near = np.linspace(lowest, touching, DRAWN_SEPARATIONS)
    alpha = np.linspace(lowest, MAX_SEPARATION * touching, DRAWN_SEPARATIONS)
    pressures, areas = asperities.contact_pressure(near), asperities.area_fraction(near)
    shown = pressures >= MIN_CONTACT_PRESSURE
    contact.plot(1e6 * near[shown], pressures[shown] / 1e6, color=COLOURS[0])
    contact.set_yscale("log")
    contact.set_ylabel("contact pressure, MPa", color=COLOURS[0])
    beside = contact.twinx()
    beside.plot(1e6 * near, 100 * areas, color=COLOURS[2])
    beside.set_ylabel("area in contact, %", color=COLOURS[2])
    beside.grid(visible=False)
    beside.spines["right"].set_visible(True)
    factors, mean = asperities(alpha), asperities.mean_gap(alpha)
    pressure = {"along, A₁₁/ĥ³": factors.along, "across, A₂₂/ĥ³": factors.across, "crossed, A₁₂/ĥ³": factors.cross}
    drag = {"along, B₁/ĥ": factors.drag, "across, B₂/ĥ": factors.drag_across}
    pressed.set_title("flow by pressure", fontsize=10)
    sheared.set_title("flow by shear", fontsize=10)
    contact.set_title("asperities", fontsize=10)
    for axes, drawn, power in ((pressed, pressure, 3), (sheared, drag, 1)):
        for (label, values), colour in zip(drawn.items(), COLOURS, strict=False):
            axes.plot(1e6 * alpha, values / mean**power, color=colour, label=label)
        axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=2)
        axes.set_ylabel("relative to a smooth film")
        axes.axvline(1e6 * touching, color="black", linewidth=0.8, linestyle="--")
    for axes in (contact, pressed, sheared):
        axes.set_xlabel("separation α, µm")
    return figure


def films(drawn: Sequence[Drawn]) -> Figure:
    """Film pressure over the bearing, a row for each speed, and beside it contact pressure where there is any."""
    kinds = ["film", *(["contact"] if any(one.contact.any() for one in drawn) else [])]
    figure, panels = new_figure(
        (11.4 if len(kinds) > 1 else 7.0, 3.3 * len(drawn)), len(drawn), len(kinds), squeeze=False
    )
    for column, (kind, colours) in enumerate(zip(kinds, ("viridis", "magma"), strict=False)):
        maps = [getattr(one, kind) for one in drawn]
        least, top = min(0.0, *(float(one.min()) for one in maps)), max(float(one.max()) for one in maps)
        for axes, one, values in zip(panels[:, column], drawn, maps, strict=True):
            if not values.any():
                axes.set_axis_off()
                axes.text(0.5, 0.5, f"{one.title}:\nno {kind} pressure", ha="center", transform=axes.transAxes)
                continue
            axes.set_title(f"{one.title}: {kind}", fontsize=10)
            x = 1e3 * one.x if one.along is None else one.along(one.x)
            label = "x, mm" if one.along is None else one.along.label
            if one.x.shape[1] == 1:
                axes.plot(x, values / 1e6, color=COLOURS[0])
                axes.set(xlabel=label, ylabel=f"{kind} pressure, MPa")
                continue
            axes.grid(visible=False)
            axes.set_aspect("auto" if one.along is not None and one.along.around else "equal")
            image = axes.pcolormesh(
                x,
                1e3 * one.y,
                values / 1e6,
                shading="gouraud",
                cmap=mpl.colormaps[colours],
                vmin=least / 1e6,
                vmax=top / 1e6,
                rasterized=True,
            )
            axes.set(xlabel=label, ylabel="y, mm" if one.along is None else "across, mm")
            if one.along is not None:
                one.along.mark(axes, covered=True)
                one.along.outline(axes)
            figure.colorbar(image, ax=axes, label=f"{kind} pressure, MPa", shrink=0.85)
    return figure
