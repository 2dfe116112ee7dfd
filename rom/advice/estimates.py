"""Estimates of the error of a model, by laws from the numbers of a scene alone or from runs of other models."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.rom.advice.laws import RESOLVING, Law, Numbers, Step, Table, on_grid, table
from roughfilm.rom.ladder.kind import Kind, Scene, kind_of_name
from roughfilm.rom.ladder.model import Model, best, find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result

GRID_FRACTION = 1 / 3
"""Largest fraction of the tolerance that the error by the resolution may take."""

MAX_COST_OF_BEST = 0.01
"""Largest ratio of the cost of a check to that of the best model at its default resolution."""

MAX_COST_OF_MODEL = 3.0
"""Largest ratio of the cost of a check to that of the checked model; one of the two limits must be met."""

MAX_STATED_ERROR = 3.0
"""Largest relative error that is printed as a number; a larger error is printed as more than this value."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """An estimate of the error of a model.

    Attributes
    ----------
    error : largest expected error over the size of the quantity.
    reasons : reasons for the error as text, the most important first.
    sure : whether the scene is within the range of the sweeps to which the laws were fitted.
    """

    error: float
    reasons: tuple[str, ...]
    sure: bool = True


@dataclass(frozen=True, kw_only=True)
class AdviceTask:
    """The task of choosing a model for a scene.

    Attributes
    ----------
    scene, kind : the scene and its kind.
    models : the models that apply to the scene.
    quantity : name of the quantity.
    within : tolerated error over the size of the quantity.
    table : the error laws.
    numbers : dimensionless numbers of the scene.
    run : run(model, resolution), which returns a result.
    failed : error of every run that failed, by name of the model and resolution.
    """

    scene: Scene
    kind: Kind
    models: Sequence[Model]
    quantity: str
    within: float
    table: Table
    numbers: Numbers
    run: Callable[[Model, int], Result]
    failed: Mapping[tuple[str, int], Exception] = field(default_factory=dict)

    def step(self, model: Model) -> Step | None:
        """The step from a model to the next one that applies; None for the most complete model."""
        return self.table.step(self.kind.name, model.name, {other.name for other in self.models})

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

    def grid(self, model: Model, resolution: int) -> float | None:
        """The error by a resolution over the size of the quantity, by the laws; None without a law.

        It is 0 for a model without an order of convergence at the full resolution of the surface, which resolves all
        waves.
        """
        if model.order is None and resolution >= max(model.resolutions_of(self.scene)):
            return 0.0
        law, numbers = self.grid_law(model), on_grid(self.numbers, resolution)
        return law.error(numbers, RESOLVING) if law is not None and law.knows(numbers) else None

    def grid_law(self, model: Model) -> Law | None:
        """The law of the error by the resolution of a model; None if there is none."""
        return self.table.grid(self.kind.name, model.name, self.quantity)

    def beyond_grids(self, model: Model, resolution: int) -> str | None:
        """The name of a number outside the range of the sweep over resolutions of a model; None if there is none."""
        law, numbers = self.grid_law(model), on_grid(self.numbers, resolution)
        return law.beyond(numbers, RESOLVING) if law is not None and law.knows(numbers) else None

    def resolution(self, model: Model) -> int:
        """The coarsest resolution whose error is at most ``GRID_FRACTION`` of the tolerance.

        The result is the finest resolution if no other meets this, and the default of the model without a law.
        """
        offered = model.resolutions_of(self.scene)
        law = self.grid_law(model)
        if law is None or not law.knows(on_grid(self.numbers, offered[0])):
            return model.resolution_of(self.scene)
        fine = [one for one in offered if (self.grid(model, one) or 0.0) <= GRID_FRACTION * self.within]
        return min((one for one in fine if self.beyond_grids(model, one) is None), default=max(offered))

    def cost(self, model: Model, resolution: int | None = None) -> float:
        """The expected CPU time of a model, s, by default at the chosen resolution."""
        return model.cost(self.scene, self.resolution(model) if resolution is None else resolution)

    def difference(self, one: Result, other: Result) -> float:
        """The difference of the quantity between two results over the smaller of its sizes in them."""
        values = (one.quantities[self.quantity].value, other.quantities[self.quantity].value)
        size = min(self.kind.scale_of(result, self.quantity) for result in (one, other))
        return over(abs(values[0] - values[1]), size)

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


def percent(fraction: float) -> str:
    """The text of a fraction in per cent."""
    if not fraction <= MAX_STATED_ERROR:
        return f"more than {100 * MAX_STATED_ERROR:.0f} %"
    return f"{100 * fraction:.2g} %" if fraction < 0.1 else f"{100 * fraction:.0f} %"


def bounded(fraction: float) -> str:
    """The text of the largest expected error for the end of a sentence, such as "up to 5 %"."""
    return percent(fraction) if fraction > MAX_STATED_ERROR else f"up to {percent(fraction)}"


def near(fraction: float) -> str:
    """The text of the error of a model for the end of a sentence, such as "within 5 %"."""
    return f"within {percent(fraction)}" if fraction <= MAX_STATED_ERROR else f"off by {percent(fraction)}"


def expected_errors(scene: Scene, model: Model, resolution: int, models: Sequence[Model]) -> dict[str, float]:
    """The bounds by the fitted laws of the error of a model over the size of each quantity, without a solution.

    Parameters
    ----------
    scene : the scene.
    model : the model.
    resolution : resolution at which the model solves the scene.
    models : all models for this kind of scene.

    Returns
    -------
    dict
        The error that 95 of 100 scenes do not exceed, for each compared quantity whose laws hold for the scene.
    """
    kind = kind_of_name(scene.kind)
    applying = [other for other in models if other.applies(scene).applies]
    errors = {}
    for quantity in kind.compared if any(other.name == model.name for other in applying) else ():
        task = AdviceTask(
            scene=scene,
            kind=kind,
            models=applying,
            quantity=quantity,
            within=1.0,
            table=table(),
            numbers=kind.numbers(scene),
            run=lambda other, grid: other.solve(scene, Request(resolution=grid)),
        )
        estimate, omitted = a_priori(task, model, resolution), kind.omitted(scene, quantity)
        part = omitted.part if omitted else 0.0
        if estimate is not None and estimate.sure and estimate.error + part < math.inf:
            errors[quantity] = estimate.error + part
    return errors


def a_priori(task: AdviceTask, model: Model, resolution: int | None = None) -> Estimate | None:
    """The estimate by the laws, from the effects that a model and the more complete ones omit, and the resolution.

    The parts are independent bounds e_i, which add up to √(Σ e_i²). The result is None if a step, or the resolution,
    has no law. By default the resolution is the one that the advice chooses.
    """
    left = left_out(task, task.chain(model))
    resolution = task.resolution(model) if resolution is None else resolution
    grid = task.grid(model, resolution)
    if left is None or grid is None:
        return None
    parts, reasons, sure = left
    if grid > 0:
        beyond = task.beyond_grids(model, resolution)
        reason = f"a resolution of {resolution} costs {bounded(grid)}"
        reasons = [*reasons, (grid, reason + _range_note(task, beyond, task.grid_law(model)))]
        parts, sure = [*parts, grid], sure and beyond is None
    largest_first = sorted(reasons, key=lambda pair: -pair[0])
    return Estimate(error=math.hypot(*parts), reasons=tuple(reason for _, reason in largest_first), sure=sure)


def left_out(task: AdviceTask, chain: Sequence[Model]) -> tuple[list[float], list[tuple[float, str]], bool] | None:
    """The errors of all steps in a chain, the errors with reasons, and whether all are sure; None if one is unknown."""
    parts, reasons, sure = [], [], True
    for model in chain[:-1]:
        step = task.step(model)
        law = None if step is None else step.left_out.get(task.quantity)
        if step is None or law is None or not law.knows(task.numbers):
            return None
        error, beyond = law.error(task.numbers, (step.tells,)), law.beyond(task.numbers, (step.tells,))
        parts.append(error)
        sure = sure and beyond is None
        reasons.append((error, _reason(task, model, step, error) + _range_note(task, beyond, law)))
    return parts, reasons, sure


def _reason(task: AdviceTask, model: Model, step: Step, error: float) -> str:
    value = task.numbers.get(step.tells)
    number = "" if value is None else f"{task.kind.symbols[step.tells]} = {value:.2g}: "
    title = task.kind.compared[task.quantity]
    return f"{number}{step.adds} may change the {title} by {bounded(error)}; {model.name} would miss it"


def _range_note(task: AdviceTask, beyond: str | None, law: Law | None) -> str:
    if beyond is None or law is None:
        return ""
    least, most = law.reach[beyond]
    if beyond in RESOLVING:
        return f" (and the fitted range begins at {least:.2g} {beyond.replace('_', ' ')})"
    symbol, value = task.kind.symbols[beyond], task.numbers[beyond]
    return f" (and {symbol} = {value:.2g} is outside the fitted range of {least:.2g} to {most:.2g})"


def a_posteriori(task: AdviceTask, model: Model, above: int = 1) -> Estimate | None:
    """The estimate of the error of a model from runs; None if there is no cheap model to compare with.

    The model is compared with the one that is ``above`` steps more complete: the difference plus the error of that
    model bounds the error. If that model costs too much and ``above`` is 1, the comparison is with a simpler model, and
    a law gives the error from the difference.
    """
    chain = task.chain(model)
    other = chain[above] if len(chain) > above and affordable(task, chain[above], model) else None
    left = None if other is None else a_priori(task, other)
    if (other is not None and left is None) or (other is None and above > 1):
        return None
    own = run(task, model)
    if own is None or task.quantity not in own.quantities:
        return None
    return _from_below(task, model, own) if other is None or left is None else _from_above(task, own, other, left)


def self_estimate(task: AdviceTask, model: Model, resolution: int) -> Estimate | None:
    """The estimate from the numerical uncertainty of a run of the most complete model.

    The result is None if another program solves the model, the run fails, or the uncertainty is unknown.
    """
    own = None if model.outside else run(task, model, resolution)
    error = None if own is None or task.quantity not in own.quantities else task.uncertainty(own)
    if error is None:
        return None
    return Estimate(error=error, reasons=(f"at resolution {resolution} its own uncertainty is {percent(error)}",))


def affordable(task: AdviceTask, other: Model, model: Model) -> bool:
    """Whether the model ``other`` is available and cheap enough to check ``model``."""
    top = best(task.models)
    limit = max(MAX_COST_OF_BEST * task.cost(top, top.resolution_of(task.scene)), MAX_COST_OF_MODEL * task.cost(model))
    return other.available().available and task.cost(other) <= limit


def run(task: AdviceTask, model: Model, resolution: int | None = None) -> Result | None:
    """The result of a model, by default at the chosen resolution; None if it fails."""
    try:
        return task.run(model, task.resolution(model) if resolution is None else resolution)
    except (InputError, ConvergenceError, UnavailableError):
        return None


def _from_above(task: AdviceTask, own: Result, other: Model, left: Estimate) -> Estimate | None:
    result = run(task, other)
    if result is None or task.quantity not in result.quantities:
        return None
    difference = task.difference(own, result)
    reason = f"{other.name} was run too and differs by {percent(difference)}"
    more = f", being itself {near(left.error)}" if left.error > 0 else ""
    return Estimate(error=difference + left.error, reasons=(reason + more,), sure=left.sure)


def _from_below(task: AdviceTask, model: Model, own: Result) -> Estimate | None:
    step = task.step(model)
    law = None if step is None else step.seen.get(task.quantity)
    if step is None or law is None:
        return None
    below, higher = find(task.models, task.kind.name, step.seen_from), left_out(task, task.chain(model)[1:])
    result = run(task, below)
    if result is None or higher is None or task.quantity not in result.quantities:
        return None
    difference = task.difference(result, own)
    numbers = {**task.numbers, "correction": difference}
    grid = task.uncertainty(own)
    grid = task.grid(model, task.resolution(model)) if grid is None else grid
    if grid is None or not law.knows(numbers):
        return None
    left, (parts, reasons, sure) = law.error(numbers), higher
    error = math.hypot(left, grid, *parts)
    first = f"{below.name} was run too and differs by {percent(difference)}, so that {model.name} is {near(error)}"
    more = [reason for part, reason in reasons if part > left]
    return Estimate(error=error, reasons=("; ".join((first, *more)),), sure=sure and law.beyond(numbers) is None)
