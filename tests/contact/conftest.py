"""Measured surfaces, and random ones whose spectrum is known."""

import warnings
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy import stats

from roughfilm.contact.surfaces.surface import Surface


def open_measured(path: Path) -> Surface:
    """A measured surface as the instrument wrote it, in metres, without a process of its own for each."""
    topography = pytest.importorskip("SurfaceTopography")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = topography.open_topography(str(path)).topography().to_unit("m")
        heights = found.heights()
    return Surface(
        heights=np.ma.filled(heights, 0.0),
        spacing=tuple(length / n for length, n in zip(found.physical_sizes, heights.shape, strict=True)),
        invalid=np.ma.getmaskarray(heights),
    )


def without_form(surface: Surface) -> Surface:
    """Less the polynomial of second order that fits its valid points best."""
    x, y = np.meshgrid(*(np.linspace(-1, 1, n) for n in surface.shape), indexing="ij")
    basis = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)
    fit, *_ = np.linalg.lstsq(basis[surface.valid], surface.heights[surface.valid])
    return surface.with_heights(surface.heights - basis @ fit)


@pytest.fixture(scope="session")
def measured(measured_file):
    """Opens a measured surface by the name of its file, with its form removed."""
    return cache(lambda name: without_form(open_measured(measured_file(name))))


@pytest.fixture
def band_limited():
    """Makes one random periodic surface, the same on any grid of more than 2 ``band`` points a side."""

    def make(seed: int, shape: tuple[int, int], *, band: int = 8, size: tuple[float, float] = (1e-3, 1e-3)) -> Surface:
        generator = np.random.default_rng(seed)
        k = np.arange(-band, band + 1)
        kx, ky = np.meshgrid(k, k, indexing="ij")
        modes = generator.normal(size=kx.shape) + 1j * generator.normal(size=kx.shape)
        modes *= np.exp(-((kx / 4) ** 2 + (kx * ky) / 12 + (ky / 3) ** 2))
        modes[(kx == 0) & (ky == 0)] = 0
        x, y = (np.exp(2j * np.pi * np.outer(np.arange(n), k) / n) for n in shape)
        heights = 1e-7 * (x @ modes @ y.T).real
        return Surface(heights=heights, spacing=(size[0] / shape[0], size[1] / shape[1]), periodic=True)

    return make


@pytest.fixture
def gaussian_heights():
    """Makes n heights that lie exactly as a Gaussian spreads them: at its quantiles (i + 1/2)/n."""
    return lambda n, rms: stats.norm.ppf((np.arange(n) + 0.5) / n) * rms
