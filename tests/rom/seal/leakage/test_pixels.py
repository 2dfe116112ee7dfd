"""The uncertainty of a permeability by the pixels of the contact, against finer pixels of the same surface."""

import numpy as np
import pytest

from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.seal.leakage.homogenized import homogenized_leakage
from roughfilm.rom.seal.leakage.passage import shut
from roughfilm.rom.seal.leakage.pixels import with_pixels


@pytest.mark.parametrize(("hardness", "load"), [(np.inf, 3e7), (1e9, 1e8)])
def test_it_covers_what_finer_pixels_change(hardness, load):
    """A synthetic surface is the same on every grid that resolves it; no factor is fitted to these surfaces."""
    alone, together = [], []
    for seed, shortest in ((11, 6), (12, 8), (13, 12), (14, 16), (15, 18), (16, 20)):

        def pressed(points, seed=seed, shortest=shortest):
            surface = self_affine(
                size=(1e-3, 1e-3),
                points=(points, points),
                seed=seed,
                hurst=0.7,
                roll_off=0.5e-3,
                cut_off=shortest * 1e-3 / 48,
                rms_slope=0.1,
            )
            contact = Press(surface.heights, surface.spacing, 1e11, hardness=hardness).at(load)
            return contact, homogenized_leakage(contact.gap, contact.spacing)

        (contact, coarse), (_, fine) = pressed(48), pressed(192)
        for direction, one, truth in ((0, coarse.along, fine.along), (1, coarse.across, fine.across)):
            error = abs(one.permeability - truth.permeability)
            alone.append(error / one.uncertainty)
            together.append(error / with_pixels(one, contact, direction).uncertainty)
    assert np.mean(np.array(alone) <= 1) < 0.9
    assert np.mean(np.array(together) <= 1) >= 0.9
    assert max(together) <= 2
    assert np.median(together) >= 0.1


def test_a_sealed_gap_stays_as_it_is():
    contact = Press(np.cos(np.add.outer(np.arange(8.0), np.arange(8.0))), (1.0, 1.0), 1.0).at(0.01)
    passage = shut((8, 8))
    assert with_pixels(passage, contact, 0) is passage
