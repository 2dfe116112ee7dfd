"""The changes of a bearing by heating and by shear thinning, from models that differ by them on one coarse grid."""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from roughfilm import rom
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.rounding import share
from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.effects.absent import absent_effects
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.keyed import KeyedScene, keyed
from roughfilm.rom.bearing.roughness import RoughSurface
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.tables import Conducting, Heat
from roughfilm.rom.cavitation.newton import few_rounds
from roughfilm.rom.ladder.kind import Omission, kind_of, kind_of_scene
from roughfilm.rom.ladder.model import Effect, Model, ladder
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.parts.allowance import allowance

CELLS = {True: (128, 512), False: (32, 64)}
"""Number of cells along a side, for an infinitely wide film (True) and for others; the second if a model fails."""

WORK = 4e5
"""Steps of Newton's method times nodes after which a film is given up, and its change is unknown.

Films that are found take up to 2.2e5. Films of which temperatures run away, or tilt a pad beyond its balance, may take
20 times as much, hundreds of times the work of the isothermal film.
"""

MARGIN = 1.1
"""Change on fine grids over that on the coarse one that 95 of 100 random scenes do not exceed."""

OIL_CONDUCTIVITY = 0.13
"""Thermal conductivity of oils, W/(m K), where a lubricant has none; 0.11 to 0.15 W/(m K) by Cragoe 1929."""

EFFECTS: Mapping[Effect, str] = {
    Effect.SHEAR_THINNING: "shear thinning",
    Effect.HEATING: "heating",
    Effect.TEMPERATURE_FIELD: "the temperature over the film",
    Effect.TEMPERATURE_ACROSS: "the temperature across the film",
}
"""The effects on the viscosity, in words."""

ON_COARSE_GRID = "measured on a coarse grid"
"""Origin of the size of these effects."""


@dataclass(frozen=True, kw_only=True)
class CoarseFilms:
    """The film of a bearing on one coarse grid, by models that differ in their effects on the viscosity.

    Attributes
    ----------
    models : the models, from that with none of these effects to those with most of them.
    results : results by the name of the model.
    failures : messages of models that have no result, by name; those that ``WORK`` ends have neither.
    smooth : whether the rough wall of the scene was replaced by a smooth one.
    conducts_as_oil : whether the lubricant has ``OIL_CONDUCTIVITY``, as none is given.
    absent : effects that the scene does not have.
    in_still_air : where ``heat_balance`` estimates the heat transfer of the bearing, the result of the model with most
        of these effects whose fixed wall has it, and the name of that model; None elsewhere.
    """

    models: tuple[Model[Bearing], ...]
    results: Mapping[str, Result]
    failures: Mapping[str, str]
    smooth: bool
    absent: frozenset[str]
    conducts_as_oil: bool = False
    in_still_air: Result | None = None

    def effects(self, model: Model[Bearing]) -> frozenset[Effect]:
        """The effects on the viscosity that a model keeps in the scene."""
        return (model.keeps & EFFECTS.keys()) - self.absent

    def above(self, model: Model[Bearing]) -> list[Model[Bearing]]:
        """The models with the effects of a model and more, from the fewest to the most."""
        return [one for one in self.models if self.effects(model) < self.effects(one)]

    def standing_for(self, model: Model[Bearing]) -> Model[Bearing]:
        """The model here with the same effects on the viscosity as another one."""
        own = self.effects(model)
        return next(one for one in reversed(self.models) if self.effects(one) <= own)

    def left_out(self, more: Model[Bearing], less: Model[Bearing]) -> list[str]:
        """The effects of a model that another one lacks, in words; heating includes what its temperature varies by."""
        lacking, field = self.effects(more) - self.effects(less), {Effect.TEMPERATURE_FIELD, Effect.TEMPERATURE_ACROSS}
        whole = Effect.HEATING not in lacking and field <= lacking
        if whole or Effect.HEATING in lacking:
            lacking -= field
        named = [words for effect, words in EFFECTS.items() if effect in lacking]
        return [*named, "the temperature over the film and across it"] if whole else named

    def change(self, quantity: str, more: Model[Bearing], less: Model[Bearing]) -> float | None:
        """A quantity by one model minus that by another one, over its size by the first; None if one lacks it."""
        found = self.results.get(more.name)
        return None if found is None else self.change_to(quantity, found, less)

    def change_to(self, quantity: str, found: Result, less: Model[Bearing]) -> float | None:
        """The same of a result."""
        other = self.results.get(less.name)
        if other is None or quantity not in found.quantities or quantity not in other.quantities:
            return None
        size = kind_of(found).scale_of(found, quantity)
        return (found[quantity].value - other[quantity].value) / size if size > 0 else None


def coarse_films(scene: Bearing) -> CoarseFilms | None:
    """The films of a scene by these models; None where the viscosity changes neither with temperature nor with shear.

    A rough surface, whose flow factors are costly, is replaced by a smooth wall; stored tables and ridges are kept. A
    lubricant without a conductivity has that of oils. The results are kept in memory.
    """
    lubricant = scene.lubricant
    if lubricant.thermoviscosity is None and lubricant.shear_thinning is None:
        return None
    return _films(keyed(scene.without_time()))


