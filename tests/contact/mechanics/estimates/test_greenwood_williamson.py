"""Asperities apart: sums over single Hertzian contacts, and contacts solved at light load."""

import math
import re

import numpy as np
import pytest
from scipy import stats
from scipy.integrate import quad

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.estimates.greenwood_williamson import exceedance, greenwood_williamson
from roughfilm.contact.mechanics.exact.hertz import HertzSphere
from roughfilm.contact.mechanics.exact.light_load import BUSH_GIBSON_THOMAS, PERSSON
from roughfilm.contact.mechanics.moments import SpectralMoments, wave_power
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.synthetic.self_affine import self_affine

MODULUS = 1.2e11
MOMENTS = SpectralMoments(m0=1e-12, m2=4e-3, m4=1e8, line=False)
STIFFNESS = MODULUS * MOMENTS.rms_slope


@pytest.mark.parametrize("power", [1.0, 1.5])
@pytest.mark.parametrize("t", [-25.0, -3.1, -0.4, 0.0, 0.7, 4.0, 12.0, 30.0])
def test_exceedances_are_their_integrals(t, power):
    """With exp(−t²/2) taken out of them where it would vanish."""
    far = max(t, 0.0) ** 2 / 2
    value, _ = quad(
        lambda s: (s - t) ** power * math.exp(far - s * s / 2) / math.sqrt(2 * math.pi), t, max(t + 10, 12), limit=400
    )
    assert exceedance(t, power) * math.exp(far) == pytest.approx(value, rel=1e-6)


@pytest.mark.parametrize("ratio", [1e-5, 1e-3, 0.02])
def test_it_is_a_crowd_of_hertzian_contacts(ratio):
    """A million asperities at the quantiles of their heights, each a sphere under the plane at its separation."""
    load = ratio * STIFFNESS
    found = greenwood_williamson(MOMENTS, composite_modulus=MODULUS, load=load)
    count = 1_000_000
    heights = MOMENTS.summit_mean + MOMENTS.summit_spread * stats.norm.ppf((np.arange(count) + 0.5) / count)
    depth = np.maximum(heights - found.mean_gap, 0.0)
    sphere = HertzSphere(radius=MOMENTS.summit_radius, composite_modulus=MODULUS, force=1.0)
    force = (depth / sphere.approach) ** 1.5
    assert MOMENTS.summit_density * force.mean() == pytest.approx(load, rel=5e-3)
    area = MOMENTS.summit_density * np.mean(np.pi * MOMENTS.summit_radius * depth)
    assert found.area_fraction == pytest.approx(area, rel=5e-3)


@pytest.mark.parametrize("ratio", [1e-6, 1e-3, 0.05])
def test_its_pressures_have_the_area_and_the_load(ratio):
    found = greenwood_williamson(MOMENTS, composite_modulus=MODULUS, load=ratio * STIFFNESS)
    highest = 40 * found.mean_contact_pressure
    assert quad(found.pressure_density, 0, highest, limit=200)[0] == pytest.approx(found.area_fraction, rel=1e-6)
    load = quad(lambda p: p * found.pressure_density(p), 0, highest, limit=200)[0]
    assert load == pytest.approx(ratio * STIFFNESS, rel=1e-6)


def test_its_slope_lies_where_those_of_the_theories_do():
    """κ = A E* g'/P falls with the load, from about that of Bush, Gibson and Thomas."""
    kappa = [
        greenwood_williamson(MOMENTS, composite_modulus=MODULUS, load=r * STIFFNESS).area_fraction / r
        for r in (1e-6, 1e-4, 1e-2)
    ]
    assert PERSSON < kappa[2] < kappa[1] < kappa[0] < 1.2 * BUSH_GIBSON_THOMAS


def test_a_solved_contact_is_like_it_at_light_load():
    """As far as it says: area within a tenth, gap within a twentieth, at about 1 % of contact."""
    surfaces = [
        self_affine(
            size=(1e-3, 1e-3), points=(128, 128), seed=seed, hurst=0.8, roll_off=1.25e-4, cut_off=6e-5, rms_slope=0.1
        )
        for seed in (5303, 5309)
    ]
    moments = wave_power(surfaces[0].heights, surfaces[0].spacing).moments
    load = 5e-3 * MODULUS * 0.1
    solved = [Press(s.heights, s.spacing, MODULUS).at(load, tolerance=1e-6) for s in surfaces]
    found = greenwood_williamson(moments, composite_modulus=MODULUS, load=load)
    assert found.trusted
    assert found.area_fraction == pytest.approx(np.mean([s.area_fraction for s in solved]), rel=0.1)
    assert found.mean_gap == pytest.approx(np.mean([s.mean_gap for s in solved]), rel=0.05)


def test_it_is_not_trusted_where_asperities_crowd():
    crowded = greenwood_williamson(MOMENTS, composite_modulus=MODULUS, load=0.05 * STIFFNESS)
    assert crowded.area_fraction > 0.03
    assert not crowded.trusted


@pytest.mark.parametrize("nayak", [1.5, 1.59, 8.1, 77.0])
def test_it_is_not_trusted_outside_the_spectra_compared(nayak):
    moments = SpectralMoments(m0=1e-12, m2=4e-3, m4=nayak * 1.6e7, line=False)
    assert not greenwood_williamson(moments, composite_modulus=MODULUS, load=5e-3 * STIFFNESS).trusted


