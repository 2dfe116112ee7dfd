"""The skeleton of the studies: kept results, entries of JSON, and a page with its claims."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from scripts.studies.study import Claim, kept, plain, publish


def test_what_is_kept_is_made_once_for_the_same_inputs(tmp_path):
    path, made_times = tmp_path / "one.json", []

    def make():
        made_times.append(1)
        return {"value": 2.5}

    for inputs in ({"a": 1}, {"a": 1}, {"a": 2}):
        assert kept(path, inputs, make) == {"value": 2.5}
    assert len(made_times) == 2
    path.write_text("{", encoding="utf-8")
    kept(path, {"a": 2}, make)
    assert len(made_times) == 3


def test_nothing_is_kept_without_a_file():
    assert kept(None, {}, lambda: np.arange(2)) == [0, 1]


@dataclass
class Nested:
    """Entries of several kinds."""

    values: np.ndarray
    rows: tuple


def test_entries_of_json_have_lists_for_arrays_and_null_for_what_is_no_number():
    nested = Nested(values=np.array([1.0, np.nan]), rows=({0.5: np.float64(2)}, float("inf")))
    assert plain({"one": nested, 2: "text"}) == {
        "one": {"values": [1.0, None], "rows": [{"0.5": 2.0}, None]},
        "2": "text",
    }


def test_a_study_is_a_page_its_figures_and_its_numbers(tmp_path, capsys):
    folder = tmp_path / "small"
    folder.mkdir()
    template = """{% extends "study.html.j2" %}{% block title %}Small & round{% endblock %}
{% block content %}{{ plots["a b"] | safe }}{{ captions["a b"] }}{% endblock %}"""
    (folder / "page.html.j2").write_text(template, encoding="utf-8")
    for name in ("study.html.j2", "claims.html.j2"):
        source = Path(__file__).parents[3] / "scripts" / "studies" / name
        (tmp_path / name).write_text(source.read_text(encoding="utf-8"), encoding="utf-8")
    claim = Claim(number=7, text="It is small", verdict="partly", evidence="1 < 2")
    (folder / "study.toml").write_text('captions = {"a b" = "A figure."}', encoding="utf-8")
    for as_json in (False, True):
        publish(
            folder,
            tmp_path / "out",
            {"a b": Figure()},
            {"value": np.inf},
            claims=[claim],
            tables=["first"],
            as_json=as_json,
        )
        printed = capsys.readouterr().out
        if as_json:
            assert json.loads(printed)["claims"][0]["verdict"] == "partly"
        else:
            assert printed.splitlines()[:2] == ["first", "7. It is small: partly; 1 < 2"]
    page = (tmp_path / "out" / "small.html").read_text(encoding="utf-8")
    assert "1 &lt; 2" in page
    assert "A figure." in page
    assert "All numbers are in small.json" in page
    assert (tmp_path / "out" / "a_b.svg").is_file()
    assert json.loads((tmp_path / "out" / "small.json").read_text(encoding="utf-8"))["value"] is None
