"""Choice of the cheapest model that is accurate enough, by fitted error laws and by comparison with other models."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.rom.advice.estimates import (
    AdviceTask,
    Estimate,
    a_posteriori,
    a_priori,
    affordable,
    combined,
    with_own_uncertainty,
)
from roughfilm.rom.advice.laws import Numbers, Table, lawful, table
from roughfilm.rom.advice.stated import StatedError, percent
from roughfilm.rom.ladder.kind import InTime, Omission, Scene, kind_of_scene
from roughfilm.rom.ladder.model import Model, Progress, best_for, silent
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result

MAX_ERROR_RATIO = 5.0
"""Ratio of the error by the laws to the tolerance above which a model is not run as a check."""

DEFAULT_TOLERANCE = 0.05
"""Tolerated error over the size of a quantity where none is given."""


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
    verdict, reason : the verdict and the reason for it, without a number for the error.
    a_priori : estimate of the error by the laws; None if unknown.
    a_posteriori : estimate of the error from runs; None if the models were not run.
    omitted : the effect that the model leaves out and that the laws do not count, whose part adds to the error.
    """

    model: str
    resolution: int | None
    cpu_s: float
    verdict: Verdict
    reason: str
    a_priori: Estimate | None = None
    a_posteriori: Estimate | None = None
    omitted: Omission | None = None

    @property
    def estimate(self) -> Estimate | None:
        """The estimate that decides, see :func:`roughfilm.rom.advice.estimates.combined`; None if there is none."""
        return combined(self.a_priori, self.a_posteriori)

    @property
    def stated(self) -> StatedError | None:
        """The error of the model in the quantity as it is stated everywhere; None if it is unknown."""
        return None if self.estimate is None or not self.sure else self.estimate.stated(self.omitted)

    @property
    def error(self) -> float | None:
        """The largest expected error over the size of the quantity; None if unknown."""
        return None if self.estimate is None else self.estimate.error + (self.omitted.part if self.omitted else 0.0)

    @property
    def why(self) -> str:
        """The error with its source, and the reason for the verdict."""
        return self.reason if self.stated is None else f"error {self.stated.words}; {self.reason}"

    @property
    def sure(self) -> bool:
        """Whether the scene is within the range of the scenes to which the laws of the estimate were fitted."""
        return self.estimate is not None and self.estimate.sure


@dataclass(frozen=True, kw_only=True)
class Advice:
    """The model that is accurate enough for a scene, and why.

    Attributes
    ----------
    quantity : name of the quantity.
    title : name of the quantity in a sentence.
    within : tolerated error over the size of the quantity.
    chosen : the cheapest model within the tolerance; None if none is known.
    nearest : the most accurate model if none is within the tolerance, otherwise None; also None if no error is known.
    fallback : the verdict on the model to take if none is within the tolerance: ``nearest`` if its error is sure,
        otherwise the most complete one that has not failed; None if there is none, and if a model is chosen.
    finer : the cheapest model at a resolution beyond its usual ones that the laws expect to be within the tolerance, if
        none is chosen; None if no resolution is expected to suffice.
    considered : the verdict on every model of the kind, cheapest first.
    numbers : the dimensionless numbers of the scene.
    result : the result of the chosen model, or of ``fallback``; None if the model was not run.
    spent_cpu_s : CPU time of all runs, s.
    omitted : by model, the effect that it leaves out and that the laws do not count, whose part is subtracted from the
        tolerance.
    outside : by model, the ways in which the scene, or a solution of it, is outside the range of the model.
    in_time : what a motion in time means; None for a steady scene.
    """

    quantity: str
    title: str
    within: float
    chosen: ModelVerdict | None
    nearest: ModelVerdict | None
    fallback: ModelVerdict | None
    finer: ModelVerdict | None
    considered: tuple[ModelVerdict, ...]
    numbers: Numbers
    result: Result | None
    spent_cpu_s: float
    omitted: Mapping[str, Omission] = field(default_factory=dict)
    outside: Mapping[str, Sequence[str]] = field(default_factory=dict)
    in_time: InTime | None = None

    def __repr__(self) -> str:
        taken = self.chosen
        found = "none" if taken is None else f"{taken.model} at resolution {taken.resolution}"
        error = "" if taken is None or taken.error is None else f" with an error of at most {100 * taken.error:.2g} %"
        return f"<Advice for the {self.title} within {100 * self.within:g} %: {found}{error}>"