@pytest.mark.parametrize("nayak", [1.5, 2.0, 6.25, 20.0, 77.0, 99.0])
def test_within_its_range_the_area_is_small_and_the_plane_above_the_mean_height(nayak):
    moments = SpectralMoments(m0=1e-12, m2=4e-3, m4=nayak * 1.6e7, line=False)
    with pytest.raises(InputError) as refused:
        greenwood_williamson(moments, composite_modulus=MODULUS, load=STIFFNESS)
    assert "\n" not in str(refused.value)
    words = str(refused.value).partition("it must be ")[2].split()
    least, most = float(words[0]) * 1.001, float(words[2]) * 0.999
    for load in np.geomspace(least, most, 7):
        found = greenwood_williamson(moments, composite_modulus=MODULUS, load=load)
        assert 0 < found.area_fraction <= 0.1
        assert found.mean_gap > 0
    assert found.area_fraction == pytest.approx(0.1, rel=0.01) or found.mean_gap < 1e-2 * moments.rms_height


@pytest.mark.parametrize(("seed", "hurst", "shortest"), [(1, 0.8, 8), (2, 0.5, 6), (3, 1.0, 8), (4, 0.7, 10)])
def test_where_it_is_trusted_a_solved_contact_is_like_it(seed, hurst, shortest):
    surface = self_affine(
        size=(1e-3, 1e-3),
        points=(128, 128),
        seed=seed,
        hurst=hurst,
        roll_off=1e-3 / 3,
        cut_off=1e-3 * shortest / 128,
        rms_slope=0.1,
    )
    moments = wave_power(surface.heights, surface.spacing).moments
    press = Press(surface.heights, surface.spacing, MODULUS)
    trusted = 0
    for ratio in (2e-3, 5e-3, 8e-3, 0.03):
        found = greenwood_williamson(moments, composite_modulus=MODULUS, load=ratio * MODULUS * 0.1)
        if found.trusted:
            solved = press.at(ratio * MODULUS * 0.1, tolerance=1e-6)
            trusted += 1
            assert found.area_fraction == pytest.approx(solved.area_fraction, rel=0.4)
            assert found.mean_gap == pytest.approx(solved.mean_gap, rel=0.15)
    assert trusted == 3


def test_the_lightest_load_is_that_of_one_summit():
    """On an area A0, η A0 Φ(−t) summits lie above the plane; at the lightest load this is 1."""
    area = 1000 / MOMENTS.summit_density
    with pytest.raises(InputError, match=r"it must be .*, where one summit or more touches") as refused:
        greenwood_williamson(MOMENTS, composite_modulus=MODULUS, load=1e-6 * STIFFNESS, nominal_area=area)
    least = float(re.search(r"must be (\S+) to", str(refused.value))[1])
    found = greenwood_williamson(MOMENTS, composite_modulus=MODULUS, load=1.001 * least, nominal_area=area)
    t = (found.mean_gap - MOMENTS.summit_mean) / MOMENTS.summit_spread
    assert 1000 * stats.norm.sf(t) == pytest.approx(1, rel=5e-3)
    with pytest.raises(InputError, match=r"nominal_area: got .* with 1.2 summits, too few"):
        greenwood_williamson(
            MOMENTS, composite_modulus=MODULUS, load=1e-3 * STIFFNESS, nominal_area=1.2 / MOMENTS.summit_density
        )


def test_it_is_not_trusted_where_a_tenth_of_its_contact_exceeds_the_hardness():
    load = 2e-3 * STIFFNESS
    elastic = greenwood_williamson(MOMENTS, composite_modulus=MODULUS, load=load)
    assert elastic.trusted
    for ratio in (1.0, 1.5, 2.0, 2.5, 3.0):
        hardness = ratio * elastic.mean_contact_pressure
        above, _ = quad(elastic.pressure_density, hardness, 40 * elastic.mean_contact_pressure, limit=200)
        found = greenwood_williamson(MOMENTS, composite_modulus=MODULUS, load=load, hardness=hardness)
        assert found.trusted == (above <= 0.1 * elastic.area_fraction), ratio
    assert not greenwood_williamson(
        MOMENTS, composite_modulus=MODULUS, load=load, hardness=elastic.mean_contact_pressure
    ).trusted


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"load": 0.0}, "load"),
        ({"hardness": 0.0}, "hardness: got 0.0; give a number above 0"),
        ({"nominal_area": -1.0}, "nominal_area: got -1.0; give a number above 0"),
        ({"load": 1e30}, "got 1e.30 Pa; it must be"),
        ({"load": 1e-9}, "got 1e-09 Pa; it must be"),
        (
            {"moments": SpectralMoments(m0=1e-12, m2=4e-3, m4=1.7e9, line=False)},
            "parameter 106.2; it must be 1.5 to 100",
        ),
        ({"moments": SpectralMoments(m0=1e-12, m2=4e-3, m4=2e7, line=False)}, "parameter 1.25; it must be 1.5 to 100"),
        ({"composite_modulus": np.nan}, "composite_modulus"),
        ({"moments": SpectralMoments(m0=1e-12, m2=4e-3, m4=1e8, line=True)}, "ridges"),
    ],
)
def test_what_makes_no_sense_is_refused(changes, words):
    given = {"moments": MOMENTS, "composite_modulus": MODULUS, "load": 1e7} | changes
    with pytest.raises(InputError, match=words):
        greenwood_williamson(given.pop("moments"), **given)
