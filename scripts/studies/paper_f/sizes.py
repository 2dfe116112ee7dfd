"""Sealing thresholds of random surfaces of one kind with growing size, for the scatter of small surfaces."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.synthetic.distribution import rms_slope
from roughfilm.contact.synthetic.gaussian import gaussian
from scripts.studies.paper_f.data import MODULUS, THRESHOLD_PRECISION, Series, sealed_contacts
from scripts.studies.paper_f.surfaces import SIDE
from scripts.studies.study import kept

CORRELATION = 4e-6
"""Correlation length Sal, m."""

NODES_PER_SIDE = 128
"""Number of nodes along ``SIDE``."""

COUNTS: Mapping[int, int] = {64: 32, 128: 24, 256: 12, 512: 6}
"""Number of surfaces by the number of nodes along a side."""


@dataclass(frozen=True, kw_only=True)
class Sizes:
    """Areas and loads at the thresholds of surfaces, by the side over the correlation length, shape (surfaces, 4).

    The four thresholds are those between ends in x and in y, and those of the cell in x and in y.

    Attributes
    ----------
    area : real over nominal contact area.
    load : reduced load W/(E* g′).
    """

    area: Mapping[float, Array]
    load: Mapping[float, Array]


def grow(folder: Path | None, advance: Callable[[str], None], counts: Mapping[int, int] = COUNTS) -> Sizes:
    """Compute all sizes, or read them from the folder where they are stored; ``advance`` is called for each."""
    area, load = {}, {}
    for nodes, count in counts.items():
        advance(f"{nodes} × {nodes} nodes")
        inputs = {"count": count, "correlation": CORRELATION, "near": THRESHOLD_PRECISION}
        found = np.array(kept(folder and folder / f"size_{nodes}.json", inputs, partial(_all, nodes, count)))
        lengths = nodes / NODES_PER_SIDE * SIDE / CORRELATION
        area[lengths], load[lengths] = found[:, 0], found[:, 1]
    return Sizes(area=area, load=load)


def _all(nodes: int, count: int) -> list[tuple[Array, Array]]:
    return [_one(nodes, seed) for seed in range(601, 601 + count)]


def _one(nodes: int, seed: int) -> tuple[Array, Array]:
    """Return the areas and the reduced loads at the thresholds of one surface."""
    side = nodes / NODES_PER_SIDE * SIDE
    surface = gaussian(
        size=(side, side),
        points=(nodes, nodes),
        seed=seed + nodes,
        rms_height=1e-7,
        correlation_length=CORRELATION,
        amplitudes="random",
    )
    slope = rms_slope(surface)
    found = sealed_contacts(Series(surface.heights, surface.spacing), slope)
    areas, loads = np.transpose([(one.area_fraction, one.load) for one in found])
    return areas, loads / (MODULUS * slope)
