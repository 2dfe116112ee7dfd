"""Whether error bars hold: gaps known on every grid as sums of waves, against what finer grids tend to."""

import numpy as np
import pytest

from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.homogenization.flow_factors import flow_factors

SIDE, NODES = 1e-3, 64
SIZE = {"size": (SIDE, SIDE), "rms_height": 1e-6}


def rough(seed, hurst, shortest):
    """Of so many nodes is the shortest wave on the coarse grid."""
    waves = {"hurst": hurst, "roll_off": SIDE / 4, "cut_off": shortest * SIDE / NODES}
    return lambda n: self_affine(**SIZE, points=(n, n), seed=seed, **waves).heights


def smooth(seed, anisotropy, angle):
    lay = {"anisotropy": anisotropy, "lay_angle": angle, "correlation_length": 0.06 * SIDE}
    return lambda n: gaussian(**SIZE, points=(n, n), seed=seed, **lay).heights


SURFACES = {
    "rough": rough(211, 0.3, 4),
    "self-affine": rough(223, 0.8, 4),
    "resolved": rough(227, 0.8, 12),
    "isotropic": smooth(229, 1.0, 0.0),
    "ridges along": smooth(233, 5.0, 0.0),
    "oblique": smooth(239, 4.0, 0.6),
}
CONTACTS = (None, 0.1, 0.3)


@pytest.fixture(scope="module")
def off():
    """By surface and contact: A₁₁, A₂₂ and B₁ less what two finer grids tend to, over their bars."""
    found = {}
    for name, heights in SURFACES.items():
        finest = heights(4 * NODES)
        for contact in CONTACTS:
            top = finest.max() + 1e-6 if contact is None else np.quantile(finest, 1 - contact)

            def values(n, heights=heights, top=top):
                return np.maximum(top - heights(n), 0.0), (SIDE / n, SIDE / n)

            own = flow_factors(*values(NODES))
            coarse, fine = (three(solve_cell(*values(n), tolerance=1e-7).factors) for n in (2 * NODES, 4 * NODES))
            truth = fine + (fine - coarse) / 3
            found[name, contact] = np.abs(three(own.factors) - truth) / three(own.uncertainty)
    return found


def three(factors):
    return np.array([factors.pressure[0, 0], factors.pressure[1, 1], factors.shear[0]])


def test_nineteen_of_twenty_errors_are_within_their_bars(off):
    ratios = np.concatenate(list(off.values()))
    assert np.mean(ratios <= 1) >= 0.95
    assert ratios.max() < 3


def test_bars_are_no_wider_than_they_need_be(off):
    assert np.median(np.concatenate(list(off.values()))) > 0.2
