"""One table of a surface from thick films to crushed asperities: what asperities carry, and what flows between them."""

import dataclasses

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.mechanics.exact.westergaard import Westergaard
from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.mixed.patir_cheng_table import patir_cheng_table
from roughfilm.rom.bearing.mixed.tabulate import tabulate_pressed
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.table import store
from roughfilm.rom.homogenization.table.store import load_table, save_table

MODULUS, HARDNESS = 200e9, 4e9
RANDOM = np.random.default_rng(53)
SIDE = 48
SPACING = (2e-6, 1.5e-6)


def rough() -> np.ndarray:
    """Waves of eight nodes and more, Sq 0.5 µm, with ridges that lie rather along y."""
    waves = np.fft.rfftfreq(SIDE) * SIDE
    qx, qy = np.meshgrid(np.fft.fftfreq(SIDE) * SIDE, waves, indexing="ij")
    size = np.where((np.hypot(qx, 2 * qy) <= 6) & (np.hypot(qx, qy) > 0), 1.0, 0.0)
    heights = np.fft.irfft2(size * np.exp(2j * np.pi * RANDOM.random(qx.shape)), s=(SIDE, SIDE))
    return 0.5e-6 * heights / heights.std()


HEIGHTS = rough()


def zoom(heights: np.ndarray, times: int) -> np.ndarray:
    """The same waves on more nodes."""
    waves = np.fft.fftshift(np.fft.fft2(heights))
    more = SIDE * (times - 1) // 2
    return np.fft.ifft2(np.fft.ifftshift(np.pad(waves, more))).real * times**2


@pytest.fixture(scope="module")
def table():
    return tabulate_pressed(HEIGHTS, SPACING, MODULUS, hardness=HARDNESS, tolerance=0.02)


@pytest.fixture(scope="module")
def elastic():
    return tabulate_pressed(HEIGHTS, SPACING, MODULUS, loads=[1e7, 1e8, 1e9], tolerance=0.05)


def test_all_is_continuous_through_the_first_touch(table):
    step = 1e-9 * table.touching
    above, below = (table(np.array([table.touching + way * step])) for way in (1, -1))
    for name in ("along", "across", "drag", "couette", "shear_couette"):
        assert getattr(below, name) == pytest.approx(getattr(above, name), rel=1e-6)
    assert table.contact_pressure(np.array([table.touching, 2 * table.touching])).tolist() == [0, 0]
    assert 0 < table.contact_pressure(np.array([table.touching - step]))[0] < 1e-6 * table.largest_pressure
    assert table.mean_gap(np.array([table.touching - step])) == pytest.approx(table.touching, rel=1e-6)


def test_contact_pressure_rises_strictly_as_the_bodies_approach(table):
    alpha = np.linspace(table.closest, table.touching, 4001)
    assert (np.diff(table.contact_pressure(alpha)) < 0).all()
    assert (np.diff(table.area_fraction(alpha)) < 0).all()
    assert (np.diff(table.mean_gap(alpha)) > 0).all()
    assert table.contact_pressure(alpha[:1]) == pytest.approx(table.largest_pressure, rel=1e-9)


def test_flow_across_the_ridges_falls_with_load_until_it_is_sealed(table):
    pressed = sorted((point for point in table.factors.points if point.load), key=lambda point: point.load)
    across = np.array([point.factors.pressure[0, 0] for point in pressed])
    assert (np.diff(across) <= 0).all()
    assert across[-1] == 0
    assert pressed[-1].factors.sealed[0]


def test_interpolation_between_loads_agrees_with_contact_and_cell_problem(table):
    press = Press(HEIGHTS, SPACING, MODULUS, hardness=HARDNESS)
    peak = HEIGHTS.max() - HEIGHTS.mean()
    for load in (3.3e6, 4.7e7, 6.1e8):
        contact = press.at(load, tolerance=1e-10)
        alpha = np.array([peak - contact.approach])
        assert table.contact_pressure(alpha) == pytest.approx(load, rel=float(table.pressure_uncertainty(alpha)[0]))
        assert table.separation_at(load) == pytest.approx(alpha[0], abs=0.04 * HEIGHTS.std())
        assert table.mean_gap(alpha) == pytest.approx(contact.mean_gap, rel=0.01)
        assert table.area_fraction(alpha) == pytest.approx(contact.area_fraction, rel=0.1, abs=2 / SIDE**2)
        own, interpolated = flow_factors(contact.gap, SPACING).factors, table(alpha)
        size = own.mean_gap**3
        assert interpolated.along[0] / size == pytest.approx(own.pressure[0, 0] / size, abs=0.03)
        assert interpolated.across[0] / size == pytest.approx(own.pressure[1, 1] / size, rel=0.03)
        assert interpolated.cross[0] / size == pytest.approx(own.pressure[0, 1] / size, abs=0.03)
        assert interpolated.drag[0] == pytest.approx(own.shear[0], rel=0.03)


