"""Studies: lists multiply, variants lie over the scene, relative lengths are exact, every fault is one line."""

import json
import re
from functools import partial

import pytest
from places import STUDIES

from roughfilm import foamcases, rom
from roughfilm.contact.foundation.errors import InputError, UnavailableError
from roughfilm.ladder import find
from roughfilm.rom.ladder.model import Availability, ladder, of_kind
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.studies.relative import resolve_relative
from roughfilm.rom.studies.study import as_toml, load_study

MODELS = ladder(rom, foamcases)

BASE = """
name = "s"
kind = "pocket"
[geometry]
length = "1 mm"
film = "30 um"
width = "0.3 mm"
depth = "7.5 um"
[lubricant]
viscosity = "0.01 Pa*s"
density = "1000 kg/m^3"
[motion]
reynolds_number = 40
"""


@pytest.fixture
def study(tmp_path):
    def read(*changes, more="", models=MODELS):
        text = BASE
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / "study.toml"
        path.write_text(text + more, encoding="utf-8")
        return load_study(path, partial(of_kind, models))

    return read


def test_all_lists_multiply_the_last_one_fastest(study):
    found = study(("width = ", 'width = ["0.2 mm", "0.3 mm", "0.4 mm"] #'), ("40", "[40, 80]"))
    pairs = [(case.scene.grooves[0].width, case.scene.reynolds_number) for case in found.cases]
    assert pairs == [(w, re_) for w in (0.2e-3, 0.3e-3, 0.4e-3) for re_ in (40.0, 80.0)]
    assert list(found.keys.values()) == [("geometry", "width"), ("motion", "reynolds_number")]


def test_a_scene_without_lists_is_one_case(study):
    (case,) = study().cases
    assert case.varied == {}
    assert re.fullmatch(r"case-[0-9a-f]{16}", case.name)


def test_variants_lie_over_the_scene_and_their_lists_multiply(study):
    found = study(
        ("40", "[40, 80]"),
        more="""
[[variants]]
geometry.profile = "cylindrical"
[[variants]]
geometry = { profile = "splined", shift = ["-0.3 width", "0.3 width"] }
motion.reynolds_number = 20
""",
    )
    stated = [(case.scene.grooves[0].profile, case.scene.reynolds_number) for case in found.cases]
    assert stated == [("cylindrical", 40), ("cylindrical", 80), ("splined", 20), ("splined", 20)]
    assert [case.varied.get("shift") for case in found.cases] == [None, None, "-0.3 width", "0.3 width"]


def test_lists_in_a_list_of_tables_are_swept_and_lists_of_pairs_are_values(study):
    grooves = """grooves = [
  { position = "-0.2 length", width = "0.1 length", depth = ["0.25 film", "0.5 film"] },
  { position = "0.2 length", width = ["0.1 length", "0.2 length"], depth = "0.25 film" },
]"""
    found = study(('width = "0.3 mm"\n', grooves + "\n"), ('depth = "7.5 um"\n', ""))
    sizes = [[(g.width, g.depth) for g in case.scene.grooves] for case in found.cases]
    assert sizes == [[(1e-4, first), (second, 7.5e-6)] for first in (7.5e-6, 15e-6) for second in (1e-4, 2e-4)]
    assert list(found.keys) == ["depth", "width"]
    points = 'profile = "points"\npoints = [[-1e-4, 0.0], [0.0, 5e-6], [1e-4, 0.0]]\n'
    found = study(('width = "0.3 mm"\ndepth = "7.5 um"\n', points))
    assert len(found.cases) == 1


def test_relative_lengths_are_the_ones_they_name():
    table = {"length": "1 mm", "film": "30 um", "width": "0.15 length", "depth": "1.25 film", "shift": "-0.3 width"}
    assert resolve_relative(table, "g") == {
        "length": "1 mm", "film": "30 um", "width": "0.15 mm", "depth": "37.50 um", "shift": "-0.045 mm"
    }  # fmt: skip


