"""OpenFOAM over a dimple and over a groove in plan: symmetry, limits and the two-dimensional models."""

import subprocess

import numpy as np
import pytest
from places import SCENES

from roughfilm.foamcases.pocket.models.navier_stokes import MODEL as NAVIER_STOKES
from roughfilm.foamcases.pocket.models.stokes import MODEL as STOKES
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

pytestmark = pytest.mark.openfoam

DIMPLE = load_scene(SCENES / "dimple.toml")
CONVERGED = {"load_plus": 0.679, "load_from_corner_plus": 0.3184, "friction_plus": 2.9829, "pressure_max_plus": 10.66}
"""Limits of 40, 80 and 120 columns, near those of snappyHexMesh: docs/theory/openfoam.md."""


def changed(scene, dimple, **geometry):
    entries = scene_entries(scene)
    (own,) = entries["geometry"]["dimples"]
    entries["geometry"] |= {**geometry, "dimples": [{**own, **dimple}]}
    return read_scene(entries)


@pytest.fixture(scope="module")
def dimple():
    return NAVIER_STOKES.solve(DIMPLE, Request(resolution=24))


def test_a_coarse_grid_is_near_the_converged_flow(dimple):
    for name, value in CONVERGED.items():
        assert dimple[name].value == pytest.approx(value, rel=1e-3 if name == "friction_plus" else 0.04), name
    assert dimple.numerics.runs[-1].imbalance < 1e-3
    assert dimple.numerics.residual < 2e-7
    assert not dimple.warnings


def test_the_fields_are_those_of_the_whole_cell(dimple):
    values = {name: field.values for name, field in dimple.fields.items()}
    assert values["pressure"].shape == values["x"].shape == (24, 24)
    assert values["vertices"].shape == (25, 25, 6, 3)
    assert values["cell_velocity"].shape == (*values["cell_pressure"].shape, 3) == (24, 24, 5, 3)
    assert values["pressure"] == pytest.approx(values["pressure"][:, ::-1])
    assert values["cell_velocity"][..., 1] == pytest.approx(-values["cell_velocity"][:, ::-1, :, 1])
    assert values["film_thickness"] == pytest.approx(DIMPLE.plan().thickness(values["x"], values["y"]))


def test_a_dimple_anywhere_in_a_cyclic_cell_is_that_in_the_half_of_a_symmetric_one(dimple):
    moved = changed(DIMPLE, {"position_across": "0.2 mm"})
    assert not moved.plan().mirrored
    found = NAVIER_STOKES.solve(moved, Request(resolution=24))
    for name in ("load_plus", "friction_plus", "pressure_max_plus"):
        assert found[name].value == pytest.approx(dimple[name].value, rel=2e-3), name


def test_creeping_flow_carries_no_load_over_a_symmetric_dimple():
    found = STOKES.solve(DIMPLE, Request(resolution=16))
    highest = found["pressure_max_plus"].value
    assert found["pressure_min_plus"].value == pytest.approx(-highest, rel=1e-5)
    assert abs(found["load_plus"].value) < 1e-6 * highest
    pressure = found.fields["pressure"].values
    assert np.abs(pressure + pressure[::-1]).max() < 1e-5 * np.abs(pressure).max()


def test_a_groove_in_plan_is_the_two_dimensional_groove():
    """3.303 and 2.922 are those of an independent solver; the load of 60 columns is 1 % below."""
    groove = read_scene(
        {
            **scene_entries(DIMPLE),
            "geometry": {
                "length": "1 mm",
                "breadth": "0.07 mm",
                "film": "30 um",
                "dimples": [{"shape": "groove", "width": "0.3 mm", "depth": "7.5 um"}],
            },
        }
    )
    found = NAVIER_STOKES.solve(groove, Request(resolution=60))
    assert found["load_plus"].value == pytest.approx(3.303, rel=0.015)
    assert found["friction_plus"].value == pytest.approx(2.922, rel=1e-3)
    assert found["load_from_corner_plus"].value == pytest.approx(found["load_plus"].value, rel=1e-6)


def test_a_case_run_by_its_script_gives_the_same_result(dimple, tmp_path):
    case = tmp_path / "case"
    NAVIER_STOKES.write(DIMPLE, case, Request(resolution=24))
    subprocess.run([case / "Allrun"], check=True, capture_output=True)
    found = NAVIER_STOKES.read(DIMPLE, case, NAVIER_STOKES.kept_run(case))
    assert found["load_plus"].value == pytest.approx(dimple["load_plus"].value, rel=1e-9)
    assert found.numerics.iterations == dimple.numerics.iterations


@pytest.mark.slow
def test_several_processes_find_what_one_finds():
    alone, together = (NAVIER_STOKES.solve(DIMPLE, Request(resolution=16, processes=n)) for n in (1, 2))
    for name in CONVERGED:
        assert together[name].value == pytest.approx(alone[name].value, rel=1e-5)
    assert together.numerics.processes == 2
