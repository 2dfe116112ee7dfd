"""How answers are judged, on made-up ones; and a sample of the study, whose truths are stored beside this file.

The stored truths are lines of the file that ``python -m scripts.studies.coverage --out OUT --kinds pocket`` writes.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from roughfilm.rom.ladder.scene import scene_entries
from scripts.studies.coverage import __main__ as study
from scripts.studies.coverage.answering import answers
from scripts.studies.coverage.drawing import drawn, part_of, seeds
from scripts.studies.coverage.judge import (
    EXPECTED,
    GOAL,
    UNCERTAINTY,
    Finding,
    advice_scores,
    coverage,
    findings,
    silences,
)
from scripts.studies.coverage.store import Advised, Answer, Judged, append, path_of, read
from scripts.studies.coverage.truth import Truth, kinds_with_truth
from scripts.studies.study import plain

STORED = Path(__file__).parent


def finding(error, *, stated=1.0, truth_uncertainty=0.0, warned=False):
    return Finding(
        kind="pocket",
        seed=20000,
        model="film",
        quantity="load_plus",
        promise=EXPECTED,
        value=100 + error,
        true=100.0,
        truth_uncertainty=truth_uncertainty,
        stated=stated,
        warned=warned,
    )


def case(**answer):
    values = {"load_plus": 2.1, "friction_plus": 3.0, "pressure_max_plus": 10.0, "pressure_min_plus": -5.0}
    truth = {name: (value, 1e-3) for name, value in {**values, "load_plus": 2.0}.items()}
    return Judged(kind="pocket", seed=20000, scene={}, truth=truth, models={"film": Answer(values=values, **answer)})


def test_seeds_to_fit_and_to_check_alternate():
    assert [part_of(seed) for seed in seeds(4)] == ["fit", "check", "fit", "check"]
    assert len(set(seeds(1000))) == 1000


@pytest.mark.parametrize("kind", kinds_with_truth())
def test_a_seed_is_one_scene(kind):
    entries = scene_entries(drawn(kind, 20001))
    assert entries == scene_entries(drawn(kind, 20001))
    assert entries != scene_entries(drawn(kind, 20002))


def test_answers_are_kept_missed_or_undecided():
    found = [
        finding(0.5),
        finding(2.0),
        finding(3.5),
        finding(3.5, warned=True),
        finding(0.9, truth_uncertainty=0.5),
        finding(0.2, truth_uncertainty=0.5),
        finding(3.2, truth_uncertainty=0.5),
    ]
    (row,) = coverage(found)
    assert (row.judged, row.kept, row.undecided, row.misleading) == (6, 2, 1, 1)
    assert row.verdict == "short"
    assert row.width == pytest.approx((1 / 2 + 1 / 3.2) / 2)


def test_bars_that_are_too_wide_are_named():
    assert coverage([finding(0.01) for _ in range(50)])[0].verdict == "wide"
    assert coverage([finding(0.5) for _ in range(50)])[0].verdict == "met"
    assert coverage([finding(0.5)] * 95 + [finding(1.5)] * 5)[0].verdict == "met"


def test_normal_errors_within_a_bar_for_95_of_100_are_not_too_wide():
    """The median of |e| is 0.674 σ and the bar 1.96 σ; |e| is below a fifth of it in 30.5 of 100 cases."""
    errors = np.abs(np.random.default_rng(0).normal(size=4000)) / 1.96
    (row,) = coverage([finding(error) for error in errors])
    assert (row.verdict, row.width) == ("met", pytest.approx(1.96 / 0.674, rel=0.05))
    assert row.wide_share == pytest.approx(0.305, abs=0.03)
    (twice,) = coverage([finding(error / 2) for error in errors])
    assert twice.verdict == "wide"


def test_an_expected_error_is_relative_and_contains_the_uncertainty():
    (found,) = findings([case(expected_error={"load_plus": 0.04}, uncertainty={"load_plus": 0.01})])
    assert (found.promise, found.stated, found.kept) == (EXPECTED, pytest.approx(0.08), False)


def test_an_uncertainty_is_judged_by_the_exact_solution_of_the_models_own_equations():
    one = case(expected_error={"load_plus": 0.06}, uncertainty={"load_plus": 0.01})
    one = replace(one, own={"film": {"load_plus": (2.105, 1e-4)}})
    found = {each.promise: each for each in findings([one])}
    assert found[UNCERTAINTY].error == pytest.approx(0.005)
    assert found[UNCERTAINTY].kept
    assert found[EXPECTED].stated == pytest.approx(0.12)


def test_answers_that_state_nothing_are_counted():
    assert [(one.quantity, one.silent) for one in silences([case()])] == [("load_plus", 1), ("friction_plus", 1)]
    assert silences([case(warnings=("beyond the range",))]) == []


def test_advice_is_kept_missed_or_refused():
    common = {"quantity": "load_plus", "within": 0.02, "best_cpu_s": 1.0}
    advice = (
        Advised(**common, model="film", value=2.01, cpu_s=0.1),
        Advised(**common, model="film", value=2.06, cpu_s=0.2),
        Advised(**common),
    )
    (score,), misses = advice_scores([replace(case(), advice=advice)])
    assert (score.judged, score.kept, score.refused, score.cost) == (2, 1, 1, 0.1)
    assert [one.value for _, one, _ in misses] == [2.06]


def test_the_store_gives_back_what_was_written_and_leaves_out_a_line_that_was_cut(tmp_path):
    path = path_of(tmp_path, "pocket")
    one = replace(case(warnings=("a",)), advice=(Advised(quantity="load_plus", within=0.02),))
    append(path, replace(one, method="old"))
    append(path, one)
    with path.open("a", encoding="utf-8") as file:
        file.write('{"kind": "pocket", "se')
    assert plain(read(path)[20000]) == plain(one)


def test_the_truth_of_a_models_own_equations_is_that_of_todays_quantities(monkeypatch):
    """A quantity whose meaning changed has another value, which its known truth does not judge."""
    seed = 20002
    scene = drawn("bearing", seed)
    now = Answer(values={"rupture": 0.71, "load_per_width": 5.0}, uncertainty={"rupture": 1e-4, "load_per_width": 0.1})
    own = {"reynolds": {"rupture": (1.0, 1e-9), "load_per_width": (5.0, 1e-9)}}
    truth = Truth(values={}, uncertainty={}, method="", own={"reynolds": {"rupture": (0.71, 1e-9)}})
    monkeypatch.setattr(study, "answers", lambda *_, **__: {"reynolds": now})
    monkeypatch.setattr(study, "truth_of", lambda *_: truth)

    def judge(**before):
        models = {"reynolds": replace(now, values=now.values | before)}
        known = Judged(kind="bearing", seed=seed, scene=scene_entries(scene), truth={}, own=own, models=models)
        return study.judged("bearing", seed, known, with_advice=False).own

    assert judge(load_per_width=5.01) == own
    assert judge(load_per_width=5.05) == truth.own
    assert judge(rupture=1.0) == truth.own


def test_a_sample_of_every_kind_is_covered():
    sampled = set(kinds_with_truth())
    stored = [one for kind in sampled for one in read(path_of(STORED, kind)).values()]
    found = [replace(one, models=answers(drawn(one.kind, one.seed))) for one in stored]
    judged = [one for one in findings(found) if one.decided]
    assert {one.kind for one in judged} == sampled
    assert len(judged) >= 500
    assert not [one for one in judged if one.misleads]
    assert sum(one.kept for one in judged) >= GOAL[0] * len(judged)
