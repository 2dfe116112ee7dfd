"""Tables of journal bearings with a lubricant that heats and keeps its viscosity, on coarse grids."""

import pytest

from roughfilm.validation.isoviscous import isoviscous_limits, table_rows

CELLS = 24

ROWS = [row for number, row in enumerate(table_rows()) if number % 20 == 0 or row.source == "lund_thomsen"]
"""Every twentieth row, and all bearings under a load."""


def test_the_sample_has_rows_of_each_table():
    assert {row.source for row in ROWS} == {"butenschoen", "raimondi_boyd", "squeeze_butenschoen", "lund_thomsen"}


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.source}, {row.case}")
def test_heat_that_does_not_change_the_viscosity_leaves_every_bit_of_a_published_case(row):
    limits = isoviscous_limits(row, CELLS)
    assert ("dynamics" in limits) == (row.source == "lund_thomsen")
    for model, limit in limits.items():
        if model == "adiabatic" and row.source == "squeeze_butenschoen":
            assert "no steady temperature" in limit.reason
        else:
            assert (limit.changed, limit.reason) == ((), ""), model
            assert limit.compared > (15 if model == "dynamics" else 30)
