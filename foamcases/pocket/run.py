"""Run the case of a pocket: check its mesh, iterate its flow, and verify its fields."""

from pathlib import Path

from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.one_flow import Run, kept_flow_run, run_flow
from roughfilm.foamcases.pocket.card import Card
from roughfilm.rom.ladder.model import Progress, silent


def run_case(directory: Path, progress: Progress = silent) -> Run:
    """Run a case; InputError if the directory holds no pocket case of this version, others as in ``run_flow``."""
    card = read_card(directory, Card)
    return run_flow(directory, card, card.criteria, progress, card.settled(directory))


def kept_run(directory: Path) -> Run:
    """Read the run of a case that its script ``Allrun`` ran; errors as those of :func:`run_case`, save OpenFOAM's."""
    card = read_card(directory, Card)
    return kept_flow_run(directory, card, card.criteria, card.settled(directory))
