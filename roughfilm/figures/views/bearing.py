"""Bearings: pressure and filled part along the film, and over it where it has a width."""

from collections.abc import Mapping

import numpy as np

from roughfilm.figures.base import MAX_PIXELS, new_figure, svg, thinned
from roughfilm.figures.view import Style, View, groups_by
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.result import Result

STYLES = {
    "reynolds": Style(colour="#7f7f7f", line="--", marker="s"),
    "infinitely_wide": Style(colour="#5aae61", line=":", marker="^"),
    "reynolds_incompressible": Style(colour="#e08214", line="-.", marker="D"),
    "reynolds_cavitating": Style(colour="#2166ac", line="-", marker="o"),
    "homogenized": Style(colour="#b2182b", line="-", marker="v"),
    "direct": Style(colour="#252525", line="-", marker="P"),
    "mixed": Style(colour="#762a83", line="-", marker="X"),
}


def along(scene: Bearing, results: Mapping[str, Result]) -> str:
    """Film thickness, pressure and θ by every model, on the line of the greatest pressure.

    Under a load each model has a film of its own.
    """
    figure, (film, pressure, density) = new_figure((9, 6.8), 3, 1, sharex=True, height_ratios=(1, 2.2, 1.5))
    factor, label = _place(results)
    for number, (name, result) in enumerate(results.items()):
        style = STYLES.get(name, Style())
        row = int(np.argmax(result.fields["pressure"].values.max(axis=0)))
        x, h, p, theta = (
            result.fields[field].values[:, row] for field in ("x", "film_thickness", "pressure", "density_ratio")
        )
        if scene.load is not None:
            film.plot(x * factor, h * 1e6, linestyle=style.line, color=style.colour)
        elif number == 0:
            film.fill_between(x * factor, h * 1e6, color="#9ecae1", linewidth=0)
        if name == "direct":
            film.plot(x * factor, h * 1e6, color=style.colour, linewidth=0.6)
        thin = x.size > 2 * MAX_PIXELS and name == "direct"
        look = {"linestyle": style.line, "color": style.colour, "linewidth": 1.0 if thin else 1.8}
        pressure.plot(x * factor, p * 1e-6, label=name, **look)
        density.plot(x * factor, theta, **look)
    lowest = scene.lubricant.cavitation_pressure * 1e-6
    pressure.axhline(lowest, color="black", linewidth=0.8, linestyle=(0, (1, 2)))
    film.set(ylim=(0, None), ylabel="film, µm")
    pressure.set_ylabel("pressure above\nambient, MPa")
    pressure.legend(fontsize=8)
    density.set(ylabel="density θ;\nbelow 1: filled fraction", xlabel=label + " (dotted: cavitation pressure)")
    return svg(figure)


def over(results: Mapping[str, Result]) -> str:
    """Pressure and θ over the film by the models that keep its width, in the same colours."""
    planes = {name: result for name, result in results.items() if result.fields["pressure"].values.shape[1] > 1}
    figure, panels = new_figure((10, 0.5 + 2.6 * len(planes)), len(planes), 2, squeeze=False)
    factor, label = _place(planes)
    kinds = (("pressure", "pressure, MPa", 1e-6, "magma"), ("density_ratio", "θ", 1.0, "cividis"))
    for column, (field, title, scale, colours) in zip(panels.T, kinds, strict=True):
        drawn = {name: thinned(result.fields[field].values) * scale for name, result in planes.items()}
        low, high = min(v.min() for v in drawn.values()), max(v.max() for v in drawn.values())
        if field == "density_ratio":  # a film that is whole everywhere is to look so
            low, high = min(low, 0.9), max(high, 1.0)
        for axes, (name, values) in zip(column, drawn.items(), strict=True):
            x, y = (thinned(planes[name].fields[place].values) for place in ("x", "y"))
            image = axes.pcolormesh(
                x * factor, y * 1e3, values, cmap=colours, vmin=low, vmax=high, shading="nearest", rasterized=True
            )
            axes.grid(visible=False)
            axes.set_title(name, fontsize=9)
            axes.set(xlabel=label, ylabel="across, mm")
        figure.colorbar(image, ax=column, label=title, shrink=0.9)
    return svg(figure)


def _place(results: Mapping[str, Result]) -> tuple[float, str]:
    """The factor of x in figures, and its label."""
    angle = next(iter(results.values())).fields["x"].unit == "rad"
    return (np.degrees(1.0), "angle, degrees") if angle else (1e3, "position along the sliding, mm")


def plots(scene: Bearing, results: Mapping[str, Result]) -> dict[str, str]:
    """The figures of a comparison; maps only where a model keeps the width."""
    plane = any(result.fields["pressure"].values.shape[1] > 1 for result in results.values())
    return {"along": along(scene, results), **({"over": over(results)} if plane else {})}


VIEW = View(
    page="bearing.html.j2",
    styles=STYLES,
    labels={"film_min": "least film", "load_per_width": "load per width", "friction_per_width": "friction per width"},
    headings={
        "film_min": "least<br>film",
        "load_per_width": "load<br>per width",
        "friction_per_width": "friction<br>per width",
        "friction_coefficient": "friction<br>coefficient",
        "power_loss_per_width": "power loss<br>per width",
        "pressure_max": "greatest<br>pressure",
        "film_start": "first film<br>begins, x/L",
        "rupture": "last film<br>ends, x/L",
    },
    plots=plots,
    groups=groups_by("shape"),
    errors="of the load and of the friction on the sliding wall",
    ordering="θ of the inlet, ϑ at 6ηuL/h² and B/L",
)