def viscosity_omitted(scene: Bearing, model: Model[Bearing], quantity: str) -> Omission | None:
    """The relative change of a quantity by heating and shear thinning that a model leaves out; None if it is unknown.

    It is ``MARGIN`` times the difference between the model with most of these effects and the one that has those of the
    model, on one coarse grid. It is infinite if the former fails, as by a thermal runaway. A model that estimates the
    heat transfer of the bearing is compared with a film between walls that have it.
    """
    films = coarse_films(scene)
    if films is None:
        return None
    own = films.standing_for(model)
    above = films.above(own)
    if not above or own.name not in films.results:
        return None
    best, change = above[-1], None
    if films.in_still_air is not None and _heat_given_off(scene, films.results[own.name]) is not None:
        change = films.change_to(quantity, films.in_still_air, own)
    elif best.name in films.failures:
        reason = f"{_listed(films.left_out(best, own))}: {films.failures[best.name]}"
        return Omission(part=math.inf, reason=reason, source=ON_COARSE_GRID)
    else:
        change = films.change(quantity, best, own)
    if change is None:
        return None
    names = films.left_out(best, own)
    where = " of the smooth film" if films.smooth else ""
    where += f" at {OIL_CONDUCTIVITY:g} W/(m K), of oils" if films.conducts_as_oil and best.name == "across" else ""
    changes = "change" if len(names) > 1 else "changes"
    title = kind_of_scene(scene).named[quantity]
    reason = f"{_listed(names)} {changes} the {title}{where} by about {share(abs(change))}"
    others = _by_others(films, quantity, best, above[:-1])
    return Omission(part=MARGIN * abs(change), reason=reason + others, source=ON_COARSE_GRID)


def _by_others(films: CoarseFilms, quantity: str, best: Model[Bearing], others: Sequence[Model[Bearing]]) -> str:
    """What models with a part of the effects leave, such as "; heat_balance gives it to 4 %"."""
    left = {one.name: films.change(quantity, best, one) for one in others}
    parts = [f"{name} to {share(abs(change))}" for name, change in left.items() if change is not None]
    return "" if not parts else f"; {_listed(parts)}".replace(" to ", " gives it to ", 1)


def _listed(names: Sequence[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


@lru_cache(maxsize=16)
def _films(question: KeyedScene) -> CoarseFilms | None:
    scene = question.scene
    smooth = isinstance(scene.roughness, RoughSurface)
    if smooth:
        scene = scene.model_copy(update={"roughness": None, "asperities": None})
    absent, lubricant = absent_effects(scene), scene.lubricant
    conducts_as_oil = lubricant.conductivity is None and not lubricant.lacking
    if conducts_as_oil:
        update = {"lubricant": lubricant.model_copy(update={"conductivity": OIL_CONDUCTIVITY})}
        scene = scene.model_copy(update=update)
    wanted = {Effect.SIDE_FLOW, Effect.CAVITATION, Effect.PRESSURE_DEPENDENCE}
    applying = [
        model for model in ladder(rom, kind="bearing") if wanted <= model.keeps and model.applies(scene).applies
    ]
    plain = [model for model in applying if not model.keeps & {*EFFECTS, Effect.FINITE_WAVES}]
    changed = [model for model in applying if model.keeps & EFFECTS.keys()]
    if not changed:
        return None
    models = (plain[-1], *sorted(changed, key=lambda model: len((model.keeps & EFFECTS.keys()) - absent)))
    for cells in CELLS[scene.wide]:
        results, failures, given_up = _solved(scene, models, cells)
        if given_up or not failures:
            break
    in_still_air = None
    if (cooled := _giving_off(scene, results.values())) is not None:
        in_still_air = _solved(cooled, models[-1:], cells)[0].get(models[-1].name)
    return CoarseFilms(
        models=models,
        results=results,
        failures=failures,
        smooth=smooth,
        conducts_as_oil=conducts_as_oil,
        absent=absent,
        in_still_air=in_still_air,
    )


def _solved(
    scene: Bearing, models: Sequence[Model[Bearing]], cells: int
) -> tuple[dict[str, Result], dict[str, str], bool]:
    """The results of models on a grid, messages of those that fail, by name, and whether ``WORK`` ended one of them."""
    results: dict[str, Result] = {}
    failures: dict[str, str] = {}
    given_up = False
    for model in models:
        with few_rounds(), allowance(WORK) as work:
            try:
                results[model.name] = model.solve(scene, Request(resolution=cells))
            except (InputError, ConvergenceError) as error:
                given_up = given_up or work.spent
                if not work.spent:
                    failures[model.name] = str(error)
                if model is models[0]:  # nothing to compare the others with
                    break
    return results, failures, given_up


def _heat_given_off(scene: Bearing, found: Result) -> float | None:
    """The heat, W, that a result gives off by a heat transfer which it estimates; None of other results."""
    off, heat = found.quantities.get(f"heat_to_surroundings{'_per_width' if scene.wide else ''}"), scene.heat or Heat()
    return None if off is None or off.value == 0 or heat.heat_transfer is not None else off.value


def _giving_off(scene: Bearing, results: Collection[Result]) -> Bearing | None:
    """The scene with a fixed wall that has the heat transfer which a result estimates; None where none does."""
    found = next((one for one in results if _heat_given_off(scene, one) is not None), None)
    heat = scene.heat or Heat()
    if found is None or not heat.insulated:
        return None
    off = _heat_given_off(scene, found) or 0.0
    rise = found["effective_temperature"].value + ZERO_CELSIUS - scene.lubricant.liquid.temperature
    area = scene.nominal_area * (math.pi if isinstance(scene.geometry, Shaft) else 1.0)
    wall = Conducting.model_construct(kind="conducting", heat_transfer=off / rise / area)
    return scene.model_copy(update={"heat": heat.model_copy(update={"fixed_wall": wall})})
