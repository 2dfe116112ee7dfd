"""A recipe says every step, is read back as it was written, and names its faults."""

import pytest
from places import SURFACES

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.recipe import Recipe, load_recipe, read_recipe, recipe_entries

FULL = """
form = "tilt"
s_filter = "2.5 um"
l_filter = "0.25 mm"
smoothing = 5
[read]
channel = "Raw"
spacing = ["1.5 um", "2 um"]
height_unit = "nm"
[outliers]
quantile = 0.002
[window]
size = ["0.8 mm", "600 um"]
start = ["0 um", "10 um"]
[grid]
points = [640, 480]
[edges]
direction = "x"
width = "12 um"
"""


def test_a_full_recipe_is_read_in_si_units_and_written_back(tmp_path):
    (tmp_path / "r.toml").write_text(FULL)
    recipe = load_recipe(tmp_path / "r.toml")
    assert recipe.window is not None
    assert recipe.window.size == (8e-4, 6e-4)
    assert recipe.window.start == (0.0, 1e-5)
    assert recipe.read.spacing == (1.5e-6, 2e-6)
    assert recipe.grid.points == (640, 480)
    assert recipe.edges.width == 12e-6
    assert (recipe.s_filter, recipe.l_filter) == (2.5e-6, 2.5e-4)
    assert read_recipe(recipe_entries(recipe)) == recipe


@pytest.mark.parametrize("given", ["1 um", "1um,1um", '["1 um"]', '["1 um", "1 um"]'])
def test_one_length_stands_for_both_directions(given):
    assert load_recipe(None, [f"read.spacing={given}"]).read.spacing == (1e-6, 1e-6)


def test_without_a_file_no_height_is_clipped_and_the_pixels_are_kept():
    recipe = load_recipe()
    assert recipe == Recipe()
    assert (recipe.outliers.quantile, recipe.smoothing) == (0.0, 3)
    assert recipe.grid.points == "kept"


def test_the_recipe_beside_the_scenes_is_the_usual_one():
    assert load_recipe(SURFACES / "recipe.toml") == Recipe()


def test_overrides_reach_every_table():
    recipe = load_recipe(
        None, ["smoothing=1", "edges.direction=y", 'window.size=["1 mm", "2 mm"]', "grid.points=[64, 32]"]
    )
    assert (recipe.smoothing, recipe.edges.direction, recipe.grid.points) == (1, "y", (64, 32))
    assert recipe.window is not None
    assert recipe.window.size == (1e-3, 2e-3)


def test_an_s_filter_takes_the_place_of_the_moving_average():
    assert load_recipe(None, ["s_filter=2 um"]).smoothing == 1
    assert load_recipe(None, ["l_filter=2 um"]).smoothing == 3
    assert load_recipe(None, ["s_filter=2 um", "smoothing=5"]).smoothing == 5


def test_an_l_filter_below_the_s_filter_is_refused():
    with pytest.raises(InputError, match=r"^recipe: got l_filter 2 um and s_filter 3 um; .* the larger nesting index$"):
        load_recipe(None, ["s_filter=3 um", "l_filter=2 um"])


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("edges.direction=q", r"^recipe\.edges\.direction: got 'q'; it must be 'x', 'y', 'both', 'none' or 'auto'$"),
        ("grid.points=5", r"^recipe\.grid\.points: got 5; write a list in brackets$"),
        ("forn=tilt", r"^recipe\.forn: unknown key; did you mean 'form'\?"),
        ("edges.directon=x", r"^recipe\.edges\.directon: unknown key; did you mean 'direction'\?"),
        ("window.sise=1", r"^recipe\.window\.sise: unknown key; did you mean 'size'\?"),
        ("form=septic", r"^recipe\.form: got 'septic'; it must be 'none', 'mean', 'tilt', .* or 'sextic'"),
        ("s_filter=2.5", r"^recipe\.s_filter: got 2\.5, a number without a unit"),
        ("l_filter=0 um", r"^recipe\.l_filter: got '0 um'; it must be above zero"),
        ("edges.width=5", r"^recipe\.edges\.width: got 5, a number without a unit; write for example '5 m'"),
        ("edges.width=5 s", r"^recipe\.edges\.width: got '5 s', which has the wrong dimension"),
        ("read.spacing=0 um", r"^recipe\.read\.spacing\.0: got '0 um'; it must be above zero$"),
        ("read.spacing=1um,2um,3um", r"^recipe\.read\.spacing: got '1um,2um,3um'; write one length or two, such as"),
        ("smoothing=0", r"^recipe\.smoothing: got 0; it must be at least 1"),
        ("smoothing=2.5", r"^recipe\.smoothing: got 2\.5; write a whole number"),
        ("outliers.quantile=many", r"^recipe\.outliers\.quantile: got 'many'"),
        ("outliers.quantile=0.2", r"^recipe\.outliers\.quantile: got 0\.2; it must be at most 0\.1"),
        ("grid.points=[64]", r"^recipe\.grid\.points"),
        ("grid.points=[1, 64]", r"^recipe\.grid\.points"),
        ("grid.points=lots", r"^recipe\.grid\.points"),
        ("grid=7", r"^recipe\.grid: got 7"),
        ("nothing", r"^set nothing: got no key=value; write for example edges\.direction=x"),
        ("form.order=2", r"^recipe\.form: got \{'order': 2\}"),
    ],
)
def test_a_fault_is_one_line_that_names_its_key(override, message):
    with pytest.raises(InputError, match=message) as raised:
        load_recipe(None, [override])
    assert "\n" not in str(raised.value)
    assert "Coordinate" not in str(raised.value)


def test_a_recipe_that_is_no_toml_is_refused(tmp_path):
    (tmp_path / "r.toml").write_text("form = ")
    with pytest.raises(InputError, match=r"r\.toml: is not TOML \(.*\); write lines such as: form = \"quadratic\""):
        load_recipe(tmp_path / "r.toml")
