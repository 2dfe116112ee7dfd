"""Numbers of the paper and of closed forms on a coarse grid, verdicts on films that do the opposite, and the page."""

import json
import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from scripts.studies.paper_b import __main__ as paper_b
from scripts.studies.paper_b.claims import judge, maxima, rows
from scripts.studies.paper_b.data import (
    CONSTANT,
    DOUBLE,
    HALF,
    MNL,
    MODULUS,
    ORIGINAL,
    SOFT,
    SpeedSweep,
    compute,
    difference,
)

CELLS = 2048


@pytest.fixture(scope="module")
def paper():
    return compute(lambda *_: None, cells=CELLS, steps=13)


TWO_DIGITS, STARVED_FRONT = 0.045, 0.03
"""Tolerances: two digits of the paper (11.54 is its 12), and films whose front it places at a node."""


@pytest.mark.parametrize(
    ("case", "law", "quantity", "printed", "tolerance"),
    [
        ("single", SOFT, "p", 0.12, TWO_DIGITS),
        ("twin", SOFT, "p", 0.15, TWO_DIGITS),
        ("flooded", ORIGINAL, "θ", 0.0061, 0.01),
        ("flooded", ORIGINAL, "p", 0.017, 0.03),
        ("starved", ORIGINAL, "θ", 0.0064, STARVED_FRONT),
        ("starved", ORIGINAL, "p", 0.074, STARVED_FRONT),
        ("starved", CONSTANT, "p", 0.0011, TWO_DIGITS),
        ("starved, moduli", HALF, "p", 0.084, STARVED_FRONT),
        ("starved, moduli", DOUBLE, "p", 0.048, STARVED_FRONT),
        ("gap", ORIGINAL, "p", 0.22, STARVED_FRONT),
        ("gap", CONSTANT, "p", 0.0054, STARVED_FRONT),
        ("gap, moduli", HALF, "p", 0.25, STARVED_FRONT),
        ("gap, moduli", DOUBLE, "p", 0.19, STARVED_FRONT),
    ],
)
def test_the_numbers_of_the_paper(paper, case, law, quantity, printed, tolerance):
    fine, coarse = paper.found[case, law, quantity]
    assert fine.between == pytest.approx(printed, rel=tolerance)
    assert coarse.between == pytest.approx(fine.between, rel=0.01)


def test_the_paper_prints_integrals_of_differences_for_differences_of_integrals(paper):
    found = {(row.printed.figure, row.printed.law): row.agrees for row in rows(paper)}
    for figure, law in (("B.3", SOFT), ("B.7", ORIGINAL), ("B.8", ORIGINAL)):
        assert found[figure, law] == (False, True)
    assert sum(between for _, between in found.values()) >= 11


def test_the_starved_film_ruptures_where_it_is_as_thick_as_the_lubricant_brought(paper):
    """h = 2 µm (1 + (2x/L - 1)²) is 0.55 · 4 µm where 2x/L - 1 = √0.1."""
    for film in paper.films["starved"].values():
        assert film.rupture == pytest.approx((1 + np.sqrt(0.1)) / 2, abs=0.1 / CELLS)


def test_both_films_of_the_twin_parabola_are_the_same(paper):
    """The same flow ruptures at the same thickness, and has the same pressure behind it."""
    for film in paper.films["twin"].values():
        left, right = maxima(film)
        assert left == pytest.approx(right, rel=1e-9)
        half = np.interp(film.x[-1] / 2, film.x, film.pressure)
        assert half == pytest.approx(film.pressure[0], rel=1e-6)


def test_what_a_density_at_the_inlet_means_in_pressure(paper):
    films = paper.films["single"]
    assert films[SOFT].pressure[0] == pytest.approx(0.069e9 * np.log(1.0001), rel=1e-9)
    assert films[MNL].pressure[0] == pytest.approx(2.22e9 * 1e-4 / (1.66 - 1.0001), rel=1e-9)


