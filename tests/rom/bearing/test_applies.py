"""Whether a model applies to a bearing: cheap for every scene, and never an error."""

import pytest
from hypothesis import HealthCheck, given, settings
from random_scenes import bearings

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import models
from roughfilm.rom.bearing.equilibrium import expected
from roughfilm.rom.cavitation import solve
from roughfilm.rom.ladder.scene import read_scene

SLOW = list(HealthCheck)


@pytest.fixture
def no_film(monkeypatch):
    """Lets no film be solved."""

    def refuse(*_given, **_options):
        pytest.fail("a film was solved")

    monkeypatch.setattr(expected, "_expected", refuse)
    monkeypatch.setattr(solve, "on_grid", refuse)


@pytest.mark.usefixtures("no_film")
@settings(max_examples=60, deadline=None, suppress_health_check=SLOW)
@given(bearings())
def test_whether_a_model_applies_is_said_without_a_film(entries):
    try:
        scene = read_scene(entries)
    except InputError:
        return
    for model in models("bearing"):
        assert model.applies(scene).reason


@pytest.mark.usefixtures("no_film")
@pytest.mark.parametrize("load", ["1 N", "1 GN"])
def test_a_load_changes_no_answer_on_whether_a_model_applies(load):
    entries = {
        "name": "a pad",
        "kind": "bearing",
        "geometry": {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "20 um", "rise": "10 um"},
        "lubricant": {"viscosity": "5 mPa*s"},
        "motion": {"speed": "1 m/s"},
    }
    free, loaded = (read_scene(one) for one in (entries, entries | {"load": {"force": load}}))
    for model in models("bearing"):
        assert model.applies(loaded).applies == model.applies(free).applies
