"""Windows of measured surfaces, half of them fitted and the other half held out, in random and in spatial halves."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.preparation.prepare import level
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.files import file_digest, read_surface
from roughfilm.contact.windows.places import independent_windows
from roughfilm.fitting.findings import findings_of, structure_of
from roughfilm.fitting.judge import halves, held_out
from roughfilm.fitting.quantities import NAMES, load_at_area, quantities_of
from roughfilm.fitting.run import side_of_windows
from roughfilm.rom.ladder.provenance import imported_code
from roughfilm.sampling.plan import Group, planned
from scripts.studies.study import kept
from scripts.studies.thesis_clipping import clipped

SURFACES: Mapping[str, Mapping[str, Any]] = {
    "milled_NT1100.opd": {},
    "oblique_grooves.x3p": {},
    "periodic_grooves.plu": {},
    "ground_striated.x3p": {},
    "isotropic.al3d": {},
    "polished.opd": {},
    "polished_with_spikes.sur": {},
    "stitching_artefacts.txt": {"spacing": (240.4e-6 / 650, 240.4e-6 / 650), "height_unit": "m"},
}
"""The files, with what they do not hold."""

BAD = ("polished_with_spikes.sur", "stitching_artefacts.txt")
"""Measurements with artefacts."""

WINDOWS, POINTS, SEEDS = 48, 64, 100
"""Number of windows of a measurement, points along a side of each cell, and seeds of each fit."""

AREAS = (0.1, 0.05)
"""Mean contact area fractions."""

RANDOM_HALVES = 2
"""Number of random halves; the spatial ones are by x and by y."""

MODULES = ("roughfilm.fitting.judge", "roughfilm.fitting.findings", "roughfilm.sampling.plan")
"""Modules whose code determines the numbers."""


@dataclass(frozen=True, kw_only=True)
class Coverage:
    """Held-out windows of one surface within the 95 % intervals of the seeds.

    Attributes
    ----------
    surface, quantity : names.
    area : mean contact area fraction.
    halves : "random" or "spatial".
    inside, count, below, above : numbers of held-out windows, over all halves.
    ratio : median of the windows over that of the seeds, mean over the halves; NaN if it is unknown.
    """

    surface: str
    quantity: str
    area: float
    halves: str
    inside: int
    count: int
    below: int
    above: int
    ratio: float

    @property
    def fraction(self) -> float:
        """The fraction inside."""
        return self.inside / self.count


@dataclass(frozen=True, kw_only=True)
class Examined:
    """One surface at one contact area."""

    surface: str
    area: float
    independent: float
    sealed: tuple[float, float]
    coverages: tuple[Coverage, ...]
    findings: tuple[str, ...]


def present(surfaces: Path | None) -> list[str]:
    """Return the names of the surfaces that a directory holds."""
    return [name for name in SURFACES if surfaces is not None and (surfaces / name).is_file()]


def examined(file: Path, area: float, keep: Path | None, advance: Callable[[str], None]) -> Examined:
    """Return the held-out coverage of one surface, from the file of the last run if it was made by the same code."""
    inputs = {
        "file": file_digest(file),
        "area": area,
        "numbers": [WINDOWS, POINTS, SEEDS, RANDOM_HALVES],
        "modules": imported_code(*MODULES),
    }
    path = None if keep is None else keep / f"{file.stem}_{100 * area:g}.json"
    found = kept(path, inputs, lambda: _examine(file, area, advance))
    return Examined(
        surface=found["surface"],
        area=found["area"],
        independent=found["independent"],
        sealed=tuple(found["sealed"]),
        coverages=tuple(
            Coverage(**{**one, "ratio": np.nan if one["ratio"] is None else one["ratio"]}) for one in found["coverages"]
        ),
        findings=tuple(found["findings"]),
    )


def _examine(file: Path, area: float, advance: Callable[[str], None]) -> Examined:
    surface = read_surface(file, **SURFACES[file.name])
    side = side_of_windows(surface, WINDOWS)
    grid = {"grid": {"points": [POINTS, POINTS]}}
    plan = planned(
        clipped(level(surface, read_recipe(grid)).trusted),
        read_recipe({**grid, "form": "none", "outliers": {"limit": 0}}),
        count=WINDOWS,
        size=side,
        sizes=[side],
        name=file.name,
        progress=lambda _, words: advance(words),
    )
    group = plan.groups[0]
    load = load_at_area(group.cells, area)
    windows = np.array([quantities_of(cell, load) for cell in group.cells])
    coverages = []
    for kind, parts in (("random", random_halves(len(windows))), ("spatial", spatial_halves(group))):
        found = [
            held_out(
                group.cells,
                windows,
                load,
                parts=part,
                seeds=SEEDS,
                independent=independent_windows(group.windows),
                progress=partial(_advance, advance, f"{file.name}, {kind} halves"),
            )[0]
            for part in parts
        ]
        for name in NAMES:
            own = [one[name] for one in found]
            coverages.append(
                Coverage(
                    surface=file.name,
                    quantity=name,
                    area=area,
                    halves=kind,
                    inside=sum(one.inside for one in own),
                    count=sum(one.count for one in own),
                    below=sum(one.below for one in own),
                    above=sum(one.above for one in own),
                    ratio=float(np.mean([one.ratio for one in own])),
                )
            )
    structure = structure_of(group.cells, load, partial(_advance, advance, file.name))
    return Examined(
        surface=file.name,
        area=area,
        independent=group.independent,
        sealed=(float((windows[:, 2] == 0).mean()), float((windows[:, 3] == 0).mean())),
        coverages=tuple(coverages),
        findings=tuple(one.text for one in findings_of(group, windows, structure)),
    )


def _advance(advance: Callable[[str], None], name: str, words: str) -> None:
    advance(f"{name}: {words}")


Halves = tuple[NDArray[np.intp], NDArray[np.intp]]


def random_halves(count: int) -> Sequence[Halves]:
    """Return random halves of the windows."""
    return [halves(count, seed) for seed in range(RANDOM_HALVES)]


def spatial_halves(group: Group) -> Sequence[Halves]:
    """Return the halves of the measurement by x and by y."""
    found = []
    for axis in (0, 1):
        order = np.argsort([window.start[axis] for window in group.windows], kind="stable")
        found.append((np.sort(order[: len(order) // 2]), np.sort(order[len(order) // 2 :])))
    return found