def wanted(scene: Scene, name: str | None) -> str:
    """The name of the quantity with a given name or title; None means the first of the kind.

    Raises InputError for a name that no quantity of the kind has.
    """
    kind = kind_of_scene(kind_of_scene(scene).steady(scene))
    if name is None:
        return next(iter(kind.compared))
    for quantity, title in (*kind.named.items(), *kind.reported.items()):
        if isinstance(name, str) and name in (quantity, title):
            per_width = f"{quantity}_per_width"
            return per_width if getattr(scene, "wide", False) and per_width in kind.reported else quantity
    titles = ", ".join(repr(title) for title in kind.titles.values())
    got = repr(name)[:60]
    raise InputError(
        f"quantity: got {got}; of a {scene.kind} it must be one of {titles}, or another one that a result shows"
    )


def shortfall(advice: Advice) -> str:
    """The message that no model is accurate enough, with the remedy or the most accurate model if they are known."""
    message = f"no model here is known to give the {advice.title} within {percent(advice.within)}"
    taken = advice.nearest or advice.fallback
    if taken is not None and advice.outside.get(taken.model):
        return f"{message}: {'; '.join(advice.outside[taken.model])}"
    omitted = None if taken is None else advice.omitted.get(taken.model)
    if omitted is not None and omitted.part > advice.within / 2:
        return f"{message}: {omitted.reason}"
    if advice.finer is not None:
        cost = f"{advice.finer.cpu_s:.2g} CPU s"
        return f"{message}; {advice.finer.model} at resolution {advice.finer.resolution} is expected to ({cost})"
    if advice.nearest is None or advice.nearest.error is None:
        return message
    if advice.nearest.stated is not None:
        return f"{message}; {advice.nearest.model} comes nearest, error {advice.nearest.stated.words}"
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

    Pairs of a model and a resolution are judged in order of cost, until one is accurate enough. The error of a pair is
    the smaller of two estimates: by error laws fitted to random scenes, and by the difference from the next model, if
    that model is cheap and the checks of all cheaper pairs cost little (:func:`affordable`). Neither depends on the
    tolerance, so that a looser tolerance never chooses a more expensive pair. A pair is not run if the laws expect more
    than ``MAX_ERROR_RATIO`` tolerances. An effect that a model leaves out and that the laws do not count is subtracted
    from its tolerance. A model outside whose range the scene or a solution is (``Kind.outside``, ``Result.outside``)
    has no known error and is not chosen. An error is a bound that 95 of 100 scenes do not exceed. A scene whose load
    changes in time is judged at its largest load.

    Parameters
    ----------
    scene : the scene.
    models : the models for this kind of scene.
    quantity : name of a quantity of the kind.
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
    given = kind_of_scene(scene)
    moving, scene = given.in_time(scene, within), given.steady(scene)
    kind = kind_of_scene(scene)
    known: dict[tuple[str, int], Result] = {}
    failed: dict[tuple[str, int], Exception] = {}
    fits = {model.name: model.applies(scene) for model in models}
    applying = [model for model in models if fits[model.name].applies]
    outside = {model.name: tuple(kind.outside(scene, model, None)) for model in applying}

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
            outside[model.name] = tuple(dict.fromkeys((*outside[model.name], *known[key].outside)))
        return known[key]

    task = AdviceTask(
        scene=scene,
        kind=kind,
        models=applying,
        quantity=quantity,
        title=kind.named[quantity],
        table=lawful(laws or table(), kind.names_of_laws, holds=kind.lawful),
        numbers=kind.numbers(scene),
        run=solved,
        failed=failed,
        omitted=_omitted(scene, applying, quantity),
        outside=outside,
        within=within,
    )
    if not task.models:
        raise InputError(f"scene: no model applies: {'; '.join(fit.reason for fit in fits.values())}")
    does_not_apply = [
        ModelVerdict(model=name, resolution=None, cpu_s=0.0, verdict=Verdict.DOES_NOT_APPLY, reason=fit.reason)
        for name, fit in fits.items()
        if not fit.applies
    ]
    judged = _judged(task)
    chosen = next((one for one in judged if one.verdict is Verdict.CHOSEN), None)
    here = {model.name for model in task.models if model.available().available}
    candidates = [one for one in judged if one.verdict is Verdict.NOT_ENOUGH and one.model in here]
    short = [one for one in candidates if one.error is not None and math.isfinite(one.error)]
    nearest = None if chosen else min(short, key=lambda one: (not one.sure, one.error or 0.0), default=None)
    sure = nearest if nearest is not None and nearest.sure else None
    fallback = None if chosen else sure or _most_complete(task, judged)
    taken = chosen or fallback
    return Advice(
        quantity=quantity,
        title=task.title,
        within=within,
        chosen=chosen,
        nearest=nearest,
        fallback=fallback,
        finer=None if chosen else _finer(task),
        considered=(*does_not_apply, *judged),
        numbers=task.numbers,
        result=known.get((taken.model, taken.resolution or 0)) if taken else None,
        spent_cpu_s=sum(result.numerics.cpu_s for result in known.values()),
        omitted=task.omitted,
        outside={name: reasons for name, reasons in outside.items() if reasons},
        in_time=moving,
    )


