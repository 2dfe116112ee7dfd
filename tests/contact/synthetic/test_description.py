"""Descriptions are read exactly, kept with the surface, and refused in one line where they make no sense."""

import contextlib
import json
import tomllib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.description import description_entries, make, read_description, read_entries

SELF_AFFINE = """
kind = "self_affine"
size = ["1 mm", "0.8 mm"]
points = [90, 70]
seed = 20071
hurst = 0.8
roll_off = "0.25 mm"
cut_off = "40 um"
rms_slope = 0.1
"""
GAUSSIAN = """
kind = "gaussian"
size = ["1 mm", "0.8 mm"]
points = [90, 70]
seed = 11
rms_height = "1 um"
correlation_length = "50 um"
anisotropy = 3
lay_angle = "30 deg"
"""
SINUSOID = """
kind = "sinusoid"
size = ["1 mm", "0.8 mm"]
points = [90, 70]
amplitude = "1 um"
wavelength_x = "0.25 mm"
"""
CROSS_HATCH = """
kind = "cross_hatch"
size = ["1 mm", "0.8 mm"]
points = [90, 70]
spacing = "0.1 mm"
half_angle = "30 deg"
depth = "1 um"
width = "40 um"
"""
MILLED = """
kind = "milled"
size = ["1 mm", "0.8 mm"]
points = [90, 70]
radius = "5 mm"
feed = "0.1 mm"
depth = "2 um"
back_lift = "0 um"
"""
HONED = """
kind = "plateau_honed"
size = ["1 mm", "0.8 mm"]
points = [90, 70]
seed = 5
plateau_rms_height = "0.1 um"
plateau_correlation_length = "30 um"
valley_rms_height = "1 um"
valley_correlation_length = "30 um"
valley_anisotropy = 8
half_angle = "30 deg"
material_ratio = 0.8
"""
SKEWED = "[height_distribution]\nskewness = -1.0\n"
ALL = {
    "self_affine": SELF_AFFINE,
    "self_affine, skewed": SELF_AFFINE + SKEWED,
    "gaussian": GAUSSIAN,
    "gaussian, skewed": GAUSSIAN + SKEWED,
    "sinusoid": SINUSOID,
    "cross_hatch": CROSS_HATCH,
    "milled": MILLED,
    "plateau_honed": HONED,
}


@pytest.fixture
def file_of(tmp_path):
    def write(text):
        (tmp_path / "surface.toml").write_text(text, encoding="utf-8")
        return tmp_path / "surface.toml"

    return write


@pytest.mark.parametrize("text", ALL.values(), ids=ALL)
def test_a_surface_states_the_description_it_was_made_from(text, file_of):
    description = read_description(file_of(text))
    surface = make(description)
    assert surface.periodic
    assert surface.shape == (90, 70)
    assert surface.size == pytest.approx((1e-3, 8e-4), rel=1e-14)
    source = json.loads(json.dumps(dict(surface.source)))
    assert source["synthetic"] == description_entries(description)
    assert read_entries(source["synthetic"]) == description
    assert (make(read_entries(source["synthetic"])).heights == surface.heights).all()


def test_lengths_and_angles_are_read_in_si(file_of):
    description = read_description(file_of(GAUSSIAN))
    assert description.size == (1e-3, 8e-4)
    assert description.correlation_length == 5e-5
    assert description.lay_angle == pytest.approx(np.pi / 6, rel=1e-15)


def changed(text, old, new):
    assert text.count(old) == 1
    return text.replace(old, new)


