"""Run the case of a pad: check its mesh, iterate its flow, and verify its fields."""

from pathlib import Path

from roughfilm.foamcases.bearing.case import PadCard
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.one_flow import Run, kept_flow_run, run_flow
from roughfilm.rom.ladder.model import Progress, silent


def run_pad(directory: Path, progress: Progress = silent) -> Run:
    """Run a case; InputError if the directory holds no case of a pad of this version, others as in ``run_flow``."""
    card = read_card(directory, PadCard)
    return run_flow(directory, card, card.criteria, progress, card.settled(directory))


def kept_run(directory: Path) -> Run:
    """Read the run of a case that its script ``Allrun`` ran; errors as those of :func:`run_pad`, save OpenFOAM's."""
    card = read_card(directory, PadCard)
    return kept_flow_run(directory, card, card.criteria, card.settled(directory))
