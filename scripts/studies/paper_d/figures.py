"""Figures D.1 to D.7 of Paper D and E.4 of Paper E; a line is the mean over seeds, a band their standard deviation."""

from collections.abc import Sequence

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


def d1(paper: PaperD) -> Figure:
    """Real area of contact of profile D at the highest load with waves 1 to n only."""
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


def d2(paper: PaperD) -> Figure:
    """Bearing curves and height distributions of the four profiles, all seeds together."""
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


def d3(paper: PaperD) -> Figure:
    """A profile D (first seed) and what the highest load takes off it for good (shaded, and below by itself)."""
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


def _against_load(paper: PaperD, wanted: Sequence[tuple[str, str, float]]) -> Figure:
    figure, panels = _panels(len(wanted))
    for axes, (quantity, label, factor) in zip(panels, wanted, strict=True):
        for name, colour in COLOURS.items():
            for spectrum, style in DASHES.items():
                values = factor * paper.pressed[spectrum, name][quantity]
                _band(axes, np.array(paper.loads) / 1e3, values, colour, style, name if style == "-" else "")
        axes.set(xlabel="load, kN/m", ylabel=label, xlim=(0, None))
    panels[0].legend(ncols=2)
    return figure


def d4(paper: PaperD) -> Figure:
    """Real area of contact and plasticity index against load."""
    return _against_load(paper, [("area", "Ar/An, %", 100), ("plasticity_index", "Ap/Ar", 1)])


def d5(paper: PaperD) -> Figure:
    """Ra and Rq of the loaded profiles."""
    return _against_load(paper, [("Ra", "Ra, µm", 1e6), ("Rq", "Rq, µm", 1e6)])


def d6(paper: PaperD) -> Figure:
    """Skewness and kurtosis of the loaded profiles."""
    return _against_load(paper, [("skewness", "skewness", 1), ("kurtosis", "kurtosis", 1)])


def d7(paper: PaperD) -> Figure:
    """Mean separation: from the plane to the mean of the loaded profile."""
    return _against_load(paper, [("separation", "mean separation, µm", 1e6)])


NUMBERED = {"D.1": d1, "D.2": d2, "D.3": d3, "D.4": d4, "D.5": d5, "D.6": d6, "D.7": d7}


def e4(contacts: Sequence[Contact]) -> Figure:
    """The model surface loaded, and its elastic and plastic parts; dots: nodes of purely elastic contact."""
    figure, ((corner, loaded), (elastic, plastic), (elastic_move, plastic_move)) = new_figure(
        (10, 9), 3, 2, sharex=True
    )
    first = contacts[0]
    x = 1e3 * first.spacing[0] * np.arange(first.heights.shape[0])
    for axes in (loaded, elastic, plastic):
        axes.plot(x, 1e6 * first.heights[:, 0], color="black", lw=1)
        axes.set_ylim(-12, 95)
    corner.set_axis_off()
    corner.plot([], [], color="black", lw=1, label="no load")
    for contact, colour in zip(contacts, colormaps["viridis"](np.linspace(0, 0.88, len(contacts))), strict=True):
        z, u_e, u_p = (
            1e6 * field[:, 0] for field in (contact.heights, contact.elastic_displacement, contact.plastic_displacement)
        )
        u_e = u_e - u_e.min()
        only = (contact.in_contact & ~contact.plastic)[:, 0]
        corner.plot([], [], color=colour, label=f"{contact.load / 1e6:g} MPa")
        loaded.plot(x, z - u_e - u_p, color=colour, lw=1.2)
        elastic.plot(x, z - u_e, color=colour, lw=1.2)
        elastic.plot(x[only], (z - u_e)[only], ".", color="black", ms=4)
        plastic.plot(x, z - u_p, color=colour, lw=1.2)
        elastic_move.plot(x, u_e, color=colour, lw=1.2)
        elastic_move.plot(x[only], u_e[only], ".", color="black", ms=4)
        plastic_move.plot(x, u_p, color=colour, lw=1.2)
    titles = {
        loaded: "loaded surface, µm",
        elastic: "elastically deformed, µm",
        plastic: "plastically deformed (unloaded), µm",
        elastic_move: "elastic displacement from its least, µm",
        plastic_move: "plastic displacement, µm",
    }
    for axes, title in titles.items():
        axes.set_title(title, fontsize=10)
    for axes in (elastic_move, plastic_move):
        axes.set_xlabel("x, mm")
    corner.legend(loc="center", fontsize=11)
    return figure
