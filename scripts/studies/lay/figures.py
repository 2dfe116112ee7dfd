"""Figures of the study of the lay."""

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughfilm.figures.base import new_figure
from roughfilm.rom.homogenization.lay import box_factors, turned
from roughfilm.stability.joint import cut_grooves
from scripts.studies.lay.claims import Lay
from scripts.studies.lay.data import TEXTURES, THICKNESSES, FactorPair, angle, box_of, grooves_exactly
from scripts.studies.lay.measured import OBLIQUE

ALONG, ACROSS, MIXED = "#2166ac", "#1a7f37", "#b2182b"
COLOURS = ("#08519c", "#4292c6", "#9ecae1")
SURFACES = ("#2166ac", "#b2182b", "#1a7f37", "#b07d2b")
THIN = 2.0
"""Separation over Sq at which shear is drawn."""


def drawings(lay: Lay) -> dict[str, Callable[[Lay], Figure]]:
    """Return the functions that draw, by name of the figure."""
    made: dict[str, Callable[[Lay], Figure]] = {
        "pressure": pressure,
        "shear": shear,
        "boxes": boxes,
        "joints": joints,
        "offsets": offsets,
    }
    return made | ({"measured": measured} if OBLIQUE in lay.measured else {})


def pressure(lay: Lay) -> Figure:
    """A and φ over the angle of the lay: a row for each texture, a column for each separation."""
    figure, panels = new_figure((10, 9), len(TEXTURES), len(THICKNESSES), sharex=True)
    turns = np.linspace(0, np.pi / 2, 91)
    for row, texture in zip(panels, TEXTURES, strict=True):
        for axes, thickness in zip(row, THICKNESSES, strict=True):
            tensors = np.array([lay.turned.tensor(texture, thickness, turn) for turn in turns])
            large = np.array([box_of(tensor, (1, 1)) for tensor in tensors])
            places = np.degrees(turns)
            for (i, j), colour, name in (((0, 0), ALONG, "A₁₁"), ((1, 1), ACROSS, "A₂₂"), ((0, 1), MIXED, "A₁₂")):
                axes.plot(places, tensors[:, i, j], color=colour, linewidth=1.2)
                _dots(axes, lay, (texture, thickness), _entry(i, j), colour, name)
            for i, colour, name in ((0, ALONG, "φ₁"), (1, ACROSS, "φ₂")):
                axes.plot(places, large[:, i], color=colour, linewidth=1, linestyle="--")
                _dots(axes, lay, (texture, thickness), _box_factor(i), colour, name, full=False)
            axes.set_title(f"{texture}, {thickness:g} Sq", fontsize=9)
        row[0].set_ylabel("over ĥ³")
    for axes in panels[-1]:
        axes.set_xlabel("lay against flow, degrees")
    panels[0][0].legend(fontsize=8, ncols=2)
    return figure


def _entry(i: int, j: int) -> Callable[[FactorPair], float]:
    return lambda one: float(one.cell.pressure[i, j])


def _box_factor(i: int) -> Callable[[FactorPair], float]:
    return lambda one: float(one.box.pressure[i])


def _drag(i: int) -> Callable[[FactorPair], float]:
    return lambda one: float(one.cell.shear[i])


def _dots(
    axes: Axes,
    lay: Lay,
    setting: tuple[str, float],
    of: Callable[[FactorPair], float],
    colour: str,
    name: str,
    *,
    full: bool = True,
) -> None:
    """Draw a value at each turn of a texture at a thickness."""
    found = {
        np.degrees(angle(turn)): of(one)
        for (own, thick, turn), one in lay.turned.found.items()
        if (own, thick) == setting
    }
    style: dict[str, Any] = {} if full else {"markerfacecolor": "white"}
    axes.plot(
        *zip(*sorted(found.items()), strict=True), "o" if full else "s", color=colour, label=name, ms=4.5, **style
    )


def shear(lay: Lay) -> Figure:
    """B and Patir and Cheng's counterpart of B₁ over the angle of the lay, at 2 Sq."""
    figure, panels = new_figure((10, 3.4), 1, len(TEXTURES), sharey=True)
    turns = np.linspace(1e-3, np.pi / 2 - 1e-3, 91)
    for axes, texture in zip(panels, TEXTURES, strict=True):
        drag = np.array([lay.turned.drag(texture, THIN, turn) for turn in turns])
        tensors = np.array([lay.turned.tensor(texture, THIN, turn) for turn in turns])
        first = np.array([box_of(tensor, (1, 1))[0] for tensor in tensors])
        large = drag[:, 0] - drag[:, 1] * (tensors[:, 0, 0] - first) / tensors[:, 0, 1]
        for i, colour, name in ((0, ALONG, "B₁"), (1, MIXED, "B₂")):
            axes.plot(np.degrees(turns), drag[:, i], color=colour, linewidth=1.2)
            _dots(axes, lay, (texture, THIN), _drag(i), colour, name)
        axes.plot(np.degrees(turns), large, color=ALONG, linewidth=1, linestyle="--")
        _dots(axes, lay, (texture, THIN), lambda one: one.box.shear, ALONG, "1 + σφs/ĥ", full=False)
        axes.set_title(f"{texture}, {THIN:g} Sq", fontsize=9)
        axes.set_xlabel("lay against flow, degrees")
    panels[0].set_ylabel("over ĥ")
    panels[0].legend(fontsize=8)
    return figure


