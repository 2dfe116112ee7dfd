"""Figures of averaged and of resolved roughness."""

from collections.abc import Mapping, Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from roughfilm.figures.base import new_figure
from roughfilm.rom.ladder.result import Result
from scripts.studies.scales.data import WaveErrors, line

ZOOM = (0.065, 0.075)
"""The magnified section of Fig. C.3, m."""


def curves(averaged: Result, resolved: Mapping[float, Result]) -> Figure:
    """Draw Fig. C.3: pressure along the film for every length of the waves, and a magnified section."""
    figure, (whole, part) = new_figure((10, 4.2), 1, 2)
    colours = mpl.colormaps["viridis"](np.linspace(0.85, 0.1, len(resolved)))
    for axes in (whole, part):
        for colour, (ratio, result) in zip(colours, resolved.items(), strict=True):
            x, p = line(result)
            label = f"ε = 2$^{{{round(np.log2(ratio))}}}$"
            axes.plot(x, p * 1e-6, color=colour, linewidth=1.1, label=label)
        x, p = line(averaged)
        axes.plot(x, p * 1e-6, color="#b2182b", linewidth=2, linestyle="--", label="homogenized")
        axes.set_xlabel("position, m")
    inside = (x > ZOOM[0]) & (x < ZOOM[1])
    part.set(xlim=ZOOM, ylim=(0.97 * p[inside].min() * 1e-6, 1.05 * p[inside].max() * 1e-6))
    whole.set_ylabel("pressure, MPa")
    whole.legend(fontsize=8)
    return figure


def errors(studies: Sequence[WaveErrors]) -> Figure:
    """Draw the error of the averaged film over the wavelength, for the worst phase and for all phases."""
    figure = Figure(figsize=(10, 3.9), layout="constrained")
    panels = figure.subplots(1, len(studies), sharey=True, squeeze=False)[0]
    looks = {"pressure": ("#762a83", "^"), "load": ("#b2182b", "o"), "friction": ("#2166ac", "s")}
    for axes, study in zip(panels, studies, strict=True):
        ratios = np.array(study.ratios)
        for name, (colour, marker) in looks.items():
            if any(getattr(pair, name) is None for pair in study.pairs):
                continue
            axes.plot(ratios, 100 * study.worst(name), color=colour, marker=marker, markersize=4, label=name)
            for pair in study.pairs:
                axes.plot(pair.ratio, 100 * abs(getattr(pair, name)), ".", color=colour, alpha=0.3, markersize=3)
        slope = 100 * study.worst("load")[-1] * ratios / ratios[-1]
        axes.plot(ratios, slope, ":", color="black", linewidth=1, label="in proportion to ε")
        axes.set_xscale("log", base=2)
        axes.set_title(study.title, fontsize=9)
        axes.set(yscale="log", ylim=(1e-3, 300), xlabel="ε: length of the waves over that of the film")
    panels[0].set_ylabel("homogenized against direct, %")
    panels[0].legend(fontsize=8)
    return figure
