"""The effects that models of a pocket leave out where the film ruptures, from what each effect does by itself.

The bounds hold in 96 to 100 of 100 random pockets, judged by the Reynolds equation with inertia to first order and with
cavitation (``python -m scripts.studies.coverage.rupture``).
"""

from dataclasses import dataclass
from functools import lru_cache
from math import inf

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.advice.laws import table
from roughfilm.rom.advice.stated import BY_LAWS, percent
from roughfilm.rom.ladder.kind import Omission, kind_of, kind_of_scene
from roughfilm.rom.ladder.model import Effect, Model
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.pocket.models.film import MODEL as FILM
from roughfilm.rom.pocket.models.film_slope import MODEL as FILM_SLOPE
from roughfilm.rom.pocket.models.inertial_reynolds import MODEL as INERTIAL_REYNOLDS
from roughfilm.rom.pocket.models.reynolds import MODEL as REYNOLDS
from roughfilm.rom.pocket.models.reynolds_cavitating import MODEL as REYNOLDS_CAVITATING
from roughfilm.rom.pocket.scene import TITLES, Pocket
from roughfilm.rom.pocket.validity.numbers import numbers
from roughfilm.rom.pocket.validity.warnings import ruptures

CELLS = 200
"""Number of cells of a film over grooves with inertia whose pressure is compared with the cavitation pressure."""

PRESSURES = ("load_plus", "pressure_max_plus", "pressure_min_plus")
"""Quantities in units of p+."""

CAVITATION_FACTORS = {"load_plus": 1.0, "pressure_max_plus": 1.0, "pressure_min_plus": 1.0, "friction_plus": 1.9}
"""Factors of |with - without cavitation|, without inertia, in the bound of the error of a model without cavitation.

|With - without inertia|, without cavitation, is added.
"""

INERTIA_FACTORS = {"load_plus": 1.5, "pressure_max_plus": 2.5, "pressure_min_plus": 0.0, "friction_plus": 4.3}
"""Bounds of the error of ``reynolds_cavitating`` over the largest change of load or pressures by inertia.

The change is that of a film that stays whole. The bound of friction is over it times the thickest film over the period.
"""

BY_ONE_EFFECT = "estimated from each effect by itself"
"""Source of the error where the film ruptures."""


@dataclass(frozen=True, kw_only=True)
class _Films:
    """The films of a scene whose film ruptures in at least one of them.

    Attributes
    ----------
    reynolds, cavitating : results without inertia, without and with cavitation; None if the latter does not converge.
    inertia : result with inertia that stays whole; None if no model has one.
    """

    reynolds: Result
    cavitating: Result | None
    inertia: Result | None

    def value(self, result: Result, quantity: str) -> float:
        """The quantity of one of the results."""
        return result.quantities[quantity].value

    @property
    def whole(self) -> Result:
        """The most complete film without cavitation."""
        return self.inertia or self.reynolds

    def lowest(self, scene: Pocket) -> tuple[float, ...]:
        """The lowest pressures of the films without cavitation, in units of η u / Ly, the most complete film first."""
        return tuple(self.value(one, "pressure_min_plus") / scene.plus_factor for one in (self.whole, self.reynolds))

    def changed(self, quantity: str) -> tuple[float, float]:
        """The changes of a quantity by cavitation and by inertia, each without the other."""
        without = self.value(self.reynolds, quantity)
        by_cavitation = inf if self.cavitating is None else abs(self.value(self.cavitating, quantity) - without)
        return by_cavitation, abs(self.value(self.whole, quantity) - without)


def omission(scene: Pocket, model: Model[Pocket], quantity: str) -> Omission | None:
    """The effect that a model leaves out and that no law counts; None if there is none.

    Without cavitation it is that of cavitation. With it, it is that of inertia and slope, for which there is no more
    complete model. The part is infinite for a quantity without a known bound.
    """
    found = _ruptured(scene)
    if Effect.CAVITATION in model.keeps:
        return _inertia(scene, found, quantity)
    return None if found is None else _cavitation(scene, found, quantity)


