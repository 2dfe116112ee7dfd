"""Seals: the gap under load and the flow through it."""

from collections.abc import Mapping
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import map_figure, model_map, new_figure, svg, thinned
from roughfilm.figures.differences import QUANTILE, differences
from roughfilm.figures.view import Plot, Style, View, groups_by
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.seal.scene import Seal
from roughfilm.words.scales import scale_for, scales_of

STYLES = {
    "effective_medium": Style(colour="#762a83", line="--", marker="P"),
    "homogenized_leakage": Style(colour="#5aae61", line=(0, (5, 1)), marker="^"),
    "direct_leakage": Style(colour="#2166ac", line="-", marker="o"),
}

FLOW_RANGE = 1e-4
"""Ratio of the weakest flow that is drawn to the strongest; weaker flow is drawn as the weakest."""

CONTACT = "#b9c2cc"

DRAWN = 0.9995
"""Fraction of the open area whose gaps are drawn in their distribution."""


def maps(scene: Seal, results: Mapping[str, Result], reference: str) -> Plot:
    """Gap and flow over the surface by the reference model, and the differences in the flow of the others."""
    resolved = {name: result for name, result in results.items() if "flow" in result.fields}
    shown = reference if reference in resolved else [*resolved][-1]
    size, of_gap = scene.surface().size, scales_of([results[reference]])("mean_gap", "m")
    gap, flow = (thinned(resolved[shown].fields[name].values) for name in ("gap", "flow"))
    strongest = float(np.percentile(flow, QUANTILE))
    of_flow = scale_for("m^2/s", strongest)
    leakage = resolved[shown].quantities["leakage_per_width"]
    bar = strongest * (leakage.uncertainty or 0.0) / leakage.value if leakage.value else 0.0
    flows = {name: thinned(result.fields["flow"].values) for name, result in resolved.items()}
    found = differences(flows, shown, "flow", of_flow, bar)
    figure, panels = map_figure(size, 1 + -(-len(found.drawn) // 2), 4.4)
    closed = gap == 0
    top = float(np.percentile(gap, QUANTILE)) / of_gap.factor or 1.0
    _map(figure, panels[0, 0], f"gap by {shown}", of_gap.label("gap"), np.where(closed, np.nan, gap / of_gap.factor),
         size, cmap="cividis", vmin=0, vmax=top)  # fmt: skip
    weakest = FLOW_RANGE * strongest / of_flow.factor
    how = {"norm": LogNorm(weakest, strongest / of_flow.factor)} if strongest > 0 else {"vmin": 0, "vmax": 1}
    drawn = np.where(closed, np.nan, np.maximum(flow / of_flow.factor, weakest))
    label = of_flow.label("flow per width")
    _map(figure, panels[0, 1], f"flow by {shown}", label, drawn, size, cmap="magma", **how)
    rest = [*panels[1:].flat]
    for axes, (name, values) in zip(rest, found.drawn.items(), strict=False):
        heading = f"flow: {name} minus {shown}"
        _map(figure, axes, heading, f"difference in\n{label}", np.where(closed, np.nan, values), size, **found.colours)
    for axes in rest[len(found.drawn) :]:
        axes.set_axis_off()
    return Plot(svg=svg(figure), words=found.words)


def _map(
    figure: Figure, axes: Axes, title: str, label: str, values: Array, size: tuple[float, float], **look: Any
) -> None:
    """Draw a map with contact in grey, and its colour bar."""
    palette = mpl.colormaps[look.pop("cmap")].with_extremes(bad=CONTACT)
    image = model_map(axes, title, values, size, cmap=palette, **look)
    figure.colorbar(image, ax=axes, label=label, shrink=0.9)


def gaps(results: Mapping[str, Result], reference: str) -> str:
    """Density of the nominal area over the gap, by every model."""
    scale = scales_of([results[reference]])("mean_gap", "m")
    figure, axes = new_figure((10, 3.4))
    top = 0.0
    for name, result in results.items():
        style = STYLES.get(name, Style())
        edges, fraction = (result.fields[field].values for field in ("gap_edges", "gap_share"))
        edges = edges / scale.factor
        density = fraction / np.diff(edges)
        top = max(top, float(edges[1:][np.cumsum(fraction) <= DRAWN * fraction.sum()].max(initial=0.0)))
        axes.stairs(density, edges, baseline=None, color=style.colour, linestyle=style.line, linewidth=1.8, label=name)
    axes.set(xlabel=scale.label("gap"), ylabel=f"density of the nominal area, 1/{scale.unit}", ylim=(0, None))
    if top > 0:
        axes.set_xlim(0, top)
    figure.legend(loc="outside upper center", ncols=4, fontsize=8)
    return svg(figure)


def plots(scene: Seal, results: Mapping[str, Result], reference: str) -> dict[str, Plot]:
    """The figures of a comparison; maps only where a model resolves the surface."""
    resolved = any("flow" in result.fields for result in results.values())
    lines = {"gaps": Plot(svg=gaps(results, reference))}
    return lines | ({"maps": maps(scene, results, reference)} if resolved else {})


VIEW = View(
    page="seal.html.j2",
    styles=STYLES,
    cards=("leakage_per_width", "area_fraction", "mean_gap"),
    rows=("leakage", "leakage_per_width", "dimensionless_leakage", "area_fraction", "mean_gap"),
    plots=plots,
    groups=groups_by("rough_surface"),
    grids="last step between grids",
    errors="of the leakage and of the contact area",
    ordering="mean pressure over modulus and rms slope P/(E* g') and Nayak's parameter α",
    left_out=" Cases that are sealed or almost sealed are left out.",
)
