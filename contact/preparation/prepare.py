"""All steps of a recipe, taken in turn, and a record of what each did."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from contact.autocorrelation import autocorrelation, decay_lengths
from contact.errors import InputError
from contact.periodicity import THRESHOLD, periodicity_mismatch
from contact.preparation.edges import Direction, make_periodic
from contact.preparation.filling import fill_invalid
from contact.preparation.form import remove_form
from contact.preparation.grid import next_power_of_two, resample
from contact.preparation.outliers import cut_outliers
from contact.preparation.recipe import Edges, Grid, Recipe, Sampling, recipe_entries
from contact.preparation.smoothing import smooth
from contact.preparation.window import Window, best_window, cut_window
from contact.spectrum import power_spectrum, texture_direction
from contact.surface import Surface

WIDTH = 1 / 80
"""Standard deviation of the edges' filter over the shorter side, where the recipe does not tell it."""

STRONG_LAY = 0.3
"""Texture aspect ratio Str below which ISO 25178-3 calls a surface anisotropic."""

NEAR_AXIS = 30.0
"""Degrees between lay and axis within which the lay counts as lying along that axis."""

MANY_INVALID = 0.15
"""Part of invalid points above which what was filled in may decide the result."""


@dataclass(frozen=True, kw_only=True)
class Prepared:
    """A surface on its way from measurement to cell.

    Attributes
    ----------
    measured : form removed, nothing else; invalid points still marked.
    cell : filled, cut, in its window and on its grid; edges as they were measured.
    joined : with edges that meet.
    surface : smoothed too: the periodic cell.
    record : for each step what it found and changed, as entries that JSON can hold.
    warnings : sentences about what may make the cell a bad picture of the surface.
    """

    measured: Surface
    cell: Surface
    joined: Surface
    surface: Surface
    record: Mapping[str, Any]
    warnings: tuple[str, ...]


def prepare(surface: Surface, recipe: Recipe) -> Prepared:
    """Take every step of the recipe; the same surface and recipe give the same bytes.

    The prepared surface's ``source`` holds where it came from, the complete recipe and the record.

    Raises
    ------
    InputError
        If a step cannot be taken, or all heights are the same; one line that names the step.
    ConvergenceError
        If invalid points cannot be filled to tolerance.

    References
    ----------
    F. Sahlin, Lubrication, contact mechanics and leakage between rough surfaces, Luleå 2008, sections E.3.1 and F.3.
    """
    measured = remove_form(surface, recipe.form)
    _refuse_constant(measured, surface)
    filled, residual = fill_invalid(measured)
    cut, told = cut_outliers(filled, bins=recipe.outliers.bins, points=recipe.outliers.points)
    window = _window(cut, recipe.window)
    cell = resample(cut_window(cut, window), _points(window.shape, recipe.grid), recipe.grid.method)
    direction, width, reason = _edges(cell, recipe.edges)
    joined = make_periodic(cell, direction, width=width)
    smoothed = smooth(joined, recipe.smoothing)
    _refuse_constant(smoothed, surface)
    mismatch = periodicity_mismatch(smoothed)
    invalid = float(surface.invalid.mean())
    record = {
        "invalid": {"points": int(surface.invalid.sum()), "fraction": invalid, "residual": residual},
        "outliers": asdict(told),
        "window": {"start": list(window.start), "pixels": list(window.shape)},
        "grid": {"points": list(cell.shape), "spacing": list(cell.spacing)},
        "edges": {"direction": direction, "width": width, "reason": reason},
        "periodicity_mismatch": {"before": periodicity_mismatch(cell), "after": mismatch},
    }
    source = {**surface.source, "recipe": recipe_entries(recipe), "record": record}
    return Prepared(
        measured=measured,
        cell=cell,
        joined=joined,
        surface=smoothed.with_heights(smoothed.heights, source=source),
        record=record,
        warnings=tuple(_warnings(invalid, mismatch)),
    )


def _refuse_constant(surface: Surface, original: Surface) -> None:
    heights = surface.heights[surface.valid]
    if np.ptp(heights) <= 1e-12 * np.abs(original.heights).max():
        raise InputError("surface: all heights are the same once its form is removed; there is no roughness to prepare")


def _window(surface: Surface, sampling: Sampling | None) -> Window:
    if sampling is None:
        return Window(start=(0, 0), shape=surface.shape)
    pairs = list(zip(sampling.size, surface.spacing, strict=True))
    if sampling.start is None:
        nx, ny = (int(np.ceil(length / step - 1e-9)) for length, step in pairs)
        return best_window(surface, (nx, ny))
    nx, ny = (round(length / step) for length, step in pairs)
    i, j = (round(place / step) for place, step in zip(sampling.start, surface.spacing, strict=True))
    return Window(start=(i, j), shape=(nx, ny))


def _points(shape: tuple[int, int], grid: Grid) -> tuple[int, int]:
    match grid.points:
        case "kept":
            return shape
        case "powers of two":
            return next_power_of_two(shape[0]), next_power_of_two(shape[1])
        case points:
            return points


def _edges(surface: Surface, edges: Edges) -> tuple[Direction, float, str]:
    width = edges.width if edges.width is not None else max(WIDTH * min(surface.size), max(surface.spacing) / 2)
    if edges.direction != "auto":
        return edges.direction, width, "given"
    ratio = decay_lengths(autocorrelation(surface), surface.spacing).aspect
    angle = texture_direction(power_spectrum(surface))
    from_x = min(angle, 180 - angle)
    told = f"Str {ratio:.2f}, lay at {round(angle) % 180} degrees"
    if ratio < STRONG_LAY and from_x <= NEAR_AXIS:
        return "x", width, f"{told}: joined along the lay only"
    if ratio < STRONG_LAY and 90 - from_x <= NEAR_AXIS:
        return "y", width, f"{told}: joined along the lay only"
    return "both", width, f"{told}: no strong lay along an axis"


def _warnings(invalid: float, mismatch: float) -> list[str]:
    told = []
    if invalid > MANY_INVALID:
        told.append(f"{100 * invalid:.0f} % of the points were invalid and are filled in; measure again if you can")
    if mismatch > THRESHOLD:
        told.append(
            f"periodicity mismatch {mismatch:.2f}, above {THRESHOLD}: ridges or steps end at the joint, which "
            "throttles flow; choose another window (or let one be found: window.size without start)"
        )
    return told
