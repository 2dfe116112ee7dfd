"""A fitted description as a TOML file with comments."""

from collections.abc import Mapping, Sequence
from typing import Any

from roughfilm.contact.foundation.toml import toml_value
from roughfilm.contact.foundation.writing.kinds import beginning_with
from roughfilm.contact.synthetic.description import RandomField, description_entries

BEGINS = "# A random field fitted by roughfilm fit.\n"
"""First line of the file, by which it is recognised."""

DESCRIPTION = beginning_with("a description of roughfilm fit", BEGINS.encode())
"""The kind of the file."""

COMMENTS = {
    "spectrum": "mean power of single waves by their wave numbers, decibels: rows n of waves_y, columns -m and m of "
    "waves_x",
    "population": "how windows differ; octaves: decibels of the power from the longest waves on; heights: over the rms "
    "height, at normal scores",
    "population.modes": "independent changes between windows of one standard deviation: decibels of octaves, "
    "square roots of the steps between heights",
}
"""The comment of each table."""


def description_text(description: RandomField, notes: Sequence[str] = ()) -> str:
    """The TOML file of a fitted random field, with notes as comments at its beginning; `read_description` reads it."""
    entries = description_entries(description)
    plain = {key: value for key, value in entries.items() if not isinstance(value, Mapping)}
    lines = [BEGINS.rstrip("\n"), *(f"# {note}" for note in notes), *_keys(plain)]
    for name in ("spectrum", "population"):
        table = dict(entries[name])
        modes = table.pop("modes", [])
        lines += ["", f"# {COMMENTS[name]}", f"[{name}]", *_keys(table)]
        for number, mode in enumerate(modes):
            lines += ["", *([f"# {COMMENTS[f'{name}.modes']}"] if number == 0 else []), f"[[{name}.modes]]"]
            lines += _keys(mode)
    return "\n".join(lines) + "\n"


def _keys(table: Mapping[str, Any]) -> list[str]:
    lines = []
    for key, value in table.items():
        if isinstance(value, list) and value and isinstance(value[0], list):
            lines += [f"{key} = [", *(f"    {toml_value(row)}," for row in value), "]"]
        else:
            lines.append(f"{key} = {toml_value(value)}")
    return lines
