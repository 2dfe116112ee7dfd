"""Seals: what is left open, and where it leaks."""

from collections.abc import Mapping

import matplotlib as mpl
import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from roughfilm.figures.base import svg
from roughfilm.figures.view import Style, View
from roughfilm.figures.views import dry_contact
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.seal.scene import Seal

STYLES = {
    "effective_medium": Style(colour="#762a83", line="--", marker="P"),
    "homogenized_leakage": Style(colour="#5aae61", line=(0, (5, 1)), marker="^"),
    "direct_leakage": Style(colour="#2166ac", line="-", marker="o"),
}

MOST_PIXELS = 512
"""Of a map along a side; finer ones are drawn by every second, third ... point."""

WEAKEST = 1e-4
"""Of the strongest flow; what is weaker is drawn as that."""

CONTACT = "#2b2b2b"


def maps(scene: Seal, results: Mapping[str, Result]) -> str:
    """Gap and flow over the surface by the models that resolve it, in the same colours; contact is dark."""
    resolved = {name: result for name, result in results.items() if "flow" in result.fields}
    length, width = (side * 1e6 for side in scene.surface().size)
    height = min(4.4, max(1.5, 4.2 * width / length))
    figure = Figure(figsize=(10, 0.4 + height * len(resolved)), layout=ConstrainedLayoutEngine(w_pad=0.15))
    panels = figure.subplots(len(resolved), 2, squeeze=False)
    gaps = {name: _thinned(result.fields["gap"].values) * 1e6 for name, result in resolved.items()}
    flows = {name: _thinned(result.fields["flow"].values) * 1e12 for name, result in resolved.items()}
    widest = max(float(np.percentile(gap, 99.9)) for gap in gaps.values()) or 1.0
    strongest = max(float(np.percentile(flow, 99.9)) for flow in flows.values())
    for row, name in zip(panels, resolved, strict=True):
        closed = gaps[name] == 0
        shown = (
            ("gap, µm", "cividis", gaps[name], {"vmin": 0, "vmax": widest}),
            (
                "flow per width, µm²/s",
                "magma",
                np.maximum(flows[name], WEAKEST * strongest),
                {"norm": LogNorm(WEAKEST * strongest, strongest)} if strongest > 0 else {"vmin": 0, "vmax": 1},
            ),
        )
        for axes, (label, colours, values, how) in zip(row, shown, strict=True):
            axes.grid(visible=False)
            image = axes.imshow(
                np.where(closed, np.nan, values).T,
                origin="lower",
                extent=(0, length, 0, width),
                cmap=mpl.colormaps[colours].with_extremes(bad=CONTACT if colours == "cividis" else "#b9c2cc"),
                interpolation="nearest",
                aspect="auto" if not 0.2 < width / length < 5 else "equal",
                **how,
            )
            axes.set_title(name, fontsize=9)
            axes.set_xlabel("x, µm")
            axes.set_ylabel("y, µm")
            figure.colorbar(image, ax=axes, label=label, shrink=0.9)
    return svg(figure)


def gaps(results: Mapping[str, Result]) -> str:
    """How much of the area has which gap, by every model."""
    figure = Figure(figsize=(10, 3.4), layout="constrained")
    axes = figure.add_subplot()
    for name, result in results.items():
        style = STYLES.get(name, Style())
        edges, share = (result.fields[field].values for field in ("gap_edges", "gap_share"))
        density = share / np.diff(edges * 1e6)
        axes.stairs(
            density, edges * 1e6, baseline=None, color=style.colour, linestyle=style.line, linewidth=1.8, label=name
        )
    axes.set_xlabel("gap, µm")
    axes.set_ylabel("density of the nominal area, 1/µm")
    axes.set_ylim(bottom=0)
    axes.legend(fontsize=8, loc="upper right")
    return svg(figure)


def _thinned(values: np.ndarray) -> np.ndarray:
    step = max(1, -(-max(values.shape) // MOST_PIXELS))
    return values[::step, ::step]


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
    groups=dry_contact.groups,
    errors="of the leakage and of the contact area",
    ordering="P/(E* g') and Nayak's α",
    left_out=" Cases that are sealed or almost sealed are left out.",
)
