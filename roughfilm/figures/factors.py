"""Figures of flow factors over the mean gap, and maps of the flow."""

from dataclasses import replace

import matplotlib as mpl
import numpy as np
from matplotlib.ticker import LogLocator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure, surface_map, svg
from roughfilm.figures.sets.bands import MEAN_ALPHA, WINDOW_ALPHA
from roughfilm.figures.ticks import plain_logarithmic
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.homogenization.flux import flux
from roughfilm.rom.homogenization.table.factor_table import FactorTable, relative_row, relative_rows
from roughfilm.words.average import MOST

COLOURS = ("#2166ac", "#b2182b", "#e08214")
GAPS = mpl.colormaps["cividis"].with_extremes(bad="#b2182b")
FLOWS = mpl.colormaps["magma"].with_extremes(bad="#dfe4ea")
DRAWN_POINTS = 600
"""Gaps at which the interpolation is drawn."""

MAX_LINEAR = 20.0
"""Factor above which the axis is logarithmic beyond 1."""

FLUX_RANGE = 1e-4
"""Ratio of the smallest flux with a colour of its own to the greatest."""

POSITIVE_ENTRIES = np.array([True, True, False, False, False, True, True])
"""Which entries of a row are 0 or more."""

SMALL_FACTOR = 0.05
"""Factor below which a scatter counts as unknown from ``MOST`` times this value on."""

MARGIN = 0.25
"""Room above and below the curves of means over windows, over their range."""

PANELS = {
    "flow by pressure": ((0, "along x, A₁₁/ĥ³"), (1, "along y, A₂₂/ĥ³"), (2, "crossed, A₁₂/ĥ³")),
    "flow by sliding along x": ((3, "along x, B₁/ĥ"), (4, "along y, B₂/ĥ")),
    "friction": ((5, "mean of 1/h, d ĥ"), (6, "deflected flow, e ĥ")),
}
"""Which entries of a row each panel shows."""


SCATTER_BANDS = {"window": WINDOW_ALPHA, "mean": MEAN_ALPHA}
"""The bands of means over windows, with their opacity."""


def curves(table: FactorTable) -> str:
    """Factors over the mean gap: points with their uncertainty, the interpolation, and the asymptote.

    Means over windows have two bands: light that of one window, and darker the scatter of the mean.
    """
    figure, panels = new_figure((11.4, 4.4), 1, len(PANELS))
    gaps = np.array([point.mean_gap for point in table.points])
    rows = np.array([relative_row(point.factors) for point in table.points])
    uncertainties = np.array(
        [relative_row(replace(point.uncertainty, mean_gap=point.mean_gap)) for point in table.points]
    )
    fine = np.geomspace(gaps[0], 1.6 * gaps[-1], DRAWN_POINTS)
    between = relative_rows(table, fine)
    bands = [_band(table, part) for part in SCATTER_BANDS] if table.points[0].scatter is not None else []
    for axes, (title, drawn) in zip(panels, PANELS.items(), strict=True):
        for (index, label), colour in zip(drawn, COLOURS, strict=False):
            axes.plot(1e6 * fine, between[:, index], color=colour, linewidth=1.2, label=label)
            bars = np.clip(np.nan_to_num(uncertainties[:, index], posinf=0.0), 0.0, 1.0)
            axes.errorbar(1e6 * gaps, rows[:, index], bars, color=colour, fmt="o", markersize=3, elinewidth=0.8)
            for (low, high), alpha in zip(bands, SCATTER_BANDS.values(), strict=False):
                axes.fill_between(1e6 * gaps, low[:, index], high[:, index], color=colour, alpha=alpha, linewidth=0)
        if bands:
            axes.set_ylim(_limits(rows[:, [index for index, _ in drawn]]))
        if any(point.contact > 0 for point in table.points):
            axes.axvline(1e6 * table.peak, color="0.6", linewidth=0.8, linestyle="--")
        axes.set_xscale("log")
        if rows[:, [index for index, _ in drawn]].max() > MAX_LINEAR:
            axes.set_yscale("symlog", linthresh=1.0)
            axes.yaxis.set_major_formatter("{x:g}")
            axes.set_ylim(bottom=min(-0.2, 1.2 * rows[:, [index for index, _ in drawn]].min()))
        axes.xaxis.set_major_locator(LogLocator(numticks=5))
        plain_logarithmic(axes.xaxis)
        axes.set_title(title, fontsize=10)
        axes.set(xlabel="mean gap ĥ, µm", ylabel="relative to a smooth film")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), fontsize=9)
    return svg(figure)


