"""Figures B.1 to B.17 of Paper B, and one of claim 9; pressures count from ambient, where liquid also cavitates."""

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
    INLETS,
    MNL,
    MODULUS,
    ORIGINAL,
    PATTERNS,
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
FREQUENCIES = {"10 mm": ("1", "#1d2530"), "5 mm": ("2", "#b2182b")}
POINTS = 2048
"""About so many of a film are drawn."""


def _thin(film: CavitatingFilm) -> slice:
    return slice(None, None, max(1, film.x.size // POINTS))


def _axes(height: float = 3.4) -> tuple[Figure, Axes]:
    return new_figure((8, height))


def _compared(paper: PaperB, case: str, quantity: str, laws: tuple[str, ...], *, relative: bool = False) -> Figure:
    figure, axes = _axes()
    for law in laws:
        film = paper.films[case][law]
        colour, style = STYLES[law]
        kept, length = _thin(film), film.x[-1] if relative else 1.0
        values = film.pressure / 1e6 if quantity == "p" else film.theta
        axes.plot(film.x[kept] / length, values[kept], style, color=colour, label=law, lw=1.8)
    axes.set(xlabel="x/L" if relative else "x, m", ylabel="p, MPa" if quantity == "p" else "θ", xlim=(0, None))
    if quantity == "p":
        axes.set_ylim(bottom=0)
    axes.legend()
    return figure


def _film(axes: Axes, film: CavitatingFilm, colour: str, label: str = "") -> None:
    kept = _thin(film)
    axes.plot(film.x[kept], 1e6 * film.thickness[kept], color=colour, lw=1.6, label=label)
    axes.set(xlabel="x, m", ylabel="h, µm")


def _geometry(film: CavitatingFilm) -> Figure:
    figure, axes = _axes(2.8)
    _film(axes, film, "#1d2530")
    axes.fill_between([0, film.x[-1]], -1.6, 0, color="#dde2e8")
    axes.annotate(
        "u",
        (0.6 * film.x[-1], 5),
        (0.45 * film.x[-1], 5),
        va="center",
        arrowprops={"arrowstyle": "->", "color": "#1d2530"},
    )
    for name, x in (("w", 0.015), ("e", 0.985)):
        axes.text(x * film.x[-1], 0.45e6 * film.thickness[0], name, ha="center", color="#5b6675")
    axes.set_ylim(-1.6, 1.05e6 * film.thickness.max())
    return figure


def b1(paper: PaperB) -> Figure:  # noqa: ARG001
    """Compressibility: the original law of Dowson and Higginson, their law fitted to the mineral oil (MNL), constant β.

    β = 3.364 GPa is dp/dθ of the fitted law at θ = 1. The measured points of the paper are not printed: left out.
    """
    figure, axes = _axes(4)
    pressure = np.linspace(0, 800e6, 401)
    laws: dict[str, ConstantBulkModulus | DowsonHigginson] = {}
    for law in (ORIGINAL, MNL, CONSTANT):
        found = bearing("thin_parabola", law, {"theta": 1}).lubricant.compressibility
        assert isinstance(found, ConstantBulkModulus | DowsonHigginson)
        laws[law] = found
    for law, found in laws.items():
        colour, style = STYLES[law]
        label = f"{law}, β = {MODULUS:.3f} GPa" if law == CONSTANT else law
        axes.plot(pressure / 1e6, 1 + found.compression(pressure)[0], style, color=colour, label=label, lw=1.8)
    axes.set(xlabel="p, MPa", ylabel="θ", xlim=(0, 800), ylim=(1, 1.3))
    axes.legend()
    return figure


def b2(paper: PaperB) -> Figure:
    """The single parabola: H0 = A = 25.4 µm (the paper rounds to 25 µm; its axis says 25.4)."""
    return _geometry(paper.films["single"][MNL])


def b3(paper: PaperB) -> Figure:
    """Pressure over the single parabola, θ = 1.0001 at the inlet; η = 0.039 Pa s, u = 4.57 m/s."""
    return _compared(paper, "single", "p", CASES["single"].laws, relative=True)


def b4(paper: PaperB) -> Figure:
    """The twin parabola."""
    return _geometry(paper.films["twin"][MNL])


def b5(paper: PaperB) -> Figure:
    """Pressure over the twin parabola, θ = 1.0001 at the inlet; η = 0.039 Pa s, u = 4.57 m/s."""
    return _compared(paper, "twin", "p", CASES["twin"].laws, relative=True)


def b6(paper: PaperB) -> Figure:
    """Density over the thin parabola, H0 = A = 2 µm, flooded; η = 0.04 Pa s, u = 0.25 m/s."""
    return _compared(paper, "flooded", "θ", (MNL, ORIGINAL))


def b7(paper: PaperB) -> Figure:
    """Pressure over the thin parabola, flooded."""
    return _compared(paper, "flooded", "p", (MNL, ORIGINAL))


def b8(paper: PaperB) -> Figure:
    """Density over the thin parabola, starved: θ = 0.55 at the inlet."""
    return _compared(paper, "starved", "θ", (MNL, ORIGINAL))


def b9(paper: PaperB) -> Figure:
    """Pressure over the thin parabola, starved; constant β lies on D&H-MNL."""
    return _compared(paper, "starved", "p", (MNL, ORIGINAL, CONSTANT))


def b10(paper: PaperB) -> Figure:
    """Pressure over the thin parabola, starved, for three bulk moduli."""
    return _compared(paper, "starved, moduli", "p", CASES["starved, moduli"].laws)


def b11(paper: PaperB) -> Figure:
    """Pressure in the converging gap, 1.25 to 1 µm, θ = 0.85 at the inlet."""
    return _compared(paper, "gap", "p", (MNL, ORIGINAL, CONSTANT))


def b12(paper: PaperB) -> Figure:
    """Pressure in the converging gap, starved, for three bulk moduli."""
    return _compared(paper, "gap, moduli", "p", CASES["gap, moduli"].laws)


def _patterns(paper: PaperB, kind: str, inlet: str) -> list[tuple[str, str, CavitatingFilm]]:
    """Number, colour and film of each wavelength."""
    return [
        (number, colour, paper.patterns[name, inlet])
        for name in PATTERNS
        for wavelength, (number, colour) in FREQUENCIES.items()
        if name == f"{kind}, {wavelength}"
    ]


def _wavy(paper: PaperB, kind: str) -> Figure:
    figure = Figure(figsize=(8, 4.2), layout="constrained")
    panels: list[Axes] = list(figure.subplots(2, 1, sharex=True))
    for axes, (number, colour, film) in zip(panels, _patterns(paper, kind, "pc"), strict=True):
        _film(axes, film, colour)
        axes.set_title(number, loc="left", fontsize=10)
        axes.set_ylim(0, 20)
    panels[0].set_xlabel("")
    return figure


def b13(paper: PaperB) -> Figure:
    """Parallel gaps with sine waves at x < L/2: 1 of 10 mm and 2 of 5 mm; H0 = 10 µm, A = 5 µm (our choice)."""
    return _wavy(paper, "sinusoidal")


def b14(paper: PaperB) -> Figure:
    """Pressure over the sine waves, flooded at pc (our choice): the film ruptures in every wave."""
    figure, axes = _axes()
    for number, colour, film in _patterns(paper, "sinusoidal", "pc"):
        axes.plot(film.x[_thin(film)], film.pressure[_thin(film)] / 1e6, color=colour, label=number, lw=1.2)
    axes.set(xlabel="x, m", ylabel="p, MPa", ylim=(0, 1.5))
    axes.legend()
    return figure


def b15(paper: PaperB) -> Figure:
    """Density over the first sine waves: the liquid above, on a scale of its own, and the cavities below.

    The paper shows the first 8 mm; the first cavity of 1 ends at 10 mm.
    """
    figure = Figure(figsize=(8, 4.8), layout="constrained")
    panels: list[Axes] = list(figure.subplots(2, 1, sharex=True, height_ratios=(1, 1)))
    for number, colour, film in _patterns(paper, "sinusoidal", "pc"):
        near = film.x <= 10.5e-3
        liquid: Array = np.where(film.pressure > 0, film.theta, np.nan)
        panels[0].plot(1e3 * film.x[near], 1e4 * (liquid[near] - 1), color=colour, label=number, lw=1.6)
        panels[1].plot(1e3 * film.x[near], np.minimum(film.theta[near], 1), color=colour, lw=1.6)
    panels[0].set(ylim=(0, 4), ylabel="(θ − 1) · 10⁴")
    panels[0].legend(loc="upper left")
    panels[1].set(ylabel="θ", ylim=(None, 1.02), xlabel="x, mm", xlim=(0, 10.5))
    return figure


def b16(paper: PaperB) -> Figure:
    """Parallel gaps with cos² pockets at x < L/2: 1 of 10 mm and 2 of 5 mm (our choice); H0 = 10 µm, A = 5 µm."""
    return _wavy(paper, "cos²")


def b17(paper: PaperB) -> Figure:
    """Pressure over the cos² pockets, with the inlet at pc and at 2 pc (0.1 MPa above ambient)."""
    figure, axes = _axes(4)
    for inlet, style in zip(INLETS, ("-", "--"), strict=True):
        for number, colour, film in _patterns(paper, "cos²", inlet):
            label = f"{number}, pw = {inlet}"
            axes.plot(film.x[_thin(film)], film.pressure[_thin(film)] / 1e6, style, color=colour, label=label, lw=1.2)
    axes.set(xlabel="x, m", ylabel="p, MPa", xlim=(0, 0.1), ylim=(0, 2.5))
    axes.legend()
    return figure


NUMBERED = {
    f"B.{number}": draw
    for number, draw in enumerate((b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14, b15, b16, b17), start=1)
}


def reach(paper: PaperB) -> Figure:
    """Relative difference of the load to that with D&H-MNL; the greatest pressure rises with the speed."""
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
