"""Profiles as the table has them, films against collocation, verdicts on films that do the opposite, and the page."""

import json
import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from roughfilm.contact.parameters.heights import height_statistics
from roughfilm.rom.homogenization.line import line_factors, profile_over_gap
from roughfilm.rom.homogenization.node_sums import Rule
from scripts.studies.paper_c import __main__ as paper_c
from scripts.studies.paper_c.claims import against, judge, order_holds_to
from scripts.studies.paper_c.data import BESIDE, RANGE, TABLE, WAYS, RuleConvergence, compute, gap, make
from scripts.studies.paper_c.films import (
    CLEARANCES,
    LOADS,
    MODULUS,
    SMOOTH,
    SPAN,
    SPEED,
    VISCOSITY,
    Curve,
    FilmOrdering,
    by_rule,
    curve,
    solved,
    tabled,
    wedge,
)

small = partial(compute, seeds=(203,), powers=(9, 10, 11), refined=1024, shuffles=(301, 302), random=4)


@pytest.fixture(scope="module")
def paper():
    return small(lambda *_: None)


@pytest.mark.parametrize("name", TABLE)
def test_profiles_have_all_five_numbers(name):
    heights, row = make(name, 207), TABLE[name]
    found = height_statistics(heights)
    assert found.peak == pytest.approx(row.peak, rel=1e-6)
    assert (found.average, found.rms, found.kurtosis) == pytest.approx((row.average, row.rms, row.kurtosis), rel=1e-6)
    assert found.skewness == pytest.approx(row.skewness, abs=1e-6)
    assert gap(heights, 0.98).min() == pytest.approx(0.02, rel=1e-9)
    assert gap(heights, 0.98).mean() == pytest.approx(1, rel=1e-12)


def by_collocation(thickness, factors, modulus):
    """Eq. C.19 is linear in θ; integrated once it has two unknowns, θ and the flow."""
    gamma = 6 * VISCOSITY * SPEED / modulus

    def slope(x, y):
        pressure, shear = factors(thickness(x * SPAN))
        return np.stack([SPAN * gamma * (shear * y[0] - 5e-6 * y[1]) / pressure, 0 * x])

    x = np.linspace(0, 1, 101)
    ends = lambda start, end: np.array([start[0] - 1, end[0] - 1])  # noqa: E731
    found = solve_bvp(slope, ends, x, np.ones((2, x.size)), tol=1e-7)
    assert found.success
    return lambda places: modulus * np.log(found.sol(places / SPAN)[0])


def smooth(mean):
    return mean**3, mean


def waves(mean):
    part = 1 - (1e-6 / mean) ** 2
    return mean**3 * part**2.5 / (1.5 - part / 2), mean * part / (1.5 - part / 2)


@pytest.mark.parametrize("modulus", [MODULUS, 1e10])
@pytest.mark.parametrize("rough", [False, True])
def test_films_against_collocation(modulus, rough):
    thickness = wedge(3e-6, 0.4e-6)
    heights = 1e-6 * np.cos(2 * np.pi * np.arange(512) / 512)
    found = solved(thickness, profile_over_gap(heights) if rough else None, cells=1024, modulus=modulus)
    exact = by_collocation(thickness, waves if rough else smooth, modulus)
    assert found.pressure == pytest.approx(exact(found.x), abs=3e-5 * found.pressure.max())


def test_a_stiff_lubricant_is_the_plane_slider():
    """The greatest pressure is 6ηuL/h² K/(4 (1 + K)(2 + K)), from (1 + K) h to h."""
    film = solved(wedge(4e-6, 4e-6), None, modulus=1e15)
    rise = 1.0
    expected = 6 * VISCOSITY * SPEED * SPAN / 4e-6**2 * rise / (4 * (1 + rise) * (2 + rise))
    assert film.pressure.max() == pytest.approx(expected, rel=1e-4)


