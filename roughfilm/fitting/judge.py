"""The test of a description with windows that were not fitted."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.fitting.fit import fit_random_field
from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import RandomField, make
from roughfilm.fitting.quantities import NAMES, quantities_of

COVERAGE = 0.95
"""Fraction of windows that an interval is meant to contain."""

CHANCE = 0.025
"""Probability of so few windows inside an interval of 95 %, below which they are too few."""

Count = Callable[[str], None]


@dataclass(frozen=True, kw_only=True)
class Held:
    """The held-out windows inside and outside of the interval of the seeds, for one quantity.

    Attributes
    ----------
    inside : number of held-out windows within the interval of the seeds.
    count : number of held-out windows.
    below, above : numbers of windows below the interval and above it.
    interval : the 95 % interval of the seeds of both halves' descriptions, as the mean of their ends.
    ratio : median of the windows over that of the seeds; NaN if one is 0.
    """

    inside: int
    count: int
    below: int
    above: int
    interval: tuple[float, float]
    ratio: float

    __repr__ = brief

    @property
    def fails(self) -> bool:
        """Whether fewer than 90 % of the windows are inside, and fewer than an interval of 95 % contains by chance."""
        rare = bool(scipy.stats.binom.cdf(self.inside, self.count, COVERAGE) < CHANCE)
        return rare and self.inside < 0.9 * self.count


def halves(count: int, seed: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Two random halves of the numbers 0 to count - 1."""
    order = np.random.default_rng(seed).permutation(count)
    return np.sort(order[::2]), np.sort(order[1::2])


def seeds_of(description: RandomField, count: int, load: float, progress: Count) -> Array:
    """The quantities of the seeds 0 to count - 1 of a description, shape (count, 4)."""
    found = []
    for seed in range(count):
        progress(f"seed {seed + 1} of {count}")
        found.append(quantities_of(make(description.model_copy(update={"seed": seed})), load))
    return np.array(found)


def interval_of(values: Array) -> tuple[float, float]:
    """The 95 % interval of a further value, between two order statistics; values that are not a number count not."""
    known = values[np.isfinite(values)]
    low, high = np.quantile(known, [0.5 - COVERAGE / 2, 0.5 + COVERAGE / 2], method="weibull")
    return float(low), float(high)


def held_out(
    cells: Sequence[Surface],
    windows: Array,
    load: float,
    *,
    parts: tuple[NDArray[np.intp], NDArray[np.intp]],
    seeds: int,
    independent: float,
    progress: Count,
) -> tuple[dict[str, Held], Mask]:
    """Fit a description to each half of the windows and count the windows of the other half within its seeds.

    Parameters
    ----------
    cells : periodic cells of the windows.
    windows : their quantities, shape (n, 4).
    load : mean pressure over E*.
    parts : numbers of the windows of both halves.
    seeds : number of seeds of each description.
    independent : effective number of independent windows of all.
    progress : called before each seed with a few words.

    Returns
    -------
    held : by the names of the quantities.
    inside : whether each window is inside, shape (n, 4); True where a window has no value.
    """
    inside = np.ones(windows.shape, dtype=bool)
    under, over = np.zeros(windows.shape, dtype=bool), np.zeros(windows.shape, dtype=bool)
    ends, ratios = [], []
    for fitted, other in (parts, parts[::-1]):
        worth = max(independent * len(fitted) / len(cells), 4.0)
        description = fit_random_field([cells[number] for number in fitted], min(worth, float(len(fitted))))
        found = seeds_of(description, seeds, load, progress)
        both = np.array([interval_of(column) for column in found.T])
        ends.append(both)
        under[other], over[other] = windows[other] < both[:, 0], windows[other] > both[:, 1]
        middle = np.nanmedian(found, axis=0)
        ratios.append(np.divide(np.nanmedian(windows[other], axis=0), middle, out=np.full(4, np.nan), where=middle > 0))
    inside = ~(under | over)
    known = np.isfinite(windows)
    held = {}
    for k, name in enumerate(NAMES):
        of_one = known[:, k]
        low, high = np.mean(ends, axis=0)[k]
        ratio = float(np.exp(np.mean(np.log([one[k] for one in ratios])))) if min(r[k] for r in ratios) > 0 else np.nan
        held[name] = Held(
            inside=int(inside[of_one, k].sum()),
            count=int(of_one.sum()),
            below=int(under[of_one, k].sum()),
            above=int(over[of_one, k].sum()),
            interval=(float(low), float(high)),
            ratio=float(ratio),
        )
    return held, inside
