"""The cost of an answer counts what its expected errors cost, apart from the solution."""

from roughfilm.interface.solving import solve
from roughfilm.rom.ladder.scene import read_scene


def test_the_films_that_show_the_errors_of_a_model_are_counted():
    oil = {"oil": "ISO VG 46", "temperature": "40 degC"}
    entries = {
        "name": "pad",
        "kind": "bearing",
        "geometry": {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "20 um", "rise": "20 um"},
        "lubricant": oil,
        "motion": {"speed": "7 m/s"},
    }
    result = solve(read_scene(entries), model="reynolds_cavitating", resolution=12)
    assert result.numerics.one_time["errors"] > 0
