"""The answer of a page in words."""

from dataclasses import replace

import pytest
from places import SCENES

from roughfilm.ladder import find, models
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.words.headline import asked, headline
from roughfilm.words.scales import scales_of


@pytest.fixture(scope="module")
def journal():
    scene = load_scene(SCENES / "journal.toml")
    return scene, find("bearing", "reynolds").solve(scene, Request(resolution=32))


def of(scene, result):
    return headline(scene, result, models("bearing"), scales_of([result]))


def test_a_film_under_a_load_is_the_answer_where_the_load_is_given():
    scene = load_scene(SCENES / "journal_under_load.toml")
    assert asked(find("bearing", "reynolds").solve(scene, Request(resolution=32))) == "film_min"


def test_the_line_names_the_model_its_uncertainty_and_what_it_leaves_out(journal):
    scene, result = journal
    found = of(scene, result)
    assert found.quantity == asked(result) == "load"
    assert found.value.endswith(" kN")
    assert "±" in found.value
    assert found.model.startswith("reynolds, ")
    assert found.sure.startswith("± is the numerical uncertainty, ")
    assert found.left_out.startswith("cavitation and pressure dependence; inertia, heat and deformation")


def test_an_unknown_uncertainty_is_said_to_be_unknown(journal):
    scene, result = journal
    quantities = {name: replace(one, uncertainty=None) for name, one in result.quantities.items()}
    found = of(scene, replace(result, quantities=quantities))
    assert found.value.rsplit(" ", 1)[0].endswith("± ?")
    assert "uncertainty is unknown" in found.sure
