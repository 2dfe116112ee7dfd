"""The directory of a batch, with a subdirectory for each case and a lock against other batches."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roughfilm.contact.foundation.files import locked, replacing
from roughfilm.contact.foundation.writing.kinds import beginning_with
from roughfilm.contact.foundation.writing.scratch import scratch_directory, sweep
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
        with replacing(path, beginning_with("a scene", b"")) as scratch:
            scratch.write_text(as_toml(case.scene), encoding="utf-8")


@contextmanager
def alone(out: Path) -> Iterator[Path]:
    """Lock the directory of a batch against other batches and yield an empty directory for temporary files.

    The lock ends with this process. Raises InputError if another process holds it.
    """
    message = f"{out}: another batch works here (process {{process}}); wait for it or choose another place"
    with locked(out / ".lock", message):
        for directory in (out, *places(out).values()):
            sweep(directory)
        with scratch_directory() as scratch:
            yield scratch
