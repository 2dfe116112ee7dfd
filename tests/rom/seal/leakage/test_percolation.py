"""Where surfaces seal: masks drawn by hand, surfaces whose threshold is known, and searches that must end."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.homogenization.paths import sealed, sealed_between_ends
from roughfilm.rom.seal.leakage.joint import joint_seals
from roughfilm.rom.seal.leakage.percolation import ends_and_cell, thresholds
from roughfilm.rom.seal.leakage.pools import Pool, constriction, pools


def drawn(*lines):
    """A gap whose open nodes are dots; x runs down, y to the right."""
    return np.array([[1.0 if letter == "." else 0.0 for letter in line] for line in lines])


OVER_THE_SIDE = drawn(
    "#.####.#",
    "######.#",
    "######..",
    ".#######",
    "..######",
    "#.######",
)
NOT_BACK = drawn(
    "#.##.#",
    "#.####",
    "#....#",
    "####.#",
)


def test_paths_over_the_periodic_side_count():
    assert sealed_between_ends(OVER_THE_SIDE, joined=False)
    assert sealed_between_ends(OVER_THE_SIDE, joined=True)
    opened = OVER_THE_SIDE.copy()
    opened[2, 0] = 1.0
    assert not sealed_between_ends(opened, joined=True)
    assert sealed_between_ends(opened, joined=False)
    assert ends_and_cell(opened)[1] is True


def test_a_path_that_does_not_come_back_is_open_between_ends_alone():
    assert sealed(NOT_BACK) == (True, True)
    assert ends_and_cell(NOT_BACK) == (False, True, True, True)
    assert sealed_between_ends(np.tile(NOT_BACK, (2, 1)), joined=True)


def test_corners_do_not_leak():
    assert ends_and_cell(drawn("#.#.", ".#.#", "#.#.", ".#.#")) == (True, True, True, True)


@pytest.mark.parametrize("seed", [211, 223, 227, 229])
def test_what_is_open_on_and_on_is_open_between_ends(seed):
    random = np.random.default_rng(seed)
    for _ in range(200):
        gap = (random.random((7, 9)) < 0.62).astype(float)
        ends_x, ends_y, cell_x, cell_y = ends_and_cell(gap)
        assert ends_x <= cell_x
        assert ends_y <= cell_y
        assert (not ends_x) >= (not sealed_between_ends(np.tile(gap, (3, 1)), joined=True))


def truncated(depths):
    """Contacts of depths of which all up to the load are closed, and nothing else moves."""

    def at(load, _start):
        gap = np.maximum(depths - load, 0.0)
        return SimpleNamespace(gap=gap, area_fraction=float((gap == 0).mean()))

    return at


def test_an_egg_box_cut_off_seals_at_half_of_contact():
    n = 128
    x = np.cos(2 * np.pi * (np.arange(n) + 0.5) / n)
    found = thresholds(truncated(1.5 + np.add.outer(x, x) / 2), 0.7, 3.0, precision=1e-4)
    assert len(found) == 4
    for threshold in found:
        assert threshold.bracketed
        assert threshold.load == pytest.approx(1.5, rel=2e-3)
        assert threshold.area_fraction == pytest.approx(0.5, abs=2 / n)
        assert threshold.open.load < threshold.sealed.load <= 1.0001 * threshold.open.load


def test_ridges_seal_across_at_the_first_touch_and_along_in_full_contact():
    """Full contact of a wave z = D cos 2πx/λ begins at P = πE*D/λ (Westergaard)."""
    n, modulus, depth = 32, 1e7, 1e-7
    heights = depth * np.repeat(np.cos(2 * np.pi * np.arange(n) / n)[:, None], 4, axis=1)
    press = Press(heights, (1e-6, 1e-6), modulus)
    full = math.pi * modulus * depth / (n * 1e-6)
    at = lambda load, start: press.at(load, start=start)  # noqa: E731
    across, along, *cell = thresholds(at, 0.1 * full, modulus)
    assert across.open is None
    assert across.load == 0.0
    assert along.open.load <= 1.01 * full
    assert along.sealed.load >= 0.95 * full
    assert along.area_fraction > 0.9
    assert [one.load for one in cell] == [across.load, along.load]
    across, along, *_ = thresholds(at, 0.1 * full, 0.5 * full)
    assert along.sealed is None
    assert along.open.load == 0.5 * full
    assert along.load == math.inf
    assert not along.bracketed


def test_a_flat_surface_is_sealed_under_any_load():
    press = Press(np.zeros((8, 8)), (1e-6, 1e-6), 1e7)
    found = thresholds(lambda load, start: press.at(load, start=start), 1e3, 1e7)
    assert [one.open for one in found] == [None] * 4
    assert [one.area_fraction for one in found] == [0.0] * 4


def test_a_plastic_surface_is_sealed_at_its_hardness_at_the_latest():
    random = np.random.default_rng(233)
    press = Press(1e-6 * random.normal(size=(16, 16)), (1e-6, 1e-6), 1e11, hardness=1e9)
    for threshold in thresholds(lambda load, start: press.at(load, start=start), 1e8, 1e9):
        assert threshold.sealed is not None
        assert threshold.sealed.load <= 1e9
        assert 0.2 < threshold.area_fraction < 0.8


@pytest.mark.parametrize(("begin", "most"), [(0.0, 1.0), (2.0, 1.0), (-1.0, 1.0), (math.nan, 1.0)])
def test_loads_that_make_no_sense_are_refused(begin, most):
    with pytest.raises(InputError, match="give 0 < first <= largest"):
        thresholds(truncated(np.zeros((4, 4))), begin, most)


def test_what_each_end_reaches():
    gap = drawn("..#.", ".###", "##.#", "#.##", "..##", "#.##")
    gap[2, 2] = 1.0
    found = pools(gap)
    assert found[0].tolist() == [Pool.INLET, Pool.INLET, Pool.CONTACT, Pool.INLET]
    assert found[1, 0] == Pool.INLET
    assert found[2, 2] == Pool.ISOLATED
    assert found[3:, 1].tolist() == [Pool.OUTLET] * 3
    assert (found == 0).sum() == (gap == 0).sum()
    gap[2, 0] = gap[3, 0] = 1.0
    assert pools(gap)[4, 1] == Pool.THROUGH


def test_the_narrowest_place_of_the_widest_path():
    gap = np.zeros((8, 10))
    gap[:, 2], gap[:, 7] = 2.0, 5.0
    gap[3, 2], gap[5, 7] = 1.0, 0.4
    found = constriction(gap)
    assert (found.gap, found.node) == (1.0, (3, 2))
    gap[3, 2] = 0.0
    found = constriction(gap)
    assert (found.gap, found.node) == (0.4, (5, 7))
    gap[5, 7] = 0.0
    assert constriction(gap) is None


def test_a_wall_at_the_joint_is_stated_from_one_inside():
    gap = np.ones((64, 64))
    gap[0] = 0.0
    assert joint_seals(gap) == (True, False)
    assert joint_seals(gap.T) == (False, True)
    assert joint_seals(np.roll(gap, 20, axis=0)) == (False, False)
    assert joint_seals(np.ones((64, 64))) == (False, False)
