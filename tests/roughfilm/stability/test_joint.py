"""Flow through windows of a random surface whose edges are joined, against periodic surfaces of the same statistics."""

import numpy as np
import pytest

from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.preparation.edges.blending import blend_edges
from roughfilm.contact.preparation.edges.seams import join_by_seams
from roughfilm.contact.preparation.window import Window, cut_window
from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.rom.homogenization.flow_factors import flow_factors

NODES, WAVES = 64, 1e-5


def surface(seed, periods):
    return gaussian(
        size=(1e-4 * periods, 1e-4 * periods),
        points=(NODES * periods, NODES * periods),
        seed=seed,
        rms_height=1e-6,
        correlation_length=WAVES,
    )


def permeability(cell):
    """Mean over both directions, m³, pressed to a contact area of about 15 %."""
    gap = Press(cell.heights, cell.spacing, 1e11).at(2e9, tolerance=1e-4).gap
    return np.trace(flow_factors(gap, cell.spacing, tolerance=1e-3).factors.pressure) / 2


def test_seams_pass_as_much_liquid_as_periodic_surfaces_and_blended_margins_throttle_it():
    window, width = Window(start=(50, 40), shape=(NODES, NODES)), (WAVES / 4, WAVES / 4)
    periodic, by_seams, by_blending = [], [], []
    for seed in range(6):
        large = surface(seed, 3)
        joined, _ = join_by_seams(large, window, "both", width=width, filled=np.zeros(large.shape, bool))
        blended = blend_edges(cut_window(large, window), "both", width=width)
        periodic.append(permeability(surface(100 + seed, 1)))
        by_seams.append(permeability(joined.surface))
        by_blending.append(permeability(blended.surface))
    scatter = np.hypot(np.std(periodic), np.std(by_seams)) / np.sqrt(len(periodic))
    assert np.mean(by_seams) == pytest.approx(np.mean(periodic), abs=2.5 * scatter)
    assert np.mean(by_blending) < 0.85 * np.mean(by_seams)