@pytest.mark.parametrize(
    ("text", "old", "new", "words"),
    [
        (SELF_AFFINE, "hurst", "hurts", r"surface\.hurts: unknown key; did you mean 'hurst'"),
        (GAUSSIAN, "anisotropy", "gamma", r"surface\.gamma: unknown key; known here: .*anisotropy"),
        (SELF_AFFINE + SKEWED, "skewness", "skewnes", r"height_distribution\.skewnes: unknown key; did you mean"),
        (SINUSOID, 'amplitude = "1 um"', "", r"surface\.amplitude: missing; add it"),
        (SINUSOID, 'kind = "sinusoid"', "", r"surface\.kind: missing; add it"),
        (SINUSOID, '"sinusoid"', '"sine"', r"surface\.kind: got 'sine'; it must be one of"),
        (SINUSOID, '"sinusoid"', "[1]", r"surface\.kind: "),
        (SINUSOID, '"1 um"', "1e-6", r"surface\.amplitude: got 1e-06, a number without a unit"),
        (SINUSOID, '"1 um"', '"1 s"', r"surface\.amplitude: .*wrong dimension"),
        (SINUSOID, '"1 um"', '"-1 um"', r"surface\.amplitude: .*above zero"),
        (SINUSOID, "[90, 70]", "[90.5, 70]", r"surface\.points\.0: got 90\.5; write a whole number"),
        (SINUSOID, "[90, 70]", "[90, true]", r"surface\.points\.1: got True; write a whole number"),
        (SINUSOID, "[90, 70]", "[90]", r"surface\.points"),
        (SINUSOID, "[90, 70]", "[90, 70, 3]", r"surface\.points"),
        (SINUSOID, "[90, 70]", "[1, 70]", r"sinusoid\.points: got 1; write a whole number from 2"),
        (SINUSOID, "[90, 70]", "[20000, 20000]", r"sinusoid\.points: got 20000 x 20000; write at most 1e8"),
        (SINUSOID, '"0.8 mm"', '"1000 km"', r"sinusoid\.size: .*look at the units"),
        (SINUSOID, '"0.8 mm"', '"1e10 m"', r"sinusoid\.size: .*look at the unit"),
        (SINUSOID, '"0.25 mm"', '"0.3 mm"', r"sinusoid\.wavelength_x: .*write 0\.00033333 m or 0\.00025 m"),
        (SINUSOID, '"0.25 mm"', '"3 mm"', r"sinusoid\.wavelength_x: .*write 0\.001 m"),
        (SINUSOID, '"0.25 mm"', '"20 um"', r"sinusoid\.wavelength_x: .*below two pixels; write at least 2\.2222e-05 m"),
        (SINUSOID, 'wavelength_x = "0.25 mm"', "", "neither of wavelength_x and wavelength_y"),
        (SINUSOID, "amplitude =", 'combination = "both"\namplitude =', r"surface\.combination: got 'both'"),
        (SELF_AFFINE, "seed = 20071", "seed = -1", r"self_affine\.seed: got -1"),
        (SELF_AFFINE, "seed = 20071", 'seed = "x"', r"surface\.seed: got 'x'; write a whole number"),
        (SELF_AFFINE, "0.8\nroll", "1.2\nroll", r"self_affine\.hurst: got 1\.2; it must be above 0 and at most 1"),
        (SELF_AFFINE, "0.8\nroll", "0\nroll", r"surface\.hurst: got 0\.0; it must be above zero"),
        (SELF_AFFINE, "0.8\nroll", "nan\nroll", r"surface\.hurst: got nan"),
        (SELF_AFFINE, '"40 um"', '"0.3 mm"', r"self_affine\.cut_off: .*not below the roll-off"),
        (SELF_AFFINE, '"40 um"', '"20 um"', r"self_affine\.cut_off: .*below two pixels; write at least 2\.2857e-05 m"),
        (SELF_AFFINE, '"0.25 mm"', '"1.5 mm"', r"self_affine\.roll_off: .*write at most 0\.001 m"),
        (SELF_AFFINE, "rms_slope = 0.1", "", "neither of rms_height and rms_slope; give exactly one"),
        (SELF_AFFINE, "rms_slope =", 'rms_height = "1 um"\nrms_slope =', "both of rms_height and rms_slope"),
        (SELF_AFFINE, "rms_slope = 0.1", "rms_slope = 1e9", r"self_affine\.rms_slope: got 1000000000\.0"),
        (SELF_AFFINE, "hurst", 'amplitudes = "exact"\nhurst', r"surface\.amplitudes: got 'exact'"),
        (SELF_AFFINE + SKEWED, "-1.0", "-9.0", r"distribution\.skewness: got -9\.0; it must be -4 to 4"),
        (SELF_AFFINE + SKEWED, "-1.0", '"-1"', r"surface\.height_distribution\.skewness: got '-1'"),
        (GAUSSIAN, '"50 um"', '"20 um"', r"gaussian\.correlation_length: .*below two pixels"),
        (GAUSSIAN, '"50 um"', '"0.2 mm"', r"correlation_length: .*along x, beyond half the period; write at most"),
        (GAUSSIAN, "= 3", "= 1e9", r"gaussian\.anisotropy: got 1000000000\.0"),
        (GAUSSIAN, '"30 deg"', '"3000 deg"', r"gaussian\.lay_angle: got 52\.3\d*; it must be"),
        (GAUSSIAN, '"30 deg"', '"30 um"', r"surface\.lay_angle: .*wrong dimension"),
        (CROSS_HATCH, '"30 deg"', '"90 deg"', r"cross_hatch\.half_angle"),
        (CROSS_HATCH, '"0.1 mm"', '"0.7 mm"', "which does not close over the period; write"),
        (CROSS_HATCH, '"40 um"', '"15 um"', r"cross_hatch\.width: .*below two pixels"),
        (CROSS_HATCH, '"40 um"', '"0.2 mm"', r"cross_hatch\.width: .*at most the spacing"),
        (MILLED, '"0.1 mm"', '"0.13 mm"', r"milled\.feed: .*write 0\.00014286 m or 0\.000125 m"),
        (MILLED, '"5 mm"', '"0.3 mm"', r"milled\.radius: .*arcs end inside the width; write more than 0\.0004 m"),
        (MILLED, '"5 mm"', '"0.401 mm"', r"milled\.radius: .*within two pixels"),
        (MILLED, '"0 um"', '"-1 um"', r"milled\.back_lift"),
        (HONED, "= 0.8", "= 1.0", r"plateau_honed\.material_ratio"),
        (HONED, '"1 um"', '"0.01 um"', r"plateau_honed\.valley_rms_height: .*at least that of the plateaus"),
        (HONED, "= 8", "= 40", r"plateau_honed\.valley_correlation_length: .*beyond half the period"),
        (HONED, '"30 deg"', '"100 deg"', r"plateau_honed\.half_angle"),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_line(text, old, new, words, file_of):
    with pytest.raises(InputError, match=words) as caught:
        make(read_description(file_of(changed(text, old, new))))
    assert "\n" not in str(caught.value)


def test_the_remedy_of_a_refusal_is_accepted(file_of):
    for text, old, new in (
        (SINUSOID, '"0.25 mm"', '"0.33333 mm"'),
        (SINUSOID, '"0.25 mm"', '"22.222 um"'),
        (MILLED, '"0.1 mm"', '"0.14286 mm"'),
        (SELF_AFFINE, '"0.25 mm"', '"1 mm"'),
    ):
        assert make(read_description(file_of(changed(text, old, new)))).heights.std() > 0


LENGTHS = st.sampled_from(
    ["1 mm", "0.8 mm", "1e-3 um", "30 um", "0.1 mm", "2 um", "1e-15 m", "1e6 m", "1e-300 m", "1e300 m"]
)
NUMBERS = st.sampled_from([0.5, 1, 0.8, 3, 1e-12, 1e12, 1e-300, 1e300, -1, 0])
COUNTS = st.sampled_from([2, 3, 5, 16, 33])


@settings(max_examples=150, deadline=None)
@given(st.sampled_from(sorted(ALL)), st.data())
def test_any_numbers_give_a_finite_surface_or_a_refusal(name, data):
    entries = tomllib.loads(ALL[name])
    entries["points"] = [data.draw(COUNTS), data.draw(COUNTS)]
    for key in data.draw(st.sets(st.sampled_from(sorted(entries)), max_size=3)):
        value = entries[key]
        if isinstance(value, str) and value.endswith(("m", "um")):
            entries[key] = data.draw(LENGTHS)
        elif isinstance(value, int | float):
            entries[key] = data.draw(NUMBERS)
        elif key == "size":
            entries[key] = [data.draw(LENGTHS), data.draw(LENGTHS)]
    surface = None
    with contextlib.suppress(InputError):
        surface = make(read_entries(entries))
    if surface is not None:
        assert np.isfinite(surface.heights).all()
        assert surface.heights.std() > 0
