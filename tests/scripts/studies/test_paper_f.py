"""Sealing of surfaces with exact thresholds, laws found again from surfaces that obey them, verdicts, and the page."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest

from roughfilm.contact.synthetic.sinusoids import sinusoid
from roughfilm.figures import base as figures
from scripts.studies.paper_f import __main__ as paper_f
from scripts.studies.paper_f.claims import LEAKAGE, SEALING, areas_differ, judge
from scripts.studies.paper_f.data import (
    MODULUS,
    THRESHOLD_PRECISION,
    Pressed,
    Series,
    press,
    press_all,
    sealed_contacts,
)
from scripts.studies.paper_f.fits import SLOPE, SealStudy, fit, fit_groups, ratios, read_formulas, sealing_law
from scripts.studies.paper_f.sizes import Sizes
from scripts.studies.paper_f.surfaces import (
    HEIGHTS,
    MAX_AVERAGE,
    MEASURED_AVERAGE,
    MIN_AVERAGE,
    SIDE,
    Numbers,
    made_surfaces,
    measured_surfaces,
    numbers_of,
    scaled,
)

SMALL = {"families": ("smooth", "valley-rich"), "seeds": (503, 504), "points": 32, "parts": (0.01, 0.3, 0.9)}


@pytest.fixture(autouse=True, scope="module")
def few_resamples():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("scripts.studies.paper_f.fits.RESAMPLES", 200)
        yield


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    folder = tmp_path_factory.mktemp("found")
    return paper_f.compute(folder, **SMALL, sizes={32: 2}, scatter={"without a lay": 2, "with a lay": 1}), folder


def test_ridges_seal_across_at_once_and_along_in_full_contact():
    """Westergaard: a sinusoid of amplitude a and wavelength λ is in full contact from π E* a/λ on."""
    amplitude, wavelength = 0.2e-6, SIDE / 2
    ridges = sinusoid(size=(SIDE, SIDE), points=(64, 64), amplitude=amplitude, wavelength_x=wavelength)
    full = np.pi * MODULUS * amplitude / wavelength
    across, along, *_ = sealed_contacts(Series(ridges.heights, ridges.spacing), 2 * np.pi * amplitude / wavelength)
    assert across.load < 1e-6 * full
    assert along.load == pytest.approx(full, rel=0.01)
    assert along.area_fraction == pytest.approx(1, abs=1e-12)


def test_the_eight_heights_of_a_sinusoid():
    """Of z = a cos x cos y: Sq = a/2, Sa = (2/π)² a, every peak a and every valley −a."""
    amplitude = 0.3e-6
    bumps = sinusoid(
        size=(SIDE, SIDE), points=(96, 96), amplitude=amplitude, wavelength_x=SIDE / 3, wavelength_y=SIDE / 3
    )
    found = numbers_of(bumps)
    expected = {"Sa": 4 / np.pi**2, "Sq": 0.5, "St": 2, "Sz": 2, "Sp": 1, "Spm": 1, "Sv": 1, "Svm": 1}
    assert {name: one / amplitude for name, one in found.heights.items()} == pytest.approx(expected, rel=0.01)
    assert found.slope == pytest.approx(amplitude * 2 * np.pi / (SIDE / 3) / np.sqrt(2), rel=1e-6)


def test_families_span_the_heights_of_the_source():
    made = made_surfaces(points=32)
    assert len(made) == len({one.name for one in made}) >= 60
    averages = {}
    for one in made:
        averages.setdefault(one.family, []).append(float(np.abs(one.surface.heights).mean()))
    for row in averages.values():
        assert min(row) == pytest.approx(MIN_AVERAGE)
        assert max(row) == pytest.approx(MAX_AVERAGE)


def test_a_surface_twice_as_high_is_solved_by_scaling():
    (made,) = made_surfaces(("fine",), (505,), 32)
    once = press(made, (0.05, 0.5))
    again = press(replace(made, surface=scaled(made.surface, 2 * once.numbers.heights["Sa"])), (0.05, 0.5))
    assert again.spots.tolist() == once.spots.tolist()
    assert again.threshold == pytest.approx(2 * once.threshold, rel=1e-6)
    for name in ("loads", "mean_gap", "valley", "round_threshold"):
        assert getattr(again, name) == pytest.approx(2 * getattr(once, name), rel=1e-4)
    assert again.area == pytest.approx(once.area, rel=1e-4)
    assert again.direct == pytest.approx(8 * once.direct, rel=1e-3)
    assert again.flow == pytest.approx(8 * once.flow, rel=1e-3)
    assert again.numbers.heights == pytest.approx({name: 2 * one for name, one in once.numbers.heights.items()})


def test_what_is_found_is_in_order(small):
    study, _ = small
    for one in study.sample:
        assert (one.direct >= one.flow * (1 - 1e-3)).all()
        assert (np.diff(one.area) > 0).all()
        assert (np.diff(one.mean_gap) < 0).all()
        assert (one.threshold >= one.round_threshold).all()
        assert one.loads[-1] < one.threshold.max() * (1 + THRESHOLD_PRECISION)
        for i in (0, 1):
            assert ((one.direct[:, i] > 0) == (one.loads < one.threshold[i])).all()
            assert (one.offset[:, i] > one.flow[:, i]).all()
    for area, load in zip(study.sizes.area.values(), study.sizes.load.values(), strict=True):
        assert (area[:, :2] >= area[:, 2:]).all()
        assert (load > 0).all()


def test_finished_surfaces_are_kept_and_damaged_ones_found_again(small, monkeypatch):
    study, folder = small
    asked = []
    monkeypatch.setattr(
        "scripts.studies.paper_f.data.press", lambda made, _: asked.append(made.name) or study.sample[0]
    )
    made = made_surfaces(SMALL["families"], SMALL["seeds"], SMALL["points"])
    read = press_all(made, folder, lambda _: None, SMALL["parts"])
    assert asked == []
    for one, other in zip(read, study.sample, strict=True):
        for name, value in vars(other).items():
            assert np.array_equal(getattr(one, name), value), name
    files = sorted(folder.glob("*_50*.json"))
    files[0].write_text(files[0].read_text(encoding="utf-8")[:500], encoding="utf-8")
    press_all(made, folder, lambda _: None, SMALL["parts"])
    assert len(asked) == 1
    press_all(made, folder, lambda _: None, (0.02, 0.3, 0.9))
    assert len(asked) == 1 + len(made)


def lawful(number, *, k=SEALING, a=LEAKAGE[0], b=LEAKAGE[1], area=0.44, more=1.0, raised=1.0, slope=0.1):
    """A surface that obeys F.14 and F.18 with the constants given."""
    valley, peak = 1e-7 * (number + 2), 1 + 0.3 * (number % 3)
    rule = dict.fromkeys(HEIGHTS, 1e-7 * (7 - number % 5)) | {"Svm": valley, "Sv": 1.1 * valley}
    rule |= {"Spm": peak * valley, "Sp": (2 - 0.1 * (number % 4)) * valley}
    sealed = k * MODULUS * rule["Spm"]
    loads = sealed * np.array([1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.6, 0.9])
    through = (a * np.cbrt(valley) - b * np.cbrt(loads / MODULUS)) ** 9
    flow = np.stack([through, through], axis=1)
    return Pressed(
        family=("smooth", "striated", "fine")[number % 3],
        seed=number,
        size=(SIDE, SIDE),
        numbers=Numbers(heights=rule, slope=slope, decay=4e-6, aspect=1.0, skewness=0.1 * (number % 4)),
        loads=loads,
        area=0.5 * loads / sealed,
        mean_gap=np.full(loads.shape, valley),
        valley=np.cbrt(through),
        flow=flow,
        direct=more * flow,
        offset=raised * flow,
        threshold=np.full(2, sealed),
        round_threshold=np.full(2, sealed),
        sealed_area=np.full(2, area),
        round_area=np.full(2, area),
        sealed_offset=np.zeros(2),
        spots=np.zeros((2, 4, 4), dtype=bool),
    )


def study_of(sample):
    sizes = Sizes(area={5.0: np.full((3, 4), 0.44)}, load={5.0: np.full((3, 4), 0.2)})
    return SealStudy(sample=sample, finer=[], measured=[], sizes=sizes, scatter={}, laws=fit_groups(sample))


def verdicts(sample):
    return {claim.number: claim.verdict for claim in judge(study_of(sample))}


def test_laws_are_found_again_in_surfaces_that_obey_them():
    sample = [lawful(number) for number in range(9)]
    laws = fit(sample)
    peaks = laws.sealing["Spm"]
    assert peaks.constant.value == pytest.approx(SEALING)
    assert peaks.constant.by_surface == pytest.approx((SEALING, SEALING))
    assert (peaks.spread, peaks.explained) == pytest.approx((1, 1))
    law = laws.leakage["Svm", "Svm"]
    assert (law.a.value, law.b.value) == pytest.approx(LEAKAGE)
    assert law.b.by_family == pytest.approx((LEAKAGE[1], LEAKAGE[1]))
    assert (law.apart, law.explained) == pytest.approx((0, 1), abs=1e-9)
    by = {one.scale: one.apart for one in laws.collapses}
    assert max(by["Svm", "Svm"]) < 0.05 < min(by["Sq", "Sq"])
    first, *others = read_formulas(sample)
    assert first.scales
    assert (first.valley, first.leakage, first.missed) == pytest.approx((0, 0, 0), abs=1e-9)
    assert not any(one.scales for one in others)
    assert min(one.leakage for one in others) > 0.3


def test_intervals_cover_what_surfaces_are_drawn_from():
    """Of ln W normal with σ = 0.3, both directions the same: 95 % is 1.96 σ/√n on either side."""
    draw = np.random.default_rng(71)
    sample = [lawful(number, k=SEALING * np.exp(draw.normal(0, 0.3))) for number in range(60)]
    constant = sealing_law(sample, "Spm").constant
    half = np.log(np.divide(*constant.by_surface[::-1])) / 2
    assert half == pytest.approx(1.96 * np.log(ratios(sample, "Spm"))[:, 0].std() / np.sqrt(60), rel=0.15)
    assert constant.by_surface[0] < SEALING < constant.by_surface[1]


def test_verdicts_on_surfaces_that_do_what_the_paper_says():
    assert verdicts([lawful(number) for number in range(9)]) == dict.fromkeys((16, 19, 23, 24, 25, 26), "true")


def test_verdicts_on_surfaces_that_do_the_opposite():
    sample = []
    for number in range(9):
        one = lawful(number, k=9e4, a=1.5, b=0.01, area=0.2, more=1.5, raised=3.0)
        power = (3e-7 / one.numbers.heights["Svm"]) ** 6
        heights = one.numbers.heights | {"Sq": (1 + 0.01 * (number % 2)) * one.threshold[0] / MODULUS / 1e5}
        heights |= {"Spm": heights["Spm"] / (1 + number % 2), "Sp": heights["Sp"] / (1 + number % 4)}
        sample.append(replace(one, direct=one.direct * power, numbers=replace(one.numbers, heights=heights)))
    found = verdicts(sample)
    assert {number: found[number] for number in (19, 23, 24, 25, 26)} == dict.fromkeys((19, 23, 24, 25, 26), "false")
    alike = [replace(one, loads=one.loads / one.loads[-1] * 5e5) for one in sample]
    assert areas_differ(replace(study_of(sample), sample=alike))[0] == "false"


def test_the_page(monkeypatch, tmp_path, small):
    study, _ = small
    monkeypatch.setattr(paper_f, "compute", lambda *_: study)
    rendered = figures.svg
    monkeypatch.setattr(figures, "svg", lambda drawn: rendered(drawn) if len(drawn.axes) == 2 else "<svg></svg>")
    paper_f.command(tmp_path)
    page = (tmp_path / "paper_f.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 11
    assert not re.search(r"""(src|href)\s*=\s*["'](?!#|data:|https://doi)|@import""", page)
    report = json.loads((tmp_path / "paper_f.json").read_text(encoding="utf-8"))
    assert [claim["number"] for claim in report["claims"]] == [16, 19, 23, 24, 25, 26]
    assert report["laws"]["all"]["sealing"][SLOPE]["scale"] == SLOPE
    assert len(report["surfaces"]) == 4
    assert {name: len(one["loads"]) for name, one in report["scatter"].items()} == {"without a lay": 2, "with a lay": 1}
    low, high = report["scatter"]["without a lay"]["interval"]
    assert 0.05 < low <= report["scatter"]["without a lay"]["mean"] <= high < 0.5


def test_measured_surfaces_are_shrunk_and_scaled(tmp_path):
    heights = np.random.default_rng(79).normal(size=(128, 96)).cumsum(axis=0)
    (tmp_path / "ground.csv").write_text(
        "# spacing: 2 um, 2 um; heights: um\n" + "\n".join(",".join(f"{z:.6f}" for z in row) for row in heights),
        encoding="utf-8",
    )
    (one,) = measured_surfaces(tmp_path, 32, ["ground.csv", "absent.x3p"])
    assert one.family == "ground"
    assert max(one.surface.size) == pytest.approx(SIDE)
    assert min(one.surface.size) < 0.9 * SIDE
    assert numbers_of(one.surface).heights["Sa"] == pytest.approx(MEASURED_AVERAGE)
    assert measured_surfaces(None) == []
