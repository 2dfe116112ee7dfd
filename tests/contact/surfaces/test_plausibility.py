"""A unit that cannot be right is named with its value, range and remedy, and nothing is altered."""

import re
import warnings

import numpy as np
import pytest

import roughfilm as rf
from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import Recipe
from roughfilm.contact.surfaces.plausibility import implausible, repeated_extreme
from roughfilm.contact.surfaces.surface import Surface

COUNT = 64


def rough(spacing=2.5e-6, rms=1e-6, **changes):
    """A smooth random surface, periodic by its making."""
    rng = np.random.default_rng(881)
    q = np.hypot(np.fft.fftfreq(COUNT)[:, None], np.fft.rfftfreq(COUNT)[None, :]) * COUNT
    heights = np.fft.irfft2(np.fft.rfft2(rng.normal(size=(COUNT, COUNT))) * (q < 8), s=(COUNT, COUNT))
    heights -= heights.mean()
    return Surface(heights=rms * heights / heights.std(), spacing=(spacing, spacing), **changes)


@pytest.mark.parametrize("spacing", [0.05e-9, 1.01e-9, 1e-7, 1e-5, 0.99e-3])
@pytest.mark.parametrize("relative", [1e-4, 1e-2, 1])
def test_usual_surfaces_pass(spacing, relative):
    assert implausible(rough(spacing, max(relative * spacing, 2e-11))) == ()


@pytest.mark.parametrize(
    ("spacing", "rms", "said"),
    [
        (2.5, 1e-6, "the pixel spacing is 2.5 x 2.5 m, outside of the plausible 5e-11 to 0.001 m;.* set read.spacing "),
        (2.5e-12, 1e-12, "the pixel spacing is 2.5e-12 x .* set read.spacing "),
        (2.5e-6, 1e-4, "the rms slope is .*, not below the plausible 3;.* set read.spacing, or read.height_unit, "),
        (2.5e-6, 1.0, "the rms slope is .* set read.height_unit in"),
        (1e-3, 5e-12, "the rms height is 5e-12 m, 5e-09 pixels, outside of the plausible 1e-05 to .*read.height_unit"),
    ],
)
def test_a_wrong_unit_is_named_with_its_range_and_remedy(spacing, rms, said):
    sentence, *_ = implausible(rough(spacing, rms), "s.csv")
    assert re.match(f"s.csv: {said}", sentence)
    assert sentence.endswith("in the recipe of roughfilm surface")


def test_a_plane_has_its_slope():
    x = np.arange(COUNT)
    for slope, wrong in ((2.9, False), (3.1, True)):
        plane = Surface(heights=1e-6 * slope / np.sqrt(2) * (x[:, None] + x[None, :]), spacing=(1e-6, 1e-6))
        assert bool(implausible(plane)) == wrong


def test_a_few_spikes_and_invalid_points_are_no_wrong_unit():
    given = rough()
    heights, invalid = given.heights.copy(), np.zeros(given.shape, bool)
    heights[10, 20] = heights[40, 50] = 1e-3
    invalid[30:40, 3:9] = True
    assert implausible(given.with_heights(heights, invalid=invalid)) == ()


def test_a_flat_surface_passes():
    assert implausible(Surface(heights=np.ones((4, 4)), spacing=(1e-6, 1e-6))) == ()


def test_a_synthetic_surface_has_the_units_of_its_description():
    source = {"prepared_from": {"synthetic": {}}}
    assert implausible(rough(2.5, 1e-6, source=source)) == ()


def test_preparation_warns_and_alters_nothing():
    wrong, right = (prepare(rough(spacing), Recipe()) for spacing in (2.5, 2.5e-6))
    assert any(warning.startswith("the pixel spacing is 2.5 x 2.5 m") for warning in wrong.warnings)
    assert not any("plausible" in warning for warning in right.warnings)
    assert wrong.surface.spacing == pytest.approx([1e6 * step for step in right.surface.spacing])
    assert np.array_equal(wrong.surface.heights, right.surface.heights)


