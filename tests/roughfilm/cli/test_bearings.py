"""Commands on bearings: solve, compare on a line and in the plane, batch and report."""

import csv
import html
import json
import math
import re
from html.parser import HTMLParser

import pytest
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.rom.ladder.store import load

SLIDER = SCENES / "parabolic_slider.toml"

WITH_INERTIA_OR_SLOPE = ("film", "film_slope", "stokes", "navier_stokes")
"""The models of infinitely wide pads with a density and without pressure dependence."""

OF_OILS = ("heat_balance", "adiabatic", "across", "shear_thinning")
"""The models of lubricants with a temperature, and of those that thin with shear."""


def run(*arguments):
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.outside, self.tags = [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.outside += [v for name, v in attributes if name in {"src", "href"} and tag not in {"a", "use", "image"}]


def page_of(path):
    page = Page()
    page.feed(path.read_text(encoding="utf-8"))
    return page


def test_solve_states_the_table_of_the_source(tmp_path):
    out = tmp_path / "r.h5"
    arguments = ["--set", "boundary.inlet.theta=0.55", "--model", "reynolds_cavitating", "--json", "--out", out]
    message = json.loads(run("solve", SLIDER, *arguments).stdout)
    found = {name: quantity["value"] for name, quantity in message["quantities"].items()}
    assert found["load_per_width"] == pytest.approx(41640.25, rel=1e-5)
    assert found["film_start"] == pytest.approx(0.15624, abs=1e-5)
    assert found["rupture"] == pytest.approx(0.65811, abs=1e-5)
    assert message["quantities"]["load_per_width"]["unit"] == "N/m"
    assert message["quantities"]["load_per_width"]["uncertainty"] < 1e-4 * found["load_per_width"]
    fields = load(out).fields
    assert fields["pressure"].values.max() == pytest.approx(found["pressure_max"])
    assert fields["density_ratio"].values.min() == pytest.approx(0.55, abs=1e-9)


def test_solve_shows_how_sure_it_is():
    shown = run("solve", SLIDER, "--model", "reynolds_cavitating").stdout
    assert "±" in shown
    assert "no film forms" in run("solve", SLIDER, "--model", "reynolds_cavitating", "--set", "boundary.inlet.theta=0.1").stdout  # fmt: skip  # noqa: E501


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--model", "thin"], "--model: got 'thin'; it must be one of reynolds, infinitely_wide"),
        (["--model", "reynolds", "--resolution", "4"], "--resolution: got 4; reynolds takes 8 to"),
        (["--model", "reynolds", "--set", "geometry.shape=oval"], "scene.geometry.shape: got 'oval'"),
        (["--model", "reynolds", "--scheme", "upwind"], "--scheme: got 'upwind' for reynolds; it offers no choice"),
    ],
)
def test_refusals_are_one_line_and_code_2(arguments, words):
    result = run("solve", SLIDER, *arguments)
    assert result.exit_code == 2
    assert words in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1


def test_pressures_that_no_lubricant_bears_are_no_answer():
    # by Barus' law pressures follow 1 - exp(-αp) = α p0: none do where α p0 >= 1, and p0 = 3.59 MPa here
    law = ["compressibility.law=incompressible", "piezoviscosity.law=barus", "piezoviscosity.pressure_coefficient="]
    options = [part for change in law for part in ("--set", f"lubricant.{change}")]
    options[-1] += "0.2 MPa^-1"
    message = json.loads(run("solve", SLIDER, "--model", "reynolds_cavitating", "--json", *options).stdout)
    assert message["quantities"]["pressure_max"]["value"] == pytest.approx(-5e6 * math.log(1 - 0.2 * 3.59182), rel=2e-4)
    options[-1] = options[-1].replace("0.2", "0.3")
    result = run("solve", SLIDER, "--model", "reynolds_cavitating", *options)
    assert result.exit_code == 3
    assert "no steady film was found" in result.stderr
    assert len(result.stderr.strip().splitlines()) == 1


