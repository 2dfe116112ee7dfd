"""Write the directory of a case completely or not at all, with a README, a shell script and a card to read it by."""

import json
import math
from collections.abc import Callable
from dataclasses import asdict, fields
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from roughfilm.contact.foundation.errors import InputError, unwritable
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.regular import read_bytes
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.foamcases.openfoam.dialect import Dialect

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

CARD = "case.json"
"""Name of the card: the file of the options with which a case was written."""

REMEDY = "generate the case again"

MAX_CARD_BYTES = 1_000_000
"""Largest size of a card that is read, bytes."""

SomeCard = TypeVar("SomeCard", bound="DataclassInstance")

TOLERANCES = (1e-10, 1e-2)
"""Least and greatest tolerance allowed: the residual at which a run may end."""


def written_for(dialect: Dialect) -> str:
    """The paragraph of a README that says which OpenFOAM the case is for."""
    return f"\nThe case is written for {dialect.releases}; for another, write it again in the other dialect.\n"


def check_tolerance(tolerance: float) -> None:
    """Raise InputError for a tolerance outside ``TOLERANCES``."""
    least, most = TOLERANCES
    if not least <= tolerance <= most:
        raise InputError(f"tolerance: got {tolerance}; it must be {least:g} to {most:g}")


def write_whole(directory: Path, fill: Callable[[Path], None]) -> None:
    """Make a case directory completely or not at all.

    Parameters
    ----------
    directory : the directory to make; it may exist if it is empty.
    fill : fill(place), which writes the files of the case into a temporary directory.

    Raises
    ------
    InputError
        If the path contains a blank, the directory is not empty, or it cannot be written.
    """
    if any(map(str.isspace, str(directory.absolute()))):
        path = repr(str(directory.absolute()))
        raise InputError(f"{path}: OpenFOAM takes no blanks in a path; name another place, or set TMPDIR to one")
    try:
        if directory.exists() and (not directory.is_dir() or any(directory.iterdir())):
            raise InputError(f"{directory}: is not an empty directory; name another")
        directory.parent.mkdir(parents=True, exist_ok=True)
        with scratch_directory(beside=directory) as place:
            scratch = place / directory.name
            scratch.mkdir()
            fill(scratch)
            scratch.replace(directory)
    except OSError as error:
        raise unwritable(directory, error) from error


def write_papers(directory: Path, *, readme: str, allrun: str, card: "DataclassInstance") -> None:
    """Write the README, the shell script and the card of a case."""
    (directory / "README").write_text(readme, encoding="utf-8")
    (directory / "Allrun").write_text(allrun, encoding="utf-8")
    (directory / "Allrun").chmod(0o755)
    (directory / CARD).write_text(json.dumps(asdict(card), indent=1) + "\n", encoding="utf-8")


def read_card(directory: Path, kind: type[SomeCard]) -> SomeCard:
    """The card of a case, an object of the class ``kind``.

    Its numbers are finite and above 0; 0 is allowed where the metadata of the field say ``may_be_zero``.

    Raises InputError if the directory holds no such card.
    """
    try:
        card = from_json(read_bytes(directory / CARD, MAX_CARD_BYTES, REMEDY), kind)
    except ValueError as error:
        raise InputError(f"{directory}: holds no {CARD} of this version; {REMEDY}") from error
    for field in fields(kind):
        value, may_be_zero = getattr(card, field.name), field.metadata.get("may_be_zero", False)
        if isinstance(value, int | float) and not (0 < value < math.inf or (may_be_zero and value == 0)):
            allowed = "0 or more" if may_be_zero else "above 0"
            raise InputError(
                f"{directory / CARD}: {field.name}: got {value}; it must be {allowed} and finite; {REMEDY}"
            )
    return card
