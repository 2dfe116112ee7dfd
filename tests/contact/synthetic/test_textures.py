"""Sinusoids, cross-hatch, milled arcs and honed plateaus have the shape that was asked."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.stats import norm

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.cross_hatch import cross_hatch
from roughfilm.contact.synthetic.milled import milled
from roughfilm.contact.synthetic.plateau_honed import plateau_honed
from roughfilm.contact.synthetic.sinusoids import sinusoid

MM = 1e-3


def metres(text):
    return float(text.removesuffix(" m"))


@pytest.mark.parametrize(
    ("wavelengths", "combination", "rms_height", "rms_slope"),
    [
        ({"wavelength_x": 0.25 * MM}, "product", 1 / math.sqrt(2), 2 * math.pi / 0.25 / math.sqrt(2)),
        ({"wavelength_y": 0.1 * MM}, "sum", 1 / math.sqrt(2), 2 * math.pi / 0.1 / math.sqrt(2)),
        ({"wavelength_x": 0.25 * MM, "wavelength_y": 0.1 * MM}, "product", 1 / 2, math.pi * math.hypot(4, 10)),
        ({"wavelength_x": 0.25 * MM, "wavelength_y": 0.1 * MM}, "sum", 1 / 2, math.pi * math.sqrt(58)),
    ],
)
@pytest.mark.parametrize("points", [(400, 300), (399, 301)])
def test_sinusoids(wavelengths, combination, rms_height, rms_slope, points):
    """σ = A/sqrt 2 and A/2; rms slope 2π A/(λ sqrt 2); π A sqrt(1/λx² + 1/λy²), sqrt 2 less for a mean."""
    made = sinusoid(size=(MM, MM), points=points, amplitude=1e-6, combination=combination, **wavelengths)
    assert made.heights.std() == pytest.approx(1e-6 * rms_height, rel=1e-12)
    assert abs(made.heights.mean()) < 1e-20
    assert made.heights[0, 0] == made.heights.max() == pytest.approx(1e-6, rel=1e-14)
    waves = np.fft.fft2(made.heights)
    slope = 0.0
    for axis, (count, length) in enumerate(zip(points, made.spacing, strict=True)):
        q = np.expand_dims(2 * np.pi * np.fft.fftfreq(count, length), 1 - axis)
        slope += np.mean(np.abs(np.fft.ifft2(1j * q * waves)) ** 2)
    assert math.sqrt(slope) == pytest.approx(1e-3 * rms_slope, rel=1e-9)


def test_a_wavelength_that_nearly_fits_is_rounded_and_recorded():
    made = sinusoid(size=(MM, MM), points=(60, 4), amplitude=1e-6, wavelength_x=0.3333 * MM)
    assert metres(made.source["achieved"]["wavelength_x"]) == pytest.approx(MM / 3, rel=1e-14)
    assert made.source["synthetic"]["wavelength_x"] == f"{0.3333 * MM!r} m"
    assert_allclose(made.heights[20], made.heights[0], rtol=1e-12)


def test_a_wavelength_that_does_not_fit_is_refused_with_those_that_do():
    with pytest.raises(InputError, match=r"write 0\.00033333 m or 0\.00025 m"):
        sinusoid(size=(MM, MM), points=(60, 4), amplitude=1e-6, wavelength_x=0.3 * MM)


@pytest.mark.parametrize("half_angle", [math.radians(20), math.radians(45), math.radians(67)])
def test_cross_hatch_leaves_the_land_that_its_grooves_leave(half_angle):
    """Each family takes w/s of the area; the two are independent over the period, so (1 - w/s)² is land."""
    made = cross_hatch(
        size=(2 * MM, 2 * MM), points=(900, 901), spacing=0.2 * MM, half_angle=half_angle, depth=3e-6, width=0.06 * MM
    )
    spacing = metres(made.source["achieved"]["spacing"])
    assert spacing == pytest.approx(0.2 * MM, rel=0.1)
    assert np.mean(made.heights == 0) == pytest.approx((1 - 0.06 * MM / spacing) ** 2, abs=0.005)
    assert made.heights.max() == 0
    assert made.heights[0, 0] == made.heights.min() == -3e-6


def test_cross_hatch_grooves_run_at_the_angle_and_spacing_that_are_recorded():
    made = cross_hatch(
        size=(2 * MM, 1.3 * MM), points=(600, 400), spacing=0.1 * MM, half_angle=0.5, depth=1e-6, width=0.05 * MM
    )
    spacing = metres(made.source["achieved"]["spacing"])
    angle = float(made.source["achieved"]["half_angle"].removesuffix(" rad"))
    assert angle == pytest.approx(0.5, abs=math.radians(3))
    power = np.abs(np.fft.fft2(made.heights)) ** 2
    power[0, 0] = 0
    strongest = np.argsort(power, axis=None)[-4:]
    across = {
        (round(abs(np.fft.fftfreq(600, 2 * MM / 600)[i])), round(abs(np.fft.fftfreq(400, 1.3 * MM / 400)[j])))
        for i, j in zip(*np.unravel_index(strongest, power.shape), strict=True)
    }
    assert across == {(round(math.sin(angle) / spacing), round(math.cos(angle) / spacing))}


def test_grooves_that_cannot_close_are_refused_with_those_that_can():
    with pytest.raises(InputError, match=r"write 0\.0004472 m at 26\.57 deg"):
        cross_hatch(size=(MM, MM), points=(64, 64), spacing=0.5 * MM, half_angle=0.6, depth=1e-6, width=0.1 * MM)


def arc_phase(surface, feeds):
    """Where the first harmonic along the feed stands at each y, in feeds, made continuous."""
    harmonic = np.fft.fft(surface.heights, axis=0)[feeds]
    return -np.unwrap(np.angle(-harmonic)) / (2 * np.pi)


@pytest.mark.parametrize("offset", [0.0, 0.7 * MM, -0.7 * MM])
def test_milled_marks_lie_on_circles_of_the_mill(offset):
    """The least squares circle through the lowest places of a mark has the radius and the centre that are recorded."""
    made = milled(size=(MM, MM), points=(400, 257), radius=3 * MM, feed=0.1 * MM, depth=2e-6, offset=offset)
    x = arc_phase(made, 10) * 0.1 * MM
    y = (np.arange(257) / 257 - 0.5) * MM
    # x² + y² = 2 a x + 2 b y + c
    (a, b, c), *_ = np.linalg.lstsq(np.stack([2 * x, 2 * y, np.ones(257)], axis=1), x**2 + y**2, rcond=None)
    assert math.sqrt(a**2 + b**2 + c) == pytest.approx(3 * MM, rel=1e-3)
    assert b == pytest.approx(metres(made.source["achieved"]["offset"]), abs=1e-3 * MM)
    assert b == pytest.approx(offset, abs=0.16 * MM)
    assert a < x.min()


@pytest.mark.parametrize("offset", [0.4 * MM, 0.9 * MM, -0.6 * MM, 1.2 * MM])
def test_arcs_come_to_the_joint_a_whole_number_of_feeds_apart(offset):
    made = milled(size=(MM, MM), points=(64, 400), radius=1.8 * MM, feed=0.25 * MM, depth=2e-6, offset=offset)
    middle = 0.5 * MM + metres(made.source["achieved"]["offset"])
    sides = [math.sqrt((1.8 * MM) ** 2 - (edge - middle) ** 2) for edge in (0, MM)]
    feeds = (sides[1] - sides[0]) / (0.25 * MM)
    assert abs(feeds) > 0.5
    assert feeds == pytest.approx(round(feeds), abs=1e-9)


def test_milled_scallops_are_parabolas():
    """Along the feed the mean is d/3 and the variance 4 d²/45."""
    made = milled(size=(MM, MM), points=(2000, 31), radius=3 * MM, feed=0.1 * MM, depth=2e-6)
    assert_allclose(made.heights.mean(axis=0), 2e-6 / 3, rtol=2e-3)
    assert_allclose(made.heights.var(axis=0), 4 * 4e-12 / 45, rtol=2e-3)
    assert 0 <= made.heights.min() < 1e-3 * 2e-6
    assert 0.99 * 2e-6 < made.heights.max() <= 2e-6


def test_the_back_of_the_mill_only_takes_away():
    given = {"size": (MM, MM), "points": (300, 200), "radius": 2 * MM, "feed": 0.1 * MM, "depth": 2e-6}
    front, faint, equal = (milled(**given, back_lift=lift) for lift in (None, 1e-6, 0.0))
    assert (faint.heights <= front.heights).all()
    assert (equal.heights <= faint.heights).all()
    assert (faint.heights < front.heights).any()
    assert_allclose(milled(**given, back_lift=2e-6).heights, front.heights, rtol=0)
    assert_allclose(equal.heights, np.roll(equal.heights[::-1], 1, axis=0), atol=1e-18)


def honed(**changes):
    given = {
        "size": (0.5 * MM, 0.5 * MM),
        "points": (400, 400),
        "seed": 1931,
        "plateau_rms_height": 1e-7,
        "plateau_correlation_length": 5e-6,
        "valley_rms_height": 8e-7,
        "valley_correlation_length": 5e-6,
        "material_ratio": 0.8,
    }
    return plateau_honed(**(given | changes))


@pytest.mark.parametrize("material_ratio", [0.5, 0.8, 0.95])
def test_the_bearing_curve_is_that_of_the_lower_of_two_gaussians(material_ratio):
    """P(h > z) = P(p > z) P(v > z), where the lines of the probability plot cross at the ratio that was asked."""
    crossing = norm.ppf(material_ratio)
    lift = (8e-7 - 1e-7) * crossing
    z = np.array([-1.5e-6, -5e-7, -1e-7, 0.0, 1e-7])
    expected = norm.sf(z / 1e-7) * norm.sf((z - lift) / 8e-7)
    found = np.array(
        [
            [np.mean(honed(seed=1931 + k, material_ratio=material_ratio).heights > level) for level in z]
            for k in range(8)
        ]
    )
    error = found.std(axis=0, ddof=1) / np.sqrt(8)
    assert (error < 0.01).all()
    assert (np.abs(found.mean(axis=0) - expected) < 4 * error + 1e-3).all()


def test_valleys_cross_at_the_half_angle():
    """Deep places are correlated further along both families than along the axes between them."""
    made = honed(valley_anisotropy=12.0, half_angle=math.pi / 6, points=(401, 400))
    deep = (made.heights < -4e-7).astype(float)
    together = np.fft.ifft2(np.abs(np.fft.fft2(deep - deep.mean())) ** 2).real
    together /= together[0, 0]

    def along(angle):
        lag = np.array([round(20e-6 / step * part) for step, part in zip(made.spacing, angle, strict=True)])
        return together[tuple(lag)]

    families = [along((math.cos(sign * math.pi / 6), math.sin(sign * math.pi / 6))) for sign in (1, -1)]
    assert min(families) > 2 * max(along((1, 0)), along((0, 1)))
    assert families[0] == pytest.approx(families[1], abs=0.1)
