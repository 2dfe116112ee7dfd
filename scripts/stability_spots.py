"""Questions put to one solver, each with what became of it: shared by the maps that gather them in tables."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, TypeVar

from rich.table import Table

from rom.provenance import code, commit, machine, versions
from rom.table import Column


class State(StrEnum):
    """What became of a question."""

    CONVERGED = "converged"
    SLOW = "slow"
    STALLED = "stalled"
    WRONG = "wrong"
    REFUSED = "refused"


MEANING: Mapping[State, str] = {
    State.STALLED: "the solver gave up and said so",
    State.WRONG: "an answer that is none, an answer where there is none, or a refusal where there is one",
    State.REFUSED: "refused in one line, as it must be",
}
"""Of what means the same on every map."""


@dataclass(frozen=True, kw_only=True)
class Spot:
    """What became of one question; None where there was no answer."""

    group: str
    row: str
    column: str
    state: StrEnum
    iterations: int | None = None
    cpu_s: float = 0.0
    message: str = ""

    @property
    def entries(self) -> dict[str, Any]:
        """For JSON."""
        return {name: value if not isinstance(value, StrEnum) else value.value for name, value in vars(self).items()}


AnySpot = TypeVar("AnySpot", bound=Spot)


def count(spots: Sequence[Spot], *states: StrEnum) -> int:
    """How many came to this."""
    return sum(spot.state in states for spot in spots)


def in_groups(spots: Sequence[AnySpot]) -> dict[str, list[AnySpot]]:
    """By group, in the order in which these come."""
    return {name: [spot for spot in spots if spot.group == name] for name in dict.fromkeys(s.group for s in spots)}


def in_rows(spots: Sequence[AnySpot]) -> dict[str, dict[str, AnySpot]]:
    """By row and column."""
    return {
        row: {spot.column: spot for spot in spots if spot.row == row} for row in dict.fromkeys(s.row for s in spots)
    }


def entries_of(
    family: str, resolution: int, spots: Sequence[Spot], told: Sequence[str], states: Iterable[StrEnum] = State
) -> dict[str, Any]:
    """A map for JSON, with the counts of these states."""
    return {
        "family": family,
        "resolution": resolution,
        "counts": {state.value: count(spots, state) for state in states},
        "in_words": told,
        "runs": [spot.entries for spot in spots],
        "provenance": {"machine": machine(), "code": code(), "commit": commit(), "versions": versions()},
    }


def columns_of(spots: Sequence[Spot], found: Sequence[str]) -> dict[str, Column]:
    """A map for CSV, with the numbers of that name."""

    def texts(name: str) -> Column:
        return Column(values=[str(getattr(spot, name)) for spot in spots], unit="")

    def numbers(name: str, unit: str = "1") -> Column:
        values = [getattr(spot, name) for spot in spots]
        return Column(values=[float("nan") if value is None else float(value) for value in values], unit=unit)

    return {
        **{name: texts(name) for name in ("group", "row", "column", "state")},
        **{name: numbers(name) for name in ("iterations", *found)},
        "cpu_time": numbers("cpu_s", "s"),
        "message": texts("message"),
    }


def table_of(groups: Mapping[str, Sequence[Spot]], states: Iterable[StrEnum] = State) -> Table:
    """How many of each group came to which of these states, for the terminal."""
    met = [state for state in states if any(count(spots, state) for spots in groups.values())]
    table = Table("group", *(state.value for state in met), "most iterations", "CPU s")
    for name, spots in groups.items():
        most = max((spot.iterations or 0 for spot in spots), default=0)
        counts = (str(count(spots, state)) for state in met)
        table.add_row(name, *counts, str(most), f"{sum(spot.cpu_s for spot in spots):.3g}")
    return table
