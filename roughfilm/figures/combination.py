"""The pictures of two combined surfaces."""

import matplotlib as mpl
import numpy as np
from matplotlib.colors import ListedColormap

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.registration.combine import Combined
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.figures.base import new_figure, surface_map, svg

COLOURS = mpl.colormaps["RdBu_r"].with_extremes(bad="#444444")


def surface_maps(combined: Combined, titles: tuple[str, str]) -> str:
    """Both surfaces on the common grid, in the same colours."""
    surfaces = (combined.first, combined.second)
    figure, panels = new_figure((11, _height(surfaces[0], 4.4)), 1, 2, squeeze=False)
    figure.set_layout_engine("compressed")
    limit = max(map(_limit, surfaces))
    for axes, surface, title in zip(panels[0], surfaces, titles, strict=True):
        image = surface_map(axes, _drawn(surface), surface.size, cmap=COLOURS, vmin=-limit, vmax=limit)
        axes.set_title(title, fontsize=10)
    figure.colorbar(image, ax=panels[0].tolist(), label="height, µm (dark: invalid)")
    return svg(figure)


def result_map(combined: Combined) -> str:
    """The difference with a line around the worn places, or the sum."""
    surface = combined.surface
    figure, axes = new_figure((8, _height(surface, 6.5)))
    figure.set_layout_engine("compressed")
    limit = _limit(surface)
    label = "composite height, µm" if combined.operation == "sum" else "before − after, µm"
    heights = _drawn(surface) if combined.operation == "sum" else _difference(surface)
    image = surface_map(axes, heights, surface.size, cmap=COLOURS, vmin=-limit, vmax=limit)
    if combined.worn.any() and not combined.worn.all():
        x, y = ((np.arange(n) + 0.5) * step * 1e6 for n, step in zip(surface.shape, surface.spacing, strict=True))
        axes.contour(x, y, combined.worn.T.astype(float), levels=[0.5], cmap=ListedColormap(["black"]), linewidths=1)
    figure.colorbar(image, ax=axes, label=f"{label} (dark: invalid)")
    return svg(figure)


def profiles(combined: Combined, names: tuple[str, str]) -> str:
    """Both surfaces and the result along x, through the place with the largest result."""
    surface = combined.surface
    heights = np.where(surface.invalid, -np.inf, surface.heights)
    line = int(np.argmax(heights.max(axis=0)))
    figure, axes = new_figure((11, 3.8))
    x = (np.arange(surface.shape[0]) + 0.5) * surface.spacing[0] * 1e6
    result = "sum" if combined.operation == "sum" else "before − after"
    for field, label, colour, width in (
        (_drawn(combined.first), names[0], "#e08214", 1.0),
        (_drawn(combined.second), names[1], "#2166ac", 1.0),
        (_drawn(surface) if combined.operation == "sum" else _difference(surface), result, "black", 1.6),
    ):
        axes.plot(x, field[:, line], color=colour, label=label, linewidth=width)
    axes.set(xlabel=f"x, µm, at y = {(line + 0.5) * surface.spacing[1] * 1e6:.4g} µm", ylabel="height, µm")
    figure.legend(loc="outside upper center", ncols=3)
    return svg(figure)


def _drawn(surface: Surface) -> Array:
    """The heights from their mean, µm, nan where invalid."""
    return np.where(surface.invalid, np.nan, surface.heights - surface.heights[surface.valid].mean()) * 1e6


def _difference(surface: Surface) -> Array:
    """The difference from its unworn level, µm, nan where invalid."""
    return np.where(surface.invalid, np.nan, surface.heights * 1e6)


def _limit(surface: Surface) -> float:
    """The end of the colours on both sides of the mean plane, µm."""
    return max(float(np.abs(np.nanpercentile(_drawn(surface), [0.1, 99.9])).max()), 1e-9)


def _height(surface: Surface, width: float) -> float:
    """The height of a figure whose maps are so wide, inches."""
    return min(6.0, 1.0 + width * surface.size[1] / surface.size[0])
