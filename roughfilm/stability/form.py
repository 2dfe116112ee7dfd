"""The one form of every map of stability: questions, what became of each, and all of them together."""

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any, Protocol, TypeVar

import numpy as np
from rich.table import Table

from roughfilm.batch.jobs import Failure
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.rom.ladder.provenance import code, commit, machine, versions
from roughfilm.rom.studies.table import Column

SLOW = 100
"""More iterations than this are slow, where a family does not say otherwise."""


SECOND = "second try"
"""Why a run that converged is slow."""

MESH = "no mesh"
"""Why a run stalled whose mesh OpenFOAM finds faults in."""


class Outcome(StrEnum):
    """What became of a question."""

    CONVERGED = "converged"
    SLOW = "slow"
    INACCURATE = "inaccurate"
    STALLED = "stalled"
    WRONG = "wrong"
    REFUSED = "refused"


MEANING: Mapping[Outcome, str] = {
    Outcome.CONVERGED: "an answer that its judge finds right",
    Outcome.SLOW: "right too, at a price: many iterations, or a second try by a recipe that costs more",
    Outcome.INACCURATE: "far from the truth, and told so: by an error bar, a warning, or what the model leaves out",
    Outcome.STALLED: "no answer: the solver gave up and said so",
    Outcome.WRONG: "a wrong answer that nothing told, an answer where there is none, a refusal where there is one, "
    "or a fault",
    Outcome.REFUSED: "refused in one line, as it must be",
}

GOOD = (Outcome.CONVERGED, Outcome.SLOW)
BAD = (Outcome.STALLED, Outcome.WRONG)


@dataclass(frozen=True, kw_only=True)
class Spot:
    """What became of one question, and where it stands on the map.

    Attributes
    ----------
    why : the outcome in a finer word, "" where there is none: unsteady, diverged, second try.
    error : by which the answer is off as its judge counts, None where there is no answer or no judge.
    numbers : what else the family tells, by name.
    """

    group: str
    row: str
    column: str
    outcome: Outcome
    why: str = ""
    iterations: int | None = None
    cpu_s: float = 0.0
    error: float | None = None
    message: str = ""
    numbers: Mapping[str, float | None] = field(default_factory=dict)

    @property
    def entries(self) -> dict[str, Any]:
        """For JSON."""
        return {**vars(self), "outcome": self.outcome.value, "numbers": dict(self.numbers)}

    @property
    def place(self) -> str:
        """In words."""
        return f"{self.group}: {self.row}, {self.column}"


@dataclass(frozen=True, kw_only=True)
class Judged:
    """An answer that its judge has seen: whether it is right, by how much it is off, and if need be why."""

    iterations: int
    right: bool
    error: float
    numbers: Mapping[str, float | None] = field(default_factory=dict)
    message: str = ""


Answer = TypeVar("Answer")


def tried(
    spot: Callable[..., Spot],
    ask: Callable[[], Answer],
    judge: Callable[[Answer], Judged],
    *,
    refused: bool = False,
    slow: int = SLOW,
) -> Spot:
    """Put a question, on the clock, and have the answer judged; whatever is raised that is not ours is wrong.

    Parameters
    ----------
    spot : makes the spot, its place given already.
    refused : whether the question must be refused.
    slow : more iterations than this are.
    """
    cpu = time.process_time()
    try:
        answer = ask()
    except Exception as error:  # a question must end in an answer or in an error of the project's, and is told if not
        ours = isinstance(error, InputError | ConvergenceError | UnavailableError) and "\n" not in str(error)
        outcome = Outcome.WRONG
        if ours:
            outcome = Outcome.STALLED if isinstance(error, ConvergenceError) else outcome
            outcome = Outcome.REFUSED if refused else outcome
        return spot(
            outcome=outcome,
            why="" if ours else "fault",
            iterations=getattr(error, "iterations", None),
            cpu_s=time.process_time() - cpu,
            message=str(error) if ours else f"{type(error).__name__}: {error}",
        )
    spent = time.process_time() - cpu
    if refused:
        return spot(outcome=Outcome.WRONG, cpu_s=spent, message="an answer, where none exists")
    found = judge(answer)
    good = Outcome.SLOW if found.iterations > slow else Outcome.CONVERGED
    return spot(
        outcome=good if found.right else Outcome.WRONG,
        iterations=found.iterations,
        cpu_s=spent,
        error=float(found.error) if np.isfinite(found.error) else None,
        message=found.message,
        numbers=found.numbers,
    )


def failed(failure: Failure, **place: Any) -> Spot:
    """The spot of a run without an answer: refused, given up in one of the ways of a solver, or a fault."""
    if failure.kind == InputError.__name__:
        outcome, why = Outcome.REFUSED, ""
    elif failure.kind in (ConvergenceError.__name__, UnavailableError.__name__):
        outcome, why = Outcome.STALLED, MESH if "mesh check" in failure.message else failure.outcome
    else:
        outcome, why = Outcome.WRONG, "fault"
    return Spot(
        outcome=outcome,
        why="" if why == outcome else why,
        iterations=failure.iterations,
        cpu_s=failure.cpu_s or 0.0,
        message=failure.message,
        **place,
    )


