"""The command ``validate``: its page, its files, what it keeps, and the chapter that is made of its tables."""

import json

import pytest
from places import ROOT
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.validation.listing import names
from roughfilm.validation.summary import COLUMNS

CHAPTER = ROOT / "docs" / "validation" / "published-numbers.md"


def run(*arguments):
    return CliRunner().invoke(app, ["validate", *map(str, arguments)])


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A directory in which two sources were compared, and the JSON that was printed."""
    place = tmp_path_factory.mktemp("validate")
    done = run("--source", "fowell", "--source", "hertz", "--out", place / "out", "--json")
    assert done.exit_code == 0, done.output
    return place / "out", json.loads(done.stdout)


def test_the_json_holds_every_number_with_its_verdict(place):
    out, entries = place
    assert json.loads((out / "validation.json").read_text()) == entries
    assert [one["name"] for one in entries["sources"]] == ["fowell", "hertz"]
    rows = [row for one in entries["sources"] for row in one["rows"]]
    assert len(rows) == 33
    assert entries["headline"].startswith("33 of 33 published numbers lie within")
    keys = {"published", "ours", "uncertainty", "bar", "relative_difference", "verdict", "unit", "quantity", "case"}
    assert all(keys <= row.keys() for row in rows)


def test_the_page_shows_the_answer_first_and_what_waits(place):
    page = (place[0] / "report.html").read_text()
    assert page.index("33 of 33 published numbers") < page.index("<h2>")
    assert page.count("<svg") == 2
    assert all(one in page[page.index("Not yet") :] for one in ("Mourier", "Freund"))


def test_the_tables_in_markdown_have_a_row_for_each_source(place):
    text = (place[0] / "validation.md").read_text()
    assert "| fowell | 21 | 21 | 0 | 0 |" in text
    assert [line for line in text.splitlines() if len(line) > 120 and not line.startswith("|")] == []


def test_complete_answers_are_used_again_unless_something_changed(place):
    out, entries = place
    created = {one["name"]: one["created"] for one in entries["sources"]}
    path = out / "answers" / "hertz.json"
    stored = json.loads(path.read_text())
    path.write_text(
        json.dumps({**stored, "identity": {**stored["identity"], "code": "other"}, "created": "2000"}, indent=1)
    )
    fowell = out / "answers" / "fowell.json"
    fowell.write_text(json.dumps({**json.loads(fowell.read_text()), "created": "2001"}, indent=1))
    done = run("--source", "fowell", "--source", "hertz", "--out", out, "--json")
    assert done.exit_code == 0, done.output
    again = json.loads(done.stdout)
    made = {one["name"]: one["created"] for one in again["sources"]}
    assert made["fowell"] == "2001"
    assert made["hertz"] >= created["hertz"]


def test_an_unknown_source_is_refused_in_one_line(tmp_path):
    done = run("--source", "nobody", "--out", tmp_path / "out")
    assert done.exit_code == 2
    assert done.stderr.startswith("error: --source: got 'nobody'; it must be one of bertocchi, ")
    assert not (tmp_path / "out").exists()


def test_a_letter_is_not_replaced(tmp_path):
    (tmp_path / "validation.md").write_text("Dear editor,\n")
    done = run("--source", "fowell", "--out", tmp_path)
    assert done.exit_code == 2
    assert (tmp_path / "validation.md").read_text() == "Dear editor,\n"


def test_the_chapter_keeps_the_table_of_all_sources():
    lines = [line.strip("| ").split(" | ") for line in CHAPTER.read_text().splitlines() if line.startswith("| ")]
    start = lines.index(list(COLUMNS))
    rows = lines[start + 2 : start + 2 + len(names())]
    assert [row[0] for row in rows] == names()
    for name, numbers, *counts, _, _ in rows:
        assert int(numbers) == sum(map(int, counts)), name