def test_the_uncertainty_of_the_pressure_covers_a_finer_grid():
    fine = zoom(HEIGHTS, 4)
    press = Press(fine, (SPACING[0] / 4, SPACING[1] / 4), MODULUS, hardness=HARDNESS)
    table = tabulate_pressed(HEIGHTS, SPACING, MODULUS, hardness=HARDNESS, loads=[2e7, 2e8, 1e9], tolerance=0.05)
    for load in (2.7e7, 9e7, 5e8):
        alpha = np.array([fine.max() - fine.mean() - press.at(load, tolerance=1e-6).approach])
        off = abs(table.contact_pressure(alpha)[0] / load - 1)
        assert off < table.pressure_uncertainty(alpha)[0] < 1


def test_the_separation_at_a_pressure_is_the_inverse(table):
    for load in np.geomspace(1e-3 * table.factors.points[0].load, table.largest_pressure, 9):
        assert table.contact_pressure(np.array([table.separation_at(load)])) == pytest.approx(load, rel=1e-9)


def test_the_mean_gap_is_the_separation_where_nothing_is_plastic(elastic):
    alpha = np.linspace(elastic.closest, 2 * elastic.touching, 60)
    assert elastic.mean_gap(alpha) == pytest.approx(alpha, rel=1e-6)


def test_plastic_asperities_leave_a_mean_gap_above_the_separation(table):
    alpha = np.array([table.closest])
    sunk = Press(HEIGHTS, SPACING, MODULUS, hardness=HARDNESS).at(table.largest_pressure).plastic_displacement.mean()
    assert table.mean_gap(alpha) - alpha == pytest.approx(sunk, rel=1e-3)


def test_a_single_wave_carries_what_westergaard_says():
    place = np.arange(64) / 64
    heights = np.tile(1e-6 * np.cos(2 * np.pi * place)[:, None], (1, 8))
    spacing = (100e-6 / 64, 100e-6 / 8)
    table = tabulate_pressed(heights, spacing, MODULUS, loads=np.geomspace(0.02, 0.6, 5) * 2e9 * np.pi, tolerance=0.02)
    pressure = 0.2 * 2e9 * np.pi
    result = table.area_fraction(np.array([table.separation_at(pressure)]))
    exact = Westergaard(amplitude=1e-6, wavelength=100e-6, composite_modulus=MODULUS, load=pressure).area_fraction
    assert result == pytest.approx(exact, abs=2 / 64)


def test_the_pressures_on_the_spots_are_those_of_westergaard():
    nodes, loads = 128, np.geomspace(0.02, 0.6, 9) * 2e9 * np.pi
    heights = np.tile(1e-6 * np.cos(2 * np.pi * np.arange(nodes) / nodes)[:, None], (1, 16))
    table = tabulate_pressed(heights, (100e-6 / nodes, 1e-6), MODULUS, loads=loads, tolerance=0.02)
    for load in (0.1 * 2e9 * np.pi, 0.5 * 2e9 * np.pi):
        exact = Westergaard(amplitude=1e-6, wavelength=100e-6, composite_modulus=MODULUS, load=load)
        spots = table.spot_pressures(table.separation_at(load))
        assert spots.peak == pytest.approx(float(exact.pressure(0.0)), rel=0.01)
        assert spots.mean == pytest.approx(load / exact.area_fraction, rel=0.07)
        assert spots.composite_modulus == MODULUS
    parted = table.spot_pressures(1.01 * table.touching)
    assert (parted.mean, parted.peak) == (0, 0)


@pytest.mark.parametrize("ask", ["__call__", "contact_pressure", "mean_gap", "area_fraction", "pressure_uncertainty"])
def test_separations_below_the_largest_load_are_refused(elastic, ask):
    with pytest.raises(InputError, match=r"it must be at least .* where the contact pressure is 1e\+09 Pa"):
        getattr(elastic, ask)(np.array([0.9 * elastic.closest]))


def test_pressures_outside_the_table_have_no_separation(elastic):
    for pressure in (0.0, -1.0, 1.1e9, np.nan):
        with pytest.raises(InputError, match="make a table with larger loads"):
            elastic.separation_at(pressure)