@dataclass(frozen=True, kw_only=True)
class Map:
    """A finished map, and what a reader must know of it.

    Attributes
    ----------
    axes : what was varied, in words.
    judge : what tells right from wrong, and what ``error`` counts, in words.
    told : what was found, in words.
    absent : what was left out, with the reason.
    figures : SVG by name, beside the tables.
    """

    family: str
    title: str
    axes: str
    judge: str
    resolution: int
    resolution_meaning: str
    spots: Sequence[Spot]
    told: Sequence[str]
    absent: Mapping[str, str] = field(default_factory=dict)
    figures: Mapping[str, str] = field(default_factory=dict)

    @property
    def entries(self) -> dict[str, Any]:
        """For JSON and for the page; the figures lie beside."""
        words = ("family", "title", "axes", "judge", "resolution", "resolution_meaning")
        return {
            **{name: getattr(self, name) for name in words},
            "counts": {outcome.value: count(self.spots, outcome) for outcome in Outcome},
            "cpu_s": sum(spot.cpu_s for spot in self.spots),
            "in_words": list(self.told),
            "absent": dict(self.absent),
            "runs": [spot.entries for spot in self.spots],
            "provenance": {"machine": machine(), "code": code(), "commit": commit(), "versions": versions()},
        }


class Family(Protocol):
    """What is mapped; ``resolution`` is the default, ``resolution_meaning`` says in words what it counts."""

    @property
    def resolution(self) -> int:
        """By default."""
        ...

    @property
    def resolution_meaning(self) -> str:
        """What it counts."""
        ...

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Map:
        """Solve what is not in ``out`` already, and put all of it together."""
        ...


def count(spots: Iterable[Spot], *outcomes: Outcome) -> int:
    """How many came to this."""
    return sum(spot.outcome in outcomes for spot in spots)


def in_groups(spots: Sequence[Spot]) -> dict[str, list[Spot]]:
    """By group, in the order in which these come."""
    return {name: [spot for spot in spots if spot.group == name] for name in dict.fromkeys(s.group for s in spots)}


def in_rows(spots: Sequence[Spot]) -> dict[str, dict[str, Spot]]:
    """By row and column."""
    return {
        row: {spot.column: spot for spot in spots if spot.row == row} for row in dict.fromkeys(s.row for s in spots)
    }


def summed(spots: Sequence[Spot]) -> str:
    """How many are right, slow, stalled and wrong, in words."""
    parts = [f"{count(spots, *GOOD)} of {len(spots)} right"]
    parts += [
        f"{count(spots, outcome)} {'of these slowly' if outcome is Outcome.SLOW else outcome}"
        for outcome in Outcome
        if outcome is not Outcome.CONVERGED and count(spots, outcome)
    ]
    return ", ".join(parts)


def named(spots: Iterable[Spot], *outcomes: Outcome) -> list[str]:
    """The questions that came to this, one a line."""
    return [
        f"{(spot.why or spot.outcome).capitalize()}: {spot.place}"
        + (f" ({spot.iterations} iterations)" if spot.iterations else "")
        + (f": {spot.message}" if spot.message else "")
        for spot in spots
        if spot.outcome in outcomes
    ]


def columns_of(maps: Sequence[Mapping[str, Any]]) -> dict[str, Column]:
    """Every question of some maps' entries, one a row, with the numbers that all of the maps tell."""
    rows = [(one["family"], run) for one in maps for run in one["runs"]]
    shared = [{name for run in one["runs"] for name in run["numbers"]} for one in maps]
    own = sorted(set.intersection(*shared)) if shared else []

    def texts(name: str) -> Column:
        return Column(values=[str(run[name]) for _, run in rows], unit="")

    def numbers(values: Iterable[float | None], unit: str = "1") -> Column:
        return Column(values=[float("nan") if value is None else float(value) for value in values], unit=unit)

    return {
        "family": Column(values=[family for family, _ in rows], unit=""),
        **{name: texts(name) for name in ("group", "row", "column", "outcome", "why")},
        **{name: numbers(run[name] for _, run in rows) for name in ("iterations", "error")},
        **{name: numbers(run["numbers"].get(name) for _, run in rows) for name in own},
        "cpu_time": numbers((run["cpu_s"] for _, run in rows), "s"),
        "message": texts("message"),
    }


def table_of(counted: Mapping[str, Sequence[Mapping[str, Any]]], what: str) -> Table:
    """How many runs by name came to which outcome, for the terminal."""
    met = [one for one in Outcome if any(run["outcome"] == one for runs in counted.values() for run in runs)]
    table = Table(what, *(outcome.value for outcome in met), "most iterations", "CPU s")
    for name, runs in counted.items():
        counts = (str(sum(run["outcome"] == outcome for run in runs)) for outcome in met)
        most = max((run["iterations"] or 0 for run in runs), default=0)
        table.add_row(name, *counts, str(most), f"{sum(run['cpu_s'] for run in runs):.3g}")
    return table
