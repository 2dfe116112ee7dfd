"""Figures of the load of dimples over depth, covered part and model."""

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from scripts.studies.dimples.data import FAMILIES, REFERENCE, Dimples

LINES = {REFERENCE: "-", "film_slope": "--", "inertial_reynolds": ":"}
"""Line style of each model in the figure of loads."""


def loads(dimples: Dimples, number: float) -> Figure:
    """Draw the load over the depth for every family and covered part at one Reynolds number."""
    figure = Figure(figsize=(10, 6.4), layout="constrained")
    panels = figure.subplots(2, 3, sharex=True)
    given = dimples.sweep.given
    for axes, family in zip(panels.flat, FAMILIES, strict=True):
        cases = dimples.cases(family, number)
        parts = np.unique(given["covered"][cases])
        colours = mpl.colormaps["viridis"](np.linspace(0.9, 0.1, len(parts)))
        for colour, part in zip(colours, parts, strict=True):
            own = cases[given["covered"][cases] == part]
            own = own[np.argsort(given["depth_plus"][own])]
            for model, style in LINES.items():
                if model in dimples.settings:
                    label = f"{100 * part:.0f} % covered" if model == REFERENCE else None
                    axes.plot(
                        given["depth_plus"][own], dimples.load(model)[own], style, color=colour, label=label, marker="."
                    )
        axes.set_title(family, fontsize=9)
        axes.legend(fontsize=6, framealpha=0.8)
    for axes in panels[-1]:
        axes.set_xlabel("depth over film thickness")
    for axes in panels[:, 0]:
        axes.set_ylabel("load, dimensionless")
    return figure


def losses(dimples: Dimples) -> Figure:
    """Draw the load that is lost by choosing the dimple by each model, all of it if the model finds no load."""
    figure = Figure(figsize=(10, 3.6), layout="constrained")
    panels = figure.subplots(1, len(dimples.numbers), sharey=True, squeeze=False)[0]
    models = [model for model in dimples.settings if model != REFERENCE]
    places = np.arange(len(FAMILIES))
    for axes, number in zip(panels, dimples.numbers, strict=True):
        for shift, model in enumerate(models):
            chosen = [dimples.choice(family, number, model) for family in FAMILIES]
            lost = [100 * (1.0 if one is None else one.lost) for one in chosen]
            axes.bar(places + (shift - len(models) / 2) * 0.15, lost, 0.14, label=model)
        axes.set_xticks(places, FAMILIES, fontsize=7, rotation=20)
        axes.set_title(f"Re = {number:g}", fontsize=9)
    panels[0].set_ylabel("load lost by the choice, %")
    panels[0].legend(fontsize=7)
    return figure