def _omitted(scene: Scene, models: Sequence[Model], quantity: str) -> dict[str, Omission]:
    """The effects that the models leave out and that the laws do not count, by model."""
    kind = kind_of_scene(scene)
    found = {model.name: kind.omitted(scene, model, quantity) for model in models}
    return {name: omission for name, omission in found.items() if omission is not None}


def _judged(task: AdviceTask) -> list[ModelVerdict]:
    """The verdict on every model that applies, cheapest first: at the accepted resolution, or at the most accurate."""
    pairs = [(model, resolution) for model in task.models for resolution in _considered(task, model)]
    pairs.sort(key=lambda pair: (task.cost(*pair), -len(pair[0].keeps)))
    checked = affordable(task, pairs)
    verdicts: dict[str, ModelVerdict] = {}
    hopeless: set[str] = set()
    chosen = False
    for model, resolution in pairs:
        if model.name in hopeless:
            continue
        within = task.left(model)
        one = (
            _after(task, model, resolution)
            if chosen or within <= 0
            else _verdict(task, model, resolution, checked=(model.name, resolution) in checked)
        )
        before = verdicts.get(model.name)
        if before is None or _better(one, before):
            verdicts[model.name] = one
        chosen = chosen or one.verdict is Verdict.CHOSEN
        decided = one.verdict in (Verdict.CHOSEN, Verdict.NOT_HERE, Verdict.NOT_NEEDED)
        if decided or (
            one.estimate is not None and one.estimate.least - (task.grid(model, resolution) or 0.0) > within
        ):
            hopeless.add(model.name)
    return sorted(verdicts.values(), key=lambda one: one.cpu_s)


def _considered(task: AdviceTask, model: Model) -> tuple[int, ...]:
    """The resolutions at which a model is considered; the default alone outside of its range."""
    return (model.resolution_of(task.scene),) if task.outside[model.name] else task.resolutions(model)


def _most_complete(task: AdviceTask, judged: Sequence[ModelVerdict]) -> ModelVerdict | None:
    """The verdict on the most complete model, in its range if one is, that runs here; None if all have failed."""
    failing = (Verdict.NOT_HERE, Verdict.FAILED)
    by_name = {one.model: one for one in judged if one.verdict not in failing}
    here = [model for model in task.models if model.name in by_name and model.available().available]
    here = [model for model in here if not task.outside[model.name]] or here
    return by_name[best_for(task.scene, here).name] if here else None


def _better(one: ModelVerdict, other: ModelVerdict) -> bool:
    """Whether a verdict at a finer resolution says more than that at a coarser one."""
    if one.verdict in (Verdict.CHOSEN, Verdict.NOT_NEEDED) or one.error is None or other.error is None:
        return one.verdict is not Verdict.FAILED
    return (one.sure, -one.error) > (other.sure, -other.error)


