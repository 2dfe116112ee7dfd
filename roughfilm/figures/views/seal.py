"""Seals: the gap under load and the flow through it."""

from collections.abc import Mapping

import matplotlib as mpl
import numpy as np
from matplotlib.colors import LogNorm

from roughfilm.figures.base import map_figure, model_map, new_figure, svg, thinned
from roughfilm.figures.view import Style, View, groups_by
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.seal.scene import Seal

STYLES = {
    "effective_medium": Style(colour="#762a83", line="--", marker="P"),
    "homogenized_leakage": Style(colour="#5aae61", line=(0, (5, 1)), marker="^"),
    "direct_leakage": Style(colour="#2166ac", line="-", marker="o"),
}

FLOW_RANGE = 1e-4
"""Ratio of the weakest flow that is drawn to the strongest; weaker flow is drawn as the weakest."""

CONTACT = "#2b2b2b"


def maps(scene: Seal, results: Mapping[str, Result]) -> str:
    """Gap and flow over the surface by the models that resolve it, in the same colours; contact is dark."""
    resolved = {name: result for name, result in results.items() if "flow" in result.fields}
    size = scene.surface().size
    figure, panels = map_figure(size, len(resolved), 4.4)
    gaps = {name: thinned(result.fields["gap"].values) * 1e6 for name, result in resolved.items()}
    flows = {name: thinned(result.fields["flow"].values) * 1e12 for name, result in resolved.items()}
    widest = max(float(np.percentile(gap, 99.9)) for gap in gaps.values()) or 1.0
    strongest = max(float(np.percentile(flow, 99.9)) for flow in flows.values())
    for row, name in zip(panels, resolved, strict=True):
        closed = gaps[name] == 0
        shown = (
            ("gap, µm", "cividis", gaps[name], {"vmin": 0, "vmax": widest}),
            (
                "flow per width, µm²/s",
                "magma",
                np.maximum(flows[name], FLOW_RANGE * strongest),
                {"norm": LogNorm(FLOW_RANGE * strongest, strongest)} if strongest > 0 else {"vmin": 0, "vmax": 1},
            ),
        )
        for axes, (label, colours, values, how) in zip(row, shown, strict=True):
            palette = mpl.colormaps[colours].with_extremes(bad=CONTACT if colours == "cividis" else "#b9c2cc")
            image = model_map(axes, name, np.where(closed, np.nan, values), size, cmap=palette, **how)
            figure.colorbar(image, ax=axes, label=label, shrink=0.9)
    return svg(figure)


def gaps(results: Mapping[str, Result]) -> str:
    """Density of the nominal area over the gap, by every model."""
    figure, axes = new_figure((10, 3.4))
    for name, result in results.items():
        style = STYLES.get(name, Style())
        edges, fraction = (result.fields[field].values for field in ("gap_edges", "gap_share"))
        density = fraction / np.diff(edges * 1e6)
        axes.stairs(
            density, edges * 1e6, baseline=None, color=style.colour, linestyle=style.line, linewidth=1.8, label=name
        )
    axes.set(xlabel="gap, µm", ylabel="density of the nominal area, 1/µm", ylim=(0, None))
    axes.legend(fontsize=8, loc="upper right")
    return svg(figure)


def plots(scene: Seal, results: Mapping[str, Result]) -> dict[str, str]:
    """The figures of a comparison; maps only where a model resolves the surface."""
    resolved = any("flow" in result.fields for result in results.values())
    return {"gaps": gaps(results), **({"maps": maps(scene, results)} if resolved else {})}


VIEW = View(
    page="seal.html.j2",
    styles=STYLES,
    labels={"leakage_per_width": "leakage", "area_fraction": "contact area"},
    headings={
        "leakage_per_width": "leakage",
        "dimensionless_leakage": "K/Sq³",
        "sealed": "sealed",
        "area_fraction": "contact area<br>A/A<sub>0</sub>",
        "mean_gap": "mean gap",
    },
    plots=plots,
    groups=groups_by("rough_surface"),
    errors="of the leakage and of the contact area",
    ordering="P/(E* g') and Nayak's α",
    left_out=" Cases that are sealed or almost sealed are left out.",
)
