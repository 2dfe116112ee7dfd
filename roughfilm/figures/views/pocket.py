"""Pockets: pressure on the sliding wall, flow in the film, and errors over width and depth of grooves or dimples."""

from collections.abc import Callable, Mapping
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.colors import LogNorm
from numpy.typing import NDArray

from roughfilm.figures.base import new_figure, svg
from roughfilm.figures.differences import differences
from roughfilm.figures.plan.on_wall import maps, pressure_along
from roughfilm.figures.plan.section import section
from roughfilm.figures.streamlines import shown
from roughfilm.figures.view import Plot, Style, View
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.sweeping import Columns
from roughfilm.rom.pocket.kind import KIND
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.studies.reference import Reference, interval
from roughfilm.rom.studies.sweep import Sweep, relative_error
from roughfilm.words.scales import Scale, scales_of

MIN_PERCENT = 1e-3

STYLES = {
    "reynolds": Style(colour="#7f7f7f", line="--", marker="s"),
    "inertial_reynolds": Style(colour="#e08214", line="-.", marker="D"),
    "reynolds_cavitating": Style(colour="#8c510a", line=(0, (1, 1)), marker="X"),
    "film": Style(colour="#b2182b", line=(0, (5, 1)), marker="v"),
    "film_slope": Style(colour="#762a83", line=(0, (3, 1, 1, 1)), marker="P"),
    "stokes": Style(colour="#5aae61", line=":", marker="^"),
    "navier_stokes": Style(colour="#2166ac", line="-", marker="o"),
}


def pressure(scene: Pocket, results: Mapping[str, Result], reference: str) -> str:
    """Pressure on the sliding wall by every model, with the edges of the grooves."""
    figure, axes = new_figure((9, 4.4))
    scale = scales_of([results[reference]])("pressure", "Pa")
    for name, result in results.items():
        x = result.fields["position"].values * 1e3
        style = STYLES.get(name, Style())
        p = result.fields["pressure"].values / scale.factor
        axes.plot(x, p, linestyle=style.line, color=style.colour, label=name, linewidth=2)
    for number, edge in enumerate(sorted({edge for groove in scene.grooves for edge in groove.span})):
        axes.axvline(
            edge * 1e3,
            color="black",
            linewidth=0.8,
            linestyle=(0, (4, 3)),
            alpha=0.6,
            label=None if number else "edges of the groove" + ("s" if len(scene.grooves) > 1 else ""),
        )
    axes.set(xlabel="position along the sliding wall, mm", ylabel=scale.label("pressure"))
    unit = scene.pressure_unit / scene.plus_factor / scale.factor
    right = axes.secondary_yaxis("right", functions=(_times(1 / unit), _times(unit)))
    right.set_ylabel("dimensionless pressure\np+ = 100 p Ly² / (η u Lx)")
    figure.legend(loc="outside upper center", ncols=4, fontsize=8)
    return svg(figure)


def _times(factor: float) -> Callable[[Any], Any]:
    return lambda value: value * factor


def flows(scene: Pocket, results: Mapping[str, Result], reference: str) -> Plot | None:
    """The differences in the speed of the liquid from the reference model; None where it does not resolve the film.

    Speeds are over the sliding speed, on the cells of the reference.
    """
    resolved = {name: result for name, result in results.items() if "cell_velocity" in result.fields}
    if reference not in resolved or len(resolved) < 2:
        return None
    top = resolved[reference]
    speeds = {name: _speed_on(result, top, scene.speed) / scene.speed for name, result in resolved.items()}
    found = differences(speeds, reference, "speed", Scale(factor=0.01, unit="% of the sliding speed"))
    if not found.drawn:
        return Plot(svg="", words=found.words)
    vertices = top.fields["vertices"].values
    window = shown(vertices)
    x, y = vertices[window, :, 0] * 1e6, vertices[window, :, 1] * 1e6
    inside = slice(window.start, window.stop - 1)
    figure, panels = new_figure((10, 0.5 + 1.9 * len(found.drawn)), len(found.drawn), 1, squeeze=False, sharex=True)
    for axes, (name, values) in zip(panels[:, 0], found.drawn.items(), strict=True):
        image = axes.pcolormesh(x, y, values[inside], rasterized=True, **found.colours)
        axes.grid(visible=False)
        axes.set_title(f"{name} minus {reference}", fontsize=9)
        axes.set_ylabel("height, µm")
    panels[-1, 0].set_xlabel("position along the sliding wall, µm")
    figure.colorbar(image, ax=panels, label="difference in speed,\n% of the sliding speed", shrink=0.9)
    return Plot(svg=svg(figure), words=found.words)


