"""Estimates of the error of a model, by laws from the numbers of a scene alone or from runs of other models."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.rom.advice.laws import RESOLVING, Law, Numbers, Step, Table, on_grid
from roughfilm.rom.advice.stated import BY_CORRECTION, BY_ITS_RUN, BY_LAWS, StatedError
from roughfilm.rom.ladder.kind import Kind, Omission, Scene
from roughfilm.rom.ladder.model import Model, best_for, find
from roughfilm.rom.ladder.result import BOUND, Result

MAX_COST_OF_BEST = 0.01
"""Largest ratio of the cost of a check to that of the best model at its default resolution."""

MAX_COST_OF_MODEL = 3.0
"""Largest ratio of the cost of a check to that of the checked model; one of the two limits must be met."""

BUDGET = 0.5
"""Largest ratio of the cost of all checks to that of the best model here at its finest usual resolution."""

CHECK_FRACTION = 1 / 3
"""Largest ratio of the error by the resolution of a check to the error that the laws expect of the checked model."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """An estimate of the error of a model.

    Attributes
    ----------
    error : largest expected error over the size of the quantity.
    reasons : reasons for the error as text, the most important first.
    sure : whether the scene is within the range of the scenes to which the laws were fitted.
    least : the error that the model has at least, as runs show; 0 if they do not show any.
    decides : whether it replaces the estimate by laws: the most complete model states it for its own run.
    source : origin of the error in words, see :class:`roughfilm.rom.advice.stated.StatedError`.
    difference : signed difference from the model that was run too; None if the error is not measured.
    """

    error: float
    reasons: tuple[str, ...]
    sure: bool = True
    least: float = 0.0
    decides: bool = False
    source: str = BY_LAWS
    difference: float | None = None

    def stated(self, omitted: Omission | None = None) -> StatedError:
        """The error as it is stated, with the part of the effect that the laws do not count."""
        part = 0.0 if omitted is None else omitted.part
        error = self.error + part
        beyond = None if self.difference is None else error - abs(self.difference)
        mostly = omitted is not None and omitted.source and part > self.error and self.difference is None
        source = omitted.source if omitted is not None and mostly else self.source
        return StatedError(error=error, source=source, difference=self.difference, uncertainty=beyond)


@dataclass(frozen=True, kw_only=True)
class AdviceTask:
    """The task of choosing a model for a scene.

    Attributes
    ----------
    scene, kind : the scene and its kind.
    models : the models that apply to the scene.
    quantity : name of the quantity.
    title : its name in a sentence.
    table : the error laws.
    numbers : dimensionless numbers of the scene.
    run : run(model, resolution), which returns a result.
    failed : error of every run that failed, by name of the model and resolution.
    omitted : by model, the effect that it leaves out and that the laws do not count.
    outside : by model, the ways in which the scene, or a solution of it, is outside the range of the model.
    within : tolerated error over the size of the quantity.
    """

    scene: Scene
    kind: Kind
    models: Sequence[Model]
    quantity: str
    title: str
    table: Table
    numbers: Numbers
    run: Callable[[Model, int], Result]
    failed: Mapping[tuple[str, int], Exception] = field(default_factory=dict)
    omitted: Mapping[str, Omission] = field(default_factory=dict)
    outside: Mapping[str, Sequence[str]] = field(default_factory=dict)
    within: float = 0.0

    def part_omitted(self, model: Model) -> float:
        """The part of the effect that a model leaves out and that the laws do not count; 0 without one."""
        return self.omitted[model.name].part if model.name in self.omitted else 0.0

    def left(self, model: Model) -> float:
        """The tolerance that remains for the error by the laws and by runs of a model."""
        return self.within - self.part_omitted(model)

    def step(self, model: Model) -> Step | None:
        """The step from a model to the next one that applies; None for the most complete model."""
        return self.table.step(self.kind.name_of_laws, model.name, {other.name for other in self.models})

    def next(self, model: Model) -> Model | None:
        """The next more complete model; None for the most complete one."""
        step = self.step(model)
        return None if step is None else find(self.models, self.kind.name, step.towards)

    def chain(self, model: Model) -> list[Model]:
        """The chain of models from a given one to the most complete."""
        chain = [model]
        while (above := self.next(chain[-1])) is not None:
            chain.append(above)
        return chain

    def is_best(self, model: Model) -> bool:
        """Whether no other model for the scene leaves out less; one outside its range counts if all are."""
        inside = [one for one in self.models if not self.outside.get(one.name)]
        return model.name == best_for(self.scene, inside or self.models).name

    def has_grid_law_alone(self, model: Model) -> bool:
        """Whether a model has a law of the error by its resolution, but none of what it leaves out."""
        own = self.kind.laws_of_grids(model.name) != self.kind.name_of_laws
        return own and self.grid_law(model) is not None

    def states_left_out(self, model: Model) -> bool:
        """Whether an omission states the size of what a model leaves out, or other models leave out no less."""
        own = self.omitted.get(model.name)
        return (own is not None and bool(own.source)) or self.is_best(model)

    def grid(self, model: Model, resolution: int) -> float | None:
        """The error by a resolution over the size of the quantity, by the laws; None without a law.

        It is 0 at the full resolution of a surface, which resolves all waves; :func:`with_own_uncertainty` adds the
        rest. Without a law it is 0 at the default resolution of a model whose promise contains it.
        """
        if self.at_full_resolution(model, resolution):
            return 0.0
        law, numbers = self.grid_law(model), on_grid(self.numbers, resolution)
        if law is None and self.promised(model) and resolution == model.resolution_of(self.scene):
            return 0.0
        return law.error(numbers, RESOLVING) if law is not None and law.has_numbers(numbers) else None

    def promised(self, model: Model) -> bool:
        """Whether a promise of a model bounds the quantity."""
        return self.quantity in self.table.promise(self.kind.name_of_laws, model.name).laws

    def at_full_resolution(self, model: Model, resolution: int) -> bool:
        """Whether a model without an order of convergence for the scene has its finest resolution.

        It then resolves all waves of a surface, or integrates a film exactly but for rounding.
        """
        return model.order_of(self.scene) is None and resolution >= max(model.resolutions_of(self.scene))

    def grid_law(self, model: Model) -> Law | None:
        """The law of the error by the resolution of a model; None if there is none."""
        return self.table.grid(self.kind.laws_of_grids(model.name), model.name, self.quantity)

    def beyond_grids(self, model: Model, resolution: int) -> str | None:
        """The name of a number outside the range of the law over resolutions of a model; None if there is none."""
        law, numbers = self.grid_law(model), on_grid(self.numbers, resolution)
        return law.beyond(numbers, RESOLVING) if law is not None and law.has_numbers(numbers) else None

    def resolutions(self, model: Model) -> tuple[int, ...]:
        """The resolutions at which a model is considered, from coarse to fine: those whose error has a law.

        Without a law this is the default resolution. The most complete model, if it runs in this process, is considered
        at all resolutions, as it estimates its own error.
        """
        offered = model.resolutions_of(self.scene)
        if self.next(model) is None and not model.outside:
            return offered
        known = tuple(one for one in offered if self.grid(model, one) is not None)
        return known or (model.resolution_of(self.scene),)

    def as_fine(self, model: Model, error: float) -> int:
        """The coarsest resolution of a model whose error by the laws is at most ``error``.

        The result is the finest one if no resolution meets this, and the default of the model without a law.
        """
        known = [one for one in model.resolutions_of(self.scene) if self.grid(model, one) is not None]
        fine = (one for one in known if (self.grid(model, one) or 0.0) <= error)
        return next(fine, max(known, default=model.resolution_of(self.scene)))

    def cost(self, model: Model, resolution: int) -> float:
        """The expected CPU time of a model at a resolution, s."""
        return model.cost(self.scene, resolution)

    def difference(self, one: Result, other: Result) -> float:
        """The value of the quantity in one result minus that in another, over the smaller of its sizes in them."""
        change = one.quantities[self.quantity].value - other.quantities[self.quantity].value
        size = min(self.kind.scale_of(result, self.quantity) for result in (one, other))
        return math.copysign(over(abs(change), size), change)

    def corrects(self, model: Model) -> bool:
        """Whether the results of a model bound its error in the quantity by the correction that it makes."""
        return self.quantity in self.kind.bounded(self.scene, model)

    def correction(self, result: Result) -> float | None:
        """The bound of the error of the model in a result, over the size of the quantity; None if it has none.

        The true quantity may be smaller than that of the result by the bound; from a half on, this says nothing.
        """
        bound = result.numerics.details.get(f"{BOUND}{self.quantity}")
        if bound is None:
            return None
        size = self.kind.scale_of(result, self.quantity)
        return over(bound, max(size - bound, size / 2))

    def uncertainty(self, result: Result) -> float | None:
        """The numerical uncertainty of the quantity in a result over its size; None if it is unknown."""
        uncertainty = result[self.quantity].uncertainty
        return None if uncertainty is None else over(uncertainty, self.kind.scale_of(result, self.quantity))


def over(error: float, size: float) -> float:
    """The ratio of an error to a size; 0 for an error of 0, infinite for a size of 0 or if one of them is NaN."""
    if error == 0:
        return 0.0
    fraction = error / size if size > 0 else math.inf
    return math.inf if math.isnan(fraction) else fraction


def combined(before: Estimate | None, after: Estimate | None) -> Estimate | None:
    """The smaller of two estimates, by the laws and from runs; that from runs if the laws do not hold for the scene.

    They do not hold outside of the range of their fit, or if runs show that the error is larger than the laws expect.
    An uncertainty that the most complete model states itself always counts.
    """
    if before is None or after is None:
        return before if after is None else after
    if after.decides:
        return after
    wrong = not before.sure or after.least > before.error
    return after if wrong or (after.sure and after.error <= before.error) else before


def a_priori(task: AdviceTask, model: Model, resolution: int, stated: float | None = None) -> Estimate | None:
    """The estimate by the laws: the promise of a model, or the sum of the steps above it, and the resolution.

    The parts are independent bounds e_i, which add up to √(Σ e_i²). The result is None if a part has no law, unless an
    effect that the laws do not count stands for the error of the most complete model, or if nothing states what a model
    with a law of its resolution alone leaves out, or if the scene is outside the range of the model. For a model
    without a promise, the uncertainty that it states for a run replaces the law over resolutions.
    """
    if task.outside.get(model.name) or (task.has_grid_law_alone(model) and not task.states_left_out(model)):
        return None
    left = left_out(task, task.chain(model))
    by_law = stated is None or task.promised(model)
    grid = task.grid(model, resolution) if by_law else stated
    if left is None or grid is None:
        return None if left is None else _by_omission(task, model)
    parts, reasons, sure = left
    if grid > 0 and not by_law:
        parts = [*parts, grid]
        reasons = [*reasons, (grid, f"uncertainty of its own at resolution {resolution}")]
    elif grid > 0:
        beyond = task.beyond_grids(model, resolution)
        reason = f"error by the resolution of {resolution}"
        reasons = [*reasons, (grid, reason + _range_note(task, beyond, task.grid_law(model)))]
        parts, sure = [*parts, grid], sure and beyond is None
    largest_first = sorted(reasons, key=lambda pair: -pair[0])
    return Estimate(
        error=math.hypot(*parts),
        reasons=tuple(reason for _, reason in largest_first),
        sure=sure,
        source=BY_LAWS if by_law or len(parts) > 1 else BY_ITS_RUN,
    )


def _by_omission(task: AdviceTask, model: Model) -> Estimate | None:
    """The estimate for the most complete model whose omitted effect stands for its error; None without one.

    The error is 0, as the part of the effect is added to it. The model states the uncertainty of its own run, as models
    that run in this process do.
    """
    own = task.omitted.get(model.name)
    if own is None or not own.source or model.outside or task.next(model) is not None:
        return None
    return Estimate(error=0.0, reasons=(own.reason,), source=own.source)


def left_out(task: AdviceTask, chain: Sequence[Model]) -> tuple[list[float], list[tuple[float, str]], bool] | None:
    """The errors by the effects that a model leaves out, the errors with reasons, and whether all are sure.

    ``chain`` is the chain from the model to the most complete one. The result is None if a law is missing.
    """
    parts: list[float] = []
    reasons: list[tuple[float, str]] = []
    sure, contained = True, 0
    for place, model in enumerate(chain):
        if place < contained:
            continue
        promise = task.table.promise(task.kind.name_of_laws, model.name)
        law = promise.laws.get(task.quantity)
        step = task.step(model)
        own = on_grid(task.numbers, model.resolution_of(task.scene))
        if law is not None and law.has_numbers(own):
            error, beyond = law.error(own, RESOLVING), law.beyond(own, RESOLVING)
            names = [one.name for one in chain]
            contained = names.index(promise.towards) if promise.towards in names else len(chain)
            reason = _promise_reason(task, chain[place:contained]) + _range_note(task, beyond, law)
            parts, reasons = [*parts, error], [*reasons, (error, reason)]
            sure = sure and beyond is None
            continue
        if step is None:
            break
        law = step.left_out.get(task.quantity)
        if law is None or not law.has_numbers(task.numbers):
            return None
        error, beyond = law.error(task.numbers, (step.measure,)), law.beyond(task.numbers, (step.measure,))
        parts.append(error)
        sure = sure and beyond is None
        reasons.append((error, _reason(task, step) + _range_note(task, beyond, law)))
    return parts, reasons, sure


def _promise_reason(task: AdviceTask, chain: Sequence[Model]) -> str:
    adds = [step.adds for model in chain if (step := task.step(model)) is not None]
    adds = [one for one in adds if one.partition(" beyond ")[0] == one or one.partition(" beyond ")[0] not in adds]
    return f"leaves out {' and '.join(adds)}"


def _reason(task: AdviceTask, step: Step) -> str:
    value = task.numbers.get(step.measure)
    number = "" if value is None else f", {task.kind.symbols[step.measure]} = {value:.2g}"
    return f"leaves out {step.adds}{number}"


def _range_note(task: AdviceTask, beyond: str | None, law: Law | None) -> str:
    if beyond is None or law is None:
        return ""
    least, most = law.reach[beyond]
    if beyond in RESOLVING:
        return f" (and the fitted range begins at {least:.2g} {beyond.replace('_', ' ')})"
    symbol, value = task.kind.symbols[beyond], task.numbers[beyond]
    return f" (and {symbol} = {value:.2g} is outside the fitted range of {least:.2g} to {most:.2g})"


def a_posteriori(task: AdviceTask, model: Model, resolution: int) -> Estimate | None:
    """The estimate of the error of a model from runs; None if there is no cheap model to compare with, or a run fails.

    The model is compared with the next one: the difference plus the error of that model bounds the error. The most
    complete model, if it runs in this process, is judged by the numerical uncertainty of its own run, as is one whose
    omission states what it leaves out.
    """
    runs = runs_of_check(task, model, resolution)
    if len(runs) == 2:
        return _from_above(task, model, resolution, *runs[1])
    own = _from_correction if task.corrects(model) else _from_itself
    return own(task, model, resolution) if runs else None


def runs_of_check(task: AdviceTask, model: Model, resolution: int) -> tuple[tuple[Model, int], ...]:
    """The models and resolutions that are run to check a model; none if no check is cheap.

    The resolution of the next model is one whose error is at most ``CHECK_FRACTION`` of that which the laws expect. The
    uncertainty of its own run checks the best model, and one with a law of its resolution whose omission states what it
    leaves out. Of another one without a next model, as the laws have none for the scene, it does not contain that.
    """
    above = task.next(model)
    if task.corrects(model):
        return ((model, resolution),)
    if above is None:
        checks = task.states_left_out(model) if task.has_grid_law_alone(model) else task.is_best(model)
        return ((model, resolution),) if checks and not model.outside else ()
    before = a_priori(task, model, resolution)
    finer = task.as_fine(above, 0.0 if before is None else CHECK_FRACTION * before.error)
    if above.available().available and _cheap(task, task.cost(above, finer), task.cost(model, resolution)):
        return (model, resolution), (above, finer)
    return ()


def affordable(task: AdviceTask, pairs: Sequence[tuple[Model, int]]) -> set[tuple[str, int]]:
    """The pairs of a model and a resolution that are checked by runs.

    The pairs are taken in order of cost, as long as all runs together cost at most ``BUDGET`` of the best model here at
    its finest usual resolution. That run itself is always affordable, as is that of a model whose laws are those of its
    resolution alone: it is no further run, but the answer itself if it suffices. The choice does not depend on the
    tolerance.
    """
    top = best_for(task.scene, [model for model in task.models if model.available().available] or task.models)
    finest = max(task.resolutions(top))
    left = BUDGET * task.cost(top, finest)
    paid = {(top.name, finest)}
    checked: set[tuple[str, int]] = set()
    for model, resolution in pairs:
        runs = {(one.name, n): task.cost(one, n) for one, n in runs_of_check(task, model, resolution)}
        if runs.keys() == {(model.name, resolution)} and task.has_grid_law_alone(model):
            paid |= runs.keys()
        cost = sum(runs[key] for key in runs.keys() - paid)
        if cost <= left:
            left -= cost
            paid |= runs.keys()
            checked.add((model.name, resolution))
    return checked


def with_own_uncertainty(task: AdviceTask, model: Model, resolution: int, estimate: Estimate) -> Estimate:
    """The estimate with the uncertainty that a model in this process states of its own run.

    In an estimate by the laws it replaces the law over resolutions, unless a promise contains that error. A measured
    error is at least this uncertainty, which adds to it at the full resolution of a rough surface without a promise.
    The estimate does not change if the run fails or does not state an uncertainty. It is not sure where the run shows
    that the laws do not hold.
    """
    result = None if model.outside else _run(task, model, resolution)
    beyond_laws = "" if result is None else task.kind.outside_laws(task.scene, result, task.quantity)
    outside = [*task.outside.get(model.name, ()), *([beyond_laws] if beyond_laws else [])]
    if outside:
        return replace(estimate, reasons=(*outside, *estimate.reasons), sure=False, decides=True)
    own = None if model.outside else _from_itself(task, model, resolution)
    if own is None or own.error == 0:
        return estimate
    by_laws = a_priori(task, model, resolution, own.error) if estimate.source == BY_LAWS else None
    if by_laws is not None and by_laws.sure:
        return replace(by_laws, error=max(by_laws.error, own.error), sure=estimate.sure, decides=True)
    promised = task.quantity in task.table.promise(task.kind.name_of_laws, model.name).laws
    adds = not promised and "waves" in task.numbers and task.at_full_resolution(model, resolution)
    error = math.hypot(estimate.error, own.error) if adds else max(estimate.error, own.error)
    first = own if own.error > estimate.error else estimate
    reasons = (*own.reasons, *estimate.reasons) if first is own else estimate.reasons
    return replace(first, error=error, reasons=reasons, sure=estimate.sure, least=estimate.least, decides=True)


def _cheap(task: AdviceTask, check: float, cost: float) -> bool:
    """Whether a check of this cost is cheap compared with the best model, or with the checked model of this cost."""
    top = best_for(task.scene, task.models)
    return check <= max(MAX_COST_OF_BEST * task.cost(top, top.resolution_of(task.scene)), MAX_COST_OF_MODEL * cost)


def _run(task: AdviceTask, model: Model, resolution: int) -> Result | None:
    """The result of a model; None if the run fails, has not the quantity or is outside the range of the model."""
    try:
        result = task.run(model, resolution)
    except (InputError, ConvergenceError, UnavailableError):
        return None
    return result if task.quantity in result.quantities and not result.outside else None


def _from_itself(task: AdviceTask, model: Model, resolution: int) -> Estimate | None:
    own = _run(task, model, resolution)
    error = None if own is None else task.uncertainty(own)
    if error is None:
        return None
    return Estimate(error=error, reasons=(f"run at resolution {resolution}",), decides=True, source=BY_ITS_RUN)


def _from_correction(task: AdviceTask, model: Model, resolution: int) -> Estimate | None:
    own = _run(task, model, resolution)
    error = None if own is None else task.correction(own)
    if error is None:
        return None
    return Estimate(error=error, reasons=(f"run at resolution {resolution}",), source=BY_CORRECTION)


def _from_above(task: AdviceTask, model: Model, resolution: int, above: Model, finer: int) -> Estimate | None:
    own, result = _run(task, model, resolution), _run(task, above, finer)
    if own is None or result is None:
        return None
    left = combined(a_priori(task, above, finer), None if task.next(above) else _from_itself(task, above, finer))
    if left is None:
        return None
    difference = task.difference(own, result)
    size = abs(difference)
    return Estimate(
        error=size + left.error,
        reasons=(f"{above.name} was run too at resolution {finer}",),
        sure=left.sure,
        least=max(size - left.error, 0.0) if left.sure else 0.0,
        source=f"measured against {above.name}",
        difference=difference,
    )
