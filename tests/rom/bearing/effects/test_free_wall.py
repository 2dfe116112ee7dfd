"""The effects of a bearing whose wall moves freely: at the place of the shaft, and under its load."""

import pytest

from roughfilm.ladder import find
from roughfilm.rom.bearing.effects.analysis import analyse_effects
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

GROOVED = {"shape": "lobes", "radius": "50 mm", "clearance": "50 um", "width": "50 mm", "lobes": 2, "arc": "160 deg"}
TABLES = {"lubricant": {"viscosity": "20 mPa*s", "density": "870 kg/m^3"}, "motion": {"speed": "3000 rpm"}}
CELLS = 48


def scene_of(geometry, **more):
    return read_scene({"name": "lobes", "kind": "bearing", "geometry": geometry, **TABLES, **more})


@pytest.fixture(scope="module")
def analysis():
    return analyse_effects(scene_of(GROOVED, load={"force": "5 kN"}), CELLS, ())


def test_the_film_under_the_load_is_that_of_the_model(analysis):
    model = find("bearing", "reynolds_cavitating").solve(analysis.scene, Request(resolution=CELLS))
    assert analysis.film == pytest.approx(model["film_min"].value, rel=1e-6)
    for study in (analysis.at_film, analysis.under_load):
        for name in ("load", "friction", "inlet_flow", "eccentricity_x", "eccentricity_y"):
            assert study.full[name].value == pytest.approx(model[name].value, rel=1e-6), name


def test_without_sides_and_cavitation_the_plain_film_is_an_infinitely_wide_one_at_the_same_place(analysis):
    place = [analysis.at_film.full[name].value for name in ("eccentricity_x", "eccentricity_y")]
    wide = {name: value for name, value in GROOVED.items() if name != "width"} | {"eccentricity": place}
    model = find("bearing", "reynolds").solve(scene_of(wide), Request(resolution=512))
    for name in ("load_per_width", "friction_per_width"):
        plain = analysis.at_film.plain[name]
        bar = plain.uncertainty + model[name].uncertainty
        assert plain.value == pytest.approx(model[name].value, abs=bar), name


def test_contributions_add_up_and_every_variant_carries_the_load(analysis):
    for name in ("friction", "film"):
        study = analysis.under_load
        total = study.plain[name].value + sum(one.on[name].value for one in study.contributions)
        assert total == pytest.approx(study.full[name].value, rel=1e-9)
    for one in analysis.under_load.contributions:
        assert one.after["load"].value == pytest.approx(5e3, rel=1e-7)
    assert not analysis.under_load.unsolved
    assert [one.name for one in analysis.under_load.contributions] == ["side flow", "cavitation"]


def test_a_full_bore_keeps_its_side_flow_and_inertia_is_left_out():
    bore = {name: value for name, value in GROOVED.items() if name not in ("lobes", "arc")}
    fed = {"boundary": {"sides": {"low": "1 bar", "high": "1 bar"}}}
    found = analyse_effects(scene_of(bore | {"eccentricity": [0.3, -0.4]}, **fed), 32, ())
    assert [one.name for one in found.at_film.contributions] == ["cavitation"]
    assert found.not_switched == {"side flow": "lubricant enters and leaves the film through its sides alone"}
    assert "side flow" not in found.left_out
    assert found.inertia is None
    assert "moves freely" in found.treated[-1].why


def test_asperities_and_roughness_are_switched_on_one_at_a_time(tips):
    geometry = {**GROOVED, "radius": "10 mm", "width": "10 mm", "clearance": "10 um"}
    scene = tips.scene(geometry, load={"force": "500 N"}, motion={"speed": "0.1 m/s"})
    found = analyse_effects(scene, 32, ())
    names = [one.name for one in found.under_load.contributions]
    assert names == ["side flow", "cavitation", "roughness", "asperities"]
    assert found.under_load.full["contact_share"].value > 0.05
    assert found.at_film.full["load"].value == pytest.approx(500, rel=1e-6)
    added = found.at_film.contributions[-1].on["load"]
    pressed = found.at_film.full["contact_load"].value
    assert added.value == pytest.approx(pressed, rel=0.2)
