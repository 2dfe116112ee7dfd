"""A case holds numbers and names of ours: nothing that a scene spells gets into it."""

import os
import re
import stat
from dataclasses import replace

import pytest
from foamlib import FoamFile

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.pocket.card import Card
from roughfilm.foamcases.pocket.models.navier_stokes import MODEL as NAVIER_STOKES
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from roughfilm.rom.pocket.models.reynolds import MODEL as REYNOLDS

HOSTILE = [
    '#calc "system(\\"touch /tmp/owned\\")"',
    '#codeStream { code #{ system("touch /tmp/owned"); #}; }',
    "$include; }",
    '#includeEtc "controlDict"',
    "a; nu 1e9;",
]


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_name_never_reaches_the_case(make_scene, tmp_path, name):
    scene = read_scene({**scene_entries(make_scene(0.3, 0.25, 160)), "name": name})
    NAVIER_STOKES.write(scene, tmp_path / "case", Request(resolution=20))
    files = [path for path in (tmp_path / "case").rglob("*") if path.is_file()]
    assert len(files) > 10
    for path in files:
        content = path.read_bytes()
        assert name.encode() not in content, path
        if path.parent.name != "polyMesh" and path.name not in {"Allrun", "README", "case.json"}:
            assert not re.search(rb"[#$]", content), path


@pytest.mark.parametrize("text", ["1 m/s; #calc", "#calc", "1 $pi", '1 "m/s"'])
@pytest.mark.parametrize("place", [("motion", "speed"), ("geometry", "depth"), ("geometry", "profile")])
def test_hostile_values_are_refused_before_a_case_is_made(make_scene, place, text):
    entries = scene_entries(make_scene(0.3, 0.25, 160))
    entries["motion"] = {"speed": "1 m/s"}
    entries[place[0]][place[1]] = text
    with pytest.raises(InputError, match=r"scene\.\w+\.\w+: got"):
        read_scene(entries)


def test_the_case_says_what_it_is(make_scene, tmp_path):
    scene = make_scene(0.3, 0.25, 160)
    NAVIER_STOKES.write(scene, tmp_path, Request(resolution=60, tolerance=1e-6))
    card = read_card(tmp_path, Card)
    assert (card.reynolds_number, card.resolution, card.tolerance) == (160.0, 60, 1e-6)
    assert FoamFile(tmp_path / "constant" / "transportProperties")["nu"] == pytest.approx(1 / 160)
    assert FoamFile(tmp_path / "system" / "controlDict")["writeFormat"] == "binary"
    assert os.stat(tmp_path / "Allrun").st_mode & stat.S_IXUSR
    factor = float(re.search(r"p \[Pa\]\s+= p \* (\S+)", (tmp_path / "README").read_text())[1])
    assert factor == pytest.approx(1000 * scene.speed**2)


@pytest.mark.parametrize(
    ("resolution", "tolerance", "words"),
    [(3, None, "resolution: got 3"), (10**8, None, "resolution: got"), (None, 0.5, "tolerance: got 0.5")],
)
def test_options_out_of_range(make_scene, tmp_path, resolution, tolerance, words):
    with pytest.raises(InputError, match=words):
        NAVIER_STOKES.write(
            make_scene(0.3, 0.25, 1), tmp_path / "c", Request(resolution=resolution, tolerance=tolerance)
        )
    assert not (tmp_path / "c").exists()


def test_a_case_is_never_written_over_another(make_scene, tmp_path):
    scene = make_scene(0.3, 0.25, 1)
    NAVIER_STOKES.write(scene, tmp_path, Request(resolution=20))
    with pytest.raises(InputError, match="is not an empty directory"):
        NAVIER_STOKES.write(scene, tmp_path, Request(resolution=20))


def test_a_directory_without_a_card_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"case\.json"):
        read_card(tmp_path, Card)


@pytest.mark.parametrize(("name", "value"), [("columns", 0), ("layers", -1), ("reynolds_number", "Infinity")])
def test_a_card_with_a_number_out_of_range_is_refused(make_scene, tmp_path, name, value):
    NAVIER_STOKES.write(make_scene(0.3, 0.25, 160), tmp_path, Request(resolution=20))
    text = (tmp_path / "case.json").read_text(encoding="utf-8")
    (tmp_path / "case.json").write_text(re.sub(rf'"{name}": [\d.]+', f'"{name}": {value}', text), encoding="utf-8")
    with pytest.raises(InputError, match=r"case\.json"):
        read_card(tmp_path, Card)


def test_a_path_with_a_blank_is_refused_before_openfoam_stumbles_over_it(make_scene, tmp_path):
    with pytest.raises(InputError, match="takes no blanks in a path"):
        NAVIER_STOKES.write(make_scene(0.3, 0.25, 1), tmp_path / "my case", Request(resolution=20))
    assert not (tmp_path / "my case").exists()


def test_a_case_that_was_run_is_outside_of_its_range_as_a_solution_is(make_scene, tmp_path):
    solution = REYNOLDS.solve(make_scene(0.3, 0.25, 5000))
    model = replace(NAVIER_STOKES, cases=replace(NAVIER_STOKES.cases, read=lambda *_: replace(solution, outside=())))
    found = model.read(make_scene(0.3, 0.25, 5000), tmp_path, None).outside
    assert found == solution.outside
    assert "exceeds 1440" in found[0]


def test_a_case_of_grooves_whose_card_names_every_field_ends_by_its_residuals(make_scene, tmp_path):
    NAVIER_STOKES.write(make_scene(0.3, 0.25, 160), tmp_path, Request(resolution=20))
    card = read_card(tmp_path, Card)
    assert not card.settles
    assert not replace(card, judged=("Ux", "Uy", "Uz", "p")).settles
    assert replace(card, judged=("Ux", "p")).settles
    assert replace(card, judged=("Ux", "Uy", "p"), rows=8).settles
