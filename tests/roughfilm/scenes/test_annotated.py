"""An annotated scene loads and is solved as it stands, and shows every key of its kind."""

import re
import tomllib

import pytest
from typer.testing import CliRunner

import roughfilm as rf
from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.kind import kind_names
from roughfilm.rom.pocket.plan.dimples import SHAPES
from roughfilm.scenes.annotated import annotated_scene, variants

MODELS = {
    "pocket": "film",
    "bearing": "reynolds_incompressible",
    "dry_contact": "persson",
    "seal": "effective_medium",
    "rough_gap": "slope_corrected",
}
"""A cheap model of each kind that computes something."""

ALL = [(kind, variant) for kind, known in variants().items() for variant in known]


def test_every_kind_has_annotated_scenes():
    assert set(variants()) == set(kind_names())


@pytest.mark.parametrize(("kind", "variant"), ALL)
def test_it_loads_and_is_solved_as_it_stands(tmp_path, kind, variant):
    path = tmp_path / "scene.toml"
    path.write_text(annotated_scene(kind, variant), encoding="utf-8")
    model = "reynolds" if variant == "dimple" else MODELS[kind]
    result = rf.solve(rf.load_scene(path), model=model)
    assert all(abs(one.value) < float("inf") for one in result.quantities.values())


@pytest.mark.parametrize(("kind", "variant"), ALL)
def test_every_comment_fits_and_every_key_in_one_is_toml(kind, variant):
    for line in annotated_scene(kind, variant).splitlines():
        assert len(line) <= 120, line
        if re.match(r"# \w+ = ", line):
            tomllib.loads(line[2:])


def test_it_shows_the_keys_that_may_be_left_out_with_unit_and_meaning():
    text = annotated_scene("bearing")
    for shown in (
        'radius = "25 mm"                # radius of the shaft, m',
        "# [load]",
        "# theta = 0.8                   # density ratio at the inlet",
        "# friction = 0.1                # coefficient of boundary friction where asperities touch; default",
        '# law = "roelands"',
        "# [geometry.texture]",
    ):
        assert shown in text
    assert "digest" not in text


def test_a_key_in_a_comment_may_be_written(tmp_path):
    text = annotated_scene("bearing", "linear")
    path = tmp_path / "scene.toml"
    path.write_text(text.replace('# density = "870', 'density = "870', 1), encoding="utf-8")
    assert rf.load_scene(path).lubricant.density == 870


def forms(place):
    """The forms of a table that the annotated bearing shows as comments, as entries; alternatives are left out."""
    blocks = annotated_scene("bearing").split("\n\n")
    for block in (one for one in blocks if one.startswith(f"# [{place}]")):
        keys = [line[2:] for line in block.splitlines() if re.match(r"# \w+ = ", line)]
        given = tomllib.loads("\n".join(keys))
        yield {key: value for key, value in given.items() if key not in ("points", "table", "relaxation_time")}


@pytest.mark.parametrize("place", ["lubricant.heat_capacity", "lubricant.shear_thinning", "heat"])
@pytest.mark.parametrize("wall", ["heat.fixed_wall", "heat.sliding_wall"])
def test_tables_of_temperature_in_comments_may_be_written(place, wall):
    shape = tomllib.loads(annotated_scene("bearing", "linear"))
    shape["lubricant"] = {"oil": "ISO VG 46", "temperature": "40 degC"}
    for table in (place, wall):
        for entries in forms(table):
            first, *inner = table.split(".")
            added = {inner[0]: entries} if inner else entries
            read = rf.read_scene(shape | {first: shape.get(first, {}) | added})
            assert str(entries.get("kind", entries.get("law", ""))) in str(read)


@pytest.mark.parametrize(
    ("kind", "variant", "words"),
    [
        ("gearbox", None, "KIND: got 'gearbox'; it must be one of pocket"),
        ("bearing", "oval", "got 'bearing/oval'; .*wash"),
    ],
)
def test_other_names_are_refused(kind, variant, words):
    with pytest.raises(InputError, match=words):
        annotated_scene(kind, variant)


def test_the_command_prints_a_scene_or_the_list_of_them():
    run = CliRunner().invoke
    assert run(app, ["new", "bearing/washer"]).stdout == annotated_scene("bearing", "washer")
    assert run(app, ["new", "seal"]).stdout == annotated_scene("seal")
    listed = run(app, ["new"]).stdout
    assert all(f"{kind}/{variant}" in listed for kind, variant in ALL)
    assert run(app, ["new", "oval"]).exit_code == 2


def test_a_cell_in_plan_shows_the_keys_of_every_shape_of_a_dimple():
    text = annotated_scene("pocket", "dimple")
    shapes = re.findall(r'^(# )?shape = "(\w+)"', text, flags=re.MULTILINE)
    assert shapes[0] == ("", "spherical")
    assert {name for _, name in shapes} == {*SHAPES}
    assert text.count("[[geometry.dimples]]") == len(SHAPES)
    assert '# width = "0.3 mm"' in text  # that of the dimple above, so that the comment may be written


def test_a_bearing_shows_the_forms_of_a_supply():
    fed, others = annotated_scene("bearing", "hydrostatic"), annotated_scene("bearing", "linear")
    assert re.findall(r"^(# )?\[\[supply\]\]", fed, flags=re.MULTILINE) == ["", "# ", "# "]
    assert others.count("# [[supply]]") == 3
    assert '# flow = "1 l/min"' in others