def _finer(task: AdviceTask) -> ModelVerdict | None:
    """The cheapest model, at a resolution beyond its series, that the laws expect to be within the tolerance."""
    expected = []
    for model in task.models:
        offered, within = model.offered(task.scene), task.left(model)
        resolution = 2 * max(offered.series)
        while resolution <= offered.most and model.available().available and within > 0:
            before = a_priori(task, model, resolution)
            if _accepts(before, within):
                expected.append(_as_verdict(task, model, resolution, Verdict.NOT_NEEDED, _main(before), before))
                break
            resolution *= 2
    return min(expected, key=lambda one: one.cpu_s, default=None)


def _as_verdict(
    task: AdviceTask,
    model: Model,
    resolution: int,
    verdict: Verdict,
    reason: str,
    before: Estimate | None,
    after: Estimate | None = None,
) -> ModelVerdict:
    return ModelVerdict(
        model=model.name,
        resolution=resolution,
        cpu_s=task.cost(model, resolution),
        verdict=verdict,
        reason=reason,
        a_priori=before,
        a_posteriori=after,
        omitted=task.omitted.get(model.name),
    )


def _after(task: AdviceTask, model: Model, resolution: int) -> ModelVerdict:
    """The verdict on a model that is not run, since a cheaper one is chosen or the tolerance is used up."""
    before, within = a_priori(task, model, resolution), task.left(model)
    if task.outside[model.name]:
        return _outside(task, model, resolution)
    if within <= 0:
        reason = "an effect that it leaves out and that the laws do not count exceeds the tolerance"
        return _as_verdict(task, model, resolution, Verdict.NOT_ENOUGH, reason, before)
    if before is not None and not before.error <= within:
        return _as_verdict(task, model, resolution, Verdict.NOT_ENOUGH, _main(before), before)
    if before is None or (before.error == 0 and task.at_full_resolution(model, resolution)):
        return _as_verdict(task, model, resolution, Verdict.NOT_NEEDED, "no law gives its error", None)
    reason = f"{task.cost(model, resolution):.2g} CPU s"
    return _as_verdict(task, model, resolution, Verdict.NOT_NEEDED, reason, before)


def _outside(task: AdviceTask, model: Model, resolution: int) -> ModelVerdict:
    """The verdict on a model outside of its range."""
    reason = f"outside its range: {'; '.join(task.outside[model.name])}"
    return _as_verdict(task, model, resolution, Verdict.NOT_ENOUGH, reason, None)


def _accepts(estimate: Estimate | None, within: float) -> bool:
    return estimate is not None and estimate.sure and estimate.error <= within


def _verdict(task: AdviceTask, model: Model, resolution: int, *, checked: bool) -> ModelVerdict:
    """The verdict on a model at a resolution, which is run if it is to be ``checked``."""
    within = task.left(model)
    here, before = model.available(), a_priori(task, model, resolution)
    if not here.available:
        return _as_verdict(task, model, resolution, Verdict.NOT_HERE, here.detail, before)
    if task.outside[model.name]:
        return _outside(task, model, resolution)
    if before is not None and before.sure and before.error > MAX_ERROR_RATIO * within:
        return _as_verdict(task, model, resolution, Verdict.NOT_ENOUGH, _main(before), before)
    after = a_posteriori(task, model, resolution) if checked else None
    if failure := task.failed.get((model.name, resolution)):
        return _as_verdict(task, model, resolution, Verdict.FAILED, str(failure), before)
    estimate = combined(before, after)
    if estimate is not None and _accepts(estimate, within):
        own = with_own_uncertainty(task, model, resolution, estimate)
        estimate, after = own, after if own is estimate else own
    if task.outside[model.name]:
        return _outside(task, model, resolution)
    verdict = Verdict.CHOSEN if _accepts(estimate, within) else Verdict.NOT_ENOUGH
    return _as_verdict(task, model, resolution, verdict, _main(estimate), before, after)


def _main(estimate: Estimate | None) -> str:
    if estimate is None:
        return "its error is not known here, and no cheap model can estimate it"
    return estimate.reasons[0] if estimate.reasons else "includes every effect available for this kind of scene"
