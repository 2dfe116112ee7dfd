"""The map of windows: its surfaces have the statistics that it takes as the truth; its judge finds bad intervals."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from roughfilm.stability import windows as stability_windows
from roughfilm.stability.checks import coverage
from roughfilm.stability.checks.coverage import of_measurements, of_subsets
from roughfilm.stability.form import MapOutcome
from roughfilm.stability.questions import windows as questions
from roughfilm.stability.questions.windows import (
    Extrapolation,
    extrapolations,
    geometric,
    measurements,
    self_affine,
    wavy,
    with_correlation,
)
from roughfilm.stability.windows import judged, probes, summary


@pytest.mark.parametrize(
    "surface",
    [with_correlation(6, 128), with_correlation(4, 128, 3.0), self_affine(0.8, 16, 128), wavy(4, 16, 0.5, 128)],
)
def test_the_surfaces_have_the_statistics_that_are_taken_as_the_truth(surface):
    rng, amplitudes = np.random.default_rng(1), surface.amplitudes()
    drawn = np.stack([surface.draw(rng, amplitudes) for _ in range(60)])
    assert np.sqrt(np.mean(drawn**2)) == pytest.approx(1, rel=0.05)
    assert geometric(drawn).mean(axis=0)[1:] == pytest.approx(surface.truth()[1:], rel=0.05)


def test_the_autocorrelation_falls_to_a_fifth_at_the_correlation_length():
    surface = with_correlation(6, 512, 3.0)
    r = np.fft.irfft2(surface.amplitudes() ** 2, s=(512, 512))
    assert (r[6, 0], r[0, 18]) == pytest.approx((0.2, 0.2), abs=0.01)


def lognormal(shape, spread=0.4):
    return np.exp(spread * np.random.default_rng(2).standard_normal(shape))


@pytest.mark.parametrize("count", [4, 40])
def test_subsets_of_independent_values_are_covered_in_95_of_100_cases(count):
    """With 40 of 160 values the error from the mean of all would be an eighth too small without its correction."""
    for found in of_subsets(lognormal(160), count, 400, np.random.default_rng(3)):
        assert found.rate == pytest.approx(0.95, abs=0.03)
        assert found.half_width == pytest.approx(found.needed, rel=0.2) or count < 10


def test_measurements_of_which_fewer_windows_are_independent_are_covered_only_if_they_are_counted_so():
    """Each of 4 values stands in the data four times."""
    values = np.repeat(lognormal((300, 4), 0.2), 4, axis=1)
    right, _ = of_measurements(values, np.full(300, 4.0))
    wrong, _ = of_measurements(values, np.full(300, 16.0))
    assert right.rate == pytest.approx(0.95, abs=0.03)
    assert wrong.rate < 0.75
    assert judged(right).right
    assert (judged(wrong).right, judged(wrong).reported, judged(wrong).why) == (False, False, "too narrow")
    none, _ = of_measurements(values, np.full(300, 2.0))
    assert none.given == 0


def test_intervals_that_are_too_wide_are_inaccurate_and_said_so():
    found, _ = of_subsets(lognormal(160), 10, 100, np.random.default_rng(3))
    wide = judged(replace(found, half_width=2 * found.needed, rate=1.0))
    assert (wide.right, wide.reported, wide.why) == (False, True, "too wide")


def test_too_narrow_intervals_of_the_statistics_are_found(monkeypatch):
    """The map is of the statistics themselves: intervals a third as wide are wrong on it."""
    true = coverage.scatter

    def narrow(*arguments, **options):
        found = true(*arguments, **options)
        low, high = found.mean_interval
        return replace(found, mean_interval=(found.mean - (found.mean - low) / 3, found.mean + (high - found.mean) / 3))

    monkeypatch.setattr(coverage, "scatter", narrow)
    found, further = of_subsets(lognormal(160), 10, 100, np.random.default_rng(3))
    assert judged(found).why == "too narrow"
    assert judged(further).right


def test_the_probes_are_different_and_two_windows_give_no_interval():
    asked = list(probes(64))
    places = {(one.group, one.row, one.column) for one in asked}
    assert len(places) == len(asked)
    assert {one.column for one in asked if one.refused and "windows" in one.column} == {"2 windows"}


def test_windows_far_apart_hold_and_scratches_in_few_of_them_do_not(monkeypatch):
    monkeypatch.setattr(questions, "BANK", 40)
    monkeypatch.setattr(stability_windows, "DRAWS", 100)
    monkeypatch.setattr(stability_windows, "SIDES", (4,))
    monkeypatch.setattr(stability_windows, "NUMBERS", (2, 5, 20))
    asked = [one for one in probes(32) if "one measurement" not in one.group and one.group != "whole surface"]
    spots = [one.spot() for one in asked if "scratches" not in one.group or one.row == "0.1 a window"]
    counts = Counter(spot.outcome for spot in spots if "scratches" not in spot.group)
    assert counts[MapOutcome.REFUSED] == 8
    assert counts[MapOutcome.WRONG] == counts[MapOutcome.STALLED] == 0
    scratched = [spot for spot in spots if spot.group == "mean, gap cubed, scratches"]
    assert scratched[0].why == "too narrow"
    assert any(line.startswith("Too narrow: mean, gap cubed, scratches: 0.1 a window") for line in summary(spots))


def test_windows_of_one_measurement_and_of_three_sizes_are_judged(monkeypatch):
    monkeypatch.setattr(stability_windows, "MEASUREMENTS", 30)
    monkeypatch.setattr(stability_windows, "EXTRAPOLATED", 6)
    lay = next(one for one in measurements(16) if "16 λ" in one.row)
    assert {probe.spot().outcome for probe in stability_windows._placed(lay, 16)} <= {
        MapOutcome.CONVERGED,
        MapOutcome.INACCURATE,
    }
    asked = [one for one in extrapolations(32) if one.column in ("Hurst 0.8 up to 4 L", "Hurst 0.8 up to 0.25 L")]
    outcomes = [[probe.spot().outcome for probe in stability_windows._extrapolated(one, 32)] for one in asked]
    assert all(one in (MapOutcome.CONVERGED, MapOutcome.INACCURATE) for one in outcomes[0])
    assert outcomes[1] == [MapOutcome.REFUSED] * 3
    unseen = Extrapolation(column="waves", surface=wavy(4, 128, 0.8, 256))
    sq, slope, _ = (probe.spot() for probe in stability_windows._extrapolated(unseen, 32))
    assert (sq.why, slope.numbers["coverage"]) == ("too narrow", 1.0)
