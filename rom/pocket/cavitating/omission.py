"""The effects that models of a pocket leave out where the film ruptures, from what each effect does by itself.

The bounds hold in 96 to 100 of 100 random pockets, judged by the Reynolds equation with inertia to first order and with
cavitation (``python -m scripts.studies.coverage.rupture``).
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from math import inf

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.advice.laws import table
from roughfilm.rom.advice.stated import BY_LAWS, percent
from roughfilm.rom.ladder.kind import Omission, kind_of, kind_of_scene
from roughfilm.rom.ladder.model import Effect, Model
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.pocket.models.film_slope import MODEL as FILM_SLOPE
from roughfilm.rom.pocket.models.inertial_reynolds import MODEL as INERTIAL_REYNOLDS
from roughfilm.rom.pocket.models.reynolds import MODEL as REYNOLDS
from roughfilm.rom.pocket.models.reynolds_cavitating import MODEL as REYNOLDS_CAVITATING
from roughfilm.rom.pocket.plan.grid import fewest_columns
from roughfilm.rom.pocket.scene import TITLES, Pocket
from roughfilm.rom.pocket.validity.numbers import numbers
from roughfilm.rom.pocket.validity.warnings import UNKNOWN_ERROR, error_of_lowest, rupture_words

PLAN_COLUMNS = (32, 64)
"""Numbers of columns along a cell in plan on which the lowest pressure is sought, until it is known well enough."""

LOWEST = "pressure_min_plus"

PRESSURES = ("load_plus", "pressure_max_plus", "pressure_min_plus")
"""Quantities in units of p+."""

CAVITATION_FACTORS = {"load_plus": 1.0, "pressure_max_plus": 1.0, "friction_plus": 1.9}
"""Factors of |with - without cavitation|, without inertia, in the bound of the error of a model without cavitation.

|With - without inertia|, without cavitation, is added.
"""

INERTIA_FACTORS = {"load_plus": 1.5, "pressure_max_plus": 2.5, "friction_plus": 4.3}
"""Bounds of the error of ``reynolds_cavitating`` over the largest change of load or pressures by inertia.

