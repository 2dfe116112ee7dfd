"""The page of a study begins with its answers: their words and numbers, from two cases on and for any kind of scene."""

import json
import shutil
from dataclasses import asdict
from html.parser import HTMLParser

import pytest
from typer.testing import CliRunner

from roughfilm.batch.jobs import Failure
from roughfilm.cli.main import app
from roughfilm.rom.ladder.scene import load_scene, scene_entries

STEP = """
name = "Rayleigh step"
kind = "bearing"
[geometry]
shape = "step"
length = "10 mm"
film = "10 um"
rise = ["6 um", "8.66 um", "12 um"]
step = ["6 mm", "7.18 mm", "8 mm"]
[lubricant]
viscosity = "0.01 Pa*s"
[motion]
speed = "1 m/s"
[study]
models = ["reynolds_cavitating"]
"""

LOAD_AT_BEST = 0.2063 * 0.01 * 1 * (10e-3 / 10e-6) ** 2
"""Load per width of Rayleigh's step at its optimum, 0.2063 ηuL²/h², N/m."""

POCKETS = """
name = "pockets"
kind = "pocket"
[geometry]
length = "1 mm"
film = "30 um"
width = "0.3 mm"
depth = {depth}
profile = {profile}
[lubricant]
viscosity = "0.01 Pa*s"
density = "1000 kg/m^3"
[motion]
speed = "40 m/s"
[study]
models = ["reynolds", "inertial_reynolds"]
"""


class Text(HTMLParser):
    """The text of a page without its figures and styles, the addresses of its links, and its headings."""

    def __init__(self, page):
        super().__init__()
        self.words, self.links, self.headings, self.open = [], [], [], []
        self.feed(page)
        self.text = " ".join(" ".join(self.words).split())

    def handle_starttag(self, tag, attrs):
        if tag in ("svg", "style", "h2"):
            self.open.append(tag)
        if tag == "a":
            self.links.append(dict(attrs)["href"])

    def handle_endtag(self, tag):
        if self.open and self.open[-1] == tag:
            self.open.pop()

    def handle_data(self, data):
        if "svg" not in self.open and "style" not in self.open:
            self.words.append(data)
            if "h2" in self.open:
                self.headings.append(data)


def batch(study, place):
    place.mkdir(parents=True, exist_ok=True)
    (place / "study.toml").write_text(study)
    run = CliRunner().invoke(app, ["batch", str(place / "study.toml"), "--out", str(place / "done"), "--jobs", "1"])
    assert run.exit_code == 0, run.output
    return place / "done", run


def report(directory, *options):
    run = CliRunner().invoke(app, ["report", str(directory), *options])
    assert run.exit_code == 0, run.output
    page = directory / "report.html"
    return run, Text(page.read_text(encoding="utf-8")), json.loads(page.with_suffix(".json").read_text())


@pytest.fixture(scope="module")
def pockets(tmp_path_factory):
    study = POCKETS.format(depth='["10 um", "15 um", "20 um"]', profile='"cylindrical"')
    return batch(study, tmp_path_factory.mktemp("pockets"))[0]


def test_the_best_case_of_a_rayleigh_step_is_the_known_optimum_by_one_model_alone(tmp_path):
    done, run = batch(STEP, tmp_path)
    assert f"roughfilm report {done}" in run.output
    run, page, entries = report(done)
    best = entries["answers"][0]["best"]
    assert best["varied"] == {"rise": "8.66 µm", "step": "7.18 mm"}
    assert best["value"] == pytest.approx(LOAD_AT_BEST, rel=1e-3)
    assert run.stdout.splitlines()[-1].startswith("Largest load: 2.06")
    assert "at rise = 8.66 µm, step = 7.18 mm (case 5 of 9), by reynolds_cavitating" in page.text
    assert "one model with results" in page.text
    assert page.headings[0] == "Load over what varies"


def test_a_page_of_three_cases_has_answers_models_inertia_and_cost_in_this_order(pockets):
    run, page, entries = report(pockets)
    sections = ["Cases", "Pressure and flow of chosen cases", "Which model would have done"]
    places = [page.headings.index(name) for name in [*sections, "Cost: speed against accuracy"]]
    assert places == sorted(places)
    assert page.headings[0].endswith("over what varies")
    assert "Inertia against Reynolds" in page.text
    assert "inertial_reynolds minus reynolds" in page.text
    assert "sought from 8 cases on; reynolds has 3 of 3 beside inertial_reynolds" in page.text
    assert entries["answers"][0]["quantity"] == "load_per_area"
    assert entries["answers"][0]["unit"] == "Pa"
    assert "(case " in run.stdout.splitlines()[-1]
    assert "report.html" in run.stdout.splitlines()[-1]
    assert all((pockets / link.replace("%3D", "=")).exists() for link in page.links)


def test_the_question_comes_first(pockets):
    run, _, entries = report(pockets, "--want", "friction")
    assert entries["answers"][0]["quantity"] == "friction_per_area"
    assert run.stdout.splitlines()[-1].startswith("Smallest friction per area: ")
    refused = CliRunner().invoke(app, ["report", str(pockets), "--want", "lod"])
    assert refused.exit_code == 2
    assert "--want: got 'lod'; inertial_reynolds has " in refused.stderr


