"""Figures of a rough surface under a series of loads."""

import math
from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.load_series import MAX_BINS, PressureDensity
from roughfilm.contact.mechanics.store import Row
from roughfilm.figures.base import new_figure, size_of, surface_map, svg
from roughfilm.figures.ticks import plain_logarithmic

AREA, PLASTIC, BEFORE, UNLOADED, PLANE = "#2166ac", "#b2182b", "0.6", "#e08214", "black"
PRESSURES = mpl.colormaps["inferno"].with_extremes(bad="#dfe4ea")
GAPS = mpl.colormaps["cividis"].with_extremes(bad="#b2182b")


def areas(rows: Sequence[Row]) -> str:
    """Contact area and plastic area over the load."""
    figure, axes = new_figure((5.4, 4.2))
    loads = _loads(rows)
    _line(axes, loads, [100 * row.area_fraction for row in rows], AREA, "in contact")
    plastic = np.array([100 * row.plastic_fraction for row in rows])
    if plastic.any():
        _line(axes, loads, np.where(plastic > 0, plastic, np.nan), PLASTIC, "plastic")
    figure.legend(loc="outside upper center", ncols=2)
    axes.set(xscale="log", yscale="log", xlabel="load, MPa", ylabel="fraction of the nominal area, %")
    plain_logarithmic(axes.xaxis, axes.yaxis)
    return svg(figure)


def mean_gaps(rows: Sequence[Row]) -> str:
    """Mean gap over the load; empty if the model has none."""
    known = [row for row in rows if row.mean_gap is not None]
    if not known:
        return ""
    figure, axes = new_figure((5.4, 4.2))
    _line(axes, _loads(known), [1e6 * (row.mean_gap or 0.0) for row in known], AREA, "mean gap")
    axes.set(xscale="log", ylim=(0, None), xlabel="load, MPa", ylabel="mean gap, µm")
    plain_logarithmic(axes.xaxis)
    return svg(figure)


def maps(contact: Contact) -> str:
    """Pressure and gap over the surface."""
    width, height = size_of(contact)
    figure, panels = new_figure((11, min(5.2, 1.0 + 4.0 * height / width)), 1, 2)
    figure.set_layout_engine("compressed", w_pad=0.12)
    pressure = np.where(contact.in_contact, contact.pressure, np.nan) / 1e6
    image = surface_map(panels[0], pressure, size_of(contact), cmap=PRESSURES, vmin=0, vmax=_top(contact) / 1e6)
    figure.colorbar(image, ax=panels[0], label="pressure, MPa (grey: no contact)")
    gap = np.where(contact.in_contact, np.nan, contact.gap) * 1e6
    open_ = gap[np.isfinite(gap)]
    top = float(np.percentile(open_, 99.9)) if open_.size else 1.0
    image = surface_map(panels[1], gap, size_of(contact), cmap=GAPS, vmin=0, vmax=top or 1.0)
    figure.colorbar(image, ax=panels[1], label="gap, µm (red: contact)")
    return svg(figure)


def pressures(spreads: Sequence[PressureDensity], hardness: float) -> str:
    """Density of the nominal area over the pressure at a few loads; empty if the model does not give it."""
    drawn = [spread for spread in spreads if spread.density.any()]
    if not drawn:
        return ""
    figure, axes = new_figure((11, 3.6))
    colours = mpl.colormaps["viridis"](np.linspace(0.0, 0.85, len(drawn)))
    for spread, colour in zip(drawn, colours, strict=True):
        density = np.where(spread.density > 0, spread.density, np.nan) * 1e6
        axes.plot(
            spread.pressure / 1e6,
            density,
            ".-" if density.size <= MAX_BINS else "-",
            color=colour,
            label=f"{float(f'{spread.load / 1e6:.3g}'):g} MPa",
        )
    if math.isfinite(hardness):
        axes.axvline(hardness / 1e6, color="black", linestyle=":", linewidth=1)
    top = max(float(spread.density.max()) for spread in drawn) * 1e6
    axes.set_yscale("log")
    axes.set(
        ylim=(max(axes.get_ylim()[0], top * 1e-6), None),
        xlim=(0, None),
        xlabel="pressure, MPa" + (" (dotted: hardness)" if math.isfinite(hardness) else ""),
        ylabel="density of the\nnominal area, 1/MPa",
    )
    figure.legend(loc="outside right upper", title="load")
    return svg(figure)


def section(contact: Contact) -> str:
    """Heights along a line through the largest pressure: undeformed, loaded, unloaded if plastic, and the plane."""
    figure, (upper, lower) = new_figure((11, 5.4), 2, 1, sharex=True, height_ratios=(3, 1.3))
    row = section_row(contact)
    x = np.arange(contact.heights.shape[0]) * contact.spacing[0] * 1e6
    plane = float(contact.heights.max()) - contact.approach
    lines = (
        (contact.heights, "undeformed", BEFORE, 1.0),
        *([(contact.unloaded_heights, "unloaded again", UNLOADED, 1.2)] if contact.plastic.any() else []),
        (contact.loaded_heights, "under load", AREA, 1.2),
    )
    for heights, label, colour, width in lines:
        upper.plot(x, (heights[:, row] - plane) * 1e6, color=colour, label=label, linewidth=width)
    upper.axhline(0, color=PLANE, linewidth=1, linestyle="--", label="plane")
    upper.set_ylabel("height above the plane, µm")
    figure.legend(*upper.get_legend_handles_labels(), ncols=4, loc="outside upper center")
    lower.fill_between(x, contact.pressure[:, row] / 1e6, color=PLASTIC, linewidth=0, step="mid")
    lower.set(ylim=(0, 1.08 * _top(contact) / 1e6), ylabel="pressure, MPa", xlabel="x, µm")
    upper.set_xlim(x[0], x[-1])
    return svg(figure)


def section_row(contact: Contact) -> int:
    """The row of points along x that carries the most of all that hold the largest pressure."""
    peak = contact.pressure.max(axis=0)
    carried = np.where(peak >= peak.max(), contact.pressure.sum(axis=0), -1.0)
    return int(np.argmax(carried))


def _loads(rows: Sequence[Row]) -> list[float]:
    return [row.load / 1e6 for row in rows]


def _line(axes: Axes, x: Sequence[float], y: Any, colour: str, label: str) -> None:
    axes.plot(x, y, "o-", color=colour, label=label, markersize=4, linewidth=1.6)


def _top(contact: Contact) -> float:
    return (
        contact.hardness if contact.plastic.any() else float(np.percentile(contact.pressure[contact.in_contact], 99.9))
    )
