"""The gaps of infinitely wide pads, and the bearings whose flow is not resolved across the film."""

import re

import numpy as np
import pytest

from roughfilm.rom.bearing.wide_pad.gap import pad_gap, thin_film_obstacle
from roughfilm.rom.ladder.scene import read_scene

TEXTURE = {"length": "1 mm", "depth": "10 um", "start": "1 mm", "pitch": "3 mm", "columns": 2}


def pad(geometry, speed="4 m/s", lubricant=None, **tables):
    liquid = {"viscosity": "10 mPa*s", "density": "1000 kg/m^3", **(lubricant or {})}
    parallel = {"shape": "parallel", "length": "10 mm", "film": "20 um"}
    entries = {"name": "pad", "kind": "bearing", "geometry": {**parallel, **geometry}, "lubricant": liquid}
    return read_scene({**entries, "motion": {"speed": speed}, **tables})


def test_kinks_of_the_wall_are_corners_and_smooth_ends_of_waves_are_not():
    assert pad_gap(pad({"shape": "linear", "rise": "5 um"})).corners == ()
    assert pad_gap(pad({"texture": TEXTURE})).corners == pytest.approx([1e-3, 2e-3, 4e-3, 5e-3])
    assert pad_gap(pad({"shape": "parabolic", "rise": "5 um", "count": 2})).corners == pytest.approx([5e-3])
    waves = {"shape": "squared_cosine_inlet", "amplitude": "5 um", "wavelength": "1 mm", "extent": "4.5 mm"}
    assert pad_gap(pad(waves)).corners == ()


def test_x_runs_along_the_motion_of_the_wall():
    forth, back = (pad_gap(pad({"texture": TEXTURE}, speed)) for speed in ("4 m/s", "-4 m/s"))
    assert back.breaks == pytest.approx([0, 5e-3, 6e-3, 8e-3, 9e-3, 10e-3])
    x = np.linspace(0, 10e-3, 101)
    assert back.thickness(x) == pytest.approx(forth.thickness(10e-3 - x))


@pytest.mark.parametrize(
    ("scene", "words"),
    [
        (lambda: pad({"texture": {**TEXTURE, "profile": "box"}}), "the wall has a step at x = 0.001 m"),
        (lambda: pad({"texture": {**TEXTURE, "profile": "box"}}, "-4 m/s"), "the wall has a step at x = 0.005 m"),
        (lambda: pad({"shape": "step", "rise": "5 um", "step": "2 mm"}), "the wall has a step at x = 0.002 m"),
        (lambda: pad({"width": "10 mm"}), "infinitely wide pads only"),
        (lambda: pad({}, "0 m/s"), "the wall does not slide"),
        (lambda: pad({}, load={"pressure": "1 MPa"}), r"sought under a load; give geometry\.film"),
        (lambda: pad({}, boundary={"inlet": {"theta": 0.5}}), "the inlet is starved"),
        (lambda: pad({}, lubricant={"compressibility": "dowson_higginson"}), "density changes with pressure"),
        (
            lambda: pad({}, roughness={"kind": "sinusoid", "amplitude": "1 um", "wavelength": "1 mm"}),
            "the wall is rough",
        ),
    ],
)
def test_reasons_for_which_inertia_is_not_resolved(scene, words):
    assert re.search(words, thin_film_obstacle(scene()) or "")


def test_inertia_needs_a_density():
    entries = {"viscosity": "10 mPa*s"}
    parallel = {"shape": "parallel", "length": "10 mm", "film": "20 um"}
    scene = read_scene(
        {"name": "pad", "kind": "bearing", "geometry": parallel, "lubricant": entries, "motion": {"speed": "4 m/s"}}
    )
    assert "lubricant.density" in (thin_film_obstacle(scene) or "")
