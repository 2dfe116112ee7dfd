"""Estimates of a model's error: from the numbers of the scene alone, and from the next models."""

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
"""Fraction of the tolerance that the resolution may use up."""

MAX_COST_OF_BEST = 0.01
"""Cost of a check over that of the best model at its default resolution, up to which the check is run."""

MAX_COST_OF_MODEL = 3.0
"""Cost of a check over that of the checked model, up to which the check is run."""

MAX_STATED_ERROR = 3.0
"""Largest error that is stated; a larger one is stated as more than this."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """The largest expected error over the size of the quantity, and why; ``sure`` within the sweeps."""

    error: float
    reasons: tuple[str, ...]
    sure: bool = True


@dataclass(frozen=True, kw_only=True)
class AdviceTask:
    """The task of an advice: a scene, the models that apply to it, the quantity and its tolerated error.

    ``failed`` holds the error of every run that failed, by name and resolution.
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
        """The step from a model to the next one that applies; None at the top."""
        return self.table.step(self.kind.name, model.name, {other.name for other in self.models})

    def next(self, model: Model) -> Model | None:
        """The next model up; None at the top."""
        step = self.step(model)
        return None if step is None else find(self.models, self.kind.name, step.towards)

    def chain(self, model: Model) -> list[Model]:
        """The models from this one to the most complete."""
        chain = [model]
        while (above := self.next(chain[-1])) is not None:
            chain.append(above)
        return chain

    def grid(self, model: Model, resolution: int) -> float | None:
        """The error that a resolution causes, by the laws; None where there is no law.

        It is 0 for a model without an order at the surface's own resolution, which loses no waves.
        """
        if model.order is None and resolution >= max(model.resolutions_of(self.scene)):
            return 0.0
        law, numbers = self.grid_law(model), on_grid(self.numbers, resolution)
        return law.error(numbers, RESOLVING) if law is not None and law.knows(numbers) else None

    def grid_law(self, model: Model) -> Law | None:
        """The law of a model's resolution; None where there is none."""
        return self.table.grid(self.kind.name, model.name, self.quantity)

    def beyond_grids(self, model: Model, resolution: int) -> str | None:
        """The number that lies beyond the sweep of a model's resolutions; None if there is none."""
        law, numbers = self.grid_law(model), on_grid(self.numbers, resolution)
        return law.beyond(numbers, RESOLVING) if law is not None and law.knows(numbers) else None

    def resolution(self, model: Model) -> int:
        """The coarsest resolution within its fraction of the tolerance, or the finest; without a law the default."""
        offered = model.resolutions_of(self.scene)
        law = self.grid_law(model)
        if law is None or not law.knows(on_grid(self.numbers, offered[0])):
            return model.resolution_of(self.scene)
        fine = [one for one in offered if (self.grid(model, one) or 0.0) <= GRID_FRACTION * self.within]
        return min((one for one in fine if self.beyond_grids(model, one) is None), default=max(offered))

    def cost(self, model: Model, resolution: int | None = None) -> float:
        """The expected CPU seconds, by default at the chosen resolution."""
        return model.cost(self.scene, self.resolution(model) if resolution is None else resolution)

    def difference(self, one: Result, other: Result) -> float:
        """The difference of the quantity in two results, over the smaller of their sizes."""
        values = (one.quantities[self.quantity].value, other.quantities[self.quantity].value)
        size = min(self.kind.scale_of(result, self.quantity) for result in (one, other))
        return over(abs(values[0] - values[1]), size)

    def uncertainty(self, result: Result) -> float | None:
        """The uncertainty of the quantity in a result over its size; None if it is unknown."""
        uncertainty = result[self.quantity].uncertainty
        return None if uncertainty is None else over(uncertainty, self.kind.scale_of(result, self.quantity))


def over(error: float, size: float) -> float:
    """An error over a size; infinite where the size is 0 and the error is not, and where one of them is no number."""
    if error == 0:
        return 0.0
    fraction = error / size if size > 0 else math.inf
    return math.inf if math.isnan(fraction) else fraction


def percent(fraction: float) -> str:
    """A fraction in per cent, as text."""
    if not fraction <= MAX_STATED_ERROR:
        return f"more than {100 * MAX_STATED_ERROR:.0f} %"
    return f"{100 * fraction:.2g} %" if fraction < 0.1 else f"{100 * fraction:.0f} %"


def bounded(fraction: float) -> str:
    """The largest expected error, as the end of a sentence."""
    return percent(fraction) if fraction > MAX_STATED_ERROR else f"up to {percent(fraction)}"


def near(fraction: float) -> str:
    """The error of a model, as the end of a sentence."""
    return f"within {percent(fraction)}" if fraction <= MAX_STATED_ERROR else f"off by {percent(fraction)}"


def expected_errors(scene: Scene, model: Model, resolution: int, models: Sequence[Model]) -> dict[str, float]:
    """The bounds of a model's error over the size of the quantity, by the fitted laws alone; nothing is solved.

    Parameters
    ----------
    resolution : at which the model solves the scene.
    models : all models of the scene's kind.

    Returns
    -------
    The compared quantities for which the laws reach the scene, each with the error that 95 of 100 scenes do not exceed.
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
        if estimate is not None and estimate.sure and estimate.error < math.inf:
            errors[quantity] = estimate.error + (omitted.part if omitted else 0.0)
    return errors


def a_priori(task: AdviceTask, model: Model, resolution: int | None = None) -> Estimate | None:
    """The estimate by the laws, from the effects that a model and those above it leave out, and its resolution.

    The parts are independent bounds and add up as squares. None where a step, or its grid, is not in the table. The
    default resolution is the one that the advice would choose.
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
    """The errors of all steps up a chain, the same with reasons, and whether all are sure; None if one is unknown."""
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
    """The estimate from runs of a model and of one ``above`` it, or below it where that costs too much; else None.

    The difference to the model above, plus that model's own error, bounds the error. From the model below, a law
    estimates the error from the size of the last step.
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
    """The uncertainty of the most complete model, once it is run; None where that costs too much, or is unknown."""
    own = None if model.outside else run(task, model, resolution)
    error = None if own is None or task.quantity not in own.quantities else task.uncertainty(own)
    if error is None:
        return None
    return Estimate(error=error, reasons=(f"at resolution {resolution} its own uncertainty is {percent(error)}",))


def affordable(task: AdviceTask, other: Model, model: Model) -> bool:
    """Whether a model is available and cheap enough to check another."""
    top = best(task.models)
    limit = max(MAX_COST_OF_BEST * task.cost(top, top.resolution_of(task.scene)), MAX_COST_OF_MODEL * task.cost(model))
    return other.available().available and task.cost(other) <= limit


def run(task: AdviceTask, model: Model, resolution: int | None = None) -> Result | None:
    """The result of a model, by default at the chosen resolution; None where it fails."""
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