def boxes(lay: Lay) -> Figure:
    """φ₁ of grooves at 45° in boxes of several shapes."""
    figure, axes = new_figure((7.5, 3.6))
    shapes = np.geomspace(0.05, 20, 121)
    principal = grooves_exactly(THIN)[0]
    tensor = turned(principal, np.pi / 4)
    axes.plot(shapes, [box_factors(tensor, (one, 1))[0] for one in shapes], color=ALONG, label="large box, exact")
    axes.plot(*lay.turned.boxes, "s", color=ALONG, markerfacecolor="white", label="φ₁, computed")
    for value, name in (
        (tensor[0, 0], "A₁₁, the arithmetic mean"),
        (np.sqrt(principal.prod()), "√(det A), the geometric mean"),
        (np.linalg.det(tensor) / tensor[1, 1], "det A/A₂₂, the harmonic mean"),
    ):
        axes.axhline(value, color="black", linewidth=0.8, linestyle=":")
        axes.annotate(name, (0.04, value), (0, 3), textcoords="offset points", size=8)
    axes.set(xscale="log", ylim=(0, 1.05), xlabel="length of the box over its width", ylabel="φ₁, over ĥ³")
    axes.legend(fontsize=8, loc="center right")
    return figure


def measured(lay: Lay) -> Figure:
    """Pressure and shear flow factors of the measured surface over the separation."""
    one = lay.measured[OBLIQUE]
    figure, (left, right) = new_figure((10, 4.2), 1, 2)
    places = sorted(one.found)
    rows = [one.found[place] for place in places]
    for (i, j), colour, name in (((0, 0), ALONG, "A₁₁"), ((1, 1), ACROSS, "A₂₂"), ((0, 1), MIXED, "A₁₂")):
        left.plot(places, [row.cell.pressure[i, j] for row in rows], color=colour, label=name)
    for i, colour, name in ((0, ALONG, "φ₁"), (1, ACROSS, "φ₂")):
        left.plot(
            places, [row.box.pressure[i] for row in rows], "s-", color=colour, label=name, ms=4, mfc="white", lw=0.8
        )
        left.plot(places, [one.boxes[place][i] for place in places], "--", color=colour, linewidth=1)
    for i, colour, name in ((0, ALONG, "B₁"), (1, MIXED, "B₂")):
        right.plot(places, [row.cell.shear[i] for row in rows], color=colour, label=name)
    right.plot(places, [row.box.shear for row in rows], "s-", color=ALONG, label="1 + σφs/ĥ", ms=4, mfc="white", lw=0.8)
    for axes, name in ((left, "pressure flow factors, over ĥ³"), (right, "shear flow factors, over ĥ")):
        axes.axvline(1, color="black", linewidth=0.8, linestyle="--")
        axes.set(xlabel="separation over highest point, α/ĥ₁", ylabel=name)
        axes.legend(fontsize=8)
    return figure


def joints(lay: Lay) -> Figure:
    """Two periods of a cut surface, and the flow through a joint, by shift and by mismatch."""
    figure, (picture, shifted, scattered) = new_figure((10, 3.8), 1, 3)
    heights = cut_grooves(0.5).heights
    picture.imshow(np.tile(heights, (2, 1)).T, cmap="Greys", origin="lower", extent=(0, 2, 0, 1), aspect="auto")
    picture.axvline(1, color=MIXED, linewidth=1)
    picture.set_title("cut by half a distance: two periods", fontsize=9)
    picture.set_xlabel("along the lay, periods")
    picture.grid(visible=False)
    for number, (thickness, colour) in enumerate(zip(THICKNESSES, COLOURS, strict=True)):
        rows = [(shift, row[number].passed) for shift, row in lay.joints.cut.items()]
        shifted.plot([s for s, _ in rows], [p[0] for _, p in rows], color=colour, label=f"{thickness:g} Sq")
        shifted.plot([s for s, _ in rows], [p[1] for _, p in rows], color=colour, linestyle="--", linewidth=1)
        for kind, marker in ((0, "o"), (1, "x")):
            windows = [
                (one.mismatch[kind], one.passed[kind]) for one in lay.joints.windows if one.thickness == thickness
            ]
            label = ("raw", "edges blended")[kind] if thickness == THIN else None
            scattered.plot(*zip(*windows, strict=True), marker, color=colour, ms=4, label=label)
    shifted.set(xlabel="shift over distance (dashed: blended)", ylabel="flow along the lay, over the truth")
    shifted.legend(fontsize=8)
    scattered.axvline(0.1, color="black", linewidth=0.8, linestyle=":")
    scattered.set_title("windows of random striated surfaces", fontsize=9)
    scattered.set_xlabel("periodicity mismatch")
    scattered.legend(fontsize=8, loc="lower left")
    return figure


def offsets(lay: Lay) -> Figure:
    """A along x with closed contact and with the offset; what the offset adds in both directions."""
    figure, (left, right) = new_figure((10, 4), 1, 2)
    for (name, row), colour in zip(lay.offsets.items(), SURFACES, strict=False):
        places = [one.separation for one in row]
        closed = np.array([np.cbrt(one.closed[0]) for one in row]) * 1e9
        left.plot(places, np.where(closed > 0, closed, np.nan), color=colour, label=name)
        left.plot(places, [1e9 * one.slit[0] for one in row], color=colour, linestyle="--", linewidth=1)
        both = [(r, a) for one in row for r, a in zip(one.relative, one.added, strict=True) if r > 0]
        right.plot(*zip(*both, strict=True), "o", color=colour, ms=4, label=name)
    left.set(
        yscale="log", xlabel="separation over Sq (dashed: with the offset)", ylabel="slit that leaks as much, ∛A₁₁, nm"
    )
    left.legend(fontsize=8)
    right.set(
        xscale="log",
        yscale="log",
        xlabel="A₁₁/ĥ³ and A₂₂/ĥ³ with closed contact",
        ylabel="what the offset adds, over A",
    )
    return figure
