"""How far off a rung is expected to be: from the numbers of the scene alone, and from the rungs next to it."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.rom.advice.laws import RESOLVING, Law, Numbers, Step, Table, on_grid, table
from roughfilm.rom.ladder.kind import Kind, Scene, kind_of_name
from roughfilm.rom.ladder.model import Model, best, find
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result

GRID_SHARE = 1 / 3
"""Of the tolerance, what the resolution may use up."""

CHEAP, NEXT = 0.01, 3.0
"""A rung is run to check another if it costs less than this part of the best rung by default, or so many times it."""


MOST = 3.0
"""A larger error is told as more than this."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """An error that is expected at most, over the size of the quantity, and why; ``sure`` where the sweeps reach."""

    error: float
    reasons: tuple[str, ...]
    sure: bool = True


@dataclass(frozen=True, kw_only=True)
class Question:
    """What is asked: a scene, the rungs of its kind that apply to it, the quantity and how far off it may be.

    ``failed`` : of what was run in vain, by name and resolution, why.
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
        """That of a rung, towards one that applies; None at the top."""
        return self.table.step(self.kind.name, model.name, {other.name for other in self.models})

    def next(self, model: Model) -> Model | None:
        """The next rung up; None at the top."""
        step = self.step(model)
        return None if step is None else find(self.models, self.kind.name, step.towards)

    def chain(self, model: Model) -> list[Model]:
        """From a rung up to the top."""
        chain = [model]
        while (above := self.next(chain[-1])) is not None:
            chain.append(above)
        return chain

    def grid(self, model: Model, resolution: int) -> float | None:
        """What a resolution costs in accuracy, by the sweeps; None where they do not tell.

        Nothing where it is the surface's own, which loses no waves: rungs without an order are judged by that.
        """
        if model.order is None and resolution >= max(model.resolutions_of(self.scene)):
            return 0.0
        law, numbers = self.grid_law(model), on_grid(self.numbers, resolution)
        return law.error(numbers, RESOLVING) if law is not None and law.knows(numbers) else None

    def grid_law(self, model: Model) -> Law | None:
        """That of a rung's resolutions; None where there is none."""
        return self.table.grid(self.kind.name, model.name, self.quantity)

    def beyond_grids(self, model: Model, resolution: int) -> str | None:
        """The number that lies beyond what a rung's resolutions were tried on; None if there is none."""
        law, numbers = self.grid_law(model), on_grid(self.numbers, resolution)
        return law.beyond(numbers, RESOLVING) if law is not None and law.knows(numbers) else None

    def resolution(self, model: Model) -> int:
        """The coarsest known to use up no more than its share of the tolerance, or the finest; else the default."""
        offered = model.resolutions_of(self.scene)
        law = self.grid_law(model)
        if law is None or not law.knows(on_grid(self.numbers, offered[0])):
            return model.resolution_of(self.scene)
        fine = [one for one in offered if (self.grid(model, one) or 0.0) <= GRID_SHARE * self.within]
        return min((one for one in fine if self.beyond_grids(model, one) is None), default=max(offered))

    def cost(self, model: Model, resolution: int | None = None) -> float:
        """Expected CPU seconds, by default at the chosen resolution."""
        return model.cost(self.scene, self.resolution(model) if resolution is None else resolution)

    def difference(self, one: Result, other: Result) -> float:
        """Of the quantity, over the smaller size of the two: where little is left, they may be counted otherwise."""
        values = (one.quantities[self.quantity].value, other.quantities[self.quantity].value)
        size = min(self.kind.scale_of(result, self.quantity) for result in (one, other))
        return over(abs(values[0] - values[1]), size)

    def told(self, result: Result) -> float | None:
        """By how much a result may be off by its own word, over its size; None if it does not say."""
        found = result[self.quantity].uncertainty
        return None if found is None else over(found, self.kind.scale_of(result, self.quantity))


def over(error: float, size: float) -> float:
    """An error as a part of a size; infinite where there is an error and no size, or where one of them is no number."""
    if error == 0:
        return 0.0
    part = error / size if size > 0 else math.inf
    return math.inf if math.isnan(part) else part


def percent(part: float) -> str:
    """A part as people read it."""
    if not part <= MOST:
        return f"more than {100 * MOST:.0f} %"
    return f"{100 * part:.2g} %" if part < 0.1 else f"{100 * part:.0f} %"


def bounded(part: float) -> str:
    """An error that is expected at most, as the end of a sentence about it."""
    return percent(part) if part > MOST else f"up to {percent(part)}"


def near(part: float) -> str:
    """How near a rung is, as the end of a sentence about it."""
    return f"within {percent(part)}" if part <= MOST else f"off by {percent(part)}"


