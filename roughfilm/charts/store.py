"""What was measured for the charts, a file a family: each answer is written as it comes, and is not asked for again."""

import hashlib
import json
import os
from collections.abc import Callable
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any

from roughfilm.charts.family import Ask, Family, Measured, Truth
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.contact.foundation.files import replacing
from roughfilm.foamcases.openfoam.installation import availability
from roughfilm.rom.ladder.provenance import code, commit, machine, versions

MEASURING = ("cells.py", "families.py", "family.py", "openfoam.py", "peer_runs.py")
"""Besides the three packages: what decides on the numbers."""

TRUTH = "truth"


@dataclass(frozen=True, kw_only=True)
class Answers:
    """Of one family: the truth and the answers by the names of what was asked, and why the others have none.

    ``taken`` says of each, by its name, when and under which load of the machine.
    """

    truth: Truth
    points: dict[str, Measured]
    failed: dict[str, str]
    taken: dict[str, dict[str, Any]]


@cache
def identity() -> dict[str, Any]:
    """What answers must agree in to stand on one chart: code, versions, machine."""
    here = Path(__file__).parent
    digest = hashlib.sha256()
    for path in [*(here / name for name in MEASURING), *sorted((here / "peers").glob("*.py"))]:
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    found = availability()
    return {
        "code": code(),
        "charts": digest.hexdigest()[:16],
        "versions": versions(),
        "openfoam": found.detail if found.available else "absent",
        "machine": machine(),
    }


def answers(family: Family, path: Path, step: Callable[[float, str], None]) -> Answers:
    """Everything that a family asks for: from its file where that is of the same code, versions and machine.

    ``step(done, words)`` is told the expected CPU seconds that are done. What has no answer is asked again next time.

    Raises
    ------
    InputError
        If the file cannot be written.
    ConvergenceError, UnavailableError
        If there is no truth.
    """
    kept = known(path)
    failed: dict[str, str] = {}

    def keep(name: str, found: Truth | Measured) -> None:
        taken = {
            "created": datetime.now(UTC).isoformat(timespec="seconds"),
            "load_average": round(os.getloadavg()[0], 2),
            "commit": commit(),
        }
        kept[name] = {"found": asdict(found), "taken": taken}
        with replacing(path) as scratch:
            scratch.write_text(json.dumps({"identity": identity(), "answers": kept}, indent=1), encoding="utf-8")

    done = 0.0
    asks: list[Ask] = family.asks()
    for ask in asks:
        step(done, f"{family.name}: {ask.solver}, {ask.resolution}")
        if ask.name not in kept:
            try:
                keep(ask.name, ask.measure())
            except (ConvergenceError, InputError, UnavailableError) as error:
                failed[ask.name] = str(error)
        done += ask.cost
    step(done, f"{family.name}: the truth")
    if TRUTH not in kept:
        keep(TRUTH, family.truth())
    points = {ask.name: Measured(**kept[ask.name]["found"]) for ask in asks if ask.name in kept}
    return Answers(
        truth=Truth(**kept[TRUTH]["found"]),
        points=points,
        failed=failed,
        taken={name: kept[name]["taken"] for name in (TRUTH, *points)},
    )


def known(path: Path) -> dict[str, Any]:
    """The answers in a file by name; none where it is absent, damaged, or of other code, versions or machine."""
    try:
        told = json.loads(path.read_text(encoding="utf-8"))
        return dict(told["answers"]) if told["identity"] == identity() else {}
    except (OSError, ValueError, LookupError, TypeError):
        return {}
