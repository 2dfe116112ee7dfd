"""Dry contacts: who bears which pressure, where, and what is left open."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from numpy.typing import NDArray

from roughfilm.figures.base import svg
from roughfilm.figures.view import Style, View
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.sweeping import Columns

STYLES = {
    "greenwood_williamson": Style(colour="#e08214", line="-.", marker="D"),
    "persson": Style(colour="#762a83", line="--", marker="P"),
    "bearing_area": Style(colour="#7f7f7f", line=":", marker="s"),
    "elastic": Style(colour="#5aae61", line=(0, (5, 1)), marker="^"),
    "elastic_plastic": Style(colour="#2166ac", line="-", marker="o"),
}

MOST_PIXELS = 512
"""Of a map along a side; finer ones are drawn by every second, third ... point."""

DEEPEST = 1e-5
"""Of the highest density; lower ones are not drawn."""

LEAST_AREA = 1e-6
"""Of the nominal area; a curve is drawn down to there."""


def pressures(scene: DryContact, results: Mapping[str, Result]) -> str:
    """Density of pressures, and the part of the nominal area that bears more than a pressure, by every model."""
    figure = Figure(figsize=(10, 4.2), layout="constrained")
    density, above = figure.subplots(1, 2)
    for name, result in results.items():
        style = STYLES.get(name, Style())
        edges = result.fields["bin_edges"].values * 1e-9
        values = result.fields["pressure_density"].values * 1e9
        plastic = result.quantities["plastic_fraction"].value
        more = np.append(np.cumsum((values * np.diff(edges))[::-1])[::-1], 0.0)
        if plastic:
            more[edges <= scene.hardness * 1e-9 * (1 + 1e-12)] += plastic
        look = {"color": style.colour, "linestyle": style.line, "linewidth": 1.8, "label": name}
        if values.any():
            density.stairs(np.where(values > 0, values, np.nan), edges, baseline=None, **look)
        above.plot(edges, np.where(more > LEAST_AREA, more, np.nan), **look)
    for axes in (density, above):
        axes.set_yscale("log")
        axes.set_xlabel("pressure, GPa" + (" (dotted: hardness)" if scene.solid.hardness else ""))
        if scene.solid.hardness and scene.solid.hardness * 1e-9 <= axes.get_xlim()[1]:
            axes.axvline(scene.solid.hardness * 1e-9, color="black", linewidth=0.8, linestyle=":")
    highest = max(float(result.fields["pressure_density"].values.max()) for result in results.values()) * 1e9
    if highest > 0:
        density.set_ylim(DEEPEST * highest, 2 * highest)
    density.set_ylabel("density of pressures below the hardness, 1/GPa")
    above.set_ylabel("fraction of the nominal area\nat a higher pressure")
    above.legend(fontsize=8)
    return svg(figure)


def maps(scene: DryContact, results: Mapping[str, Result]) -> str:
    """Pressure and gap over the surface by the models that resolve it, in the same colours."""
    resolved = {name: result for name, result in results.items() if "gap" in result.fields}
    length, width = (side * 1e6 for side in scene.surface().size)
    height = min(4.0, max(1.5, 3.6 * width / length))
    figure = Figure(figsize=(10, 0.4 + height * len(resolved)), layout=ConstrainedLayoutEngine(w_pad=0.15))
    panels = figure.subplots(len(resolved), 2, squeeze=False)
    kinds = (("pressure", "pressure, GPa", 1e-9, "magma"), ("gap", "gap, µm", 1e6, "cividis"))
    for column, (field, label, factor, colours) in zip(panels.T, kinds, strict=True):
        drawn = {name: _thinned(result.fields[field].values) * factor for name, result in resolved.items()}
        top = max(float(np.percentile(values, 99.9)) for values in drawn.values())
        for axes, (name, values) in zip(column, drawn.items(), strict=True):
            axes.grid(visible=False)
            image = axes.imshow(
                values.T,
                origin="lower",
                extent=(0, length, 0, width),
                cmap=colours,
                vmin=0,
                vmax=top or None,
                interpolation="nearest",
                aspect="auto" if not 0.2 < width / length < 5 else "equal",
            )
            axes.set_title(name, fontsize=9)
            axes.set_xlabel("x, µm")
            axes.set_ylabel("y, µm")
        figure.colorbar(image, ax=column, label=label, shrink=0.9)
    return svg(figure)


def _thinned(values: NDArray[np.float64]) -> NDArray[np.float64]:
    step = max(1, -(-max(values.shape) // MOST_PIXELS))
    return values[::step, ::step]


def plots(scene: DryContact, results: Mapping[str, Result]) -> dict[str, str]:
    """The figures of a comparison; maps only where a model resolves the surface."""
    resolved = any("gap" in result.fields for result in results.values())
    return {"pressures": pressures(scene, results), **({"maps": maps(scene, results)} if resolved else {})}


def groups(given: Columns) -> dict[str, NDArray[np.bool_]]:
    """The cases of each surface, by its name."""
    names = given["rough_surface"]
    return {str(name): names == name for name in np.unique(names)}


VIEW = View(
    page="dry_contact.html.j2",
    styles=STYLES,
    labels={"area_fraction": "contact area", "mean_gap": "mean gap"},
    headings={
        "area_fraction": "contact area<br>A/A<sub>0</sub>",
        "plastic_fraction": "plastic<br>A<sub>p</sub>/A<sub>0</sub>",
        "mean_gap": "mean gap",
        "mean_contact_pressure": "mean pressure<br>in contact",
        "pressure_max": "greatest<br>pressure",
    },
    plots=plots,
    groups=groups,
    errors="of the contact area and of the mean gap",
    ordering="P/(E* g'), H/(E* g') and Nayak's α",
)
