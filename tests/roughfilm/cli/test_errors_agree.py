"""Every statement about the error of a model in a quantity agrees with every other one, over text, JSON and page."""

import json
import re
from collections import defaultdict
from functools import partial

import numpy as np
import pytest
from places import SCENES
from typer.testing import CliRunner

from roughfilm.cli.first_steps import compare
from roughfilm.cli.main import app
from roughfilm.ladder import models
from roughfilm.rom.advice.stated import StatedError
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.rom.ladder.model import of_kind
from roughfilm.terminal.console import NOT_CONVERGED

AMOUNT = r"(?:above 100 %|unknown|[+−]?[\d.e-]+ %(?: ± [\d.e-]+ %)?)"
SOURCE = r"\((?:expected by the laws|its own uncertainty|measured against \w+)\)"

SMOOTH = ("pocket", "splined", "two_grooves", "parabolic_slider")
ROUGH = ("dry_contact", "seal", "rough_gap")


def words_of(name, place):
    """The arguments of a command for an example scene; a rough surface is replaced by waves on 24 points a side."""
    if name in SMOOTH:
        return [f"{SCENES}/{name}.toml"]
    x = 2 * np.pi * np.arange(24) / 24
    np.save(place / "waves.npy", 1e-7 * (np.cos(x)[:, None] * np.cos(x) + 0.3 * np.cos(3 * x + 1)))
    sets = [f"geometry.surface={place / 'waves.npy'}", "geometry.spacing=1um"]
    return [f"{SCENES}/{name}.toml", *(word for text in sets for word in ("--set", text))]


@pytest.fixture(scope="module")
def compared(request, tmp_path_factory):
    """Text, entries and page of a comparison of the models that run in this process, each run once."""
    place = tmp_path_factory.mktemp("compared")
    command = "compare", *words_of(request.param, place), "--out", place / "study"
    with pytest.MonkeyPatch.context() as patch:
        inside = tuple(model for model in models() if not model.outside)
        patch.setattr(compare, "models", partial(of_kind, inside))
        text = run(*command)
        printed = json.loads(run(*command, "--json").splitlines()[-1])
    return text, printed, (place / "study" / "report.html").read_text(encoding="utf-8")


def run(*arguments):
    found = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert found.exit_code in (0, NOT_CONVERGED), found.output
    return found.stdout


def statements(text, titles):
    """The amounts that a text states, by model and title."""
    found = defaultdict(set)
    any_title = "|".join(map(re.escape, sorted(titles, key=len, reverse=True)))
    for model, rest in re.findall(r"(?:errors of |warning: |⚠ \w+: )(\w+)(?: has a large error here)?: (.*)", text):
        for title, amount in re.findall(rf"\b({any_title}) ({AMOUNT})", rest):
            found[model, title].add(amount)
    for title, model, amount in re.findall(
        rf"^(?:warning: )?({any_title}) \S.*? by (\w+); (?:not )?enough for [^:]*: error ({AMOUNT})", text, re.MULTILINE
    ):
        found[model, title].add(amount)
    for title, model, amount in re.findall(
        rf"^({any_title}) \S.*?; (\w+) is (?:not )?enough for [^:]*: error ({AMOUNT})", text, re.MULTILINE
    ):
        found[model, title].add(amount)
    return found


def merged(*parts):
    found = defaultdict(set)
    for part in parts:
        for key, amounts in part.items():
            found[key] |= amounts
    return found


def of_result(entries, titles):
    """The amounts of a result as JSON holds it, checked against its plain numbers."""
    stated = {name: StatedError(**one) for name, one in entries["provenance"]["errors"].items()}
    assert entries["expected_error"] == pytest.approx({name: one.error for name, one in stated.items()})
    return {(entries["model"], titles[name]): {one.amount} for name, one in stated.items()}


def contradictions(found):
    return {key: amounts for key, amounts in found.items() if len(amounts) != 1}


