"""The map of cell problems: its judge tells right from wrong by itself, and it is drawn and stored."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.homogenization.paths import sealed
from roughfilm.stability import cell as stability_cell
from roughfilm.stability.cell import DEFAULT, asked, in_words, put, solvers, truth_of
from roughfilm.stability.form import Outcome as Found
from roughfilm.stability.questions.cell import REFUSED, Probe, probes

LINE = 1e-6 * np.repeat(np.array([1.0, 2.0, 1.0, 4.0]), 4)
RIDGES = np.tile(LINE[:, None], (1, 16))


def probe(**given):
    return Probe(**{"group": "g", "name": "n", "gap": RIDGES, **given})


def ridges():
    """Faces in series: a straight gap between two nodes has <h⁻³> = (h₁ + h₂)/(2 h₁² h₂²)."""
    after = np.roll(LINE, -1)
    return (1 / np.mean((LINE + after) / (2 * LINE**2 * after**2)), 0.0, np.mean(LINE**3))


def test_a_formula_judges_elimination_and_elimination_the_rest():
    exact = ridges()
    for name in solvers():
        spot = put(probe(exact=exact), name, truth_of(probe(exact=exact)))
        assert (spot.outcome, spot.message) == (Found.CONVERGED, "")
        assert spot.error < 1e-8
        right, shear, source = truth_of(probe())
        assert source == "elimination"
        assert np.diag(right) == pytest.approx((exact[0], exact[2]), rel=1e-12)
        assert shear is not None
    assert put(probe(), "elimination", truth_of(probe())).message == "taken for right"


@pytest.mark.parametrize("wrong", [(1.00001, 1.0), (1.0, 0.9999), (np.nan, 1.0), (0.0, 1.0)])
def test_a_wrong_a_is_told(wrong):
    exact = ridges()
    other = (exact[0] * wrong[0], 0.0, exact[2] * wrong[1])
    for name in ("multigrid", "elimination"):
        assert put(probe(), name, truth_of(probe(exact=other))).outcome is Found.WRONG


def test_the_default_may_be_off_by_a_part_of_its_bar_and_no_more(monkeypatch):
    right = truth_of(probe())
    found = asked(probe(), DEFAULT)
    off = replace(found, pressure=found.pressure * (1 + 1e-3), bar=np.full((2, 2), 1.1e-2))
    monkeypatch.setattr(stability_cell, "asked", lambda *_: off)
    assert put(probe(), DEFAULT, right).outcome is Found.CONVERGED
    monkeypatch.setattr(stability_cell, "asked", lambda *_: replace(off, bar=np.full((2, 2), 0.9e-2)))
    assert put(probe(), DEFAULT, right).outcome is Found.WRONG
    sharp = replace(found, shear=found.shear + 1e-3, bar=np.zeros((2, 2)))
    monkeypatch.setattr(stability_cell, "asked", lambda *_: sharp)
    assert put(probe(), DEFAULT, right).outcome is Found.WRONG


def test_every_way_to_go_wrong_is_told(monkeypatch):
    right = truth_of(probe())
    assert put(probe(gap=-RIDGES, expected=REFUSED), DEFAULT, None).outcome is Found.REFUSED
    assert put(probe(gap=-RIDGES), DEFAULT, right).outcome is Found.WRONG
    assert put(probe(expected=REFUSED), DEFAULT, None).outcome is Found.WRONG
    broken = put(probe(gap=None), "multigrid", right)
    assert broken.outcome is Found.WRONG
    assert ": " in broken.message

    def stalls(*_):
        raise ConvergenceError("the system: stalled", outcome=Outcome.STALLED, iterations=7)

    found = asked(probe(), DEFAULT)
    monkeypatch.setattr(stability_cell, "asked", stalls)
    stalled = put(probe(), DEFAULT, right)
    assert (stalled.outcome, stalled.iterations) == (Found.STALLED, 7)
    assert "Stalled: g: n, default (7 iterations): the system: stalled" in in_words([stalled])
    assert truth_of(probe())[2] == "nothing"
    monkeypatch.setattr(stability_cell, "asked", lambda *_: replace(found, iterations=101))
    assert put(probe(), DEFAULT, right).outcome is Found.SLOW
    assert put(probe(), DEFAULT, (np.full((2, 2), np.nan), None, "nothing")).outcome is Found.WRONG


def test_the_probes_are_different_and_hold_what_they_should():
    every = list(probes(64))
    assert len({(one.group, one.name) for one in every}) == len(every)
    sound = [one for one in every if one.expected != REFUSED]
    assert {(63, 64), (64, 63), (2, 2), (2, 64), (64, 2)} <= {one.gap.shape for one in sound}
    parts = {one.name: np.mean(one.gap == 0) for one in sound if one.group == "contact"}
    assert parts["Hurst 0.8, 60 %"] == pytest.approx(0.6, abs=0.01)
    assert parts["Hurst 0.8, 0 %"] == 0
    spans = {one.name: np.ptp(np.log10(one.gap**3)) for one in sound if one.group == "contrast of h³"}
    assert spans["checkerboard, 1e+16"] == pytest.approx(16)
    assert spans["smooth, 1e+08"] == pytest.approx(8)
    gaps = {one.name: one.gap for one in sound if one.group == "near sealing"}
    for number in range(1, 5):
        both, one = (gaps[f"surface {number}, 0 % before {name}"] for name in ("both seal", "one seals"))
        assert not all(sealed(both))
        assert not any(sealed(one))
        least = np.min(both[both > 0])
        assert all(sealed(np.maximum(both - least - 1e-3 * np.ptp(both), 0)))


def test_the_map_is_a_page_a_table_and_json(tmp_path, monkeypatch):
    some = [one for one in probes(64) if one.group in ("pixels", "limits")]
    monkeypatch.setattr(stability_cell, "probes", lambda _points: iter(some))
    result = CliRunner().invoke(app, ["stability", "cell", "--out", str(tmp_path), "--resolution", "64", "--json"])
    assert result.exit_code == 0, result.stderr
    entries = json.loads(result.stdout)
    assert entries == json.loads((tmp_path / "stability.json").read_text())
    assert entries["counts"] == {"converged": 48, "slow": 0, "inaccurate": 0, "stalled": 0, "wrong": 0, "refused": 23}
    with (tmp_path / "stability.csv").open() as file:
        assert len(list(csv.DictReader(file))) == 71
    page = (tmp_path / "report.html").read_text()
    assert "dx/dy = 0.01, 20 %" in page
    assert "src=" not in page


def test_too_few_nodes_are_refused(tmp_path):
    result = CliRunner().invoke(app, ["stability", "cell", "--out", str(tmp_path), "--resolution", "8"])
    assert result.exit_code == 2
    assert "--resolution: got 8; the cells take 64 to 512 nodes along a side" in result.stderr
