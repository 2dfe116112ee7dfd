"""The cheapest rung that is enough: judged by the numbers of a scene first, then by the rungs next to it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from math import inf

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.rom.advice.estimates import (
    Estimate,
    Question,
    a_posteriori,
    a_priori,
    affordable,
    by_its_own_word,
    near,
    percent,
)
from roughfilm.rom.advice.laws import Numbers, Table, table
from roughfilm.rom.ladder.kind import Omission, Scene, kind_of_name
from roughfilm.rom.ladder.model import Model, Progress, silent
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result

HOPELESS = 5.0
"""Times the tolerance: a rung that is farther off by the numbers of the scene is not run to be sure."""


class Verdict(StrEnum):
    """What became of a rung."""

    CHOSEN = "chosen"
    NOT_ENOUGH = "not enough"
    DOES_NOT_APPLY = "does not apply"
    NOT_HERE = "not on this machine"
    NOT_NEEDED = "not needed"
    IN_VAIN = "tried in vain"


@dataclass(frozen=True, kw_only=True)
class Considered:
    """One rung at its resolution: expected CPU seconds, what was expected of it by either source, and the verdict."""

    model: str
    resolution: int | None
    cpu_s: float
    verdict: Verdict
    reason: str
    a_priori: Estimate | None = None
    a_posteriori: Estimate | None = None

    @property
    def error(self) -> float | None:
        """That is expected at most: by the rungs next to it if they were run, else by the numbers; None if unknown."""
        estimate = self.a_posteriori or self.a_priori
        return None if estimate is None else estimate.error

    @property
    def sure(self) -> bool:
        """Whether the sweeps reach as far as what is expected."""
        estimate = self.a_posteriori or self.a_priori
        return estimate is not None and estimate.sure


@dataclass(frozen=True, kw_only=True)
class Advice:
    """What is enough for a scene, and why.

    Attributes
    ----------
    quantity, within : what was asked, and how far off it may be, as a part of its size.
    chosen : the cheapest rung that keeps it; None where none is known to.
    nearest : of those that do not, the one that is expected to come nearest; None where nothing is known.
    considered : every rung of the kind, cheapest first.
    numbers : the dimensionless numbers of the scene.
    result : of the chosen rung, if it was run to be sure.
    spent_cpu_s : CPU seconds of all that was run.
    omitted : what every rung of the kind leaves out; the rest of the tolerance is left for the rungs.
    """

    quantity: str
    within: float
    chosen: Considered | None
    nearest: Considered | None
    considered: tuple[Considered, ...]
    numbers: Numbers
    result: Result | None
    spent_cpu_s: float
    omitted: Omission | None = None


def wanted(scene: Scene, name: str | None) -> str:
    """The compared quantity that people call so: by default the first of the kind.

    Raises InputError for a name that the kind does not have.
    """
    compared = kind_of_name(scene.kind).compared
    if name is None:
        return next(iter(compared))
    for quantity, title in compared.items():
        if name in (quantity, title):
            return quantity
    told = ", ".join(repr(title) for title in compared.values())
    raise InputError(f"quantity: got {name!r}; of a {scene.kind} it must be one of {told}")


def shortfall(found: Advice, title: str) -> str:
    """That no rung is enough, and which comes nearest."""
    told = f"no rung here is known to give the {title} within {percent(found.within)}"
    if found.omitted is not None and found.omitted.part > found.within / 2:
        return f"{told}: {found.omitted.reason}"
    if found.nearest is None or found.nearest.error is None:
        return told
    if found.nearest.sure:
        return f"{told}; {found.nearest.model} comes nearest, {near(found.nearest.error)}"
    return f"{told}, as the scene lies beyond those that were swept; {found.nearest.model} may come nearest"


def advise(
    scene: Scene,
    models: Sequence[Model],
    *,
    quantity: str,
    within: float,
    laws: Table | None = None,
    run: Callable[[Model, int], Result] | None = None,
    progress: Progress = silent,
) -> Advice:
    """The cheapest rung, at the coarsest resolution, whose quantity is within a tolerance of the best rung's.

    Rungs are taken from the cheapest up. Two estimates are asked for: the numbers of the scene against laws that were
    fitted to sweeps, and the difference to the next rung, if that is cheap. A rung that the numbers put beyond
    ``HOPELESS`` tolerances is not run, nor one that is put beyond the tolerance if to be sure of it costs more than the
    cheapest that is enough. Where the two disagree, one more rung up is run and decides, if it is cheap;
    else the rung is passed over. What all of them leave out is judged apart and
    taken off the tolerance. Errors are those that 95 of 100 scenes do not exceed.

    Parameters
    ----------
    models : the rungs of the scene's kind.
    quantity : one of those that the kind compares.
    within : over the quantity's size, above 0 and below 1.
    laws : those of the project by default.
    run : run(model, resolution), by default the model's ``solve``; whoever keeps results may give theirs.

    Raises
    ------
    InputError
        For a tolerance out of range, or a scene to which no rung applies.
    """
    if not 0 < within < 1:
        raise InputError(f"within: got {within!r}; it must be above 0 and below 1, for example 5%")
    kind = kind_of_name(scene.kind)
    known: dict[tuple[str, int], Result] = {}
    failed: dict[tuple[str, int], Exception] = {}

    def solved(model: Model, resolution: int) -> Result:
        key = (model.name, resolution)
        if key in failed:
            raise failed[key]
        if key not in known:
            progress(0.0, f"running {model.name} on {resolution}")
            try:
                known[key] = (
                    model.solve(scene, Request(resolution=resolution), progress=progress)
                    if run is None
                    else run(model, resolution)
                )
            except (InputError, ConvergenceError, UnavailableError) as error:
                failed[key] = error
                raise
        return known[key]

    omitted = kind.omitted(scene, quantity)
    left = within - (omitted.part if omitted else 0.0)
    fits = {model.name: model.applies(scene) for model in models}
    asked = Question(
        scene=scene,
        kind=kind,
        models=[model for model in models if fits[model.name].applies],
        quantity=quantity,
        within=left,
        table=laws or table(),
        numbers=kind.numbers(scene),
        run=solved,
        failed=failed,
    )
    if not asked.models:
        raise InputError(f"scene: no rung applies: {'; '.join(fit.reason for fit in fits.values())}")
    considered = [
        Considered(model=name, resolution=None, cpu_s=0.0, verdict=Verdict.DOES_NOT_APPLY, reason=fit.reason)
        for name, fit in fits.items()
        if not fit.applies
    ]
    chosen: Considered | None = None
    here = [model for model in asked.models if model.available().available]
    secure = min((asked.cost(model) for model in here if _keeps(a_priori(asked, model), left)), default=inf)
    for model in sorted(asked.models, key=lambda model: (asked.cost(model), -len(model.keeps))):
        one = _after(asked, model) if chosen or left <= 0 else _considered(asked, model, secure)
        considered.append(one)
        if one.verdict is Verdict.CHOSEN:
            chosen = one
    short = [one for one in considered if one.error is not None and one.verdict is Verdict.NOT_ENOUGH]
    return Advice(
        quantity=quantity,
        within=within,
        chosen=chosen,
        nearest=None if chosen else min(short, key=lambda one: one.error or 0.0, default=None),
        considered=tuple(considered),
        numbers=asked.numbers,
        result=known.get((chosen.model, chosen.resolution or 0)) if chosen else None,
        spent_cpu_s=sum(result.numerics.cpu_s for result in known.values()),
        omitted=omitted,
    )


def _after(asked: Question, model: Model) -> Considered:
    """A rung that costs no less than the one chosen, or of whose tolerance nothing is left: it is not run."""
    before = a_priori(asked, model)
    lost = "what all of them leave out takes all of the tolerance" if asked.within <= 0 else None
    short = lost is not None or (before is not None and not before.error <= asked.within)
    told = "" if before is None else f"expected within {percent(before.error)}, "
    return Considered(
        model=model.name,
        resolution=asked.resolution(model),
        cpu_s=asked.cost(model),
        verdict=Verdict.NOT_ENOUGH if short else Verdict.NOT_NEEDED,
        reason=lost or _main(before) if short else f"{told}for {asked.cost(model):.2g} CPU s",
        a_priori=before,
    )


def _keeps(before: Estimate | None, within: float) -> bool:
    return before is not None and before.sure and before.error <= within


def _considered(asked: Question, model: Model, secure: float) -> Considered:
    """Judge a rung; ``secure``, CPU seconds, is what the cheapest costs that is enough by its numbers."""
    resolution = asked.resolution(model)
    here, before = model.available(), a_priori(asked, model)

    def judged(
        verdict: Verdict, reason: str, after: Estimate | None = None, resolution: int = resolution
    ) -> Considered:
        return Considered(
            model=model.name,
            resolution=resolution,
            cpu_s=asked.cost(model, resolution),
            verdict=verdict,
            reason=reason,
            a_priori=before,
            a_posteriori=after,
        )

    if not here.available:
        return judged(Verdict.NOT_HERE, here.detail)
    above = asked.next(model)
    trial = asked.cost(model) + (asked.cost(above) if above else 0.0)
    doubtful = before is not None and before.sure and before.error > asked.within
    if before is not None and doubtful and (before.error > HOPELESS * asked.within or trial > secure):
        return judged(Verdict.NOT_ENOUGH, _main(before))
    if above is None:
        return _top(asked, model, judged)
    after = a_posteriori(asked, model)
    if after is None:
        if failure := asked.failed.get((model.name, resolution)):
            return judged(Verdict.IN_VAIN, str(failure))
        if _keeps(before, asked.within):
            return judged(Verdict.CHOSEN, _main(before))
        why = "its error is not known here, and no cheap rung can tell" if before is None else _main(before)
        return judged(Verdict.NOT_ENOUGH, why)
    agree = before is None or not before.sure or (before.error <= asked.within) == (after.error <= asked.within)
    if not agree:
        chain = asked.chain(model)
        dear = len(chain) < 3 or not affordable(asked, chain[2], model)
        decided = None if dear else a_posteriori(asked, model, above=2)
        if decided is not None:
            after = decided
        elif after.error <= asked.within:
            return judged(Verdict.NOT_ENOUGH, f"{_main(before)}; the two estimates disagree", after)
    enough = after.sure and after.error <= asked.within
    return judged(Verdict.CHOSEN if enough else Verdict.NOT_ENOUGH, after.reasons[0], after)


def _top(asked: Question, model: Model, judged: Callable[..., Considered]) -> Considered:
    """Judge a rung at the top: by its grids, from the coarsest that its numbers allow on, each by its own word."""
    before = a_priori(asked, model)
    last: tuple[Estimate, int] | None = None
    for resolution in (one for one in model.resolutions_of(asked.scene) if one >= asked.resolution(model)):
        after = by_its_own_word(asked, model, resolution)
        if after is None:
            break
        if after.error <= asked.within:
            return judged(Verdict.CHOSEN, after.reasons[0], after, resolution)
        last = after, resolution
    if last is not None:
        return judged(Verdict.NOT_ENOUGH, last[0].reasons[0], *last)
    if failure := asked.failed.get((model.name, asked.resolution(model))):
        return judged(Verdict.IN_VAIN, str(failure))
    if _keeps(before, asked.within):
        return judged(Verdict.CHOSEN, _main(before))
    return judged(Verdict.NOT_ENOUGH, "how far off its grid is is not known here" if before is None else _main(before))


def _main(estimate: Estimate | None) -> str:
    return estimate.reasons[0] if estimate is not None and estimate.reasons else "keeps all that the ladder knows"
