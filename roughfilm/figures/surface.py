"""The pictures of a surface and its preparation."""

from collections.abc import Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.image import AxesImage
from matplotlib.patches import Rectangle

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.parameters.bearing_curve import bearing_curve
from roughfilm.contact.parameters.spectrum import power_spectrum, radial_power
from roughfilm.contact.preparation.edges.joined import Joined
from roughfilm.contact.preparation.prepare import Prepared
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.figures.base import new_figure, surface_map, svg
from roughfilm.figures.ticks import plain_logarithmic

COLOURS = mpl.colormaps["RdBu_r"].with_extremes(bad="#444444")
BEFORE, AFTER = "#e08214", "#2166ac"

MARKED_POINTS = 256
"""Largest number of points along a side at which the blended ones are marked."""


def height_maps(prepared: Prepared) -> str:
    """The measured surface with its invalid points and window, and the prepared one, in the same colours."""
    drawn = {"measured, form removed": prepared.measured, "prepared": prepared.surface}
    if np.array_equal(prepared.measured.heights, prepared.surface.heights):
        drawn = {"measured; preparation changed no height": prepared.measured}
    figure, panels = new_figure((11, _height(prepared.measured, 4.4)), 1, len(drawn), squeeze=False)
    figure.set_layout_engine("compressed")
    level, limit = _level(prepared), _limit(prepared)
    for axes, (title, surface) in zip(panels[0], drawn.items(), strict=True):
        heights = np.where(surface.invalid, np.nan, surface.heights)
        image = _height_map(axes, surface, heights - level, limit)
        axes.set_title(title, fontsize=10)
    window = prepared.record["window"]
    dx, dy = (step * 1e6 for step in prepared.measured.spacing)
    (i, j), (nx, ny) = window["start"], window["pixels"]
    panels[0, 0].add_patch(Rectangle((i * dx, j * dy), nx * dx, ny * dy, fill=False, edgecolor="black", linewidth=1.5))
    figure.colorbar(image, ax=panels[0].tolist(), label="height, µm (dark: invalid)")
    return svg(figure)


