"""Sal and Str are those of surfaces whose autocorrelation is known, however they are sampled."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters import exact
from roughfilm.contact.parameters.autocorrelation import autocorrelation, decay_lengths
from roughfilm.contact.surfaces.surface import Surface


def lengths(surface):
    return decay_lengths(autocorrelation(surface), surface.spacing)


def with_autocorrelation(function, shape, spacing, seed):
    """A periodic random surface with exactly this autocorrelation of lags (x, y)."""
    x, y = np.meshgrid(*(np.fft.fftfreq(n, 1 / n) * d for n, d in zip(shape, spacing, strict=True)), indexing="ij")
    amplitude = np.sqrt(np.fft.fft2(function(x, y)).real.clip(min=0))
    amplitude[0, 0] = 0
    noise = np.fft.fft2(np.random.default_rng(seed).normal(size=shape))
    heights = np.fft.ifft2(amplitude * noise / np.abs(noise)).real
    return Surface(heights=1e-6 * heights, spacing=spacing, periodic=True)


def direct(surface, lag):
    """Mean product over all pairs of valid points, one by one."""
    z = surface.heights - surface.heights[surface.valid].mean()
    total, pairs = 0.0, 0
    nx, ny = surface.shape
    for i, j in np.argwhere(surface.valid):
        p, q = i + lag[0], j + lag[1]
        if surface.periodic:
            p, q = p % nx, q % ny
        if 0 <= p < nx and 0 <= q < ny and surface.valid[p, q]:
            total, pairs = total + z[i, j] * z[p, q], pairs + 1
    return total / pairs / (z[surface.valid] ** 2).mean()


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("shape", [(12, 9), (7, 10)])
@pytest.mark.parametrize("holes", [True, False])
def test_it_is_the_mean_product_over_all_pairs(periodic, shape, holes):
    generator = np.random.default_rng(5103)
    invalid = generator.random(shape) < (0.2 if holes else 0)
    heights = generator.normal(size=shape) + 5
    surface = Surface(heights=heights, spacing=(1.0, 2.0), invalid=invalid, periodic=periodic)
    r = autocorrelation(surface)
    middle = np.array(shape) // 2
    assert r.shape == tuple(2 * middle + 1)
    for lag in [(0, 0), (1, 0), (0, 1), (2, -3), (-2, 3), tuple(middle), tuple(-middle)]:
        assert r[tuple(middle + lag)] == pytest.approx(direct(surface, lag), abs=1e-12), lag


def test_lags_of_which_there_is_no_pair_are_uncorrelated():
    invalid = np.ones((9, 9), dtype=bool)
    invalid[4, 3:6] = False
    heights = np.zeros((9, 9))
    heights[4, 3:6] = [1, 0, 3]
    r = autocorrelation(Surface(heights=heights, spacing=(1.0, 1.0), invalid=invalid))
    assert r[4, 4] == 1
    assert np.count_nonzero(r) == 5


def gaussian_decay(length, part):
    """Where exp(−(t/λ)²) less its mean over the period, ``part`` of its top, drops to 0.2 of its new top."""
    return length * np.sqrt(-np.log(0.2 + 0.8 * part))


def test_the_closed_form_of_a_gaussian_autocorrelation():
    assert exact.decay_length(3.0) == pytest.approx(gaussian_decay(3.0, 0.0))


@pytest.mark.parametrize(("points", "tolerance"), [(4, 1e-3), (8, 1e-4), (16, 1e-5)])
@pytest.mark.parametrize(("lx", "ly", "dy"), [(1.0, 1.0, 1.0), (3.0, 1.0, 1.0), (1.0, 2.5, 1.6)])
def test_a_gaussian_autocorrelation_has_its_closed_form(points, tolerance, lx, ly, dy):
    """exp(−(x/λx)² − (y/λy)²), with a pixel of λ/points (λ the shorter)."""
    shape = int(12 * lx * points), int(12 * ly * points / dy)
    surface = with_autocorrelation(
        lambda x, y: np.exp(-((x / lx) ** 2) - (y / ly) ** 2), shape, (1 / points, dy / points), 5104
    )
    part = np.pi * lx * ly / np.prod(surface.size)
    found = lengths(surface)
    assert found.closed
    assert found.shortest == pytest.approx(gaussian_decay(1.0, part), rel=tolerance)
    assert found.longest == pytest.approx(gaussian_decay(max(lx, ly), part), rel=tolerance)
    assert found.aspect == pytest.approx(1 / max(lx, ly), rel=2 * tolerance)


@pytest.mark.parametrize("degrees", [0, 17, 45, 71, 90, 128])
def test_an_oblique_lay_changes_nothing(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    surface = with_autocorrelation(
        lambda x, y: np.exp(-(((c * x + s * y) / 40) ** 2) - ((c * y - s * x) / 8) ** 2), (480, 480), (1.0, 1.0), 5105
    )
    found = lengths(surface)
    assert found.shortest == pytest.approx(gaussian_decay(8.0, np.pi * 40 * 8 / 480**2), rel=1e-4)
    assert found.aspect == pytest.approx(0.2, rel=3e-4)


def test_an_exponential_autocorrelation_has_its_closed_form():
    surface = with_autocorrelation(lambda x, y: np.exp(-np.hypot(x, y) / 10), (300, 300), (1.0, 1.0), 5106)
    assert lengths(surface).shortest == pytest.approx(exact.decay_length(10.0, 1.0), rel=2e-2)
    assert lengths(surface).aspect == pytest.approx(1, rel=1e-2)


def test_ridges_never_end():
    """Cosine waves drop to 0.2 at arccos(0.2)/2π of a period across, and run to the edge of the window along."""
    x = np.arange(128)
    surface = Surface(heights=np.outer(np.sin(2 * np.pi * x / 32), np.ones(60)), spacing=(1.0, 3.0), periodic=True)
    found = lengths(surface)
    across = 32 * np.arccos(0.2) / (2 * np.pi)
    assert not found.closed
    assert found.shortest == pytest.approx(across, rel=1e-4)
    assert found.longest == pytest.approx(np.hypot(90, across), rel=1e-3)


def test_an_open_piece_of_a_random_surface_states_nearly_the_same():
    whole = with_autocorrelation(lambda x, y: np.exp(-((x / 4) ** 2) - (y / 8) ** 2), (800, 800), (1.0, 1.0), 5107)
    invalid = np.random.default_rng(5108).random((400, 500)) < 0.1
    piece = Surface(heights=whole.heights[:400, :500], spacing=whole.spacing, invalid=invalid)
    assert lengths(piece).shortest == pytest.approx(exact.decay_length(4.0), rel=0.05)
    assert lengths(piece).aspect == pytest.approx(0.5, rel=0.1)


def test_where_it_never_drops_the_edge_is_a_bound():
    r = np.full((7, 11), 0.5)
    r[3, 5] = 1.0
    found = decay_lengths(r, (2.0, 1.0))
    assert (found.shortest, found.longest, found.closed) == (5.0, np.hypot(6, 5), False)


def test_constant_heights_have_none():
    with pytest.raises(InputError, match="all the same"):
        autocorrelation(Surface(heights=np.full((5, 5), 0.1), spacing=(1.0, 1.0)))
