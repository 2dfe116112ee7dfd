"""Output files that a command writes bit by bit: checked before, and held against other processes."""

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from glob import escape
from pathlib import Path

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import locked, replacing


class _OnlyTriedError(Exception):
    """Leaves a file unwritten."""


def refuse_unwritable(*paths: Path | None) -> None:
    """Raise InputError if one of the files cannot be written; nothing is written."""
    for path in filter(None, paths):
        with suppress(_OnlyTriedError), replacing(path):
            raise _OnlyTriedError


def refuse_same(named: Mapping[str, Path | None]) -> None:
    """Raise InputError if ``--out`` or ``--report`` is the same file as one named before it."""
    seen: dict[str, str] = {}
    for name, path in named.items():
        if path is None:
            continue
        place = os.path.realpath(os.path.expanduser(path))
        if name in ("--out", "--report") and place in seen:
            raise InputError(f"{name} {path}: is the same file as {seen[place]}; choose another place")
        seen[place] = name


@contextmanager
def alone(out: Path | None, what: str) -> Iterator[None]:
    """Lock a file into which ``what`` is written against other processes, and remove what a killed one left."""
    if out is None:
        yield
        return
    message = f"--out {out}: another {what} goes into it (process {{process}}); wait for it or choose another place"
    with locked(out.with_name(f".{out.name}.lock"), message):
        for left in out.parent.glob(f".{escape(out.stem)}-????????{escape(out.suffix)}"):
            left.unlink(missing_ok=True)
        yield