def missing(scene: Pocket, model: Model[Pocket]) -> float:
    """The relative change of the load by the effects among inertia and cavitation that a model leaves out.

    It is 0 where the film does not rupture: a model then includes all.
    """
    found = _ruptured(scene)
    if found is None:
        return 0.0
    by_cavitation, by_inertia = found.changed("load_plus")
    left_out = {Effect.CAVITATION: by_cavitation, Effect.INERTIA: by_inertia}
    change = sum(size for effect, size in left_out.items() if effect not in model.keeps)
    return _over(change, found, "load_plus")


def _cavitation(scene: Pocket, found: _Films, quantity: str) -> Omission:
    reason = next(filter(None, (ruptures(scene, lowest) for lowest in found.lowest(scene))))[0]
    change = inf
    if quantity in CAVITATION_FACTORS:
        by_cavitation, by_inertia = found.changed(quantity)
        change = CAVITATION_FACTORS[quantity] * by_cavitation + by_inertia
    return Omission(part=_over(change, found, quantity), reason=reason, source=BY_ONE_EFFECT)


def _inertia(scene: Pocket, found: _Films | None, quantity: str) -> Omission:
    change, part = inf, inf
    if found is None:
        laws = table().promise(kind_of_scene(scene).name_of_laws, REYNOLDS.name).laws
        law, own = laws.get(quantity), numbers(scene)
        if law is not None and law.has_numbers(own) and law.beyond(own) is None:
            part = law.error(own)
    elif found.inertia is not None and quantity in INERTIA_FACTORS:
        change = INERTIA_FACTORS[quantity] * max(found.changed(name)[1] for name in PRESSURES)
        if quantity == "friction_plus":
            change *= (1 + scene.depth) * scene.geometry.film / scene.geometry.length
        part = _over(change, found, quantity)
    size = f"up to {percent(part)}" if part <= 1 else "more than 100 %"
    changed = f"change the {TITLES[quantity]} by {size}" if part < inf else "have an unknown effect here"
    return Omission(
        part=part,
        reason=f"inertia and slope, which reynolds_cavitating leaves out, {changed}",
        source=BY_LAWS if found is None else BY_ONE_EFFECT,
    )


def _over(change: float, found: _Films, quantity: str) -> float:
    """A change over the size of the quantity with cavitation."""
    if change == 0 or found.cavitating is None or quantity not in found.cavitating.quantities:
        return 0.0 if change == 0 else inf
    size = kind_of(found.cavitating).scale_of(found.cavitating, quantity)
    return change / size if size > 0 else inf


@lru_cache(maxsize=8)
def _ruptured(scene: Pocket) -> _Films | None:
    """The films of a scene whose film ruptures; None if it does not.

    A film with inertia to first order is judged first, over grooves then one with all of it, if it converges. The film
    without inertia need not meet its tolerance.
    """
    reynolds, inertia = _by(REYNOLDS, scene), _by(INERTIAL_REYNOLDS, scene)
    if reynolds is None:
        reynolds = REYNOLDS.solve(scene, Request(resolution=REYNOLDS.resolution_of(scene)))
    if not any(_falls(scene, one) for one in (reynolds, inertia) if one is not None):
        return None
    if not scene.in_plan:
        inertia = _by(FILM_SLOPE, scene, CELLS) or _by(FILM, scene, CELLS) or inertia
    if not _falls(scene, inertia or reynolds):
        return None
    return _Films(reynolds=reynolds, cavitating=_by(REYNOLDS_CAVITATING, scene), inertia=inertia)


def _by(model: Model[Pocket], scene: Pocket, cells: int | None = None) -> Result | None:
    """The result of a model; None if it does not converge."""
    try:
        return model.solve(scene, Request(resolution=cells))
    except ConvergenceError:
        return None


def _falls(scene: Pocket, result: Result) -> bool:
    """Whether a result falls below the cavitation pressure."""
    return bool(ruptures(scene, result.quantities["pressure_min_plus"].value / scene.plus_factor))