def test_a_table_is_extended_and_nothing_known_is_solved_again(elastic):
    solved = []
    further = tabulate_pressed(
        HEIGHTS,
        SPACING,
        MODULUS,
        loads=[1e7, 1e8, 1e9],
        required_load=2e9,
        tolerance=0.05,
        known=elastic.factors.points,
        keep=solved.append,
    )
    assert further.largest_pressure == 2e9
    assert solved
    assert all(1e9 < point.load <= 2e9 for point in solved)


def test_two_threads_make_the_same_table(elastic):
    both = tabulate_pressed(HEIGHTS, SPACING, MODULUS, loads=[1e7, 1e8, 1e9], tolerance=0.05, threads=2)
    alpha = np.linspace(elastic.closest, 3 * elastic.touching, 50)
    assert np.array_equal(both.contact_pressure(alpha), elastic.contact_pressure(alpha))
    assert np.array_equal(both(alpha).across, elastic(alpha).across)


def test_a_table_is_read_back_from_its_file(elastic, tmp_path):
    inputs = Inputs(heights=HEIGHTS, spacing=SPACING, settings={"composite_modulus": MODULUS})
    save_table(tmp_path / "T.h5", inputs, elastic.factors)
    again = AsperityTable(factors=load_table(tmp_path / "T.h5"))
    alpha = np.linspace(elastic.closest, 3 * elastic.touching, 50)
    assert np.array_equal(again.contact_pressure(alpha), elastic.contact_pressure(alpha))
    assert np.array_equal(again(alpha).along, elastic(alpha).along)
    assert np.array_equal(again.pressure_uncertainty(alpha), elastic.pressure_uncertainty(alpha))
    assert again.spot_pressures(alpha[0]) == elastic.spot_pressures(alpha[0])


def test_a_table_of_an_older_version_has_no_peak_but_a_mean(tips, tmp_path, monkeypatch):
    with monkeypatch.context() as older:
        older.delitem(store.NUMBERS, "peak_pressure")
        path = tips.stored(tmp_path / "T.h5", modulus=1e9, peak=2e9)
    spots = AsperityTable(factors=load_table(path)).spot_pressures(tips.closest)
    assert np.isnan(spots.peak)
    assert spots.warnings == ()
    assert spots.mean == pytest.approx(1e9)
    assert len(spots.outside) == 1


def test_a_hardness_at_which_no_load_moves_the_walls_is_an_error():
    with pytest.raises(ConvergenceError, match=r"^asperities: loads of .* close the gap equally; .* of 0\.0001 Pa"):
        tabulate_pressed(HEIGHTS[::3, ::3], (6e-6, 4.5e-6), MODULUS, hardness=1e-4, tolerance=0.05)


def test_a_table_without_loads_is_refused(elastic):
    points = [point for point in elastic.factors.points if not point.load]
    with pytest.raises(InputError, match="has 0 points under load"):
        AsperityTable(factors=dataclasses.replace(elastic.factors, points=points))


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ({"loads": [1e6]}, "two or more"),
        ({"loads": [1e6, -1e6]}, "two or more"),
        ({"loads": [1e6, np.nan]}, "two or more"),
        ({"loads": [1e6, 5e9], "hardness": HARDNESS}, "must not exceed the hardness of 4e\\+09 Pa"),
        ({"required_load": 5e9, "hardness": HARDNESS}, "must not exceed the hardness"),
        ({"loads": [1e6, 1e13]}, "closes the gap everywhere"),
    ],
)
def test_loads_out_of_range_are_refused(how, words):
    with pytest.raises(InputError, match=words):
        tabulate_pressed(HEIGHTS, SPACING, MODULUS, tolerance=0.5, **how)


def test_patir_and_cheng_agree_on_longitudinal_ridges_and_have_no_oblique_flow(table):
    ridges = np.tile(0.5e-6 * np.sin(2 * np.pi * np.arange(32) / 32), (8, 1))
    straight = tabulate_pressed(ridges, SPACING, MODULUS, loads=[1e8, 1e9], tolerance=0.05)
    same = patir_cheng_table(straight, Press(ridges, SPACING, MODULUS))
    alpha = np.array([point.separation for point in straight.factors.points])  # between them only one has slopes
    for name in ("along", "across", "drag"):
        assert getattr(same(alpha), name) == pytest.approx(getattr(straight(alpha), name), rel=1e-6, abs=1e-30)
    oblique = patir_cheng_table(table, Press(HEIGHTS, SPACING, MODULUS, hardness=HARDNESS))
    open_film = np.array([2 * table.touching])
    assert abs(table(open_film).cross[0]) > 0
    assert oblique(open_film).cross[0] == 0
    assert np.array_equal(oblique.contact_pressure(open_film / 3), table.contact_pressure(open_film / 3))
