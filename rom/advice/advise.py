"""Choice of the cheapest model that is accurate enough, by fitted error laws and by comparison with other models."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from math import inf

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.rom.advice.estimates import (
    AdviceTask,
    Estimate,
    a_posteriori,
    a_priori,
    affordable,
    near,
    percent,
    self_estimate,
)
from roughfilm.rom.advice.laws import Numbers, Table, table
from roughfilm.rom.ladder.kind import Omission, Scene, kind_of_name
from roughfilm.rom.ladder.model import Model, Progress, silent
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result

MAX_ERROR_RATIO = 5.0
"""Ratio of the error by the laws to the tolerance above which a model is not run as a check."""


class Verdict(StrEnum):
    """The verdict on a model."""

    CHOSEN = "chosen"
    NOT_ENOUGH = "not enough"
    DOES_NOT_APPLY = "does not apply"
    NOT_HERE = "not on this machine"
    NOT_NEEDED = "not needed"
    FAILED = "failed"


@dataclass(frozen=True, kw_only=True)
class ModelVerdict:
    """The verdict on a model at a resolution.

    Attributes
    ----------
    model : name of the model.
    resolution : number of cells, points or nodes; None if the model does not apply.
    cpu_s : expected CPU time, s.
    verdict, reason : the verdict and the reason for it.
    a_priori : estimate of the error by the laws; None if unknown.
    a_posteriori : estimate of the error from runs; None if the models were not run.
    """

    model: str
    resolution: int | None
    cpu_s: float
    verdict: Verdict
    reason: str
    a_priori: Estimate | None = None
    a_posteriori: Estimate | None = None

    @property
    def error(self) -> float | None:
        """The largest expected error over the size of the quantity; None if unknown.

        It is the estimate from runs if there is one, otherwise that by the laws.
        """
        estimate = self.a_posteriori or self.a_priori
        return None if estimate is None else estimate.error

    @property
    def sure(self) -> bool:
        """Whether the scene is within the range of the sweeps to which the laws of the estimate were fitted."""
        estimate = self.a_posteriori or self.a_priori
        return estimate is not None and estimate.sure


@dataclass(frozen=True, kw_only=True)
class Advice:
    """The model that is accurate enough for a scene, and why.

    Attributes
    ----------
    quantity : name of the quantity.
    within : tolerated error over the size of the quantity.
    chosen : the cheapest model within the tolerance; None if none is known.
    nearest : the most accurate model if none is within the tolerance, otherwise None; also None if no error is known.
    considered : the verdict on every model of the kind, cheapest first.
    numbers : the dimensionless numbers of the scene.
    result : the result of the chosen model; None if the model was not run.
    spent_cpu_s : CPU time of all runs, s.
    omitted : the effect that every model of the kind omits, whose part is subtracted from the tolerance; None if there
        is no such effect.
    """

    quantity: str
    within: float
    chosen: ModelVerdict | None
    nearest: ModelVerdict | None
    considered: tuple[ModelVerdict, ...]
    numbers: Numbers
    result: Result | None
    spent_cpu_s: float
    omitted: Omission | None = None


def wanted(scene: Scene, name: str | None) -> str:
    """The name of the compared quantity with a given name or title; None means the first of the kind.

    Raises InputError for a name that the kind does not have.
    """
    compared = kind_of_name(scene.kind).compared
    if name is None:
        return next(iter(compared))
    for quantity, title in compared.items():
        if name in (quantity, title):
            return quantity
    titles = ", ".join(repr(title) for title in compared.values())
    raise InputError(f"quantity: got {name!r}; of a {scene.kind} it must be one of {titles}")


def shortfall(advice: Advice, title: str) -> str:
    """The message that no model is accurate enough, with the name of the most accurate one if it is known.

    ``title`` is the title of the quantity.
    """
    message = f"no model here is known to give the {title} within {percent(advice.within)}"
    if advice.omitted is not None and advice.omitted.part > advice.within / 2:
        return f"{message}: {advice.omitted.reason}"
    if advice.nearest is None or advice.nearest.error is None:
        return message
    if advice.nearest.sure:
        return f"{message}; {advice.nearest.model} comes nearest, {near(advice.nearest.error)}"
    return f"{message}, as the scene is outside the fitted range; {advice.nearest.model} may come nearest"


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
    """Choose the cheapest model, at the coarsest resolution, whose quantity is within a tolerance of the best model's.

    Models are judged in order of cost by two estimates: error laws fitted to sweeps, evaluated for the numbers of the
    scene, and the difference from the next model, if that model is cheap. A model is not run if the laws expect more
    than ``MAX_ERROR_RATIO`` tolerances, or more than the tolerance where the check costs more than the cheapest model
    that is accurate enough. If the estimates disagree, the model after the next decides, if it is cheap; otherwise the
    model is not chosen. The effect that all models omit is subtracted from the tolerance. An error is a bound that 95
    of 100 scenes do not exceed.

    Parameters
    ----------
    scene : the scene.
    models : the models for this kind of scene.
    quantity : name of a quantity that the kind compares.
    within : tolerated error over the quantity's size, above 0 and below 1.
    laws : the error laws, by default the table of this package.
    run : run(model, resolution), which returns a result; by default ``solve`` of the model. A caller may return stored
        results.
    progress : called with the done fraction and a few words.

    Raises
    ------
    InputError
        If the tolerance is out of range, or no model applies to the scene.
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
    task = AdviceTask(
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
    if not task.models:
        raise InputError(f"scene: no model applies: {'; '.join(fit.reason for fit in fits.values())}")
    considered = [
        ModelVerdict(model=name, resolution=None, cpu_s=0.0, verdict=Verdict.DOES_NOT_APPLY, reason=fit.reason)
        for name, fit in fits.items()
        if not fit.applies
    ]
    chosen: ModelVerdict | None = None
    available = [model for model in task.models if model.available().available]
    secure = min((task.cost(model) for model in available if _within(a_priori(task, model), left)), default=inf)
    for model in sorted(task.models, key=lambda model: (task.cost(model), -len(model.keeps))):
        one = _after(task, model) if chosen or left <= 0 else _verdict(task, model, secure)
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
        numbers=task.numbers,
        result=known.get((chosen.model, chosen.resolution or 0)) if chosen else None,
        spent_cpu_s=sum(result.numerics.cpu_s for result in known.values()),
        omitted=omitted,
    )


