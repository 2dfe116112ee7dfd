"""Dry contacts: pressures and gaps."""

from collections.abc import Mapping

import numpy as np

from roughfilm.figures.base import map_figure, model_map, new_figure, svg, thinned
from roughfilm.figures.differences import QUANTILE, differences
from roughfilm.figures.view import Plot, Style, View, groups_by
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.result import Result
from roughfilm.words.scales import scales_of

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


def pressures(scene: DryContact, results: Mapping[str, Result], reference: str) -> str:
    """Density of pressures, and the fraction of the nominal area at a higher pressure, by every model."""
    figure, (density, above) = new_figure((10, 4.4), 1, 2)
    scale = scales_of([results[reference]])("pressure", "Pa")
    for name, result in results.items():
        style = STYLES.get(name, Style())
        edges = result.fields["bin_edges"].values / scale.factor
        values = result.fields["pressure_density"].values * scale.factor
        plastic = result.quantities["plastic_fraction"].value
        more = np.append(np.cumsum((values * np.diff(edges))[::-1])[::-1], 0.0)
        if plastic:
            more[edges <= scene.hardness / scale.factor * (1 + 1e-12)] += plastic
        look = {"color": style.colour, "linestyle": style.line, "linewidth": 1.8, "label": name}
        if values.any():
            density.stairs(np.where(values > 0, values, np.nan), edges, baseline=None, **look)
        above.plot(edges, 100 * np.where(more > MIN_AREA, more, np.nan), **look)
    for axes in (density, above):
        axes.set(yscale="log", xlabel=scale.label("pressure"))
        if scene.solid.hardness and scene.solid.hardness / scale.factor <= axes.get_xlim()[1]:
            axes.axvline(
                scene.solid.hardness / scale.factor, color="black", linewidth=0.8, linestyle=":", label="hardness"
            )
    highest = max(float(result.fields["pressure_density"].values.max()) for result in results.values()) * scale.factor
    if highest > 0:
        density.set_ylim(DENSITY_RANGE * highest, 2 * highest)
    density.set_ylabel(f"density of pressures below the hardness, 1/{scale.unit}")
    above.set_ylabel("area at a higher pressure\nover nominal area, %")
    figure.legend(*above.get_legend_handles_labels(), loc="outside upper center", ncols=4, fontsize=8)
    return svg(figure)


def maps(scene: DryContact, results: Mapping[str, Result], reference: str) -> Plot:
    """Pressure and gap over the surface by the reference model, and the differences of the others that resolve it."""
    resolved = {name: result for name, result in results.items() if "gap" in result.fields}
    shown = reference if reference in resolved else [*resolved][-1]
    size, scales = scene.surface().size, scales_of([results[reference]])
    fields = {"pressure": ("pressure", "Pa", "magma"), "gap": ("gap", "m", "cividis")}
    found = {
        name: differences(
            {model: thinned(one.fields[name].values) for model, one in resolved.items()},
            shown,
            title,
            scales(name, unit),
        )
        for name, (title, unit, _) in fields.items()
    }
    others = [model for model in resolved if any(model in one.drawn for one in found.values())]
    figure, panels = map_figure(size, 1 + len(others), 4.0)
    for column, (name, (title, unit, colours)) in zip(panels.T, fields.items(), strict=True):
        scale = scales(name, unit)
        values = thinned(resolved[shown].fields[name].values) / scale.factor
        top = float(np.percentile(values, QUANTILE)) or float(values.max()) or None
        image = model_map(column[0], f"{title} by {shown}", values, size, cmap=colours, vmin=0, vmax=top)
        figure.colorbar(image, ax=column[0], label=scale.label(title), shrink=0.9)
        for axes, model in zip(column[1:], others, strict=True):
            if model not in found[name].drawn:
                axes.set_axis_off()
                continue
            heading = f"{model} minus {shown}"
            image = model_map(axes, heading, found[name].drawn[model], size, **found[name].colours)
            figure.colorbar(image, ax=axes, label=scale.label(f"difference in {title}"), shrink=0.9)
    return Plot(svg=svg(figure), words=tuple(words for one in found.values() for words in one.words))


def plots(scene: DryContact, results: Mapping[str, Result], reference: str) -> dict[str, Plot]:
    """The figures of a comparison; maps only where a model resolves the surface."""
    resolved = any("gap" in result.fields for result in results.values())
    lines = {"pressures": Plot(svg=pressures(scene, results, reference))}
    return lines | ({"maps": maps(scene, results, reference)} if resolved else {})


VIEW = View(
    page="dry_contact.html.j2",
    styles=STYLES,
    cards=("mean_gap", "plastic_fraction", "mean_contact_pressure", "pressure_max"),
    rows=("area_fraction", "plastic_fraction", "mean_gap", "approach", "mean_contact_pressure", "pressure_max"),
    plots=plots,
    groups=groups_by("rough_surface"),
    grids="last step between grids",
    errors="of the contact area and of the mean gap",
    ordering="mean pressure P/(E* g') and hardness H/(E* g') over modulus and rms slope, and Nayak's parameter α",
)
