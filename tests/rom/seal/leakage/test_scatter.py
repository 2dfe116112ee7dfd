"""The scatter of the sealing load between independent surfaces."""

import numpy as np

from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.synthetic.distribution import rms_slope
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.seal.leakage.percolation import thresholds
from roughfilm.rom.seal.leakage.scatter import MEAN_SEALING_LOAD, SEALING_LOADS


def reduced_sealing_loads(seed):
    """W/(E* g') at the thresholds between the ends of a surface, in x and in y."""
    surface = self_affine(
        size=(1.0, 1.0),
        points=(64, 64),
        seed=seed,
        hurst=0.8,
        roll_off=0.3,
        cut_off=0.1,
        rms_slope=0.01,
        amplitudes="random",
    )
    press, unit = Press(surface.heights, surface.spacing, 1.0), rms_slope(surface)
    found = thresholds(lambda load, start: press.at(load, start=start), 0.3 * unit, 10 * unit)
    return [threshold.load / unit for threshold in found[:2]]


def test_nearly_all_directions_of_surfaces_without_a_lay_seal_within_the_interval():
    loads = np.array([reduced_sealing_loads(seed) for seed in range(8100, 8124)])
    low, high = SEALING_LOADS["without a lay"]
    assert np.mean((loads > low) & (loads < high)) >= 0.9
    assert np.exp(np.log(loads).mean()) == np.clip(np.exp(np.log(loads).mean()), 0.2, 0.24)
    assert low < MEAN_SEALING_LOAD < high
