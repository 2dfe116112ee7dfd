"""The command cache: what is kept, what it takes, and its removal."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from roughfilm.cli.main import app
from roughfilm.contact.foundation import cache
from roughfilm.rom.homogenization.table.kept import kept_table, table_inputs
from roughfilm.rom.homogenization.table.tabulate import tabulate
from roughfilm.rom.ladder.model import silent


def run(*arguments):
    return CliRunner().invoke(app, ["cache", *arguments])


def keep_table(amplitude: float) -> None:
    x = 2 * np.pi * np.arange(12) / 12
    heights, spacing = amplitude * np.add.outer(np.cos(x), np.sin(x)), (1e-5, 1e-5)
    kept_table(
        table_inputs(heights, spacing, "rom.homogenization.table.tabulate", tolerance=0.05),
        lambda known, keep: tabulate(heights, spacing, tolerance=0.05, known=known, keep=keep),
        about={"surface": f"egg box of {1e6 * amplitude:g} um", "kind": "flow factors"},
        progress=silent,
    )


def test_an_empty_cache_has_its_place_and_no_entries():
    assert json.loads(run("--json").stdout)["entries"] == []
    assert "0 entries" in run().stdout


def test_entries_are_shown_with_what_they_hold_and_removed():
    keep_table(1e-6)
    keep_table(2e-6)
    shown = run().stdout
    assert "egg box of 1 um" in shown
    assert "egg box of 2 um" in shown
    found = json.loads(run("--json").stdout)
    assert found["directory"] == str(cache.user_directory())
    assert {entry["kind"] for entry in found["entries"]} == {"flow factors"}
    assert all(entry["points"] > 2 for entry in found["entries"])
    assert found["size"] == sum(entry["size"] for entry in found["entries"])
    assert "removed: 2 entries" in run("--clear").stdout
    assert json.loads(run("--json").stdout)["entries"] == []


def test_a_limit_keeps_what_was_used_last():
    keep_table(1e-6)
    keep_table(2e-6)
    keep_table(1e-6)  # the one of 2 µm is now unused for longer
    (one, other) = cache.entries()
    found = json.loads(run("--limit", f"{max(one.size, other.size)}B", "--json").stdout)
    assert [entry["surface"] for entry in found["entries"]] == ["egg box of 1 um"]
    assert len(found["removed"]) == 1


def test_a_damaged_entry_is_named_so():
    keep_table(1e-6)
    (entry,) = cache.entries()
    entry.path.write_bytes(b"no table")
    (found,) = json.loads(run("--json").stdout)["entries"]
    assert found["kind"] == "damaged"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--limit", "3x"], "--limit: got '3x'; give a size of 0 or more"),
        (["--limit", "-1MB"], "--limit: got '-1MB'"),
        (["--limit", "nan"], "--limit: got 'nan'"),
        (["--limit", "1MB", "--clear"], "--limit: leaves a part and --clear nothing"),
    ],
)
def test_bad_options_are_one_line(arguments, words):
    result = run(*arguments)
    assert result.exit_code == 2
    assert words in result.stderr
