"""What models of a wide pad leave out, and which of them is the reference: inertia against cavitation."""

import pytest

from roughfilm import replace
from roughfilm.ladder import find, models
from roughfilm.rom.bearing.kind import KIND
from roughfilm.rom.bearing.models.film import MODEL as FILM
from roughfilm.rom.ladder.model import best_for
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

LOAD = "load_per_width"
NAMES = ("reynolds", "reynolds_incompressible", "reynolds_cavitating", "film", "film_slope", "navier_stokes")
HERE = [find("bearing", name) for name in NAMES]


def omissions(scene):
    """What each model leaves out of the load, by name."""
    return {model.name: KIND.omitted(scene, model, LOAD) for model in HERE}


def pad(**lubricant):
    texture = {"length": "0.5 mm", "depth": "30 um", "start": "0.25 mm", "pitch": "1 mm", "columns": 3}
    return read_scene(
        {
            "name": "pad",
            "kind": "bearing",
            "geometry": {"shape": "linear", "length": "6 mm", "film": "30 um", "rise": "30 um", "texture": texture},
            "lubricant": {"viscosity": "10 mPa*s", "density": "900 kg/m^3", **lubricant},
            "motion": {"speed": "40 m/s"},
        }
    )


@pytest.fixture(scope="module")
def whole():
    """A pad whose film stays whole."""
    return pad(cavitation_pressure="-1 GPa")


@pytest.fixture(scope="module")
def ruptured():
    """The same pad in a liquid that bears no tension, sliding backwards, so that it diverges."""
    return replace(pad(), "motion.speed", "-40 m/s")


def test_the_reference_is_the_model_that_misses_least(whole, ruptured):
    assert best_for(whole, HERE).name == "navier_stokes"
    assert best_for(whole, HERE[:-1]).name == "film_slope"
    assert best_for(ruptured, HERE).name == "reynolds_cavitating"


def test_inertia_is_what_reynolds_leaves_out_and_slope_what_the_film_does(whole):
    omitted = omissions(whole)
    film, reynolds = (find("bearing", name).solve(whole)[LOAD].value for name in ("film", "reynolds"))
    for name in NAMES[:3]:
        assert omitted[name].part == pytest.approx(abs(film - reynolds) / film, rel=0.05)
        assert "inertia, which film and film_slope include, changes the load" in omitted[name].reason
    assert omitted["film"].reason.startswith("slope to second order changes the load by about")
    assert omitted["film_slope"].reason.startswith("slope beyond the second order changes the load at most by")
    assert omitted["film"].part == omitted["film_slope"].part < omitted["reynolds"].part
    assert omitted["navier_stokes"] is None


def test_cavitation_is_what_models_with_inertia_leave_out_where_the_film_ruptures(ruptured):
    omitted = omissions(ruptured)
    assert all("the film ruptures, and cavitation changes the load" in omitted[name].reason for name in NAMES[3:])
    assert omitted["navier_stokes"].part > 1
    assert omitted["reynolds_cavitating"].part < omitted["navier_stokes"].part
    result = FILM.solve(ruptured, Request(resolution=100))
    assert any("kPa below the cavitation pressure: the film ruptures" in warning for warning in result.warnings)


def test_the_creeping_pad_keeps_its_ram_pressure():
    scene = replace(pad(cavitation_pressure="-1 GPa"), "boundary.inlet", {"ram_factor": 1.0})
    still = replace(pad(cavitation_pressure="-1 GPa"), "boundary.inlet", {"pressure": f"{900 * 40**2 / 2} Pa"})
    one, other = (KIND.omitted(case, find("bearing", "reynolds"), LOAD).part for case in (scene, still))
    assert one == pytest.approx(other, rel=1e-6)


def test_models_of_other_bearings_are_ranked_by_their_effects():
    scene = replace(pad(), "geometry.width", "10 mm")
    applying = [model for model in models("bearing") if model.applies(scene).applies]
    assert best_for(scene, applying).name == "reynolds_cavitating"
