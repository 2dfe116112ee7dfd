"""The table of the quantities of a result: what stands first, in words, in 80 columns."""

import io
import re

import pytest
from places import SCENES
from rich.console import Console

import roughfilm as rf
from roughfilm.rom.ladder.kind import kind_of, kind_of_name
from roughfilm.terminal.results import quantity_table

CASES = {
    "journal": ("reynolds_cavitating", 32),
    "washer": ("reynolds_cavitating", 32),
    "parabolic_slider": ("reynolds_cavitating", 256),
    "pocket": ("reynolds", None),
    "dimple": ("reynolds_cavitating", 16),
    "dry_contact": ("persson", None),
    "seal": ("effective_medium", None),
    "rough_gap": ("smooth_gap", None),
}


def solved(name, **changes):
    model, resolution = CASES[name]
    return rf.solve(rf.load_scene(SCENES / f"{name}.toml", set=changes), model=model, resolution=resolution)


def printed(result, width=80):
    file = io.StringIO()
    Console(file=file, width=width).print(quantity_table(result))
    return file.getvalue()


def titles(result):
    lines = printed(result).splitlines()
    below = lines[next(number for number, line in enumerate(lines) if "──" in line) + 1 :]
    return [line.split("  ")[0].strip() for line in below][: len(kind_of(result).listed(result))]


@pytest.mark.parametrize("name", CASES)
def test_a_table_fits_80_columns_without_cutting_names(name):
    result = solved(name)
    text = printed(result)
    assert max(map(len, text.splitlines())) <= 80
    assert "…" not in text
    assert titles(result) == list(kind_of(result).listed(result).values())


@pytest.mark.parametrize("name", CASES)
def test_every_quantity_has_a_title_in_words(name):
    result = solved(name)
    assert set(result.quantities) <= set(kind_of(result).reported)
    assert not [title for title in titles(result) if "_" in title]


@pytest.mark.parametrize("kind", ["bearing", "pocket", "dry_contact", "seal", "rough_gap"])
def test_the_compared_quantities_have_a_title(kind):
    assert set(kind_of_name(kind).titles) <= set(kind_of_name(kind).reported)


def test_the_quantities_that_are_sought_most_stand_first():
    assert titles(solved("journal"))[:6] == ["load", "least film thickness", "friction coefficient", "power loss", "peak pressure", "flow in"]  # fmt: skip  # noqa: E501
    assert titles(solved("seal"))[0] == "leakage per width"
    assert titles(solved("pocket"))[0] == "load per area"


def test_a_bearing_with_a_width_shows_nothing_per_width():
    assert not [title for title in titles(solved("journal")) if "per width" in title]
    assert titles(solved("parabolic_slider"))[0] == "load per width"


def test_under_a_load_the_film_stands_first():
    scene = rf.load_scene(SCENES / "journal.toml", set={"load.force": "2 kN"})
    loaded = rf.solve(scene, model="reynolds_cavitating", resolution=32)
    assert titles(loaded)[:2] == ["least film thickness", "load"]


def test_a_cell_of_a_washer_says_of_how_many_it_is_one_and_what_the_whole_carries():
    result = solved("washer")
    whole = 30 * result["load"].value / 1e3
    below = printed(result).splitlines()[-1].strip()
    assert below == f"one of 30 equal pieces; the whole bearing carries {whole:.4g} kN"


def test_a_pad_without_the_number_of_pads_says_that_it_is_one():
    ring = {"inner_radius": "20 mm", "outer_radius": "40 mm", "film": "20 um", "rise": "20 um", "angle": "45 deg"}
    entries = {
        "name": "thrust",
        "kind": "bearing",
        "geometry": {"shape": "sector", **ring},
        "lubricant": {"viscosity": "0.02 Pa*s"},
        "motion": {"speed": "3 m/s"},
    }
    one = rf.solve(rf.read_scene(entries), model="reynolds", resolution=16)
    assert "geometry.pads" in printed(one)
    entries["geometry"]["pads"] = 8
    assert "one of 8 equal pieces" in printed(rf.solve(rf.read_scene(entries), model="reynolds", resolution=16))


def test_an_exact_place_is_exact_and_no_uncertainty_is_written_as_zero():
    text = printed(solved("journal"))
    row = next(line for line in text.splitlines() if "least film thickness" in line)
    assert row.split()[-3:] == ["15", "exact", "µm"]
    assert "e+00" not in text


def test_a_result_without_uncertainties_says_so():
    text = printed(rf.solve(rf.load_scene(SCENES / "pocket.toml"), model="inertial_reynolds"))
    assert "±" not in text
    assert "uncertainties: unknown" in text


def test_a_seal_of_known_width_leaks_over_the_whole_width():
    ring = solved("seal", **{"flow.width": "0.25 m"})
    whole, per_width = ring.quantities["leakage"], ring.quantities["leakage_per_width"]
    assert (whole.value, whole.unit) == (pytest.approx(0.25 * per_width.value), "kg/s")
    assert whole.uncertainty == pytest.approx(0.25 * per_width.uncertainty)
    assert titles(ring)[0] == "leakage, whole seal"


def test_a_cell_in_plan_names_the_place_where_its_pressure_is_zero():
    text = " ".join(printed(solved("dimple")).split())
    assert "pressures count from their mean over the edges x = ±L/2 of the cell on the sliding wall" in text
    assert "pressures count" not in printed(solved("pocket"))


def test_a_load_that_is_round_off_is_written_as_zero():
    """A symmetric dimple carries nothing without inertia."""
    result = rf.solve(rf.load_scene(SCENES / "dimple.toml"), model="reynolds", resolution=16)
    assert result["load_per_area"].value == 0
    assert 0 < result["load_per_area"].uncertainty < 1e-6 * result["friction_per_area"].value
    assert re.search(r"^load per area +0 ", printed(result), flags=re.MULTILINE)
