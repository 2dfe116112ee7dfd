"""The study of dimples on invented loads whose best dimples and errors are known."""

from dataclasses import replace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.studies.sweep import Sweep
from scripts.studies.dimples.__main__ import error_row, parts
from scripts.studies.dimples.data import dimples_of, joined

DEPTHS, WIDTHS = (0.5, 1.0, 1.5), (0.3, 0.6)
DEPTH, WIDTH = (values.ravel() for values in np.meshgrid(DEPTHS, WIDTHS, indexing="ij"))
TRUE = WIDTH * (2 - (DEPTH - 1) ** 2)
"""The loads at infinitely many columns; the best dimple is the wide one of depth 1."""

LOADS = {
    "reynolds": 1e-14 * DEPTH,
    "inertial_reynolds": WIDTH * (2 + DEPTH),
    "navier_stokes-40": TRUE * (1 - 16 / 1600),
    "navier_stokes-80": TRUE * (1 - 16 / 6400),
}
RESOLUTIONS = {"reynolds": 64.0, "inertial_reynolds": 64.0, "navier_stokes-40": 40.0, "navier_stokes-80": 80.0}


@pytest.fixture
def sweep():
    def each(value):
        return np.full(DEPTH.size, value)

    return Sweep(
        kind="pocket",
        names=tuple(f"case {number}" for number in range(DEPTH.size)),
        given={
            "profile": each("spherical"),
            "width": WIDTH,
            "breadth": each(np.nan),
            "depth_plus": DEPTH,
            "covered": WIDTH**2,
            "reynolds_number": each(40.0),
        },
        found={
            name: {"load_plus": load, "pressure_max_plus": each(5.0), "pressure_min_plus": each(-5.0)}
            for name, load in LOADS.items()
        },
        cpu_s={name: each(1e-3 * number) for number, name in enumerate(LOADS, start=1)},
        failures=(),
        resolution={name: each(value) for name, value in RESOLUTIONS.items()},
    )


def test_the_load_of_the_reference_is_extrapolated_at_second_order(sweep):
    dimples = dimples_of(sweep)
    assert list(dimples.settings) == ["reynolds", "inertial_reynolds", "navier_stokes"]
    assert dimples.load("navier_stokes") == pytest.approx(TRUE, rel=1e-12)
    assert dimples.load("inertial_reynolds") == pytest.approx(LOADS["inertial_reynolds"])


def test_each_model_chooses_the_dimple_with_its_largest_load(sweep):
    dimples = dimples_of(sweep)
    best, cheap = (dimples.choice("spherical", 40.0, model) for model in ("navier_stokes", "inertial_reynolds"))
    assert (best.depth, best.covered, best.deepest, best.lost) == (1.0, pytest.approx(0.36), False, 0.0)
    assert best.load == pytest.approx(1.2)
    assert (cheap.depth, cheap.covered, cheap.deepest) == (1.5, pytest.approx(0.36), True)
    assert cheap.true == pytest.approx(0.6 * 1.75)
    assert cheap.lost == pytest.approx(0.125)


def test_a_model_whose_loads_are_round_off_chooses_nothing(sweep):
    assert dimples_of(sweep).choice("spherical", 40.0, "reynolds") is None
    assert dimples_of(sweep).choice("spherical", 40.0, "inertial_reynolds") is not None


def test_a_model_whose_loads_are_round_off_chooses_nothing_beside_negative_loads(sweep):
    negative = {name: {**one, "load_plus": -one["load_plus"]} for name, one in sweep.found.items() if "navier" in name}
    found = dimples_of(replace(sweep, found={**sweep.found, **negative}))
    assert found.choice("spherical", 40.0, "reynolds") is None


def test_tables_are_joined_with_gaps_where_a_column_is_missing():
    one = {"case": np.array(["a", "b"]), "load": np.array([1.0, 2.0]), "shape": np.array(["box", "box"])}
    other = {"case": np.array(["longer"]), "load": np.array([3.0]), "angle": np.array([0.5])}
    found = joined([one, other])
    assert found["case"].tolist() == ["a", "b", "longer"]
    assert found["shape"].tolist() == ["box", "box", ""]
    assert found["load"].tolist() == [1.0, 2.0, 3.0]
    assert np.isnan(found["angle"][:2]).all()
    assert found["angle"][2] == 0.5


def test_errors_leave_out_loads_that_are_small_beside_the_pressure(sweep):
    dimples = dimples_of(replace(sweep, found={**sweep.found, "navier_stokes-80": LARGE_PRESSURE}))
    shallow, deep = parts(dimples).items()
    row = error_row(dimples, "inertial_reynolds", *deep)
    assert row["cells"] == 2
    assert row["worst"] == pytest.approx(3.5 / 1.75 - 1)
    assert error_row(dimples, "inertial_reynolds", *shallow)["median"] == pytest.approx(2.5 / 1.75 - 1)


LARGE_PRESSURE = {
    "load_plus": LOADS["navier_stokes-80"],
    "pressure_max_plus": np.where(WIDTH > 0.5, 5.0, 100.0),
    "pressure_min_plus": np.full(DEPTH.size, -5.0),
}
"""Quantities of the finest mesh, with narrow dimples whose loads are small beside their largest pressure."""


def test_a_batch_without_two_meshes_of_the_reference_is_refused(sweep):
    resolution = {name: values for name, values in sweep.resolution.items() if name != "navier_stokes-40"}
    with pytest.raises(InputError, match="no two meshes of navier_stokes"):
        dimples_of(replace(sweep, resolution=resolution))
