"""Figures B.1 to B.17 of Paper B, and one for claim 9; pressures are relative to ambient, the cavitation pressure."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus, DowsonHigginson
from scripts.studies.paper_b.data import (
    CASES,
    CONSTANT,
    DOUBLE,
    HALF,
    MNL,
    MODULUS,
    ORIGINAL,
    SOFT,
    CavitatingFilm,
    PaperB,
    bearing,
)

STYLES = {
    MNL: ("#1d2530", "-"),
    ORIGINAL: ("#b2182b", "--"),
    CONSTANT: ("#2166ac", ":"),
    SOFT: ("#5aae61", "--"),
    HALF: ("#b2182b", "--"),
    DOUBLE: ("#5aae61", "-."),
}
WAVELENGTHS = (("10 mm", "1", "#1d2530"), ("5 mm", "2", "#b2182b"))
Lines = dict[str, tuple[str, str]]
"""End of the label and style of a line by inlet."""

POINTS = 2048
"""Approximate number of points of a film that are drawn."""


def _thin(film: CavitatingFilm) -> slice:
    return slice(None, None, max(1, film.x.size // POINTS))


def _axes(height: float = 3.4) -> tuple[Figure, Axes]:
    return new_figure((8, height))


def _compared(case: str, quantity: str, paper: PaperB) -> Figure:
    """Draw the pressure or density of one case for the lubricants of the paper."""
    figure, axes = _axes()
    relative = case in ("single", "twin")
    laws = (MNL, ORIGINAL) if quantity == "θ" else [law for law in CASES[case].laws if law in STYLES]
    for law in laws:
        film = paper.films[case][law]
        colour, style = STYLES[law]
        drawn, length = _thin(film), film.x[-1] if relative else 1.0
        values = film.pressure / 1e6 if quantity == "p" else film.theta
        axes.plot(film.x[drawn] / length, values[drawn], style, color=colour, label=law, lw=1.8)
    axes.set(xlabel="x/L" if relative else "x, m", ylabel="p, MPa" if quantity == "p" else "θ", xlim=(0, None))
    if quantity == "p":
        axes.set_ylim(bottom=0)
    axes.legend()
    return figure


def _film(axes: Axes, film: CavitatingFilm, colour: str) -> None:
    drawn = _thin(film)
    axes.plot(film.x[drawn], 1e6 * film.thickness[drawn], color=colour, lw=1.6)
    axes.set(xlabel="x, m", ylabel="h, µm")


def _geometry(case: str, paper: PaperB) -> Figure:
    film = paper.films[case][MNL]
    figure, axes = _axes(2.8)
    _film(axes, film, "#1d2530")
    axes.fill_between([0, film.x[-1]], -1.6, 0, color="#dde2e8")
    arrow = {"arrowstyle": "->", "color": "#1d2530"}
    axes.annotate("u", (0.6 * film.x[-1], 5), (0.45 * film.x[-1], 5), va="center", arrowprops=arrow)
    for name, x in (("w", 0.015), ("e", 0.985)):
        axes.text(x * film.x[-1], 0.45e6 * film.thickness[0], name, ha="center", color="#5b6675")
    axes.set_ylim(-1.6, 1.05e6 * film.thickness.max())
    return figure


def _compressibility(paper: PaperB) -> Figure:  # noqa: ARG001
    figure, axes = _axes(4)
    pressure = np.linspace(0, 800e6, 401)
    for law in (ORIGINAL, MNL, CONSTANT):
        lubricant = bearing("thin_parabola", law, {"theta": 1}).lubricant.compressibility
        assert isinstance(lubricant, ConstantBulkModulus | DowsonHigginson)
        colour, style = STYLES[law]
        label = f"{law}, β = {MODULUS:.3f} GPa" if law == CONSTANT else law
        axes.plot(pressure / 1e6, 1 + lubricant.compression(pressure)[0], style, color=colour, label=label, lw=1.8)
    axes.set(xlabel="p, MPa", ylabel="θ", xlim=(0, 800), ylim=(1, 1.3))
    axes.legend()
    return figure


def _waves(kind: str, inlet: str, paper: PaperB) -> list[tuple[str, str, CavitatingFilm]]:
    """Return the number, the colour and the film of each wavelength."""
    return [(number, colour, paper.patterns[f"{kind}, {length}", inlet]) for length, number, colour in WAVELENGTHS]


def _wave_heights(kind: str, paper: PaperB) -> Figure:
    figure, panels = new_figure((8, 4.2), 2, 1, sharex=True)
    for axes, (number, colour, film) in zip(panels, _waves(kind, "pc", paper), strict=True):
        _film(axes, film, colour)
        axes.set_title(number, loc="left", fontsize=10)
        axes.set_ylim(0, 20)
    panels[0].set_xlabel("")
    return figure


def _wave_pressures(kind: str, lines: Lines, height: float, paper: PaperB, **limits: Any) -> Figure:
    """Draw the pressure over waves for each inlet of ``lines``."""
    figure, axes = _axes(height)
    for inlet, (label, style) in lines.items():
        for number, colour, film in _waves(kind, inlet, paper):
            x, pressure = film.x[_thin(film)], film.pressure[_thin(film)] / 1e6
            axes.plot(x, pressure, style, color=colour, label=number + label, lw=1.2)
    axes.set(xlabel="x, m", ylabel="p, MPa", **limits)
    axes.legend()
    return figure


def _wave_densities(paper: PaperB) -> Figure:
    figure, (liquid, cavities) = new_figure((8, 4.8), 2, 1, sharex=True, height_ratios=(1, 1))
    for number, colour, film in _waves("sinusoidal", "pc", paper):
        near = film.x <= 10.5e-3
        density: Array = np.where(film.pressure > 0, film.theta, np.nan)
        liquid.plot(1e3 * film.x[near], 1e4 * (density[near] - 1), color=colour, label=number, lw=1.6)
        cavities.plot(1e3 * film.x[near], np.minimum(film.theta[near], 1), color=colour, lw=1.6)
    liquid.set(ylim=(0, 4), ylabel="(θ − 1) · 10⁴")
    liquid.legend(loc="upper left")
    cavities.set(ylabel="θ", ylim=(None, 1.02), xlabel="x, mm", xlim=(0, 10.5))
    return figure


def _load_differences(paper: PaperB) -> Figure:
    figure, axes = _axes(4)
    for (name, sweep), colour in zip(paper.sweeps.items(), ("#2166ac", "#5aae61", "#b2182b"), strict=True):
        axes.plot(sweep.peaks / 1e6, 100 * sweep.differences[CONSTANT], color=colour, label=f"{name}: constant β")
        axes.plot(sweep.peaks / 1e6, 100 * sweep.differences[ORIGINAL], "--", color=colour, label="D&H-Orig")
    axes.axvspan(50, 100, color="#5b6675", alpha=0.12, lw=0)
    axes.set(xscale="log", yscale="log", xlim=(0.5, 1000), ylim=(1e-3, 100))
    axes.set_xticks([1, 10, 50, 100, 500], ["1", "10", "50", "100", "500"])
    axes.set_yticks([0.001, 0.01, 0.1, 1, 10, 100], ["0.001", "0.01", "0.1", "1", "10", "100"])
    axes.minorticks_off()
    axes.set(xlabel="greatest pressure, MPa", ylabel="load differs by, %")
    axes.legend(fontsize=8, ncols=1, loc="upper left", bbox_to_anchor=(1, 1))
    return figure


BOTH_INLETS: Lines = {"pc": (", pw = pc", "-"), "2 pc": (", pw = 2 pc", "--")}
DRAWINGS: dict[str, Callable[[PaperB], Figure]] = {
    "B.1": _compressibility,
    "B.2": partial(_geometry, "single"),
    "B.3": partial(_compared, "single", "p"),
    "B.4": partial(_geometry, "twin"),
    "B.5": partial(_compared, "twin", "p"),
    "B.6": partial(_compared, "flooded", "θ"),
    "B.7": partial(_compared, "flooded", "p"),
    "B.8": partial(_compared, "starved", "θ"),
    "B.9": partial(_compared, "starved", "p"),
    "B.10": partial(_compared, "starved, moduli", "p"),
    "B.11": partial(_compared, "gap", "p"),
    "B.12": partial(_compared, "gap, moduli", "p"),
    "B.13": partial(_wave_heights, "sinusoidal"),
    "B.14": partial(_wave_pressures, "sinusoidal", {"pc": ("", "-")}, 3.4, ylim=(0, 1.5)),
    "B.15": _wave_densities,
    "B.16": partial(_wave_heights, "cos²"),
    "B.17": partial(_wave_pressures, "cos²", BOTH_INLETS, 4, xlim=(0, 0.1), ylim=(0, 2.5)),
    "claim 9": _load_differences,
}
