"""Parameters of measured surfaces agree with numpy's and with those of surfalize, wherever their definitions do."""

import warnings

import numpy as np
import pytest

from roughfilm.contact.parameters.autocorrelation import autocorrelation, decay_lengths
from roughfilm.contact.parameters.bearing_curve import bearing_core, descending
from roughfilm.contact.parameters.roughness_parameters import parameters
from roughfilm.contact.parameters.spectrum import power_spectrum, texture_direction
from roughfilm.contact.preparation.filling import fill_invalid
from roughfilm.contact.surfaces.surface import Surface

pytestmark = pytest.mark.measured

# The table beside the files: Sa, Sq, Sz, Sz99.8 (µm), Ssk, Sku by numpy; Spk, Svk (µm) by surfalize 0.19.2.
TABLE = {
    "milled_NT1100.opd": (1.558, 1.888, 18.11, 10.47, 0.17, 2.62, 1.954, 1.01),
    "oblique_grooves.x3p": (15.23, 18.14, 84.32, 72.49, -0.88, 2.56, 3.237, 37.36),
    "periodic_grooves.plu": (4.479, 5.161, 23.96, 20.84, -0.25, 1.88, 1.48, 4.419),
    "ground_striated.x3p": (0.06153, 0.07652, 0.5521, 0.453, -0.39, 2.94, 0.05122, 0.08827),
    "isotropic.al3d": (0.2054, 0.2592, 1.88, 1.613, -0.04, 3.14, 0.2648, 0.261),
    "polished.opd": (0.005012, 0.006501, 0.1128, 0.05116, -0.39, 4.72, 0.006033, 0.008302),
    "polished_with_spikes.sur": (0.004341, 0.01135, 1.47, 0.04146, -53.13, 4221.91, 0.003338, 0.009924),
    "stitching_artefacts.txt": (0.1759, 0.2382, 3.387, 2.083, -0.17, 6.26, 0.3033, 0.3135),
}
every_file = pytest.mark.parametrize("name", TABLE)


def in_surfalize(surface):
    """The same surface there: rows along y, µm, and points that were not measured filled by the nearest."""
    surfalize = pytest.importorskip("surfalize")
    heights = np.where(surface.invalid, np.nan, surface.heights).T * 1e6
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = surfalize.Surface(heights, *(length * 1e6 for length in surface.spacing))
        return found.fill_nonmeasured() if surface.invalid.any() else found


@every_file
def test_heights_are_those_of_the_table(measured, name):
    surface = measured(name)
    found = parameters(surface)
    average, rms, total, middle, skewness, kurtosis, *_ = TABLE[name]
    for symbol, value in (("Sa", average), ("Sq", rms), ("Sz", total)):
        assert found[symbol].value == pytest.approx(value * 1e-6, rel=5e-4), symbol
    assert found["Ssk"].value == pytest.approx(skewness, abs=0.0051)
    assert found["Sku"].value == pytest.approx(kurtosis, abs=0.0051)
    low, high = np.percentile(surface.heights[surface.valid], [0.1, 99.9])
    assert high - low == pytest.approx(middle * 1e-6, rel=5e-4)


@every_file
def test_the_core_is_that_of_surfalize(measured, name):
    other = in_surfalize(measured(name))
    core = bearing_core(descending(other.data))
    assert core.height == pytest.approx(other.Sk(), rel=3e-4)
    assert core.peak_ratio == pytest.approx(other.Smr1() / 100, rel=2e-3)
    assert core.valley_ratio == pytest.approx(other.Smr2() / 100, rel=2e-4)


@pytest.mark.parametrize("name", sorted(TABLE.keys() - {"polished_with_spikes.sur"}))
def test_peaks_and_valleys_of_the_bearing_curve_are_those_of_the_table(measured, name):
    """The table's are of surfaces whose holes were filled by the nearest points."""
    core = bearing_core(descending(in_surfalize(measured(name)).data))
    *_, peak, valley = TABLE[name]
    assert core.peak == pytest.approx(peak, rel=5e-3)
    assert core.valley == pytest.approx(valley, rel=5e-3)


@pytest.mark.parametrize("name", sorted(TABLE.keys() - {"polished_with_spikes.sur"}))
def test_a_harmonic_fill_gives_the_same_peaks_and_valleys(measured, name):
    filled, _ = fill_invalid(measured(name))
    found = bearing_core(descending(filled.heights))
    *_, peak, valley = TABLE[name]
    assert found.peak * 1e6 == pytest.approx(peak, rel=5e-3)
    assert found.valley * 1e6 == pytest.approx(valley, rel=5e-3)


def test_spikes_weigh_what_their_points_do(measured):
    """The areas are those of the bearing curve integrated over height instead of ratio.

    The table has 9 % and 5 % more here: surfalize joins the curve at 10 000 ratios by straight lines, so that a spike
    of a single point, a twenty-seventh of a class, gets the area of half a class.
    """
    heights = in_surfalize(measured("polished_with_spikes.sur")).data
    rising, core = np.sort(heights, axis=None), bearing_core(descending(heights))
    above = np.linspace(core.upper, rising[-1], 400_001)
    below = np.linspace(rising[0], core.lower, 400_001)
    peaks = np.trapezoid(1 - np.searchsorted(rising, above) / rising.size, above)
    valleys = np.trapezoid(np.searchsorted(rising, below) / rising.size, below)
    assert core.peak == pytest.approx(2 * peaks / core.peak_ratio, rel=1e-4)
    assert core.valley == pytest.approx(2 * valleys / (1 - core.valley_ratio), rel=1e-4)
    *_, peak, valley = TABLE["polished_with_spikes.sur"]
    assert 1.05 < peak / core.peak < 1.10
    assert 1.03 < valley / core.valley < 1.06


@pytest.mark.parametrize("name", ["milled_NT1100.opd", "isotropic.al3d", "polished.opd"])
def test_decay_lengths_are_those_of_surfalize(measured, name):
    """Where the lobe ends inside half the surface: beyond that surfalize goes on to lags of which few pairs tell."""
    other = in_surfalize(measured(name))
    surface = Surface(heights=other.data.T * 1e-6, spacing=(other.step_x * 1e-6, other.step_y * 1e-6))
    found = decay_lengths(autocorrelation(surface), surface.spacing)
    assert found.closed
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        shortest, aspect = other.Sal(), other.Str()
    assert found.shortest * 1e6 == pytest.approx(shortest, rel=2e-3)
    assert found.aspect == pytest.approx(aspect, rel=2e-3)


@pytest.mark.parametrize(
    ("name", "lay", "tolerance"),
    [
        ("periodic_grooves.plu", 90.0, 0.5),
        ("oblique_grooves.x3p", 31.0, 0.5),  # 59° from the y axis
        ("ground_striated.x3p", 88.55, 0.5),  # along the crest of its autocorrelation
    ],
)
def test_the_lay_is_what_the_eye_sees(measured, name, lay, tolerance):
    surface = measured(name)
    assert texture_direction(power_spectrum(surface)) == pytest.approx(lay, abs=tolerance)
    assert parameters(surface)["Str"].value < 0.06


def test_spikes_show_where_parameters_of_the_extremes_and_of_the_bulk_part(measured):
    found = {name: quantity.value for name, quantity in parameters(measured("polished_with_spikes.sur")).items()}
    assert found["Sz"] > 100 * found["Sq"]
    assert found["Spm"] + found["Svm"] < 0.6 * found["Sz"]
    assert found["Sk"] < 4 * found["Sa"]
