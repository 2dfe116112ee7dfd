"""The effect of cavitation, which all models of a pocket leave out."""

from functools import lru_cache

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.ladder.kind import Omission
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.pocket.models.film import MODEL as FILM
from roughfilm.rom.pocket.models.inertial_reynolds import MODEL as INERTIAL_REYNOLDS
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.warnings import ruptures

CELLS = 200
"""Number of cells of the film whose pressure is compared with the cavitation pressure."""

CHANGES = {"load_plus": 8.0, "pressure_max_plus": 16.0, "pressure_min_plus": 16.0}
"""Largest changes by cavitation over the part of the lowest pressure that is below the cavitation pressure.

In 60 random grooves by the Reynolds equation with cavitation that conserves mass, at six cavitation pressures each, the
load changed by at most 7.5 of that pressure (5.1 in 95 of 100), and the pressure anywhere by at most 15.
"""

FRICTION_CHANGE = 2.5
"""The same for friction per area, over that pressure times the thickest film over the period; at most 2.2 in them."""


def rupture_omitted(scene: Pocket, quantity: str) -> Omission | None:
    """The largest relative change of a quantity by cavitation; None if the film does not rupture.

    The lowest pressure is that of ``film``, or of ``inertial_reynolds`` if it does not rupture or ``film`` does not
    converge. The change of a quantity without a known bound is infinite.
    """
    found = _ruptured(scene)
    if found is None:
        return None
    lowest = _lowest(scene, found)
    missing = scene.cavitation_pressure / scene.pressure_unit - lowest
    thickest = (1 + scene.depth) * scene.geometry.film / scene.geometry.length
    change = {**CHANGES, "friction_plus": FRICTION_CHANGE * thickest}.get(quantity, float("inf"))
    size = abs(found.quantities[quantity].value) / scene.plus_factor if quantity in found.quantities else 0.0
    return Omission(part=change * missing / size if size > 0 else float("inf"), reason=ruptures(scene, lowest)[0])


@lru_cache(maxsize=8)
def _ruptured(scene: Pocket) -> Result | None:
    """The film whose pressure falls below the cavitation pressure; None if it does not."""
    found = INERTIAL_REYNOLDS.solve(scene, Request(resolution=INERTIAL_REYNOLDS.resolution_of(scene)))
    if ruptures(scene, _lowest(scene, found)):
        found = _by_film(scene, FILM) or found
    return found if ruptures(scene, _lowest(scene, found)) else None


def _by_film(scene: Pocket, model: Model[Pocket]) -> Result | None:
    try:
        return model.solve(scene, Request(resolution=CELLS))
    except ConvergenceError:
        return None


def _lowest(scene: Pocket, result: Result) -> float:
    return result.quantities["pressure_min_plus"].value / scene.plus_factor
