"""Tables of flow factors: interpolation, thick films, sealing, and files."""

import dataclasses

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.table.factor_table import relative_row, relative_rows
from roughfilm.rom.homogenization.table.separation import Separations
from roughfilm.rom.homogenization.table.store import known_points, load_table, save_table
from roughfilm.rom.homogenization.table.tabulate import tabulate

SPACING = (1e-6, 2e-6)
RANDOM = np.random.default_rng(20071)


def surface(shape=(48, 32), seed=29):
    random = np.random.default_rng(seed)
    q = np.hypot(shape[0] * np.fft.fftfreq(shape[0])[:, None], shape[1] * np.fft.rfftfreq(shape[1]))
    spectrum = np.where((q > 0) & (q < min(shape) / 4), np.maximum(q, 3.0) ** -1.8, 0)
    height = np.fft.irfft2(np.fft.rfft2(random.normal(size=shape)) * spectrum, s=shape)
    return 1e-6 * height / height.std()


HEIGHTS = surface()


@pytest.fixture(scope="module")
def table():
    return tabulate(HEIGHTS, SPACING, tolerance=0.005)


@pytest.fixture
def inputs():
    return Inputs(heights=HEIGHTS, spacing=SPACING, settings={"rule": "linear", "code": "1"})


def cell(mean_gap):
    body = Separations(heights=HEIGHTS)
    return flow_factors(body.gap(body.at_mean_gap(mean_gap)), SPACING, tolerance=1e-9)


def test_the_gap_at_a_separation_has_the_mean_gap_asked_for():
    body = Separations(heights=HEIGHTS)
    for mean_gap in (1e-9, 1e-7, 1e-6, 2.5e-6, 4e-5):
        assert body.gap(body.at_mean_gap(mean_gap)).mean() == pytest.approx(mean_gap, rel=1e-9)
    assert body.at_mean_gap(1e-4) == pytest.approx(1e-4, rel=1e-9)  # without contact they are equal
    with pytest.raises(InputError, match="give 1e-15"):
        body.at_mean_gap(0.0)


def test_sealing_separations_are_the_last_heights_without_a_path():
    body = Separations(heights=HEIGHTS)
    above = np.unique(HEIGHTS - HEIGHTS.mean())
    for direction, separation in enumerate(body.sealing()):
        rank = np.searchsorted(above, separation)
        assert above[rank] == separation
        for height, shut in ((separation, True), (above[rank + 1], False)):
            assert flow_factors(body.gap(height), SPACING).factors.sealed[direction] is shut


def test_interpolation_keeps_its_tolerance_between_points(table):
    assert table.interpolation_error <= 0.005
    for mean_gap in np.exp(RANDOM.uniform(np.log(table.narrowest), np.log(4 * table.widest), 30)):
        one = cell(float(mean_gap))
        own, uncertainty = one.factors.relative, one.uncertainty
        row = relative_rows(table, np.array([mean_gap]))[0]
        off = np.abs(row[:4] - [own.pressure[0, 0], own.pressure[1, 1], own.pressure[0, 1], own.shear[0]])
        a = uncertainty.pressure / mean_gap**3
        allowed = 0.0075 * np.array([own.pressure[0, 0], own.pressure[1, 1], own.pressure[0, 0], own.shear[0]]) + 2e-4
        uncertain = np.array([a[0, 0], a[1, 1], a[0, 1], uncertainty.shear[0] / mean_gap])
        assert (off <= allowed + uncertain).all()


