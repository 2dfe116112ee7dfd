"""Rough gaps: where the liquid passes, and how fast it is across the gap."""

from collections.abc import Mapping
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.ticker import MaxNLocator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import model_map, new_figure, svg, thinned
from roughfilm.figures.differences import QUANTILE, differences, on_points
from roughfilm.figures.view import Plot, Style, View, groups_by
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.words.scales import scale_for, scales_of

STYLES = {
    "smooth_gap": Style(colour="#7f7f7f", line=":", marker="s"),
    "homogenized": Style(colour="#5aae61", line=(0, (5, 1)), marker="^"),
    "slope_corrected": Style(colour="#e08214", line="-.", marker="D"),
    "stokes": Style(colour="#762a83", line="--", marker="P"),
    "navier_stokes": Style(colour="#2166ac", line="-", marker="o"),
}

CONTACT = "#b9c2cc"

COEFFICIENTS = {
    "A11": "flow along x (A11)",
    "A22": "flow along y (A22)",
    "B1": "flow by sliding (B1)",
    "friction": "friction",
}
"""The factors that are drawn, with their names."""


def factors(results: Mapping[str, Result]) -> str:
    """The coefficients by every model, with their uncertainty."""
    given = [name for name in COEFFICIENTS if all(name in result.quantities for result in results.values())]
    figure, panels = new_figure((10, 2.9), 1, len(given), sharey=True, squeeze=False)
    for axes, name in zip(panels[0], given, strict=True):
        for place, (model, result) in enumerate(results.items()):
            style = STYLES.get(model, Style())
            axes.errorbar(
                result.quantities[name].value,
                place,
                xerr=result[name].uncertainty,
                color=style.colour,
                marker=style.marker,
                capsize=3,
                linestyle="",
            )
        axes.set_yticks(range(len(results)), list(results))
        axes.xaxis.set_major_locator(MaxNLocator(4))
        axes.ticklabel_format(axis="x", useOffset=False)
        axes.set(ylim=(-0.6, len(results) - 0.4))
        axes.set_xlabel(f"{COEFFICIENTS[name]}\nover that of a smooth gap", fontsize=9)
        axes.margins(x=0.15)
    return svg(figure)


def sections(results: Mapping[str, Result], reference: str) -> Plot:
    """Speed along x in the section where the gap is narrowest, by the reference, and the differences of the others."""
    shown = reference if reference in results else [*results][-1]
    vertices = results[shown].fields["vertices"].values
    open_cells = results[shown].fields["kept"].values > 0
    gap = vertices[:, :, -1, 2] - vertices[:, :, 0, 2]
    row = int(np.argmin(np.where(open_cells, gap[:-1, :-1], np.inf).min(axis=0)))
    same = {
        name: one for name, one in results.items() if one.fields["cell_velocity"].values.shape[:2] == gap[1:, 1:].shape
    }
    speeds = {
        name: np.where(open_cells[:, row, None], one.fields["cell_velocity"].values[:, row, :, 0], np.nan)
        for name, one in same.items()
    }
    scale = scale_for("m/s", float(np.nanmax(speeds[shown])))
    flow = results[shown].quantities["A11"]
    bar = float(np.nanmax(speeds[shown])) * (flow.uncertainty or 0.0) / flow.value if flow.value else 0.0
    found = differences(speeds, shown, "speed along x in this section", scale, bar)
    figure, panels = new_figure((10, 2.5 * (1 + len(found.drawn))), 1 + len(found.drawn), 1, squeeze=False, sharex=True)
    least = min(0.0, float(np.nanmin(speeds[shown])) / scale.factor)
    drawn = {shown: speeds[shown] / scale.factor, **found.drawn}
    for axes, (name, values) in zip(panels[:, 0], drawn.items(), strict=True):
        look = {"cmap": "magma", "vmin": least} if name == shown else found.colours
        x, z = (vertices[:, row, :, part] * 1e6 for part in (0, 2))
        image = axes.pcolormesh(x, z, values, rasterized=True, **look)
        axes.set_facecolor(CONTACT)
        axes.grid(visible=False)
        place = f"y = {vertices[0, row, 0, 1] * 1e6:.3g} µm"
        axes.set_title(f"by {shown}, {place}" if name == shown else f"{name} minus {shown}", fontsize=9)
        axes.set_ylabel("z, µm")
        figure.colorbar(image, ax=axes, label=scale.label("speed along x" if name == shown else "difference"))
    panels[-1, 0].set_xlabel("x, µm")
    return Plot(svg=svg(figure), words=found.words)


