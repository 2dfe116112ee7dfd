"""Several windows as arguments of the public interface."""

from types import SimpleNamespace

import numpy as np
import pytest
from places import SCENES
from small_scenes import SEAL, SURFACE
from window_sets import surface_of_seed

import roughfilm as rf
from roughfilm.contact.surfaces.store import save_surface

BEARING = {"points": [16, 16], "correlation_length": "0.4 mm", "anisotropy": 1}


@pytest.fixture(scope="module")
def cells():
    return [surface_of_seed(seed, 24) for seed in (1, 2, 3)]


@pytest.fixture(scope="module")
def seal(tmp_path_factory):
    folder = tmp_path_factory.mktemp("seal")
    (folder / "rough.toml").write_text(SURFACE, encoding="utf-8")
    (folder / "seal.toml").write_text(SEAL, encoding="utf-8")
    return rf.load_scene(folder / "seal.toml")


def test_flow_factors_of_windows_are_their_means_with_a_scatter(cells):
    own = [rf.flow_factors(cell, gap=0.3e-6) for cell in cells]
    found = rf.flow_factors(cells, gap=0.3e-6)
    assert found.keys() == own[0].keys()
    for name in ("A11", "A22", "B1", "d"):
        assert found[name].value == pytest.approx(np.mean([one[name].value for one in own]), rel=1e-9)
        assert found[name].uncertainty == pytest.approx(np.mean([one[name].uncertainty for one in own]), rel=1e-6)
        assert found[name].scatter > 0
        assert found[name].window_interval[0] < found[name].value < found[name].window_interval[1]
    fewer = rf.flow_factors(SimpleNamespace(cells=tuple(cells), independent=2.0), gap=0.3e-6)
    assert fewer["A11"].value == found["A11"].value
    assert fewer["A11"].scatter is None


def test_leakage_over_windows_has_the_scatter_in_its_rows(cells, seal, tmp_path):
    found = rf.leakage_curve(seal, [1e4], windows=cells, directory=tmp_path, threads=1)
    (row,) = found.rows
    own = []
    for number, cell in enumerate(cells):
        file = tmp_path / f"cell{number}.h5"
        save_surface(cell, file)
        own += rf.leakage_curve(rf.replace(seal, "geometry.surface", str(file)), [1e4], threads=1).rows
    assert row["direct_x"] == pytest.approx(np.mean([one["direct_x"] for one in own]), rel=1e-6)
    assert row["direct_x_scatter"] > 0
    assert found.rows.units["direct_x_scatter"] == "m^3"
    assert found.windows.sealing["direct_x"].load.value > 1e4
    assert (tmp_path / "0003" / "leakage.h5").is_file()


def test_stribeck_over_windows_has_the_scatter_at_its_points():
    scene = rf.load_scene(SCENES / "rough_washer.toml", set={f"roughness.surface.{k}": v for k, v in BEARING.items()})
    cells = [rf.replace(scene, "roughness.surface.seed", seed).roughness.read() for seed in (1, 2, 3)]
    (curve,) = rf.stribeck(scene, [0.3], [1e6], windows=cells, resolution=16)
    (point,) = curve.points
    assert point.scatter["friction_coefficient"] > 0
    assert curve.lift_off.scatter > 0


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ([], "give a set of windows"),
        ("windows", "give a set of windows"),
        ([1.0], "got float at 0"),
        ([surface_of_seed(1, 16), surface_of_seed(1, 24)], "the surface at 1 has"),
    ],
)
def test_wrong_windows_are_refused(seal, wrong, message):
    with pytest.raises(rf.InputError, match=message):
        rf.leakage_curve(seal, [1e4], windows=wrong)


def test_windows_have_their_own_spacing_and_bearings_a_surface(cells):
    with pytest.raises(rf.InputError, match="spacing: got 1e-06"):
        rf.flow_factors(cells, spacing=1e-6, gap=1e-6)
    washer = rf.load_scene(SCENES / "washer.toml")
    with pytest.raises(rf.InputError, match=r"scene\.roughness"):
        rf.stribeck(washer, [1.0], [1e6], windows=cells)
