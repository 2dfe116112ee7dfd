"""What became of every run of a map over the Reynolds number and the depth of a groove, and the words for it."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from statistics import median

from contact.errors import InputError
from rom.result import Result
from rom.setting import Setting
from rom.table import Column
from scripts.runs import Failure


class State(StrEnum):
    """What became of a run: an outcome of its solver, or that it converged at the second try, or was not tried."""

    CONVERGED = "converged"
    RESCUED = "rescued"
    STALLED = "stalled"
    UNSTEADY = "unsteady"
    DIVERGED = "diverged"
    UNFINISHED = "unfinished"
    FAILED = "failed"
    REFUSED = "refused"


MEANING: Mapping[State, str] = {
    State.CONVERGED: "met its tolerance at the first try",
    State.RESCUED: "met its tolerance at the second try, by a recipe that costs more",
    State.STALLED: "the flow along the film stands still, but cross flow and pressure miss the tolerance: round-off",
    State.UNSTEADY: "the flow keeps swinging from iteration to iteration and gets no nearer to a steady one",
    State.DIVERGED: "the numbers grew beyond all bounds",
    State.UNFINISHED: "was getting nearer when its iterations were used up",
    State.FAILED: "did not converge, and the model does not say how",
    State.REFUSED: "the model does not take such a scene",
}


@dataclass(frozen=True, kw_only=True)
class Spot:
    """One run: where, what became of it, iterations (of the last try), CPU seconds and load; None where unknown."""

    reynolds_number: float
    depth_plus: float
    state: State
    iterations: int | None = None
    cpu_s: float | None = None
    load_plus: float | None = None
    message: str = ""


@dataclass(frozen=True, kw_only=True)
class Map:
    """One model with one scheme, and its runs."""

    setting: Setting
    spots: tuple[Spot, ...]

    def at(self, reynolds_number: float, depth_plus: float) -> Spot:
        """The run at a place of the map."""
        return next(s for s in self.spots if (s.reynolds_number, s.depth_plus) == (reynolds_number, depth_plus))

    def count(self, *states: State) -> int:
        """How many runs came to this."""
        return sum(spot.state in states for spot in self.spots)

    @property
    def cpu_s(self) -> float:
        """CPU seconds of all runs."""
        return sum(spot.cpu_s or 0.0 for spot in self.spots)


def spot_of(reynolds_number: float, depth_plus: float, answer: Result | Failure) -> Spot:
    """The run of which this is the answer."""
    if isinstance(answer, Failure):
        state = State.REFUSED if answer.kind == InputError.__name__ else State(answer.outcome or State.FAILED)
        return Spot(
            reynolds_number=reynolds_number,
            depth_plus=depth_plus,
            state=state,
            iterations=answer.iterations,
            cpu_s=answer.cpu_s,
            message=answer.message,
        )
    tries = answer.provenance.get("tries", [])
    told = [f"{one['outcome']} after {one['iterations']} iterations at the first try" for one in tries[:-1]]
    return Spot(
        reynolds_number=reynolds_number,
        depth_plus=depth_plus,
        state=State.RESCUED if told else State.CONVERGED,
        iterations=answer.numerics.iterations,
        cpu_s=answer.numerics.cpu_s,
        load_plus=answer.quantities["load_plus"].value,
        message="; ".join([*told, *answer.provenance.get("warnings", [])]),
    )


def in_words(found: Map, others: Sequence[Map]) -> list[str]:
    """What a reader should know of a map: where it converges and where not, and how far its scheme is off."""
    whole = len(found.spots)
    good = found.count(State.CONVERGED)
    told = [f"Converges at {'all' if good == whole else good} of {whole} places."]
    told += [
        f"{state.capitalize()} at {number}: {_places(spot for spot in found.spots if spot.state is state)}."
        for state in State
        if state is not State.CONVERGED and (number := found.count(state))
    ]
    first = next(map_ for map_ in others if map_.setting.model is found.setting.model)
    gaps = _gaps(found, first)
    if first is not found and gaps:
        told.append(
            f"At half of them its load is {100 * median(gaps):.2g} % or more from that of {first.setting.scheme}."
        )
    return told


def _gaps(found: Map, first: Map) -> list[float]:
    pairs = ((spot, first.at(spot.reynolds_number, spot.depth_plus)) for spot in found.spots)
    return [
        abs(spot.load_plus / other.load_plus - 1)
        for spot, other in pairs
        if spot.load_plus is not None and other.load_plus
    ]


def _places(spots: Iterable[Spot]) -> str:
    """The places of runs, gathered by Reynolds number or by depth, whichever is shorter."""
    at = [(f"{spot.reynolds_number:g}", f"{spot.depth_plus:g}") for spot in spots]
    numbers = {n: ", ".join(d for m, d in at if m == n) for n, _ in at}
    depths = {d: ", ".join(n for n, e in at if e == d) for _, d in at}
    if len(depths) < len(numbers):
        return "; ".join(f"d+ {depth} at Re {numbers}" for depth, numbers in depths.items())
    return "; ".join(f"Re {number} at d+ {depths}" for number, depths in numbers.items())


def columns(maps: Sequence[Map]) -> dict[str, Column]:
    """Every run of every map, one a row."""
    rows = [(map_.setting, spot) for map_ in maps for spot in map_.spots]

    def numbers(values: Iterable[float | None], unit: str = "1") -> Column:
        return Column(values=[float("nan") if value is None else float(value) for value in values], unit=unit)

    def texts(values: Iterable[str]) -> Column:
        return Column(values=list(values), unit="")

    return {
        "model": texts(setting.model.name for setting, _ in rows),
        "scheme": texts(setting.scheme or "" for setting, _ in rows),
        "resolution": numbers(setting.resolution or setting.model.resolution for setting, _ in rows),
        "reynolds_number": numbers(spot.reynolds_number for _, spot in rows),
        "depth_plus": numbers(spot.depth_plus for _, spot in rows),
        "state": texts(spot.state for _, spot in rows),
        "iterations": numbers(spot.iterations for _, spot in rows),
        "cpu_time": numbers((spot.cpu_s for _, spot in rows), "s"),
        "load_plus": numbers(spot.load_plus for _, spot in rows),
        "message": texts(spot.message for _, spot in rows),
    }
