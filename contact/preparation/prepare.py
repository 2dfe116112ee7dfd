"""Preparation of a measured surface: all steps of a recipe in order, with a record of each step."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Mask
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.change import PreparationChange, change, smoothing_warnings
from roughfilm.contact.preparation.edges.join import join_edges
from roughfilm.contact.preparation.edges.joined import Joined, seam_pixels
from roughfilm.contact.preparation.filling import fill_invalid
from roughfilm.contact.preparation.filters import l_filter, nesting_warnings, s_filter
from roughfilm.contact.preparation.form import remove_form
from roughfilm.contact.preparation.grid import next_power_of_two, resample
from roughfilm.contact.preparation.outliers import Cut, cut_outliers
from roughfilm.contact.preparation.recipe import Grid, Recipe, Sampling, recipe_entries
from roughfilm.contact.preparation.removal import removal_warnings
from roughfilm.contact.preparation.smoothing import smooth
from roughfilm.contact.preparation.spikes import Spikes, find_spikes
from roughfilm.contact.preparation.window import Window, best_window, cut_window
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, periodicity_mismatch
from roughfilm.contact.surfaces.plausibility import implausible, repeated_extreme
from roughfilm.contact.surfaces.surface import MAX_POINTS, Surface

MAX_WINDOW_PIXELS = 1e9
"""Bound on size and start of a window, pixels, larger than any surface; it prevents overflow."""

INVALID_WARNING_FRACTION = 0.15
"""Fraction of filled points in the window above which a warning is given."""

MAX_INVALID_FRACTION = 0.9
"""Fraction of invalid points above which a measurement is refused."""

CUT_WARNING_FRACTION = 0.01
"""Fraction of clipped points above which a warning is given."""

MAX_FITS = 5
"""Largest number of fits of the form, each without the spikes that the fit before showed."""

FORM_TOLERANCE = 0.05
"""Change of the form, in rms heights, up to which the spikes are not sought again."""


@dataclass(frozen=True, kw_only=True)
class Prepared:
    """A prepared surface with its intermediate states.

    Attributes
    ----------
    measured : after removal of the form, with invalid points, spikes and rims; with an S- or L-filter the surface after
        clipping and these filters, without spikes and rims.
    filled : ``measured`` after clipping, with invalid points, spikes and rims filled.
    cell : ``filled`` cut to its window and resampled; edges as measured.
    joined : ``cell`` with joined edges.
    joint : where opposite edges meet and which points were blended, on the pixels of the measurement or of ``cell``.
    surface : ``joined`` after smoothing: the periodic cell.
    record : data and changes of each step, as entries that JSON can hold.
    warnings : reasons why the cell may misrepresent the surface, one sentence each.
    """

    measured: Surface
    filled: Surface
    cell: Surface
    joined: Surface
    joint: Joined
    surface: Surface
    record: Mapping[str, Any]
    warnings: tuple[str, ...]


def prepare(surface: Surface, recipe: Recipe) -> Prepared:
    """Prepare a surface by all steps of a recipe; equal surfaces and recipes give equal bytes.

    Returns
    -------
    Prepared : the ``source`` of its surface holds the given source, the complete recipe and the record.

    Raises
    ------
    InputError
        If a step fails, or all heights are equal; the message names the step.
    ConvergenceError
        If the filling of invalid points does not converge.

    References
    ----------
    F. Sahlin, Lubrication, contact mechanics and leakage between rough surfaces, Luleå 2008, sections E.3.1 and F.3.
    """
    return cell_of(level(surface, recipe), recipe)


@dataclass(frozen=True, kw_only=True)
class Levelled:
    """A measured surface after the steps that come before its window is cut.

    Attributes
    ----------
    original : the surface as it was read.
    measured : after removal of the form, with invalid points, spikes and rims; with an S- or L-filter as ``trusted``.
    trusted : ``measured`` after clipping, with spikes and rims marked as invalid too, then the S- and the L-filter.
    filled : ``trusted`` with invalid points filled.
    record : data and changes of each step, as entries that JSON can hold.
    warnings : sentences on units that may be wrong, on nesting indices that pixels or sides do not support, and on many
        outliers.
    """

    original: Surface
    measured: Surface
    trusted: Surface
    filled: Surface
    record: Mapping[str, Any]
    warnings: tuple[str, ...]


def level(surface: Surface, recipe: Recipe) -> Levelled:
    """Prepare a surface by the steps before its window is cut, which many windows share; raises as `prepare`."""
    invalid = float(surface.invalid.mean())
    if invalid > MAX_INVALID_FRACTION:
        raise InputError(f"invalid points: they are {100 * invalid:.0f} % of all; measure again")
    measured, spikes = _without_form(surface, recipe)
    _refuse_constant(measured, surface)
    unfiltered = measured
    kept = measured.with_heights(measured.heights, invalid=measured.invalid | spikes.points)
    trusted, cut = cut_outliers(kept, recipe.outliers.quantile)
    if recipe.s_filter is not None or recipe.l_filter is not None:
        measured = trusted = _scale_limited(trusted, recipe)
        _refuse_constant(trusted, surface)
    filled, residual = fill_invalid(trusted)
    doubts = (*removal_warnings(unfiltered, spikes), *_clipping_warnings(cut, surface.heights.size))
    record = {
        "invalid": {
            "points": int(surface.invalid.sum()),
            "measured": surface.heights.size,
            "fraction": invalid,
            "residual": residual,
        },
        "outliers": {
            "spikes": int(spikes.spikes.sum()),
            "rims": int(spikes.rims.sum()),
            **asdict(cut),
            "doubts": list(doubts),
        },
        "filled": {"points": int(trusted.invalid.sum()), "fraction": float(trusted.invalid.mean())},
        "scale": {"form": recipe.form, "s_filter": recipe.s_filter, "l_filter": recipe.l_filter},
    }
    return Levelled(
        original=surface,
        measured=measured,
        trusted=trusted,
        filled=filled,
        record=record,
        warnings=(
            *repeated_extreme(surface),
            *implausible(trusted),
            *nesting_warnings(surface, recipe.s_filter, recipe.l_filter),
            *doubts,
        ),
    )


def cell_of(levelled: Levelled, recipe: Recipe, window: Window | None = None) -> Prepared:
    """Prepare the periodic cell of a levelled surface by the steps from the window on; raises as `prepare`.

    Parameters
    ----------
    levelled : the surface after the steps before.
    recipe : the recipe.
    window : the window, in place of that of the recipe.
    """
    surface, filled, guessed = levelled.original, levelled.filled, levelled.trusted.invalid
    if window is None:
        window = _window(filled, recipe.window, guessed)
    cut_window(filled, window)  # refuses a window that is not inside the surface
    asked = window
    in_window = float(guessed[window.slices].mean())
    if in_window > MAX_INVALID_FRACTION:
        raise InputError(f"window: {100 * in_window:.0f} % of its points are invalid; choose another window")
    cell, joint, window, edges = join_edges(
        filled,
        window,
        recipe.edges,
        lambda part: resample(part, _points(part.shape, recipe.grid), recipe.grid.method),
        filled=guessed,
    )
    smoothed = smooth(joint.surface, recipe.smoothing)
    _refuse_constant(smoothed, surface)
    mismatch = periodicity_mismatch(smoothed, seam_pixels(joint.seams, smoothed))
    record = {
        **levelled.record,
        "filled": {**levelled.record["filled"], "in_window": in_window},
        "window": {"start": list(window.start), "pixels": list(window.shape)},
        "grid": {"points": list(cell.shape), "spacing": list(cell.spacing)},
        "edges": edges,
        "periodicity_mismatch": {"before": periodicity_mismatch(cell), "after": mismatch},
        "change": asdict(_change(levelled, recipe, asked, window, joint, smoothed)),
    }
    warnings = (*_cell_warnings(record), *smoothing_warnings(joint.surface, smoothed, recipe.smoothing))
    source = {"prepared_from": dict(surface.source), "recipe": recipe_entries(recipe), "record": record}
    return Prepared(
        measured=levelled.measured,
        filled=filled,
        cell=cell,
        joined=joint.surface,
        joint=joint,
        surface=smoothed.with_heights(smoothed.heights, source=source),
        record=record,
        warnings=(*levelled.warnings, *warnings),
    )


def _change(
    levelled: Levelled, recipe: Recipe, asked: Window, window: Window, joint: Joined, smoothed: Surface
) -> PreparationChange:
    """The change of the window that was asked for to the cell, which may cover a smaller one."""
    guessed = levelled.trusted.invalid
    kept = float((~guessed[window.slices]).sum()) / math.prod(asked.shape)
    measured = Surface(
        heights=levelled.measured.heights[asked.slices],
        spacing=levelled.measured.spacing,
        invalid=guessed[asked.slices],
        periodic=levelled.original.periodic and asked.shape == guessed.shape,
    )
    return change(measured, smoothed, kept=kept * (1 - joint.mean_weight), form=recipe.form)


def _without_form(surface: Surface, recipe: Recipe) -> tuple[Surface, Spikes]:
    """The surface without its form, which is fitted without spikes and rims, and their masks."""
    measured = remove_form(surface, recipe.form)
    spikes = find_spikes(measured, limit=recipe.outliers.limit)
    for _ in range(MAX_FITS - 1):
        if recipe.form == "none" or not spikes.points.any():
            break
        before, measured = measured, remove_form(surface, recipe.form, ignored=spikes.points)
        roughness = measured.heights[measured.valid & ~spikes.points].std()
        if np.abs(measured.heights - before.heights).max() <= FORM_TOLERANCE * roughness:
            break
        spikes = find_spikes(measured, limit=recipe.outliers.limit)
    return measured, spikes


def _scale_limited(surface: Surface, recipe: Recipe) -> Surface:
    """The surface after the S- and the L-filter of the recipe."""
    if recipe.s_filter is not None:
        surface = s_filter(surface, recipe.s_filter)
    return surface if recipe.l_filter is None else l_filter(surface, recipe.l_filter)


def _refuse_constant(surface: Surface, original: Surface) -> None:
    heights = surface.heights[surface.valid]
    if np.ptp(heights) <= 1e-12 * np.abs(original.heights).max():
        raise InputError("surface: all heights are the same once its form is removed; there is no roughness to prepare")


def _window(surface: Surface, sampling: Sampling | None, guessed: Mask) -> Window:
    if sampling is None:
        return Window(start=(0, 0), shape=surface.shape)
    sizes, places = (
        [min(abs(length) / step, MAX_WINDOW_PIXELS) for length, step in zip(lengths, surface.spacing, strict=True)]
        for lengths in (sampling.size, sampling.start or (0.0, 0.0))
    )
    if sampling.start is None:
        nx, ny = (math.ceil(size - 1e-9) for size in sizes)
        return best_window(surface, (nx, ny), guessed)
    i, j = (round(math.copysign(place, start)) for place, start in zip(places, sampling.start, strict=True))
    nx, ny = (round(size) for size in sizes)
    return Window(start=(i, j), shape=(nx, ny))


def _points(shape: tuple[int, int], grid: Grid) -> tuple[int, int]:
    match grid.points:
        case "kept":
            return shape
        case "powers of two":
            nx, ny = next_power_of_two(shape[0]), next_power_of_two(shape[1])
        case points:
            nx, ny = points
    if nx * ny > MAX_POINTS:
        raise InputError(f"grid: got {nx} x {ny} points; at most {MAX_POINTS} are made; set fewer in grid.points")
    return nx, ny


def _clipping_warnings(cut: Cut, points: int) -> tuple[str, ...]:
    """The warning about many clipped points."""
    fraction = (cut.above + cut.below) / points
    if fraction <= CUT_WARNING_FRACTION:
        return ()
    return (
        f"{100 * fraction:.2g} % of the points were clipped, which removes summits that carry load; take a smaller "
        "outliers.quantile, or 0 to clip none",
    )


def _cell_warnings(record: Mapping[str, Any]) -> list[str]:
    """The warnings about filled points in the window and the joint of the cell."""
    warnings = []
    filled, mismatch = record["filled"]["in_window"], record["periodicity_mismatch"]["after"]
    if filled > INVALID_WARNING_FRACTION:
        warnings.append(f"{100 * filled:.0f} % of the points were invalid and are filled in; measure again if you can")
    if mismatch > MISMATCH_THRESHOLD:
        warnings.append(
            f"periodicity mismatch {mismatch:.2f}, above {MISMATCH_THRESHOLD}: ridges or steps end at the joint, which "
            "throttles flow; take another or a larger window, or a larger edges.width"
        )
    return warnings