def test_factors_between_table_places():
    heights = make("B", 203)
    top = float(heights.max())
    exact = profile_over_gap(heights)
    found = tabled(exact, top, (CLEARANCES[0], CLEARANCES[-1]))
    mean = top + np.geomspace(CLEARANCES[0], CLEARANCES[-1], 60)
    for name in ("along", "across", "drag", "couette"):
        assert getattr(found(mean), name) == pytest.approx(getattr(exact(mean), name), rel=1e-5)
    assert found(mean).shear_couette * mean == pytest.approx(exact(mean).shear_couette * mean, abs=1e-4)


def test_rules_tend_to_the_closed_form_in_films():
    heights = make("D", 205)
    exact = solved(wedge(5e-6, 1e-6), profile_over_gap(heights), cells=64).load
    top = float(heights.max())
    sums = tabled(by_rule(heights, 2048, Rule.SIMPSON), top, (5e-6 - top, 6e-6 - top), 8)
    by_sums = solved(wedge(5e-6, 1e-6), sums, cells=64).load
    assert by_sums == pytest.approx(exact, rel=1e-7)


def test_films_stand_as_the_paper_has_them(paper):
    """Equal h0: the smooth film bears most; equal mean: the rough ones; equal Λ: the smoothest by far."""
    peaks = {name: [film.pressure.max() for _, film in sorted(shown.items())] for name, shown in paper.films.items()}
    a, b, c, d, s = peaks["C.10"]
    assert s > c > b > d > a
    a, b, c, d, s = peaks["C.11"]
    assert a > d > b > c > s
    a, b, c, d = peaks["C.12"]
    assert c > 3 * b > 3 * d > 3 * a
    assert max(peaks["C.10"]) < 100e6
    assert max(peaks["C.12"]) < 140e6


def test_a_curve_goes_through_its_films():
    found = curve(None, cells=64)
    places = CLEARANCES[[5, 17, 30]]
    assert found.at([solved(wedge(h, 1e-6), None, cells=64).load for h in places]) == pytest.approx(places, rel=1e-9)
    assert np.isnan(found.at([1e12])).all()


def test_nodes_and_orders_of_a_known_error():
    nodes = 2.0 ** np.arange(8, 14)
    made = RuleConvergence(
        nodes=nodes,
        exact=np.ones((1, 2)),
        found={(Rule.SIMPSON, 0): (1 + 1e4 / nodes**2)[None, :, None] * np.ones(2)},
    )
    assert made.order(Rule.SIMPSON, 0) == pytest.approx(2)
    assert made.needed(Rule.SIMPSON, 0, 1e-3) == pytest.approx([np.sqrt(1e7)])
    assert np.isnan(made.needed(Rule.SIMPSON, 0, 1e-9)).all()
    assert made.needed(Rule.SIMPSON, 0, 1.0) == pytest.approx([256])
    change = made.changes(Rule.SIMPSON, 0)[0, -1, 0]
    assert change == pytest.approx(1e4 * (1 / nodes[-2] ** 2 - 1 / nodes[-1] ** 2), rel=1e-3)


def test_simpson_in_the_study_is_nearer_on_the_points(paper):
    for (name, alpha), study in paper.convergence.items():
        on, beside = (study.errors(Rule.SIMPSON, left_out)[:, -1, 0].max() for left_out in (0, BESIDE))
        assert on < beside or alpha > 0.9, name
        assert study.exact[0] == pytest.approx(
            [line_factors(gap(paper.profiles[name][0], alpha)).factors.relative.pressure[0, 0], study.exact[0, 1]]
        )


def test_sums_over_rearranged_heights_are_the_same(paper):
    for name in TABLE:
        values = paper.shuffled[name, WAYS[0]]
        assert values.shape == (3, RANGE.size, 2)
        assert np.ptp(values, axis=0) == pytest.approx(0, abs=1e-12)
        assert np.ptp(paper.shuffled[name, WAYS[1]], axis=0).max() > 1e-4


def line_of(factor, rms=1e-7):
    """A load that falls with the square of the clearance."""
    return [Curve(clearance=CLEARANCES, load=1e6 * factor * (1e-6 / CLEARANCES) ** 2, rms=rms)]


