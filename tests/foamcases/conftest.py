"""Flows between walls of any shape."""

import json
from types import SimpleNamespace

import pytest

from roughfilm.foamcases.openfoam.case_directory import CARD, read_card
from roughfilm.foamcases.openfoam.installation import dialect_here
from roughfilm.foamcases.rough_gap.case import GapCard, mesh_of, write_gap_case
from roughfilm.foamcases.rough_gap.cases import factors_of
from roughfilm.foamcases.rough_gap.fields import read_gap_flow
from roughfilm.foamcases.rough_gap.model import TOLERANCE
from roughfilm.foamcases.rough_gap.run import run_gap
from roughfilm.rom.ladder.request import CheckedRequest, Request


@pytest.fixture
def flow_between(tmp_path):
    """Write, run and read the gap between walls whose heights are in mean gaps; all drives, or one ``only``."""

    def solve(walls, layers, *, only=None, reynolds_number=1e-6, tolerance=TOLERANCE, scheme="", processes=1):
        scene = SimpleNamespace(
            walls=lambda _: walls,
            mean_gap=1.0,
            layers=layers,
            nominal_flow=1.0,
            pressure_gradient=12.0,
            surface=lambda: SimpleNamespace(shape=walls.lower.shape),
        )
        case = tmp_path / f"case-{len([*tmp_path.iterdir()])}"
        request = CheckedRequest(
            resolution=max(walls.lower.shape), tolerance=tolerance, scheme=scheme, processes=processes, asked=Request()
        )
        write_gap_case(scene, case, request, reynolds_number, dialect_here())
        if only is not None:
            entries = json.loads((case / CARD).read_text())
            entries["judged"] = {only: entries["judged"][only]}
            (case / CARD).write_text(json.dumps(entries))
        run = run_gap(case)
        card = read_card(case, GapCard)
        _, columns = mesh_of(scene, card.resolution)
        flows = {name: read_gap_flow(case / name, card, columns) for name in card.judged}
        found, pulled = factors_of(flows, slides=walls.slides)
        return SimpleNamespace(found=found, pulled=pulled, flows=flows, run=run, columns=columns, case=case)

    return solve
