"""The errors of several models on one scene, measured against the most complete one that solved it."""

from collections.abc import Mapping, Sequence

from roughfilm.rom.advice.expected import with_errors
from roughfilm.rom.advice.stated import StatedError, measured, stated_errors
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model, best_for
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.studies.comparison import to_best


def with_measured_errors(scene: Scene, models: Sequence[Model], results: Mapping[str, Result]) -> dict[str, Result]:
    """The results with their errors, those of all but the most complete model measured against its result.

    A measured error is the difference from the most complete model ± the error of that model, which is its own
    uncertainty, with the error that the laws expect if there is a still more complete one. Errors of quantities that
    are not compared are those of the laws. Nothing is measured against a model outside its range.

    Parameters
    ----------
    scene : the scene.
    models : all models for this kind of scene.
    results : results by the name of the model; at least one.
    """
    by_name = {model.name: model for model in models}
    top = best_for(scene, [by_name[name] for name in results]).name
    judged = {top: with_errors(results[top], scene, by_name[top], models)}
    floor = stated_errors(judged[top])
    known: dict[str, dict[str, StatedError]] = {}
    for one in () if results[top].outside else to_best(scene, models, results):
        bar = floor[one.quantity].error if one.quantity in floor else one.uncertainty
        known.setdefault(one.model, {})[one.quantity] = measured(top, one.relative, bar)
    return {
        name: judged.get(name) or with_errors(result, scene, by_name[name], models, known=known.get(name))
        for name, result in results.items()
    }
