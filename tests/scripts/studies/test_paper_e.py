"""Paper E: surfaces made to its table, and how much a leakage hangs on window, resolution and load."""

import numpy as np
import pytest

from roughfilm.contact.parameters.spectrum import power_spectrum, texture_direction
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.surface import Surface
from scripts.studies.paper_e.made import LAYS, TABLE, made, turned
from scripts.studies.paper_e.windows import (
    DROP,
    DURATION,
    LENGTH,
    PARTS,
    STEEL,
    VISCOSITY,
    WIDTH,
    Leak,
    leaks,
    places,
    recipe,
    sensitivity,
)

POINTS = 128


@pytest.mark.parametrize("name", TABLE)
def test_a_made_surface_has_the_numbers_of_the_table(name):
    z = made(name, POINTS).heights
    row = TABLE[name]
    found = (z.max(), -z.min(), np.abs(z).mean(), z.std())
    np.testing.assert_allclose(found, (row.peak, row.valley, row.average, row.rms), rtol=1e-6)
    assert abs(z.mean()) < 1e-9 * row.rms


@pytest.mark.parametrize("name", ["surface 1", "surface 3"])
def test_a_lay_runs_along_the_sliding_and_across_it_once_turned(name):
    surface = made(name, POINTS)
    along = texture_direction(power_spectrum(surface))
    assert min(along, 180 - along) < 3
    assert abs(texture_direction(power_spectrum(turned(surface))) - 90) < 3


def test_the_deeper_of_two_crossing_cuts_gives_the_lay():
    assert abs(texture_direction(power_spectrum(made("surface 2", 128))) - LAYS[0]) < 10


def test_another_seed_is_another_surface_with_the_same_heights():
    one, other = (made("surface 3", POINTS, seed).heights for seed in (0, 17))
    np.testing.assert_allclose(np.sort(one, axis=None), np.sort(other, axis=None))
    assert np.abs(np.corrcoef(one.ravel(), other.ravel())[0, 1]) < 0.3


def slit(load, height):
    return Leak(
        window="a",
        resolution=1.0,
        start=(0.0, 0.0),
        mismatch=(0.0, 0.0),
        load=load,
        mean_gap=height,
        area_fraction=0.0,
        roughness=0.0,
        homogenized=(height**3, height**3),
        uncertainty=(0.0, 0.0),
        direct=(1.1 * height**3, 1.2 * height**3),
        direct_uncertainty=(0.0, 0.0),
    )


def test_a_slit_leaks_as_poiseuille_says():
    """Mean speed h²Δp/(12ηL) through the area h w, for 300 s; as thin as W^(-1/10) it leaks as W^(-3/10)."""
    height = 4e-6
    speed = height**2 * DROP / (12 * VISCOSITY * LENGTH)
    assert slit(1e6, height).volume(1) == pytest.approx(speed * height * WIDTH * DURATION)
    assert slit(1e6, height).volume(1, direct=True) == pytest.approx(1.2 * speed * height * WIDTH * DURATION)
    loads = (1e6, 2e6, 4e6)
    assert sensitivity([slit(load, load**-0.1) for load in loads], 0) == pytest.approx(-0.3)


def test_load_throttles_a_window():
    """Contact bears the hardness at most, so that at least W/H touches."""
    rows = leaks(made("surface 2", POINTS), "b", places("b")[0], 1.0, loads=(2e6, 8e6, 32e6), coarser=2)
    passed = np.array([one.homogenized for one in rows])
    assert (np.diff(passed, axis=0) < 0).all()
    assert (np.diff([one.mean_gap for one in rows]) < 0).all()
    touching = np.array([one.area_fraction for one in rows])
    assert (touching >= [one.load / STEEL.hardness for one in rows]).all()
    assert sensitivity(rows, 1) < 0
    assert min(one.apart(direction) for one in rows for direction in (0, 1)) > 0


def test_windows_lie_inside_the_measurement_and_the_first_in_its_middle():
    for window, part in PARTS.items():
        starts = np.array(places(window))
        assert (starts >= 0).all()
        assert (starts + part <= 1 + 1e-12).all()
        assert starts[0] == pytest.approx((1 - part) / 2)
        assert len(np.unique(starts, axis=0)) == len(starts)


@pytest.mark.parametrize(("resolution", "points"), [(0.5, [256, 128]), (1.0, [512, 256]), (2.0, [1024, 512])])
def test_nodes_are_powers_of_two_that_are_not_fewer_than_the_pixels(resolution, points):
    measured = Surface(heights=np.random.default_rng(5).random((600, 300)), spacing=(1e-6, 2e-6))
    entries = recipe(measured, "b", (0.1, 0.2), resolution)
    assert entries["grid"]["points"] == points
    asked = read_recipe(entries)
    assert asked.window.size == pytest.approx((400e-6, 400e-6))
    assert asked.window.start == pytest.approx((60e-6, 120e-6))