def test_a_relative_case_is_the_case_written_out(study):
    (one,) = study(('"0.3 mm"', '"0.3 length"'), ('"7.5 um"', '"0.25 film"')).cases
    (other,) = study().cases
    assert one.scene == other.scene
    assert one.digest == other.digest


@pytest.mark.parametrize(
    ("changes", "more", "words"),
    [
        ([('"0.3 mm"', '"0.3 lenght"')], "", "scene.geometry.width: got '0.3 lenght'; 'lenght' is neither a unit nor"),
        ([('"0.3 mm"', '"0.3 depth"'), ('"7.5 um"', '"0.1 width"')], "", "leads in a circle (width -> depth -> width)"),
        ([('"0.3 mm"', '"0.3 width"')], "", "leads in a circle (width -> width)"),
        ([('"7.5 um"', '"0.3 profile"\nprofile = "cylindrical"')], "", "multiple of profile, which is 'cylindrical'"),
        ([("= 40", "= []")], "", "motion.reynolds_number: got an empty list"),
        ([("= 40", '= [40, "80"]')], "", "motion.reynolds_number: got a mixture of numbers and texts"),
        ([("= 40", "= [40, true]")], "", "motion.reynolds_number: got a mixture of numbers and truth values"),
        ([("= 40", "= [40, 40]")], "", "two cases are the same scene, reynolds_number-40-"),
        ([('"0.3 mm"', '["0.3 mm", "300 um"]')], "", "two cases are the same scene"),
        ([("= 40", f"= {list(range(1, 1002))}"), ('"7.5 um"', json.dumps([f"{i} nm" for i in range(1, 1001)]))], "",
         "the lists make 1001000 cases; a study has 1 to 1000000"),
        ([('name = "s"', 'name = "s"\nvariants = []')], "", "the lists make 0 cases"),
        ([('name = "s"', 'name = "s"\nvariants = [1]')], "", "variants: is not a list of tables"),
        ([('"7.5 um"', '["7.5 um", "7.5"]')], "", "case depth-7.5: scene.geometry.depth: got '7.5', a number without"),
        ([('"7.5 um"', '["7.5 um", "1 mm"]')], "", "case depth-1mm: scene.geometry.depth: got 0.001 m"),
        ([("depth", "dept")], "", "scene.geometry.dept: "),
        ([], "[study]\nmodel = 1\n", "study.model: unknown key; known here: models, resolution, scheme"),
        ([], '[study]\nmodels = ["raynolds"]\n', "study.models: got 'raynolds'; it must be one of reynolds"),
        ([], "[study]\nmodels = []\n", "study.models: got []"),
        ([], '[study]\nmodels = ["stokes", "stokes"]\n', "study.models: got ['stokes', 'stokes']; list"),
        ([], "[study]\nresolution.navier = 3\n", "study.resolution.navier: is no model of this study"),
        ([], '[study]\nmodels = ["reynolds"]\nresolution.stokes = 60\n', "study.resolution.stokes: is no model"),
        ([], "[study]\nresolution = 60\n", "study.resolution: got 60; write { MODEL = VALUE }"),
        ([], "[study]\nresolution.reynolds = 2.5\n", "study.resolution.reynolds: got 2.5; write a whole number"),
        ([], "[study]\nresolution.reynolds = [8, 8]\n", "list of different ones"),
        ([], '[study]\nscheme.reynolds = "upwind"\n', "study.scheme.reynolds: got 'upwind'; it offers no choice"),
        ([], '[study]\nscheme.navier_stokes = "up"\n', "study.scheme.navier_stokes: got 'up'; it must be one of"),
    ],
)  # fmt: skip
def test_every_fault_is_one_line(study, changes, more, words):
    with pytest.raises(InputError) as caught:
        study(*changes, more=more)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("depth", [100, 200, 300, 500, 700, 5000])
def test_tables_nested_without_end_are_one_line(study, depth):
    with pytest.raises(InputError, match=r"^[^\n]*$"):
        study(("= 40", "= 40\n" + ".".join(["a"] * depth) + " = 1"))


