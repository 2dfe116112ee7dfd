"""The map of the contact solver: the judge finds wrong answers by itself, and the whole map is drawn and stored."""

import math
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.stability import contact as stability_contact
from roughfilm.stability.checks.contact import broken_conditions, displacement, rms_slope
from roughfilm.stability.contact import probe, summary
from roughfilm.stability.form import MapOutcome
from roughfilm.stability.questions.contact import MODULUS, Pressing, pressings

N, LENGTH, DEPTH = 64, 1e-4, 1e-7
X = LENGTH * np.arange(N)[:, None] / N + np.zeros(N)
RIPPLE = DEPTH * np.cos(2 * math.pi * X / LENGTH)
SPACING = (LENGTH / N, LENGTH / N)
FULL = MODULUS * math.pi / LENGTH * RIPPLE
"""What full contact adds to the mean pressure: E* q/2 times the heights."""


def judged(pressure, **changes):
    given = {"composite_modulus": MODULUS, "hardness": math.inf, "load": 2 * FULL.max(), **changes}
    return broken_conditions(pressure, RIPPLE, SPACING, **given)


def outcome_of(pressing):
    return probe(pressing).spot().outcome


def test_the_displacement_of_a_wave_is_two_over_modulus_and_wave_number():
    assert displacement(FULL, SPACING, MODULUS) == pytest.approx(RIPPLE, abs=1e-12 * DEPTH)
    assert rms_slope(RIPPLE, SPACING) == pytest.approx(2 * math.pi / LENGTH * DEPTH / math.sqrt(2))


def test_full_contact_keeps_the_conditions_and_a_wrong_pressure_does_not():
    right = 2 * FULL.max() + FULL
    assert judged(right) < 1e-12
    assert judged(2 * FULL.max() + 0.99 * FULL) == pytest.approx(0.01 * math.sqrt(2))
    assert judged(right, load=2.1 * FULL.max()) == math.inf
    assert judged(right, hardness=2.5 * FULL.max()) == math.inf
    assert judged(right[1:]) == math.inf
    assert judged(np.where(right == right.max(), np.nan, right)) == math.inf


def test_a_pressure_that_is_clipped_breaks_what_it_must():
    """Full contact at half the load would pull: clipped at 0 it is no solution, nor is it when clipped at H."""
    load = FULL.max() / 2
    pulled = np.maximum(load + FULL, 0)
    assert judged(pulled * load / pulled.mean(), load=load) > 0.01


def test_every_way_to_go_wrong_has_an_outcome(monkeypatch):
    pressing = Pressing(
        group="g", row="r", column="c", heights=RIPPLE, spacing=SPACING, hardness=math.inf, load=2 * FULL.max()
    )
    assert outcome_of(pressing) is MapOutcome.CONVERGED
    assert outcome_of(replace(pressing, load=-1.0)) is MapOutcome.WRONG
    assert outcome_of(replace(pressing, load=-1.0, refused=True)) is MapOutcome.REFUSED
    assert outcome_of(replace(pressing, refused=True)) is MapOutcome.WRONG

    found = stability_contact.contact_of(pressing)

    def stalls(_pressing):
        raise ConvergenceError("contact: stalled", outcome=Outcome.STALLED, iterations=7)

    monkeypatch.setattr(stability_contact, "contact_of", stalls)
    stalled = probe(pressing).spot()
    assert (stalled.outcome, stalled.iterations) == (MapOutcome.STALLED, 7)
    assert "Stalled: g: r, c (7 iterations): contact: stalled" in summary([stalled])
    monkeypatch.setattr(stability_contact, "contact_of", lambda _pressing: replace(found, iterations=101))
    assert outcome_of(pressing) is MapOutcome.SLOW
    even = np.full(found.pressure.shape, pressing.load)
    monkeypatch.setattr(stability_contact, "contact_of", lambda _pressing: replace(found, pressure=even))
    assert outcome_of(pressing) is MapOutcome.WRONG


def test_the_probes_are_different_and_hold_what_they_should():
    asked = list(pressings(64))
    places = {(one.group, one.row, one.column) for one in asked}
    assert len(places) == len(asked)
    shapes = {one.heights.shape for one in asked}
    assert {(63, 64), (64, 63), (63, 63), (64, 1), (1, 63)} <= shapes
    assert any(one.heights.dtype == np.float32 for one in asked)
    rough = [one for one in asked if one.group == "amplitude" and one.row == "rms slope 100"]
    assert rms_slope(rough[0].heights, rough[0].spacing) == pytest.approx(100)


def test_hard_and_soft_surfaces_converge_and_invalid_input_is_refused():
    spots = [probe(one).spot() for one in pressings(64) if one.group in ("elastic-plastic", "limits")]
    counts = Counter(spot.outcome for spot in spots)
    assert counts == {MapOutcome.CONVERGED: 49, MapOutcome.REFUSED: len(spots) - 49}
