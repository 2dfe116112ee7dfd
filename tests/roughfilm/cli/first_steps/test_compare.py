"""The comparison: one self-contained page, results that survive a kill, pictures that may be missing."""

import html
import json
import math
import os
import re
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from forging import forge
from places import SCENES

from roughfilm.batch import jobs as runs
from roughfilm.batch.jobs import Job
from roughfilm.cli.first_steps import compare
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.figures import rendering
from roughfilm.ladder import find, models
from roughfilm.rom.ladder.model import Availability, Resolutions, of_kind
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.ladder.store import load
from roughfilm.rom.studies.convergence import converge

GAP = SCENES / "rough_gap.toml"


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.outside, self.tags = [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        for name, value in attributes:
            if name in {"src", "href"} and tag not in {"a", "use"}:
                self.outside.append(value)


def read_page(path):
    page = Page()
    page.feed(path.read_text(encoding="utf-8"))
    return page


@pytest.fixture
def reynolds_only(monkeypatch):
    monkeypatch.setattr(compare, "models", lambda _: (find("pocket", "reynolds"),))


@dataclass(frozen=True)
class Killed:
    """A comparison by every model that was killed, and then run again to its end.

    ``left`` has the results that were there after the kill with their times, ``page`` whether the page was.
    """

    out: Path
    left: dict[Path, int]
    page: bool
    entries: dict[str, Any]


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    out = tmp_path_factory.mktemp("killed")
    command = [sys.executable, "-m", "roughfilm.cli.main", "compare", str(SCENES / "pocket.toml"), "--out", str(out)]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    deadline = time.monotonic() + 120
    while not list((out / "results").glob("stokes*.h5")) and time.monotonic() < deadline:
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    left = {path: path.stat().st_mtime_ns for path in (out / "results").glob("[!.]*.h5")}
    for path in left:
        load(path)
    page = (out / "report.html").exists()
    done = subprocess.run([*command, "--json"], capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    return Killed(out=out, left=left, page=page, entries=json.loads(done.stdout))


@pytest.mark.openfoam
@pytest.mark.slow
def test_a_killed_comparison_leaves_whole_results_and_goes_on(killed):
    assert killed.left
    assert not killed.page
    assert {path: path.stat().st_mtime_ns for path in killed.left} == killed.left
    assert (killed.out / "report.html").exists()


@pytest.mark.openfoam
@pytest.mark.slow
def test_the_whole_ladder_in_one_self_contained_page(killed):
    entries = killed.entries
    assert entries["model"] == "navier_stokes"
    names = [
        "reynolds",
        "reynolds_cavitating",
        "inertial_reynolds",
        "film",
        "stokes",
        "film_slope",
        "navier_stokes",
    ]
    assert names == [model.name for model in models("pocket")]
    costs = [(part["numerics"]["cpu_s"], part["model"]) for part in entries["models"]]
    assert {name for _, name in costs} == set(names)
    assert costs == sorted(costs), "the models are in order of their cost"
    named = {(d["other"], d["model"], d["effect"]) for d in entries["differences"] if d["effect"]}
    assert ("stokes", "navier_stokes", "inertia") in named
    assert ("film", "navier_stokes", "slope") in named
    assert ("reynolds", "reynolds_cavitating", "cavitation") in named
    assert entries["cheapest_within_10_percent"] == "inertial_reynolds"
    page = read_page(killed.out / "report.html")
    assert all(place.startswith("data:image/png;base64,") for place in page.outside)
    assert page.tags.count("svg") == 4
    found = entries["convergence"]["navier_stokes"]["load_plus"]
    assert (found["kind"], found["grids"]) == ("monotone", [60, 120, 240])
    assert found["value"] == pytest.approx(3.303, abs=found["uncertainty"])
    assert set(entries["convergence"]) == {"reynolds_cavitating", "film", "film_slope", "stokes", "navier_stokes"}
    assert entries["convergence"]["stokes"]["load_plus"]["kind"] == "at round-off"
    if rendering.probe().available:
        assert page.tags.count("img") == 1
    for name in names:
        assert load(killed.out / "results" / f"{name}.h5").model == name
    raw = json.loads((killed.out / "chart.json").read_text())
    per_model = {name: sum(point["model"] == name for point in raw["points"]) for name in names}
    assert min(per_model.values()) >= 3


@pytest.mark.usefixtures("reynolds_only")
def test_text_of_a_scene_is_text_in_the_page_beside_the_note_on_the_published_plots(pocket_file, tmp_path):
    name = "<script>alert(1)</script> {{ 7 * 7 }}"
    compare.command(pocket_file, out=tmp_path, set_=[f"name={name}"])
    page = (tmp_path / "report.html").read_text()
    assert "<script>alert" not in page
    assert html.escape(name) in page
    assert re.search(r"show half of the\s+definition", page)


@pytest.mark.usefixtures("reynolds_only")
def test_the_table_shows_converged_numbers_even_where_the_default_order_is_too_low(pocket_file, tmp_path):
    """A half circle needs hundreds of nodes; its reference is the densest sampling of the same integrals."""
    compare.command(pocket_file, out=tmp_path, set_=["geometry.depth=150um"])
    result = load(tmp_path / "results" / "reynolds.h5")
    assert result.numerics.residual <= result.numerics.tolerance
    gap = load_scene(pocket_file, ["geometry.depth=150um"]).gap()
    count = 4_000_000
    x = ((np.arange(count) + 0.5) / count - 0.5) * gap.length
    h = gap.thickness(x) / gap.film
    q = (h**-2.0).mean() / (2 * (h**-3.0).mean())
    pressure = np.cumsum(6 / h**2 - 12 * q / h**3) / count * 100
    assert result.quantities["pressure_max_plus"].value == pytest.approx(pressure.max(), rel=1e-5)


@pytest.mark.openfoam
def test_where_nothing_can_be_drawn_the_page_says_so(pocket_file, tmp_path, monkeypatch):
    at_30 = Resolutions(least=30, most=30, default=30, series=(30,))
    some = tuple(replace(model, resolutions=at_30) for model in models("pocket"))
    monkeypatch.setattr(compare, "models", lambda _: some)
    monkeypatch.setattr(
        compare, "draw_apart", lambda *_: Availability(available=False, detail="VTK cannot draw here (exit code -11)")
    )
    compare.command(pocket_file, out=tmp_path)
    assert "no picture: VTK cannot draw here (exit code -11)" in (tmp_path / "report.html").read_text()
    assert "img" not in read_page(tmp_path / "report.html").tags


def sampled(monkeypatch, *, fails_at=None):
    """A single rung of formal order 2, whose load is the mean thickness over the groove by the midpoint rule."""
    film = find("pocket", "reynolds")

    def compute(_model, scene, request, _progress):
        n = request.resolution
        if n == fails_at:
            raise ConvergenceError("sampled: did not converge; take another grid")
        result = film.solve(scene)
        gap = scene.gap()
        thickness = gap.thickness(((np.arange(n) + 0.5) / n - 0.5) * scene.grooves[0].width).mean() / gap.film
        quantities = {**result.quantities, "load_plus": Quantity(value=float(thickness), unit="1")}
        return replace(result, quantities=quantities, numerics=replace(result.numerics, resolution=n))

    model = replace(
        film, resolutions=Resolutions(least=1, most=99, default=16, series=(4, 8, 16)), order=2, compute=compute
    )
    monkeypatch.setattr(compare, "models", lambda _: (model,))


def compared(capsys, pocket_file, out, **options):
    compare.command(pocket_file, out=out, as_json=True, **options)
    return json.loads(capsys.readouterr().out)


def test_the_grids_of_the_chart_are_those_of_the_convergence(pocket_file, tmp_path, monkeypatch, capsys):
    """The mean thickness over an arc's chord is the segment's area over it, in film thicknesses, plus one."""
    sampled(monkeypatch)
    load = compared(capsys, pocket_file, tmp_path)["convergence"]["reynolds"]["load_plus"]
    width, depth = 0.3, 0.0075
    radius = (width**2 / 4 + depth**2) / (2 * depth)
    half = math.asin(width / 2 / radius)
    mean = 1 + radius**2 * (half - math.sin(2 * half) / 2) / width / 0.03
    assert load["grids"] == [4, 8, 16]
    assert load["order"] == pytest.approx(2, abs=0.01)
    assert load["value"] == pytest.approx(mean, abs=load["uncertainty"])
    assert load["value"] == pytest.approx(mean, rel=1e-6)
    page = (tmp_path / "report.html").read_text()
    assert "Grid convergence" in page
    assert read_page(tmp_path / "report.html").tags.count("svg") == 3


def test_a_fourth_grid_is_finer_and_becomes_the_reference(pocket_file, tmp_path, monkeypatch, capsys):
    sampled(monkeypatch)
    entries = compared(capsys, pocket_file, tmp_path, grids=4)
    assert entries["convergence"]["reynolds"]["load_plus"]["grids"] == [8, 16, 32]
    assert entries["chart"]["reference"]["resolution"] == entries["numerics"]["resolution"] == 32
    finest = tmp_path / "results" / "reynolds-32.h5"
    stamp = finest.stat().st_mtime_ns
    compared(capsys, pocket_file, tmp_path, grids=4)
    assert finest.stat().st_mtime_ns == stamp


def test_a_grid_that_fails_is_stated_in_one_line_and_the_others_are_judged(pocket_file, tmp_path, monkeypatch, capsys):
    sampled(monkeypatch, fails_at=8)
    compare.command(pocket_file, out=tmp_path)
    captured = capsys.readouterr()
    (line,) = captured.err.splitlines()
    assert line == "grid left out: reynolds-8: sampled: did not converge; take another grid"
    assert "reynolds on grids 4, 16" in captured.out
    page = (tmp_path / "report.html").read_text()
    assert "two grids, formal order assumed" in page
    assert "nothing to extrapolate" not in page


def test_without_a_formal_order_there_is_no_grid_convergence(pocket_file, tmp_path, monkeypatch, capsys):
    scene = load_scene(pocket_file)
    spectral = tuple(model for model in models("pocket") if model.order_of(scene) is None)
    monkeypatch.setattr(compare, "models", lambda kind: of_kind(spectral, kind))
    assert compared(capsys, pocket_file, tmp_path)["convergence"] == {}
    assert "Grid convergence" not in (tmp_path / "report.html").read_text()


def test_a_result_that_states_more_doubt_than_its_grids_is_believed():
    scene = load_scene(GAP)
    found = find("rough_gap", "slope_corrected").solve(scene)
    value, bar = found["A11"].value, found["A11"].uncertainty
    for of_grids, expected in ((0.1 * bar, bar), (3 * bar, 3 * bar)):
        study = {"A11": converge((16, 32), (value, value), formal_order=2, noise=of_grids)}
        assert compare._uncertainty(found, study)["A11"] == pytest.approx(expected / value)


def test_models_that_the_reference_does_not_separate_are_named(pocket_file, tmp_path, monkeypatch, capsys):
    """A shallow wide groove at 50 cells: film and film_slope differ by far less than the uncertainty of these grids."""
    coarse = Resolutions(least=10, most=400, default=50, series=(25, 50))
    own = find("pocket", "film"), replace(find("pocket", "film_slope"), resolutions=coarse)
    monkeypatch.setattr(compare, "models", lambda _: own)
    scene = ["geometry.depth=1 um", "geometry.width=0.5 mm"]
    compare.command(pocket_file, out=tmp_path / "report", set_=scene)
    assert "load: cannot be distinguished with this reference: film and film_slope" in capsys.readouterr().out
    entries = compared(capsys, pocket_file, tmp_path / "report", set_=scene)
    assert entries["undecided"]["load_plus"] == [["film", "film_slope"]]
    (difference,) = (d for d in entries["differences"] if d["quantity"] == "load_plus" and d["effect"] is None)
    assert 2 * difference["uncertainty"] > abs(difference["relative"])
    reference = entries["quantities"]["load_plus"]
    assert difference["uncertainty"] == pytest.approx(reference["uncertainty"] / reference["value"])
    page = (tmp_path / "report" / "report.html").read_text(encoding="utf-8")
    assert "Models that cannot be distinguished" in page
    assert "in load film and film_slope" in page


def test_a_crash_while_drawing_is_an_answer():
    found = rendering._apart("-c", "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)")
    assert not found.available
    assert "apt-get install" in found.detail


def test_finished_results_are_used_again_only_for_the_same_question(pocket_file, tmp_path, monkeypatch):
    scene, other = load_scene(pocket_file), load_scene(pocket_file, ["geometry.depth=8 um"])
    setting = Setting(model=find("pocket", "reynolds"), resolution=8)
    job = Job(scene=scene, setting=setting, path=tmp_path / "reynolds-8.h5")
    first = runs.solved_once(job, lambda *_: None)
    stamp = job.path.stat().st_mtime_ns
    runs.solved_once(job, lambda *_: None)
    assert job.path.stat().st_mtime_ns == stamp
    changed = runs.solved_once(replace(job, scene=other), lambda *_: None)
    assert changed.quantities["pressure_max_plus"] != first.quantities["pressure_max_plus"]
    assert load(job.path).provenance["scene"]["geometry"]["depth"] == "8e-06 m"
    os.truncate(job.path, job.path.stat().st_size // 2)
    runs.solved_once(job, lambda *_: None)
    forge(job.path, lambda file: file.attrs.update(provenance="[]"))
    runs.solved_once(job, lambda *_: None)
    stamp = job.path.stat().st_mtime_ns
    monkeypatch.setattr(runs, "model_code", lambda *_: "other code")
    runs.solved_once(job, lambda *_: None)
    assert job.path.stat().st_mtime_ns != stamp
