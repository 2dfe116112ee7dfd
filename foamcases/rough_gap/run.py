"""Run the cases of a rough gap one after the other on one checked mesh, and verify the fields of each."""

import time
from dataclasses import dataclass
from pathlib import Path

from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.kept import release_of, wall_time
from roughfilm.foamcases.openfoam.program import Ended
from roughfilm.foamcases.openfoam.run import (
    CaseRun,
    Checked,
    check_mesh,
    converge,
    kept_flow,
    kept_mesh,
    ready,
    remarks,
)
from roughfilm.foamcases.openfoam.settling import MAIN, mean_velocity, settled_within, unsettled
from roughfilm.foamcases.rough_gap.case import GapCard
from roughfilm.rom.ladder.model import Progress, silent

TOLERATED = ("highly skew faces",)
"""Faults of cells beside steep walls, which are warnings: their error falls with cell size."""

MESH_REMEDY = "take fewer layers, more columns or a larger mesh.smallest_gap"

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
    """Check the mesh and run each drive; errors as in :func:`roughfilm.foamcases.openfoam.one_flow.run_flow`.

    A directory without cases gives a run without flows and the warning ``SEALED``.
    """
    card = read_card(directory, GapCard)
    version = ready(directory, card.dialect, card.processes)
    wall = time.perf_counter()
    if not card.drives:
        return GapRun(flows={}, unsettled={}, cpu_s=0.0, wall_s=0.0, version=version, warnings=(SEALED,))
    mesh = check_mesh(directory / next(iter(card.drives)), tolerated=TOLERATED, remedy=MESH_REMEDY)
    flows: dict[str, Checked] = {}
    for number, (name, judged) in enumerate(card.drives.items()):

        def report(part: float, words: str, name: str = name, number: int = number) -> None:
            progress((number + part) / len(card.drives), f"{name}: {words}")

        flows[name] = converge(
            directory / name, card, judged, report, settled_within(card.tolerance, directory / name, judged)
        )
    return _run(directory, card, mesh, flows, time.perf_counter() - wall, version)


def kept_run(directory: Path) -> GapRun:
    """Read the runs of cases that their script ``Allrun`` ran; errors as those of :func:`run_gap`, save OpenFOAM's."""
    card = read_card(directory, GapCard)
    version = release_of(directory, card.dialect)
    if not card.drives:
        return GapRun(flows={}, unsettled={}, cpu_s=0.0, wall_s=0.0, version=version, warnings=(SEALED,))
    mesh = kept_mesh(directory / next(iter(card.drives)), tolerated=TOLERATED, remedy=MESH_REMEDY)
    flows = {
        name: kept_flow(directory / name, card, judged, settled_within(card.tolerance, directory / name, judged))
        for name, judged in card.drives.items()
    }
    return _run(directory, card, mesh, flows, wall_time(directory), version)


def _run(directory: Path, card: GapCard, mesh: Ended, flows: dict[str, Checked], wall_s: float, version: str) -> GapRun:
    return GapRun(
        flows=flows,
        unsettled={name: unsettled(mean_velocity(directory / name)[:, MAIN[card.drives[name].main]]) for name in flows},
        cpu_s=mesh.cpu_s + sum(flow.cpu_s for flow in flows.values()),
        wall_s=wall_s,
        version=version,
        warnings=remarks(mesh),
    )
