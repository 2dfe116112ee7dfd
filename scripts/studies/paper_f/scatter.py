"""Scatter of the sealing load between independent random surfaces of many sizes, spectra, skewnesses and lays."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.distribution import rms_slope, with_skewness
from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.contact.synthetic.self_affine import self_affine
from scripts.studies.paper_f.data import MODULUS, Series, sealed_contacts
from scripts.studies.study import kept

PIXEL = 1e-6
"""Spacing of the nodes, m; only ratios of lengths matter."""

POINTS = (64, 96, 128, 192, 256)
"""Numbers of nodes along a side."""

INTERVAL = (2.5, 97.5)
"""Percentiles of the interval of 95 of 100 directions of surfaces."""

COUNTS: Mapping[str, int] = {"without a lay": 240, "skewed, without a lay": 120, "with a lay": 120}
"""Number of surfaces by group; each has two directions."""


@dataclass(frozen=True, kw_only=True)
class Scatter:
    """The reduced sealing loads W/(E* g′) of one group of independent surfaces, shape (surfaces, 2), by direction."""

    loads: Array

    @property
    def mean(self) -> float:
        """The geometric mean."""
        return float(np.exp(np.log(self.loads).mean()))

    @property
    def interval(self) -> tuple[float, float]:
        """The ends of the interval of 95 of 100 directions."""
        low, high = np.percentile(self.loads, INTERVAL)
        return float(low), float(high)


def scatter(
    folder: Path | None, advance: Callable[[str], None], counts: Mapping[str, int] = COUNTS
) -> dict[str, Scatter]:
    """The scatter of each group; every surface is stored in the folder and read from it by the next run."""
    found = {}
    for group, count in counts.items():
        advance(f"scatter {group}")
        rows = []
        for seed in range(count):
            path = folder and folder / f"scatter_{group.replace(', ', '_').replace(' ', '_')}_{seed}.json"
            rows.append(kept(path, {"group": group, "seed": seed}, partial(_one, group, seed))["load"])
        found[group] = Scatter(loads=np.array(rows, dtype=float))
    return found


def drawn(group: str, seed: int) -> tuple[Surface, dict[str, Any]]:
    """A random surface of a group, of any height, and the numbers that describe it.

    Without a lay, half of the surfaces are self-affine with a Hurst exponent of 0.1 to 1, a roll-off of 1 to 1/8 of the
    side and a shortest wave of 4 to 8 nodes. The others have a Gaussian autocorrelation with Sal of 1/32 to 1/6 of the
    side. The skewness of skewed surfaces is -1.5 to 1.5. With a lay, the ratio of the correlation lengths is 2 to 8 and
    the lay has any angle.
    """
    draw = np.random.default_rng([list(COUNTS).index(group), seed])
    points = int(draw.choice(POINTS))
    side = points * PIXEL
    shared: dict[str, Any] = {
        "size": (side, side),
        "points": (points, points),
        "seed": int(draw.integers(1 << 31)),
        "amplitudes": "random",
        "rms_height": 1e-7,
    }
    numbers: dict[str, Any] = {"points": points}
    if group != "with a lay" and seed % 2 == 0:
        numbers |= {"hurst": draw.uniform(0.1, 1), "roll_off": 2 ** draw.uniform(-3, 0), "shortest": draw.uniform(4, 8)}
        made = self_affine(
            **shared,
            hurst=numbers["hurst"],
            roll_off=max(side * numbers["roll_off"], 1.5 * PIXEL * numbers["shortest"]),
            cut_off=PIXEL * numbers["shortest"],
        )
    else:
        numbers["correlation"] = max(np.exp(draw.uniform(np.log(1 / 32), np.log(1 / 6))), 6 / points)
        if group == "with a lay":
            numbers |= {"anisotropy": np.exp(draw.uniform(np.log(2), np.log(8))), "angle": draw.uniform(0, np.pi)}
        made = gaussian(
            **shared,
            correlation_length=side * numbers["correlation"] / numbers.get("anisotropy", 1.0) ** 0.5,
            anisotropy=numbers.get("anisotropy", 1.0),
            lay_angle=numbers.get("angle", 0.0),
        )
    if group.startswith("skewed"):
        numbers["skewness"] = draw.uniform(-1.5, 1.5)
        made = with_skewness(made, numbers["skewness"])
    return made, numbers


def _one(group: str, seed: int) -> dict[str, Any]:
    surface, numbers = drawn(group, seed)
    slope = rms_slope(surface)
    ends = sealed_contacts(Series(surface.heights, surface.spacing), slope)[:2]
    return {
        **numbers,
        "load": [one.load / (MODULUS * slope) for one in ends],
        "area": [one.area_fraction for one in ends],
    }
