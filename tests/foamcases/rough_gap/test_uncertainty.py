"""What a mesh says of its own error holds against exact flows."""

import numpy as np
import pytest

from roughfilm.foamcases.rough_gap.case import mesh_of
from roughfilm.foamcases.rough_gap.cases import lost_shear
from roughfilm.foamcases.rough_gap.models.stokes import MODEL
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from roughfilm.rom.rough_gap.flow.exact import sinusoidal_ridge_flow

pytestmark = pytest.mark.openfoam


def scene_of(**geometry):
    return read_scene(
        {
            "name": "gap",
            "kind": "rough_gap",
            "geometry": {"mean_gap": "1 um", **geometry},
            "lubricant": {"viscosity": "10 mPa*s", "density": "870 kg/m^3"},
            "flow": {"reynolds_number": 1.0},
        }
    )


@pytest.mark.parametrize(("amplitude", "wavelength"), [(0.3, 2.5), (0.8, 5.0)])
def test_ridges_are_within_their_bars_which_shrink_at_second_order(amplitude, wavelength):
    scene = scene_of(surface="sinusoid", amplitude=f"{amplitude} um", wavelength=f"{wavelength} um")
    exact = sinusoidal_ridge_flow(amplitude, wavelength)
    bars = []
    for resolution in (16, 32):
        found = MODEL.solve(scene, Request(resolution=resolution))
        truths = {"A11": exact.across, "A22": exact.along, "B1": exact.drag, "friction": exact.friction}
        for name, truth in truths.items():
            assert abs(found[name].value - truth) < found[name].uncertainty < 0.5 * truth
        bars.append([found[name].uncertainty for name in truths])
    assert np.divide(*bars) == pytest.approx(np.full(4, 4.0), abs=1.2)


def test_waves_that_the_mesh_cannot_hold_are_counted():
    short = {
        "kind": "sinusoid",
        "size": ["8 um", "1 um"],
        "points": [32, 4],
        "amplitude": "0.3 um",
        "wavelength_x": "0.8 um",
    }
    scene = scene_of(surface=short)
    assert np.ptp(scene.walls(16).lower) == pytest.approx(0.0, abs=1e-12)
    found = MODEL.solve(scene, Request(resolution=16))
    assert found.quantities["A11"].value == pytest.approx(1.0, abs=1e-4)
    truth = sinusoidal_ridge_flow(0.3, 0.8, tolerance=1e-4).across
    assert 1 - truth < 1.3 * found["A11"].uncertainty


def test_flow_over_thin_film_theory_on_the_same_nodes_is_what_slope_takes():
    found = MODEL.solve(scene_of(surface="sinusoid", amplitude="0.3 um", wavelength="5 um"), Request(resolution=32))
    assert found.quantities["A11_over_reynolds"].value == pytest.approx(0.95383, abs=1e-3)
    assert found.quantities["A22_over_reynolds"].value == pytest.approx(0.94218, abs=2e-3)


def test_a_gap_that_contact_seals_is_an_answer():
    bumps = {
        "kind": "sinusoid",
        "size": ["20 um", "20 um"],
        "points": [16, 16],
        "amplitude": "0.5 um",
        "wavelength_x": "20 um",
        "wavelength_y": "20 um",
    }
    entries = scene_entries(scene_of(surface=bumps))
    del entries["geometry"]["mean_gap"]
    solid = {"modulus": "200 GPa", "poisson": 0.3}
    scene = read_scene({**entries, "solid": solid, "load": {"pressure": "9 GPa"}})
    found = MODEL.solve(scene)
    assert [found.quantities[name].value for name in ("A11", "A12", "A21", "A22")] == [0.0] * 4
    assert any("seals the gap both ways" in warning for warning in found.warnings)


@pytest.mark.parametrize(("amplitude", "columns"), [(0.3, 16), (0.9, 16), (0.98, 32), (0.98, 64)])
def test_shear_that_columns_do_not_see_is_known_before_anything_is_solved(amplitude, columns):
    """<1/h> of a sinusoid is 1/√(1 - a²); columns are as high as the liquid between them on average."""
    scene = scene_of(surface="sinusoid", amplitude=f"{amplitude} um", wavelength="5 um")
    edges = 1 - amplitude * np.cos(2 * np.pi * np.arange(columns + 1) / columns)
    seen = np.mean(2 / (edges[1:] + edges[:-1])) * np.sqrt(1 - amplitude**2)
    assert lost_shear(scene, mesh_of(scene, columns)[1]) == pytest.approx(1 - seen, abs=1e-6)


def test_walls_that_are_nearer_between_columns_cause_a_warning():
    apart, near = (
        MODEL.solve(
            scene_of(surface="sinusoid", amplitude=f"{amplitude} um", wavelength="5 um"), Request(resolution=16)
        )
        for amplitude in (0.3, 0.9)
    )
    assert not any("are nearer between" in warning for warning in apart.warnings)
    assert any("friction is too small by as much" in warning for warning in near.warnings)
