"""Registration finds shifts that are known, to a fraction of a pixel, and does not trust unrelated surfaces."""

import numpy as np
import pytest
from scipy import ndimage

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.registration.correlation import correlation_map
from roughfilm.contact.registration.register import register
from roughfilm.contact.surfaces.surface import Surface

N = 128


def spectrum(seed, *, long=1 / 40, short=0.2, lay=1.0):
    """The Fourier coefficients of a random periodic surface of N x N pixels without waves shorter than 5 pixels."""
    q = np.hypot(lay * np.fft.fftfreq(N)[:, None], np.fft.rfftfreq(N))
    waves = np.fft.rfft2(np.random.default_rng(seed).normal(size=(N, N)))
    return waves * np.where(q < short, np.maximum(q, long) ** -1.8, 0)


def moved(waves, shift):
    """The surface moved by a shift in pixels, exactly."""
    phase = np.fft.fftfreq(N)[:, None] * shift[0] + np.fft.rfftfreq(N) * shift[1]
    return np.fft.irfft2(waves * np.exp(-2j * np.pi * phase), s=(N, N))


def surface(heights, spacing=(1e-6, 1.3e-6), invalid=None):
    mask = np.zeros(heights.shape, bool) if invalid is None else invalid
    return Surface(heights=heights * 1e-6, spacing=spacing, invalid=mask)


@pytest.mark.parametrize("shift", [(3.37, -6.81), (-0.25, 11.5)])
@pytest.mark.parametrize("holes", [0.0, 0.03])
def test_a_shift_by_a_fraction_of_a_pixel_is_found_below_noise(shift, holes):
    """Band-limited shift, noise of 7 % of the rms height in both; also a tilt and spikes in one."""
    rng, waves = np.random.default_rng(881), spectrum(882)
    scale = moved(waves, (0, 0)).std()
    first, second = (moved(waves, t) / scale + 0.07 * rng.normal(size=(N, N)) for t in ((0, 0), shift))
    second[40, 50] += 30
    second += 0.01 * np.arange(N)[:, None]
    inner, masks = np.s_[14:-14, 14:-14], rng.random((2, N, N)) < holes
    found = register(surface(first[inner], invalid=masks[0][inner]), surface(second[inner], invalid=masks[1][inner]))
    assert found.uncertainty is not None
    error = np.abs(np.add(found.shift, shift))  # the second shows at k what the first shows at k − shift
    assert error.max() < 0.05
    assert max(found.uncertainty) < 0.06
    assert not found.warnings


def test_windows_of_one_surface_have_their_distance():
    heights = moved(spectrum(883), (0, 0))
    found = register(surface(heights[:90, 20:110]), surface(heights[17:107, 6:90]))
    assert found.shift == pytest.approx((17, -14), abs=1e-6)


def test_unrelated_surfaces_are_not_trusted():
    for seed in range(12):
        lay = 4.0 if seed % 2 else 1.0
        first, second = (moved(spectrum(900 + 2 * seed + k, lay=lay), (0, 0))[:80, :80] for k in (0, 1))
        found = register(surface(first), surface(second))
        assert found.peak is not None
        assert found.peak.false_probability > 0.05
        assert "too low to register" in found.warnings[0]


def test_a_texture_that_repeats_itself_is_ambiguous():
    x = np.arange(N)
    grooves = np.sin(2 * np.pi * x / 16)[:, None] + 0.02 * moved(spectrum(884), (0, 0)) / 1e3
    found = register(surface(grooves[:100]), surface(grooves[5:105]))
    assert any("ambiguous" in warning or "too low" in warning for warning in found.warnings)


def test_the_correlation_is_that_of_numpy_over_the_common_valid_points():
    rng = np.random.default_rng(885)
    a, b = rng.normal(size=(11, 9)), rng.normal(size=(8, 12))
    u, v = rng.random(a.shape) < 0.8, rng.random(b.shape) < 0.8
    coefficient, count = correlation_map(a, u, b, v)
    for i, j in ((0, 0), (4, -3), (-2, 5)):
        pairs = [
            (a[k + i, m + j], b[k, m])
            for k, m in np.ndindex(b.shape)
            if 0 <= k + i < 11 and 0 <= m + j < 9 and u[k + i, m + j] and v[k, m]
        ]
        assert count[i + 7, j + 11] == len(pairs)
        assert coefficient[i + 7, j + 11] == pytest.approx(np.corrcoef(np.transpose(pairs))[0, 1], abs=1e-12)


def test_a_shift_does_not_depend_on_units_or_the_order_of_the_axes():
    waves = spectrum(886)
    first, second = moved(waves, (0, 0))[:90, :80], moved(waves, (2.4, -3.3))[:90, :80]
    plain = register(surface(first), surface(second)).shift
    scaled = register(surface(1e-3 * first, (1e-9, 1.3e-9)), surface(1e-3 * second, (1e-9, 1.3e-9))).shift
    turned = register(surface(first.T, (1.3e-6, 1e-6)), surface(second.T, (1.3e-6, 1e-6))).shift
    assert scaled == pytest.approx(plain, abs=1e-4)
    assert turned[::-1] == pytest.approx(plain, abs=1e-4)


def test_a_flat_surface_is_refused():
    with pytest.raises(InputError, match=r"^registration: the heights of a surface are all the same"):
        register(surface(np.ones((20, 20))), surface(np.ones((20, 20))))


@pytest.mark.measured
@pytest.mark.parametrize("name", ["milled_NT1100.opd", "polished.opd", "isotropic.al3d", "ground_striated.x3p"])
def test_overlapping_windows_of_measured_surfaces_have_their_distance(measured, name):
    whole = measured(name)
    nx, ny = (min(n, 300) for n in whole.shape)
    cuts = np.s_[: nx - 40, 13:ny], np.s_[29:nx, : ny - 21]
    first, second = (whole.with_heights(whole.heights[cut], invalid=whole.invalid[cut]) for cut in cuts)
    assert register(first, second).shift == pytest.approx((29, -13), abs=1e-5)


@pytest.mark.measured
def test_a_measured_surface_keeps_its_place_under_noise_of_its_own(measured):
    """Noise of a tenth of the rms height, filtered over a pixel, in both windows."""
    whole = measured("isotropic.al3d")
    rng, scale = np.random.default_rng(887), 0.1 * whole.heights.std()
    noisy = [ndimage.gaussian_filter(rng.normal(size=whole.shape), 1.0) * 3.5 * scale for _ in range(2)]
    first, second = (
        whole.with_heights((whole.heights + noise)[cut], invalid=whole.invalid[cut])
        for noise, cut in zip(noisy, (np.s_[:180, :260], np.s_[11:, 20:280]), strict=True)
    )
    found = register(first, second)
    assert found.uncertainty is not None
    assert np.abs(np.subtract(found.shift, (11, 20))).max() < 2 * max(found.uncertainty) < 0.2
