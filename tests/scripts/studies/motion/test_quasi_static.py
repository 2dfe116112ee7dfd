"""The comparison of stated changes of the least film with marches: its random journals and its table."""

import numpy as np
import pytest

from scripts.studies.motion.quasi_static import Compared, drawn, table


@pytest.mark.parametrize("seed", range(14))
def test_random_journals_have_a_load_that_repeats(seed):
    bearing, period, part = drawn(seed)
    rows = bearing.motion.over_time.table
    loads = rows.columns["load"]
    assert rows.period == pytest.approx(period)
    assert loads[0] == loads[-1]
    assert np.ptp(loads) / loads.mean() == pytest.approx(2 * part, rel=0.02)
    assert drawn(seed)[0] == bearing


def test_a_march_that_stops_is_in_the_table_with_its_reason():
    row = Compared(
        seed=3,
        period=0.02,
        part=0.3,
        squeeze_number=0.5,
        linear=-0.1,
        coarse=None,
        true=None,
        linear_s=0.5,
        coarse_s=0.0,
        reason="the walls touch",
    )
    assert [next(iter(column.cells)) for column in table([row]).columns[4:7]] == [
        "-10.00 %",
        "the walls touch",
        "the walls touch",
    ]