def _band(table: FactorTable, part: str) -> tuple[Array, Array]:
    """The lower and upper ends of a band at each point of a table of means over windows, shape (n, 7) each."""
    ends = []
    for point in table.points:
        assert point.scatter is not None
        row = relative_row(point.factors)
        half = relative_row(point.scatter.mean)
        half = np.where(half > MOST * np.maximum(np.abs(row), SMALL_FACTOR), np.nan, half)
        mean = np.where(POSITIVE_ENTRIES, np.maximum(row - half, 0.0), row - half), row + half
        ends.append(mean if part == "mean" else (relative_row(point.scatter.low), relative_row(point.scatter.high)))
    low, high = (np.array(one) for one in zip(*ends, strict=True))
    return low, high


def _limits(rows: Array) -> tuple[float, float]:
    """The limits of an axis that shows some curves, whatever the width of their bands."""
    least, most = min(0.0, float(rows.min())), max(1.0, float(rows.max()))
    room = MARGIN * (most - least)
    return least - room, most + room


def pressures(table: AsperityTable) -> str:
    """Contact pressure, contact area and mean gap over the separation, with the points and their uncertainty."""
    figure, panels = new_figure((11.4, 3.6), 1, 3)
    pressed = [point for point in table.factors.points if point.load]
    alpha = np.linspace(table.closest, table.touching, DRAWN_POINTS + 1)[:-1]
    places = np.array([point.separation for point in pressed])
    drawn = (
        ("contact pressure, MPa", 1e-6 * table.contact_pressure(alpha), [1e-6 * point.load for point in pressed]),
        ("real area of contact, %", 100 * table.area_fraction(alpha), [100 * point.area_fraction for point in pressed]),
        ("mean gap ĥ, µm", 1e6 * table.mean_gap(alpha), [1e6 * point.mean_gap for point in pressed]),
    )
    for axes, (label, line, points), colour in zip(panels, drawn, COLOURS, strict=True):
        axes.plot(1e6 * alpha, line, color=colour, linewidth=1.2)
        uncertainties = [1e6 * min(point.separation_uncertainty, table.touching) for point in pressed]
        axes.errorbar(1e6 * places, points, xerr=uncertainties, color=colour, fmt="o", markersize=3, elinewidth=0.8)
        axes.axvline(1e6 * table.touching, color="0.6", linewidth=0.8, linestyle="--")
        axes.set(xlabel="separation of the mean planes α, µm", ylabel=label)
        if "µm" not in label:
            axes.set_yscale("log")
    return svg(figure)


def maps(gap: Array, spacing: tuple[float, float], correctors: Array, sealed: tuple[bool, bool]) -> str:
    """Maps of the gap, and of the flow under a pressure gradient along x and along y over that of a smooth film."""
    width, height = (count * length for count, length in zip(gap.shape, spacing, strict=True))
    figure, panels = new_figure((11.4, min(6.0, 1.6 + 3.3 * height / width)), 1, 3)
    figure.set_layout_engine("compressed", w_pad=0.12)
    shown = np.where(gap > 0, gap, np.nan) * 1e6
    image = surface_map(panels[0], shown, (width, height), cmap=GAPS, vmin=0)
    panels[0].set_title("gap", fontsize=10)
    figure.colorbar(image, ax=panels[0], label="gap, µm (red: contact)", location="bottom")
    speeds = [np.hypot(*flux(gap, spacing, correctors[axis], axis)) / gap.mean() ** 3 for axis in (0, 1)]
    top = max(float(speed.max()) for speed, closed in zip(speeds, sealed, strict=True) if not closed or all(sealed))
    norm = mpl.colors.LogNorm(vmin=FLUX_RANGE * top, vmax=top, clip=True) if top > 0 else None
    for axes, axis, speed, closed in zip(panels[1:], "xy", speeds, sealed, strict=True):
        axes.set_title(f"flow driven along {axis}" + (": sealed" if closed else ""), fontsize=10)
        flowing = np.where((gap > 0) & ~np.array(closed), speed, np.nan)
        image = surface_map(axes, flowing, (width, height), cmap=FLOWS, norm=norm)
    figure.colorbar(image, ax=panels[1:].tolist(), label="flow over that of a smooth film", location="bottom")
    return svg(figure)