def test_slopes_are_the_derivatives_of_the_factors(table):
    body = Separations(heights=HEIGHTS)
    for point in (table.points[len(table.points) // 2], table.points[-3]):
        rows = []
        for step in (-2e-4, 2e-4):
            gap = body.gap(point.separation + step * point.mean_gap)
            rows.append((gap.mean(), relative_row(flow_factors(gap, SPACING, tolerance=1e-10).factors)))
        (before, first), (after, last) = rows
        found = (last - first) / np.log(after / before)
        known = 7 if point.contact == 0 else 5
        assert np.isfinite(point.slopes).sum() == known
        assert point.slopes[:known] == pytest.approx(found[:known], rel=2e-3, abs=2e-4)


def test_the_uncertainty_of_friction_includes_its_interpolation():
    place = 2 * np.pi * np.arange(64) / 64
    heights = 1e-6 * np.add.outer(np.sin(place), np.sin(2 * place))  # smooth: little error of the grid
    table = tabulate(heights, (1e-6, 1e-6))
    covered = []
    for mean_gap in np.geomspace(1.02 * table.peak, table.widest, 31):
        exact = flow_factors(mean_gap - heights, (1e-6, 1e-6), tolerance=1e-9).factors
        found = table(np.array([mean_gap]))
        error = abs((found.couette + 3 * found.shear_couette)[0] / (exact.couette + 3 * exact.shear_couette) - 1)
        covered.append(error <= table.friction_uncertainty(float(mean_gap)))
    assert np.mean(covered) >= 0.95


def test_flow_falls_as_the_gap_closes_and_ends_where_it_is_sealed(table):
    gaps = np.geomspace(0.5 * table.narrowest, 3 * table.widest, 400)
    factors = table(gaps)
    assert (np.diff(factors.along) >= 0).all()
    assert (np.diff(factors.across) >= 0).all()
    below = gaps < table.narrowest
    assert not factors.along[below].any()
    assert not factors.across[below].any()
    assert not factors.drag[below].any()
    assert (factors.along * factors.across - factors.cross**2 >= -1e-12 * factors.along * factors.across).all()


def test_the_effect_of_roughness_falls_with_the_square_of_thick_gaps(table):
    row = relative_rows(table, 1e-6 * np.array([1e3, 2e3]))
    assert (1 - row[0, 0]) / (1 - row[1, 0]) == pytest.approx(4, rel=1e-6)
    one = cell(3e-4).factors.relative
    assert 1 - relative_rows(table, np.array([3e-4]))[0, 0] == pytest.approx(1 - one.pressure[0, 0], rel=0.05)


def test_the_surface_with_its_heights_multiplied(table):
    twice = table.scaled(2.0)
    gaps = np.array([1.1e-6, 3e-6])
    assert np.allclose(relative_rows(twice, 2 * gaps), relative_rows(table, gaps), rtol=1e-12)
    assert twice(2 * gaps).along == pytest.approx(8 * table(gaps).along)
    assert twice(np.array([1e-5])).least == pytest.approx(1e-5 - 2 * (HEIGHTS.max() - HEIGHTS.mean()))


def test_gaps_below_an_open_table_are_refused(table):
    cut = dataclasses.replace(table, points=table.points[len(table.points) // 2 :])
    with pytest.raises(InputError, match="reaches further"):
        cut(np.array([0.5 * cut.narrowest]))


def test_smaller_tolerances_only_add_points(table):
    finer = tabulate(HEIGHTS, SPACING, tolerance=0.0015, known=table.points)
    before = {point.separation for point in table.points}
    assert len(finer.points) > len(before)
    assert len(before & {point.separation for point in finer.points}) >= 0.9 * len(before)


def test_a_smooth_wall_and_an_invalid_tolerance_are_refused():
    with pytest.raises(InputError, match="all the same"):
        tabulate(np.ones((8, 8)), SPACING)
    with pytest.raises(InputError, match=r"^tolerance: got"):
        tabulate(HEIGHTS, SPACING, tolerance=0.0)
    with pytest.raises(InputError, match="nan"):
        tabulate(np.where(np.arange(HEIGHTS.size).reshape(HEIGHTS.shape) == 7, np.nan, HEIGHTS), SPACING)


def test_a_file_gives_the_table_back(table, inputs, tmp_path):
    path = tmp_path / "F.h5"
    save_table(path, inputs, table)
    gaps = np.geomspace(table.narrowest, 2 * table.widest, 50)
    assert np.array_equal(relative_rows(load_table(path), gaps), relative_rows(table, gaps))
    known = known_points(path, inputs)
    assert len(known) == len(table.points)
    pairs = zip(known, table.points, strict=True)
    assert all(one.uncertainty.shear[1] == other.uncertainty.shear[1] for one, other in pairs)
    pairs = zip(known, table.points, strict=True)
    assert all(np.array_equal(one.slopes, other.slopes, equal_nan=True) for one, other in pairs)


def test_points_already_known_are_not_solved_again(table, inputs, tmp_path):
    save_table(tmp_path / "F.h5", inputs, table)
    solved = []
    again = tabulate(
        HEIGHTS, SPACING, tolerance=0.005, known=known_points(tmp_path / "F.h5", inputs), keep=solved.append
    )
    assert not solved
    assert len(again.points) == len(table.points)


def test_files_of_other_tables_and_damaged_files_are_errors(table, inputs, tmp_path):
    path = tmp_path / "F.h5"
    assert not known_points(path, inputs)
    path.touch()
    assert not known_points(path, inputs)
    save_table(path, inputs, table)
    with pytest.raises(InputError, match="another surface"):
        known_points(path, dataclasses.replace(inputs, heights=2 * HEIGHTS))
    with pytest.raises(InputError, match="with rule linear, not harmonic"):
        known_points(path, dataclasses.replace(inputs, settings={"rule": "harmonic", "code": "1"}))
    with pytest.raises(InputError, match="another version"):
        known_points(path, dataclasses.replace(inputs, settings={"rule": "linear", "code": "2"}))
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)
    with pytest.raises(InputError, match="was damaged"):
        known_points(path, inputs)
    path.write_bytes(b"something else")
    with pytest.raises(InputError, match="is no table"):
        load_table(path)
    for missing in (tmp_path / "none.h5", tmp_path):
        with pytest.raises(InputError, match=r"no such file|is no file, but a directory"):
            load_table(missing)


def heights_of(kind):
    place = np.arange(24) / 24
    random = np.random.default_rng(31).normal(size=(24, 24))
    return (
        1e-6
        * {
            "plateau": np.minimum(random, 0),
            "pit": -1.0 * (np.arange(576).reshape(24, 24) == 100),
            "spike": 1.0 * (np.arange(576).reshape(24, 24) == 100),
            "two levels": 1.0 * (random > 0),
            "lines": np.tile(np.sin(2 * np.pi * place)[:, None], (1, 24)),
            "crossed": np.add.outer(np.sin(2 * np.pi * place), np.sin(4 * np.pi * place)),
            "one deep pit": random - 1e5 * (np.arange(576).reshape(24, 24) == 100),
        }[kind]
    )


@pytest.mark.parametrize("kind", ["plateau", "pit", "spike", "two levels", "lines", "crossed", "one deep pit"])
def test_tables_of_awkward_surfaces_stay_within_their_errors(kind):
    heights = heights_of(kind)
    table = tabulate(heights, (1e-6, 1e-6), tolerance=0.02)
    assert len(table.points) <= 401
    assert np.isfinite(table.interpolation_error)
    assert table.relative_uncertainty >= table.interpolation_error
    body = Separations(heights=heights)
    gaps = np.exp(RANDOM.uniform(np.log(2 * table.narrowest), np.log(table.widest), 12))
    for mean_gap in gaps:
        one = flow_factors(body.gap(body.at_mean_gap(float(mean_gap))), (1e-6, 1e-6), tolerance=1e-9)
        own, uncertainty = one.factors.relative, one.uncertainty
        row = relative_rows(table, np.array([mean_gap]))[0]
        for index, value, uncertain in (
            (0, own.pressure[0, 0], uncertainty.pressure[0, 0]),
            (1, own.pressure[1, 1], uncertainty.pressure[1, 1]),
        ):
            room = 3 * max(table.interpolation_error, 0.02) * (value + 1e-4) + uncertain / mean_gap**3
            assert abs(row[index] - value) <= room


def test_oblique_grooves_have_no_flow_across_them_between_points():
    place = 2 * np.pi * np.arange(32) / 32
    table = tabulate(1e-6 * np.sin(np.add.outer(place, place)), (1e-6, 1e-6))
    gaps = np.geomspace(table.narrowest, 1e-7, 60)[1:]
    factors = table(gaps)
    across = (factors.along + factors.across + 2 * factors.cross) / 2  # flow along (1, 1) for grooves along (1, -1)
    assert (np.abs(across) <= 0.01 * factors.along).all()


def test_a_negligible_film_is_open_and_its_uncertainty_covers_its_flow():
    gap = np.full((32, 32), 1e-8)
    gap[8:16, 8:16] = 1e-3
    flow = flow_factors(gap, (1e-6, 1e-6))
    assert flow.factors.sealed == (False, False)
    truth = (
        flow_factors(1e5 * np.minimum(gap, 1e-6), (1e-6, 1e-6)).factors.pressure[0, 0] / 1e15
    )  # a shallower pit: less
    assert flow.factors.pressure[0, 0] == 0
    assert truth < 2e-24 < flow.uncertainty.pressure[0, 0]


@pytest.mark.parametrize(
    ("gap", "options", "words"),
    [
        (np.full((8, 8), 1e150), {}, "look at the unit"),
        (np.full((8, 8), 1e-120), {}, "look at the unit"),
        (np.ones((8, 8)), {"tolerance": 0.0}, "tolerance"),
        (np.ones((8, 8)), {"tolerance": np.nan}, "tolerance"),
        (np.ma.masked_array(np.ones((8, 8)), mask=np.eye(8)), {}, "masked"),
    ],
)
def test_invalid_gaps_and_tolerances_are_refused(gap, options, words):
    with pytest.raises(InputError, match=words):
        flow_factors(gap, (1.0, 1.0), **options)


@pytest.mark.parametrize("spacing", [1.0, (1.0, 1e9), (1.0,)])
def test_invalid_spacings_are_refused(spacing):
    with pytest.raises(InputError, match="spacing"):
        flow_factors(np.ones((8, 8)), spacing)


def test_factors_beyond_all_numbers_are_one_line(table):
    first, *others = table.points
    factors = dataclasses.replace(first.factors, shear=np.array([1e306, 0.0]))
    with pytest.raises(ConvergenceError, match="flow factors: its numbers overflow"):
        dataclasses.replace(table, points=[dataclasses.replace(first, factors=factors), *others])(np.array([1e-6]))
