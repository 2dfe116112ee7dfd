"""Figures of Paper E: leakage by window, resolution and load, and the thrust washer over speed."""

from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np
from matplotlib.figure import Figure

from roughfilm.figures.base import new_figure
from roughfilm.pages.stribeck import drawn_film
from roughfilm.rom.bearing.mixed.film import MixedFilm
from roughfilm.rom.bearing.mixed.stribeck import StribeckPoint
from scripts.studies.paper_e.claims import PaperE
from scripts.studies.paper_e.data import CELLS, LOADS, SEEDS, SHOWN, Washer
from scripts.studies.paper_e.windows import LOAD, PARTS, Leak
from scripts.studies.paper_e.windows import LOADS as PRESSED

COLOURS = ("#2166ac", "#b2182b", "#1a7f37", "#b07d2b", "#6a51a3")
LINES = (":", "-", "--")
WINDOWS = dict(zip(PARTS, COLOURS, strict=False))
WITH_PRESSURES = ("surface 1", "surface 2", "surface 3")
SPEED_TICKS = (10, 20, 50, 100, 200, 500)
"""Speeds at the ticks of an axis, revolutions per minute."""

LAYS = {"along": COLOURS[0], "across": COLOURS[2], "+45°": COLOURS[1], "-45°": COLOURS[3]}


def leakages(windows: Sequence[Leak]) -> Figure:
    """Draw Figs. E.19 to E.21: leaked volumes by window and place, by resolution, and over the load."""
    figure, (places, grids, loads) = new_figure((11.4, 4.0), 1, 3)
    for number, (window, colour) in enumerate(WINDOWS.items()):
        rows = [one for one in windows if one.window == window and one.resolution == 1.0]
        usual = [one for one in rows if one.load == LOAD]
        for axis, marker in ((0, "s"), (1, "o")):
            where = number + 0.22 * (axis - 0.5) * 2 + np.linspace(-0.08, 0.08, len(usual))
            label = f"along {'xy'[axis]}" if window == "a" else None
            homogenized, direct = ([1e6 * one.volume(axis, direct=way) for one in usual] for way in (False, True))
            places.plot(where, homogenized, marker, color=colour, ms=4.5, label=label)
            places.plot(where, direct, marker, color=colour, ms=7.5, mfc="none", lw=0)
        for start in dict.fromkeys(one.start for one in rows):
            line = [one for one in rows if one.start == start]
            look = {
                "lw": 1.8 if window == "a" else 0.7,
                "label": f"window {window}" if start == rows[0].start else None,
            }
            loads.plot([one.load / 1e6 for one in line], [1e6 * one.volume(1) for one in line], color=colour, **look)
    places.set_xticks(range(len(PARTS)), list(PARTS))
    places.set_xlabel(f"window, at {LOAD / 1e6:g} MPa")
    places.legend(fontsize=8, title="full: HNS, empty: DNS", title_fontsize=8, loc="lower left")
    for window in ("a", "b"):
        rows = [one for one in windows if one.window == window]
        for load, style in zip(PRESSED[:3], LINES, strict=True):
            line = [one for one in rows if one.start == rows[0].start and one.load == load]
            line.sort(key=lambda one: one.resolution)
            x, y = [one.resolution for one in line], [1e6 * one.volume(1) for one in line]
            label = f"{load / 1e6:g} MPa" if window == "a" else None
            grids.plot(x, y, "o" + style, color=WINDOWS[window], label=label)
    grids.set_xscale("log", base=2)
    grids.set_xticks([0.5, 1, 2], ["half", "as prepared", "double"])
    grids.set(xlabel="nodes along a side, along y", ylim=(0, None))
    grids.legend(fontsize=8, loc="lower right")
    loads.set(xscale="log", yscale="log", xlabel="load, MPa, along y")
    loads.legend(fontsize=8)
    for axes in (places, grids, loads):
        axes.set_ylabel("leaked in 300 s, ml")
    return figure


def pressures(washers: Mapping[str, Washer]) -> Figure:
    """Draw Figs. E.25 to E.27: the pressure of the film at 30 and 300 revolutions per minute under 1 MPa."""
    names = [name for name in WITH_PRESSURES if name in washers]
    figure, panels = new_figure((11.4, 2.7 * len(SHOWN)), len(SHOWN), len(names), squeeze=False)
    views = {}
    for name, turns in product(names, SHOWN):
        one = washers[name]
        film = MixedFilm(scene=one.scene, asperities=one.asperities, cells=CELLS)
        point = point_at(one, 1, turns)
        views[name, turns] = drawn_film(film.at(point.separation + film.dip, point.speed), f"{name}, {turns:g} rpm")
    scale = {"vmin": 0, "vmax": max(float(view.film.max()) for view in views.values()) / 1e6, "cmap": "viridis"}
    for axes, (turns, name) in zip(panels.ravel(), product(SHOWN, names), strict=True):
        view = views[name, turns]
        axes.grid(visible=False)
        axes.set_aspect("equal")
        x, y, film_pressure = 1e3 * view.x, 1e3 * view.y, view.film / 1e6
        image = axes.pcolormesh(x, y, film_pressure, shading="gouraud", rasterized=True, **scale)
        axes.set_title(view.title, fontsize=9)
    figure.colorbar(image, ax=panels, label="film, MPa", shrink=0.8)
    return figure


