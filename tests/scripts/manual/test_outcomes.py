"""Outcomes of programs of the gallery: kept for the present code alone, and as a program gives them."""

import os
import warnings
from types import MappingProxyType, SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest

from scripts.manual import outcomes
from scripts.manual.outcomes import GALLERY, Outcome, apart, keep, kept_outcome, outcome

PROGRAM = GALLERY / "seals" / "lay.py"


@pytest.fixture
def found():
    """The outcome of a program with a figure, a module and arrays that is not there."""
    _, ax = plt.subplots(figsize=(6, 4))
    ax.plot([0, 1], [0, 1], label="a line")
    ax.set(xlabel="x (m)", ylabel="y (m)")
    ax.legend(loc="center")
    values = {
        "np": np,
        "ax": ax,
        "axes": np.array([ax]),
        "load": np.linspace(0, 1, 5),
        "names": MappingProxyType({"a": 1}),
    }
    yield outcome(PROGRAM, values)
    plt.close("all")


def test_a_kept_outcome_has_the_values_and_figures_of_the_program(found, tmp_path):
    keep(PROGRAM, found, tmp_path)
    again = kept_outcome(PROGRAM, tmp_path)
    assert again.figures == found.figures
    assert again.figures[0].labels == ("x (m)", "y (m)")
    assert again.figures[0].covered == ("a line",)
    assert again.left == frozenset()
    assert set(again.values) == {"load", "names"}
    assert again.values["names"] == {"a": 1}
    assert (again.values["load"] == found.values["load"]).all()
    assert plt.get_fignums() == [1]


def test_outcomes_of_other_code_are_not_read(found, tmp_path, monkeypatch):
    assert kept_outcome(PROGRAM, tmp_path) is None
    keep(PROGRAM, found, tmp_path)
    monkeypatch.setattr(outcomes, "digest", lambda: "of other code")
    assert kept_outcome(PROGRAM, tmp_path) is None


def test_nothing_is_kept_where_a_value_cannot_be_stored(found, tmp_path):
    keep(PROGRAM, found, tmp_path)
    keep(PROGRAM, Outcome(values={"law": lambda x: x}, figures=(), left=frozenset()), tmp_path)
    assert kept_outcome(PROGRAM, tmp_path) is None


@pytest.mark.usefixtures("found")
def test_the_outcome_of_the_last_part_of_a_program_is_kept_with_the_figures_of_all(tmp_path, monkeypatch):
    monkeypatch.setattr(outcomes, "KEPT", tmp_path)
    part = {"src_file": str(PROGRAM), "example_globals": {"load": 1.0}}
    apart(None, str(PROGRAM), "before")
    try:
        assert outcomes.scraper(None, part, None) == ""
        plt.close("all")
        plt.subplots(figsize=(5, 4))
        outcomes.scraper(None, part | {"example_globals": {"load": 2.0}}, None)
    finally:
        apart(None, str(PROGRAM), "after")
    again = kept_outcome(PROGRAM, tmp_path)
    assert again.values == {"load": 2.0}
    assert [figure.width for figure in again.figures] == [6, 5]


def test_programs_run_with_an_empty_cache_and_warnings_as_errors(monkeypatch):
    monkeypatch.setenv(outcomes.CACHE, "that of the user")
    warnings.simplefilter("default")
    before = list(warnings.filters)
    apart(SimpleNamespace(), "a program", "before")
    place = os.environ[outcomes.CACHE]
    assert os.listdir(place) == []
    with pytest.raises(UserWarning, match="a remark"):
        warnings.warn("a remark", stacklevel=1)
    apart(SimpleNamespace(), "a program", "after")
    assert not os.path.exists(place)
    assert os.environ[outcomes.CACHE] == "that of the user"
    assert warnings.filters == before