def expected_errors(scene: Scene, model: Model, resolution: int, models: Sequence[Model]) -> dict[str, float]:
    """Bounds of a model's error over the size of the quantity, by the fitted laws alone; nothing is solved.

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
        asked = Question(
            scene=scene,
            kind=kind,
            models=applying,
            quantity=quantity,
            within=1.0,
            table=table(),
            numbers=kind.numbers(scene),
            run=lambda other, grid: other.solve(scene, Request(resolution=grid)),
        )
        estimate, omitted = a_priori(asked, model, resolution), kind.omitted(scene, quantity)
        if estimate is not None and estimate.sure and estimate.error < math.inf:
            errors[quantity] = estimate.error + (omitted.part if omitted else 0.0)
    return errors


def a_priori(asked: Question, model: Model, resolution: int | None = None) -> Estimate | None:
    """By the numbers of the scene: what a rung and those above it leave out, and what its resolution costs.

    The parts are independent bounds and add up as squares. None where a step, or its grid, is not in the table. The
    resolution is the one that the advice would choose by default.
    """
    left = left_out(asked, asked.chain(model))
    resolution = asked.resolution(model) if resolution is None else resolution
    grid = asked.grid(model, resolution)
    if left is None or grid is None:
        return None
    parts, reasons, sure = left
    if grid > 0:
        beyond = asked.beyond_grids(model, resolution)
        told = f"a resolution of {resolution} costs {bounded(grid)}"
        reasons = [*reasons, (grid, told + _lies(asked, beyond, asked.grid_law(model)))]
        parts, sure = [*parts, grid], sure and beyond is None
    kept = [reason for _, reason in sorted(reasons, key=lambda told: -told[0])]
    return Estimate(error=math.hypot(*parts), reasons=tuple(kept), sure=sure)


def left_out(asked: Question, chain: Sequence[Model]) -> tuple[list[float], list[tuple[float, str]], bool] | None:
    """Of every step up a chain the error and, beside it, the reason; whether all are sure; None if one is not known."""
    parts, reasons, sure = [], [], True
    for rung in chain[:-1]:
        step = asked.step(rung)
        law = None if step is None else step.left_out.get(asked.quantity)
        if step is None or law is None or not law.knows(asked.numbers):
            return None
        error, beyond = law.error(asked.numbers, (step.tells,)), law.beyond(asked.numbers, (step.tells,))
        parts.append(error)
        sure = sure and beyond is None
        reasons.append((error, _told(asked, rung, step, error) + _lies(asked, beyond, law)))
    return parts, reasons, sure


def _told(asked: Question, rung: Model, step: Step, error: float) -> str:
    value = asked.numbers.get(step.tells)
    number = "" if value is None else f"{asked.kind.symbols[step.tells]} = {value:.2g}: "
    title = asked.kind.compared[asked.quantity]
    return f"{number}{step.adds} may change the {title} by {bounded(error)}; {rung.name} would miss it"


def _lies(asked: Question, beyond: str | None, law: Law | None) -> str:
    if beyond is None or law is None:
        return ""
    least, most = law.reach[beyond]
    if beyond in RESOLVING:
        return f" (and none coarser than {least:.2g} {beyond.replace('_', ' ')} was swept)"
    symbol, value = asked.kind.symbols[beyond], asked.numbers[beyond]
    return f" (and {symbol} = {value:.2g} lies beyond the {least:.2g} to {most:.2g} that were swept)"


def a_posteriori(asked: Question, model: Model, above: int = 1) -> Estimate | None:
    """By running a rung and one that is ``above`` it, or below it where that is too dear; None if neither can be run.

    The difference to the rung above is the error but for what that leaves out itself. From a rung below, the size of
    the last step tells by the sweeps how large the next would be.
    """
    chain = asked.chain(model)
    other = chain[above] if len(chain) > above and affordable(asked, chain[above], model) else None
    left = None if other is None else a_priori(asked, other)
    if (other is not None and left is None) or (other is None and above > 1):
        return None
    own = run(asked, model)
    if own is None or asked.quantity not in own.quantities:
        return None
    return _from_below(asked, model, own) if other is None or left is None else _from_above(asked, own, other, left)


def by_its_own_word(asked: Question, model: Model, resolution: int) -> Estimate | None:
    """What a rung at the top says of its grid once it is run; None where that is dear, or it does not say."""
    own = None if model.outside else run(asked, model, resolution)
    told = None if own is None or asked.quantity not in own.quantities else asked.told(own)
    if told is None:
        return None
    return Estimate(error=told, reasons=(f"on {resolution} it says itself that it is {near(told)}",))


def affordable(asked: Question, other: Model, model: Model) -> bool:
    """Whether a rung is here and cheap enough to check another."""
    top = best(asked.models)
    limit = max(CHEAP * asked.cost(top, top.resolution_of(asked.scene)), NEXT * asked.cost(model))
    return other.available().available and asked.cost(other) <= limit


def run(asked: Question, model: Model, resolution: int | None = None) -> Result | None:
    """The rung's answer, by default at the chosen resolution; None where it has none."""
    try:
        return asked.run(model, asked.resolution(model) if resolution is None else resolution)
    except (InputError, ConvergenceError, UnavailableError):
        return None


def _from_above(asked: Question, own: Result, other: Model, left: Estimate) -> Estimate | None:
    found = run(asked, other)
    if found is None or asked.quantity not in found.quantities:
        return None
    apart = asked.difference(own, found)
    told = f"{other.name} was run too and differs by {percent(apart)}"
    more = f", being itself {near(left.error)}" if left.error > 0 else ""
    return Estimate(error=apart + left.error, reasons=(told + more,), sure=left.sure)


def _from_below(asked: Question, model: Model, own: Result) -> Estimate | None:
    step = asked.step(model)
    law = None if step is None else step.seen.get(asked.quantity)
    if step is None or law is None:
        return None
    below, higher = find(asked.models, asked.kind.name, step.seen_from), left_out(asked, asked.chain(model)[1:])
    found = run(asked, below)
    if found is None or higher is None or asked.quantity not in found.quantities:
        return None
    apart = asked.difference(found, own)
    numbers = {**asked.numbers, "correction": apart}
    word = asked.told(own)
    grid = asked.grid(model, asked.resolution(model)) if word is None else word
    if grid is None or not law.knows(numbers):
        return None
    left, (parts, reasons, sure) = law.error(numbers), higher
    error = math.hypot(left, grid, *parts)
    told = f"{below.name} was run too and differs by {percent(apart)}, by which {model.name} is {near(error)}"
    more = [reason for part, reason in reasons if part > left]
    return Estimate(error=error, reasons=("; ".join((told, *more)),), sure=sure and law.beyond(numbers) is None)
