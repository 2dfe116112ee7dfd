"""The map of the contact solver: the judge tells right from wrong by itself, and the whole map is drawn and stored."""

import csv
import json
import math
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.stability import contact as stability_contact
from roughfilm.stability.checks.contact import broken_conditions, displacement, rms_slope
from roughfilm.stability.contact import put, told
from roughfilm.stability.form import Outcome as Found
from roughfilm.stability.questions.contact import MODULUS, Probe, probes

N, LENGTH, DEPTH = 64, 1e-4, 1e-7
X = LENGTH * np.arange(N)[:, None] / N + np.zeros(N)
RIPPLE = DEPTH * np.cos(2 * math.pi * X / LENGTH)
SPACING = (LENGTH / N, LENGTH / N)
FULL = MODULUS * math.pi / LENGTH * RIPPLE
"""What full contact adds to the mean pressure: E* q/2 times the heights."""


def judged(pressure, **changes):
    given = {"composite_modulus": MODULUS, "hardness": math.inf, "load": 2 * FULL.max(), **changes}
    return broken_conditions(pressure, RIPPLE, SPACING, **given)


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


def test_every_way_to_go_wrong_is_told(monkeypatch):
    probe = Probe(
        group="g", row="r", column="c", heights=RIPPLE, spacing=SPACING, hardness=math.inf, load=2 * FULL.max()
    )
    assert put(probe).outcome is Found.CONVERGED
    assert put(replace(probe, load=-1.0)).outcome is Found.WRONG
    assert put(replace(probe, load=-1.0, expected="refused")).outcome is Found.REFUSED
    assert put(replace(probe, expected="refused")).outcome is Found.WRONG

    found = stability_contact.pressed(probe)

    def stalls(_probe):
        raise ConvergenceError("contact: stalled", outcome=Outcome.STALLED, iterations=7)

    monkeypatch.setattr(stability_contact, "pressed", stalls)
    stalled = put(probe)
    assert (stalled.outcome, stalled.iterations) == (Found.STALLED, 7)
    assert "Stalled: g: r, c (7 iterations): contact: stalled" in told([stalled])
    monkeypatch.setattr(stability_contact, "pressed", lambda _probe: replace(found, iterations=101))
    assert put(probe).outcome is Found.SLOW
    even = np.full(found.pressure.shape, probe.load)
    monkeypatch.setattr(stability_contact, "pressed", lambda _probe: replace(found, pressure=even))
    assert put(probe).outcome is Found.WRONG


def test_the_probes_are_different_and_hold_what_they_should():
    asked = list(probes(64))
    places = {(probe.group, probe.row, probe.column) for probe in asked}
    assert len(places) == len(asked)
    shapes = {probe.heights.shape for probe in asked}
    assert {(63, 64), (64, 63), (63, 63), (64, 1), (1, 63)} <= shapes
    assert any(probe.heights.dtype == np.float32 for probe in asked)
    rough = [probe for probe in asked if probe.group == "amplitude" and probe.row == "rms slope 100"]
    assert rms_slope(rough[0].heights, rough[0].spacing) == pytest.approx(100)


def test_the_map_is_a_page_a_table_and_json(tmp_path, monkeypatch):
    some = [probe for probe in probes(64) if probe.group in ("elastic-plastic", "limits")]
    monkeypatch.setattr(stability_contact, "probes", lambda _points: iter(some))
    result = CliRunner().invoke(app, ["stability", "contact", "--out", str(tmp_path), "--resolution", "64", "--json"])
    assert result.exit_code == 0, result.stderr
    entries = json.loads(result.stdout)
    assert entries == json.loads((tmp_path / "stability.json").read_text())
    assert entries["counts"]["converged"] == 49
    assert entries["counts"]["wrong"] == 0
    assert max(spot["iterations"] or 0 for spot in entries["runs"]) <= 100
    with (tmp_path / "stability.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(some)
    page = (tmp_path / "report.html").read_text()
    assert "elastic-plastic" in page
    assert "src=" not in page


def test_too_few_points_are_refused(tmp_path):
    result = CliRunner().invoke(app, ["stability", "contact", "--out", str(tmp_path), "--resolution", "8"])
    assert result.exit_code == 2
    assert "--resolution: got 8; the surfaces need at least 32 points" in result.stderr