def test_compare_on_a_line(tmp_path):
    result = run("compare", SLIDER, "--out", tmp_path / "study", "--json")
    assert result.exit_code == 0, result.stderr
    message = json.loads(result.stdout)
    assert message["model"] == "reynolds_cavitating"
    effects = {(d["other"], d["model"], d["effect"]) for d in message["differences"] if d["effect"]}
    assert effects == {
        ("reynolds", "reynolds_incompressible", "cavitation"),
        ("reynolds_incompressible", "reynolds_cavitating", "pressure dependence"),
    }
    assert set(message["absent"]) == {
        "infinitely_wide",
        "homogenized",
        "direct",
        "mixed",
        *WITH_INERTIA_OR_SLOPE,
        *OF_OILS,
    }
    page = page_of(tmp_path / "study" / "report.html")
    assert page.outside == []
    assert page.tags.count("svg") == 3


def test_cavitation_carries_the_textured_slider(tmp_path):
    result = run("compare", SCENES / "textured_slider.toml", "--out", tmp_path / "study", "--json")
    message = json.loads(result.stdout)
    loads = {part["model"]: part["quantities"]["load_per_width"]["value"] for part in message["models"]}
    assert abs(loads["reynolds"]) < 1e-6 * loads["reynolds_cavitating"]
    assert loads["reynolds_incompressible"] == pytest.approx(loads["reynolds_cavitating"])


def test_compare_in_the_plane(tmp_path):
    result = run("compare", SCENES / "journal.toml", "--out", tmp_path / "study", "--json")
    assert result.exit_code == 0, result.stderr
    message = json.loads(result.stdout)
    assert set(message["absent"]) == {"homogenized", "direct", "mixed", *WITH_INERTIA_OR_SLOPE, *OF_OILS}
    assert {d["effect"] for d in message["differences"] if d["effect"]} == {
        "cavitation",
        "pressure dependence",
        "side flow",
    }
    assert message["convergence"]["reynolds_cavitating"]["load_per_width"]["order"] == pytest.approx(2, abs=0.1)
    page = page_of(tmp_path / "study" / "report.html")
    assert page.outside == []
    assert page.tags.count("svg") == 4
    text = (tmp_path / "study" / "report.html").read_text(encoding="utf-8")
    assert one_unit_each(text) == {"load": "kN", "friction": "N", "least film thickness": "µm", "peak pressure": "MPa"}
    assert re.search(r'class="answer">Load: [\d.]+ ± [\d.]+ kN<', text)
    assert '"name":"pressure above ambient","unit":"MPa"' in html.unescape(text)
    assert "The pressure by reynolds_incompressible is that by reynolds_cavitating." in text


def one_unit_each(page):
    """The unit of some quantities in all tables of a page."""
    found = {}
    for cell in re.findall(r"<t[dh][^>]*>(?:change of<br>)?([^<]+)</t[dh]>", page):
        name, _, unit = cell.rpartition(", ")
        if name in ("load", "friction", "least film thickness", "peak pressure"):
            found.setdefault(name, set()).add(unit)
    assert all(len(units) == 1 for units in found.values()), found
    return {name: units.pop() for name, units in found.items()}


def test_batch_and_report(tmp_path):
    text = SLIDER.read_text(encoding="utf-8").replace("theta = 1 ", "theta = [0.55, 0.7, 1, 1.001] ")
    study = tmp_path / "study.toml"
    moduli = '["0.069 GPa", "0.2 GPa", "1 GPa", "3 GPa", "10 GPa"]'
    study.write_text(text.replace('"0.069 GPa"', moduli), encoding="utf-8")
    result = run("batch", study, "--out", tmp_path / "done", "--jobs", 1)
    assert result.exit_code == 0, result.output
    with (tmp_path / "done" / "table.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert {"kind", "theta", "inlet_theta", "compression", "load_per_width (N/m)"} <= set(rows[0])
    assert {row["kind"] for row in rows} == {"bearing"}
    result = run("report", tmp_path / "done", "--json")
    assert result.exit_code == 0, result.output
    message = json.loads(result.stdout)
    assert message["reference"] == "reynolds_cavitating"
    plain = next(row for row in message["settings"] if row["setting"] == "reynolds_incompressible")
    assert plain["error"]["load_per_width"]["worst"] > 0.05
    assert page_of(tmp_path / "done" / "report.html").outside == []
