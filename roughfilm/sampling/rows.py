"""Rows of finished windows on disk: each is stored when it is finished, and used again while nothing changes."""

import hashlib
import json
import logging
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

from roughfilm.batch.jobs import Failure
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.regular import read_bytes
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.ladder.provenance import code, imported_code, versions
from roughfilm.rom.parts.surface_geometry import digest_of
from roughfilm.sampling.asked import Asked
from roughfilm.sampling.quantities import Row

ROWS = "rows"
"""The directory of the rows in that of a set of windows."""

MAX_BYTES = 1_000_000
"""Largest size of a row that is read, bytes."""


@dataclass(frozen=True, kw_only=True)
class RowEntries:
    """The content of the file of a row; ``row_of`` is the identity of its window."""

    row_of: str
    quantities: Mapping[str, tuple[float, str, float | None]]
    warnings: tuple[str, ...]
    failure: Failure | None
    cpu_s: float


def identity_of(cell: Surface, asked: Asked) -> str:
    """A digest of all that determines a row: the cell, what is asked, the code and the versions of the libraries."""
    text = json.dumps([digest_of(cell), asked.digest, *_circumstances()], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


@cache
def _circumstances() -> tuple[str, str, Mapping[str, str]]:
    return code(), imported_code("roughfilm.sampling.quantities"), versions()


def row_path(directory: Path, identity: str) -> Path:
    """The file of a row."""
    return directory / ROWS / f"{identity}.json"


def _digest(entries: Mapping[str, Any]) -> str:
    """The SHA-256 digest of the entries of a row, without the time that it took."""
    lasting = {name: entry for name, entry in entries.items() if name != "cpu_s"}
    return hashlib.sha256(json.dumps(lasting, sort_keys=True).encode()).hexdigest()


def store_row(row: Row, identity: str, directory: Path) -> None:
    """Write a row, completely or not at all; InputError if it cannot be written.

    A failure that another run could avoid, such as a worker that died, is not stored.
    """
    if row.failure is not None and not row.failure.is_answer:
        return
    entries: dict[str, Any] = {
        "row_of": identity,
        "quantities": {name: [one.value, one.unit, one.uncertainty] for name, one in row.quantities.items()},
        "warnings": list(row.warnings),
        "failure": None if row.failure is None else asdict(row.failure),
        "cpu_s": row.cpu_s,
    }
    write_json(entries | {"digest": _digest(entries)}, row_path(directory, identity))


def stored_row(identity: str, directory: Path) -> Row | None:
    """The row of a window from its file; None if there is none, or, with a warning, if it is damaged or edited."""
    path = row_path(directory, identity)
    if not path.is_file():
        return None
    try:
        text = read_bytes(path, MAX_BYTES, "start again")
        entries = from_json(text, RowEntries)
        given = json.loads(text)
        if entries.row_of != identity or given.pop("digest", "") != _digest(given):
            raise ValueError("the digest is another one")
    except (ValueError, InputError):
        logging.getLogger(__name__).warning("%s: was damaged or changed; its window is computed again", path)
        return None
    return Row(
        quantities={
            name: Quantity(value=value, unit=unit, uncertainty=uncertainty)
            for name, (value, unit, uncertainty) in entries.quantities.items()
        },
        warnings=tuple(entries.warnings),
        failure=entries.failure,
        cpu_s=entries.cpu_s,
    )


def remove_other_rows(identities: Iterable[str], directory: Path) -> None:
    """Remove the rows of windows that do not belong to the set any more."""
    kept = set(identities)
    for path in (directory / ROWS).glob("*.json"):
        if path.stem not in kept:
            path.unlink(missing_ok=True)
