"""The measured answers of the charts: each is written to the file of its family at once, and is used again later."""

import hashlib
import json
import os
from collections.abc import Callable
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

from roughfilm.charts.family import Ask, ChartFamily, Measured, ReferenceValue
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.contact.foundation.files import write_json
from roughfilm.contact.foundation.reading.json_entries import from_json
from roughfilm.contact.foundation.reading.regular import read_bytes
from roughfilm.foamcases.openfoam.installation import availability
from roughfilm.rom.ladder.provenance import code, commit, machine, versions

MEASURING = ("cells.py", "families.py", "family.py", "openfoam.py", "peer_runs.py")
"""The files of this folder on which the answers depend."""

MAX_BYTES = 100_000_000
"""Largest size of a file of answers that is read, bytes."""

TRUTH = "truth"
"""Name of the reference among the stored answers."""


@dataclass(frozen=True, kw_only=True)
class StoredAnswer:
    """One answer in a file, and when it was ``taken``."""

    found: ReferenceValue | Measured
    taken: dict[str, Any]


@dataclass(frozen=True, kw_only=True)
class StoredAnswers:
    """The content of a file of answers: the answers by name, and the ``identity`` of what made them."""

    identity: dict[str, Any]
    answers: dict[str, StoredAnswer]


@dataclass(frozen=True, kw_only=True)
class Answers:
    """The reference and the measured answers of one family.

    Attributes
    ----------
    truth : reference.
    points : answers by the name of the point.
    failed : messages by the name of the point without an answer.
    taken : time, load of the machine and commit of each answer by name.
    """

    truth: ReferenceValue
    points: dict[str, Measured]
    failed: dict[str, str]
    taken: dict[str, dict[str, Any]]


@cache
def identity() -> dict[str, Any]:
    """The code, versions and machine, on which stored answers depend."""
    here = Path(__file__).parent
    digest = hashlib.sha256()
    for path in [*(here / name for name in MEASURING), *sorted((here / "peers").glob("*.py"))]:
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    openfoam = availability()
    return {
        "code": code(),
        "charts": digest.hexdigest()[:16],
        "versions": versions(),
        "openfoam": openfoam.detail if openfoam.available else "absent",
        "machine": machine(),
    }


def answers(family: ChartFamily, path: Path, step: Callable[[float, str], None]) -> Answers:
    """All answers of a family; stored answers of the same code, versions and machine are used again.

    A failed point is measured again at the next call.

    Parameters
    ----------
    family : family to measure.
    path : file of its answers.
    step : step(done, words) reports the expected CPU seconds of the finished points, and the next point.

    Raises
    ------
    InputError
        If the file cannot be written.
    ConvergenceError, UnavailableError
        If there is no reference.
    """
    stored = known(path)
    failed: dict[str, str] = {}

    def keep(name: str, answer: ReferenceValue | Measured) -> None:
        taken = {
            "created": datetime.now(UTC).isoformat(timespec="seconds"),
            "load_average": round(os.getloadavg()[0], 2),
            "commit": commit(),
        }
        stored[name] = {"found": asdict(answer), "taken": taken}
        write_json({"identity": identity(), "answers": stored}, path)

    done = 0.0
    asks: list[Ask] = family.asks()
    for ask in asks:
        step(done, f"{family.name}: {ask.solver}, {ask.resolution}")
        if ask.name not in stored:
            try:
                keep(ask.name, ask.measure())
            except (ConvergenceError, InputError, UnavailableError) as error:
                failed[ask.name] = str(error)
        done += ask.cost
    step(done, f"{family.name}: the truth")
    if TRUTH not in stored:
        keep(TRUTH, family.truth())
    points = {ask.name: Measured(**stored[ask.name]["found"]) for ask in asks if ask.name in stored}
    return Answers(
        truth=ReferenceValue(**stored[TRUTH]["found"]),
        points=points,
        failed=failed,
        taken={name: stored[name]["taken"] for name in (TRUTH, *points)},
    )


def known(path: Path) -> dict[str, Any]:
    """The answers in a file by name; empty if it is absent, damaged, or of other code, versions or machine."""
    try:
        text = read_bytes(path, MAX_BYTES, "measure again")
        from_json(text, StoredAnswers)
        entries = json.loads(text)
    except ValueError:
        return {}
    return dict(entries["answers"]) if entries["identity"] == identity() else {}
