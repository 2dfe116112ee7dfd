"""A file that a command writes bit by bit: whether it can be written, and nobody else writing it."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from glob import escape
from pathlib import Path

from roughfilm.contact.foundation.files import locked, replacing


class _OnlyTriedError(Exception):
    """Leaves a file unwritten."""


def refuse_unwritable(path: Path) -> None:
    """InputError if a file cannot be written there; nothing is."""
    with suppress(_OnlyTriedError), replacing(path):
        raise _OnlyTriedError


@contextmanager
def alone(out: Path | None, what: str) -> Iterator[None]:
    """Hold a file against another process that writes ``what`` into it, and remove what a killed one was writing."""
    if out is None:
        yield
        return
    told = f"--out {out}: another {what} goes into it (process {{process}}); wait for it or choose another place"
    with locked(out.with_name(f".{out.name}.lock"), told):
        for left in out.parent.glob(f".{escape(out.stem)}-????????{escape(out.suffix)}"):
            left.unlink(missing_ok=True)
        yield
