"""The film with inertia and cavitation in its limits, and how the errors that it judges are drawn."""

import numpy as np
import pytest
from places import SCENES

from roughfilm.ladder import find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.pocket.scene import Pocket
from scripts.studies.coverage.rupture import SUM, both, judgements, ruptured_scene

CELLS = 256


def groove(*overrides):
    return load_scene(SCENES / "pocket.toml", overrides)


def by(model, scene, **request):
    return find("pocket", model).solve(scene, Request(**request))


def test_without_cavitation_it_is_inertia_to_first_order():
    scene = groove("boundary.ambient_pressure=2MPa")
    found, exact = both(scene, CELLS), by("inertial_reynolds", scene)
    for name, value in found.items():
        assert value == pytest.approx(exact[name].value, rel=5e-3)


def test_without_inertia_it_is_the_film_that_cavitates():
    scene = groove("motion.reynolds_number=1e-6", "boundary.ambient_pressure=1e-4Pa")
    found, exact = both(scene, CELLS), by("reynolds_cavitating", scene, resolution=CELLS)
    assert exact["cavitated_fraction"].value > 0.05
    for name, value in found.items():
        assert value == pytest.approx(exact[name].value, rel=1e-5)


def test_the_ambient_pressure_makes_the_film_rupture_and_the_errors_are_positive():
    scene = ruptured_scene(20_003)
    assert isinstance(scene, Pocket)
    assert any("ruptures" in warning for warning in by("inertial_reynolds", scene).warnings)
    found = list(judgements(scene))
    assert len(found) == 9
    assert all(one.relative >= 0 for one in found)
    assert all(np.isnan(one.ratio) == (one.model == SUM) for one in found)
