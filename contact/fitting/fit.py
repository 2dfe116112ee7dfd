"""The random field that windows are drawn from: its spectrum, its heights, and how windows differ."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import with_unit
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import RandomField, read_entries
from roughfilm.contact.synthetic.random_field import DECIBEL, LEAST_ROOT, MIN_WINDOWS, at_scores, octave_of

SINGLE_WAVES = 8
"""Wave number up to which the table has every wave; beyond it, four for each octave."""

SCORE_COUNT = 15
"""Number of quantiles of the heights."""

LEAST_POWER = 1e-10
"""Power of an octave over that of all below which it counts as this power."""

LEAST_DEVIATION = 1e-6
"""Standard deviation of a logarithm or a square root below which windows do not differ in it."""

VARIANCE_KEPT = 0.99
"""Fraction of the variance that the modes keep."""

DEEPEST = -200.0
"""Smallest power of a wave in the table, decibels below the largest."""


def fit_random_field(cells: Sequence[Surface], independent: float | None = None) -> RandomField:
    """Fit a random field to the periodic cells of windows.

    The table of the spectrum is the mean over the windows of the power of each wave over that of its octave, averaged
    over the wave vectors nearest to each entry. The population has the mean and the covariance of the logarithms of
    the powers of the octaves and of the square roots of the steps between the quantiles of the heights, in units of the
    rms height of each window. The principal components that carry 99 % of the variance become modes.

    Parameters
    ----------
    cells : periodic cells of one shape and spacing, m.
    independent : effective number of independent windows, 4 to the number of cells; by default their number.

    Returns
    -------
    RandomField : of the size and the points of the cells, with seed 0.

    Raises
    ------
    InputError
        If the cells are fewer than four, differ in shape or spacing, are not periodic, or one is flat.
    """
    first, count = cells[0], len(cells)
    worth = float(count if independent is None else independent)
    _refuse(cells, worth)
    heights = np.array([cell.heights - cell.heights.mean() for cell in cells])
    rms = heights.std(axis=(1, 2))
    power = np.abs(scipy.fft.fft2(heights, norm="forward")) ** 2
    power[:, 0, 0] = 0.0
    (nx, ny), (dx, dy) = first.shape, first.spacing
    qx, qy = 2 * np.pi * scipy.fft.fftfreq(nx, dx)[:, None], 2 * np.pi * scipy.fft.fftfreq(ny, dy)[None, :]
    tops = [(points - 1) // 2 for points in first.shape]
    cut_off = max(side / top for side, top in zip(first.size, tops, strict=True))
    octave_count = max(1, round(math.log2(min(first.size) / cut_off)))
    octaves = octave_of(qx, qy, first.size, octave_count)
    own = np.array([np.bincount(octaves.ravel(), one.ravel(), minlength=octave_count) for one in power])
    own = np.maximum(own, LEAST_POWER * rms[:, None] ** 2)
    mean_octaves = np.log(own).mean(axis=0)
    shares = (power / own[:, octaves.ravel()].reshape(power.shape)).mean(axis=0) * np.exp(mean_octaves)[octaves]
    waves = [wave_numbers(top) for top in tops]
    scores, steps = quantile_steps(heights / rms[:, None, None])
    values = np.hstack([np.log(own), steps])
    z = np.concatenate([[0.0], np.cumsum(steps.mean(axis=0) ** 2)])
    middle = at_scores(scores, z, scipy.special.ndtri((np.arange(nx * ny) + 0.5) / (nx * ny)))
    return described(
        {
            "kind": "random_field",
            "size": [with_unit(side, "m") for side in first.size],
            "points": [nx, ny],
            "seed": 0,
            "spectrum": {
                "period": [with_unit(side, "m") for side in first.size],
                "waves_x": waves[0],
                "waves_y": waves[1],
                "decibels": _decibels(shares, waves).tolist(),
            },
            "population": {
                "windows": round(worth, 3),
                "rms_height": with_unit(float(f"{math.sqrt(np.exp(mean_octaves).sum()):.6g}"), "m"),
                "octaves": rounded((mean_octaves - mean_octaves.max()) / DECIBEL, 3),
                "scores": rounded(scores, 6),
                "heights": rounded((z - middle.mean()) / middle.std(), 6),
                "modes": [
                    {
                        "octaves": rounded(mode[:octave_count] / DECIBEL, 3),
                        "steps": rounded(mode[octave_count:], 4),
                    }
                    for mode in _modes(values, worth)
                ],
            },
        }
    )


def _refuse(cells: Sequence[Surface], worth: float) -> None:
    if not MIN_WINDOWS <= worth <= len(cells) * (1 + 1e-9):
        raise InputError(
            f"windows: got {len(cells)} that are worth {worth:.3g} independent ones; a fit needs {MIN_WINDOWS:g} or "
            "more, take smaller windows or measure more places"
        )
    first = cells[0]
    for number, cell in enumerate(cells):
        same = cell.shape == first.shape and np.allclose(cell.spacing, first.spacing, rtol=1e-9)
        if not same:
            raise InputError(f"window {number + 1}: has another shape or spacing than the first; give windows alike")
        if min(cell.shape) < 8:
            raise InputError(f"window {number + 1}: has {min(cell.shape)} points along a side; give 8 or more")
        if not cell.heights.std() > 0:
            raise InputError(f"window {number + 1}: is flat; leave it out")


def described(entries: dict[str, Any]) -> RandomField:
    """The random field of nested entries."""
    found = read_entries(entries)
    assert isinstance(found, RandomField)
    return found


def wave_numbers(top: int) -> list[int]:
    """Wave numbers from 0 to the largest: every one up to 8, then four for each octave."""
    numbers = list(range(min(SINGLE_WAVES, top) + 1))
    while numbers[-1] < top:
        following = max(numbers[-1] + 1, round(numbers[-1] * 2**0.25))
        numbers.append(following if following * 2**0.125 < top else top)
    return numbers


def _decibels(power: Array, waves: Sequence[Sequence[int]]) -> Array:
    """Power of the wave vectors around each entry of the table, decibels, one row for each number along y."""
    (nx, ny), (along, across) = power.shape, waves
    columns = [-number for number in along[:0:-1]] + list(along)
    of_column, of_row = _nearest(nx, columns), _nearest(ny, across)
    sums, counts = (np.zeros((len(across), len(columns))) for _ in range(2))
    inside = np.ix_(of_column >= 0, of_row >= 0)
    places = (np.broadcast_to(of_row, power.shape)[inside], np.broadcast_to(of_column[:, None], power.shape)[inside])
    np.add.at(sums, places, power[inside])
    np.add.at(counts, places, 1.0)
    table = np.divide(sums, counts, out=np.zeros(sums.shape), where=counts > 0)
    middle = len(along) - 1
    table[0, :middle] = table[0, :middle:-1]  # the waves of n = 0 and their opposites are the same
    table[0, middle] = math.sqrt(table[0, middle + 1] * table[1, middle])
    decibels = 10 * np.log10(np.maximum(table / table.max(), 10 ** (DEEPEST / 10)))
    return np.asarray(np.round(decibels, 2))


def _nearest(points: int, numbers: Sequence[int]) -> NDArray[np.intp]:
    """The entry of the table nearest to each frequency of a transform; -1 for frequencies beyond it."""
    frequency = np.rint(scipy.fft.fftfreq(points, 1 / points))
    entries = np.array(numbers, dtype=float)
    distance = np.abs(frequency[:, None] - entries) + 1e-6 * np.abs(entries)  # the longer wave of two as near
    nearest = distance.argmin(axis=1)
    return np.where((frequency >= entries[0]) & (frequency <= entries[-1]), nearest, -1)


def quantile_steps(heights: Array) -> tuple[Array, Array]:
    """Normal scores, and the square roots of the steps between the heights of each window at them."""
    count = heights[0].size
    x = scipy.special.ndtri((np.arange(count) + 0.5) / count)
    scores = np.linspace(x[0], x[-1], SCORE_COUNT)
    at = np.array([np.interp(scores, x, np.sort(one, axis=None)) for one in heights])
    return scores, np.sqrt(np.maximum(np.diff(at, axis=1), LEAST_ROOT**2))


def _modes(values: Array, worth: float) -> Array:
    """Principal components, each times its standard deviation, that carry most of the variance, shape (modes, n).

    The variance counts in units of that of each column, as the columns have different units.
    """
    changes = values - values.mean(axis=0)
    deviations = changes.std(axis=0)
    some = deviations > LEAST_DEVIATION
    if not some.any():
        return np.empty((0, values.shape[1]))
    _, sizes, directions = np.linalg.svd(changes[:, some] / deviations[some], full_matrices=False)
    total = np.cumsum(sizes**2)
    kept = int(np.searchsorted(total, VARIANCE_KEPT * total[-1])) + 1
    scale = 1 / math.sqrt(len(changes) * (1 - 1 / worth))
    modes = np.zeros((kept, values.shape[1]))
    modes[:, some] = scale * sizes[:kept, None] * directions[:kept] * deviations[some]
    return modes


def rounded(values: Array, digits: int) -> list[float]:
    """The values with a number of decimals, as a list."""
    return [float(value) for value in np.round(values, digits)]