def test_models_resolutions_and_schemes_multiply(study):
    here = Availability(available=True, detail="here")
    models = tuple(type(model)(**{**vars(model), "available": lambda: here}) for model in MODELS)
    more = """
[study]
models = ["navier_stokes", "reynolds"]
resolution = { navier_stokes = [60, 120] }
scheme = { navier_stokes = ["linear_upwind", "upwind"] }
"""
    names = [setting.name for setting in study(more=more, models=models).settings]
    assert names == ["reynolds"] + [f"navier_stokes-{n}-{s}" for n in (60, 120) for s in ("linear_upwind", "upwind")]


def test_models_that_are_missing_are_left_out_unless_they_are_named(study):
    absent = Availability(available=False, detail="no simpleFoam; install it")
    models = tuple(
        type(model)(**{**vars(model), "available": lambda: absent}) if model.outside else model for model in MODELS
    )
    assert not any(setting.model.outside for setting in study(models=models).settings)
    with pytest.raises(UnavailableError, match=r"study.models: stokes: no simpleFoam; install it"):
        study(models=models, more='[study]\nmodels = ["stokes"]\n')


def test_names_fit_any_system(study):
    found = study(
        ('name = "s"', json.dumps(["a/b", "..", "con:*?", "µ " * 90])[1:-1].join(["name = [", "]"])),
        ("= 40", "= [40, 1e-6]"),
    )
    names = [case.name for case in found.cases]
    assert len(set(names)) == 8
    for name in names:
        assert re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9.+_-]*", name)
        assert len(name) < 200


def test_a_case_is_written_as_a_scene_that_reads_back_the_same(study, tmp_path):
    grooves = '[[geometry.grooves]]\nwidth = "0.1 mm"\ndepth = "3 um"\nposition = "-0.2 mm"\n'
    points = '[[geometry.grooves]]\nprofile = "points"\nposition = "0.2 mm"\n'
    points += "points = [[-1e-4, 0.0], [0.0, 5e-6], [1e-4, 0.0]]\n"
    name = 'name = "\\"µ\\u0001\\u007f\\U0001F600\\\\"'
    base = (('width = "0.3 mm"\ndepth = "7.5 um"\n', ""), ('name = "s"', name))
    for found in (study(), study(*base, more=grooves + points)):
        path = tmp_path / "scene.toml"
        path.write_text(as_toml(found.cases[0].scene), encoding="utf-8")
        assert load_scene(path) == found.cases[0].scene


def test_the_published_table_has_its_640_cases():
    """Table A.2 of the source: 8 widths, 5 depths, 4 Reynolds numbers, one cylindrical and three splined shapes.

    Figs. A.3 and A.4 show eight more, at Re = 10.
    """
    found = load_study(STUDIES / "paper_a.toml", partial(of_kind, MODELS))
    groups = {}
    for case in found.cases:
        if case.scene.reynolds_number == 10:
            continue
        part = case.scene.geometry
        (groove,) = case.scene.grooves
        shift = round(groove.shift / groove.width, 9) if groove.profile == "splined" else None
        key = (groove.profile, shift)
        numbers = (round(groove.width / part.length, 9), round(groove.depth / part.film, 9), case.scene.reynolds_number)
        groups.setdefault(key, set()).add(numbers)
    whole = {
        (w, d, number)
        for w in (0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5)
        for d in (0.25, 0.5, 0.75, 1.0, 1.25)
        for number in (40, 80, 120, 160)
    }
    assert groups == dict.fromkeys(
        [("cylindrical", None), ("splined", -0.3), ("splined", 0.0), ("splined", 0.3)], whole
    )
    assert len(found.cases) == 648


def test_the_first_study_is_cheap():
    found = load_study(STUDIES / "pocket.toml", partial(of_kind, MODELS))
    assert len(found.cases) == 12
    assert sum(setting.cost(case.scene) for setting in found.settings for case in found.cases) < 1
    assert find("pocket", "reynolds") in [setting.model for setting in found.settings]
