"""A rearranged profile keeps its heights, its steps small and its crossings, and little of its order."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.rearrangement import rearranged


def steps(ring):
    return np.abs(ring - np.roll(ring, 1))


def rough(count, seed):
    """A profile of many peaks whose ends do not meet: noise, smoothed over seven points, on a slope."""
    noise = np.random.default_rng(seed).standard_normal(count)
    return 1e-6 * (np.convolve(noise, np.hanning(9), mode="same") + np.linspace(0, 2, count))


@pytest.mark.parametrize("count", [500, 2047])
@pytest.mark.parametrize("folds", [1, 3])
def test_heights_are_kept_bit_for_bit_and_steps_stay_small(count, folds):
    profile = rough(count, 611)
    made = rearranged(profile, seed=907, folds=folds)
    assert (np.sort(made) == np.sort(profile)).all()
    assert steps(made).max() <= 2 * folds * np.abs(np.diff(profile)).max()
    assert np.sqrt(np.mean(steps(made) ** 2)) < 2 * folds * np.sqrt(np.mean(np.diff(profile) ** 2))


def test_a_period_keeps_its_greatest_step_and_crosses_every_level_as_often():
    x = 2 * np.pi * np.arange(1200) / 1200
    profile = sum(np.cos(k * x + k**2) / k for k in (3, 8, 17, 29))
    made = rearranged(profile, seed=1013, folds=0)
    assert (np.sort(made) == np.sort(profile)).all()
    assert steps(made).max() <= steps(profile).max()
    assert steps(made).sum() == pytest.approx(steps(profile).sum(), rel=1e-12)
    for level in np.linspace(-1.5, 1.5, 31):
        crossings = [np.count_nonzero((ring > level) != (np.roll(ring, 1) > level)) for ring in (profile, made)]
        assert crossings[0] == crossings[1]


def test_little_of_the_order_is_left():
    """Of the pairs of neighbours few remain, and the autocorrelation at some distance is lost."""
    profile = rough(4096, 2221)
    made = rearranged(profile, seed=3499)
    pairs = [{frozenset(pair) for pair in zip(ring, np.roll(ring, 1), strict=True)} for ring in (profile, made)]
    folded = {frozenset(pair) for pair in zip(profile[:-2], profile[2:], strict=True)}
    assert len(pairs[1] & (pairs[0] | folded)) < 0.1 * len(pairs[1])
    kept = rearranged(profile, seed=3499, levels=0)
    assert len({frozenset(pair) for pair in zip(kept, np.roll(kept, 1), strict=True)} & folded) > 0.99 * 4094


def test_half_of_the_stretches_are_turned_round():
    """Teeth that rise in eight steps and fall in two keep this, turned or not; of all steps half rise afterwards."""
    heights = np.random.default_rng(4447).uniform(0.9, 1.1, 300)[:, None]
    profile = (heights * np.array([0, 1, 2, 3, 4, 5, 6, 7, 8, 4]) / 8).ravel()
    rising = [np.mean(np.diff(ring) > 0) for ring in (profile, rearranged(profile, seed=4451, folds=0))]
    assert rising[0] == pytest.approx(0.8, abs=0.01)
    assert rising[1] == pytest.approx(0.5, abs=0.05)


def test_folds_give_a_smooth_profile_more_peaks():
    profile = np.sin(np.linspace(0, np.pi, 800))
    made = rearranged(profile, seed=5003, folds=8)
    peaks = np.count_nonzero((made >= np.roll(made, 1)) & (made > np.roll(made, -1)))
    assert peaks == 16
    assert steps(made).max() <= 16 * np.diff(profile).max()


def test_the_seed_decides():
    profile = rough(700, 77)
    assert (rearranged(profile, seed=11) == rearranged(profile, seed=11)).all()
    assert (rearranged(profile, seed=11) != rearranged(profile, seed=12)).mean() > 0.9


@settings(max_examples=60, deadline=None)
@given(
    arrays(float, st.integers(2, 40), elements=st.floats(-1e3, 1e3) | st.sampled_from([0.0, 1.0, 2.0, -1.0])),
    st.integers(0, 2**63 - 1),
    st.booleans(),
)
def test_any_profile(profile, seed, folded):
    folds = int(folded and profile.size >= 4)
    made = rearranged(profile, seed=seed, folds=folds, levels=40)
    ring = rearranged(profile, seed=seed, folds=folds, levels=0)
    assert (np.sort(made) == np.sort(profile)).all()
    assert steps(made).max() <= steps(ring).max()


@pytest.mark.parametrize(
    ("profile", "changes", "words"),
    [
        ([1.0], {}, "at least 2 points"),
        ([[1.0, 2.0], [3.0, 4.0]], {}, "one dimension"),
        ([], {}, "at least 2 points"),
        ([0.0, np.nan, 1.0, 2.0], {}, "finite"),
        ([0.0, np.inf, 1.0, 2.0], {}, "finite"),
        ([0.0, 1e200, 1.0, 2.0], {}, "finite"),
        ([0.0, 1.0, 2.0, 3.0], {"folds": 2}, "folds"),
        ([0.0, 1.0, 2.0, 3.0], {"folds": -1}, "folds"),
        ([0.0, 1.0, 2.0, 3.0], {"seed": -1}, "seed"),
        ([0.0, 1.0, 2.0, 3.0], {"seed": 1.5}, "seed"),
        ([0.0, 1.0, 2.0, 3.0], {"levels": 1.5}, "levels"),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_line(profile, changes, words):
    with pytest.raises(InputError, match=words) as caught:
        rearranged(np.array(profile), **({"seed": 17} | changes))
    assert "\n" not in str(caught.value)