@pytest.mark.parametrize("height", [3e-6, 0.1, -7e3, 0.0])
def test_constant_heights_have_no_unit_to_doubt(height):
    """The mean of 64 x 64 equal numbers differs from them by rounding, which is no rms height."""
    for heights in (np.full((COUNT, COUNT), height), height * (1 + 1e-15 * rough().heights / 1e-6)):
        given = Surface(heights=heights, spacing=(1e-6, 1e-6))
        assert implausible(given) == ()
        assert repeated_extreme(Surface(heights=np.full((COUNT, COUNT), height), spacing=(1e-6, 1e-6))) == ()


@pytest.mark.parametrize(("code", "word"), [(-9.999e-3, "lowest"), (9.999e-3, "highest")])
def test_many_points_that_share_an_extreme_height_are_said(code, word):
    heights = rough().heights.copy()
    heights[10:17, 20:23] = code
    (sentence,) = repeated_extreme(Surface(heights=heights, spacing=(1e-6, 1e-6)), "s.npy")
    assert sentence.startswith(f"s.npy: 21 points (0.51 %) share the {word} height, {code:g} m, to the last bit")
    assert "read.invalid" in sentence


def test_a_few_shared_extremes_are_no_code():
    heights = rough().heights.copy()
    heights[10:12, 20:22] = -1e-5
    assert repeated_extreme(Surface(heights=heights, spacing=(1e-6, 1e-6))) == ()


@pytest.mark.parametrize("steps", [20, 200])
def test_rounded_heights_are_no_codes(steps):
    """An instrument of few digits repeats every height."""
    heights = np.round(rough().heights * steps / 1e-6) / steps * 1e-6
    assert repeated_extreme(Surface(heights=heights, spacing=(1e-6, 1e-6))) == ()


def test_made_and_prepared_surfaces_may_have_plateaus():
    heights = np.minimum(rough().heights, 0.5e-6)
    assert repeated_extreme(Surface(heights=heights, spacing=(1e-6, 1e-6)))
    for source in ({"synthetic": {}}, {"prepared_from": {"file": "s.opd"}}):
        assert repeated_extreme(Surface(heights=heights, spacing=(1e-6, 1e-6), source=source)) == ()


def test_a_code_is_said_before_the_form_is_removed():
    heights = rough().heights.copy()
    heights[5:25, 20:40] = -9.999e-3
    warnings = prepare(Surface(heights=heights, spacing=(2.5e-6, 2.5e-6)), Recipe()).warnings
    assert sum("share the lowest height, -0.009999 m" in one for one in warnings) == 1


def far_apart(folder, suffix, step):
    """A file of heights whose points are so far apart, m, with the arguments that its reader needs."""
    path = folder / f"map{suffix}"
    heights = np.random.default_rng(1).standard_normal((12, 14))
    if suffix == ".npy":
        np.save(path, heights * step / 20)
        return path, {"spacing": step}
    if suffix == ".csv":
        rows = "\n".join(",".join(f"{1e9 * z * step / 20:.6g}" for z in row) for row in heights)
        path.write_text(f"# spacing: {1e9 * step:.6g} nm, {1e9 * step:.6g} nm; heights: nm\n{rows}\n")
        return path, {}
    tifffile = pytest.importorskip("tifffile")
    tifffile.imwrite(path, (1e9 * heights * step / 20).astype("f4"))
    return path, {"spacing": step, "height_unit": "nm"}


@pytest.mark.parametrize("suffix", [".npy", ".csv", ".tif"])
@pytest.mark.parametrize(("step", "shown"), [(2e-3, "0.002 x 0.002 m"), (4e-11, "4e-11 x 4e-11 m"), (1e-6, None)])
def test_pixels_beyond_a_millimetre_and_below_an_atom_are_named_for_every_reader(tmp_path, suffix, step, shown):
    path, arguments = far_apart(tmp_path, suffix, step)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        rf.read_surface(path, **arguments)
    said = [str(one.message) for one in caught if "pixel spacing" in str(one.message)]
    assert len(said) == (shown is not None)
    assert all(shown in one and "set read.spacing" in one for one in said)


@pytest.mark.measured
def test_a_file_of_an_instrument_with_pixels_of_a_third_of_a_metre_is_doubted(measured_file):
    pytest.importorskip("SurfaceTopography")
    with pytest.warns(UserWarning, match=r"pixel spacing is 0.312 x 0.312 m, .*set read.spacing"):
        rf.read_surface(measured_file("areal.nms"))
