"""The table of the error laws as a TOML file."""

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.toml import toml_value
from roughfilm.contact.foundation.writing.kinds import beginning_with
from roughfilm.rom.advice import laws
from roughfilm.rom.advice.laws import Law, Table

OWN_FILE = Path(laws.__file__).with_name(laws.TABLE)
"""The file of this project."""

LAWS = beginning_with("a table of laws", b"# Made by programs")


def write_table(table: Table, path: Path) -> None:
    """Write a table of laws, whole or not at all."""
    lines = ["# Made by programs, see provenance: errors that 95 of 100 random scenes did not exceed", "[provenance]"]
    lines += [f"{key} = {toml_value(value)}" for key, value in table.provenance.items()]
    for name, entries in (("step", table.steps), ("promise", table.promises), ("grid", table.grids)):
        for entry in entries:
            lines += ["", f"[[{name}]]", *_lines(vars(entry))]
    with replacing(path, LAWS) as scratch_file:
        scratch_file.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _lines(entries: Mapping[str, Any]) -> list[str]:
    lines = []
    for key, value in entries.items():
        if isinstance(value, Mapping):
            lines += [f"{key}.{quantity} = {toml_value(_plain(law))}" for quantity, law in value.items()]
        elif value:
            lines.append(f"{key} = {toml_value(value)}")
    return lines


def _plain(law: Law) -> dict[str, Any]:
    entries = {**asdict(law), "terms": [asdict(term) for term in law.terms], "within": list(law.within)}
    return {name: value for name, value in entries.items() if value or name != "within"}


def text_of(law: Law) -> str:
    """Return the sum of a law in words."""
    return " + ".join(
        " · ".join([f"{term.coefficient:g}", *(f"{number}^{power:g}" for number, power in term.powers.items())])
        for term in law.terms
    )
