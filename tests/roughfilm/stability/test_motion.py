"""The map of shafts that move freely: known places come back, motions agree with short steps, and the judges."""

from dataclasses import replace

import pytest

from roughfilm.stability.form import MapOutcome, Probe
from roughfilm.stability.motion import Found, Moved, judged, judged_motion, probes, summary

FOUND = Found(apart=1e-9, again=1e-9, idle=False, known=1e-5, film=1e-5, finer=1.001e-5, uncertainty=2e-8, iterations=7)


def probe(group: str, row: str, column: str) -> Probe:
    place = (group, row, column)
    return next(one for one in probes(48) if (one.group, one.row, one.column) == place)


@pytest.mark.parametrize(
    ("group", "row", "column"),
    [
        ("full bore", "B/D = 1", "ε = 0.6"),
        ("two lobes, preload 0.5", "B/D = inf", "ε = 0.8"),
        ("four tilting pads", "B/D = 1", "ε = 0.3"),
        ("a shaft that is moved", "v/(cω) = 10", "step ≤ 0.05 of the motion"),
    ],
)
def test_known_places_and_motions_come_back(group: str, row: str, column: str) -> None:
    spot = probe(group, row, column).spot()
    assert spot.outcome is MapOutcome.CONVERGED, spot.message
    assert "1 of 1 right" in summary([spot])[0]


def test_shafts_without_an_equilibrium_are_refused() -> None:
    asked = [one for one in probes(48) if one.refused]
    assert [one.spot().outcome for one in asked] == [MapOutcome.REFUSED] * 5


def test_a_place_is_wrong_where_it_is_another_one_or_its_uncertainty_too_small() -> None:
    assert judged(FOUND).right
    for change in ({"apart": 1e-3}, {"again": 1e-3}, {"finer": 1.1e-5}):
        answer = judged(replace(FOUND, **change))
        assert not answer.right, change
        assert not answer.reported
    other = replace(FOUND, apart=1.0, idle=True, known=0.9e-5)
    assert judged(other).right
    assert not judged(replace(other, known=1.1e-5)).right
    unknown = judged(replace(FOUND, uncertainty=None))
    assert not unknown.right
    assert unknown.reported


def test_a_motion_is_wrong_where_it_differs_from_that_by_short_steps() -> None:
    assert judged_motion(Moved(error=1e-3, allowed=2e-3, steps=10, iterations=25)).right
    assert not judged_motion(Moved(error=3e-3, allowed=2e-3, steps=10, iterations=25)).right
