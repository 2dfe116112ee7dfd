"""Advice on a bearing under a load: what is compared is the film, and no law of a given film is used."""

import pytest

from roughfilm.ladder import find, models
from roughfilm.rom.advice.advise import advise, wanted
from roughfilm.rom.ladder.kind import kind_of_scene
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

ENTRIES = {
    "name": "journal",
    "kind": "bearing",
    "geometry": {"shape": "journal", "radius": "25 mm", "clearance": "25 um", "width": "50 mm"},
    "lubricant": {"viscosity": "0.02 Pa*s"},
    "motion": {"speed": "2 m/s"},
    "load": {"force": "5 kN"},
}


def test_loaded_bearings_are_compared_by_their_film():
    scene = read_scene(ENTRIES)
    given = read_scene({name: entry for name, entry in ENTRIES.items() if name != "load"} | {"geometry": GIVEN})
    assert list(kind_of_scene(scene).compared) == ["film_min", "friction_per_width"]
    assert list(kind_of_scene(given).compared) == ["load_per_width", "friction_per_width"]
    assert (wanted(scene, None), wanted(given, None)) == ("film_min", "load_per_width")


GIVEN = ENTRIES["geometry"] | {"eccentricity": 0.6}


@pytest.mark.parametrize("within", [0.05, 0.005])
def test_advice_on_the_film_keeps_its_tolerance(within):
    scene = read_scene(ENTRIES)
    advice = advise(scene, models("bearing"), quantity="film_min", within=within)
    assert advice.chosen is not None
    assert all(one.a_priori is None for one in advice.considered if one.model != advice.chosen.model)
    truth = find("bearing", "reynolds_cavitating").solve(scene, Request(resolution=192)).quantities["film_min"].value
    assert advice.result is not None
    assert advice.result.quantities["film_min"].value == pytest.approx(truth, rel=within)
