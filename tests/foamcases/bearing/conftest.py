"""Scenes of infinitely wide pads."""

import pytest

from roughfilm.rom.ladder.scene import read_scene


@pytest.fixture(scope="session")
def pad():
    """Make a pad of 1 mm with a film of 30 µm."""

    def make(speed="5 m/s", *, inlet=None, texture=None, lubricant=None, **geometry):
        shape = {"shape": "parallel", "length": "1 mm", "film": "30 um", **geometry}
        if texture is not None:
            shape["texture"] = texture
        entries = {
            "name": "pad",
            "kind": "bearing",
            "geometry": shape,
            "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3", **(lubricant or {})},
            "motion": {"speed": speed},
        }
        return read_scene(entries if inlet is None else {**entries, "boundary": {"inlet": inlet}})

    return make
