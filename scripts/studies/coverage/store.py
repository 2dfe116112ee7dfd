"""Judged scenes in a file of one JSON object a line, which grows by one line with every finished scene."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from scripts.studies.study import plain


@dataclass(frozen=True, kw_only=True)
class Answer:
    """The answer of one model at its default resolution, or the reason why it gave none.

    ``expected_error`` is relative (see ``Kind.scale``), ``values`` and ``uncertainty`` have the unit of the quantity.
    """

    values: Mapping[str, float] = field(default_factory=dict)
    uncertainty: Mapping[str, float] = field(default_factory=dict)
    expected_error: Mapping[str, float] = field(default_factory=dict)
    cpu_s: float = 0.0
    warnings: tuple[str, ...] = ()
    failure: str = ""
    resolution: int = 0


@dataclass(frozen=True, kw_only=True)
class Advised:
    """The advice on one quantity at one tolerance, and the answer of the model that it chooses.

    ``model`` is None if no model is known to be accurate enough. ``cpu_s`` is that of all runs for advice and answer.
    """

    quantity: str
    within: float
    model: str | None = None
    resolution: int | None = None
    expected: float | None = None
    value: float | None = None
    cpu_s: float = 0.0
    best_cpu_s: float = 0.0
    failure: str = ""


@dataclass(frozen=True, kw_only=True)
class Judged:
    """A random scene with its truth, as (value, uncertainty) by quantity, and the answers of models by name.

    ``own`` is the truth of the own equations of a model, by its name, ``by`` the model that gave the truth of the
    scene, and ``runs`` its quantities by resolution, ``finer`` those of each model (see ``Truth``).
    ``failure`` is the reason why there is no truth. ``code`` is a digest of the code and the laws behind the answers.
    """

    kind: str
    seed: int
    scene: Mapping[str, Any]
    truth: Mapping[str, tuple[float, float]]
    own: Mapping[str, Mapping[str, tuple[float, float]]] = field(default_factory=dict)
    by: str = ""
    runs: Mapping[int, Mapping[str, float]] = field(default_factory=dict)
    finer: Mapping[str, Mapping[int, Mapping[str, float]]] = field(default_factory=dict)
    method: str = ""
    truth_warnings: tuple[str, ...] = ()
    truth_cpu_s: float = 0.0
    failure: str = ""
    models: Mapping[str, Answer] = field(default_factory=dict)
    advice: tuple[Advised, ...] = ()
    code: str = ""


def path_of(out: Path, kind: str) -> Path:
    """Return the file of the judged scenes of a kind."""
    return out / f"coverage_{kind}.jsonl"


def append(path: Path, found: Judged) -> None:
    """Write one scene at the end of the file; of several lines for one seed the last one counts."""
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(plain(asdict(found)), allow_nan=False) + "\n")


def lines(path: Path) -> Iterator[dict[str, Any]]:
    """Return the objects in a file of one JSON object a line; a line that was cut off is left out."""
    for line in path.read_text(encoding="utf-8").splitlines() if path.is_file() else ():
        try:
            yield json.loads(line)
        except ValueError:
            continue


def read(path: Path) -> dict[int, Judged]:
    """Return the scenes in a file by seed."""
    found = {}
    for entries in lines(path):
        entries["truth"] = {name: tuple(pair) for name, pair in entries["truth"].items()}
        own = entries.get("own", {})
        entries["own"] = {name: {q: tuple(pair) for q, pair in one.items()} for name, one in own.items()}
        entries["runs"] = {int(resolution): values for resolution, values in entries.get("runs", {}).items()}
        finer = entries.get("finer", {})
        entries["finer"] = {name: {int(n): values for n, values in one.items()} for name, one in finer.items()}
        answers = {name: {**one, "warnings": tuple(one["warnings"])} for name, one in entries["models"].items()}
        entries["models"] = {name: Answer(**one) for name, one in answers.items()}
        entries["advice"] = tuple(Advised(**one) for one in entries.get("advice", ()))
        entries["truth_warnings"] = tuple(entries["truth_warnings"])
        found[entries["seed"]] = Judged(**entries)
    return found
