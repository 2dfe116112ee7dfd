"""Advice on the model for a scene at several tolerances, and the answers of the models that it chooses."""

import time
from dataclasses import replace

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.ladder import find, models
from roughfilm.rom.advice.advise import advise
from roughfilm.rom.ladder.kind import Scene, kind_of_scene
from roughfilm.rom.ladder.model import Model, best_for
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from scripts.studies.coverage.store import Advised

TOLERANCES = (0.02, 0.05, 0.10)


def advised(scene: Scene) -> tuple[Advised, ...]:
    """Return the advice on every compared quantity at every tolerance; a run that several of them need is done once."""
    solved: dict[tuple[str, int], Result] = {}

    def run(model: Model, resolution: int) -> Result:
        key = (model.name, resolution)
        if key not in solved:
            solved[key] = model.solve(scene, Request(resolution=resolution))
        return solved[key]

    ladder = models(scene.kind)
    reference = best_for(scene, [model for model in ladder if model.applies(scene).applies])
    best_cpu_s = reference.cost(scene, reference.resolution_of(scene))

    def one(quantity: str, within: float) -> Advised:
        begun, known = time.process_time(), sum(result.numerics.cpu_s for result in solved.values())
        asked = Advised(quantity=quantity, within=within, best_cpu_s=best_cpu_s)
        try:
            advice = advise(scene, ladder, quantity=quantity, within=within, run=run)
            chosen = advice.chosen
            if chosen is None or chosen.resolution is None:
                return replace(asked, cpu_s=advice.spent_cpu_s)
            answer = advice.result or run(find(scene.kind, chosen.model), chosen.resolution)
        except (InputError, ConvergenceError, UnavailableError) as error:
            return replace(asked, failure=f"{type(error).__name__}: {error}")
        new = sum(result.numerics.cpu_s for result in solved.values()) - known
        runs = advice.spent_cpu_s + (0.0 if advice.result else answer.numerics.cpu_s)
        return replace(
            asked,
            model=chosen.model,
            resolution=chosen.resolution,
            expected=chosen.error,
            value=answer.quantities[quantity].value,
            cpu_s=runs + max(time.process_time() - begun - new, 0.0),
        )

    return tuple(one(quantity, within) for quantity in kind_of_scene(scene).compared for within in TOLERANCES)
