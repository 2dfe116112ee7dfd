"""What pressure does to a lubricant: laws against their definitions, tables against what they were made from."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus, DowsonHigginson, Incompressible
from roughfilm.rom.lubricants.tabulated import Tabulated, fitted
from roughfilm.rom.lubricants.viscosity import Barus, ConstantViscosity, Roelands

PRESSURES = np.array([0.0, 1e5, 3e6, 5e7, 4e8])
BULK = ConstantBulkModulus.model_validate({"law": "constant_bulk_modulus", "bulk_modulus": "1.3 GPa"})
OIL = DowsonHigginson.model_validate({"law": "dowson_higginson"})
MEASURED = DowsonHigginson.model_validate({"law": "dowson_higginson", "c1": "2.22 GPa", "c2": 1.66})
ROWS = [[1e6 * p, 870 * (2.22e9 + 1.66e6 * p) / (2.22e9 + 1e6 * p)] for p in (0, 20, 50, 100, 200, 400, 700, 1000)]
TABLE = Tabulated.model_validate({"law": "tabulated", "table": ROWS})
LAWS = [Incompressible(), BULK, OIL, MEASURED, TABLE]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.law)
def test_the_slope_is_that_of_the_compression(law):
    pressure = PRESSURES[1:]
    step = 1e-6 * pressure
    rise = (law.compression(pressure + step)[0] - law.compression(pressure - step)[0]) / (2 * step)
    assert law.compression(pressure)[1] == pytest.approx(rise, rel=1e-5, abs=1e-20)
    assert law.compression(PRESSURES)[0][0] == 0


def test_a_constant_bulk_modulus_is_theta_times_dp_by_dtheta():
    excess, slope = BULK.compression(PRESSURES)
    assert (1 + excess) / slope == pytest.approx(np.full(5, 1.3e9), rel=1e-12)
    assert excess == pytest.approx(np.exp(PRESSURES / 1.3e9) - 1, rel=1e-9)


def test_dowson_and_higginson():
    assert 1 + OIL.compression(PRESSURES)[0] == pytest.approx((0.59e9 + 1.34 * PRESSURES) / (0.59e9 + PRESSURES))
    assert 1 / MEASURED.compression(np.zeros(1))[1][0] == pytest.approx(2.22e9 / 0.66)


@pytest.mark.parametrize("law", [BULK, OIL, MEASURED, TABLE], ids=lambda law: law.law)
@pytest.mark.parametrize("pressure", [1e4, 2e7, 3e8])
def test_the_pressure_of_a_density_leads_back(law, pressure):
    theta = 1 + float(law.compression(np.array([pressure]))[0][0])
    assert law.pressure_at(theta) == pytest.approx(pressure, rel=1e-6)


def test_a_table_goes_through_its_points_and_never_falls():
    pressure, density = np.array(ROWS).T
    assert 1 + TABLE.compression(pressure)[0] == pytest.approx(density / 870, rel=1e-12)
    dense = TABLE.compression(np.linspace(0, 2e9, 4001))
    assert (np.diff(dense[0]) > 0).all()
    assert (dense[1] > 0).all()


def test_between_its_points_a_table_is_near_the_law_it_was_made_from():
    pressure = np.linspace(0, 1e9, 301)
    assert TABLE.compression(pressure)[0] == pytest.approx(MEASURED.compression(pressure)[0], abs=4e-4)


def test_a_fit_finds_the_law():
    found = fitted(TABLE.table)
    assert (found.c1, found.c2) == (pytest.approx(2.22e9, rel=1e-6), pytest.approx(1.66, rel=1e-6))
    law = Tabulated.model_validate({"law": "tabulated", "table": ROWS, "fit": "dowson_higginson"})
    assert law.compression(PRESSURES)[0] == pytest.approx(MEASURED.compression(PRESSURES)[0], rel=1e-6)
    assert law.pressure_at(1.05) == pytest.approx(MEASURED.pressure_at(1.05), rel=1e-5)


def test_a_file_says_its_units(tmp_path):
    path = tmp_path / "oil.csv"
    lines = ["pressure (MPa), density (g/cm^3)", *(f"{p * 1e-6!r}, {d * 1e-3!r}" for p, d in ROWS)]
    path.write_text("\n".join(lines), encoding="utf-8")
    law = Tabulated.model_validate({"law": "tabulated", "table": str(path)})
    assert np.array(law.table) == pytest.approx(np.array(ROWS), rel=1e-12)
    np.save(tmp_path / "oil.npy", np.array(ROWS))
    assert Tabulated.model_validate({"law": "tabulated", "table": str(tmp_path / "oil.npy")}).table == TABLE.table


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        ([[0, 870], [1e7, 880], [2e7, 879]], "row 3 after .* must both increase"),
        ([[0, 870], [1e7, 880], [1e7, 890]], "row 3 after .* must both increase"),
        ([[1e5, 870], [1e7, 880], [2e7, 890]], "must be the density at pressure 0"),
        ([[0, 870], [1e7, 880]], "got 2 rows"),
        ([[0, 870], [1e7, float("nan")], [2e7, 890]], "got nan kg/m\\^3 as density of row 2"),
        ([[0, 870], [1e7], [2e7, 890]], "write pressure and density"),
        ("nowhere.csv", "nowhere.csv.*no such file"),
        (7, "got 7; name a file"),
    ],
)
def test_tables_that_are_none_are_refused(rows, words):
    with pytest.raises(ValueError, match=words):
        Tabulated.model_validate({"law": "tabulated", "table": rows})


def test_points_that_bend_upward_are_not_fitted():
    rows = [[1e6 * p, 870 * (1 + 1e-9 * p**3)] for p in (0, 100, 200, 300, 400)]
    with pytest.raises(ValueError, match="does not fit"):
        Tabulated.model_validate({"law": "tabulated", "table": rows, "fit": "dowson_higginson"})


def test_densities_that_no_pressure_gives_are_refused():
    with pytest.raises(InputError, match="incompressible"):
        Incompressible().pressure_at(1.001)
    with pytest.raises(InputError, match=r"c2 = 1\.34"):
        OIL.pressure_at(1.4)
    with pytest.raises(InputError, match="the table ends at"):
        TABLE.pressure_at(1.5)


def test_viscosity_by_barus_and_roelands():
    barus = Barus.model_validate({"law": "barus", "pressure_coefficient": "20 GPa^-1"})
    found, slope = barus.fluidity(PRESSURES, 0.04)
    assert found == pytest.approx(np.exp(-2e-8 * PRESSURES))
    assert slope == pytest.approx(-2e-8 * found)
    roelands = Roelands.model_validate({"law": "roelands", "index": 0.6})
    viscosity = 0.04 / roelands.fluidity(PRESSURES, 0.04)[0]
    expected = np.exp(-9.67 + (np.log(0.04) + 9.67) * (1 + 5.1e-9 * PRESSURES) ** 0.6)
    assert viscosity == pytest.approx(expected, rel=1e-12)
    step = 1e3
    rise = (roelands.fluidity(PRESSURES + step, 0.04)[0] - roelands.fluidity(PRESSURES, 0.04)[0]) / step
    assert roelands.fluidity(PRESSURES, 0.04)[1] == pytest.approx(rise, rel=1e-4)
    assert (ConstantViscosity().fluidity(PRESSURES, 0.04)[0] == 1).all()
