"""Maps of the change of load by inertia, and pressures along pads."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure
from roughfilm.rom.ladder.result import Result
from scripts.studies.pads.claims import relative
from scripts.studies.pads.data import NO_INERTIA, Pad, PadStudy

REDUCED = (0.1, 1.0, 10.0)
"""Values of Re/λ that are drawn as lines."""

LEVELS = (-0.2, -0.1, -0.05, -0.02, -0.01, 0.0, 0.01, 0.02, 0.05, 0.1, 0.2)


def partial(study: PadStudy) -> Figure:
    """Relative change of the load by inertia of pads with pockets on their inlet half, and of an inclined one."""
    names = {
        ("inlet half", 0.5, 0.0): "parallel, d = h/2",
        ("inlet half", 1.0, 0.0): "parallel, d = h",
        ("inlet half", 1.0, 0.5): "inclined, d = h",
    }
    figure, panels = new_figure((10, 3.9), 1, len(names), sharey=True)
    for axes, (name, title) in zip(panels, names.items(), strict=True):
        image = _map(axes, study, relative(study, name), title)
    panels[0].set_ylabel("λ = pocket length over depth")
    bar = figure.colorbar(image, ax=panels, label="change of the load by inertia")
    bar.ax.set_yticks(LEVELS, [f"{100 * level:+g} %" for level in LEVELS])
    return figure


def _map(axes: Axes, study: PadStudy, values: Array, title: str) -> Any:
    numbers, ratios = np.array(study.plan.numbers), np.array(study.plan.ratios)
    shown = np.clip(values, LEVELS[0], LEVELS[-1])
    image = axes.contourf(numbers, ratios, shown, levels=LEVELS, cmap="RdBu", norm=BoundaryNorm(LEVELS, 256))
    if np.nanmin(values) < 0 < np.nanmax(values):
        axes.contour(numbers, ratios, values, levels=[0.0], colors="black", linewidths=1.2)
    for one in REDUCED:
        axes.plot(one * ratios, ratios, color="black", linewidth=0.7, linestyle=":")
    axes.set(xscale="log", yscale="log", xlim=(numbers[0], numbers[-1]), ylim=(ratios[0], ratios[-1]), xlabel="Re")
    axes.set_yticks(ratios[::2], [f"{ratio:g}" for ratio in ratios[::2]])
    axes.minorticks_off()
    axes.grid(visible=False)
    axes.set_title(title, fontsize=9)
    return image


def full(study: PadStudy) -> Figure:
    """Change of the load by inertia of fully textured pads over that by the inlet half without inertia."""
    names = {
        ("full", 0.5, 0.0): "parallel, d = h/2",
        ("full", 1.0, 0.0): "parallel, d = h",
        ("full", 1.0, 0.5): "inclined, d = h",
    }
    figure, panels = new_figure((10, 3.9), 1, len(names), sharey=True)
    for axes, (name, title) in zip(panels, names.items(), strict=True):

        def value(pad: Pad) -> float:
            inlet = Pad(texture="inlet half", depth=pad.depth, rise=0.0, ratio=pad.ratio, number=pad.number)
            return study.by_inertia(pad) / (study.without(pad) if pad.rise else study.without(inlet))

        image = _map(axes, study, study.map(name, value), title)
    panels[0].set_ylabel("λ = pocket length over depth")
    bar = figure.colorbar(image, ax=panels, label="change of the load by inertia")
    bar.ax.set_yticks(LEVELS, [f"{100 * level:+g} %" for level in LEVELS])
    return figure


def collapsed(study: PadStudy) -> Figure:
    """Change of the load by inertia over Re, and over Re/λ, with the prediction of single cells."""
    figure, (left, right) = new_figure((10, 4.2), 1, 2, sharey=True)
    name, numbers = ("inlet half", 1.0, 0.0), np.array(study.plan.numbers)
    change = relative(study, name)
    cells = study.map(name, study.by_cells)
    base = study.map(name, study.without)
    for place, ratio in enumerate(study.plan.ratios):
        colour = f"C{place}"
        left.plot(numbers, 100 * change[place], "o-", color=colour, markersize=3, label=f"λ = {ratio:g}")
        right.plot(numbers / ratio, 100 * change[place], "o-", color=colour, markersize=3)
        predicted = 100 * cells[place] / base[place]
        right.plot(numbers / ratio, predicted, linestyle="--", color=colour, linewidth=0.9)
    for pad, (load, bar) in study.checked.items():
        if (pad.texture, pad.depth, pad.rise) == name:
            value = 100 * (load / study.load(replace(pad, number=NO_INERTIA), "film_slope") - 1)
            size = 100 * bar / study.without(pad)
            for axes, x in ((left, pad.number), (right, pad.number / pad.ratio)):
                axes.errorbar(x, value, yerr=size, fmt="k+", markersize=8, linewidth=1)
    for axes, label in ((left, "Re"), (right, "Re/λ")):
        axes.set(xscale="log", xlabel=label)
        axes.axhline(0, color="black", linewidth=0.7)
    left.set_ylabel("change of the load by inertia, %")
    left.legend(fontsize=8)
    return figure


def pressures(drawn: Mapping[str, Mapping[str, Result]], unit: Callable[[str], float]) -> Figure:
    """Pressure along pads by the Reynolds equation and with inertia."""
    figure, panels = new_figure((10, 3.8), 1, len(drawn))
    for axes, (title, results) in zip(panels, drawn.items(), strict=True):
        for name, result in results.items():
            x, p = (result.fields[field].values[:, 0] for field in ("x", "pressure"))
            line = "--" if name == "reynolds" else "-"
            axes.plot(x / x.max(), p / unit(title), linestyle=line, label=name, linewidth=1.4)
        axes.set_title(title, fontsize=9)
        axes.set_xlabel("x/L")
    panels[0].set_ylabel("pressure over 6ηuL/h²")
    panels[0].legend(fontsize=8)
    return figure
