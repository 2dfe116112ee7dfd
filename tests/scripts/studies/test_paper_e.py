"""Paper E: made surfaces, leakage by window, resolution and load, and the washer with its verdicts."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from roughfilm.contact.parameters.spectrum import power_spectrum, texture_direction
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.figures.base import svg
from scripts.studies.paper_e import data as paper_e_data
from scripts.studies.paper_e.__main__ import studies
from scripts.studies.paper_e.claims import PaperE, direct_is_homogenized, judge, lift_off, methods_agree, worst_cell
from scripts.studies.paper_e.data import LOADS, SEEDS, Washer, washer
from scripts.studies.paper_e.figures import drawings
from scripts.studies.paper_e.made import LAYS, TABLE, made, turned
from scripts.studies.paper_e.windows import (
    DURATION,
    LENGTH,
    LOAD,
    PARTS,
    PRESSURE_DROP,
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


def leak(window, load, apart, passed=1e-16, resolution=1.0, start=(0.0, 0.0)):
    return Leak(
        window=window,
        resolution=resolution,
        start=start,
        mismatch=(0.0, 0.0),
        load=load,
        mean_gap=5e-6,
        area_fraction=0.0,
        roughness=1e-6,
        homogenized=(passed, passed),
        uncertainty=(0.0, 0.0),
        direct=(passed * (1 + apart), passed * (1 + 2 * apart)),
        direct_uncertainty=(0.0, 0.0),
    )


def slit(load, height):
    return leak("a", load, 0.1, height**3)


def test_a_slit_leaks_as_poiseuille_says():
    """Mean speed h²Δp/(12ηL) through the area h w, for 300 s; as thin as W^(-1/10) it leaks as W^(-3/10)."""
    height = 4e-6
    speed = height**2 * PRESSURE_DROP / (12 * VISCOSITY * LENGTH)
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


DIRECTIONS = ("along", "across", "+45°", "-45°")


@dataclass
class Lifted:
    """A washer of which lift-off alone is known."""

    cell: tuple
    box: tuple
    uncertainty: float = 0.01

    def lift(self, *, boxed=False):
        speeds = np.array(self.box if boxed else self.cell)
        return np.stack([speeds, self.uncertainty * speeds], axis=1)

    def apart(self):
        return max(abs(b / c - 1) for b, c in zip(self.box, self.cell, strict=True))


def lifted(factor=1.0, boxed=1.0, loads=LOADS):
    cell = tuple(factor * 1e-4 * load for load in loads)
    return Lifted(cell, tuple(boxed * speed for speed in cell))


def paper(straight=1.0, crossed=0.8, across=1.2, oblique=2.0, loads=LOADS):
    washers = {
        "surface 1": lifted(boxed=straight, loads=loads),
        "surface 2": lifted(1.5, crossed, loads),
        "surface 3": lifted(0.6, straight, loads),
    }
    factors = dict(zip(DIRECTIONS, (1.0, across, oblique, 1 / oblique), strict=True))
    lays = {f"{lay}, {seed}": lifted(factor, loads=loads) for lay, factor in factors.items() for seed in SEEDS}
    return PaperE(windows=(), rows=(), washers=washers, lays=lays | {"surface 1, across": lifted(across, loads=loads)})


@pytest.mark.parametrize(
    ("straight", "crossed", "verdict"), [(1.0, 0.8, "true"), (1.0, 0.995, "partly"), (1.3, 0.995, "false")]
)
def test_methods_are_judged_by_lift_off_of_straight_and_of_crossed_marks(straight, crossed, verdict):
    assert methods_agree(paper(straight, crossed).washers)[0] == verdict


@pytest.mark.parametrize(
    ("across", "loads", "verdict"),
    [(1.2, LOADS, "true"), (1.001, LOADS, "partly"), (0.8, LOADS, "partly"), (0.8, LOADS[::-1], "false")],
)
def test_lift_off_is_judged_by_load_and_by_the_same_surface_turned(across, loads, verdict):
    assert lift_off(paper(across=across, loads=loads))[0] == verdict


def windows(apart):
    usual = [leak(window, load, apart, load**-0.25) for window in "abc" for load in (LOAD / 2, LOAD, 2 * LOAD)]
    return [*usual, *(leak(window, LOAD, apart, 0.9, r) for window in "ab" for r in (0.5, 2.0))]


@pytest.mark.parametrize(("apart", "verdict"), [(0.01, "true"), (0.04, "partly"), (0.2, "false")])
def test_direct_and_homogenized_leaks_are_judged_within_five_per_cent(apart, verdict):
    found = windows(apart)
    assert direct_is_homogenized(found, ((1, apart), (2, apart / 2)))[0] == verdict
    one, axis = worst_cell([*found, leak("c", LOAD, 3 * apart, start=(0.5, 0.5))])
    assert (one.window, one.start, axis) == ("c", (0.5, 0.5), 1)


def test_studies_state_what_half_and_double_the_load_do():
    report = dict(studies(windows(0.01)))
    assert report["half load, window a"] == "+18.9 %"
    assert report["double load, window a"] == "-15.9 %"
    assert report["slope d ln Q/d ln W, window a, half to double the load"] == "-0.25"


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    folder = tmp_path_factory.mktemp("washer")
    return folder, washer(made("surface 2", 64), folder, boxed=True, speeds=(0.0, 100.0), cells=16)


def test_a_washer_of_crossed_marks_parts_earlier_without_what_they_pump(small):
    _, one = small
    assert (np.diff(one.lift()[:, 0]) > 0).all()
    assert (one.lift(boxed=True)[:, 0] < one.lift()[:, 0]).all()
    assert 0 < one.apart() < 1
    assert [len(curve.points) for curve in one.curves] == [4] * len(LOADS)
    assert one.turns == pytest.approx(60 / (2 * np.pi * 0.165))


def test_a_washer_is_found_again(small, monkeypatch):
    folder, one = small
    monkeypatch.setattr(paper_e_data, "patir_cheng_table", only_known)
    again = washer(made("surface 2", 64), folder, boxed=True, speeds=(0.0, 100.0), cells=16)
    assert isinstance(again, Washer)
    assert again.wall.known_points == again.wall.points
    for mine, other in zip((*one.curves, *one.boxed), (*again.curves, *again.boxed), strict=True):
        assert mine.points == other.points


def only_known(table, _press, *, known, keep):
    """The table, if all of its points are known; none is new."""
    assert callable(keep)
    points = tuple(known[point.mean_gap] for point in table.factors.points)
    return replace(table, factors=replace(table.factors, points=points))


def test_everything_is_drawn(small):
    _, one = small
    washers = dict.fromkeys(("surface 1", "surface 2", "surface 3"), one)
    lays = dict.fromkeys([f"{lay}, {seed}" for lay in DIRECTIONS for seed in SEEDS] + ["surface 1, across"], one)
    whole = PaperE(windows=windows(0.01), rows=((1, 0.01),), washers=washers, lays=lays)
    assert [claim.number for claim in judge(whole)] == [19, 21, 22]
    plots = drawings(whole)
    assert set(plots) == {"textures", "friction", "films", "pressures", "lays", "leakages"}
    assert all("<svg" in svg(figure) for figure in plots.values())