def test_order_of_curves():
    good = {SMOOTH: line_of(8), "C": line_of(7), "B": line_of(6), "D": line_of(5), "A": line_of(4)}
    assert order_holds_to(good) > LOADS[-1]
    assert order_holds_to(good | {"C": line_of(3)}) == 0
    crossing = [replace(line_of(4)[0], load=1e6 * 4 * (1e-6 / CLEARANCES) ** 3)]
    # 5 MN/m (µm/c)² is 4 MN/m (µm/c)³ at c = 0.8 µm, where both are 7.8 MN/m
    assert order_holds_to(good | {"A": crossing}) == pytest.approx(5e6 / 0.8**2, rel=0.03)


def test_pairs_against_the_order():
    rough, thin = np.array([1.0, 2.0, 8.0]), np.array([3.0, 2.0, 1.0])
    assert against(rough, thin) == 1
    assert against(rough, np.array([3.0, 1.0, 2.0])) == pytest.approx(4)
    made = FilmOrdering(numbers={"Ra": rough}, clearance=np.array([[3.0], [1.0], [2.0]]))
    assert made.concordance("Ra", 0) == pytest.approx(2 / 3)


def verdicts(made):
    return {claim.number: claim.verdict for claim in judge(made)}


def orderings(sign):
    rough = np.linspace(1, 2, 8)
    numbers = dict.fromkeys(("Ra", "Rq", "rmax"), rough)
    one = FilmOrdering(numbers=numbers, clearance=np.tile((10 - sign * rough)[:, None], len(LOADS)))
    return {"random": one, "of one Ra": one}


def studies(simpson, others):
    nodes = 2.0 ** np.arange(10, 18)

    def errors(order):
        return (1 + (nodes / 512) ** -order)[None, :, None] * np.ones(2)

    found = {
        (rule, left_out): errors(simpson if rule is Rule.SIMPSON else others)
        for rule in Rule
        for left_out in (0, BESIDE)
    }
    return RuleConvergence(nodes=nodes, exact=np.ones((1, 2)), found=found)


def test_verdicts_on_what_the_paper_says_and_on_the_opposite(paper):
    curves = {SMOOTH: line_of(8), "C": line_of(7), "B": line_of(6), "D": line_of(5), "A": line_of(4)}
    says = replace(
        paper,
        convergence=dict.fromkeys(paper.convergence, studies(4, 2)),
        curves=curves,
        orderings=orderings(1),
    )
    assert verdicts(says) == {11: "true", 12: "true", 14: "true"}
    turned = {key: values * np.linspace(1, 2, len(values))[:, None, None] for key, values in paper.shuffled.items()}
    opposite = replace(
        paper,
        convergence=dict.fromkeys(paper.convergence, studies(2, 4)),
        shuffled=turned,
        curves=curves | {"A": line_of(9)},
        orderings=orderings(-1),
    )
    assert verdicts(opposite) == {11: "false", 12: "false", 14: "false"}


def test_the_page(monkeypatch, tmp_path, paper):
    monkeypatch.setattr(paper_c, "compute", lambda _advance: paper)
    paper_c.command(tmp_path)
    page = (tmp_path / "paper_c.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 11
    assert all(f"<h2>C.{number}</h2>" in page for number in range(4, 14))
    assert not re.search(r"""(src|href)\s*=\s*["'](?!#|data:)|url\(\s*["']?(?!#|data:)|@import""", page)
    assert {path.stem for path in tmp_path.glob("C.*.svg")} == {f"C.{number}" for number in range(4, 14)}
    stated = json.loads((tmp_path / "paper_c.json").read_text(encoding="utf-8"))
    assert [claim["number"] for claim in stated["claims"]] == [11, 12, 14]
    assert stated["claims"][0]["verdict"] == "true"
    assert stated["profiles"]["C"]["peak"] == pytest.approx(0.57e-6, rel=1e-6)
