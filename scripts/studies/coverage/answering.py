"""The answers of the models of a scene's kind at their default resolutions."""

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.interface.solving import solve
from roughfilm.ladder import models
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model
from scripts.studies.coverage.store import Answer


def answers(scene: Scene) -> dict[str, Answer]:
    """Return the answers of every applicable model that runs in this process, by name."""
    ladder = [model for model in models(scene.kind) if not model.outside and model.applies(scene).applies]
    return {model.name: answer(model, scene) for model in ladder if model.available().available}


def answer(model: Model, scene: Scene) -> Answer:
    """Return the answer of one model to a scene."""
    try:
        found = solve(scene, model=model.name)
    except (ConvergenceError, InputError) as error:
        return Answer(failure=f"{type(error).__name__}: {error}")
    quantities = found.quantities
    return Answer(
        values={name: one.value for name, one in quantities.items()},
        uncertainty={name: one.uncertainty for name, one in quantities.items() if one.uncertainty is not None},
        expected_error=dict(found.expected_error),
        cpu_s=found.numerics.cpu_s,
        warnings=found.warnings,
    )
