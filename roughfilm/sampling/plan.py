"""The windows to examine: places on a measurement, or seeds of a description, of several sizes."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import in_range, whole_in_range
from roughfilm.contact.foundation.units import with_unit
from roughfilm.contact.parameters.autocorrelation import autocorrelation, decay_lengths
from roughfilm.contact.preparation.prepare import MAX_INVALID_FRACTION, Levelled, Prepared, cell_of, level
from roughfilm.contact.preparation.recipe import Recipe, recipe_entries
from roughfilm.contact.preparation.window import Window
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import (
    Description,
    description_entries,
    make,
    read_description,
    read_entries,
)
from roughfilm.contact.windows.places import MAX_WINDOWS, independent_windows, valid_places, window_places
from roughfilm.rom.ladder.model import Progress
from roughfilm.sampling.warnings import counted

COUNT = 16
"""Default number of windows of each size."""

PIXEL_STEP = 8
"""The pixels along a side of a window are a multiple of this, so that coarser grids estimate its numerical error."""

MIN_PIXELS = 32
"""Smallest number of pixels along a side of a window."""

SIZE_RATIOS = (2, 4)
"""Ratios of the size of the largest windows to the default further sizes."""

DECAY_LENGTHS = 5.0
"""Side of a window over the decay length Sal below which a warning is given."""

MAX_FILLED, FILLED_OVER_MEAN = 0.25, 1.25
"""Fraction of invalid points above which a place is not taken, and the same over that of the measurement, if larger."""

SEEDS_APART = 100_000
"""Difference of the first seeds of two sizes."""


@dataclass(frozen=True, kw_only=True)
class Group:
    """The windows of one size.

    Attributes
    ----------
    size : shorter side, m.
    cells : periodic cells.
    windows : their places; empty for seeds.
    seeds : their seeds; empty for places.
    independent : effective number of independent windows.
    rms_height : mean Sq of the windows before their edges are joined, m.
    """

    size: float
    cells: tuple[Surface, ...]
    windows: tuple[Window, ...] = ()
    seeds: tuple[int, ...] = ()
    independent: float
    rms_height: float


@dataclass(frozen=True, kw_only=True)
class Plan:
    """All windows of one surface.

    Attributes
    ----------
    name : name of the file.
    groups : windows by size, the largest first.
    source : origin of the surface, and the recipe or description, as entries that JSON can hold.
    surface : the levelled measurement; None for a description.
    decay : shortest and longest decay length of its autocorrelation, m; those of the first cell for a description.
    warnings : sentences about the windows.
    """

    name: str
    groups: tuple[Group, ...]
    source: Mapping[str, Any]
    surface: Surface | None
    decay: tuple[float, float]
    warnings: tuple[str, ...]


def planned(
    given: Surface | Path,
    recipe: Recipe,
    *,
    count: int,
    size: float | None,
    sizes: Sequence[float] | None,
    name: str,
    progress: Progress,
) -> Plan:
    """Choose the windows of a measured surface or of a described one, and prepare their cells.

    Parameters
    ----------
    given : measured surface, or the TOML file of a description.
    recipe : recipe of the preparation; not used for a description, whose cells are periodic.
    count : number of windows of each size.
    size : side of the largest windows, m; by default five decay lengths Sal or, if it is more, the side of the largest
        squares of which ``count`` fit, up to half of the measurement; for a description its size.
    sizes : further sides, m; empty for windows of one size, None for a half and a quarter of ``size``.
    name : name for people.
    progress : called with the done fraction and a few words.

    Raises
    ------
    InputError
        If a size, the count or the recipe is out of range, or a window cannot be prepared.
    """
    count = whole_in_range("windows", count, 1, MAX_WINDOWS)
    size = None if size is None else in_range("size", size, "m")
    if isinstance(sizes, str) or not isinstance(sizes, Iterable | None):
        raise InputError(f"sizes: got {sizes!r:.60}; give a list of lengths in m, or an empty one for a single size")
    sizes = None if sizes is None else [in_range("sizes", one, "m") for one in sizes]
    if isinstance(given, Path):
        return _of_description(read_description(given), count, size, sizes, name, progress)
    return _of_measurement(given, recipe, count, size, sizes, name, progress)


def _of_measurement(
    surface: Surface,
    recipe: Recipe,
    count: int,
    size: float | None,
    sizes: Sequence[float] | None,
    name: str,
    progress: Progress,
) -> Plan:
    if recipe.window is not None:
        raise InputError("recipe: window: is set; the windows are chosen here, leave it out and give --size")
    if "points" not in recipe.grid.model_fields_set:
        recipe = recipe.model_copy(update={"grid": recipe.grid.model_copy(update={"points": "kept"})})
    progress(0.0, "levelling the measurement")
    levelled = level(surface, recipe)
    filled = levelled.filled
    found = decay_lengths(autocorrelation(filled), filled.spacing)
    largest = _largest(surface, count, found.shortest) if size is None else size
    shapes, warnings = _shapes(surface, largest, sizes)
    recipe = _with_one_edge(levelled, recipe, shapes[-1])
    groups: list[Group] = []
    done = 0
    for shape in shapes:
        places, left_out = _with_valid_points(levelled, window_places(surface.shape, shape, count))
        warnings += left_out
        cells, of_cells = [], []
        for window in places:
            progress(done / (count * len(shapes)), f"preparing window {done + 1} of {count * len(shapes)}")
            prepared = _prepared(levelled, recipe, window)
            cells.append(prepared.surface)
            of_cells.append(prepared.warnings[len(levelled.warnings) :])
            done += 1
        if not groups:
            warnings += counted(of_cells)
        groups.append(
            Group(
                size=min(n * step for n, step in zip(shape, surface.spacing, strict=True)),
                cells=tuple(cells),
                windows=places,
                independent=independent_windows(places, filled),
                rms_height=float(np.mean([filled.heights[window.slices].std() for window in places])),
            )
        )
    return Plan(
        name=name,
        groups=tuple(groups),
        source={"prepared_from": dict(surface.source), "recipe": recipe_entries(recipe)},
        surface=filled,
        decay=(found.shortest, found.longest),
        warnings=(*levelled.warnings, *warnings),
    )


def _with_valid_points(levelled: Levelled, places: Sequence[Window]) -> tuple[tuple[Window, ...], list[str]]:
    """The places that have enough valid points, with others for those that have not, and a sentence on their numbers.

    Raises InputError if no place has enough.
    """
    invalid = levelled.trusted.invalid
    most = min(max(MAX_FILLED, FILLED_OVER_MEAN * float(invalid.mean())), MAX_INVALID_FRACTION)
    found = valid_places(places, invalid, most)
    nx, ny = places[0].shape
    many = f"for windows of {nx} x {ny} pixels have more than {100 * most:.0f} % invalid points"
    if not found:
        raise InputError(f"windows: all places {many}; take smaller windows or measure again")
    bad = sum(window not in found for window in places)
    if not bad:
        return found, []
    others, fewer = len(found) - len(places) + bad, len(places) - len(found)
    ends = ([f"{others} taken elsewhere"] if others else []) + ([f"{fewer} left out"] if fewer else [])
    return found, [f"{bad} of {len(places)} places {many}: {', '.join(ends)}"]


def _with_one_edge(levelled: Levelled, recipe: Recipe, smallest: tuple[int, int]) -> Recipe:
    """The recipe with one direction and one width of blended edges for all windows: the width of the smallest window.

    A blended margin lowers the rms height. With a width in proportion to the window it would be the same part of any
    window, and its effect would not vanish on the whole surface. Seams keep the rms height, at any width.
    """
    if recipe.edges.method != "blended":
        return recipe
    whole, small = (
        cell_of(levelled, recipe, Window(start=(0, 0), shape=shape)).record["edges"]
        for shape in (levelled.original.shape, smallest)
    )
    width = recipe.edges.width or min(small["width"])
    edges = recipe.edges.model_copy(update={"direction": whole["direction"], "width": width})
    return recipe.model_copy(update={"edges": edges})


def _prepared(levelled: Levelled, recipe: Recipe, window: Window) -> Prepared:
    try:
        return cell_of(levelled, recipe, window)
    except InputError as error:
        (i, j), (nx, ny) = window.start, window.shape
        raise InputError(f"window of {nx} x {ny} pixels at pixel {i}, {j}: {error}") from None


def side_of_squares(size: tuple[float, float], count: int) -> float:
    """The side of the largest squares of which ``count`` fit into a rectangle in rows and columns, m."""
    low, high = 0.0, min(size)
    for _ in range(60):
        side = 0.5 * (low + high)
        low, high = (side, high) if (size[0] // side) * (size[1] // side) >= count else (low, side)
    return low


def _largest(surface: Surface, count: int, sal: float) -> float:
    """The default side of the largest windows, m: five decay lengths, or more if ``count`` such squares fit.

    It is at most half of the shorter side of the measurement, so that four windows fit without overlap.
    """
    side = side_of_squares(surface.size, count)
    least = MIN_PIXELS * max(surface.spacing)
    return max(min(max(side, DECAY_LENGTHS * sal), 0.5 * min(surface.size)), min(least, *surface.size))


def _shapes(surface: Surface, largest: float, sizes: Sequence[float] | None) -> tuple[list[tuple[int, int]], list[str]]:
    """The numbers of pixels of the windows of each size, the largest first, and warnings about sizes left out."""
    side = min(surface.size)
    if largest > side * (1 + 1e-9):
        raise InputError(f"size: got {_micro(largest)}; the measurement is {_micro(side)} wide, take less")
    wanted = [largest, *([largest / ratio for ratio in SIZE_RATIOS] if sizes is None else sizes)]
    shapes: list[tuple[int, int]] = []
    warnings = []
    for length in sorted(set(wanted), reverse=True):
        nx, ny = (
            min(PIXEL_STEP * round(length / step / PIXEL_STEP), most // PIXEL_STEP * PIXEL_STEP)
            for step, most in zip(surface.spacing, surface.shape, strict=True)
        )
        if length > side * (1 + 1e-9):
            raise InputError(f"sizes: got {_micro(length)}; the measurement is {_micro(side)} wide, take less")
        if min(nx, ny) < MIN_PIXELS:
            if length == largest or sizes:
                raise InputError(
                    f"size: got {_micro(length)}, which is {min(nx, ny)} pixels; a window has at least {MIN_PIXELS} "
                    "along each side"
                )
            warnings.append(f"windows of {_micro(length)} are left out: fewer than {MIN_PIXELS} pixels along a side")
        elif (nx, ny) not in shapes:
            shapes.append((nx, ny))
    return shapes, warnings


def _of_description(
    description: Description,
    count: int,
    size: float | None,
    sizes: Sequence[float] | None,
    name: str,
    progress: Progress,
) -> Plan:
    entries = description_entries(description)
    if "seed" not in entries:
        raise InputError(f"{name}: kind: got {entries['kind']!r}, which has no seed; all its windows are the same")
    shorter = min(description.size)
    largest = shorter if size is None else size
    wanted = sorted({largest, *([largest / ratio for ratio in SIZE_RATIOS] if sizes is None else sizes)}, reverse=True)
    points = [_points(description, length / shorter) for length in wanted]
    warnings = []
    groups: list[Group] = []
    done = 0
    for number, (length, shape) in enumerate(zip(wanted, points, strict=True)):
        if min(shape) < MIN_PIXELS:
            if length == largest or sizes:
                raise InputError(f"size: got {_micro(length)}, which is {min(shape)} points; give {MIN_PIXELS} or more")
            warnings.append(f"surfaces of {_micro(length)} are left out: fewer than {MIN_PIXELS} points along a side")
            continue
        seeds = [entries["seed"] + SEEDS_APART * number + one for one in range(count)]
        cells = []
        try:
            for seed in seeds:
                progress(done / (count * len(wanted)), f"making surface {done + 1} of {count * len(wanted)}")
                cells.append(make(read_entries(_resized(entries, description, shape, seed))))
                done += 1
        except InputError as error:
            if length == largest or sizes:
                raise InputError(f"{name}, at a size of {_micro(length)}: {error}") from None
            warnings.append(f"surfaces of {_micro(length)} are left out: {error}")
            continue
        groups.append(
            Group(
                size=min(cells[0].size),
                cells=tuple(cells),
                seeds=tuple(seeds),
                independent=float(count),
                rms_height=float(np.mean([cell.heights.std() for cell in cells])),
            )
        )
    if entries.get("amplitudes") == "fixed":
        warnings.append(
            'amplitudes = "fixed" gives every seed the same spectrum, so that seeds scatter less than windows of one '
            'surface do; "random" lets them scatter as windows'
        )
    if entries["kind"] == "random_field" and any(group.cells[0].shape != description.points for group in groups):
        warnings.append(
            "a random_field scatters at any size as the windows to which it was fitted, not as windows of that size; "
            "leave --size out and give --sizes none"
        )
    first = groups[0].cells[0]
    found = decay_lengths(autocorrelation(first), first.spacing)
    return Plan(
        name=name,
        groups=tuple(groups),
        source={"description": entries},
        surface=None,
        decay=(found.shortest, found.longest),
        warnings=tuple(warnings),
    )


def _points(description: Description, ratio: float) -> tuple[int, int]:
    nx, ny = (PIXEL_STEP * max(round(n * ratio / PIXEL_STEP), 1) for n in description.points)
    return (nx, ny) if ratio != 1 else description.points


def _resized(entries: Mapping[str, Any], description: Description, shape: tuple[int, int], seed: int) -> dict[str, Any]:
    """The entries of a description with another number of points of the same spacing, and another seed."""
    lengths = [
        with_unit(length * n / points, "m")
        for length, n, points in zip(description.size, shape, description.points, strict=True)
    ]
    changed = {"seed": seed, "points": list(shape)}
    return {**entries, **changed, **({} if shape == tuple(description.points) else {"size": lengths})}


def _micro(length: float) -> str:
    return f"{1e6 * length:.4g} µm"
