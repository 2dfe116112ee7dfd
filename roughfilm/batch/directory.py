"""The directory of a batch: a place for each case, one batch at a time, nothing left over from one that was killed."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roughfilm.contact.foundation.files import locked, replacing
from roughfilm.rom.studies.study import Case, as_toml

CASES = "cases"
LOCK = ".lock"
SCRATCH = ".scratch"


def places(out: Path) -> dict[str, Path]:
    """The directory of every case that has one, by the digest of its scene.

    A case keeps its directory when a study grows and other keys begin to vary.
    """
    cases = out / CASES
    return {path.name.rpartition("-")[2]: path for path in cases.iterdir()} if cases.is_dir() else {}


def put_scene(case: Case, directory: Path) -> None:
    """Write the complete scene of a case, once."""
    path = directory / "scene.toml"
    if not path.is_file():
        with replacing(path) as scratch:
            scratch.write_text(as_toml(case.scene), encoding="utf-8")


@contextmanager
def alone(out: Path) -> Iterator[Path]:
    """Hold the directory against any other batch and yield a place for temporary files, empty.

    The lock ends with this process, however it ends. Raises InputError if another process holds it.
    """
    told = f"out {out}: another batch works here (process {{process}}); wait for it or choose another place"
    with locked(out / LOCK, told):
        scratch = out / SCRATCH
        _tidy(out)
        scratch.mkdir(exist_ok=True)
        try:
            yield scratch.resolve()
        finally:
            shutil.rmtree(scratch, ignore_errors=True)


def _tidy(out: Path) -> None:
    """Remove what a batch that was killed could not: temporary files, and files that were being written."""
    shutil.rmtree(out / SCRATCH, ignore_errors=True)
    for path in [*out.glob(".table-*"), *(out / CASES).glob("*/.*")]:
        path.unlink(missing_ok=True)