def _speed_on(result: Result, other: Result, sliding: float) -> NDArray[np.float64]:
    """The speed in the cells of another result, linear between them, and 0 and ``sliding`` on the walls."""
    heights, places, speed = _cells(result)
    at, across, _ = _cells(other)
    if heights.shape == at.shape and np.allclose(heights, at) and np.allclose(places, across):
        return speed
    period = float(np.ptp(result.fields["vertices"].values[:, 0, 0]))
    around = np.concatenate([places[-1:] - period, places, places[:1] + period])
    columns = np.concatenate([[-1], np.arange(places.size), [0]])
    middle = at.mean(axis=0)
    ends = [np.concatenate([[0.0], one, [1.0]]) for one in heights]
    profiles = [np.concatenate([[0.0], one, [sliding]]) for one in speed]
    levels = np.array([np.interp(middle, *one) for one in zip(ends, profiles, strict=True)])[columns]
    return np.array([np.interp(across, around, level) for level in levels.T]).T


def _cells(result: Result) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """The cells of a result: heights over the gap, shape (nx, ny), places along, shape (nx,), and speeds, m/s."""
    vertices, velocity = result.fields["vertices"].values, result.fields["cell_velocity"].values
    middle = (vertices[:-1, :-1] + vertices[1:, :-1] + vertices[:-1, 1:] + vertices[1:, 1:]) / 4
    low, high = ((vertices[:-1, end, 1] + vertices[1:, end, 1]) / 2 for end in (0, -1))
    heights = (middle[..., 1] - low[:, None]) / (high - low)[:, None]
    return heights, middle.mean(axis=1)[:, 0], np.linalg.norm(velocity, axis=2)


def plots(scene: Pocket, results: Mapping[str, Result], reference: str) -> dict[str, Plot]:
    """The figures of a comparison; differences of flows, or a section of a dimple, where models resolve the film."""
    if scene.in_plan:
        return _plots_in_plan(scene, results, reference)
    lines = {"pressure": Plot(svg=pressure(scene, results, reference))}
    found = flows(scene, results, reference)
    return lines | ({"flows": found} if found else {})


def _plots_in_plan(scene: Pocket, results: Mapping[str, Result], reference: str) -> dict[str, Plot]:
    """The figures of a cell in plan; a section of the flow by the reference, or by the last model that resolves it."""
    found = {
        "maps": maps(scene, results, reference),
        "pressure": Plot(svg=pressure_along(scene, results, reference, STYLES)),
    }
    resolved = [name for name, result in results.items() if "cell_velocity" in result.fields]
    if not resolved:
        return found
    top = reference if reference in resolved else resolved[-1]
    return {**found, "section": Plot(svg=section(scene, results[top]), words=(f"By {top}.",))}


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
    cards=("friction_per_area", "load_plus", "friction_plus", "backflow"),
    rows=(
        "load_per_area",
        "friction_per_area",
        "load_plus",
        "load_from_corner_plus",
        "friction_plus",
        "pressure_max_plus",
        "pressure_min_plus",
        "backflow",
    ),
    plots=plots,
    line="pressure",
    drawing="roughfilm.figures.streamlines",
    groups=groups,
    maps=error_maps,
    errors="of the load and of the friction on the sliding wall",
    left_out=" Cases whose load is under a twentieth of the greatest pressure are left out here and in the table "
    "above: their load is the difference of two larger ones.",
    ordering="the Reynolds number Re, depth over film d/Ly, twice the depth over the width 2d/w and the slope of the "
    "steeper side",
)
