"""The study of the isoviscous limit, on two rows of its tables."""

import json
from itertools import islice

from roughfilm.validation.isoviscous import IsoviscousLimit, table_rows
from scripts.studies.isoviscous import __main__ as study


def test_each_row_is_kept_and_counted(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(study, "table_rows", lambda: islice(table_rows(), 2))
    study.command(tmp_path / "out", cells=8)
    kept = json.loads((tmp_path / "out" / "isoviscous.json").read_text())
    assert [row["case"] for row in kept["rows"]] == ["ε = 0.1, B/D = 1", "ε = 0.1, B/D = 0.5"]
    limits = [row[model] for row in kept["rows"] for model in kept["models"]]
    assert [one["changed"] for one in limits] == [[]] * 4
    assert "adiabatic" in capsys.readouterr().out


def test_rows_are_counted_by_their_outcome():
    limits = [
        IsoviscousLimit(compared=3),
        IsoviscousLimit(compared=3, changed=("load",)),
        IsoviscousLimit(reason="no film"),
    ]
    found = [(row, {"adiabatic": limit}) for row, limit in zip(islice(table_rows(), 3), limits, strict=True)]
    assert study.cells_of(found) == [("butenschoen", "adiabatic", "3", "1", "1", "1", "6")]
