"""Section heights, elements and gradient of profiles that are known."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.heights import deviations
from roughfilm.contact.parameters.profile import profile_elements, rms_profile_gradient, section_heights
from roughfilm.contact.parameters.roughness_parameters import profile_parameters


def elements_of(heights, spacing=1.0):
    z = deviations(heights)
    return profile_elements(z, spacing, section_heights(z))


def test_sections_are_averaged():
    """Ramps of 1, 2, 3, 4 and 5 µm in the five sections, each about the mean."""
    ramps = [1e-6 * height * np.linspace(-0.5, 0.5, 101) for height in (1, 2, 3, 4, 5)]
    found = section_heights(np.concatenate(ramps))
    assert found.peak == pytest.approx(1.5e-6)
    assert found.valley == pytest.approx(1.5e-6)
    assert found.total == pytest.approx(3e-6)
    assert section_heights(np.concatenate(ramps), 1).total == pytest.approx(5e-6)


def test_points_that_no_section_length_divides_all_count():
    z = deviations(np.random.default_rng(7401).normal(size=203))
    parts = np.split(z, [41, 82, 123, 163])
    assert section_heights(z).total == pytest.approx(np.mean([np.ptp(part) for part in parts]))


@pytest.mark.parametrize("sections", [0, -1, 12, 2.5, "5"])
def test_a_number_of_sections_that_is_none_is_refused(sections):
    with pytest.raises(InputError, match="give 1 to 11"):
        section_heights(np.linspace(-1, 1, 11), sections)


def test_the_gradient_of_a_line_is_its_slope():
    assert rms_profile_gradient(0.3 * np.arange(20) * 2e-6, 2e-6) == pytest.approx(0.3, rel=1e-12)


def test_the_gradient_of_a_wave_converges_with_second_order():
    counts = np.array([10, 20, 40, 80])
    errors = [
        abs(rms_profile_gradient(np.sin(2 * np.pi * np.arange(50 * n + 1) / n), 2 * np.pi / n) - np.sqrt(0.5))
        for n in counts
    ]
    assert np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(-2, abs=0.02)


@pytest.mark.parametrize("phase", [0.0, 0.3, 0.9])
@pytest.mark.parametrize("periods", [3.0, 7.4])
def test_the_elements_of_a_wave_are_its_periods(phase, periods):
    n = 4000
    heights = 2e-6 * np.sin(2 * np.pi * (periods * np.arange(n) / n + phase))
    found = elements_of(heights, 1e-6)
    assert found.spacings == pytest.approx(np.full(found.spacings.size, n / periods * 1e-6), rel=1e-5)
    assert found.heights == pytest.approx(np.full(found.heights.size, 4e-6), rel=1e-5)
    assert found.spacings.size >= int(2 * periods) - 3


def test_waves_below_a_tenth_of_the_height_make_no_elements():
    """A wave of 6 % on the long one makes several crossings of the mean line at each flank, but no element."""
    x = np.arange(20_000) / 4000
    long, short = np.sin(2 * np.pi * x), 0.06 * np.sin(2 * np.pi * 40 * x + 1)
    found = elements_of(long + short)
    assert found.spacings.mean() == pytest.approx(4000, rel=2e-3)
    assert elements_of(long + 5 * short).spacings.mean() < 3500


def test_elements_are_the_same_in_both_directions():
    heights = np.convolve(np.random.default_rng(7402).normal(size=3000), np.hanning(25), mode="valid")
    one, other = elements_of(heights), elements_of(heights[::-1])
    np.testing.assert_allclose(one.spacings, other.spacings[::-1], rtol=1e-9)
    np.testing.assert_allclose(one.heights, other.heights[::-1], rtol=1e-12)


def test_a_step_has_no_element():
    assert elements_of(np.repeat([0.0, 1.0], 50)) is None
    assert "Rsm" not in profile_parameters(np.repeat([0.0, 1.0], 50), 1e-6)


def test_a_gaussian_profile_has_nearly_the_spacing_of_rice():
    """Crossings lie π √(m0/m2) apart on average; the height discrimination removes few of a smooth profile."""
    n, s = 1 << 16, 0.02
    q = 2 * np.pi * np.fft.rfftfreq(n)
    noise = np.fft.rfft(np.random.default_rng(7403).normal(size=n))
    heights = np.fft.irfft(noise * np.exp(-(q**2) / (4 * s**2)), n)
    spacing = 2 * np.pi / s
    found = profile_parameters(heights, 1.0)
    assert spacing < found["Rsm"].value < 1.3 * spacing
    assert found["Rdq"].value == pytest.approx(s * found["Rq"].value, rel=0.05)
