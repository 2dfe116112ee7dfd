"""Pages of examples that take long: kept with their output, so that a build of the manual does not run them.

A kept page holds the digest of its program. Sphinx-Gallery takes the page as it is while the digest is right, and
otherwise shows the program without output, of which :func:`outdated` reports to the build.
"""

import hashlib
import shutil
import zipfile
from collections.abc import Iterator
from pathlib import Path

BEGINNING = "long_"
"""The beginning of the names of examples that take long."""


def restore(kept: Path, gallery: Path, examples: Path) -> None:
    """Copy the kept pages and pictures, and their programs for download, into the gallery before it is built."""
    shutil.copytree(kept, gallery, dirs_exist_ok=True)
    for program in examples.rglob(f"{BEGINNING}*.py"):
        copy = gallery / program.relative_to(examples)
        shutil.copy2(program, copy)
        with zipfile.ZipFile(copy.with_suffix(".zip"), "w") as archive:
            archive.write(copy, copy.name)


def keep(gallery: Path, kept: Path) -> None:
    """Keep the pages and pictures of the examples that take long, from a gallery for which they were run."""
    shutil.rmtree(kept, ignore_errors=True)
    for path in sorted(gallery.rglob("*")):
        ours = path.stem.startswith((BEGINNING, f"sphx_glr_{BEGINNING}"))
        if ours and path.suffix in (".rst", ".md5", ".png"):
            target = kept / path.relative_to(gallery)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, target)


def outdated(examples: Path, kept: Path) -> Iterator[str]:
    """The examples that take long and have no kept page, or one of another program.

    Parameters
    ----------
    examples : folder of the programs.
    kept : folder of the kept pages, with the same folders below it.
    """
    for program in sorted(examples.rglob(f"{BEGINNING}*.py")):
        digest = (kept / program.relative_to(examples)).with_suffix(".py.md5")
        text = program.read_text(encoding="utf-8")
        if not digest.exists() or digest.read_text() != hashlib.md5(text.encode(), usedforsecurity=False).hexdigest():
            yield str(program.relative_to(examples))
