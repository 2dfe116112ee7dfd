"""The case of a cell in plan: its mesh, symmetry, criteria and card."""

import numpy as np
import pytest
from foamlib import FoamFile
from places import SCENES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.residuals import FIELDS
from roughfilm.foamcases.openfoam.settling import MEAN_VELOCITY
from roughfilm.foamcases.pocket.card import Card
from roughfilm.foamcases.pocket.models.navier_stokes import MODEL
from roughfilm.foamcases.pocket.plan.fields import CellFlow
from roughfilm.foamcases.pocket.plan.mesh.hexahedra import cells
from roughfilm.foamcases.pocket.plan.mesh.vertices import vertices_of
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries

DIMPLE = load_scene(SCENES / "dimple.toml")


def with_dimple(**dimple):
    entries = scene_entries(DIMPLE)
    entries["geometry"]["dimples"] = [dimple]
    return read_scene(entries)


def patches(case):
    return dict(FoamFile(case / "constant" / "polyMesh" / "boundary")[None])


def test_half_of_a_symmetric_cell_is_solved_between_symmetry_planes(tmp_path):
    MODEL.write(DIMPLE, tmp_path, Request(resolution=24))
    card = read_card(tmp_path, Card)
    assert (card.columns, card.rows, card.layers, card.mirrored, card.judged) == (24, 24, 5, True, FIELDS)
    found = patches(tmp_path)
    assert [found[name]["type"] for name in ("west", "south", "north")] == ["cyclic", "symmetryPlane", "symmetryPlane"]
    assert [found[name]["nFaces"] for name in ("west", "south", "lower")] == [12 * 5, 24 * 5, 24 * 12]
    assert FoamFile(tmp_path / "0" / "U")["boundaryField", "south", "type"] == "symmetryPlane"
    assert "functions" not in FoamFile(tmp_path / "system" / "controlDict")
    assert 'symmetry planes "south" and "north"' in (tmp_path / "README").read_text()


def test_a_cell_without_symmetry_is_cyclic_across(tmp_path):
    scene = with_dimple(shape="spherical", width="0.3 mm", depth="7.5 um", position_across="0.1 mm")
    MODEL.write(scene, tmp_path, Request(resolution=24, processes=6))
    found = patches(tmp_path)
    assert not read_card(tmp_path, Card).mirrored
    assert [found[name]["type"] for name in ("south", "north")] == ["cyclic", "cyclic"]
    assert found["lower"]["nFaces"] == 24 * 24
    assert [*FoamFile(tmp_path / "system" / "decomposeParDict")["simpleCoeffs", "n"]] in ([2, 3, 1], [3, 2, 1])


def test_a_groove_is_not_judged_by_the_velocity_across(tmp_path):
    """Its residual is round-off: the run ends when the mean velocity has settled."""
    MODEL.write(with_dimple(shape="groove", width="0.3 mm", depth="7.5 um"), tmp_path, Request(resolution=24))
    assert read_card(tmp_path, Card).judged == ("Ux", "Uz", "p")
    assert MEAN_VELOCITY in FoamFile(tmp_path / "system" / "controlDict")["functions"]
    assert not FoamFile(tmp_path / "system" / "fvSolution")["SIMPLE", "residualControl"]


def test_a_case_of_grooves_is_not_read_as_one_in_plan(make_scene, tmp_path):
    MODEL.write(make_scene(0.3, 0.25, 160), tmp_path, Request(resolution=20))
    with pytest.raises(InputError, match="holds a case of grooves, and the scene has a cell in plan"):
        MODEL.read(DIMPLE, tmp_path, None)


@pytest.fixture(scope="module")
def flow():
    """Plane shear u = z and a linear pressure in the mesh of a smooth wall whose columns lean as over a dimple."""
    vertices = vertices_of(DIMPLE.plan(), 24)
    vertices[..., 2] = np.linspace(0, 1, 6)
    _, centre = cells(vertices)
    z = centre[..., 2]
    return CellFlow(
        vertices=vertices, velocity=np.stack([z, 0 * z, 0 * z], axis=-1), pressure=3 + 2 * z + centre[..., 1]
    )


def test_plane_shear_has_shear_stress_1_and_balanced_drags(flow):
    assert flow.wall_shear == pytest.approx(1)
    assert flow.imbalance() == pytest.approx(0, abs=1e-12)
    assert flow.back_flow() == 0


def test_a_linear_pressure_is_extrapolated_to_the_wall(flow):
    _, y = flow.sides
    assert flow.wall_pressure == pytest.approx(np.broadcast_to(5 + (y[1:] + y[:-1]) / 2, (24, 24)), abs=2e-3)


def test_the_extremes_of_pressure_lie_between_the_columns(flow):
    x, y = ((side[1:] + side[:-1]) / 2 for side in flow.sides)
    period = flow.sides[0][-1] - flow.sides[0][0]
    wave = np.cos(2 * np.pi * (x - 0.3) / period)[:, None] * np.cos(2 * np.pi * (y + 0.4) / period)
    smooth = CellFlow(vertices=flow.vertices, velocity=flow.velocity, pressure=np.repeat(wave[..., None], 5, axis=2))
    assert smooth.pressure_range() == pytest.approx((-1, 1), abs=2e-3)
