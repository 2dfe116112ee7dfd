"""Run the cases of a rough gap one after the other on one checked mesh, and verify the fields of each."""

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
"""Component of the mean velocity that belongs to each main velocity."""

TOLERATED = ("High aspect ratio cells", "highly skew faces")
"""Faults of flat cells and of cells beside steep walls, which are warnings: their error falls with cell size."""

WINDOW = 10
"""Number of iterations over which the change of the flow is measured."""

MIN_VELOCITY = 1e-6
"""Least mean velocity, over that of a smooth gap, to which the change of a flow is compared."""

MAX_STEP_RATIO = 0.98
"""Largest ratio of successive steps in the extrapolation, which stays finite where steps of round-off do not shrink."""


SEALED = "contact seals the gap both ways on this mesh: nothing flows, and nothing was run"
"""The warning for a gap without cases."""


@dataclass(frozen=True, kw_only=True)
class GapRun(CaseRun):
    """Successful runs of the flows through a gap.

    Attributes
    ----------
    flows : the run of each drive, by its name.
    unsettled : extrapolated remaining change of the mean velocity of each drive, over that velocity.
    """

    flows: dict[str, Checked]
    unsettled: dict[str, float]


def run_gap(directory: Path, progress: Progress = silent) -> GapRun:
    """Check the mesh and run each drive; errors as in :func:`roughfilm.foamcases.pocket.run.run_case`.

    A directory without cases gives a run without flows and the warning ``SEALED``.
    """
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

        def report(part: float, words: str, name: str = name, number: int = number) -> None:
            progress((number + part) / len(card.drives), f"{name}: {words}")

        flows[name] = converge(
            directory / name, card, judged, report, settled_within(card.tolerance, directory / name, judged)
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
    """A function that tests whether a running case has settled.

    A case has settled if it has done at least 2 ``WINDOW`` iterations, its greatest residual is ``judged.slack`` times
    the tolerance or less, and the remaining relative change of the mean velocity is at most the tolerance.
    """

    def settled(residuals: Residuals) -> bool:
        if len(residuals.greatest) < 2 * WINDOW or not residuals.greatest[-1] <= judged.slack * tolerance:
            return False
        return unsettled(mean_velocity(case)[:, MAIN[judged.main]]) <= tolerance

    return settled


def mean_velocity(case: Path) -> Array:
    """The mean velocity of all cells in each logged iteration of a case, in V, shape (iterations, 3).

    After a complete run, the last iteration is the one that verified the fields.
    """
    folders = sorted((case / "postProcessing" / MEAN_VELOCITY).iterdir(), key=lambda folder: float(folder.name))
    lines = [
        line
        for folder in folders
        for line in (folder / "volFieldValue.dat").read_text(encoding="ascii").splitlines(keepends=True)
        if not line.startswith("#") and line.endswith("\n")
    ]
    return np.array([[float(word.strip("()")) for word in line.split()[1:]] for line in lines]).reshape(-1, 3)


def unsettled(values: Array) -> float:
    """The remaining change of a series over its last value, if its steps keep shrinking at their present rate.

    The remaining change is d r/(1 - r), where d is the largest of the last ``WINDOW`` steps, d' the largest of as many
    steps before, and r = (d/d')^(1/``WINDOW``), at most ``MAX_STEP_RATIO``. The steps of a shorter series are split in
    half. The last value counts as at least ``MIN_VELOCITY``.
    """
    steps = np.abs(np.diff(values))
    window = min(WINDOW, steps.size // 2)
    if not window:
        return 0.0
    last, before = steps[-window:].max(), steps[-2 * window : -window].max()
    rate = min((last / before) ** (1 / window) if before > 0 else 1.0, MAX_STEP_RATIO)
    return float(last * rate / (1 - rate) / max(abs(values[-1]), MIN_VELOCITY)) if last > 0 else 0.0
