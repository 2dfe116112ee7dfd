"""The cases of a rough gap, run one after the other on one checked mesh, each believed only after it was checked."""

import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.iterate import Settled
from roughfilm.foamcases.openfoam.residuals import Judged, Residuals
from roughfilm.foamcases.openfoam.run import CaseRun, Checked, check_mesh, converge, ready, remarks
from roughfilm.foamcases.rough_gap.case import GapCard
from roughfilm.foamcases.rough_gap.dictionaries import MEAN_VELOCITY
from roughfilm.rom.ladder.model import Progress, silent

MAIN = {"Ux": 0, "Uy": 1}

TOLERATED = ("High aspect ratio cells", "highly skew faces")
"""Faults that the mesh check finds in flat cells and beside steep walls: they are told, and their error shrinks."""

WINDOW = 10
"""Iterations over which the change of the flow is looked at."""

LEAST = 1e-6
"""A mean velocity below this, over that of a smooth gap, is as good as none."""

SLOWEST = 0.98
"""By which steps are taken to shrink at least; those of round-off do not."""


SEALED = "contact seals the gap both ways on this mesh: nothing flows, and nothing was run"


@dataclass(frozen=True, kw_only=True)
class GapRun(CaseRun):
    """Successful runs of the flows through a gap.

    Attributes
    ----------
    flows : by the name of the drive.
    unsettled : likewise, by what part of itself the mean velocity would still change, by its trend.
    """

    flows: dict[str, Checked]
    unsettled: dict[str, float]


def run_gap(directory: Path, progress: Progress = silent) -> GapRun:
    """Check the mesh and run each drive; errors as :func:`roughfilm.foamcases.pocket.run.run_case` raises them."""
    card = read_card(directory, GapCard)
    version = ready(card.processes)
    wall = time.perf_counter()
    if not card.drives:
        return GapRun(flows={}, unsettled={}, cpu_s=0.0, wall_s=0.0, version=version, warnings=(SEALED,))
    mesh = check_mesh(
        directory / next(iter(card.drives)),
        tolerated=TOLERATED,
        remedy="take fewer layers, more columns or a larger mesh.smallest_gap",
    )
    flows: dict[str, Checked] = {}
    for number, (name, judged) in enumerate(card.drives.items()):

        def told(part: float, words: str, name: str = name, number: int = number) -> None:
            progress((number + part) / len(card.drives), f"{name}: {words}")

        flows[name] = converge(
            directory / name, card, judged, told, settled_within(card.tolerance, directory / name, judged)
        )
    return GapRun(
        flows=flows,
        unsettled={name: unsettled(mean_velocity(directory / name)[:, MAIN[card.drives[name].main]]) for name in flows},
        cpu_s=mesh.cpu_s + sum(flow.cpu_s for flow in flows.values()),
        wall_s=time.perf_counter() - wall,
        version=version,
        warnings=remarks(mesh),
    )


def settled_within(tolerance: float, case: Path, judged: Judged) -> Settled:
    """Whether the residuals of a running case are within the slack, and its mean velocity will change by so little."""

    def settled(residuals: Residuals) -> bool:
        if len(residuals.greatest) < 2 * WINDOW or not residuals.greatest[-1] <= judged.slack * tolerance:
            return False
        return unsettled(mean_velocity(case)[:, MAIN[judged.main]]) <= tolerance

    return settled


def mean_velocity(case: Path) -> Array:
    """Mean velocity of all cells in each iteration, shape (iterations, 3); the last is that which verified the run."""
    folders = sorted((case / "postProcessing" / MEAN_VELOCITY).iterdir(), key=lambda folder: float(folder.name))
    lines = [
        line
        for folder in folders
        for line in (folder / "volFieldValue.dat").read_text(encoding="ascii").splitlines(keepends=True)
        if not line.startswith("#") and line.endswith("\n")
    ]
    return np.array([[float(word.strip("()")) for word in line.split()[1:]] for line in lines]).reshape(-1, 3)


def unsettled(values: Array) -> float:
    """By what part of its last value a series would still change if its steps went on shrinking as they do.

    With d the largest of the last ``WINDOW`` steps and d' that of those before, what would come is d r/(1 - r) with
    r = (d/d')^(1/``WINDOW``), at most ``SLOWEST``. (Of fewer steps, the halves.)
    """
    steps = np.abs(np.diff(values))
    window = min(WINDOW, steps.size // 2)
    if not window:
        return 0.0
    last, before = steps[-window:].max(), steps[-2 * window : -window].max()
    rate = min((last / before) ** (1 / window) if before > 0 else 1.0, SLOWEST)
    return float(last * rate / (1 - rate) / max(abs(values[-1]), LEAST)) if last > 0 else 0.0
