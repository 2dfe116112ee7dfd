"""Mean flow factors over windows: equal windows, sealed ones, bounds, and the scatter against very many windows."""

import numpy as np
import pytest
from window_sets import surface_of_seed

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.factors import relative_quantities
from roughfilm.rom.homogenization.table.factor_table import relative_row, relative_rows
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.homogenization.table.store import load_table, save_table
from roughfilm.rom.homogenization.table.tabulate import point_of, tabulate
from roughfilm.rom.homogenization.table.windows import factor_averages, mean_point, tabulate_windows

SPACING = surface_of_seed(1).spacing


def point_at(heights, mean_gap):
    body = Separations(heights=heights)
    separation = body.at_mean_gap(mean_gap)
    return point_of(body.gap(separation), SPACING, separation, rule=FaceRule.LINEAR, deformed=False)


@pytest.fixture(scope="module")
def cells():
    return [surface_of_seed(seed, 24).heights for seed in (1, 2, 3, 4)]


@pytest.fixture(scope="module")
def table(cells):
    return tabulate_windows(cells, SPACING, tolerance=0.02)


def test_equal_windows_give_the_table_of_one_of_them_without_scatter(cells):
    plain = tabulate(cells[0], SPACING, tolerance=0.02)
    equal = tabulate_windows([cells[0]] * 3, SPACING, tolerance=0.02)
    assert (equal.peak, equal.rms) == pytest.approx((plain.peak, plain.rms), rel=1e-14)
    for one, two in zip(plain.points, equal.points, strict=True):
        assert two.mean_gap == pytest.approx(one.mean_gap, rel=1e-12)
        assert relative_row(two.factors) == pytest.approx(relative_row(one.factors), rel=1e-9, abs=1e-12)
        assert two.uncertainty.pressure == pytest.approx(one.uncertainty.pressure, rel=1e-6, nan_ok=True)
        assert two.factors.sealed == one.factors.sealed
        assert two.slopes == pytest.approx(one.slopes, rel=1e-6, abs=1e-9, nan_ok=True)
        assert np.nan_to_num(two.scatter.mean.relative.shear) == pytest.approx(0.0, abs=1e-12)


def test_a_point_is_the_mean_of_the_windows_at_its_mean_gap(cells, table):
    for point in (table.points[2], table.points[-3]):
        own = [point_at(cell, point.mean_gap) for cell in cells]
        assert relative_row(point.factors) == pytest.approx(
            np.mean([relative_row(one.factors) for one in own], axis=0), rel=1e-9, abs=1e-12
        )
        assert point.contact == pytest.approx(np.mean([one.contact for one in own]))


def test_the_table_begins_where_every_window_is_sealed_and_interpolates_the_means(cells, table):
    assert table.points[0].factors.sealed == (True, True)
    assert not any(table.points[1].factors.sealed)
    assert table.interpolation_error <= 0.02
    between = 0.2e-6
    mean = np.mean([relative_row(point_at(cell, between).factors) for cell in cells], axis=0)
    assert relative_rows(table, np.array([between]))[0][:5] == pytest.approx(mean[:5], abs=0.02)


def test_the_mean_pressure_factors_stay_positive_semidefinite(table):
    for point in table.points:
        assert np.linalg.eigvalsh(point.factors.pressure).min() >= -1e-12 * point.mean_gap**3


def test_a_sealed_window_counts_with_a_factor_of_zero(cells):
    walled = cells[0].copy()
    walled[:, 0] = walled[0, :] = walled.max() + 1e-7
    points = [point_at(cell, 0.3e-6) for cell in (*cells, walled)]
    assert points[-1].factors.sealed == (True, True)
    found = mean_point(points, 0.3e-6)
    assert found.factors.sealed == (False, False)
    assert found.factors.pressure[0, 0] == pytest.approx(sum(one.factors.pressure[0, 0] for one in points[:4]) / 5)
    averages = factor_averages([one.factors for one in points])
    assert averages["A11"].zeros == 0.2
    assert averages["A11"].interval[0] == 0.0


def test_files_keep_the_scatter(table, tmp_path):
    inputs = Inputs(heights=np.zeros((2, 2)), spacing=SPACING, settings={})
    save_table(tmp_path / "t.h5", inputs, table)
    again = load_table(tmp_path / "t.h5")
    for one, two in zip(table.points, again.points, strict=True):
        for part in ("mean", "low", "high"):
            for name in ("pressure", "shear", "couette"):
                kept, made = (getattr(getattr(point.scatter, part), name) for point in (one, two))
                assert made == pytest.approx(kept, nan_ok=True, rel=0, abs=0)
    assert again.scatter_above(1e-6) == table.scatter_above(1e-6) > 0


def test_known_points_are_not_solved_again(cells, table):
    new = []
    again = tabulate_windows(cells, SPACING, tolerance=0.02, known=table.points[:5], keep=new.append)
    assert len(new) <= len(table.points) - 5
    assert [one.mean_gap for one in again.points] == [one.mean_gap for one in table.points]


def test_flat_windows_are_refused(cells):
    with pytest.raises(InputError, match="1 of 2 windows are flat"):
        tabulate_windows([cells[0], np.zeros((24, 24))], SPACING)


def test_the_scatter_of_eight_windows_covers_the_mean_of_very_many():
    """The mean over 160 seeds stands for the truth; 20 sets of 8 of them each are compared with it."""
    points = [point_at(surface_of_seed(seed, 24).heights, 0.2e-6) for seed in range(100, 260)]
    truth = relative_quantities(mean_point(points, 0.2e-6).factors, points[0].uncertainty)
    covered = []
    for first in range(0, 160, 8):
        found = mean_point(points[first : first + 8], 0.2e-6)
        values, halves = (relative_quantities(one, one) for one in (found.factors, found.scatter.mean))
        covered += [abs(values[name].value - truth[name].value) <= halves[name].value for name in ("A11", "A22", "B1")]
    assert len(covered) == 60
    assert 0.85 <= np.mean(covered) <= 1.0