The change is that of a film that stays whole. The bound of friction is over it times the thickest film over the period.
"""

BY_ONE_EFFECT = "estimated from each effect by itself"
"""Source of the error where the film ruptures."""


@dataclass(frozen=True, kw_only=True)
class _Films:
    """The films of a scene, without inertia and with it.

    Attributes
    ----------
    reynolds, cavitating : results without inertia, without and with cavitation; None if the latter does not converge.
    whole : result of the best model known to hold for a film that stays whole.
    error : error of its lowest pressure, in units of p+.
    limit : the cavitation pressure in these units.
    """

    reynolds: Result
    cavitating: Result | None
    whole: Result
    error: float
    limit: float

    @property
    def lowest(self) -> float:
        """The lowest pressure of the film that stays whole, in units of p+."""
        return self.value(self.whole, LOWEST)

    @property
    def ruptures(self) -> bool:
        """Whether the film ruptures, whatever the error of its lowest pressure."""
        return self.lowest + self.error < self.limit

    @property
    def stays_whole(self) -> bool:
        """Whether the film stays whole, whatever the error of its lowest pressure."""
        return self.lowest - self.error >= self.limit

    def value(self, result: Result, quantity: str) -> float:
        """The quantity of one of the results."""
        return result.quantities[quantity].value

    def changed(self, quantity: str) -> tuple[float, float]:
        """The changes of a quantity by cavitation and by inertia, each without the other."""
        without = self.value(self.reynolds, quantity)
        by_cavitation = inf if self.cavitating is None else abs(self.value(self.cavitating, quantity) - without)
        return by_cavitation, abs(self.value(self.whole, quantity) - without)


def omission(scene: Pocket, model: Model[Pocket], quantity: str) -> Omission | None:
    """The effect that a model leaves out and that no law counts; None if there is none.

    Without cavitation it is that of cavitation. With it, it is that of inertia and slope, for which there is no more
    complete model. The part is infinite for a quantity without a known bound. Where the error of the lowest pressure
    contains the cavitation pressure, the part is that of a film that ruptures or stays whole, whichever is larger.
    """
    films = _films(scene)
    if Effect.CAVITATION in model.keeps:
        return _inertia(scene, films, quantity)
    return None if films.stays_whole else _cavitation(scene, films, quantity)


def missing(scene: Pocket, model: Model[Pocket]) -> float:
    """The relative change of the load by the effects among inertia and cavitation that a model leaves out.

    A film that is not sure to rupture lacks cavitation, so that a model without it misses nothing by that.
    """
    films = _films(scene)
    by_cavitation, by_inertia = films.changed("load_plus")
    if films.ruptures:
        left_out = {Effect.CAVITATION: by_cavitation, Effect.INERTIA: by_inertia}
        change = sum(size for effect, size in left_out.items() if effect not in model.keeps)
    else:
        change = by_inertia if Effect.CAVITATION in model.keeps else 0.0
    return _over(change, films, "load_plus")


def _cavitation(scene: Pocket, films: _Films, quantity: str) -> Omission:
    """The effect of cavitation in a film that ruptures, or may.

    The lowest pressure is then the cavitation pressure, unless the film stays whole.
    """
    (reason,) = rupture_words(scene, films.lowest / scene.plus_factor, films.error / scene.plus_factor)
    change = inf
    if quantity in CAVITATION_FACTORS:
        by_cavitation, by_inertia = films.changed(quantity)
        change = CAVITATION_FACTORS[quantity] * by_cavitation + by_inertia
    elif quantity == LOWEST:
        change = films.limit - (films.lowest - films.error)
    return Omission(part=_over(change, films, quantity), reason=reason, source=BY_ONE_EFFECT)


def _inertia(scene: Pocket, films: _Films, quantity: str) -> Omission:
    """The effects of inertia and slope, which ``reynolds_cavitating`` leaves out."""
    change, part = inf, inf
    if films.stays_whole:
        law, own = table().promise(kind_of_scene(scene).name_of_laws, REYNOLDS.name).laws.get(quantity), numbers(scene)
        if law is not None and law.has_numbers(own) and law.beyond(own) is None:
            part = law.error(own) + _over(films.changed(quantity)[0], films, quantity)
    elif quantity == LOWEST and films.cavitating is not None:
        ends = (max(films.lowest + sign * films.error, films.limit) for sign in (-1, 1))
        change = max(abs(end - films.value(films.cavitating, quantity)) for end in ends)
        part = _over(change, films, quantity)
    elif quantity in INERTIA_FACTORS and films.whole is not films.reynolds:
        change = INERTIA_FACTORS[quantity] * max(films.changed(name)[1] for name in PRESSURES)
        if quantity == "friction_plus":
            change *= (1 + scene.depth) * scene.geometry.film / scene.geometry.length
        if not films.ruptures and films.cavitating is not None:
            change = max(change, abs(films.value(films.cavitating, quantity) - films.value(films.whole, quantity)))
        part = _over(change, films, quantity)
    size = f"up to {percent(part)}" if part <= 1 else "more than 100 %"
    changed = f"change the {TITLES[quantity]} by {size}" if part < inf else "have an unknown effect here"
    return Omission(
        part=part,
        reason=f"inertia and slope, which reynolds_cavitating leaves out, {changed}",
        source=BY_LAWS if films.stays_whole else BY_ONE_EFFECT,
    )


def _over(change: float, films: _Films, quantity: str) -> float:
    """A change over the size of the quantity with cavitation."""
    if change == 0 or films.cavitating is None or quantity not in films.cavitating.quantities:
        return 0.0 if change == 0 else inf
    size = kind_of(films.cavitating).scale_of(films.cavitating, quantity)
    return change / size if size > 0 else inf


@lru_cache(maxsize=8)
def _films(scene: Pocket) -> _Films:
    """The films of a scene, of which that with inertia is the best model known to hold.

    A film with inertia to first order is judged first. If its error is unknown or contains the cavitation pressure, or
    if it ruptures over grooves, one with all of inertia takes its place. The film without inertia need not meet its
    tolerance.
    """
    reynolds = _by(REYNOLDS, scene)
    if reynolds is None:
        fine = max(REYNOLDS.resolution_of(scene), _fewest(scene))
        reynolds = REYNOLDS.solve(scene, Request(resolution=fine))
    limit = scene.cavitation_pressure / scene.pressure_unit * scene.plus_factor
    falls = reynolds.quantities[LOWEST].value < limit
    films = _Films(
        reynolds=reynolds,
        cavitating=_by(REYNOLDS_CAVITATING, scene) if falls else reynolds,
        whole=reynolds,
        error=_error_of_lowest(scene, REYNOLDS, reynolds),
        limit=limit,
    )
    full = [(FILM_SLOPE, columns) for columns in (PLAN_COLUMNS if scene.in_plan else (None,))]
    for model, columns in ((INERTIAL_REYNOLDS, None), *full):
        result = _by(model, scene, columns)
        if result is None:
            continue
        films = replace(films, whole=result, error=_error_of_lowest(scene, model, result))
        decided = films.stays_whole or (films.ruptures and (scene.in_plan or model is FILM_SLOPE))
        if decided and error_of_lowest(scene, model) is not None:
            break
    return films


def _error_of_lowest(scene: Pocket, model: Model[Pocket], result: Result) -> float:
    """The error of the lowest pressure of a result in units of p+: that by the laws, and its own uncertainty."""
    by_laws, size = error_of_lowest(scene, model), kind_of_scene(scene).scale_of(result, LOWEST)
    return (UNKNOWN_ERROR if by_laws is None else by_laws) * size + (result.quantities[LOWEST].uncertainty or 0.0)


def _fewest(scene: Pocket) -> int:
    """The number of columns that a film needs at least."""
    return fewest_columns(scene) if scene.in_plan else 1


def _by(model: Model[Pocket], scene: Pocket, cells: int | None = None) -> Result | None:
    """The result of a model; None if it does not converge, or its columns are wider than the narrowest dimple."""
    if (cells or model.resolution_of(scene)) < _fewest(scene):
        return None
    try:
        return model.solve(scene, Request(resolution=cells))
    except ConvergenceError:
        return None
