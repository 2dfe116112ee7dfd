"""Scenes with a temperature that the models over the film do not take."""

import pytest

from roughfilm.ladder import find
from roughfilm.rom.ladder.scene import read_scene

GROOVE = {"kind": "pocket", "x": "10 mm", "length": "4 mm", "extent": "4 mm", "depth": "1 mm", "pressure": "1 MPa"}
WARM = {"fixed_wall": {"kind": "temperature", "temperature": "45 degC"}}


def applies(model, *, speed="0 m/s", approach="1 mm/s", **tables):
    entries = {
        "name": "squeezed",
        "kind": "bearing",
        "geometry": {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "20 um", "rise": "1 um"},
        "lubricant": {"oil": "ISO VG 46", "temperature": "40 degC"},
        "motion": {"speed": speed, "approach": approach},
    }
    return find("bearing", model).applies(read_scene(entries | tables))


@pytest.mark.parametrize("model", ["adiabatic", "across"])
def test_walls_that_only_approach_and_take_no_heat_have_no_steady_field(model):
    """What flows to all sides leaves a place at which it stays: nothing takes the heat of that place away."""
    refused = applies(model)
    assert not refused.applies
    assert "no steady temperature" in refused.reason
    for case in ({"speed": "1 m/s"}, {"supply": [GROOVE]}, {"boundary": {"sides": {"low": "1 MPa"}}}):
        assert applies(model, **case).applies, case
    assert applies("across", heat=WARM).applies
    assert applies("heat_balance").applies
