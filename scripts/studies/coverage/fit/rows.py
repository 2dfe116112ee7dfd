"""The errors to which laws are fitted, from the scenes of the study and from the models at all their resolutions."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from roughfilm.ladder import find, models
from roughfilm.rom.advice.estimates import over
from roughfilm.rom.advice.laws import Numbers, on_grid
from roughfilm.rom.ladder.kind import Kind, kind_of_laws
from roughfilm.rom.ladder.model import best
from roughfilm.rom.ladder.scene import read_scene
from scripts.studies.coverage import store
from scripts.studies.coverage.drawing import part_of
from scripts.studies.coverage.fit.resolutions import Refinement
from scripts.studies.coverage.store import Judged

Rows = list[tuple[Numbers, float]]
"""The numbers of scenes, each with an error."""

Refinements = Mapping[tuple[int, str], Refinement]
"""Refinements by seed and model."""

MAX_TRUTH_UNCERTAINTY = 0.02
"""Largest relative uncertainty of a truth to which a law is fitted, unless the error is ``SHARE`` times larger."""

SHARE = 5.0
"""Smallest ratio of an error to the uncertainty of a truth that is larger than ``MAX_TRUTH_UNCERTAINTY``."""


@dataclass(frozen=True, kw_only=True)
class FitScene:
    """A scene to which laws are fitted, with its numbers and its kind."""

    judged: Judged
    numbers: Numbers
    kind: Kind

    def limits(self, model: str) -> Mapping[str, tuple[float, float]]:
        """The exact solutions of a model's equations; those of the scene for an unknown or the most complete model."""
        own = self.judged.own.get(model)
        return self.judged.truth if own is None else own

    def error(self, quantity: str, values: Mapping[str, float], model: str) -> float | None:
        """The difference of values from the limit of a model over the size; None if the limit is unknown or uncertain.

        ``values`` give the size where limits are unknown.
        """
        limits = self.limits(model)
        if quantity not in values or quantity not in limits:
            return None
        limit, uncertainty = limits[quantity]
        size = float(self.kind.scale({**values, **{name: value for name, (value, _) in limits.items()}}, quantity))
        error = over(abs(values[quantity] - limit), size)
        return error if over(uncertainty, size) <= max(MAX_TRUTH_UNCERTAINTY, error / SHARE) else None


def fit_scenes(kind: str, out: Path) -> dict[int, FitScene]:
    """Return the scenes of a kind to which laws are fitted, by seed, without those that have no truth."""
    own_kind, found = kind_of_laws(kind), {}
    for seed, one in store.read(store.path_of(out, kind)).items():
        if part_of(seed) == "fit" and not one.failure:
            found[seed] = FitScene(judged=one, numbers=own_kind.numbers(read_scene(one.scene)), kind=own_kind)
    return found


def promised(scenes: Mapping[int, FitScene], refinements: Refinements, model: str, towards: str, quantity: str) -> Rows:
    """Return the errors of a model against the limit of another model, or the truth.

    The errors are those at the judged resolution; of a model that another program runs, at its default resolution.
    """
    rows: Rows = []
    for seed, one in scenes.items():
        own = find(one.kind.name, model)
        if own.outside and (seed, model) in refinements:
            resolution = own.resolution_of(read_scene(one.judged.scene))
            values = refinements[seed, model].values.get(resolution, {})
        elif not own.outside and model in one.judged.models:
            resolution, values = one.judged.models[model].resolution, one.judged.models[model].values
        else:
            continue
        error = one.error(quantity, values, towards)
        if error is not None:
            rows.append((on_grid(one.numbers, resolution), error))
    return rows


def between_limits(scenes: Mapping[int, FitScene], _: Refinements, model: str, towards: str, quantity: str) -> Rows:
    """Return the differences of the limits of two models."""
    rows: Rows = []
    for one in scenes.values():
        if model in one.judged.own and towards in one.judged.own:
            values = {name: value for name, (value, _) in one.judged.own[model].items()}
            error = one.error(quantity, values, towards)
            if error is not None:
                rows.append((one.numbers, error))
    return rows


def at_one_resolution(
    scenes: Mapping[int, FitScene], refinements: Refinements, model: str, towards: str, quantity: str
) -> Rows:
    """Return the differences of two models at the finest resolution that both have."""
    rows: Rows = []
    for seed, one in scenes.items():
        own, other = (
            refinements[seed, name].values if (seed, name) in refinements else {} for name in (model, towards)
        )
        for resolution in sorted(own.keys() & other.keys(), reverse=True)[:1]:
            if quantity in own[resolution] and quantity in other[resolution]:
                values = other[resolution]
                difference = abs(own[resolution][quantity] - values[quantity])
                rows.append((one.numbers, over(difference, float(one.kind.scale(values, quantity)))))
    return rows


def answered(scenes: Mapping[int, FitScene], refinements: Refinements, model: str, quantity: str) -> Rows:
    """Return the errors of a model against the limit of its own equations.

    They are those of all solutions behind that limit but the finest one, where these are known, otherwise those of the
    judged answer.
    """
    own = {seed: one for seed, one in scenes.items() if model in one.judged.own}
    known = {seed: one for seed, one in own.items() if model in one.judged.finer}
    rows = promised({seed: own[seed] for seed in own.keys() - known.keys()}, refinements, model, model, quantity)
    for one in known.values():
        runs = one.judged.finer[model]
        for resolution in sorted(runs)[:-1]:
            error = one.error(quantity, runs[resolution], model)
            if error is not None:
                rows.append((on_grid(one.numbers, resolution), error))
    return rows


def refinement(scenes: Mapping[int, FitScene], refinements: Refinements, model: str, quantity: str) -> Rows:
    """Return the errors of a model by its resolution.

    The limit is that of the model's equations if a method solves them independently. Otherwise it is the value at the
    finest resolution; for a model that another program runs, it is extrapolated from the two finest.
    """
    rows: Rows = []
    for one, known in _known(scenes, refinements, model, quantity):
        for resolution, error in _errors(one, known, model, quantity):
            rows.append((on_grid(one.numbers, resolution), error))
    return rows


def _known(
    scenes: Mapping[int, FitScene], refinements: Refinements, model: str, quantity: str
) -> Iterator[tuple[FitScene, Mapping[int, Mapping[str, float]]]]:
    for (seed, name), one in refinements.items():
        known = {resolution: values for resolution, values in one.values.items() if quantity in values}
        if name == model and seed in scenes and len(known) > 1:
            yield scenes[seed], known


def _errors(
    one: FitScene, known: Mapping[int, Mapping[str, float]], model: str, quantity: str
) -> Iterator[tuple[int, float]]:
    kind = one.kind.name
    own = find(kind, model)
    if own.outside and (model in one.judged.own or own is best(models(kind))):
        for resolution, values in known.items():
            error = one.error(quantity, values, model)
            if error is not None:
                yield resolution, error
        return
    *_, second, last = sorted(known)
    finest, limit = known[last], known[last][quantity]
    if own.outside:
        limit += (limit - known[second][quantity]) / (
            (last / second) ** (own.order_of(read_scene(one.judged.scene)) or 1) - 1
        )
    for resolution, values in known.items():
        if own.outside or resolution < last:
            yield resolution, over(abs(values[quantity] - limit), float(one.kind.scale(finest, quantity)))
