"""Paper E's washer: what is judged of it, and that what is computed stays."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from roughfilm.figures.base import svg
from scripts.studies.paper_e import data as paper_e_data
from scripts.studies.paper_e.__main__ import studies
from scripts.studies.paper_e.claims import PaperE, direct_is_homogenized, judge, lift_off, methods_agree, worst_cell
from scripts.studies.paper_e.data import LOADS, SEEDS, Washer, washer
from scripts.studies.paper_e.figures import drawings
from scripts.studies.paper_e.made import made
from scripts.studies.paper_e.windows import LOAD, Leak

LAYS = ("along", "across", "+45°", "-45°")


@dataclass
class Lifted:
    """A washer of which lift-off alone is known."""

    cell: tuple
    box: tuple
    unsure: float = 0.01

    def lift(self, *, boxed=False):
        speeds = np.array(self.box if boxed else self.cell)
        return np.stack([speeds, self.unsure * speeds], axis=1)

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
    factors = dict(zip(LAYS, (1.0, across, oblique, 1 / oblique), strict=True))
    lays = {f"{lay}, {seed}": lifted(factor, loads=loads) for lay, factor in factors.items() for seed in SEEDS}
    return PaperE(windows=(), rows=(), washers=washers, lays=lays | {"surface 1, across": lifted(across, loads=loads)})


@pytest.mark.parametrize(
    ("straight", "crossed", "verdict"), [(1.0, 0.8, "true"), (1.0, 0.995, "partly"), (1.3, 0.995, "false")]
)
def test_methods_are_judged_by_lift_off_of_straight_and_of_crossed_marks(straight, crossed, verdict):
    assert methods_agree(paper(straight, crossed).washers).verdict == verdict


@pytest.mark.parametrize(
    ("across", "loads", "verdict"),
    [(1.2, LOADS, "true"), (1.001, LOADS, "partly"), (0.8, LOADS, "partly"), (0.8, LOADS[::-1], "false")],
)
def test_lift_off_is_judged_by_load_and_by_the_same_surface_turned(across, loads, verdict):
    assert lift_off(paper(across=across, loads=loads)).verdict == verdict


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


def windows(apart):
    usual = [leak(window, load, apart, load**-0.25) for window in "abc" for load in (LOAD / 2, LOAD, 2 * LOAD)]
    return [*usual, *(leak(window, LOAD, apart, 0.9, r) for window in "ab" for r in (0.5, 2.0))]


@pytest.mark.parametrize(("apart", "verdict"), [(0.01, "true"), (0.04, "partly"), (0.2, "false")])
def test_direct_and_homogenized_leaks_are_judged_within_five_per_cent(apart, verdict):
    found = windows(apart)
    assert direct_is_homogenized(found, ((1, apart), (2, apart / 2))).verdict == verdict
    one, axis = worst_cell([*found, leak("c", LOAD, 3 * apart, start=(0.5, 0.5))])
    assert (one.window, one.start, axis) == ("c", (0.5, 0.5), 1)


def test_studies_tell_what_half_and_double_the_load_do():
    told = dict(studies(windows(0.01)))
    assert told["half load, window a"] == "+18.9 %"
    assert told["double load, window a"] == "-15.9 %"
    assert told["slope d ln Q/d ln W, window a, half to double the load"] == "-0.25"


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
    lays = dict.fromkeys([f"{lay}, {seed}" for lay in LAYS for seed in SEEDS] + ["surface 1, across"], one)
    whole = PaperE(windows=windows(0.01), rows=((1, 0.01),), washers=washers, lays=lays)
    assert [claim.number for claim in judge(whole)] == [19, 21, 22]
    plots = drawings(whole)
    assert set(plots) == {"textures", "friction", "films", "pressures", "lays", "leakages"}
    assert all("<svg" in svg(figure) for figure in plots.values())
