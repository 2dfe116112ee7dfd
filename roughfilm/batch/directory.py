"""The directory of a batch, with a subdirectory for each case and a lock against other batches."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roughfilm.contact.foundation.files import locked, replacing
from roughfilm.rom.studies.study import Case, as_toml

CASES = "cases"


def places(out: Path) -> dict[str, Path]:
    """The existing directories of cases by the digest of their scene.

    A case keeps its directory if more keys of the study are varied later.
    """
    cases = out / CASES
    return {path.name.rpartition("-")[2]: path for path in cases.iterdir()} if cases.is_dir() else {}


def put_scene(case: Case, directory: Path) -> None:
    """Write the complete scene of a case to ``scene.toml`` in its directory, unless the file exists."""
    path = directory / "scene.toml"
    if not path.is_file():
        with replacing(path) as scratch:
            scratch.write_text(as_toml(case.scene), encoding="utf-8")


@contextmanager
def alone(out: Path) -> Iterator[Path]:
    """Lock the directory of a batch against other batches and yield an empty directory for temporary files.

    The lock ends with this process. Raises InputError if another process holds it.
    """
    message = f"out {out}: another batch works here (process {{process}}); wait for it or choose another place"
    with locked(out / ".lock", message):
        scratch = out / ".scratch"
        shutil.rmtree(scratch, ignore_errors=True)  # left by a batch that was killed, as are the files
        for path in [*out.glob(".table-*"), *out.glob(".study-*"), *(out / CASES).glob("*/.*")]:
            path.unlink(missing_ok=True)
        scratch.mkdir(exist_ok=True)
        try:
            yield scratch.resolve()
        finally:
            shutil.rmtree(scratch, ignore_errors=True)