def joints(prepared: Prepared) -> str:
    """One and a quarter cells each way, after each step that changes them; black squares where the cells meet.

    Black lines are seams; dotted lines surround the points that were blended.
    """
    stages = {"the cell": prepared.cell}
    for title, surface in (("edges joined", prepared.joined), ("smoothed", prepared.surface)):
        if not np.array_equal(surface.heights, [*stages.values()][-1].heights):
            stages[title] = surface
    size = (11, _height(prepared.surface, 8.7 / max(2, len(stages))))
    figure, panels = new_figure(size, 1, len(stages), squeeze=False)
    figure.set_layout_engine("compressed")
    level, limit = _level(prepared), _limit(prepared)
    for axes, (title, surface) in zip(panels[0], stages.items(), strict=True):
        nx, ny = surface.shape
        tiled = np.pad(surface.heights, ((0, nx // 4), (0, ny // 4)), mode="wrap")
        image = _height_map(axes, surface, tiled - level, limit)
        width, height = (length * 1e6 for length in surface.size)
        for x, y in ((width, 0), (0, height), (width, 1.25 * height), (1.25 * width, height)):
            axes.plot(x, y, "ks", markersize=7, clip_on=False, zorder=5)
        if title == "edges joined":
            _mark_joint(axes, prepared.joint, surface.size)
        axes.set_title(title, fontsize=10)
    figure.colorbar(image, ax=panels[0].tolist(), label="height, µm")
    return svg(figure)


def _mark_joint(axes: Axes, joint: Joined, size: tuple[float, float]) -> None:
    every = [-(-count // MARKED_POINTS) for count in joint.weight.shape]
    blended = (joint.weight[:: every[0], :: every[1]] > 0).astype(float)
    tiled = np.pad(blended, [(0, count // 4) for count in blended.shape], mode="wrap")
    x, y = (
        (np.arange(many) + 0.5) * length / count * 1e6
        for many, count, length in zip(tiled.shape, blended.shape, size, strict=True)
    )
    if tiled.min() < tiled.max():
        axes.contour(x, y, tiled.T, levels=[0.5], colors="black", linewidths=0.7, linestyles=":")
    for axis, seam in enumerate(joint.seams):
        if seam is None:
            continue
        period, count = size[axis] * 1e6, seam.size
        place = np.pad(seam * 1e6, (0, count // 4), mode="wrap")
        along = (np.arange(place.size) + 0.5) * size[1 - axis] / count * 1e6
        for copy in (place, place + period):
            outside = (copy > 1.25 * period) | (np.abs(np.gradient(copy)) > period / 4)
            drawn = np.where(outside, np.nan, copy)
            axes.plot(*((drawn, along) if axis == 0 else (along, drawn)), "k-", linewidth=0.9)


def bearing_curves(prepared: Prepared) -> str:
    """Height against the part of the surface above it, with the cut levels."""
    figure, axes = new_figure((5.4, 4.2))
    level = _level(prepared)
    for surface, label, colour, line in _both(prepared):
        ratio, height = bearing_curve(surface.heights[surface.valid])
        axes.plot(100 * ratio, (height - level) * 1e6, color=colour, label=label, linewidth=line)
    clipped = bool(prepared.surface.source["recipe"]["outliers"]["quantile"])
    for end in ("highest", "lowest") if clipped else ():
        axes.axhline((prepared.record["outliers"][end] - level) * 1e6, color="black", linestyle=":", linewidth=1)
    axes.set(xlabel="part of the surface above, %" + (" (dotted: clipped)" if clipped else ""), ylabel="height, µm")
    figure.legend(loc="outside upper center", ncols=2)
    return svg(figure)


def power_spectra(prepared: Prepared) -> str:
    """Power by wavelength, all directions together, summed over quarters of an octave."""
    figure, axes = new_figure((5.4, 4.2))
    for surface, label, colour, line in _both(prepared):
        frequency, power = radial_power(power_spectrum(surface))
        quarter = np.rint(4 * np.log2(frequency[1:] / frequency[1])).astype(int)
        octaves = 4 * np.bincount(quarter, weights=power[1:])
        drawn = octaves > 1e-9 * octaves.max()
        wavelength = 2 ** (-np.arange(octaves.size) / 4) / frequency[1]
        axes.loglog(wavelength[drawn] * 1e6, octaves[drawn] * 1e12, color=colour, label=label, linewidth=line)
    axes.invert_xaxis()
    axes.set(xlabel="wavelength, µm", ylabel="mean square height per octave, µm²")
    plain_logarithmic(axes.xaxis)
    figure.legend(loc="outside upper center", ncols=2)
    return svg(figure)


def edge_profiles(prepared: Prepared) -> str:
    """The lines of pixels at both ends of each direction: black the outermost, grey the ten next to each."""
    figure, panels = new_figure((11, 3.6), 1, 2)
    surface, level = prepared.surface, _level(prepared)
    for axis, axes in enumerate(panels):
        lines = np.moveaxis(surface.heights - level, axis, 0) * 1e6
        place = (np.arange(lines.shape[1]) + 0.5) * surface.spacing[1 - axis] * 1e6
        near = min(11, lines.shape[0] // 2)
        for k in (*range(1, near), *range(-near, -1)):
            axes.plot(place, lines[k], color="0.75", linewidth=0.6)
        axes.plot(place, lines[0], "k-", linewidth=1, label="first line")
        axes.plot(place, lines[-1], "k--", linewidth=1, label="last line")
        axes.set(xlabel=f"{'yx'[axis]}, µm, along the joint across {'xy'[axis]}", ylabel="height, µm")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return svg(figure)


def _height(surface: Surface, width: float) -> float:
    """Of a figure whose maps are so wide at most, inches."""
    return min(5.0, 1.0 + width * surface.size[1] / surface.size[0])


def _both(prepared: Prepared) -> Sequence[tuple[Surface, str, str, float]]:
    return (prepared.measured, "measured", BEFORE, 2.4), (prepared.surface, "prepared", AFTER, 1.2)


def _level(prepared: Prepared) -> float:
    """The mean plane of the measured surface, from which all heights are drawn, m."""
    return float(prepared.measured.heights[prepared.measured.valid].mean())


def _limit(prepared: Prepared) -> float:
    """The end of the colours on both sides of the mean plane, µm."""
    heights = prepared.measured.heights[prepared.measured.valid] - _level(prepared)
    return float(np.abs(np.percentile(heights, [0.1, 99.9])).max()) * 1e6


def _height_map(axes: Axes, surface: Surface, heights: Array, limit: float) -> AxesImage:
    size = (heights.shape[0] * surface.spacing[0], heights.shape[1] * surface.spacing[1])
    return surface_map(axes, heights * 1e6, size, cmap=COLOURS, vmin=-limit, vmax=limit)
