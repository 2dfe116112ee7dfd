"""The common form of every stability map: probes of a solver, their judged answers, and the map that holds them."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from roughfilm.batch.jobs import Failure
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.contact.foundation.timing import working_time
from roughfilm.rom.ladder.provenance import code, commit, machine, versions
from roughfilm.rom.studies.table import Column
from roughfilm.terminal import results
from roughfilm.terminal.console import progress_bar

SLOW_ITERATIONS = 100
"""Number of iterations above which a probe is slow, unless its map counts something else."""

SECOND_TRY = "second try"
"""The reason (``why``) of a run that is slow because it converged only at its second try."""

NO_MESH = "no mesh"
"""The reason (``why``) of a run that stalled because OpenFOAM rejects its mesh."""


class MapOutcome(StrEnum):
    """The outcome of a probe."""

    CONVERGED = "converged"
    SLOW = "slow"
    INACCURATE = "inaccurate"
    STALLED = "stalled"
    WRONG = "wrong"
    REFUSED = "refused"


MEANING: Mapping[MapOutcome, str] = {
    MapOutcome.CONVERGED: "correct, compared with the reference of the map",
    MapOutcome.SLOW: "correct, but after many iterations or in a second run by a costlier recipe",
    MapOutcome.INACCURATE: "far from the truth, and reported so: by an uncertainty, a warning, or an effect left out",
    MapOutcome.STALLED: "no answer: the solver stopped and reported it",
    MapOutcome.WRONG: "an error that nothing reports, an answer where there is none, a refusal where there is one, "
    "or a fault",
    MapOutcome.REFUSED: "refused in one line, as it must be",
}

GOOD = (MapOutcome.CONVERGED, MapOutcome.SLOW)
BAD = (MapOutcome.STALLED, MapOutcome.WRONG)


@dataclass(frozen=True, kw_only=True)
class Spot:
    """The outcome of one probe and its place on the map.

    Attributes
    ----------
    group, row, column : names of the place on the map.
    outcome : outcome of the probe.
    why : finer word for the outcome, such as unsteady, diverged or second try; "" where there is none.
    iterations : number of iterations of the solver, None where it is unknown.
    cpu_s : CPU time, s.
    error : error of the answer as its judge measures it, None where there is no answer or no judge.
    message : message of the judge, the solver or the error; "" where there is none.
    numbers : other numbers of the map, by name.
    """

    group: str
    row: str
    column: str
    outcome: MapOutcome
    why: str = ""
    iterations: int | None = None
    cpu_s: float = 0.0
    error: float | None = None
    message: str = ""
    numbers: Mapping[str, float | None] = field(default_factory=dict)

    @property
    def entries(self) -> dict[str, Any]:
        """The attributes by name, as JSON holds them."""
        return {**vars(self), "outcome": self.outcome.value, "numbers": dict(self.numbers)}

    @property
    def place(self) -> str:
        """The group, row and column in one phrase."""
        return f"{self.group}: {self.row}, {self.column}"


@dataclass(frozen=True, kw_only=True)
class Judgement:
    """The judgement of an answer.

    Attributes
    ----------
    iterations : number of iterations of the solver; None if there is none.
    right : whether the answer is right.
    error : its error as the judge measures it.
    reported : whether the answer itself reports, by a warning or an uncertainty, that it may be as wrong as it is.
    numbers : other numbers of the map, by name.
    why : finer word for the outcome; "" where there is none.
    message : message of the judge; "" where there is none.
    """

    iterations: int | None
    right: bool
    error: float
    reported: bool = False
    numbers: Mapping[str, float | None] = field(default_factory=dict)
    why: str = ""
    message: str = ""


@dataclass(frozen=True, kw_only=True)
class Probe:
    """One question to a solver and its place on the map.

    Attributes
    ----------
    group, row, column : names of the place on the map.
    ask : function that runs the solver and returns its answer; its CPU time is measured.
    judge : function that judges the answer.
    refused : whether the solver must refuse the question.
    many : number of iterations above which the probe is slow.
    """

    group: str
    row: str
    column: str
    ask: Callable[[], Any]
    judge: Callable[[Any], Judgement]
    refused: bool = False
    many: int = SLOW_ITERATIONS

    def spot(self) -> Spot:
        """Run the solver and judge its answer.

        An exception that is not one of the project's error classes, or whose message has several lines, is a fault, and
        the outcome is wrong.
        """
        place: dict[str, Any] = {"group": self.group, "row": self.row, "column": self.column}
        cpu = working_time()
        try:
            answer = self.ask()
        except Exception as error:  # every exception becomes a spot of the map
            ours = isinstance(error, InputError | ConvergenceError | UnavailableError) and "\n" not in str(error)
            outcome = MapOutcome.WRONG
            if ours and self.refused:
                outcome = MapOutcome.REFUSED
            elif ours and isinstance(error, ConvergenceError):
                outcome = MapOutcome.STALLED
            return Spot(
                **place,
                outcome=outcome,
                why="" if ours else "fault",
                iterations=getattr(error, "iterations", None),
                cpu_s=working_time() - cpu,
                message=str(error) if ours else f"{type(error).__name__}: {error}",
            )
        cpu_s = working_time() - cpu
        if self.refused:
            return Spot(**place, outcome=MapOutcome.WRONG, cpu_s=cpu_s, message="an answer, where none exists")
        judged = self.judge(answer)
        good = MapOutcome.SLOW if (judged.iterations or 0) > self.many else MapOutcome.CONVERGED
        return Spot(
            **place,
            outcome=good if judged.right else MapOutcome.INACCURATE if judged.reported else MapOutcome.WRONG,
            why=judged.why,
            iterations=judged.iterations,
            cpu_s=cpu_s,
            error=float(judged.error) if np.isfinite(judged.error) else None,
            message=judged.message,
            numbers=judged.numbers,
        )


def failed(failure: Failure, **place: Any) -> Spot:
    """The spot of a run without an answer.

    The outcome is refused for an InputError, stalled for a ConvergenceError or UnavailableError, and otherwise wrong, a
    fault. ``place`` holds the other attributes of the spot: group, row, column and numbers.
    """
    if failure.kind == InputError.__name__:
        outcome, why = MapOutcome.REFUSED, ""
    elif failure.kind in (ConvergenceError.__name__, UnavailableError.__name__):
        outcome, why = MapOutcome.STALLED, NO_MESH if "mesh check" in failure.message else failure.outcome
    else:
        outcome, why = MapOutcome.WRONG, "fault"
    return Spot(
        outcome=outcome,
        why="" if why == outcome else why,
        iterations=failure.iterations,
        cpu_s=failure.cpu_s or 0.0,
        message=failure.message,
        **place,
    )


Spots = tuple[Sequence[Spot], Mapping[str, str]]
"""The spots of a map, and the models that were left out: the reason by name."""


@dataclass(frozen=True, kw_only=True)
class StabilityMap:
    """The description of a stability map, and the function that makes it.

    Attributes
    ----------
    name, title : name of the map in commands and files, and its title on the page.
    axes : quantities that are varied, in words; {resolution} stands for the resolution.
    judge : how answers are judged and how the error is measured, in words.
    resolution, resolution_meaning : default resolution, and what the resolution counts, in words.
    solve : solve(resolution, out, processes, scratch) returns the spots; runs that ``out`` already holds are reused.
    summary : function that returns sentences about the spots.
    least, most, allowed : smallest and largest resolution, and this range in words.
    draw : function that returns the figures beside the tables as SVG, by name.
    cell_numbers : names of two numbers of a spot, fractions that its cell on the page shows in percent; none for the
        number of iterations and the error.
    cell_words : sentence on what each cell of the page shows.
    """

    name: str
    title: str
    axes: str
    judge: str
    resolution: int
    resolution_meaning: str
    solve: Callable[[int, Path, int, Path], Spots]
    summary: Callable[[Sequence[Spot]], list[str]]
    least: float = -math.inf
    most: float = math.inf
    allowed: str = ""
    draw: Callable[[Sequence[Spot]], Mapping[str, str]] = field(default=lambda _spots: {})
    cell_numbers: tuple[str, str] | tuple[()] = ()
    cell_words: str = (
        "Each cell has the number of iterations, and below it the error against the reference, or the CPU time where "
        "there is no error."
    )

    def make(
        self, *, resolution: int | None, out: Path, processes: int, scratch: Path
    ) -> tuple[dict[str, Any], Mapping[str, str]]:
        """Make the map.

        Parameters
        ----------
        resolution : resolution of the map, None for the default.
        out : directory of the stored runs.
        processes : number of processes.
        scratch : directory for temporary files.

        Returns
        -------
        dict, mapping
            The entries of the map for JSON and for the page, and its figures as SVG by name.

        Raises
        ------
        InputError
            If the resolution is out of range.
        """
        resolution = self.resolution if resolution is None else resolution
        if not self.least <= resolution <= self.most:
            raise InputError(f"--resolution: got {resolution}; {self.allowed}")
        spots, absent = self.solve(resolution, out, processes, scratch)
        return {
            "family": self.name,
            "title": self.title,
            "axes": self.axes.format(resolution=resolution),
            "judge": self.judge,
            "resolution": resolution,
            "resolution_meaning": self.resolution_meaning,
            "cell_numbers": list(self.cell_numbers),
            "cell_words": self.cell_words,
            "counts": {outcome.value: count(spots, outcome) for outcome in MapOutcome},
            "cpu_s": sum(spot.cpu_s for spot in spots),
            "in_words": self.summary(spots),
            "absent": dict(absent),
            "runs": [spot.entries for spot in spots],
            "provenance": {"machine": machine(), "code": code(), "commit": commit(), "versions": versions()},
        }, self.draw(spots)


def in_turn(probes: Callable[[int], Iterable[Probe]]) -> Callable[[int, Path, int, Path], Spots]:
    """The ``solve`` function that runs all probes of a resolution one after the other, so that CPU times compare."""

    def solve(resolution: int, _out: Path, _processes: int, _scratch: Path) -> Spots:
        asked = list(probes(resolution))
        spots: list[Spot] = []
        with progress_bar(len(asked)) as advance:
            for probe in asked:
                advance(len(spots), f"{probe.group}: {probe.row}, {probe.column}")
                spots.append(probe.spot())
        return spots, {}

    return solve


def count(spots: Iterable[Spot], *outcomes: MapOutcome) -> int:
    """The number of spots with one of these outcomes."""
    return sum(spot.outcome in outcomes for spot in spots)


def in_groups(spots: Sequence[Spot]) -> dict[str, list[Spot]]:
    """The spots by group, in the order of the groups."""
    return {name: [spot for spot in spots if spot.group == name] for name in dict.fromkeys(s.group for s in spots)}


def in_rows(spots: Sequence[Spot]) -> dict[str, dict[str, Spot]]:
    """The spots by row and column."""
    return {
        row: {spot.column: spot for spot in spots if spot.row == row} for row in dict.fromkeys(s.row for s in spots)
    }


def in_numbers(spots: Sequence[Spot]) -> str:
    """The numbers of right, slow, stalled and wrong spots, in words."""
    parts = [f"{count(spots, *GOOD)} of {len(spots)} right"]
    parts += [
        f"{count(spots, outcome)} {'of these slowly' if outcome is MapOutcome.SLOW else outcome}"
        for outcome in MapOutcome
        if outcome is not MapOutcome.CONVERGED and count(spots, outcome)
    ]
    return ", ".join(parts)


def listed(spots: Iterable[Spot], *outcomes: MapOutcome) -> list[str]:
    """The lines that describe the spots with one of these outcomes, one line for each spot."""
    return [
        f"{(spot.why or spot.outcome).capitalize()}: {spot.place}"
        + (f" ({spot.iterations} iterations)" if spot.iterations else "")
        + (f": {spot.message}" if spot.message else "")
        for spot in spots
        if spot.outcome in outcomes
    ]


def columns_of(maps: Sequence[Mapping[str, Any]]) -> dict[str, Column]:
    """The columns of a table with a row for each spot, and with the numbers that all of these maps have."""
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


def table_of(counted: Mapping[str, Sequence[Mapping[str, Any]]], title: str) -> Table:
    """A table of the number of runs by name and outcome, for the terminal."""
    met = [one for one in MapOutcome if any(run["outcome"] == one for runs in counted.values() for run in runs)]
    rows = []
    for name, runs in counted.items():
        counts = (str(sum(run["outcome"] == outcome for run in runs)) for outcome in met)
        most = max((run["iterations"] or 0 for run in runs), default=0)
        rows.append((name, *counts, str(most), f"{sum(run['cpu_s'] for run in runs):.3g}"))
    return results.table_of((title, *(outcome.value for outcome in met), "most iterations", "CPU s"), rows, left=1)