def test_the_modulus_that_touches_the_fit():
    pressure = 1e3
    density = (2.22e9 + 1.66 * pressure) / (2.22e9 + pressure)
    assert pytest.approx(pressure / (density - 1), rel=1e-5) == MODULUS * 1e9


def test_the_step_of_whole_pockets_by_their_averages(paper):
    """p' = 12 η (u <h⁻²>/2 - q <h⁻³>) on average before the step, p' = 12 η (u H⁻²/2 - q H⁻³) behind it."""
    h, u, eta, half = 10e-6, 0.25, 0.04, 0.05
    pocket = h + 5e-6 * np.cos(np.pi * (np.arange(400) + 0.5) / 400) ** 2
    squared, cubed = (pocket**-2.0).mean(), (pocket**-3.0).mean()
    for inlet, pressed in (("pc", 0.0), ("2 pc", 1e5)):
        flow = (pressed / (12 * eta * half) + u * (squared + h**-2) / 2) / (cubed + h**-3)
        step = 12 * eta * half * (flow * h**-3 - u * h**-2 / 2)
        for name in ("cos², 10 mm", "cos², 5 mm"):
            film = paper.patterns[name, inlet]
            assert np.interp(half, film.x, film.pressure) == pytest.approx(step, rel=2e-3)


def test_waves_of_half_the_length_make_half_the_pressure(paper):
    long, short = (paper.patterns[f"sinusoidal, {length} mm", "pc"] for length in (10, 5))
    assert long.peak / short.peak == pytest.approx(2, rel=0.01)
    assert 0.99e6 < long.peak < 1.5e6
    assert long.theta.max() == pytest.approx(1.0003, abs=5e-5)


def test_both_readings_of_the_difference():
    reference, crossing = np.array([1.0, 2.0, 1.0]), np.array([1.5, 2.0, 0.5])
    found = difference(crossing, reference, np.array([1.0, 0.5, 1.0]))
    assert found.integrals == pytest.approx(0)
    assert found.between == pytest.approx(1 / 3)


def test_how_far_a_law_reaches():
    peaks = np.geomspace(1e6, 1e8, 5)
    sweep = SpeedSweep(speeds=peaks, peaks=peaks, differences={CONSTANT: (peaks / 1e9) ** 2})
    assert sweep.reach(CONSTANT, 1e-3) == pytest.approx(1e9 * np.sqrt(1e-3))
    assert sweep.reach(CONSTANT, 0.1) is None
    assert sweep.reach(CONSTANT, 1e-7) == 0


def verdicts(made):
    return {claim.number: claim.verdict for claim in judge(made)}


def test_claims(paper):
    assert verdicts(paper) == {8: "partly", 9: "true", 10: "partly"}


def test_claims_on_films_that_do_the_opposite(paper):
    same = {name: films | dict.fromkeys(films, next(iter(films.values()))) for name, films in paper.films.items()}
    loose = {
        name: replace(sweep, differences=dict.fromkeys(sweep.differences, 0.1 + 0 * sweep.peaks))
        for name, sweep in paper.sweeps.items()
    }
    one = paper.patterns["cos², 5 mm", "pc"]
    opposite = replace(paper, films=same, sweeps=loose, patterns=dict.fromkeys(paper.patterns, one))
    assert verdicts(opposite) == {8: "false", 9: "false", 10: "false"}


def test_the_page(monkeypatch, tmp_path):
    monkeypatch.setattr(paper_b, "compute", partial(compute, cells=512, steps=5))
    paper_b.command(tmp_path)
    page = (tmp_path / "paper_b.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 18
    assert all(f"<h2>B.{number}</h2>" in page for number in range(1, 18))
    assert not re.search(r"""(src|href)\s*=\s*["'](?!#|data:)|url\(\s*["']?(?!#|data:)|@import""", page)
    assert {path.stem for path in tmp_path.glob("B.*.svg")} == {f"B.{number}" for number in range(1, 18)}
    stated = json.loads((tmp_path / "paper_b.json").read_text(encoding="utf-8"))
    assert [claim["number"] for claim in stated["claims"]] == [8, 9, 10]
    assert len(stated["differences"]) == 13