def test_two_cases_of_a_text_are_enough(tmp_path):
    done, _ = batch(POCKETS.format(depth='"10 um"', profile='["cylindrical", "splined"]'), tmp_path)
    _, page, entries = report(done)
    best = entries["answers"][0]["best"]
    assert best["varied"]["profile"] in ("cylindrical", "splined")
    assert f"at profile = {best['varied']['profile']} (case {best['number']} of 2)" in page.text


def test_one_case_is_for_compare(tmp_path):
    done, _ = batch(POCKETS.format(depth='"10 um"', profile='"cylindrical"'), tmp_path)
    run = CliRunner().invoke(app, ["report", str(done)])
    assert run.exit_code == 2
    assert "holds one case" in run.stderr
    assert "roughfilm compare" in run.stderr


def test_a_batch_that_was_killed_is_reported_with_what_is_missing(pockets, tmp_path):
    done = tmp_path / "done"
    shutil.copytree(pockets, done)
    for name in ("table.h5", "table.csv"):
        (done / name).unlink()
    first, second, _ = sorted((done / "cases").iterdir())
    for path in first.glob("*.h5"):
        path.unlink()
    (second / "inertial_reynolds.h5").unlink()
    _, page, entries = report(done)
    assert entries["cases"] == 3
    assert "(case " in page.text
    assert "(case 3 of 3), the only case by inertial_reynolds" in page.text
    assert "2 cases (1, 2) have no inertial_reynolds result: not solved yet" in page.text
    assert "1 case (1) has no reynolds result: not solved yet" in page.text
    assert "The batch is not finished: 3 jobs have no answer" in page.text


def test_a_failed_case_is_listed_with_its_message(pockets, tmp_path):
    done = tmp_path / "done"
    shutil.copytree(pockets, done)
    (done / "table.h5").unlink()
    place = sorted((done / "cases").iterdir())[1]
    (place / "inertial_reynolds.h5").unlink()
    failure = Failure(kind="ConvergenceError", message="stalls at a residual of 0.1")
    scene = scene_entries(load_scene(place / "scene.toml"))
    identity = {"setting": "inertial_reynolds", "scene": scene, "code": "", "versions": {}, "needs": ""}
    record = {"failure": asdict(failure), "identity": identity}
    (place / "inertial_reynolds.failed.json").write_text(json.dumps(record))
    _, page, entries = report(done)
    message = "ConvergenceError: stalls at a residual of 0.1"
    assert f"1 case (2) has no inertial_reynolds result: {message}" in page.text
    assert [place.name, "inertial_reynolds", message] in entries["failures"]
    assert entries["answers"][0]["best"]["case"] != place.name


def test_a_directory_of_an_older_version_has_no_plan_and_is_reported_all_the_same(pockets, tmp_path):
    done = tmp_path / "done"
    shutil.copytree(pockets, done)
    (done / "study.json").unlink()
    _, page, entries = report(done)
    assert set(entries["answers"][0]["best"]["varied"]) == {"depth"}
    assert "(case " in page.text


@pytest.mark.parametrize("name", ["a" * 300, "../elsewhere", "..", "", "a\\u0000"])
def test_a_plan_with_a_case_that_has_no_directory_is_refused_in_one_line(pockets, tmp_path, name):
    done = tmp_path / "done"
    shutil.copytree(pockets, done)
    text = (done / "study.json").read_text(encoding="utf-8")
    case = next((done / "cases").iterdir()).name
    (done / "study.json").write_text(text.replace(f'"{case}"', f'"{name}"'), encoding="utf-8")
    run = CliRunner().invoke(app, ["report", str(done)])
    assert run.exit_code == 2
    assert "is not the plan of a batch" in " ".join(run.stderr.split())


SOMMERFELD = """
name = "long journal"
kind = "bearing"
[geometry]
shape = "journal"
radius = "25 mm"
clearance = "25 um"
width = "500 mm"
[lubricant]
viscosity = "0.02 Pa*s"
[motion]
speed = "2 m/s"
[load]
pressure = ["0.5 MPa", "1 MPa", "2 MPa"]
[study]
models = ["infinitely_wide", "reynolds_cavitating"]
[study.resolution]
infinitely_wide = 256
reynolds_cavitating = 48
"""


@pytest.fixture(scope="module")
def journals(tmp_path_factory):
    return batch(SOMMERFELD, tmp_path_factory.mktemp("journals"))[0]


def test_a_page_of_bearings_under_loads_answers_by_the_film_and_not_by_the_load(journals):
    run, page, entries = report(journals)
    assert run.stdout.splitlines()[-1].startswith("Largest least film thickness: ")
    assert page.headings[0] == "Least film thickness over what varies"
    assert [one["quantity"] for one in entries["answers"]] == ["film_min", "friction"]  # in N, which one line lacks
    best = entries["answers"][0]["best"]
    assert best["varied"] == {"pressure": "0.5 MPa"}
    assert 0 < best["uncertainty"] < best["value"] < 25e-6
    (row,) = (row for row in entries["settings"] if row["setting"].startswith("infinitely_wide"))
    least, largest = row["error"]["film_min"]["intervals"]["worst"]
    assert largest > 0.001
    assert least <= largest


def test_an_unfinished_batch_under_loads_answers_by_the_film_too(journals, tmp_path):
    done = tmp_path / "done"
    shutil.copytree(journals, done)
    case = sorted((done / "cases").iterdir())[0]
    for name in ("table.csv", "table.h5"):
        (done / name).unlink()
    for result in case.iterdir():
        result.unlink()
    run, _, entries = report(done)
    assert entries["answers"][0]["quantity"] == "film_min"
    assert "not finished" in run.output
