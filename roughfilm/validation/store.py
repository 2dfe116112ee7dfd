"""The answers of the sources: each is kept in a file as soon as it is complete, and used again by the same code."""

import hashlib
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.regular import read_bytes
from roughfilm.contact.foundation.timing import working_time
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.provenance import code, versions
from roughfilm.validation.published import Answer, Source

MAX_BYTES = 10_000_000
"""Largest size of a kept answer that is read, bytes."""


@dataclass(frozen=True, kw_only=True)
class Kept:
    """An answer with what made it.

    Attributes
    ----------
    identity : digests of the code and the tables, versions, and whether the finest grids were taken.
    created : time at which it was complete.
    cpu_s : CPU time, s.
    """

    identity: dict[str, Any]
    created: str
    cpu_s: float
    answer: Answer


@cache
def _digest() -> str:
    """A digest of the modules and tables of this folder."""
    folder = Path(__file__).parent
    digest = hashlib.sha256()
    for path in sorted(path for path in folder.rglob("*") if path.suffix in (".py", ".csv", ".toml")):
        digest.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def identity(thorough: bool) -> dict[str, Any]:
    """What an answer depends on."""
    return {"code": code(), "validation": _digest(), "versions": versions(), "thorough": thorough}


def answered(source: Source, path: Path, *, thorough: bool, progress: Progress) -> Kept:
    """The answer of a source, from the file if the same code made it, else computed and written there.

    Raises
    ------
    InputError
        If the file cannot be written.
    ConvergenceError
        If a model does not converge.
    """
    known = _known(path)
    if known is not None and known.identity == identity(thorough):
        return known
    begun = working_time()
    answer = source.answer(thorough, progress)
    kept = Kept(
        identity=identity(thorough),
        created=datetime.now(UTC).isoformat(timespec="seconds"),
        cpu_s=working_time() - begun,
        answer=answer,
    )
    write_json(asdict(kept), path)
    return kept


def _known(path: Path) -> Kept | None:
    try:
        return from_json(read_bytes(path, MAX_BYTES, "answer again"), Kept)
    except (OSError, ValueError):
        return None
