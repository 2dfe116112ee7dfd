"""Pockets: pressure along the sliding wall, and errors over width and depth of the groove."""

from collections.abc import Callable, Mapping
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.colors import LogNorm
from numpy.typing import NDArray

from roughfilm.figures.base import new_figure, svg
from roughfilm.figures.view import Style, View
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.sweeping import Columns
from roughfilm.rom.pocket.kind import KIND
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.studies.reference import Reference, interval
from roughfilm.rom.studies.sweep import Sweep, relative_error

MIN_PERCENT = 1e-3

STYLES = {
    "reynolds": Style(colour="#7f7f7f", line="--", marker="s"),
    "inertial_reynolds": Style(colour="#e08214", line="-.", marker="D"),
    "film": Style(colour="#b2182b", line=(0, (5, 1)), marker="v"),
    "film_slope": Style(colour="#762a83", line=(0, (3, 1, 1, 1)), marker="P"),
    "stokes": Style(colour="#5aae61", line=":", marker="^"),
    "navier_stokes": Style(colour="#2166ac", line="-", marker="o"),
}


def pressure(scene: Pocket, results: Mapping[str, Result]) -> str:
    """Pressure on the sliding wall by every model, with the edges of the grooves."""
    figure, axes = new_figure((9, 4.2))
    for name, result in results.items():
        plus = result.fields["pressure"].values / scene.pressure_unit * scene.plus_factor
        x = result.fields["position"].values * 1e3
        style = STYLES.get(name, Style())
        axes.plot(x, plus, linestyle=style.line, color=style.colour, label=name, linewidth=2)
    for edge in {edge for groove in scene.grooves for edge in groove.span}:
        axes.axvline(edge * 1e3, color="black", linewidth=0.8, linestyle=(0, (4, 3)), alpha=0.6)
    axes.set(xlabel="position along the sliding wall, mm (dashed: groove edges)", ylabel="p+ = 100 p Ly² / (η u Lx)")
    pascal = scene.pressure_unit / scene.plus_factor
    right = axes.secondary_yaxis("right", functions=(_times(pascal / 1e3), _times(1e3 / pascal)))
    right.set_ylabel("pressure, kPa")
    axes.legend()
    return svg(figure)


def _times(factor: float) -> Callable[[Any], Any]:
    return lambda value: value * factor


def _shapes(given: Columns) -> list[tuple[str, float]]:
    """The different (profile, shift) of a sweep, in order."""
    pairs = zip(given["profile"], given["shift_plus"], strict=True)
    return sorted({(str(profile), round(float(shift), 6)) for profile, shift in pairs})


def shape_name(shape: tuple[str, float]) -> str:
    """Profile, and how far its lowest point is shifted."""
    return shape[0] if shape[0] != "splined" else f"splined, xd+ = {shape[1]:g}"


def rows_of(given: Columns, shape: tuple[str, float], reynolds_number: float | None = None) -> NDArray[np.bool_]:
    """Which cases have this shape (and Reynolds number), shape (cases,)."""
    chosen = (given["profile"] == shape[0]) & (np.abs(given["shift_plus"] - shape[1]) < 1e-6)
    if reynolds_number is not None:
        chosen &= np.isclose(given["reynolds_number"], reynolds_number)
    return np.asarray(chosen)


def error_maps(sweep: Sweep, setting: str, reference: Reference, quantity: str) -> str:
    """Error of one setting over (w+, d+), in per cent: a panel for each shape and Reynolds number.

    Errors that may be 0, as they are below the uncertainty of the reference, are in parentheses.
    """
    numbers, kinds = np.unique(sweep.given["reynolds_number"]), _shapes(sweep.given)
    error = 100 * relative_error(sweep, setting, reference.setting, quantity)
    certain = interval(sweep, setting, reference, quantity)[0] > 0
    figure, panels = new_figure(
        (2.1 + 2.6 * numbers.size, 0.7 + 1.75 * len(kinds)), len(kinds), numbers.size, squeeze=False
    )
    norm = LogNorm(vmin=0.05, vmax=50)
    image = mpl.cm.ScalarMappable(norm=norm, cmap="viridis_r")
    for line, shape in zip(panels, kinds, strict=True):
        for axes, number in zip(line, numbers, strict=True):
            rows = rows_of(sweep.given, shape, number)
            widths, depths = np.unique(sweep.given["width_plus"][rows]), np.unique(sweep.given["depth_plus"][rows])
            grid, sure = np.full((depths.size, widths.size), np.nan), np.zeros((depths.size, widths.size), bool)
            place = (
                np.searchsorted(depths, sweep.given["depth_plus"][rows]),
                np.searchsorted(widths, sweep.given["width_plus"][rows]),
            )
            grid[place], sure[place] = error[rows], certain[rows]
            axes.grid(visible=False)
            axes.pcolormesh(np.maximum(grid, MIN_PERCENT), norm=norm, cmap="viridis_r")
            for (i, j), value in np.ndenumerate(grid):
                if np.isfinite(value):
                    ink = "white" if value > 4 else "black"
                    text = _short(value) if sure[i, j] else f"({_short(value)})"
                    axes.text(j + 0.5, i + 0.5, text, ha="center", va="center", fontsize=6, color=ink)
            axes.set_xticks(np.arange(widths.size) + 0.5, [f"{w:g}" for w in widths], fontsize=7, rotation=60)
            axes.set_yticks(np.arange(depths.size) + 0.5, [f"{d:g}" for d in depths], fontsize=7)
            axes.set_title(f"{shape_name(shape)}, Re = {number:g}", fontsize=8)
    figure.supxlabel("groove width w+", fontsize=9)
    figure.supylabel("groove depth d+", fontsize=9)
    figure.colorbar(image, ax=panels, label=f"error in {KIND.compared[quantity]}, %", shrink=0.8)
    return svg(figure)


def groups(given: Columns) -> dict[str, NDArray[Any]]:
    """The cases of each shape of groove, by its name."""
    return {shape_name(shape): rows_of(given, shape) for shape in _shapes(given)}


def _short(value: float) -> str:
    return f"{value:.0f}" if value >= 10 else f"{value:.1f}" if value >= 0.1 else f"{value:.2f}".lstrip("0")


VIEW = View(
    page="pocket.html.j2",
    styles=STYLES,
    labels={"load_plus": "load Fy+", "friction_plus": "friction Fx+"},
    headings={
        "load_plus": "load<br>F<sub>y</sub>+",
        "friction_plus": "friction<br>F<sub>x</sub>+",
        "pressure_max_plus": "max p+",
        "pressure_min_plus": "min p+",
        "backflow": "reverse flow",
    },
    plots=lambda scene, results: {"pressure": pressure(scene, results)},
    drawing="roughfilm.figures.streamlines",
    groups=groups,
    maps=error_maps,
    errors="of the load and of the friction on the sliding wall",
    left_out=" Cases whose load is under a twentieth of the greatest pressure are left out here and in the table "
    "above: their load is the difference of two larger ones.",
    ordering="Re, depth d/Ly, 2d/w and the slope of the steeper side",
)
