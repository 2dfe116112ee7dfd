"""Output files that a command writes bit by bit: checked before, and held against other processes."""

import os
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import locked, replacing
from roughfilm.contact.foundation.writing.kinds import Kind, OtherKindError
from roughfilm.contact.foundation.writing.scratch import sweep


class _OnlyTriedError(Exception):
    """Leaves a file unwritten."""


def refuse_unwritable(*targets: tuple[Path | None, Kind], overwrite: bool | None = None) -> None:
    """Raise InputError if one of the files cannot be written, or is of another kind; nothing is written.

    Parameters
    ----------
    targets : files, or None for one that is not wanted, with their kinds.
    overwrite : whether files of another kind are replaced; None if the command has no such option.
    """
    for path, kind in targets:
        if path is not None:
            try:
                with suppress(_OnlyTriedError), replacing(path, kind, overwrite=bool(overwrite)):
                    raise _OnlyTriedError
            except OtherKindError as error:
                if overwrite is None:
                    raise
                raise InputError(f"{error}, or give --overwrite") from error


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
def replacing_together(*targets: tuple[Path | None, Kind], overwrite: bool) -> Iterator[list[Path | None]]:
    """Yield a path to write for each file, None for one that is not wanted; all are renamed into place at the end.

    Parameters
    ----------
    targets : files, or None for one that is not wanted, with their kinds.
    overwrite : whether files of another kind are replaced.
    """
    with ExitStack() as stack:
        yield [
            None if path is None else stack.enter_context(replacing(path, kind, overwrite=overwrite))
            for path, kind in targets
        ]


@contextmanager
def alone(out: Path | None, what: str) -> Iterator[None]:
    """Lock a file into which ``what`` is written against other processes."""
    if out is None:
        yield
        return
    message = f"--out {out}: another {what} goes into it (process {{process}}); wait for it or choose another place"
    with locked(out.with_name(f".{out.name}.lock"), message):
        sweep(out.parent)
        yield
