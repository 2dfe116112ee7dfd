"""roughfilm cache: the tables of surfaces and series of leakage that are kept for later runs."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import Annotated, Any

import typer
from rich.table import Table

from roughfilm.contact.foundation.cache import LIMIT_BYTES, Entry, entries, trim, user_directory
from roughfilm.contact.foundation.checked_hdf5 import has_mark
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.homogenization.table.store import MARK as TABLE_MARK
from roughfilm.rom.homogenization.table.store import kept_part
from roughfilm.rom.seal.leakage.series import kept_rows
from roughfilm.terminal.console import AsJson, print_json
from roughfilm.terminal.results import print_all, table_of

EXAMPLES = ("roughfilm cache", "roughfilm cache --limit 500MB", "roughfilm cache --clear")

PREFIXES = {"": 1, "k": 10**3, "M": 10**6, "G": 10**9}
"""Factors of the prefixes of a size."""


@dataclass(frozen=True, kw_only=True)
class Described:
    """What an entry holds: the ``surface`` by its name, the ``kind``, its ``points``, and the CPU time it took, s."""

    surface: str
    kind: str
    points: int | None = None
    cpu_s: float | None = None


def command(
    clear: Annotated[bool, typer.Option("--clear", help="Remove all entries.")] = False,
    limit: Annotated[
        str | None,
        typer.Option(metavar="SIZE", help="Remove the entries unused for longest until SIZE is left, e.g. 500MB."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Show what is kept for later runs, tables of surfaces and series of leakage, or remove it."""
    if clear and limit is not None:
        raise InputError("--limit: leaves a part and --clear nothing; give one of them")
    place, removed = user_directory(), []
    if clear or limit is not None:
        removed = trim(0 if limit is None else _bytes(limit))
    left = [(entry, _described(entry)) for entry in reversed(entries())]
    if as_json:
        print_json(
            {
                "directory": str(place),
                "limit": LIMIT_BYTES,
                "size": sum(entry.size for entry, _ in left),
                "removed": [entry.path.name for entry in removed],
                "entries": [_entry(entry, described) for entry, described in left],
            }
        )
    else:
        print_all(_shown(str(place), left, removed))


def _shown(place: str, left: list[tuple[Entry, Described]], removed: list[Entry]) -> Iterator[Table | str]:
    """The entries for people, the one used last first, and what they take."""
    if left:
        yield table_of(
            ("surface", "kind", "size", "CPU s", "last used"),
            [
                (
                    described.surface,
                    described.kind,
                    _size(entry.size),
                    "" if described.cpu_s is None else f"{described.cpu_s:.3g}",
                    f"{datetime.fromtimestamp(entry.use):%Y-%m-%d %H:%M}",
                )
                for entry, described in left
            ],
            left=2,
        )
    if removed:
        yield f"removed: {len(removed)} entries, {_size(sum(entry.size for entry in removed))}"
    size = _size(sum(entry.size for entry, _ in left))
    yield f"{place}: {len(left)} entries, {size} of at most {_size(LIMIT_BYTES)}"


def _entry(entry: Entry, described: Described) -> Mapping[str, Any]:
    return {"file": str(entry.path), "size": entry.size, "last_used": entry.use, **vars(described)}


def _described(entry: Entry) -> Described:
    """What an entry holds; a damaged one is removed when it is needed."""
    try:
        if has_mark(entry.path, TABLE_MARK):
            table, making = kept_part(entry.path)
            kind = making.kind + ("" if making.complete else ", unfinished")
            return Described(surface=making.surface, kind=kind, points=len(table.points), cpu_s=making.cpu_s)
        rows, surface = kept_rows(entry.path)
        kind = "leakage by load" if rows else "sealing loads"
        return Described(surface=surface, kind=kind, points=len(rows), cpu_s=sum(row.cpu_s for row in rows) or None)
    except InputError:
        return Described(surface="", kind="damaged")


def _size(count: int) -> str:
    """A number of bytes with a prefix."""
    prefix = next((prefix for prefix in "GMk" if count >= PREFIXES[prefix]), "")
    return f"{count / PREFIXES[prefix]:.3g} {prefix}B"


def _bytes(text: str) -> int:
    """The number of bytes of a text such as "500MB"; InputError for any other."""
    number = text.strip().removesuffix("B")
    prefix = number[-1:] if number[-1:] in PREFIXES else ""
    try:
        count = float(number.removesuffix(prefix))
    except ValueError:
        count = -1.0
    if not 0 <= count < 1e9:
        raise InputError(f"--limit: got {text!r}; give a size of 0 or more, such as 500MB or 2GB")
    return round(count * PREFIXES[prefix])
