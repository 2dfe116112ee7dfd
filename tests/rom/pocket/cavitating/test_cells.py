"""Cells in plan whose film ruptures: the groove as a limit, conservation of mass, symmetry, and the whole film."""

import numpy as np
import pytest
from places import SCENES

from roughfilm.ladder import find
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.evaluation.flows import flow_along
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.pocket.cavitating.cells import cell_film, edge_mean

CAVITATING, REYNOLDS = find("pocket", "reynolds_cavitating"), find("pocket", "reynolds")


def dimple(*overrides):
    return load_scene(SCENES / "dimple.toml", overrides)


@pytest.fixture(scope="module", params=["aligned", "staggered"])
def ruptured(request):
    scene = dimple("boundary.ambient_pressure=3kPa", f"geometry.arrangement={request.param}")
    return scene, cell_film(scene, (48, 48), tolerance=1e-9)


def test_the_mean_pressure_over_the_edges_is_ambient(ruptured):
    scene, film = ruptured
    assert (film.kind == CAVITY).any()
    assert edge_mean(film) == pytest.approx(3e3, abs=1e-6 * film.state.pressure.max())
    result = CAVITATING.solve(scene, Request(resolution=48))
    assert result["pressure_min_plus"].value * scene.pressure_unit / scene.plus_factor == pytest.approx(-3e3, rel=1e-4)
    edges = [warning for warning in result.warnings if "of the edges x = ±length/2" in warning]
    assert len(edges) == (1 if (film.kind[0] == CAVITY).any() else 0)


def test_as_much_liquid_passes_every_line_across_the_cell(ruptured):
    """Also that of the anchor, whose balance follows from those of all other nodes."""
    _, film = ruptured
    through = flow_along(film).sum(axis=1)
    assert np.ptp(through) < 1e-7 * through.mean()


def test_a_cell_that_is_symmetric_across_has_a_symmetric_film(ruptured):
    _, film = ruptured
    for values in (film.state.pressure, film.state.fill):
        turned = np.roll(values[:, ::-1], 1, axis=1)
        assert np.abs(values - turned).max() < 1e-4 * np.abs(values).max()


def test_a_groove_over_the_breadth_has_the_film_of_the_groove():
    own = ["boundary.ambient_pressure=20kPa"]
    groove = load_scene(SCENES / "pocket.toml", own)
    geometry = {"shape": "groove", "width": "0.3 mm", "depth": "7.5 um"}
    cell = dimple(
        *own, "geometry.breadth=0.2mm", *(f"geometry.dimples.0.{key}={value}" for key, value in geometry.items())
    )
    exact, found = CAVITATING.solve(groove), CAVITATING.solve(cell, Request(resolution=128))
    assert exact["cavitated_fraction"].value > 0.02
    for name in ("load_per_area", "friction_per_area", "pressure_max_plus", "theta_min"):
        assert found[name].value == pytest.approx(exact[name].value, rel=1e-2)
    assert found["load_from_corner_per_area"].value == pytest.approx(found["load_per_area"].value, rel=1e-6)


def test_a_film_that_stays_whole_is_that_of_the_reynolds_equation():
    scene = dimple()
    whole, reynolds = CAVITATING.solve(scene, Request(resolution=64)), REYNOLDS.solve(scene, Request(resolution=128))
    assert whole["cavitated_fraction"].value == 0
    assert np.abs(whole.fields["density_ratio"].values - 1).max() < 1e-9
    for name in ("friction_plus", "pressure_max_plus", "pressure_min_plus"):
        assert whole[name].value == pytest.approx(reynolds[name].value, rel=1e-2)
    assert abs(whole["load_plus"].value) < 1e-6 * whole["pressure_max_plus"].value


def test_the_difference_to_a_fine_grid_is_within_the_uncertainty():
    scene = dimple("boundary.ambient_pressure=3kPa", "geometry.dimples.0.position=-0.1mm")
    coarse, fine = (CAVITATING.solve(scene, Request(resolution=n)) for n in (40, 128))
    for name in ("load_plus", "friction_plus", "cavitated_fraction"):
        assert abs(coarse[name].value - fine[name].value) <= coarse[name].uncertainty + fine[name].uncertainty
    assert all(field.values.shape == fine.fields["pressure"].values.shape for field in fine.fields.values())


def test_at_ambient_cavitation_pressure_the_edges_are_full_and_parallel_walls_carry_nothing():
    result = CAVITATING.solve(dimple("lubricant.cavitation_pressure=0Pa"), Request(resolution=32))
    assert result["load_plus"].value == pytest.approx(0, abs=1e-12)
    assert result["theta_min"].value == pytest.approx(30 / 37.5, rel=1e-2)
    assert any("is ambient pressure" in warning for warning in result.warnings)
