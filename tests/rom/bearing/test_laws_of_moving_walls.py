"""The error laws of walls that move freely: which laws a scene has, and the advice on the templates."""

import pytest

from roughfilm.ladder import find, models
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.advice.laws import lawful, table
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.ladder.kind import kind_of_scene
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

BORE = {"shape": "lobes", "radius": "50 mm", "width": "50 mm", "clearance": "100 um"}
LEMON = {**BORE, "lobes": 2, "arc": "160 deg", "preload": 0.5}
TILTING = {**BORE, "lobes": 4, "arc": "80 deg", "first": "-45 deg", "preload": 0.3, "pivot": 0.5}
PAD = {"shape": "pivoted", "length": "40 mm", "width": "40 mm", "pivot": [0.6, 0.5]}


def scene(geometry, **tables):
    """A bearing at 30 m/s, under 2 MPa unless its place is given."""
    given = {"geometry": geometry, "lubricant": {"viscosity": "20 mPa*s"}, "motion": {"speed": "30 m/s"}, **tables}
    placed = "eccentricity" in geometry or "film" in geometry
    return read_scene(
        {"name": "law", "kind": "bearing", **given, **({} if placed else {"load": {"pressure": "1 MPa"}})}
    )


def test_a_place_under_a_load_and_a_given_one_have_laws_of_their_own():
    free, placed = scene(LEMON), scene({**LEMON, "eccentricity": [0.1, -0.2]})
    assert [kind_of_scene(one).name_of_laws for one in (free, placed)] == ["free_bearing", "placed_bearing"]
    assert next(iter(kind_of_scene(free).compared)) == "film_min"
    assert next(iter(kind_of_scene(placed).compared)) == "load_per_width"
    assert all(kind_of_scene(one).lawful for one in (free, placed))
    journal = {"shape": "journal", "radius": "50 mm", "width": "50 mm", "clearance": "100 um"}
    assert kind_of_scene(scene({**journal, "eccentricity": 0.5})).name_of_laws == "bearing"
    assert not kind_of_scene(
        scene(journal, lubricant={"viscosity": "20 mPa*s", "cavitation_pressure": "-1 kPa"})
    ).lawful


def test_the_grids_of_models_with_temperature_have_the_laws_of_given_films_that_heat():
    """Not those of walls that move freely, nor under a load."""
    placed, free = scene({**LEMON, "eccentricity": [0.1, -0.2]}), scene(LEMON)
    journal = kind_of_scene(scene({"shape": "journal", "radius": "50 mm", "clearance": "100 um", "eccentricity": 0.5}))
    models = ("reynolds_cavitating", "heat_balance", "adiabatic", "across")
    assert [journal.laws_of_grids(model) for model in models] == ["bearing", *["heated_bearing"] * 3]
    assert journal.names_of_laws == ("bearing", "heated_bearing", "hot_wedge")
    assert [kind_of_scene(one).laws_of_grids("across") for one in (placed, free)] == ["placed_bearing", "free_bearing"]
    without = lawful(table(), journal.names_of_laws, holds=False)
    assert not {grid.kind for grid in without.grids} & {"bearing", "heated_bearing"}


def test_suction_is_that_of_a_film_that_widens_over_that_and_the_ambient_pressure():
    oil = {"viscosity": "20 mPa*s", "cavitation_pressure": "-0.1 MPa"}
    pad = {**PAD, "film": "20 um", "slopes": ["-0.5 mrad", "0 rad"]}
    assert bearing_numbers(scene(pad, lubricant=oil))["suction"] == 0
    at_ambient = bearing_numbers(scene({**LEMON, "eccentricity": [0.1, -0.2]}))
    below = bearing_numbers(scene({**LEMON, "eccentricity": [0.1, -0.2]}, lubricant=oil))
    assert at_ambient["suction"] == 1
    assert below["suction"] == pytest.approx(below["divergence"] / (below["divergence"] + below["cavitation_number"]))
    assert below["piece_slenderness"] == pytest.approx(0.05 / (0.05 * 160 / 180 * 3.14159265))


@pytest.mark.parametrize("geometry", [LEMON, TILTING, PAD])
def test_the_chosen_model_is_the_cheapest_within_the_tolerance_and_its_error_is_stated(geometry):
    bearing = scene(geometry)
    advice = advise(bearing, models("bearing"), quantity="film_min", within=0.05)
    by_model = {one.model: one for one in advice.considered if one.resolution is not None}
    assert {"infinitely_wide", "reynolds", "reynolds_incompressible", "reynolds_cavitating"} <= by_model.keys()
    assert by_model["infinitely_wide"].estimate is not None
    assert by_model["reynolds_incompressible"].stated is not None
    chosen = advice.chosen
    assert chosen is not None
    assert chosen.error <= 0.05
    fine = find("bearing", "reynolds_cavitating").solve(bearing, Request(resolution=128))
    own = find("bearing", chosen.model).solve(bearing, Request(resolution=chosen.resolution))
    true = fine["film_min"].value
    assert abs(own["film_min"].value / true - 1) <= chosen.error


def test_the_table_has_laws_for_both():
    fitted = {(step.kind, step.model) for step in table().steps if "friction_per_width" in step.left_out}
    for kind in ("free_bearing", "placed_bearing"):
        assert {(kind, name) for name in ("infinitely_wide", "reynolds", "reynolds_incompressible")} <= fitted
