"""Boundary friction over temperature: a table, and the friction of a mixed film at the temperature of its lubricant."""

import numpy as np
import pytest

import roughfilm as rf
from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.asperity_contact import BoundaryFriction
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene, scene_entries

ROWS = [["20 degC", 0.12], ["60 degC", 0.1], ["120 degC", 0.04]]
PARALLEL = {"shape": "parallel", "length": "20 mm", "width": "10 mm", "film": "1 um"}


def at(tips, friction, temperature="20 degC"):
    return tips.scene(
        PARALLEL,
        asperities={"friction": friction},
        lubricant={"viscosity": "0.1 Pa*s", "temperature": temperature},
        motion={"speed": "0 m/s"},
    )


def test_a_table_passes_through_its_rows_and_falls_between_them():
    friction = BoundaryFriction.model_validate({"table": ROWS})
    assert [friction.at(273.15 + row) for row in (20, 60, 120)] == pytest.approx([0.12, 0.1, 0.04])
    over = friction.at(np.linspace(293.15, 393.15, 101))
    assert np.all(np.diff(over) < 0)
    assert over.shape == (101,)


def test_a_number_is_the_same_at_all_temperatures_and_needs_none():
    friction = BoundaryFriction(constant=0.13)
    assert friction.at(None) == friction.at(500.0) == 0.13
    assert friction.at(np.array([[300.0, 500.0]])).tolist() == [[0.13, 0.13]]


def test_a_film_has_the_friction_at_the_temperature_of_its_lubricant(tips):
    mixed = find("bearing", "mixed")
    constant = mixed.solve(at(tips, 0.1), Request(resolution=8))
    for scene in (
        at(tips, {"table": ROWS}, "60 degC"),
        rf.replace(at(tips, 0.3), "asperities.friction", {"table": ROWS}),
    ):
        own = mixed.solve(scene, Request(resolution=8))
        expected = 0.1 if scene.lubricant.temperature > 300 else 0.12
        assert own["friction"].value == pytest.approx(expected / 0.1 * constant["friction"].value, rel=1e-12)


@pytest.mark.parametrize("friction", [0.13, {"table": ROWS}])
def test_a_scene_is_read_back_from_its_entries(tips, friction):
    scene = at(tips, friction)
    assert read_scene(scene_entries(scene)) == scene
    assert isinstance(scene_entries(scene)["asperities"]["friction"], type(friction))


def test_a_table_can_be_replaced_by_a_number(tips):
    scene = rf.replace(at(tips, {"table": ROWS}), "asperities.friction", 0.2)
    assert scene.boundary_friction == 0.2


@pytest.mark.parametrize(
    ("friction", "temperature", "words"),
    [
        ({"table": ROWS}, "130 degC", r"asperities\.friction: got 130 °C; its table is from 20 °C to 120 °C"),
        ({"table": ROWS[:1]}, "20 degC", r"asperities\.friction\.table: "),
        ({"table": ROWS[::-1]}, "20 degC", r"asperities\.friction\.table: got 60 °C at row 2 after 120 °C"),
        ({"table": [["20 degC", 11], *ROWS[1:]]}, "20 degC", r"asperities\.friction\.table\.0\.1: got 11\.0; it must"),
        ({}, "20 degC", r"asperities\.friction: give a number, such as 0\.1, or a table"),
        ({"tabel": ROWS}, "20 degC", r"asperities\.friction\.tabel: unknown key; did you mean 'table'"),
        ({"table": "rows.csv"}, "20 degC", r"asperities\.friction\.table: "),
        ("slippery", "20 degC", r"asperities\.friction: got 'slippery'"),
    ],
)
def test_each_error_is_one_line(tips, friction, temperature, words):
    with pytest.raises(InputError, match=words) as caught:
        at(tips, friction, temperature)
    assert "\n" not in str(caught.value)


def test_a_table_needs_the_temperature_of_the_lubricant(tips):
    with pytest.raises(InputError, match=r"lubricant\.temperature: missing; a table of asperities\.friction needs it"):
        tips.scene(PARALLEL, asperities={"friction": {"table": ROWS}})
