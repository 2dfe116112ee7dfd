"""The verification of cells in plan: its rows, and a mesh of snappyHexMesh that is near the flow on the own one."""

import pytest

from scripts.studies.dimples import snapped as other_mesh
from scripts.studies.dimples.verification import CAP, cell, limits, solve

SECOND_ORDER = [
    {"columns": n, **dict.fromkeys(("load_plus", "load_from_corner_plus", "friction_plus"), 1 + 9 / n**2)}
    | dict.fromkeys(("pressure_max_plus", "pressure_min_plus"), 2.0)
    for n in (24, 48, 96)
]


def test_rows_of_grids_have_a_limit():
    found = limits("cap", SECOND_ORDER)
    assert found["load_plus"] == pytest.approx(1)
    assert found["pressure_max_plus"] == 2
    assert "load 2.00 ±" in found["orders"]


@pytest.mark.openfoam
def test_two_meshes_agree_within_their_coarse_cells(monkeypatch):
    monkeypatch.setattr(other_mesh, "POINTS", 120)
    own, other = solve("own", cell(CAP), 24), other_mesh.snapped("snappyHexMesh", cell(CAP), 32)
    vertical = solve("vertical", cell(CAP), 24, 0.0)
    assert other["load_plus"] == pytest.approx(own["load_plus"], rel=0.15)
    assert vertical["load_plus"] == pytest.approx(own["load_plus"], rel=0.05)
    assert vertical["load_plus"] != own["load_plus"]
    for row in (other, vertical):
        assert row["friction_plus"] == pytest.approx(own["friction_plus"], rel=1e-3)
