"""Figures of the study of the lay."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
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
DRAWN_THICKNESS = 2.0
"""Separation over Sq at which shear is drawn."""

CELL_FACTORS = (((0, 0), ALONG, "A₁₁"), ((1, 1), ACROSS, "A₂₂"), ((0, 1), MIXED, "A₁₂"))
BOX_FACTORS = ((0, ALONG, "φ₁"), (1, ACROSS, "φ₂"))
DRAG_FACTORS = ((0, ALONG, "B₁"), (1, MIXED, "B₂"))
"""Index, colour and label of the factors that are drawn."""

SQUARES: dict[str, Any] = {"marker": "s", "linestyle": "", "markersize": 4.5, "markerfacecolor": "white"}
LINE_OF_SQUARES: dict[str, Any] = {"marker": "s", "ms": 4, "mfc": "white", "lw": 0.8}


def drawings(lay: Lay) -> Mapping[str, Callable[[Lay], Figure]]:
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
            places, computed = _turns(lay, texture, thickness)
            for (i, j), colour, name in CELL_FACTORS:
                axes.plot(np.degrees(turns), tensors[:, i, j], color=colour, linewidth=1.2)
                axes.plot(places, [one.cell.pressure[i, j] for one in computed], "o", color=colour, label=name, ms=4.5)
            for i, colour, name in BOX_FACTORS:
                axes.plot(np.degrees(turns), large[:, i], color=colour, linewidth=1, linestyle="--")
                axes.plot(places, [one.box.pressure[i] for one in computed], color=colour, label=name, **SQUARES)
            axes.set_title(f"{texture}, {thickness:g} Sq", fontsize=9)
        row[0].set_ylabel("over ĥ³")
    for axes in panels[-1]:
        axes.set_xlabel("lay against flow, degrees")
    panels[0][0].legend(fontsize=8, ncols=2)
    return figure


def _turns(lay: Lay, texture: str, thickness: float) -> tuple[list[float], list[FactorPair]]:
    """Return the angles of the lay, degrees, in order, and the factors at each."""
    found = {
        np.degrees(angle(turn)): one
        for (own, thick, turn), one in lay.turned.found.items()
        if (own, thick) == (texture, thickness)
    }
    return sorted(found), [found[place] for place in sorted(found)]


def shear(lay: Lay) -> Figure:
    """B and Patir and Cheng's counterpart of B₁ over the angle of the lay, at 2 Sq."""
    figure, panels = new_figure((10, 3.4), 1, len(TEXTURES), sharey=True)
    turns = np.linspace(1e-3, np.pi / 2 - 1e-3, 91)
    for axes, texture in zip(panels, TEXTURES, strict=True):
        drag = np.array([lay.turned.drag(texture, DRAWN_THICKNESS, turn) for turn in turns])
        tensors = np.array([lay.turned.tensor(texture, DRAWN_THICKNESS, turn) for turn in turns])
        first = np.array([box_of(tensor, (1, 1))[0] for tensor in tensors])
        large = drag[:, 0] - drag[:, 1] * (tensors[:, 0, 0] - first) / tensors[:, 0, 1]
        places, computed = _turns(lay, texture, DRAWN_THICKNESS)
        for i, colour, name in DRAG_FACTORS:
            axes.plot(np.degrees(turns), drag[:, i], color=colour, linewidth=1.2)
            axes.plot(places, [one.cell.shear[i] for one in computed], "o", color=colour, label=name, ms=4.5)
        axes.plot(np.degrees(turns), large, color=ALONG, linewidth=1, linestyle="--")
        axes.plot(places, [one.box.shear for one in computed], color=ALONG, label="1 + σφs/ĥ", **SQUARES)
        axes.set_title(f"{texture}, {DRAWN_THICKNESS:g} Sq", fontsize=9)
        axes.set_xlabel("lay against flow, degrees")
    panels[0].set_ylabel("over ĥ")
    panels[0].legend(fontsize=8)
    return figure


def boxes(lay: Lay) -> Figure:
    """φ₁ of grooves at 45° in boxes of several shapes."""
    figure, axes = new_figure((7.5, 3.6))
    shapes = np.geomspace(0.05, 20, 121)
    principal = grooves_exactly(DRAWN_THICKNESS)[0]
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
    for (i, j), colour, name in CELL_FACTORS:
        left.plot(places, [row.cell.pressure[i, j] for row in rows], color=colour, label=name)
    for i, colour, name in BOX_FACTORS:
        left.plot(places, [row.box.pressure[i] for row in rows], color=colour, label=name, **LINE_OF_SQUARES)
        left.plot(places, [one.boxes[place][i] for place in places], "--", color=colour, linewidth=1)
    for i, colour, name in DRAG_FACTORS:
        right.plot(places, [row.cell.shear[i] for row in rows], color=colour, label=name)
    right.plot(places, [row.box.shear for row in rows], color=ALONG, label="1 + σφs/ĥ", **LINE_OF_SQUARES)
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
        shifts = list(lay.joints.cut)
        raw, blended = np.transpose([row[number].passed for row in lay.joints.cut.values()])
        shifted.plot(shifts, raw, color=colour, label=f"{thickness:g} Sq")
        shifted.plot(shifts, blended, color=colour, linestyle="--", linewidth=1)
        windows = [one for one in lay.joints.windows if one.thickness == thickness]
        for kind, marker in ((0, "o"), (1, "x")):
            label = ("raw", "edges blended")[kind] if thickness == DRAWN_THICKNESS else None
            x, y = [one.mismatch[kind] for one in windows], [one.passed[kind] for one in windows]
            scattered.plot(x, y, marker, color=colour, ms=4, label=label)
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
    left.set(yscale="log", xlabel="separation over Sq (dashed: with the offset)")
    left.set_ylabel("slit that leaks as much, ∛A₁₁, nm")
    left.legend(fontsize=8)
    right.set(xscale="log", yscale="log", xlabel="A₁₁/ĥ³ and A₂₂/ĥ³ with closed contact")
    right.set_ylabel("what the offset adds, over A")
    return figure
