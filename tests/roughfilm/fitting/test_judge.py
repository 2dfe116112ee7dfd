"""Seeds of a fitted description scatter as windows that were not fitted, where the windows are random fields."""

import numpy as np
import pytest

from roughfilm.contact.fitting.structure import strongest_line
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.preparation.recipe import Recipe
from roughfilm.contact.preparation.window import Window
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.fitting.findings import Structure, findings_of, structure_of
from roughfilm.fitting.judge import Held, halves, held_out, interval_of
from roughfilm.fitting.quantities import NAMES, load_at_area, quantities_of
from roughfilm.fitting.run import fit_windows, overlap
from roughfilm.sampling.plan import Group, side_of_squares

COUNT = 32


def cell_of(seed: int) -> Surface:
    """A Gaussian field whose rms height differs from seed to seed by a lognormal factor."""
    rms_height = 1e-6 * float(np.exp(0.25 * np.random.default_rng([seed, 1]).standard_normal()))
    return gaussian(
        size=(1e-4, 1e-4),
        points=(32, 32),
        seed=seed,
        rms_height=rms_height,
        correlation_length=1.2e-5,
        amplitudes="random",
    )


def quiet(*_: object) -> None:
    """No progress."""


@pytest.fixture(scope="module")
def windows():
    cells = tuple(cell_of(seed) for seed in range(COUNT))
    load = load_at_area(cells, 0.1)
    return cells, load, np.array([quantities_of(cell, load) for cell in cells])


def test_seeds_hold_the_windows_of_a_random_field(windows):
    cells, load, values = windows
    held, inside = held_out(cells, values, load, parts=halves(COUNT, 0), seeds=60, independent=COUNT, progress=quiet)
    assert tuple(held) == NAMES
    for one in held.values():
        assert one.count == COUNT
        assert one.inside + one.below + one.above == COUNT
        assert one.inside >= 26  # of 32 at 95 %: fewer in one of 1000 samples
        assert not one.fails
        assert 0.5 < one.ratio < 2
    assert inside.sum(axis=0).tolist() == [one.inside for one in held.values()]


def test_a_random_field_lacks_nothing(windows):
    cells, load, values = windows
    group = Group(size=1e-4, cells=cells, independent=float(COUNT), rms_height=1e-6)
    found = findings_of(group, values, structure_of(cells, load, quiet))
    assert [one.name for one in found if one.lacking] == []
    assert [one.name for one in found] == ["spread"]


def test_grooves_are_named_with_their_wavelength():
    x = np.arange(32) / 8
    random = np.random.default_rng(2)
    shapes = [np.abs(np.sin(np.pi * (x + shift))) ** 0.7 for shift in random.uniform(size=16)]
    rough = [cell_of(seed).heights for seed in range(16)]
    cells = tuple(
        Surface(heights=3e-6 * shape[:, None] + 0.05 * z, spacing=(1e-6, 1e-6), periodic=True)
        for shape, z in zip(shapes, rough, strict=True)
    )
    load = load_at_area(cells, 0.1)
    values = np.array([quantities_of(cell, load) for cell in cells])
    found = findings_of(
        Group(size=3.2e-5, cells=cells, independent=16.0, rms_height=1e-6), values, structure_of(cells, load, quiet)
    )
    (grooves,) = (one for one in found if one.name == "grooves")
    assert grooves.lacking
    assert "waves of 8 µm along 90°" in grooves.text
    assert "locked" in grooves.text


def test_the_load_gives_the_mean_area(windows):
    cells, load, _ = windows
    areas = [Press(cell.heights, cell.spacing, 1.0).at(load).area_fraction for cell in cells[::2]]
    assert np.mean(areas) == pytest.approx(0.1, rel=0.1)


def test_the_interval_leaves_one_of_forty_on_each_side():
    values = np.arange(1.0, 400.0)  # 399 values: the ends are those of ranks 10 and 390
    assert interval_of(values) == pytest.approx((10.0, 390.0))
    assert interval_of(np.append(values, np.nan)) == interval_of(values)


def test_too_few_inside_fail_and_a_few_outside_do_not():
    def held(inside: int, count: int) -> Held:
        return Held(inside=inside, count=count, below=count - inside, above=0, interval=(0.0, 1.0), ratio=1.0)

    assert held(40, 48).fails
    assert not held(44, 48).fails
    assert not held(48, 48).fails
    assert not held(14, 16).fails  # as few of 16 are outside by chance


def test_halves_are_disjoint_and_the_same_for_a_seed():
    first, second = halves(17, 3)
    assert sorted([*first, *second]) == list(range(17))
    assert np.array_equal(first, halves(17, 3)[0])


def test_squares_fill_a_rectangle():
    assert side_of_squares((8.0, 6.0), 48) == pytest.approx(1.0)
    assert side_of_squares((6.0, 8.0), 12) == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("entries", "words"),
    [({"count": 15}, "windows: got 15"), ({"seeds": 39}, "seeds: got 39"), ({"area": 0.95}, "area: got 0.95")],
)
def test_numbers_out_of_range_are_refused(entries, words):
    surface = Surface(heights=1e-6 * np.random.default_rng(0).standard_normal((160, 160)), spacing=(1e-6, 1e-6))
    with pytest.raises(InputError, match=words):
        fit_windows(surface, Recipe(), progress=quiet, **entries)


def test_windows_that_share_points_are_known():
    def group(*starts: tuple[int, int]) -> Group:
        windows = tuple(Window(start=start, shape=(32, 32)) for start in starts)
        return Group(
            size=3.2e-5,
            cells=tuple(map(cell_of, range(len(starts)))),
            windows=windows,
            independent=2.0,
            rms_height=1e-6,
        )

    assert not overlap(group((0, 0), (32, 0), (0, 32)))
    assert overlap(group((0, 0), (31, 31)))
    assert not overlap(Group(size=1e-4, cells=(cell_of(0),), independent=1.0, rms_height=1e-6))


@pytest.mark.parametrize(("growth", "names"), [(0.03, ["drift", "spread"]), (0.0, ["spread"])])
def test_a_drift_of_the_rms_height_is_stated(growth, names):
    starts = [(32 * i, 32 * j) for i in range(5) for j in range(4)]
    cells = [cell_of(seed) for seed in range(20)]
    cells = [
        cell.with_heights(cell.heights / cell.heights.std() * np.exp(growth * i / 4 + 0.1 * np.sin(17 * seed)))
        for seed, (cell, (i, _)) in enumerate(zip(cells, starts, strict=True))
    ]
    group = Group(
        size=3.2e-5,
        cells=tuple(cells),
        windows=tuple(Window(start=start, shape=(32, 32)) for start in starts),
        independent=20.0,
        rms_height=1e-6,
    )
    nothing = Structure(
        line=strongest_line(cells),
        kurtosis=np.full((20, 2), 3.0),
        angles=np.zeros(20),
        flatness=np.zeros((20, 2)),
        copies=np.ones((20, 4)),
    )
    found = findings_of(group, np.ones((20, 4)), nothing)
    assert [one.name for one in found] == names
    assert not any(one.lacking for one in found)