def _after(task: AdviceTask, model: Model) -> ModelVerdict:
    """The verdict on a model that is not run, since a cheaper one is chosen or the tolerance is used up."""
    before = a_priori(task, model)
    lost = "the effect that all models leave out exceeds the tolerance" if task.within <= 0 else None
    short = lost is not None or (before is not None and not before.error <= task.within)
    expected = "" if before is None else f"expected within {percent(before.error)}, "
    return ModelVerdict(
        model=model.name,
        resolution=task.resolution(model),
        cpu_s=task.cost(model),
        verdict=Verdict.NOT_ENOUGH if short else Verdict.NOT_NEEDED,
        reason=lost or _main(before) if short else f"{expected}for {task.cost(model):.2g} CPU s",
        a_priori=before,
    )


def _within(before: Estimate | None, within: float) -> bool:
    return before is not None and before.sure and before.error <= within


def _verdict(task: AdviceTask, model: Model, secure: float) -> ModelVerdict:
    """The verdict on a model; ``secure`` is the cost of the cheapest model that the laws accept, CPU seconds."""
    resolution = task.resolution(model)
    here, before = model.available(), a_priori(task, model)

    def judged(
        verdict: Verdict, reason: str, after: Estimate | None = None, resolution: int = resolution
    ) -> ModelVerdict:
        return ModelVerdict(
            model=model.name,
            resolution=resolution,
            cpu_s=task.cost(model, resolution),
            verdict=verdict,
            reason=reason,
            a_priori=before,
            a_posteriori=after,
        )

    if not here.available:
        return judged(Verdict.NOT_HERE, here.detail)
    above = task.next(model)
    trial = task.cost(model) + (task.cost(above) if above else 0.0)
    rejected = before is not None and before.sure and before.error > task.within
    if before is not None and rejected and (before.error > MAX_ERROR_RATIO * task.within or trial > secure):
        return judged(Verdict.NOT_ENOUGH, _main(before))
    if above is None:
        return _top(task, model, judged)
    after = a_posteriori(task, model)
    if after is None:
        if failure := task.failed.get((model.name, resolution)):
            return judged(Verdict.FAILED, str(failure))
        if _within(before, task.within):
            return judged(Verdict.CHOSEN, _main(before))
        why = "its error is not known here, and no cheap model can estimate it" if before is None else _main(before)
        return judged(Verdict.NOT_ENOUGH, why)
    agree = before is None or not before.sure or (before.error <= task.within) == (after.error <= task.within)
    if not agree:
        chain = task.chain(model)
        costly = len(chain) < 3 or not affordable(task, chain[2], model)
        decided = None if costly else a_posteriori(task, model, above=2)
        if decided is not None:
            after = decided
        elif after.error <= task.within:
            return judged(Verdict.NOT_ENOUGH, f"{_main(before)}; the two estimates disagree", after)
    enough = after.sure and after.error <= task.within
    return judged(Verdict.CHOSEN if enough else Verdict.NOT_ENOUGH, after.reasons[0], after)


def _top(task: AdviceTask, model: Model, judged: Callable[..., ModelVerdict]) -> ModelVerdict:
    """The verdict on the most complete model, by its numerical uncertainty on successively finer grids."""
    before = a_priori(task, model)
    last: tuple[Estimate, int] | None = None
    for resolution in (one for one in model.resolutions_of(task.scene) if one >= task.resolution(model)):
        after = self_estimate(task, model, resolution)
        if after is None:
            break
        if after.error <= task.within:
            return judged(Verdict.CHOSEN, after.reasons[0], after, resolution)
        last = after, resolution
    if last is not None:
        return judged(Verdict.NOT_ENOUGH, last[0].reasons[0], *last)
    if failure := task.failed.get((model.name, task.resolution(model))):
        return judged(Verdict.FAILED, str(failure))
    if _within(before, task.within):
        return judged(Verdict.CHOSEN, _main(before))
    return judged(
        Verdict.NOT_ENOUGH,
        "the discretisation error of this model is not known here" if before is None else _main(before),
    )


def _main(estimate: Estimate | None) -> str:
    return (
        estimate.reasons[0]
        if estimate is not None and estimate.reasons
        else "includes every effect available for this kind of scene"
    )
