"""The map of films with temperatures: balances, limits and runaways of a few of its films, and the judges."""

from dataclasses import replace

import pytest

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.stability.checks.thermal import heat_errors
from roughfilm.stability.form import MapOutcome, Probe
from roughfilm.stability.questions import thermal
from roughfilm.stability.questions.thermal import Answer, asked, bounded, film, judged, lubricant, solved
from roughfilm.stability.questions.warm import Compared, exact_wedge, judged_pair
from roughfilm.stability.thermal import COOLED, PAD, REFUSED, probes, summary

CELLS = 24


def probe(group: str, row: str, column: str) -> Probe:
    place = (group, row, column)
    return next(one for one in probes(CELLS) if (one.group, one.row, one.column) == place)


@pytest.mark.parametrize(
    ("group", "row", "column"),
    [
        ("adiabatic over the heating number", "sector", "10 (Na = 22.1)"),
        ("across over the heating number", "two axial grooves", "0.1 (Na = 0.221)"),
        ("heat_balance over the heating number", "pad", "100 (Na = 221)"),
        ("starved pads", "across", "θ = 0.9"),
        ("a film that widens, pumped against its sliding", "adiabatic", "2 MPa"),
        ("a pad against a pressure at its outlet", "adiabatic", "10 MPa"),
        ("a pad against a pressure at its outlet", "across", "10 MPa"),
        ("laws", "ISO VG 460", "across"),
        ("walls that take heat", "a turning shaft", "1 (Na = 2.21)"),
        ("a wide wedge against its exact solution", "rise/film = 1", "10 (Na = 22.1)"),
        ("no thinning, against reynolds_cavitating", "journal with a groove", "across"),
        ("a supply at 60 °C against one at 40 °C", "three lobes", "adiabatic"),
        ("heat_balance against adiabatic", "pad", "1 (Na = 2.21)"),
        ("films under the load of a known one", "pad, adiabatic", "1 (Na = 2.21)"),
    ],
)
def test_films_with_temperatures_are_right(group: str, row: str, column: str) -> None:
    spot = probe(group, row, column).spot()
    assert spot.outcome is MapOutcome.CONVERGED, spot.message
    assert "1 of 1 right" in summary([spot])[0]


def test_films_without_a_temperature_are_refused() -> None:
    smooth = [one for one in probes(CELLS) if one.refused and "asperities" not in one.row]
    assert [one.spot().outcome for one in smooth] == [MapOutcome.REFUSED] * (3 * (len(REFUSED) - 1) - len(COOLED))


@pytest.fixture(scope="module")
def answer() -> Answer:
    """The answer of adiabatic to a pad that heats."""
    return asked(film(PAD, lubricant(1.0)), "adiabatic", 16, less=True)


def test_an_answer_is_wrong_where_its_heat_or_its_uncertainty_is(answer: Answer) -> None:
    assert judged(answer).right
    heated = answer.film.heated
    assert heated is not None
    hot = replace(answer, film=replace(answer.film, heated=replace(heated, temperature=heated.temperature + 0.1)))
    assert "the heat of the film has an error" in judged(hot).message
    more = replace(answer, film=replace(answer.film, heated=replace(heated, generated=1.01 * heated.generated)))
    assert "the heat differs from the work" in judged(more).message
    result = answer.film.result
    least = replace(result["load"], uncertainty=1e-9 * result["load"].value)
    quantities = {**result.quantities, "load": least}
    sure = replace(answer, film=replace(answer.film, result=replace(result, quantities=quantities)))
    other = replace(answer.finer, quantities={**answer.finer.quantities, "load": replace(least, value=2 * least.value)})
    assert "load differs" in judged(replace(sure, finer=other)).message
    unknown = {**quantities, "load": replace(least, uncertainty=None)}
    silent = replace(answer, film=replace(answer.film, result=replace(result, quantities=unknown)))
    assert not judged(silent).right
    assert judged(silent).reported
    assert answer.most is not None
    cold = replace(answer, most=replace(answer.most, value=0.5 * answer.most.value))
    assert "the film heats by" in judged(cold).message


def test_the_heat_of_a_film_is_balanced_from_its_flows() -> None:
    scene = film(PAD, lubricant(1.0))
    for model in ("adiabatic", "across"):
        found = solved(scene, model, 16)
        assert found.solution is not None
        assert found.heated is not None
        errors = heat_errors(scene, found.result, found.solution, found.heated)
        assert errors.balance < 1e-8
        assert errors.work < 1e-4


def test_the_exact_wedge_is_the_isothermal_one_without_heating() -> None:
    geometry = {"shape": "linear", "length": "50 mm", "film": "30 um", "rise": "30 um"}
    cold = find("bearing", "reynolds_cavitating").solve(film(geometry, lubricant(1e-6)), Request(resolution=256))
    truth = exact_wedge(1.0, 1e-6)
    for name in ("load_per_width", "friction_per_width"):
        assert cold[name].value == pytest.approx(truth[name], rel=1e-4)


def test_a_pair_is_wrong_where_it_has_a_fault() -> None:
    assert judged_pair(Compared(error=0.1, faults=(), films=3)).right
    assert not judged_pair(Compared(error=0.1, faults=("the load differs",), films=3)).right


def test_a_question_without_an_end_is_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused() -> None:
        raise ConvergenceError("a runaway")

    with pytest.raises(ConvergenceError, match="a runaway"):
        bounded(refused)
    monkeypatch.setattr(thermal, "LONGEST_S", -1.0)
    with pytest.raises(TimeoutError, match="a runaway"):
        bounded(refused)