def maps(scene: RoughGap, results: Mapping[str, Result], reference: str) -> Plot:
    """The gap, the flow per width by the reference model, and the differences of the other models of these results."""
    shown = reference if reference in results else [*results][-1]
    flows = {name: _thinned_to(result, results[shown]) for name, result in results.items()}
    strongest = float(np.percentile(flows[shown], QUANTILE))
    scale = scale_for("m^2/s", strongest)
    flow = results[shown].quantities["A11"]
    bar = strongest * (flow.uncertainty or 0.0) / flow.value if flow.value else 0.0
    found = differences(flows, shown, "flow", scale, bar)
    gap = thinned(results[shown].fields["gap"].values)
    of_gap = scales_of([results[reference]])("mean_gap", "m")
    label = scale.label("flow per width")
    drawn: list[tuple[str, Array, dict[str, Any], str]] = [
        ("gap", np.where(gap > 0, gap / of_gap.factor, np.nan), {"cmap": "cividis", "vmin": 0}, of_gap.label("gap")),
        (
            f"flow by {shown}",
            flows[shown] / scale.factor,
            {"cmap": "magma", "vmin": 0, "vmax": strongest / scale.factor},
            label,
        ),
    ]
    drawn += [
        (f"{name} minus {shown}", one, found.colours, f"difference in\n{label}") for name, one in found.drawn.items()
    ]
    figure, panels = new_figure((10, 3.3), 1, len(drawn), sharey=True)
    for axes, (title, values, look, name) in zip(panels, drawn, strict=True):
        palette = mpl.colormaps[look.pop("cmap")].with_extremes(bad=CONTACT)
        image = model_map(axes, title, values, scene.surface().size, cmap=palette, **look)
        axes.label_outer()
        figure.colorbar(image, ax=axes, label=name, shrink=0.85)
    return Plot(svg=svg(figure), words=found.words)


def _thinned_to(result: Result, other: Result) -> Array:
    """The flow of a result on the points of another one, of one period both."""
    own, wanted = (one.fields["flow"].values.shape for one in (result, other))
    if own == wanted:
        return np.asarray(thinned(result.fields["flow"].values))
    places = [[(np.arange(count) + 0.5) / count for count in shape] for shape in (own, wanted)]
    return np.asarray(thinned(on_points(places[0], result.fields["flow"].values, places[1])))


def plots(scene: RoughGap, results: Mapping[str, Result], reference: str) -> dict[str, Plot]:
    """The figures of a comparison: sections where a model resolves the film, maps where the gap varies both ways."""
    shown = {"factors": Plot(svg=factors(results))} if len(results) > 1 else {}
    resolved = {name: result for name, result in results.items() if "cell_velocity" in result.fields}
    if resolved:
        shown["sections"] = sections(resolved, reference)
    thin = {name: result for name, result in results.items() if name == "homogenized"}
    top = {reference: resolved[reference]} if reference in resolved else dict([*resolved.items()][-1:])
    mapped = thin | top
    if mapped and min(scene.surface().shape) > 2:
        shown["maps"] = maps(scene, mapped, reference)
    return shown


VIEW = View(
    page="rough_gap.html.j2",
    styles=STYLES,
    cards=("A22", "flow_per_width_x", "flow_per_width_y", "friction", "contact_area"),
    rows=("A11", "A22", "A12", "flow_per_width_x", "flow_per_width_y", "B1", "friction", "mean_gap", "contact_area"),
    plots=plots,
    drawing="roughfilm.figures.gap_view",
    groups=groups_by("rough_surface"),
    errors="of the flow along x and of the flow along y",
    ordering="the rms slope g', rms height over mean gap Sq/h̄ and the Reynolds number Re",
    left_out=" Cases that are almost closed are left out.",
)
