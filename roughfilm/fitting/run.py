"""The fit of a description to the windows of a surface, and its judgement."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.fitting.fit import fit_random_field
from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.ranges import whole_in_range
from roughfilm.contact.preparation.recipe import Recipe
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import RandomField, make, read_description
from roughfilm.contact.windows.places import MAX_WINDOWS, independent_windows
from roughfilm.fitting.findings import Finding, findings_of, structure_of
from roughfilm.fitting.judge import Held, halves, held_out, seeds_of
from roughfilm.fitting.quantities import load_at_area, quantities_of, refuse_area
from roughfilm.rom.ladder.model import Progress
from roughfilm.sampling.plan import MIN_PIXELS, PIXEL_STEP, Group, Plan, planned, side_of_squares

COUNT = 48
"""Default number of windows."""

SEEDS = 200
"""Number of seeds by which a description is judged."""

AREA = 0.1
"""Default mean contact area fraction at which windows and seeds are compared."""

MIN_SEEDS, MAX_SEEDS = 40, 10_000
"""Smallest number of seeds, of which a 95 % interval is known, and largest one."""

MIN_COUNT = 16
"""Smallest number of windows: each half then has eight."""

SHOWN_SEEDS = 24
"""Number of seeds that are kept as surfaces."""

PREPARED = 0.05
"""Done fraction after the preparation of the windows."""


@dataclass(frozen=True, kw_only=True)
class Fit:
    """A description fitted to the windows of a surface.

    Attributes
    ----------
    name : name of the surface.
    description : the random field.
    plan : the windows, in its only group.
    area : mean contact area fraction of the comparison.
    load : mean pressure over E* at this area.
    windows, seeds : quantities of windows and seeds, shapes (n, 4) and (m, 4), see `quantities_of`.
    surfaces : the first seeds.
    held : held-out windows by the names of the quantities.
    findings : what the windows have, and what the description lacks.
    warnings : sentences.
    """

    name: str
    description: RandomField
    plan: Plan
    area: float
    load: float
    windows: Array
    seeds: Array
    surfaces: tuple[Surface, ...]
    held: Mapping[str, Held]
    findings: tuple[Finding, ...]
    warnings: tuple[str, ...]

    __repr__ = brief

    @property
    def group(self) -> Group:
        """The windows."""
        return self.plan.groups[0]

    def surface_of(self, seed: int) -> Surface:
        """The surface of a seed, 0 or more."""
        return make(self.description.model_copy(update={"seed": seed}))


def side_of_windows(surface: Surface, count: int) -> float:
    """The default side of the windows, m: squares that fit, of whole pixels as in `planned`, at least 32 of them."""
    side = side_of_squares(surface.size, count)
    whole = min(PIXEL_STEP * step * math.floor(side / (PIXEL_STEP * step) + 1e-9) for step in surface.spacing)
    return max(whole, min(MIN_PIXELS * max(surface.spacing), *surface.size))


def fit_windows(
    given: Surface | Path,
    recipe: Recipe,
    *,
    count: int = COUNT,
    size: float | None = None,
    area: float = AREA,
    seeds: int = SEEDS,
    name: str = "surface",
    progress: Progress,
) -> Fit:
    """Fit a random field to the windows of a measured surface, or to the seeds of a description, and judge it.

    Half of the windows are fitted and the other half is compared with the 95 % intervals of the seeds, then the other
    way round, so that every window is held out once. The description that is returned is fitted to all windows. Windows
    of a measurement count as independent unless they overlap, also along a lay: seeds stand for further windows of this
    measurement, not for those of other ones.

    Parameters
    ----------
    given : measured surface, or the TOML file of a description.
    recipe : recipe of the preparation of windows.
    count : number of windows, 16 or more.
    size : side of the windows, m; by default that of the largest squares of which ``count`` fit without overlap, but at
        least 32 pixels.
    area : mean contact area fraction at which windows and seeds are compared.
    seeds : number of seeds of each fit, 40 to 10 000.
    name : name for people.
    progress : called with the done fraction and a few words.

    Raises
    ------
    InputError
        If there are too few windows, or a size, the recipe or a window is out of range.
    ConvergenceError
        If no window has a contact or a flow.
    """
    count = whole_in_range("windows", count, MIN_COUNT, MAX_WINDOWS)
    seeds = whole_in_range("seeds", seeds, MIN_SEEDS, MAX_SEEDS)
    refuse_area(area)
    if size is None and isinstance(given, Surface):
        size = side_of_windows(given, count)
    elif size is None and isinstance(given, Path):
        size = min(read_description(given).size)
    plan = planned(
        given,
        recipe,
        count=count,
        size=size,
        sizes=[size] if size is not None else [],
        name=name,
        progress=lambda done, words: progress(PREPARED * done, words),
    )
    group = plan.groups[0]
    cells = group.cells
    total, done = 2 * len(cells) + 3 * seeds, 0

    def count_one(words: str) -> None:
        nonlocal done
        progress(PREPARED + (1 - PREPARED) * done / total, words)
        done += 1

    progress(PREPARED, "choosing the load")
    load = load_at_area(cells, area)
    windows = []
    for number, cell in enumerate(cells):
        count_one(f"contact and flow of window {number + 1} of {len(cells)}")
        windows.append(quantities_of(cell, load))
    measured = np.array(windows)
    if not np.isfinite(measured).any():
        raise ConvergenceError(f"{name}: no window has a contact; look at the surface")
    parts, worth = halves(len(cells), 0), independent_windows(group.windows) if group.windows else float(len(cells))
    held, _ = held_out(cells, measured, load, parts=parts, seeds=seeds, independent=worth, progress=count_one)
    description = fit_random_field(cells, worth)
    of_seeds = seeds_of(description, seeds, load, count_one)
    structure = structure_of(cells, load, count_one)
    findings = findings_of(group, measured, structure, plan.decay[0])
    return Fit(
        name=name,
        description=description,
        plan=plan,
        area=area,
        load=load,
        windows=measured,
        seeds=of_seeds,
        surfaces=tuple(make(description.model_copy(update={"seed": seed})) for seed in range(SHOWN_SEEDS)),
        held=held,
        findings=findings,
        warnings=tuple(_warnings(plan, held, findings)),
    )


def _warnings(plan: Plan, held: Mapping[str, Held], findings: tuple[Finding, ...]) -> list[str]:
    warnings = list(plan.warnings)
    if overlap(plan.groups[0]):
        warnings.append(
            "windows overlap, so that those held out share points with those fitted, and the judgement is too good; "
            "take fewer or smaller windows"
        )
    failing = [f"{name}: {held_in_words(one)}" for name, one in held.items() if one.fails]
    if failing:
        reasons = [one.text for one in findings if one.lacking or one.name in ("drift", "short")]
        why = (
            "; why: " + "; ".join(reasons)
            if reasons
            else "; tests of phases, grooves, scratches and drift found no reason"
        )
        warnings.append(f"seeds do not scatter as the windows do ({'; '.join(failing)}){why}")
    return warnings


def overlap(group: Group) -> bool:
    """Whether two windows share points."""
    starts = np.array([window.start for window in group.windows])
    if not len(starts):
        return False
    apart = np.abs(starts[:, None] - starts)
    shared = (apart < group.windows[0].shape).all(axis=2)
    return int(shared.sum()) > len(starts)


def held_in_words(one: Held) -> str:
    """How many held-out windows are inside, and where the others are."""
    outside = [f"{number} {where}" for number, where in ((one.below, "below"), (one.above, "above")) if number]
    return f"{one.inside} of {one.count} held-out windows inside" + (f", {' and '.join(outside)}" if outside else "")
