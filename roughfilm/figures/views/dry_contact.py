"""Dry contacts: pressures and gaps."""

from collections.abc import Mapping

import numpy as np

from roughfilm.figures.base import map_figure, model_map, new_figure, svg, thinned
from roughfilm.figures.view import Style, View, groups_by
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.result import Result

STYLES = {
    "greenwood_williamson": Style(colour="#e08214", line="-.", marker="D"),
    "persson": Style(colour="#762a83", line="--", marker="P"),
    "bearing_area": Style(colour="#7f7f7f", line=":", marker="s"),
    "elastic": Style(colour="#5aae61", line=(0, (5, 1)), marker="^"),
    "elastic_plastic": Style(colour="#2166ac", line="-", marker="o"),
}

DENSITY_RANGE = 1e-5
"""Ratio of the lowest density that is drawn to the highest."""

MIN_AREA = 1e-6
"""Smallest fraction of the nominal area that is drawn."""


def pressures(scene: DryContact, results: Mapping[str, Result]) -> str:
    """Density of pressures, and the fraction of the nominal area at a higher pressure, by every model."""
    figure, (density, above) = new_figure((10, 4.2), 1, 2)
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
        above.plot(edges, np.where(more > MIN_AREA, more, np.nan), **look)
    for axes in (density, above):
        axes.set(yscale="log", xlabel="pressure, GPa" + (" (dotted: hardness)" if scene.solid.hardness else ""))
        if scene.solid.hardness and scene.solid.hardness * 1e-9 <= axes.get_xlim()[1]:
            axes.axvline(scene.solid.hardness * 1e-9, color="black", linewidth=0.8, linestyle=":")
    highest = max(float(result.fields["pressure_density"].values.max()) for result in results.values()) * 1e9
    if highest > 0:
        density.set_ylim(DENSITY_RANGE * highest, 2 * highest)
    density.set_ylabel("density of pressures below the hardness, 1/GPa")
    above.set_ylabel("fraction of the nominal area\nat a higher pressure")
    above.legend(fontsize=8)
    return svg(figure)


def maps(scene: DryContact, results: Mapping[str, Result]) -> str:
    """Pressure and gap over the surface by the models that resolve it, in the same colours."""
    resolved = {name: result for name, result in results.items() if "gap" in result.fields}
    size = scene.surface().size
    figure, panels = map_figure(size, len(resolved), 4.0)
    kinds = (("pressure", "pressure, GPa", 1e-9, "magma"), ("gap", "gap, µm", 1e6, "cividis"))
    for column, (field, label, factor, colours) in zip(panels.T, kinds, strict=True):
        drawn = {name: thinned(result.fields[field].values) * factor for name, result in resolved.items()}
        top = max(float(np.percentile(values, 99.9)) for values in drawn.values())
        for axes, (name, values) in zip(column, drawn.items(), strict=True):
            image = model_map(axes, name, values, size, cmap=colours, vmin=0, vmax=top or None)
        figure.colorbar(image, ax=column, label=label, shrink=0.9)
    return svg(figure)


def plots(scene: DryContact, results: Mapping[str, Result]) -> dict[str, str]:
    """The figures of a comparison; maps only where a model resolves the surface."""
    resolved = any("gap" in result.fields for result in results.values())
    return {"pressures": pressures(scene, results), **({"maps": maps(scene, results)} if resolved else {})}


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
    groups=groups_by("rough_surface"),
    errors="of the contact area and of the mean gap",
    ordering="P/(E* g'), H/(E* g') and Nayak's α",
)