def point_at(one: Washer, number: int, turns: float) -> StribeckPoint:
    """Return the point under the load of index ``number`` that is nearest to a speed, revolutions per minute."""
    return min(one.curves[number].points, key=lambda point: abs(point.speed * one.turns - turns))


def films(washers: Mapping[str, Washer]) -> Figure:
    """Draw Fig. E.28: the least separation above that of first contact, by both methods, under 1 and 2 MPa."""
    figure, panels = new_figure((11.4, 4.2), 1, 2, sharey=True)
    for axes, number, end in zip(panels, (1, 2), (300, 600), strict=True):
        for (name, one), colour in zip(washers.items(), COLOURS, strict=False):
            for curves, line in ((one.curves, "-"), (one.boxed, "--")):
                points = [point for point in curves[number].points if point.speed * one.turns <= end * 1.15]
                speeds = [point.speed * one.turns for point in points]
                heights = [1e6 * (point.separation - one.asperities.touching) for point in points]
                axes.plot(speeds, heights, line, color=colour, linewidth=1.4, label=name if line == "-" else None)
            speed, uncertainty = one.lift()[number]
            axes.errorbar([speed], [0], xerr=[uncertainty], fmt="o", ms=3.5, color=colour, elinewidth=1.2, capsize=2)
        axes.axhline(0, color="black", linewidth=0.8)
        axes.set_title(f"{LOADS[number] / 1e6:g} MPa; full: HNS, dashed: Patir and Cheng", fontsize=10)
        axes.set(xlim=(0, end), ylim=(-2.5, 12), xlabel="speed, rpm")
    panels[0].set_ylabel("least separation over the first touch, µm")
    panels[0].legend(fontsize=8, loc="upper left")
    return figure


def friction(washers: Mapping[str, Washer]) -> Figure:
    """Draw Fig. E.29: the coefficient of friction over speed."""
    figure, axes = new_figure((11.4, 4.4))
    for (name, one), colour in zip(washers.items(), COLOURS, strict=False):
        for curve, line in zip(one.curves, LINES, strict=True):
            speeds = [point.speed * one.turns for point in curve.points]
            coefficients = [point.friction_coefficient for point in curve.points]
            label = name if line == "-" else None
            axes.plot(speeds, coefficients, line, color=colour, label=label, linewidth=1.3)
    axes.set(yscale="log", ylabel="coefficient of friction")
    axes.set_xlabel("speed, rpm (dotted 0.5 MPa, full 1 MPa, dashed 2 MPa)")
    axes.legend(fontsize=8)
    return figure


def lays(paper: PaperE) -> Figure:
    """Draw the lift-off speed over the load for every lay of surface 3, and for surface 1 along and across."""
    figure, (turned, first) = new_figure((11.4, 3.8), 1, 2)
    loads = np.array(LOADS) / 1e6
    lines = [(turned, lay, lay if seed == SEEDS[0] else None, f"{lay}, {seed}") for lay in LAYS for seed in SEEDS]
    lines += [(first, "along", "along", "surface 1"), (first, "across", "across", "surface 1, across")]
    washers = {**paper.washers, **paper.lays}
    for axes, lay, label, name in lines:
        speed, uncertainty = washers[name].lift().T
        axes.errorbar(loads, speed, uncertainty, fmt="o-", color=LAYS[lay], label=label, lw=1, ms=3, capsize=2)
    turned.set_title("surface 3, two samples", fontsize=10)
    first.set_title("surface 1", fontsize=10)
    for axes in (turned, first):
        axes.set(xlabel="load, MPa", ylabel="lift-off, rpm", xscale="log", yscale="log")
        axes.set_xticks(loads, [f"{load:g}" for load in loads])
        axes.minorticks_off()
        axes.set_yticks(SPEED_TICKS, [f"{speed:g}" for speed in SPEED_TICKS])
        axes.set_ylim(7, 500)
        axes.legend(fontsize=8, title="ridges against the sliding", title_fontsize=8, loc="lower right")
    return figure


def textures(washers: Mapping[str, Washer]) -> Figure:
    """Draw the heights of the surfaces."""
    figure, panels = new_figure((11.4, 2.9), 1, len(washers))
    for axes, (name, one) in zip(panels, washers.items(), strict=True):
        roughness = one.scene.roughness
        heights, spacing = roughness.scaled_heights(), roughness.scaled_spacing()  # type: ignore[union-attr]
        width, height = (count * step * 1e3 for count, step in zip(heights.shape, spacing, strict=True))
        axes.grid(visible=False)
        axes.imshow(1e6 * heights.T, origin="lower", extent=(0, width, 0, height), cmap="cividis", vmin=-6, vmax=9)
        axes.set_title(f"{name}, Sq {1e6 * heights.std():.2f} µm", fontsize=9)
        axes.set_xlabel("mm")
    return figure


def drawings(paper: PaperE) -> dict[str, Figure]:
    """Return the figures by name."""
    made = {draw.__name__: draw(paper.washers) for draw in (textures, friction, films, pressures)}
    made["lays"] = lays(paper)
    return made | ({"leakages": leakages(paper.windows)} if paper.windows else {})
