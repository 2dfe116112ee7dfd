"""The share of answers that keep what they state, by model and quantity, and every miss by name."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from statistics import median

from roughfilm.rom.ladder.kind import kind_of_laws
from scripts.studies.coverage.store import Advised, Judged

GOAL = (0.93, 0.98)
"""Least and greatest share of answers whose error is within what they state; 95 of 100 is meant."""

ADVICE_GOAL = 0.95
"""Least share of advised answers whose error is within the tolerance."""

FAR = 3.0
"""Ratio of an error to what was stated above which an answer without a warning misleads."""

WIDE = 5.0
"""Median of stated over true error above which what a model states about a quantity is too wide, a miss as well.

A bound that normal errors keep in 95 of 100 cases is 2.9 times their median, and more than 5 times 30 of 100 of them.
"""

SHARE = 0.2
"""Largest uncertainty of a truth over the stated error at which a scene is judged in any case."""

UNCERTAINTY, EXPECTED = "uncertainty", "expected error"


@dataclass(frozen=True, kw_only=True)
class Finding:
    """The error of one answer beside what it states; all in the unit of the quantity.

    Attributes
    ----------
    kind, seed, model, quantity : the answer.
    promise : "uncertainty", of the numerical solution, or "expected error", of the model and its solution together.
    value, true, truth_uncertainty : the answer, the truth, and the uncertainty of the truth.
    stated : the stated error.
    warned : whether the result has a warning.
    """

    kind: str
    seed: int
    model: str
    quantity: str
    promise: str
    value: float
    true: float
    truth_uncertainty: float
    stated: float
    warned: bool

    @property
    def error(self) -> float:
        """The difference from the truth."""
        return abs(self.value - self.true)

    @property
    def decided(self) -> bool:
        """Whether the truth is sharp enough: its uncertainty is small, or cannot change whether the promise is kept."""
        return self.truth_uncertainty <= SHARE * self.stated or abs(self.error - self.stated) > self.truth_uncertainty

    @property
    def kept(self) -> bool:
        """Whether the error is within what is stated."""
        return self.error <= self.stated

    @property
    def wide(self) -> bool:
        """Whether what is stated is surely more than ``WIDE`` times the error."""
        return self.stated > WIDE * (self.error + self.truth_uncertainty)

    @property
    def misleads(self) -> bool:
        """Whether the error surely exceeds three times what is stated, without a warning."""
        return self.error - self.truth_uncertainty > FAR * self.stated and not self.warned


def findings(scenes: Sequence[Judged]) -> Iterator[Finding]:
    """Return what every answer states about its quantities.

    An uncertainty is judged by the truth of the model's own equations, an expected error, which contains it, by the
    truth of the scene. Where a model states no expected error and has no entry in the own truths, its uncertainty is
    judged by the truth of the scene.
    """
    for one in scenes:
        kind = kind_of_laws(one.kind)
        values = {name: value for name, (value, _) in one.truth.items()}
        for model, answer in one.models.items():
            own = one.own.get(model, {})
            for quantity, value in answer.values.items():
                bar, expected = answer.uncertainty.get(quantity), answer.expected_error.get(quantity)
                promises = []
                if bar is not None and quantity in own:
                    promises.append((UNCERTAINTY, own[quantity], bar))
                if quantity not in one.truth or model == one.by:
                    pass
                elif expected is not None:
                    promises.append(
                        (EXPECTED, one.truth[quantity], expected * kind.size_of(one.scene, values, quantity))
                    )
                elif bar is not None and model not in one.own:
                    promises.append((UNCERTAINTY, one.truth[quantity], bar))
                for promise, (true, truth_uncertainty), stated in promises:
                    yield Finding(
                        kind=one.kind,
                        seed=one.seed,
                        model=model,
                        quantity=quantity,
                        promise=promise,
                        value=value,
                        true=true,
                        truth_uncertainty=truth_uncertainty,
                        stated=stated,
                        warned=bool(answer.warnings),
                    )


@dataclass(frozen=True, kw_only=True)
class Coverage:
    """The promises of one model on one quantity: how many were judged, kept, undecided, misleading and wide.

    ``width`` is the median of the stated error over the error.
    """

    kind: str
    model: str
    quantity: str
    promise: str
    judged: int
    kept: int
    undecided: int
    misleading: int
    wide: int
    width: float

    @property
    def wide_share(self) -> float:
        """Fraction of the judged answers whose stated error is more than ``WIDE`` times the error."""
        return self.wide / self.judged if self.judged else float("nan")

    @property
    def share(self) -> float:
        """Fraction of the judged answers that keep their promise."""
        return self.kept / self.judged if self.judged else float("nan")

    @property
    def verdict(self) -> str:
        """Whether the goals are met, in words."""
        if not self.judged:
            return "not judged"
        if self.misleading or self.share < GOAL[0]:
            return "short"
        return "wide" if self.width > WIDE else "met"


def coverage(found: Sequence[Finding]) -> list[Coverage]:
    """Return the coverage of every model, quantity and promise."""
    groups: dict[tuple[str, str, str, str], list[Finding]] = {}
    for one in found:
        groups.setdefault((one.kind, one.model, one.quantity, one.promise), []).append(one)
    rows = []
    for (kind, model, quantity, promise), group in groups.items():
        decided = [one for one in group if one.decided]
        ratios = [one.stated / one.error for one in decided if one.error > 0]
        rows.append(
            Coverage(
                kind=kind,
                model=model,
                quantity=quantity,
                promise=promise,
                judged=len(decided),
                kept=sum(one.kept for one in decided),
                undecided=len(group) - len(decided),
                misleading=sum(one.misleads for one in group),
                wide=sum(one.wide for one in decided),
                width=median(ratios) if ratios else float("nan"),
            )
        )
    return rows


@dataclass(frozen=True, kw_only=True)
class Silence:
    """The answers of a model on a compared quantity that state no error and have no warning."""

    kind: str
    model: str
    quantity: str
    answers: int
    silent: int


def silences(scenes: Sequence[Judged]) -> list[Silence]:
    """Return the number of silent answers of every model on every compared quantity, where there are any."""
    groups: dict[tuple[str, str, str], list[bool]] = {}
    for one in scenes:
        for model, answer in one.models.items():
            for quantity in kind_of_laws(one.kind).compared:
                if quantity in answer.values:
                    states = quantity in answer.uncertainty or quantity in answer.expected_error or answer.warnings
                    groups.setdefault((one.kind, model, quantity), []).append(not states)
    return [
        Silence(kind=kind, model=model, quantity=quantity, answers=len(group), silent=sum(group))
        for (kind, model, quantity), group in groups.items()
        if any(group)
    ]


@dataclass(frozen=True, kw_only=True)
class AdviceScore:
    """The advice on one quantity at one tolerance: the answers judged and kept, the refusals, and the cost.

    ``cost`` is the median CPU time of advice and answer over that of the best model.
    """

    kind: str
    quantity: str
    within: float
    judged: int
    kept: int
    refused: int
    cost: float

    @property
    def share(self) -> float:
        """Fraction of the judged answers within the tolerance."""
        return self.kept / self.judged if self.judged else float("nan")


def relative_error(scene: Judged, advice: Advised) -> tuple[float, float] | None:
    """Return error and uncertainty of the truth over the size of the quantity; None without an answer or a truth."""
    if advice.value is None or advice.quantity not in scene.truth or advice.model == scene.by:
        return None
    true, truth_uncertainty = scene.truth[advice.quantity]
    values = {name: pair[0] for name, pair in scene.truth.items()}
    size = kind_of_laws(scene.kind).size_of(scene.scene, values, advice.quantity)
    return abs(advice.value - true) / size, truth_uncertainty / size


def advice_scores(scenes: Sequence[Judged]) -> tuple[list[AdviceScore], list[tuple[Judged, Advised, float]]]:
    """Return the score of the advice by kind, quantity and tolerance, and every answer beyond its tolerance."""
    groups: dict[tuple[str, str, float], list[tuple[Judged, Advised]]] = {}
    for scene in scenes:
        for one in scene.advice:
            groups.setdefault((scene.kind, one.quantity, one.within), []).append((scene, one))
    scores, misses = [], []
    for (kind, quantity, within), group in groups.items():
        errors = [(scene, one, relative_error(scene, one)) for scene, one in group]
        decided = [
            (scene, one, pair[0]) for scene, one, pair in errors if pair is not None and abs(pair[0] - within) > pair[1]
        ]
        misses += [(scene, one, error) for scene, one, error in decided if error > within]
        scores.append(
            AdviceScore(
                kind=kind,
                quantity=quantity,
                within=within,
                judged=len(decided),
                kept=sum(error <= within for *_, error in decided),
                refused=sum(one.value is None for _, one in group),
                cost=median(one.cpu_s / one.best_cpu_s for _, one in group if one.best_cpu_s > 0),
            )
        )
    return scores, misses
