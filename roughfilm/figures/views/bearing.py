"""Bearings: pressure and filled part along the film, and over it where it has a width."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import MAX_PIXELS, new_figure, svg
from roughfilm.figures.differences import Differences, differences, on_points
from roughfilm.figures.shafts.angles import EDGE_COLOUR, FEW_TICKS, GAP_COLOUR, LEAST_COLOUR, Along, along_of
from roughfilm.figures.shafts.around import around
from roughfilm.figures.view import Plot, Style, View, groups_by
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.pivoted import Tilting
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.supply.tables import MAX_SUPPLIES
from roughfilm.rom.ladder.result import Result
from roughfilm.words.scales import Scale, scales_of

MAX_COLUMNS = 4
"""Largest number of models whose differences stand beside each other."""

EVEN_DENSITY = 0.12
"""Range of densities below which a film is drawn as whole."""

STYLES = {
    "reynolds": Style(colour="#7f7f7f", line="--", marker="s"),
    "infinitely_wide": Style(colour="#5aae61", line=":", marker="^"),
    "reynolds_incompressible": Style(colour="#e08214", line="-.", marker="D"),
    "reynolds_cavitating": Style(colour="#2166ac", line="-", marker="o"),
    "homogenized": Style(colour="#b2182b", line="-", marker="v"),
    "direct": Style(colour="#252525", line="-", marker="P"),
    "mixed": Style(colour="#762a83", line="-", marker="X"),
    "shear_thinning": Style(colour="#1b7837", line="-.", marker="H"),
    "heat_balance": Style(colour="#a6611a", line="--", marker="p"),
    "adiabatic": Style(colour="#e7298a", line="-", marker="d"),
    "across": Style(colour="#01665e", line="-", marker="*"),
    "film": Style(colour="#d6604d", line=(0, (5, 1)), marker="<"),
    "film_slope": Style(colour="#9970ab", line=(0, (3, 1, 1, 1)), marker=">"),
    "stokes": Style(colour="#35978f", line=":", marker="h"),
    "navier_stokes": Style(colour="#c51b7d", line="-", marker="*"),
}


def along(scene: Bearing, results: Mapping[str, Result], reference: str) -> str:
    """Film thickness, pressure, density and temperature by every model, on the line of the greatest pressure.

    Under a load each model has a film of its own.
    """
    warm = any("temperature" in result.fields for result in results.values())
    ratios = (1, 2.2, 1.5, 1.5) if warm else (1, 2.2, 1.5)
    figure, panels = new_figure((9, 8.6 if warm else 6.8), len(ratios), 1, sharex=True, height_ratios=ratios)
    film, pressure, density, *more = panels
    axis, scales = along_of(scene), scales_of([results[reference]])
    of_film, of_pressure = scales("film_min", "m"), scales("pressure_max", "Pa")
    for number, (name, result) in enumerate(results.items()):
        style = STYLES.get(name, Style())
        row = int(np.argmax(result.fields["pressure"].values.max(axis=0)))
        place, h, p, theta = (
            result.fields[field].values[:, row] for field in ("x", "film_thickness", "pressure", "density_ratio")
        )
        x = axis(place)
        if scene.load is not None:
            film.plot(x, axis.lobes_only(x, h / of_film.factor), linestyle=style.line, color=style.colour)
        elif number == 0:
            film.fill_between(x, axis.lobes_only(x, h / of_film.factor), color="#9ecae1", linewidth=0)
        if name == "direct":
            film.plot(x, axis.lobes_only(x, h / of_film.factor), color=style.colour, linewidth=0.6)
        thin = x.size > 2 * MAX_PIXELS and name == "direct"
        look = {"linestyle": style.line, "color": style.colour, "linewidth": 1.0 if thin else 1.8}
        pressure.plot(x, p / of_pressure.factor, label=name, **look)
        density.plot(x, theta, **look)
        for temperature in more if "temperature" in result.fields else ():
            temperature.plot(x, result.fields["temperature"].values[:, row], **look)
    lowest = scene.lubricant.cavitation_pressure / of_pressure.factor
    pressure.axhline(lowest, color="black", linewidth=0.8, linestyle=(0, (1, 2)), label="cavitation pressure")
    film.set(ylim=(0, 1.08 * film.get_ylim()[1]), ylabel=of_film.label("film thickness"))
    pressure.set_ylabel(of_pressure.label("pressure\nabove ambient"))
    density.set_ylabel("relative density θ\n(filled fraction)")
    for temperature in more:
        temperature.set_ylabel("mean temperature\nacross the film, °C")
    panels[-1].set_xlabel(axis.label)
    if np.ptp(density.get_ylim()) < EVEN_DENSITY:  # a film that is whole everywhere is to look so
        density.set_ylim(1 - EVEN_DENSITY, 1 + EVEN_DENSITY / 4)
    if isinstance(scene.geometry, Tilting):
        for result in results.values():
            height = result.quantities["pivot_film"].value / of_film.factor
            film.plot(
                axis.pivots[0][0], height, "^", color=GAP_COLOUR, markeredgecolor=EDGE_COLOUR, markersize=7, zorder=4
            )
    shown = results[reference].fields
    across = float(shown["y"].values[0, int(np.argmax(shown["pressure"].values.max(axis=0)))])
    for axes in panels:
        axis.mark(axes, named=axes is pressure, at=across)
    figure.legend(loc="outside upper center", ncols=4, fontsize=8)
    figure.align_ylabels()
    return svg(figure)


def over(scene: Bearing, results: Mapping[str, Result], reference: str) -> Plot:
    """Pressure, density and temperature over the film by the reference model, and how others with a width differ.

    Differences in one quantity have the same colours.
    """
    planes = {name: result for name, result in results.items() if result.fields["pressure"].values.shape[1] > 1}
    shown = reference if reference in planes else [*planes][-1]
    result, axis = planes[shown], along_of(scene)
    place = [result.fields["x"].values[:, 0], result.fields["y"].values[0]]
    scales = scales_of([result])
    fields = {
        "pressure": ("pressure", scales("pressure_max", "Pa"), "pressure_max", "magma"),
        "density_ratio": ("relative density θ", Scale(factor=1.0, unit=""), "theta_min", "cividis"),
    }
    if "temperature" in result.fields:
        fields["temperature"] = ("temperature", Scale(factor=1.0, unit="°C"), "temperature_max", "inferno")
    found = {}
    for name, (title, scale, decided_by, _) in fields.items():
        maps = {model: _on(one, name, place) for model, one in planes.items() if name in one.fields}
        found[name] = differences(maps, shown, title, scale, result.quantities[decided_by].uncertainty)
    others = [model for model in planes if any(model in one.drawn for one in found.values())]
    unequal = {name: one for name, one in found.items() if one.drawn}
    columns = max(len(fields), min(len(others), MAX_COLUMNS))
    rows = 1 if len(others) == 1 else sum(_lines(one, columns) for one in unequal.values())
    figure = Figure(figsize=(10, 3.4 + 2.1 * rows), layout=ConstrainedLayoutEngine(w_pad=0.1, h_pad=0.08))
    spaces = figure.add_gridspec(2 if rows else 1, 1, height_ratios=(3.4, 2.1 * rows)[: 2 if rows else 1])
    x, y = axis(place[0]), place[1] * 1e3
    upper: Any = spaces[0].subgridspec(1, len(fields)).subplots()
    for axes, (name, (title, scale, _, colours)) in zip(upper, fields.items(), strict=True):
        values = result.fields[name].values / scale.factor
        # a film that is whole everywhere is to look so
        limits = {"vmin": min(values.min(), 0.9), "vmax": max(values.max(), 1.0)} if name == "density_ratio" else {}
        image = _map(axes, x, y, values, cmap=colours, **limits)
        axes.set_title(f"{title} by {shown}", fontsize=9)
        axes.set(xlabel=axis.label, ylabel="across, mm")
        _mark(axes, axis, result)
        figure.colorbar(image, ax=axes, label=scale.label(title))
    if rows:
        panels = spaces[1].subgridspec(rows, columns).subplots(squeeze=False, sharex=True, sharey=True)
        _difference_maps(panels, unequal, fields, (x, y), axis, beside=len(others) == 1)
    return Plot(svg=svg(figure), words=tuple(words for one in found.values() for words in one.words))


def _lines(drawn: Differences, columns: int) -> int:
    """The number of rows that the differences in one quantity take."""
    return -(-len(drawn.drawn) // columns)


def _difference_maps(
    panels: Any,
    found: Mapping[str, Differences],
    fields: Mapping[str, Any],
    place: tuple[Array, Array],
    along: Along,
    *,
    beside: bool,
) -> None:
    """Draw the differences of the other models: one quantity below the other, or beside it if there is one model."""
    for axes in panels.flat:
        axes.set_axis_off()
    begin = 0
    for row, (name, one) in enumerate(found.items()):
        end = begin + (1 if beside else _lines(one, panels.shape[1]))
        line = panels[:, row : row + 1] if beside else panels[begin:end]
        begin = end
        for axes, (model, difference) in zip(line.flat, one.drawn.items(), strict=False):
            axes.set_axis_on()
            image = _map(axes, *place, difference, **one.colours)
            axes.set_title(model, fontsize=9)
            axes.set_xlabel(along.label, fontsize=8)
            axes.set_ylabel("across, mm", fontsize=8)
            along.mark(axes, covered=True, ticks=FEW_TICKS)
            along.outline(axes)
            axes.label_outer()
        title, scale = fields[name][:2]
        label = scale.label(f"difference\nin {title}").replace("°C", "K")
        axes.figure.colorbar(image, ax=line, label=label, shrink=0.95)


def _map(axes: Axes, x: Array, y: Array, values: Array, **look: Any) -> Any:
    """Draw values of shape (nx, ny) over their places."""
    axes.grid(visible=False)
    steps = tuple(slice(None, None, max(1, -(-count // MAX_PIXELS))) for count in values.shape)
    drawn = np.asarray(values)[steps].T
    return axes.pcolormesh(x[steps[0]], y[steps[1]], drawn, shading="nearest", rasterized=True, **look)


def _on(result: Result, field: str, place: Sequence[Array]) -> Array:
    """A field of a result on the points of the reference."""
    own = [result.fields["x"].values[:, 0], result.fields["y"].values[0]]
    return on_points(own, result.fields[field].values, place)


def _mark(axes: Axes, along: Along, result: Result) -> None:
    """Mark the gaps between lobes, the direction of the load, the supplies, the pivots and the least film on a map."""
    along.mark(axes, covered=True, ticks=FEW_TICKS)
    along.outline(axes)
    if along.around:
        least = [result.quantities[name].value for name in ("film_min_x", "film_min_y")]
        axes.plot(along(np.array(least[:1])), [1e3 * least[1]], "x", color=LEAST_COLOUR, markersize=7, zorder=4)


def plots(scene: Bearing, results: Mapping[str, Result], reference: str) -> dict[str, Plot]:
    """The figures of a comparison; maps only where a model keeps the width."""
    plane = any(result.fields["pressure"].values.shape[1] > 1 for result in results.values())
    drawn = {"along": Plot(svg=along(scene, results, reference))}
    if isinstance(scene.geometry, Lobes):
        drawn["around"] = Plot(svg=around(scene, results, reference, STYLES))
    return drawn | ({"over": over(scene, results, reference)} if plane else {})


VIEW = View(
    page="bearing.html.j2",
    styles=STYLES,
    cards=(
        "film_min",
        "load",
        "friction_coefficient",
        "power_loss",
        "pressure_max",
        "temperature_max",
        "supply_flow",
        "contact_share",
        "cavitated_fraction",
        "eccentricity",
    ),
    rows=(
        "film_min",
        "eccentricity",
        "attitude_angle",
        "pivot_film",
        "slope_x",
        "slope_y",
        "load",
        "contact_share",
        "friction",
        "friction_coefficient",
        "power_loss",
        "pressure_max",
        "temperature_max",
        "temperature_mean",
        "effective_temperature",
        "inlet_temperature",
        "outlet_temperature",
        "shaft_temperature",
        "heat_to_lubricant",
        "heat_to_fixed_wall",
        "heat_to_sliding_wall",
        "heat_to_surroundings",
        "inlet_flow",
        "side_leakage",
        "supply_flow",
        *(f"supply_{number}_{kind}" for number in range(1, MAX_SUPPLIES + 1) for kind in ("flow", "pressure")),
        "cavitated_fraction",
        "film_start",
        "rupture",
    ),
    plots=plots,
    line="along",
    drawing="roughfilm.figures.streamlines",
    groups=groups_by("shape"),
    errors="of the load and of the friction on the sliding wall",
    ordering="the relative density θ of the inlet, the compression ϑ at the pressure 6ηuL/h² and width over length B/L",
)