@pytest.mark.parametrize("name", [*SMOOTH, *ROUGH])
def test_advice_and_solution_state_one_error_for_a_model_and_a_quantity(name, tmp_path):
    scene = words_of(name, tmp_path)
    advised, printed = run("advise", *scene), json.loads(run("advise", *scene, "--json"))
    entries = json.loads(run("solve", *scene, "--json").splitlines()[-1])
    titles = kind_of_name(entries["provenance"]["scene"]["kind"]).titles
    title = titles[printed["want"]]
    by_lines = re.findall(
        rf"^(\w+): (?:chosen|not enough|not needed): error ({AMOUNT}) {SOURCE}", advised, re.MULTILINE
    )
    by_rows = re.findall(rf"^(\w+) +\d+ +\S+ +({AMOUNT})  ", advised, re.MULTILINE)
    last = re.findall(
        rf"(\w+)(?:, resolution \d+:| comes nearest,) error ({AMOUNT}) {SOURCE}", advised.splitlines()[-1]
    )
    by_json = {(one["model"], StatedError(**one["error"]).amount) for one in printed["considered"] if one["error"]}
    assert last
    assert by_rows
    found = defaultdict(set)
    for model, amount in [*by_lines, *by_rows, *last, *by_json]:
        found[model, title].add(amount)
    found = {key: amounts for key, amounts in found.items() if amounts != {"unknown"}}
    found = merged(found, of_result(entries, titles), statements(run("solve", *scene), titles))
    assert (entries["model"], title) in found
    assert contradictions(found) == {}


@pytest.mark.parametrize("compared", ["pocket", "parabolic_slider", "dry_contact"], indirect=True)
def test_table_page_and_json_of_a_comparison_state_one_error_for_a_model_and_a_quantity(compared):
    text, printed, page = compared
    kind = kind_of_name(printed["provenance"]["scene"]["kind"])
    found = merged(*(of_result(entries, kind.titles) for entries in printed["models"]), statements(text, kind.titles))
    rows = defaultdict(set)
    table = text[text.index("errors measured against") :].partition("\n\n")[0]
    for row in re.findall(r"^\w+  .*", table.partition("──\n")[2], re.MULTILINE):
        model, _cpu, *amounts = re.split(r"\s{2,}", row.strip())
        for title, amount in zip(kind.compared.values(), amounts, strict=False):
            rows[model, title].add(amount)
    assert {model for model, _ in rows} == {entries["model"] for entries in printed["models"]}
    lines = re.sub(r"<[^>]*>", "", page)
    found = merged(found, rows, statements(lines, kind.titles))
    assert contradictions(found) == {}
    shown = errors_of_page(page)
    for key in rows:
        assert found[key] == {"unknown"} or shown[key] in found[key], key


def names_of_page(page):
    """The models in the order of the columns of the table."""
    head = re.search(r'<table class="models">(.*?)</tr>', page, re.DOTALL)[1]
    return [re.sub(r"<[^>]*>", "", one) for one in re.findall(r"<th[ >].*?</th>", head, re.DOTALL)][1:]


def errors_of_page(page):
    """The errors in the table of the models, by model and title."""
    part = page[page.index("± its own error") : page.index("effects that a model includes")]
    found = {}
    for row in re.findall(r"<tr><td>(.*?)</tr>", part, re.DOTALL):
        title, *cells = re.findall(r"(.*?)</td>(?:<td[^>]*>)?", row)
        for model, cell in zip(names_of_page(page), cells, strict=True):
            text = re.sub(r"<[^>]*>", "", cell.replace("<small>", " ")).replace("\xa0", " ")
            found[model, title] = text.removeprefix(" ± ")
    return found


def bound(amount):
    """The bound in per cent of an amount |difference| ± uncertainty."""
    return sum(abs(float(part)) for part in re.findall(r"[\d.e-]+(?= %)", amount))


@pytest.mark.parametrize("compared", ["pocket"], indirect=True)
def test_the_page_names_the_cheapest_model_whose_column_is_within_the_tolerance(compared):
    _, printed, page = compared
    cheapest = re.search(r"The cheapest model within 5 % [^.]*? is <b>(\w+)</b>", page)[1]
    assert cheapest == printed["cheapest_within_5_percent"]
    costs = {one["model"]: one["numerics"]["cpu_s"] for one in printed["models"]}
    assert names_of_page(page) == sorted(costs, key=costs.get)
    within = [
        one["model"]
        for one in printed["models"]
        if all(
            bound(StatedError(**one["provenance"]["errors"][name]).amount) <= 5
            for name in ("load_plus", "friction_plus")
        )
    ]
    assert cheapest == min(within, key=costs.get)
