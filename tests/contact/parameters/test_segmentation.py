"""Hills are those of the definition, by a search of each level of the surface, on open, periodic and holed grids."""

import numpy as np
import pytest
from scipy import ndimage
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from roughfilm.contact.parameters.segmentation import hills


def neighbours(valid, periodic):
    """All pairs of valid points that are neighbours, along the axes and diagonals, as flat indices."""
    nx, ny = valid.shape
    pairs = []
    for i, j in np.argwhere(valid):
        for di, dj in ((0, 1), (1, 0), (1, 1), (1, -1)):
            p, q = i + di, j + dj
            if periodic:
                p, q = p % nx, q % ny
            if 0 <= p < nx and 0 <= q < ny and valid[p, q]:
                pairs.append((i * ny + j, p * ny + q))
    return np.array(pairs).reshape(-1, 2)


def peaks_by_levels(heights, valid, periodic, pruning):
    """Peaks whose height above their saddle is at least the pruning, by the components of {z >= level} for each level.

    The saddle of a peak is the highest level at which its component has a higher point.
    """
    z, pairs = heights.ravel(), neighbours(valid, periodic)
    kept = []
    candidates = [
        p
        for p in np.flatnonzero(valid)
        if not (z[np.concatenate([pairs[pairs[:, 0] == p, 1], pairs[pairs[:, 1] == p, 0]])] > z[p]).any()
    ]
    for peak in candidates:
        for level in np.sort(z[valid.ravel()])[::-1]:
            if level > z[peak]:
                continue
            inside = (z >= level) & valid.ravel()
            both = pairs[inside[pairs].all(axis=1)]
            graph = coo_array((np.ones(len(both)), (both[:, 0], both[:, 1])), shape=(z.size, z.size))
            _, label = connected_components(graph, directed=False)
            if z[(label == label[peak]) & inside].max() > z[peak]:
                if z[peak] - level >= pruning:
                    kept.append(peak)
                break
        else:
            kept.append(peak)  # the highest of its region
    return sorted(kept)


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("holes", [0.0, 0.15])
@pytest.mark.parametrize("pruning", [0.0, 0.4, 1.5])
def test_the_peaks_are_those_that_stand_above_their_saddle(periodic, holes, pruning):
    generator = np.random.default_rng(7201)
    heights = generator.normal(size=(9, 8))
    valid = generator.random(heights.shape) >= holes
    found = hills(heights, valid, periodic=periodic, pruning=pruning)
    assert sorted(found.peaks) == peaks_by_levels(heights, valid, periodic, pruning)
    assert (np.diff(heights.ravel()[found.peaks]) < 0).all()


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("pruning", [0.0, 1.0])
def test_hills_are_connected_regions_below_their_peak(periodic, pruning):
    generator = np.random.default_rng(7202)
    heights = ndimage.gaussian_filter(generator.normal(size=(40, 30)), 1.5, mode="wrap") * 5
    valid = generator.random(heights.shape) >= 0.05
    found = hills(heights, valid, periodic=periodic, pruning=pruning)
    assert ((found.labels >= 0) == valid).all()
    pairs = neighbours(valid, periodic)
    label = found.labels.ravel()
    both = pairs[label[pairs[:, 0]] == label[pairs[:, 1]]]
    graph = coo_array((np.ones(len(both)), (both[:, 0], both[:, 1])), shape=(label.size, label.size))
    count, _ = connected_components(graph, directed=False)
    assert count == found.peaks.size + (~valid).sum()
    for hill, peak in enumerate(found.peaks):
        assert heights[found.labels == hill].max() == heights.ravel()[peak]


def test_without_pruning_each_point_climbs_to_its_peak():
    """Along the highest of its neighbours, step by step."""
    heights = np.random.default_rng(7203).normal(size=(20, 25))
    found = hills(heights, np.ones(heights.shape, dtype=bool), periodic=True, pruning=0.0)
    for start in np.ndindex(heights.shape):
        place = start
        while True:
            around = [((place[0] + a) % 20, (place[1] + b) % 25) for a in (-1, 0, 1) for b in (-1, 0, 1)]
            best = max(around, key=lambda one: heights[one])
            if best == place:
                break
            place = best
        assert found.peaks[found.labels[start]] == place[0] * 25 + place[1]


def test_the_hills_of_an_egg_box_are_its_cells():
    """cos x cos y has its peaks in two families of rhombs; those of (1 + cos x)(1 + cos y) are squares."""
    wave = 1 + np.cos(2 * np.pi * np.arange(36) / 12)
    found = hills(np.outer(wave, wave), np.ones((36, 36), dtype=bool), periodic=True, pruning=0.1)
    assert found.peaks.size == 9
    sizes = np.bincount(found.labels.ravel())
    assert sizes.sum() == 36**2
    assert (abs(sizes - 144) <= 26).all()  # the valley lines are one pixel wide


def test_a_pruned_hill_belongs_to_the_one_that_it_meets_at_its_highest_saddle():
    """Peaks 9, 5.5 and 8 in a line with saddles 4 and 5: the second one is merged with the third."""
    line = np.array([0, 9, 4, 5.5, 5, 8, 0], dtype=float)
    heights = np.stack([np.full(7, -1.0), line, np.full(7, -1.0)])
    found = hills(heights, np.ones(heights.shape, dtype=bool), periodic=False, pruning=1.0)
    assert list(found.peaks % 7) == [1, 5]
    assert found.labels[1, 3] == 1


def test_a_plateau_is_one_hill():
    heights = np.zeros((8, 8))
    heights[2:6, 2:6] = 1.0
    heights[3, 3] = 0.9
    found = hills(heights, np.ones(heights.shape, dtype=bool), periodic=False, pruning=0.0)
    assert found.peaks.size == 1


def test_hills_that_touch_an_edge_are_known():
    heights = np.zeros((20, 20))
    heights[5, 5], heights[0, 15], heights[14, 19] = 3.0, 2.0, 1.0
    found = hills(heights, np.ones(heights.shape, dtype=bool), periodic=False, pruning=0.5)
    assert found.peaks.size == 3
    walls = heights - 5 * np.isin(np.arange(20), (2, 9))[:, None] - 5 * np.isin(np.arange(20), (2, 9))
    inner = hills(walls, np.ones(heights.shape, dtype=bool), periodic=False, pruning=0.5)
    place = list(inner.peaks).index(5 * 20 + 5)
    assert inner.inside()[place]
    assert inner.inside().sum() == 1
