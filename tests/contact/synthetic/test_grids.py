"""A synthetic surface is the same on every run and every grid, and its joint is like any other place."""

import hashlib
import subprocess
import sys

import numpy as np
import pytest
from numpy.testing import assert_allclose

from roughfilm.contact.synthetic.description import make, read_entries

KINDS = {
    "self_affine": {
        "kind": "self_affine",
        "seed": 41,
        "hurst": 0.7,
        "roll_off": "0.2 mm",
        "cut_off": "40 um",
        "rms_slope": 0.1,
    },
    "gaussian": {
        "kind": "gaussian",
        "seed": 43,
        "rms_height": "1 um",
        "correlation_length": "60 um",
        "anisotropy": 3,
        "lay_angle": "30 deg",
    },
    "sinusoid": {"kind": "sinusoid", "amplitude": "1 um", "wavelength_x": "0.25 mm", "wavelength_y": "0.175 mm"},
    "cross_hatch": {
        "kind": "cross_hatch",
        "spacing": "0.1 mm",
        "half_angle": "30 deg",
        "depth": "1 um",
        "width": "40 um",
    },
    "milled": {"kind": "milled", "radius": "3 mm", "feed": "0.1 mm", "depth": "2 um"},
    "milled aside": {"kind": "milled", "radius": "3 mm", "feed": "0.1 mm", "depth": "2 um", "offset": "0.5 mm"},
    "milled, front and back": {
        "kind": "milled",
        "radius": "3 mm",
        "feed": "0.1 mm",
        "depth": "2 um",
        "back_lift": "0.3 um",
    },
    "plateau_honed": {
        "kind": "plateau_honed",
        "seed": 47,
        "plateau_rms_height": "0.2 um",
        "plateau_correlation_length": "60 um",
        "valley_rms_height": "1 um",
        "valley_correlation_length": "60 um",
        "valley_anisotropy": 3,
        "half_angle": "35 deg",
        "material_ratio": 0.7,
    },
}
RANDOM = ("self_affine", "gaussian", "plateau_honed")
SHAPED = KINDS | {
    f"{kind}, skewed": KINDS[kind] | {"height_distribution": {"skewness": -1.0}} for kind in ("self_affine", "gaussian")
}
ON_A_RECTANGLE = {"size": ["1 mm", "0.7 mm"]}


def surface(kind, points, **changes):
    return make(read_entries(SHAPED[kind] | ON_A_RECTANGLE | {"points": list(points)} | changes))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("points", "finer"), [((130, 96), (2, 2)), ((131, 99), (3, 2))])
def test_a_finer_grid_holds_the_same_surface(kind, points, finer):
    coarse = surface(kind, points)
    fine = surface(kind, (points[0] * finer[0], points[1] * finer[1]))
    assert_allclose(fine.heights[:: finer[0], :: finer[1]], coarse.heights, rtol=0, atol=3e-12 * coarse.heights.std())


def test_a_shorter_cut_off_keeps_the_waves_and_adds_others():
    def low(surface):
        waves = np.fft.fft2(surface.heights) / surface.heights.size
        numbers = [np.abs(np.fft.fftfreq(count, 1 / count)) for count in surface.shape]
        inside = (numbers[0][:, None] < 17) & (numbers[1] < 12)
        return waves[inside & (np.abs(waves) > 0)]

    coarse, fine = (low(surface("self_affine", (200, 140), cut_off=cut_off)) for cut_off in ("40 um", "12 um"))
    strong = np.abs(coarse) > 1e-3 * np.abs(coarse).max()
    ratio = fine[strong] / coarse[strong]
    assert_allclose(ratio, ratio[0].real, rtol=1e-7)
    assert 0.1 < ratio[0].real < 0.9


@pytest.mark.parametrize("kind", SHAPED)
@pytest.mark.parametrize("points", [(128, 96), (131, 99)])
def test_the_joint_is_like_any_other_place(kind, points):
    """Steps across the joint are no greater than elsewhere, and their rms value within a tenth of those elsewhere."""
    made = surface(kind, points)
    assert made.periodic
    for axis in (0, 1):
        inside = np.abs(np.diff(made.heights, axis=axis))
        joint = np.abs(np.take(made.heights, 0, axis) - np.take(made.heights, -1, axis))
        columns = np.sqrt(np.mean(inside**2, axis=1 - axis))
        assert joint.max() <= inside.max() * (1 + 1e-9)
        assert columns.min() * 0.9 <= np.sqrt(np.mean(joint**2)) <= columns.max() * 1.1


def digests():
    return [hashlib.sha256(surface(kind, (66, 51)).heights.tobytes()).hexdigest() for kind in SHAPED]


def test_the_same_bytes_in_this_process_and_in_another():
    here = digests()
    assert digests() == here
    code = f"import runpy; print(' '.join(runpy.run_path({__file__!r})['digests']()))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=120)
    assert done.stdout.split() == here


@pytest.mark.parametrize("kind", RANDOM)
def test_another_seed_is_another_surface(kind):
    one, other = surface(kind, (130, 96)).heights, surface(kind, (130, 96), seed=2**40 + 11).heights
    assert abs(np.corrcoef(one.ravel(), other.ravel())[0, 1]) < 0.4


def test_numbers_drawn_for_more_waves_begin_with_those_for_fewer():
    """What keeps a surface when its cut-off shrinks: a longer draw begins with the shorter one."""
    few, many = (np.random.default_rng(97).standard_normal((count, 2)) for count in (100, 100_000))
    assert (many[:100] == few).all()
