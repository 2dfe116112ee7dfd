"""The temperature of the lubricant that leaves a film."""

import pytest

import roughfilm as rf

ALONG = {"kind": "sinusoid", "amplitude": "1 um", "wavelength": "1 mm", "direction": "90 deg"}


@pytest.mark.parametrize("roughness", [None, ALONG], ids=["smooth", "ridges along"])
def test_insulated_walls_leave_the_outlet_as_warm_with_and_without_a_profile_across(roughness):
    entries = {
        "name": "pad",
        "kind": "bearing",
        "geometry": {"shape": "linear", "length": "40 mm", "width": "40 mm", "rise": "10 um", "film": "5 um"},
        "lubricant": {"oil": "ISO VG 32", "temperature": "45 degC"},
        "motion": {"speed": "10 m/s"},
    }
    scene = rf.read_scene(entries | ({"roughness": roughness} if roughness else {}))
    mean, across = (rf.solve(scene, model=model, resolution=12) for model in ("adiabatic", "across"))
    assert across["outlet_temperature"].value > 80
    assert across["outlet_temperature"].value == pytest.approx(mean["outlet_temperature"].value, abs=0.5)
