"""Pressure and shear stress on the sliding wall of a cell in plan, and its film thickness."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import MAX_PIXELS, new_figure, svg
from roughfilm.figures.differences import QUANTILE, SIGNED, differences, on_points
from roughfilm.figures.plan.places import MIN_DEPTH, along, edges_on, middle_line
from roughfilm.figures.view import Plot, Style
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.pocket.plan.plan import Plan
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.words.scales import Scale, scale_for, scales_of

MAX_COLUMNS = 3
"""Largest number of maps beside each other."""

OUTLINE_POINTS = 241
"""Points along the longer side of the cell by which the outlines of dimples are drawn."""


def pressure_along(scene: Pocket, results: Mapping[str, Result], reference: str, styles: Mapping[str, Style]) -> str:
    """Pressure on the sliding wall by every model along the middle line of a dimple, with the film thickness above."""
    y = middle_line(scene)
    figure, (film, axes) = new_figure((9, 5), 2, 1, sharex=True, height_ratios=(1, 3))
    scale, of_length = scales_of([results[reference]])("pressure", "Pa"), scale_for("m", scene.geometry.length)
    x, h = along(scene, results[reference], "film_thickness", y)
    film.fill_between(x / of_length.factor, h * 1e6, color="#9ecae1", linewidth=0)
    film.set(ylim=(0, None), ylabel="film\nthickness, µm")
    for name, result in results.items():
        style = styles.get(name, Style())
        x, p = along(scene, result, "pressure", y)
        line: dict[str, Any] = {"linestyle": style.line, "color": style.colour, "linewidth": 2}
        axes.plot(x / of_length.factor, p / scale.factor, label=name, **line)
    dashed: dict[str, Any] = {"color": "black", "linewidth": 0.8, "linestyle": (0, (4, 3)), "alpha": 0.6}
    for number, edge in enumerate(edges_on(scene, y)):
        label = None if number else "edges of the dimple" + ("s" if len(edges_on(scene, y)) > 2 else "")
        axes.axvline(edge / of_length.factor, label=label, **dashed)
    axes.set(xlabel=of_length.label("position x along the sliding"), ylabel=scale.label(f"pressure at y = {_at(y)}"))
    figure.legend(loc="outside upper center", ncols=4, fontsize=8)
    figure.align_ylabels()
    return svg(figure)


def _at(y: float) -> str:
    return f"{1e6 * y:.4g} µm".replace("-", "−") if abs(y) > 1e-12 else "0"


def maps(scene: Pocket, results: Mapping[str, Result], reference: str) -> Plot:
    """Maps of film thickness, pressure and shear stress by the reference, and the pressure of the others minus its."""
    top, scales = results[reference], scales_of([results[reference]])
    place = [top.fields["x"].values[:, 0], top.fields["y"].values[0]]
    of_pressure, of_stress = scales("pressure", "Pa"), scales("friction_per_area", "Pa")
    pressures = {name: _on(result, place) for name, result in results.items()}
    uncertainty = top.quantities["pressure_max_plus"].uncertainty
    bar = None if uncertainty is None else uncertainty * scene.pressure_unit / scene.plus_factor
    found = differences(pressures, reference, "pressure on the sliding wall", of_pressure, bar)
    rows = -(-len(found.drawn) // MAX_COLUMNS)
    ratio = min(max(scene.plan().breadth / scene.geometry.length, 0.3), 2.0)
    height = 0.75 + 1.85 * ratio
    figure = Figure(
        figsize=(10, height * (1 + rows)), layout=ConstrainedLayoutEngine(w_pad=0.08, h_pad=0.08, compress=True)
    )
    panels = figure.subplots(1 + rows, MAX_COLUMNS, squeeze=False)
    p = top.fields["pressure"].values
    limit = float(np.percentile(np.abs(p), QUANTILE)) / of_pressure.factor
    signed = {"cmap": SIGNED, "vmin": -limit, "vmax": limit}
    drawn: list[tuple[str, Array, Scale, dict[str, Any], str]] = [
        (
            "film thickness",
            top.fields["film_thickness"].values,
            scale_for("m", scene.geometry.film),
            {"cmap": "cividis"},
            "",
        ),
        ("pressure", p, of_pressure, signed, ""),
        ("shear stress", top.fields["shear_stress"].values, of_stress, {"cmap": "magma"}, ""),
    ]
    for axes, (title, values, scale, look, _) in zip(panels[0], drawn, strict=True):
        image = _map(axes, scene, place, values / scale.factor, **look)
        axes.set_title(f"{title} by {reference}" if title != "film thickness" else title, fontsize=9)
        figure.colorbar(image, ax=axes, label=scale.label(title), shrink=0.85)
    for axes in panels[1:].flat:
        axes.set_axis_off()
    for axes, (name, values) in zip(panels[1:].flat, found.drawn.items(), strict=False):
        axes.set_axis_on()
        image = _map(axes, scene, place, values, **found.colours)
        axes.set_title(f"pressure by {name} minus {reference}", fontsize=9)
        figure.colorbar(image, ax=axes, label=of_pressure.label("difference"), shrink=0.85)
    return Plot(svg=svg(figure), words=found.words)


def _on(result: Result, place: list[Array]) -> Array:
    """The pressure of a result on the points of the reference."""
    own = [result.fields["x"].values[:, 0], result.fields["y"].values[0]]
    return on_points(own, result.fields["pressure"].values, place)


def _map(axes: Axes, scene: Pocket, place: list[Array], values: Array, **look: Any) -> Any:
    """Draw values of shape (nx, ny) over the cell, with the outlines of dimples."""
    plan, of_length = scene.plan(), scale_for("m", scene.geometry.length)
    steps = tuple(slice(None, None, max(1, -(-count // MAX_PIXELS))) for count in values.shape)
    x, y = (one[step] / of_length.factor for one, step in zip(place, steps, strict=True))
    image = axes.pcolormesh(x, y, values[steps].T, shading="nearest", rasterized=True, **look)
    axes.contour(*_outlines(plan, of_length), levels=[MIN_DEPTH], colors="black", linewidths=0.6, alpha=0.6)
    axes.grid(visible=False)
    axes.set(xlabel=of_length.label("along x"), ylabel=of_length.label("across y"))
    axes.set_aspect("equal" if 0.3 < plan.breadth / plan.length < 3 else "auto")
    return image


def _outlines(plan: Plan, of_length: Scale) -> tuple[Array, Array, Array]:
    """Places over the cell, and the depth there over the greatest depth, whose contours are the outlines."""
    finest = max(plan.length, plan.breadth) / OUTLINE_POINTS
    x, y = (np.linspace(-side / 2, side / 2, max(9, round(side / finest))) for side in (plan.length, plan.breadth))
    depth = plan.thickness(x[:, None], y) - plan.film
    return x / of_length.factor, y / of_length.factor, (depth / depth.max()).T
