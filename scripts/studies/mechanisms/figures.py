"""Figures of load by inertia and by cavitation."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from roughfilm.figures.base import new_figure
from roughfilm.rom.ladder.result import Result
from scripts.studies.mechanisms.data import FILM, GAPS, SPEEDS, TENSIONS, LoadLaws, periodic_pressure

INERTIA, CAVITATION = "#b2182b", ("#08519c", "#4292c6", "#9ecae1")


def pressures(drawn: Mapping[str, Mapping[float, tuple[Result, Result]]], tension: float) -> Figure:
    """Pressure along the sliding wall by both mechanisms: a row for each gap, a panel for each speed."""
    figure, panels = new_figure((10, 6.4), len(drawn), len(next(iter(drawn.values()))), sharex=True)
    for line, (gap, runs) in zip(panels, drawn.items(), strict=True):
        for axes, (speed, (pocket, slider)) in zip(line, runs.items(), strict=True):
            x, p = periodic_pressure(gap, pocket)
            axes.plot(x * 1e3, p * 1e-3, color=INERTIA, label="inertia (film)")
            x, p = (slider.fields[name].values[:, 0] for name in ("x", "pressure"))
            axes.plot(x * 1e3, p * 1e-3, color=CAVITATION[0], label="cavitation (reynolds_cavitating)")
            axes.axhline(-tension * 1e-3, color="black", linewidth=0.8, linestyle=":")
            axes.set_title(f"{GAPS[gap]}: {speed:.3g} m/s", fontsize=9)
        line[0].set_ylabel("pressure above ambient, kPa")
    for axes in panels[-1]:
        axes.set_xlabel("position, mm")
    panels[0][0].legend(fontsize=8)
    return figure


def loads(found: Mapping[str, Mapping[str, Sequence[float]]]) -> Figure:
    """Mean pressure over speed, by inertia and by cavitation at each tension, a panel for each gap."""
    figure, panels = new_figure((10, 4.2), 1, len(found))
    for axes, (gap, loads) in zip(panels, found.items(), strict=True):
        axes.plot(SPEEDS, np.array(loads["inertia"]) * 1e-3, color=INERTIA, linewidth=2.2, label="inertia")
        for tension, colour in zip(TENSIONS, CAVITATION, strict=True):
            label = f"cavitation {tension * 1e-3:g} kPa below ambient"
            axes.plot(SPEEDS, np.array(loads[f"{tension:g}"]) * 1e-3, color=colour, linewidth=2, label=label)
        axes.set_xscale("log")
        axes.set_yscale("symlog", linthresh=0.1)
        axes.set_title(GAPS[gap], fontsize=10)
        axes.set_xlabel("sliding speed, m/s")
    panels[0].set_ylabel("mean pressure above ambient, kPa")
    panels[0].legend(fontsize=8)
    return figure


def rule(laws: LoadLaws, tensions: Sequence[float]) -> Figure:
    """Load by cavitation over the size of that by inertia, over film thickness and speed, the proportions kept."""
    figure, panels = new_figure((10, 3.8), 1, len(tensions), sharey=True)
    film, speed = np.meshgrid(np.geomspace(1e-6, 100e-6, 121), np.geomspace(0.1, 60, 121))
    for axes, tension in zip(panels, tensions, strict=True):
        ratio = laws.cavitation(speed, film, tension) / np.abs(laws.inertia(speed, film))
        shown = np.log10(np.clip(ratio, 1e-3, 1e3))
        image = axes.pcolormesh(film * 1e6, speed, shown, cmap="RdBu", vmin=-3, vmax=3, rasterized=True)
        axes.contour(film * 1e6, speed, shown, levels=[0.0], colors="black", linewidths=1.2)
        axes.plot([FILM * 1e6] * 2, [0.3, 60], color="black", linestyle=":", linewidth=1)
        axes.set(xscale="log", yscale="log")
        axes.grid(visible=False)
        axes.set_title(f"cavitation {tension * 1e-3:g} kPa below ambient", fontsize=9)
        axes.set_xlabel("film thickness, µm")
    panels[0].set_ylabel("sliding speed, m/s")
    figure.colorbar(image, ax=panels, label="log₁₀ of load by cavitation\nover size of that by inertia")
    return figure
