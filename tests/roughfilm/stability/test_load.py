"""The map of films under a load: the film of a load comes back, the thicker of two is found, and its judge."""

from dataclasses import replace

import pytest

from roughfilm.stability.form import MapOutcome, Probe
from roughfilm.stability.load import Found, judged, probes, summary

FOUND = Found(known=1e-6, film=1e-6, uncertainty=1e-9, films=7, again=1.0, thicker=0.97)


def probe(group: str, row: str, column: str) -> Probe:
    place = (group, row, column)
    return next(one for one in probes(32) if (one.group, one.row, one.column) == place)


@pytest.mark.parametrize(
    ("group", "row", "column"),
    [
        ("journal", "B/D = 0.25", "e = 0.9995"),
        ("journal", "B/D = inf", "e = 0.01"),
        ("starved pad", "θ = 0.4", "h/h_full = 0.3"),
        ("averaged ridges", "a/h = 0.9", "h/rise = 0.3"),
        ("cell of a washer", "d = 30 µm", "h/d = 0.5"),
    ],
)
def test_the_film_of_a_load_comes_back(group: str, row: str, column: str) -> None:
    spot = probe(group, row, column).spot()
    assert spot.outcome in (MapOutcome.CONVERGED, MapOutcome.SLOW), spot.message
    assert spot.numbers["film"] == pytest.approx(spot.numbers["known_film"], rel=1e-3)


def test_a_film_whose_load_round_off_hides_is_still_found() -> None:
    """The load of 9 mPa is 10⁻⁷ of the pressures that the cavitation pressure adds to."""
    assert probe("pad", "B/L = 0.05", "h/rise = 100").spot().outcome is MapOutcome.SLOW


def test_of_two_films_under_a_pocket_the_thicker_one_is_found() -> None:
    spot = probe("parallel pad with a pocket", "d = 30 µm", "h/d = 0.03").spot()
    assert spot.outcome in (MapOutcome.CONVERGED, MapOutcome.SLOW), spot.message
    film, known = spot.numbers["film"], spot.numbers["known_film"]
    assert film is not None
    assert known is not None
    assert film > 1.1 * known
    assert "two films" in spot.message
    assert any("thicker film" in line for line in summary([spot]))


def test_a_load_that_falls_with_a_thinner_film_is_found_on_a_finer_grid_too() -> None:
    """The coarse grids carry the load at 4.8 µm, and the finest one carries less there."""
    spot = probe("parallel pad with a pocket", "d = 1 µm", "h/d = 0.2").spot()
    assert spot.outcome is MapOutcome.SLOW, spot.message


def test_loads_that_no_film_carries_are_refused() -> None:
    asked = [one for one in probes(32) if one.refused]
    assert [one.spot().outcome for one in asked] == [MapOutcome.REFUSED] * 6


@pytest.mark.parametrize(
    ("change", "right", "reported", "words"),
    [
        ({}, True, True, ""),
        ({"film": 2e-6}, True, True, "the thicker of two films"),
        ({"again": 0.9}, False, False, "carries 0.9 of the load"),
        ({"thicker": 1.2}, False, False, "a thicker film carries 1.2"),
        ({"film": 0.5e-6}, False, False, "0.5 of the known one"),
        ({"film": 0.5e-6, "uncertainty": 0.6e-6}, False, True, "within its uncertainty"),
        ({"film": 0.5e-6, "uncertainty": 0.6e-6, "thicker": 1.2}, False, False, "a thicker film carries"),
    ],
)
def test_a_film_is_judged_by_its_load_and_by_other_films(
    change: dict[str, float], right: bool, reported: bool, words: str
) -> None:
    answer = judged(replace(FOUND, **change))  # type: ignore[arg-type]
    assert (answer.right, answer.reported) == (right, reported)
    assert words in answer.message
