"""Rough gaps: where the liquid passes, and how fast it is across the gap."""

from collections.abc import Mapping

import matplotlib as mpl
import numpy as np

from roughfilm.figures.base import model_map, new_figure, svg, thinned
from roughfilm.figures.view import Style, View, groups_by
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.rough_gap.scene import RoughGap

STYLES = {
    "smooth_gap": Style(colour="#7f7f7f", line=":", marker="s"),
    "homogenized": Style(colour="#5aae61", line=(0, (5, 1)), marker="^"),
    "slope_corrected": Style(colour="#e08214", line="-.", marker="D"),
    "stokes": Style(colour="#762a83", line="--", marker="P"),
    "navier_stokes": Style(colour="#2166ac", line="-", marker="o"),
}

CONTACT = "#b9c2cc"

COEFFICIENTS = ("A11", "A22", "B1", "friction")


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
        axes.set(ylim=(-0.6, len(results) - 0.4), xlabel=f"{name}, relative to a smooth gap")
        axes.margins(x=0.15)
    return svg(figure)


def sections(results: Mapping[str, Result]) -> str:
    """Speed along x in the section along x where the gap is narrowest, under the gradient along x."""
    figure, panels = new_figure((10, 2.3 * len(results)), len(results), 1, squeeze=False)
    fastest = max(float(result.fields["cell_velocity"].values[..., 0].max()) for result in results.values())
    for axes, (name, result) in zip(panels[:, 0], results.items(), strict=True):
        vertices, velocity = (result.fields[field].values for field in ("vertices", "cell_velocity"))
        open_cells = result.fields["kept"].values > 0
        gap = vertices[:, :, -1, 2] - vertices[:, :, 0, 2]
        row = int(np.argmin(np.where(open_cells, gap[:-1, :-1], np.inf).min(axis=0)))
        speed = np.where(open_cells[:, row, None], velocity[:, row, :, 0], np.nan)
        image = axes.pcolormesh(
            vertices[:, row, :, 0] * 1e6,
            vertices[:, row, :, 2] * 1e6,
            speed * 1e3,
            cmap="magma",
            vmin=min(0.0, float(np.nanmin(speed)) * 1e3),
            vmax=fastest * 1e3,
            rasterized=True,
        )
        axes.set_facecolor(CONTACT)
        axes.grid(visible=False)
        axes.set_title(f"{name}, y = {vertices[0, row, 0, 1] * 1e6:.3g} µm", fontsize=9)
        axes.set_ylabel("z, µm")
        figure.colorbar(image, ax=axes, label="speed along x, mm/s")
    panels[-1, 0].set_xlabel("x, µm")
    return svg(figure)


def maps(scene: RoughGap, results: Mapping[str, Result]) -> str:
    """The gap, and the flow per width under the gradient along x by each of these models."""
    gap = thinned([*results.values()][-1].fields["gap"].values) * 1e6
    flows = {name: thinned(result.fields["flow"].values) * 1e6 for name, result in results.items()}
    strongest = max(float(np.percentile(flow, 99.9)) for flow in flows.values()) or 1.0
    drawn = [("gap", np.where(gap > 0, gap, np.nan), "cividis", float(gap.max()), "µm")]
    drawn += [(name, flow, "magma", strongest, "flow per width, mm²/s") for name, flow in flows.items()]
    figure, panels = new_figure((10, 3.1), 1, len(drawn), sharey=True)
    for axes, (name, values, colours, top, label) in zip(panels, drawn, strict=True):
        palette = mpl.colormaps[colours].with_extremes(bad=CONTACT)
        image = model_map(axes, name, values, scene.surface().size, cmap=palette, vmin=0, vmax=top)
        axes.label_outer()
        figure.colorbar(image, ax=axes, label=label, shrink=0.85)
    return svg(figure)


def plots(scene: RoughGap, results: Mapping[str, Result]) -> dict[str, str]:
    """The figures of a comparison: sections where a model resolves the film, maps where the gap varies both ways."""
    shown = {"factors": factors(results)}
    resolved = {name: result for name, result in results.items() if "cell_velocity" in result.fields}
    if resolved:
        shown["sections"] = sections(resolved)
    thin = {name: result for name, result in results.items() if name == "homogenized"}
    mapped = thin | dict([*resolved.items()][-1:])
    if mapped and min(scene.surface().shape) > 2:
        shown["maps"] = maps(scene, mapped)
    return shown


VIEW = View(
    page="rough_gap.html.j2",
    styles=STYLES,
    labels={"A11": "flow along x", "A22": "flow along y"},
    headings={
        "A11": "A<sub>11</sub>/h̄³",
        "A22": "A<sub>22</sub>/h̄³",
        "A12": "A<sub>12</sub>/h̄³",
        "B1": "B<sub>1</sub>/h̄",
        "friction": "friction<br>τ h̄/(ηu)",
        "flow_per_width_x": "flow along x<br>per width",
    },
    plots=plots,
    drawing="roughfilm.figures.gap_view",
    groups=groups_by("rough_surface"),
    errors="of the flow along x and of the flow along y",
    ordering="slope g', Sq/h̄ and Re",
    left_out=" Cases that are almost closed are left out.",
)
