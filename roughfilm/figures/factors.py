"""The pictures of flow factors: over the mean gap, and where the flow goes."""

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import svg
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.homogenization.flux import flux
from roughfilm.rom.homogenization.table.factor_table import FactorTable, relative_row, relative_rows

COLOURS = ("#2166ac", "#b2182b", "#e08214")
GAPS = mpl.colormaps["cividis"].with_extremes(bad="#b2182b")
FLOWS = mpl.colormaps["magma"].with_extremes(bad="#dfe4ea")
BETWEEN = 600
"""Places where the interpolation is drawn."""

MOST_PIXELS = 640
FAINT = 1e-4
"""Of the greatest flux, the darkest that is told apart."""

PANELS = {
    "pressure flow": ((0, "A₁₁/ĥ³"), (1, "A₂₂/ĥ³"), (2, "A₁₂/ĥ³")),
    "shear flow": ((3, "B₁/ĥ"), (4, "B₂/ĥ")),
    "friction": ((5, "d ĥ"), (6, "e ĥ")),
}
"""Which entries of a row each panel shows."""


def curves(table: FactorTable) -> str:
    """Factors over the mean gap: points with their error bars, the interpolation, and the asymptote beyond them."""
    figure = Figure(figsize=(11.4, 3.9), layout="constrained")
    gaps = np.array([point.mean_gap for point in table.points])
    rows = np.array([relative_row(point.factors) for point in table.points])
    doubts = np.array([_doubt(table, row) for row in range(gaps.size)])
    fine = np.geomspace(gaps[0], 1.6 * gaps[-1], BETWEEN)
    between = relative_rows(table, fine)
    for axes, (title, drawn) in zip(figure.subplots(1, len(PANELS)), PANELS.items(), strict=True):
        for (index, label), colour in zip(drawn, COLOURS, strict=False):
            axes.plot(1e6 * fine, between[:, index], color=colour, linewidth=1.2, label=label)
            bars = np.clip(np.nan_to_num(doubts[:, index], posinf=0.0), 0.0, 1.0)
            axes.errorbar(1e6 * gaps, rows[:, index], bars, color=colour, fmt="o", markersize=3, elinewidth=0.8)
        if any(point.contact > 0 for point in table.points):
            axes.axvline(1e6 * table.peak, color="0.6", linewidth=0.8, linestyle="--")
        axes.set_xscale("log")
        axes.set_title(title, fontsize=10)
        axes.set_xlabel("mean gap ĥ, µm")
        axes.set_ylabel("relative to a smooth film")
        axes.legend()
    return svg(figure)


def pressures(table: AsperityTable) -> str:
    """What asperities carry over the separation, with the points and what is unsure; the mean gap and the area."""
    figure = Figure(figsize=(11.4, 3.6), layout="constrained")
    pressed = [point for point in table.factors.points if point.load]
    alpha = np.linspace(table.closest, table.touching, BETWEEN + 1)[:-1]
    places = np.array([point.separation for point in pressed])
    drawn = (
        ("contact pressure, MPa", 1e-6 * table.contact_pressure(alpha), [1e-6 * point.load for point in pressed]),
        ("real area of contact, %", 100 * table.area_fraction(alpha), [100 * point.area_fraction for point in pressed]),
        ("mean gap ĥ, µm", 1e6 * table.mean_gap(alpha), [1e6 * point.mean_gap for point in pressed]),
    )
    for axes, (label, line, points), colour in zip(figure.subplots(1, 3), drawn, COLOURS, strict=True):
        axes.plot(1e6 * alpha, line, color=colour, linewidth=1.2)
        doubts = [1e6 * min(point.separation_uncertainty, table.touching) for point in pressed]
        axes.errorbar(1e6 * places, points, xerr=doubts, color=colour, fmt="o", markersize=3, elinewidth=0.8)
        axes.axvline(1e6 * table.touching, color="0.6", linewidth=0.8, linestyle="--")
        axes.set_xlabel("separation of the mean planes α, µm")
        axes.set_ylabel(label)
        if "µm" not in label:
            axes.set_yscale("log")
    return svg(figure)


def _doubt(table: FactorTable, row: int) -> Array:
    point = table.points[row]
    h, doubt = point.mean_gap, point.uncertainty
    a = doubt.pressure
    return np.array(
        [
            *(a[0, 0] / h**3, a[1, 1] / h**3, a[0, 1] / h**3),
            *(doubt.shear / h),
            doubt.couette * h,
            doubt.shear_couette * h,
        ]
    )


def maps(gap: Array, spacing: tuple[float, float], correctors: Array, sealed: tuple[bool, bool]) -> str:
    """The gap, and where the flow goes that a pressure gradient drives along x and along y."""
    step = max(1, -(-max(gap.shape) // MOST_PIXELS))
    width, height = (count * length for count, length in zip(gap.shape, spacing, strict=True))
    figure = Figure(figsize=(11.4, min(6.0, 1.6 + 3.6 * height / width)), layout="constrained")
    panels = figure.subplots(1, 3)
    shown = np.where(gap > 0, gap, np.nan) * 1e6
    image = _map(panels[0], shown[::step, ::step], (width, height), cmap=GAPS, vmin=0)
    figure.colorbar(image, ax=panels[0], label="gap, µm (red: contact)", location="bottom", shrink=0.9)
    for direction, axis in enumerate("xy"):
        axes = panels[1 + direction]
        axes.set_title(f"driven along {axis}" + (": sealed" if sealed[direction] else ""), fontsize=10)
        speed = np.hypot(*flux(gap, spacing, correctors[direction], direction))
        speed[gap == 0] = np.nan
        if sealed[direction]:
            speed[:] = np.nan
        top = float(np.nanmax(speed)) if np.isfinite(speed).any() else 1.0
        norm = mpl.colors.LogNorm(vmin=FAINT * top, vmax=top, clip=True)
        image = _map(axes, speed[::step, ::step], (width, height), cmap=FLOWS, norm=norm)
        figure.colorbar(image, ax=axes, label="flux, m³ (per unit gradient)", location="bottom", shrink=0.9)
    return svg(figure)


def _map(axes: Axes, values: Array, size: tuple[float, float], **how: object) -> mpl.image.AxesImage:
    axes.grid(visible=False)
    axes.set_xlabel("x, µm")
    axes.set_ylabel("y, µm")
    extent = (0.0, 1e6 * size[0], 0.0, 1e6 * size[1])
    return axes.imshow(values.T, origin="lower", extent=extent, interpolation="nearest", **how)  # type: ignore[arg-type]
