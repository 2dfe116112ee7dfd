"""The changes of a bearing by heating and by shear thinning, from models that differ by them on one coarse grid."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from roughfilm import rom
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.rounding import share
from roughfilm.rom.bearing.effects.absent import absent_effects
from roughfilm.rom.bearing.keyed import KeyedScene, keyed
from roughfilm.rom.bearing.roughness import RoughSurface
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import Omission, kind_of, kind_of_scene
from roughfilm.rom.ladder.model import Effect, Model, ladder
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result

CELLS = {True: 128, False: 32}
"""Number of cells along a side of the coarse grid, for an infinitely wide film (True) and for others."""

EFFECTS: Mapping[Effect, str] = {
    Effect.SHEAR_THINNING: "shear thinning",
    Effect.HEATING: "heating",
    Effect.TEMPERATURE_FIELD: "the difference of temperature over the film",
    Effect.TEMPERATURE_ACROSS: "the difference of temperature across the film",
}
"""The effects on the viscosity, in words."""

ON_COARSE_GRID = "measured on a coarse grid"
"""Origin of the size of these effects."""


@dataclass(frozen=True, kw_only=True)
class CoarseFilms:
    """The film of a bearing on one coarse grid, by models that differ in their effects on the viscosity.

    Attributes
    ----------
    models : the models, from that with none of these effects to that with most of them.
    results : results by the name of the model.
    failures : messages of models without a result, by name.
    smooth : whether the rough wall of the scene was replaced by a smooth one.
    absent : effects that the scene does not have.
    """

    models: tuple[Model[Bearing], ...]
    results: Mapping[str, Result]
    failures: Mapping[str, str]
    smooth: bool
    absent: frozenset[str]

    def effects(self, model: Model[Bearing]) -> frozenset[Effect]:
        """The effects on the viscosity that a model keeps in the scene."""
        return (model.keeps & EFFECTS.keys()) - self.absent

    @property
    def best(self) -> Model[Bearing]:
        """The model with most effects that has a result."""
        return next(model for model in reversed(self.models) if model.name in self.results)

    def standing_for(self, model: Model[Bearing]) -> Model[Bearing]:
        """The model here with the same effects on the viscosity as another one."""
        own = self.effects(model)
        return next(one for one in reversed(self.models) if self.effects(one) <= own)

    def left_out(self, more: Model[Bearing], less: Model[Bearing]) -> list[str]:
        """The effects of a model that another one lacks, in words; heating includes what its temperature varies by."""
        lacking = self.effects(more) - self.effects(less)
        if Effect.HEATING in lacking:
            lacking -= {Effect.TEMPERATURE_FIELD, Effect.TEMPERATURE_ACROSS}
        return [words for effect, words in EFFECTS.items() if effect in lacking]

    def change(self, quantity: str, more: Model[Bearing], less: Model[Bearing]) -> float | None:
        """A quantity by one model minus that by another one, over its size by the first; None if one lacks it."""
        if any(one.name not in self.results for one in (more, less)):
            return None
        found, other = self.results[more.name], self.results[less.name]
        if quantity not in found.quantities or quantity not in other.quantities:
            return None
        size = kind_of(found).scale_of(found, quantity)
        return (found[quantity].value - other[quantity].value) / size if size > 0 else None


def coarse_films(scene: Bearing) -> CoarseFilms | None:
    """The films of a scene by these models; None where the viscosity changes neither with temperature nor with shear.

    A rough surface, whose flow factors are costly, is replaced by a smooth wall; stored tables and ridges are kept. The
    results are kept in memory.
    """
    lubricant = scene.lubricant
    if lubricant.thermoviscosity is None and lubricant.shear_thinning is None:
        return None
    return _films(keyed(scene.without_time()))


def viscosity_omitted(scene: Bearing, model: Model[Bearing], quantity: str) -> Omission | None:
    """The relative change of a quantity by heating and shear thinning that a model leaves out; None if it is unknown.

    It is the difference between the best model of these effects and the one that has those of the model, on one coarse
    grid. It is infinite if every model with more effects fails, as by a thermal runaway.
    """
    films = coarse_films(scene)
    if films is None:
        return None
    own = films.standing_for(model)
    if own.name not in films.results:
        return None
    above = [one for one in films.models if films.effects(own) < films.effects(one)]
    if above and films.best not in above:
        reason = f"{_listed(films.left_out(above[0], own))}: {films.failures[above[0].name]}"
        return Omission(part=float("inf"), reason=reason, source=ON_COARSE_GRID)
    change = films.change(quantity, films.best, own)
    if change is None or films.best == own:
        return None
    names = films.left_out(films.best, own)
    where = " of the smooth film" if films.smooth else ""
    changes = "change" if len(names) > 1 else "changes"
    title = kind_of_scene(scene).titles[quantity]
    reason = f"{_listed(names)} {changes} the {title}{where} by about {share(abs(change))}"
    return Omission(part=abs(change), reason=reason + _by_others(films, quantity, own), source=ON_COARSE_GRID)


def _by_others(films: CoarseFilms, quantity: str, own: Model[Bearing]) -> str:
    """What the models between this one and the best one leave, such as "; heat_balance gives it to 4 %"."""
    parts = []
    for one in films.models[films.models.index(own) + 1 :]:
        left = films.change(quantity, films.best, one)
        if one != films.best and left is not None:
            verb = "" if parts else " gives it"
            parts.append(f"{one.name}{verb} to {share(abs(left))}")
    return f"; {_listed(parts)}" if parts else ""


def _listed(names: Sequence[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


@lru_cache(maxsize=16)
def _films(question: KeyedScene) -> CoarseFilms | None:
    scene = question.scene
    smooth = isinstance(scene.roughness, RoughSurface)
    if smooth:
        scene = scene.model_copy(update={"roughness": None, "asperities": None})
    absent = absent_effects(scene)
    wanted = {Effect.SIDE_FLOW, Effect.CAVITATION, Effect.PRESSURE_DEPENDENCE}
    applying = [
        model for model in ladder(rom, kind="bearing") if wanted <= model.keeps and model.applies(scene).applies
    ]
    plain = [model for model in applying if not model.keeps & {*EFFECTS, Effect.FINITE_WAVES}]
    models = (plain[-1], *(model for model in applying if model.keeps & EFFECTS.keys()))
    if len(models) == 1:
        return None
    results: dict[str, Result] = {}
    failures: dict[str, str] = {}
    for model in models:
        try:
            results[model.name] = model.solve(scene, Request(resolution=CELLS[scene.wide]))
        except (InputError, ConvergenceError) as error:
            failures[model.name] = str(error)
    if not results:
        return None
    return CoarseFilms(models=models, results=results, failures=failures, smooth=smooth, absent=absent)
