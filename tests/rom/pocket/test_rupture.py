"""A pocket says where its film would rupture, and no advice is given on it as if it did not."""

import pytest

from roughfilm import rom
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import models
from roughfilm.rom.advice.advise import advise, shortfall
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.rom.ladder.model import ladder
from roughfilm.rom.ladder.scene import read_scene, scene_entries

MODELS = ladder(rom, kind="pocket")


def ruptured(speed="50 m/s", lubricant=(), **tables):
    """A film whose lowest pressure is 641 kPa below ambient by an independent solution."""
    return read_scene(
        {
            "name": "ruptured",
            "kind": "pocket",
            "geometry": {"length": "2 mm", "film": "20 um", "width": "0.8 mm", "depth": "15 um"},
            "lubricant": {"viscosity": "0.02 Pa*s", "density": "870 kg/m^3", **dict(lubricant)},
            "motion": {"speed": speed},
            **tables,
        }
    )


def warnings_of(model, scene):
    return [warning for warning in model.solve(scene).warnings if warning.startswith("pressure: falls")]


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_every_model_tells_the_lowest_pressure_below_that_of_cavitation(model):
    (warning,) = warnings_of(model, ruptured())
    lowest = float(warning.split()[3])
    assert lowest == pytest.approx(-641, rel=0.02)
    assert "cavitation pressure of -101.3 kPa (ambient pressure 101.3 kPa)" in warning
    assert not warnings_of(model, ruptured("5 m/s"))


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_the_ambient_pressure_and_the_liquid_decide(model):
    assert not warnings_of(model, ruptured(boundary={"ambient_pressure": "0.7 MPa"}))
    slow = ruptured("5 m/s", [("cavitation_pressure", "-20 kPa")])
    assert "cavitation pressure of -20 kPa" in warnings_of(model, slow)[0]


@pytest.mark.parametrize("pressure", ["2 kPa", "-102 kPa"])
def test_a_cavitation_pressure_above_ambient_or_below_vacuum_is_refused(pressure):
    with pytest.raises(InputError, match=r"lubricant\.cavitation_pressure: got .* it counts from ambient and must be"):
        ruptured(lubricant=[("cavitation_pressure", pressure)])


def test_the_default_is_written_into_the_scene():
    scene = ruptured()
    assert scene_entries(scene)["boundary"] == {"ambient_pressure": "101325.0 Pa"}
    assert scene.cavitation_pressure == -101325.0
    assert read_scene(scene_entries(scene)) == scene


@pytest.mark.parametrize("quantity", ["load_plus", "friction_plus"])
def test_a_torn_film_has_no_advice(quantity):
    found = advise(ruptured(), models("pocket"), quantity=quantity, within=0.1)
    assert found.chosen is None
    assert "no model of a pocket includes" in shortfall(found)


def test_the_omitted_part_falls_to_nothing_where_the_film_just_stays_whole():
    """By the bound of 8 times what the lowest pressure lies below the cavitation pressure, over the load."""
    film = next(model for model in MODELS if model.name == "film").solve(ruptured())
    load, lowest = film["load"].value, -641.5e3
    omitted = kind_of_name("pocket").omitted
    parts = [
        omitted(ruptured(boundary={"ambient_pressure": f"{-lowest - missing!r} Pa"}), "load_plus")
        for missing in (4e4, 2e4)
    ]
    assert [part.part for part in parts] == pytest.approx([8 * 4e4 / load, 8 * 2e4 / load], rel=0.05)
    assert omitted(ruptured(boundary={"ambient_pressure": "645 kPa"}), "load_plus") is None
    assert omitted(ruptured(), "backflow").part == float("inf")
