"""Figures D.1 to D.7 of Paper D and E.4 of Paper E; a line is the mean over seeds, a band their standard deviation."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.parameters.bearing_curve import bearing_curve
from roughfilm.figures.base import new_figure
from scripts.studies.paper_d.data import LENGTH, SPECTRA, PaperD

COLOURS = {"A": "#b2182b", "B": "#2166ac", "C": "#5aae61", "D": "#762a83"}
DASHES = {"self-affine": "-", "smooth": "--"}
MAIN = "self-affine"


def _panels(count: int, height: float = 3.9) -> tuple[Figure, list[Axes]]:
    figure, axes = new_figure((5 * count, height), 1, count, squeeze=False)
    return figure, list(axes[0])


def _band(axes: Axes, x: Array, values: Array, colour: str, style: str, label: str) -> None:
    mean, spread = values.mean(axis=0), values.std(axis=0)
    axes.plot(x, mean, style, color=colour, label=label, lw=1.6)
    if style == "-":
        axes.fill_between(x, mean - spread, mean + spread, color=colour, alpha=0.15, lw=0)


def _waves(paper: PaperD) -> Figure:
    figure, panels = _panels(2)
    for axes, spectrum in zip(panels, SPECTRA, strict=True):
        for name, colour in (("elastic-plastic", "#b2182b"), ("elastic", "#2166ac")):
            _band(axes, np.array(paper.waves), 100 * paper.cut[spectrum][name], colour, "-", name)
        axes.set_title(f"{spectrum}, waves up to {SPECTRA[spectrum]}", fontsize=10)
        axes.set(xlabel="number of frequencies n", yscale="log")
        axes.set_yticks([2, 5, 10, 20, 50, 100], ["2", "5", "10", "20", "50", "100"])
    panels[0].set_ylabel("Ar/An, %")
    panels[0].legend()
    return figure


def _bearing_curves(paper: PaperD) -> Figure:
    figure, (left, right) = _panels(2)
    for name, colour in COLOURS.items():
        heights = np.concatenate(paper.profiles[MAIN, name]) * 1e6
        ratio, height = bearing_curve(heights)
        left.plot(100 * ratio, height, color=colour, label=name)
        density, edges = np.histogram(heights, bins=40, density=True)
        right.plot(density, (edges[1:] + edges[:-1]) / 2, color=colour)
    left.set(xlabel="part of the profile above, %", ylabel="height from the mean, µm")
    right.set_xlabel("P(z), 1/µm")
    left.legend()
    return figure


def _plastic_profile(paper: PaperD) -> Figure:
    figure, (above, below) = new_figure((10, 4.6), 2, 1, sharex=True, height_ratios=(3, 1))
    contact = paper.shown
    x = 1e6 * LENGTH * np.arange(contact.heights.shape[0]) / contact.heights.shape[0]
    before, after = 1e6 * contact.heights[:, 0], 1e6 * contact.unloaded_heights[:, 0]
    above.plot(x, before, color="#1d2530", lw=0.9)
    above.fill_between(x, after, before, color="#b2182b", lw=0.8)
    below.fill_between(x, 0, before - after, color="#b2182b", lw=0.8, step="mid")
    above.set_ylabel("height, µm")
    below.set(ylabel="plastic, µm", xlabel="x, µm")
    return figure


def _against_load(quantities: Sequence[tuple[str, str, float]], paper: PaperD) -> Figure:
    """Draw a panel for each quantity, with its label and the factor to its unit."""
    figure, panels = _panels(len(quantities))
    for axes, (quantity, label, factor) in zip(panels, quantities, strict=True):
        for name, colour in COLOURS.items():
            for spectrum, style in DASHES.items():
                values = factor * paper.pressed[spectrum, name][quantity]
                _band(axes, np.array(paper.loads) / 1e3, values, colour, style, name if style == "-" else "")
        axes.set(xlabel="load, kN/m", ylabel=label, xlim=(0, None))
    panels[0].legend(ncols=2)
    return figure


DRAWINGS: dict[str, Callable[[PaperD], Figure]] = {
    "D.1": _waves,
    "D.2": _bearing_curves,
    "D.3": _plastic_profile,
    "D.4": partial(_against_load, [("area", "Ar/An, %", 100), ("plasticity_index", "Ap/Ar", 1)]),
    "D.5": partial(_against_load, [("Ra", "Ra, µm", 1e6), ("Rq", "Rq, µm", 1e6)]),
    "D.6": partial(_against_load, [("skewness", "skewness", 1), ("kurtosis", "kurtosis", 1)]),
    "D.7": partial(_against_load, [("separation", "mean separation, µm", 1e6)]),
}


def e4(contacts: Sequence[Contact]) -> Figure:
    """Draw the loaded model surface and its elastic and plastic parts; dots are nodes of purely elastic contact."""
    figure, panels = new_figure((10, 9), 3, 2, sharex=True)
    corner, *shown = panels.ravel()
    loaded, elastic, plastic, elastic_move, plastic_move = shown
    first = contacts[0]
    x = 1e3 * first.spacing[0] * np.arange(first.heights.shape[0])
    for axes in (loaded, elastic, plastic):
        axes.plot(x, 1e6 * first.heights[:, 0], color="black", lw=1)
        axes.set_ylim(-12, 95)
    corner.set_axis_off()
    corner.plot([], [], color="black", lw=1, label="no load")
    for contact, colour in zip(contacts, colormaps["viridis"](np.linspace(0, 0.88, len(contacts))), strict=True):
        fields = contact.heights, contact.elastic_displacement, contact.plastic_displacement
        z, u_e, u_p = (1e6 * field[:, 0] for field in fields)
        u_e = u_e - u_e.min()
        only = (contact.in_contact & ~contact.plastic)[:, 0]
        corner.plot([], [], color=colour, label=f"{contact.load / 1e6:g} MPa")
        for axes, y in zip(shown, (z - u_e - u_p, z - u_e, z - u_p, u_e, u_p), strict=True):
            axes.plot(x, y, color=colour, lw=1.2)
            if axes in (elastic, elastic_move):
                axes.plot(x[only], y[only], ".", color="black", ms=4)
    titles = (
        "loaded surface, µm",
        "elastically deformed, µm",
        "plastically deformed (unloaded), µm",
        "elastic displacement from its least, µm",
        "plastic displacement, µm",
    )
    for axes, title in zip(shown, titles, strict=True):
        axes.set_title(title, fontsize=10)
    for axes in (elastic_move, plastic_move):
        axes.set_xlabel("x, mm")
    corner.legend(loc="center", fontsize=11)
    return figure
