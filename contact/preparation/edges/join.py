"""The choice of directions and width by the texture, and the cell before and after its edges are joined."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, Literal

from roughfilm.contact.foundation.arrays import Mask
from roughfilm.contact.parameters.autocorrelation import autocorrelation, decay_lengths
from roughfilm.contact.parameters.spectrum import power_spectrum, texture_direction
from roughfilm.contact.preparation.edges import blending, seams
from roughfilm.contact.preparation.edges.blending import Direction, blend_edges
from roughfilm.contact.preparation.edges.joined import Joined
from roughfilm.contact.preparation.edges.seams import join_by_seams
from roughfilm.contact.preparation.recipe import Edges
from roughfilm.contact.preparation.window import Window, cut_window
from roughfilm.contact.surfaces.surface import Surface

WIDTH = 1 / 2
"""Default width of the joint, in units of Sal."""

MIN_WIDTH_OF_SIDE, MAX_WIDTH_OF_SIDE = 1 / 80, 1 / 40
"""Limits of the default width, in units of the shorter side."""

STRONG_LAY = 0.3
"""Texture aspect ratio Str below which a surface is anisotropic (ISO 25178-3)."""

NEAR_AXIS = 30.0
"""Angle between lay and axis, degrees, up to which the lay counts as parallel to the axis."""

NAMES: dict[tuple[bool, bool], Direction] = {
    (False, False): "none",
    (True, False): "x",
    (False, True): "y",
    (True, True): "both",
}
"""Direction by whether edges were changed along x and along y."""


def join_edges(
    surface: Surface, window: Window, edges: Edges, grid: Callable[[Surface], Surface], *, filled: Mask
) -> tuple[Surface, Joined, Window, dict[str, Any]]:
    """Cut the window, resample it and join its edges.

    Parameters
    ----------
    surface : the measurement around the window, without invalid pixels.
    window : the window.
    edges : method, direction and width.
    grid : resamples a surface.
    filled : mask of the points that were invalid and filled, shape of the surface.

    Returns
    -------
    cell : resampled, edges as measured.
    joined : ``cell`` with joined edges; weight and seams may be on the pixels of the measurement.
    window : that of the cell, which joining by seams may have shortened.
    entries : method, direction, that in which edges did not match and were changed, width (m), reason of the choice,
        pixels by which the window was shortened, the fraction of blended points and the mean weight.

    Raises
    ------
    InputError
        As `blend_edges`, `join_by_seams` and ``grid`` do.
    """
    windowed = cut_window(surface, window)
    if edges.method == "blended":
        cell = grid(windowed)
        direction, width, reason = _chosen(cell, edges)
        joined, changed = blend_edges(cell, direction, width=width), direction
    else:
        direction, width, reason = _chosen(windowed, edges)
        joined, window = join_by_seams(surface, window, direction, width=width, filled=filled)
        cell = grid(cut_window(surface, window))
        joined = replace(joined, surface=grid(joined.surface))
        changed = NAMES[joined.seams[0] is not None, joined.seams[1] is not None]
    entries = {
        "method": edges.method,
        "direction": direction,
        "changed": changed,
        "width": list(width),
        "reason": reason,
        "shortened": [before - after for before, after in zip(windowed.shape, window.shape, strict=True)],
        "blended_fraction": joined.blended,
        "mean_weight": joined.mean_weight,
    }
    return cell, joined, window, entries


def _chosen(surface: Surface, edges: Edges) -> tuple[Direction, tuple[float, float], str]:
    decay = decay_lengths(autocorrelation(surface), surface.spacing)
    width = _width(surface, decay.shortest, edges) if edges.width is None else (edges.width, edges.width)
    if edges.direction != "auto":
        return edges.direction, width, "given"
    angle = texture_direction(power_spectrum(surface))
    texture = f"Str {decay.aspect:.2f}, lay at {round(angle) % 180} degrees"
    if edges.method == "seams":
        return "both", width, texture
    from_x = min(angle, 180 - angle)
    if decay.aspect < STRONG_LAY and from_x <= NEAR_AXIS:
        return "x", width, f"{texture}: joined along the lay only"
    if decay.aspect < STRONG_LAY and 90 - from_x <= NEAR_AXIS:
        return "y", width, f"{texture}: joined along the lay only"
    return "both", width, f"{texture}: no strong lay along an axis"


def _width(surface: Surface, correlation_length: float, edges: Edges) -> tuple[float, float]:
    """The default width along x and y, m, limited to the range that the pixels allow."""
    side = min(surface.size)
    usual = min(max(WIDTH * correlation_length, MIN_WIDTH_OF_SIDE * side), MAX_WIDTH_OF_SIDE * side)
    least, most = width_limits(edges.method)
    x, y = (
        max(min(usual, most(count) * step), least * step)
        for count, step in zip(surface.shape, surface.spacing, strict=True)
    )
    return x, y


def width_limits(method: Literal["seams", "blended"]) -> tuple[float, Callable[[int], float]]:
    """The smallest width of a joint, pixels, and the largest one by the number of pixels of the window."""
    return (blending.MIN_WIDTH, blending.largest_width) if method == "blended" else (0.0, seams.largest_width)
