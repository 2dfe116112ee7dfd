"""Windows of a seal beside each other and in series, and their sealing loads."""

import numpy as np
import pytest

from roughfilm.rom.seal.leakage.percolation import Side, Threshold
from roughfilm.rom.seal.leakage.windows import _sealing, permeability_in_series


def harmonic(values):
    return values.shape[-1] / np.sum(1 / values, axis=-1)


def test_one_window_in_series_is_the_arithmetic_mean_and_very_many_are_the_harmonic_one():
    values = np.array([1.0, 3.0, 10.0, 0.2])
    assert permeability_in_series(values, 1) == pytest.approx(values.mean(), rel=1e-12)
    assert permeability_in_series(values, 10**6) == pytest.approx(harmonic(values), rel=1e-4)
    assert permeability_in_series([2.5e-21] * 5, 7) == pytest.approx(2.5e-21, rel=1e-12)


def test_two_windows_in_series_are_the_mean_over_all_pairs():
    values = np.array([1.0, 3.0, 10.0, 0.2, 1e-6])
    pairs = np.array([(one, two) for one in values for two in values])
    assert permeability_in_series(values, 2) == pytest.approx(harmonic(pairs).mean(), rel=1e-9)


def test_three_windows_in_series_leak_nothing_if_one_of_them_is_sealed():
    values = [0.0, 0.0, 4.0, 1.0]
    triples = np.array([(a, b, c) for a in values[2:] for b in values[2:] for c in values[2:]])
    assert permeability_in_series(values, 3) == pytest.approx(harmonic(triples).mean() / 8, rel=1e-9)
    assert permeability_in_series([0.0, 0.0], 3) == 0.0


def test_sealing_loads_are_known_only_if_every_window_seals():
    seals = [
        Threshold(open=Side(load=load, area_fraction=0.4), sealed=Side(load=1.01 * load, area_fraction=0.41))
        for load in (1e5, 1.3e5, 1.1e5, 0.9e5)
    ]
    never = Threshold(open=Side(load=1e7, area_fraction=0.9), sealed=None)
    always = Threshold(open=None, sealed=Side(load=1.0, area_fraction=0.0))
    known = _sealing(seals, 4.0)
    assert known.load.value == pytest.approx(np.mean([one.load for one in seals]))
    assert known.load.uncertainty == pytest.approx(0.005 * np.mean([1e5, 1.3e5, 1.1e5, 0.9e5]))
    assert known.load.interval[0] < 0.9e5
    assert known.load.interval[1] > 1.3e5
    some = _sealing([*seals, never], 5.0)
    assert (some.sealing, some.always, some.load) == (0.8, 0.0, None)
    flat = _sealing([*seals, always], 5.0)
    assert (flat.sealing, flat.always, flat.load.zeros) == (1.0, 0.2, 0.2)
