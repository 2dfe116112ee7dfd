"""The map of cell problems: its judge finds wrong answers by itself, and it is drawn and stored."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.homogenization.paths import sealed
from roughfilm.stability import cell as stability_cell
from roughfilm.stability.cell import DEFAULT, Reference, answer_of, probe, reference, solvers, summary
from roughfilm.stability.form import MapOutcome
from roughfilm.stability.questions.cell import CellGap, gaps

LINE = 1e-6 * np.repeat(np.array([1.0, 2.0, 1.0, 4.0]), 4)
RIDGES = np.tile(LINE[:, None], (1, 16))


def gap(**given):
    return CellGap(**{"group": "g", "name": "n", "thickness": RIDGES, **given})


def put(own, solver, right=None):
    return probe(own, solver, lambda: right).spot()


def ridges():
    """Faces in series: a straight gap between two nodes has <h⁻³> = (h₁ + h₂)/(2 h₁² h₂²)."""
    after = np.roll(LINE, -1)
    return (1 / np.mean((LINE + after) / (2 * LINE**2 * after**2)), 0.0, np.mean(LINE**3))


def test_a_formula_judges_elimination_and_elimination_the_rest():
    exact = ridges()
    for name in solvers():
        spot = put(gap(exact=exact), name, reference(gap(exact=exact)))
        assert (spot.outcome, spot.message) == (MapOutcome.CONVERGED, "")
        assert spot.error < 1e-8
        right = reference(gap())
        assert right.source == "elimination"
        assert np.diag(right.pressure) == pytest.approx((exact[0], exact[2]), rel=1e-12)
        assert right.shear is not None
    assert put(gap(), "elimination", reference(gap())).message == "the reference"


@pytest.mark.parametrize("wrong", [(1.00001, 1.0), (1.0, 0.9999), (np.nan, 1.0), (0.0, 1.0)])
def test_a_wrong_a_is_noticed(wrong):
    exact = ridges()
    other = (exact[0] * wrong[0], 0.0, exact[2] * wrong[1])
    for name in ("multigrid", "elimination"):
        assert put(gap(), name, reference(gap(exact=other))).outcome is MapOutcome.WRONG


def test_the_error_of_the_default_may_be_a_fraction_of_its_uncertainty_and_no_more(monkeypatch):
    right = reference(gap())
    found = answer_of(gap(), DEFAULT)
    off = replace(found, pressure=found.pressure * (1 + 1e-3), uncertainty=np.full((2, 2), 1.1e-2))
    monkeypatch.setattr(stability_cell, "answer_of", lambda *_: off)
    assert put(gap(), DEFAULT, right).outcome is MapOutcome.CONVERGED
    monkeypatch.setattr(stability_cell, "answer_of", lambda *_: replace(off, uncertainty=np.full((2, 2), 0.9e-2)))
    assert put(gap(), DEFAULT, right).outcome is MapOutcome.WRONG
    sharp = replace(found, shear=found.shear + 1e-3, uncertainty=np.zeros((2, 2)))
    monkeypatch.setattr(stability_cell, "answer_of", lambda *_: sharp)
    assert put(gap(), DEFAULT, right).outcome is MapOutcome.WRONG


def test_every_way_to_go_wrong_has_an_outcome(monkeypatch):
    right = reference(gap())
    assert put(gap(thickness=-RIDGES, refused=True), DEFAULT).outcome is MapOutcome.REFUSED
    assert put(gap(thickness=-RIDGES), DEFAULT, right).outcome is MapOutcome.WRONG
    assert put(gap(refused=True), DEFAULT).outcome is MapOutcome.WRONG
    broken = put(gap(thickness=None), "multigrid", right)
    assert broken.outcome is MapOutcome.WRONG
    assert ": " in broken.message

    def stalls(*_):
        raise ConvergenceError("the system: stalled", outcome=Outcome.STALLED, iterations=7)

    found = answer_of(gap(), DEFAULT)
    monkeypatch.setattr(stability_cell, "answer_of", stalls)
    stalled = put(gap(), DEFAULT, right)
    assert (stalled.outcome, stalled.iterations) == (MapOutcome.STALLED, 7)
    assert "Stalled: g: n, default (7 iterations): the system: stalled" in summary([stalled])
    assert reference(gap()).source == "nothing"
    monkeypatch.setattr(stability_cell, "answer_of", lambda *_: replace(found, iterations=101))
    assert put(gap(), DEFAULT, right).outcome is MapOutcome.SLOW
    assert (
        put(gap(), DEFAULT, Reference(pressure=np.full((2, 2), np.nan), shear=None, source="nothing")).outcome
        is MapOutcome.WRONG
    )


def test_the_probes_are_different_and_hold_what_they_should():
    every = list(gaps(64))
    assert len({(one.group, one.name) for one in every}) == len(every)
    sound = [one for one in every if not one.refused]
    assert {(63, 64), (64, 63), (2, 2), (2, 64), (64, 2)} <= {one.thickness.shape for one in sound}
    parts = {one.name: np.mean(one.thickness == 0) for one in sound if one.group == "contact"}
    assert parts["Hurst 0.8, 60 %"] == pytest.approx(0.6, abs=0.01)
    assert parts["Hurst 0.8, 0 %"] == 0
    spans = {one.name: np.ptp(np.log10(one.thickness**3)) for one in sound if one.group == "contrast of h³"}
    assert spans["checkerboard, 1e+16"] == pytest.approx(16)
    assert spans["smooth, 1e+08"] == pytest.approx(8)
    named = {one.name: one.thickness for one in sound if one.group == "near sealing"}
    for number in range(1, 5):
        both, one = (named[f"surface {number}, 0 % before {name}"] for name in ("both seal", "one seals"))
        assert not all(sealed(both))
        assert not any(sealed(one))
        least = np.min(both[both > 0])
        assert all(sealed(np.maximum(both - least - 1e-3 * np.ptp(both), 0)))


def test_long_pixels_are_solved_and_invalid_input_is_refused(monkeypatch):
    some = [one for one in gaps(64) if one.group in ("pixels", "limits")]
    monkeypatch.setattr(stability_cell, "gaps", lambda _points: iter(some))
    counts = Counter(one.spot().outcome for one in stability_cell.probes(64))
    assert counts == {MapOutcome.CONVERGED: 48, MapOutcome.REFUSED: 23}
