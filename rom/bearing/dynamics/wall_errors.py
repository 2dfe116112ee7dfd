"""The errors of stiffness, damping and equilibrium by those of flow factors and contact pressures of rough walls."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.dynamics.point import grid_point
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.march.rough_walls import Walls
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.cavitation.motion.contact import ContactLaw
from roughfilm.rom.cavitation.motion.coupled import Instant
from roughfilm.rom.cavitation.motion.film import MovingFilm

OF_FACTORS = ("side_leakage", "power_loss", "power_loss_per_width")
"""Numbers that flow factors change at an unchanged film and load."""

OF_CONTACT = ("contact_pressure_max", "contact_area")
"""Numbers of the contact whose relative uncertainty is that of the contact pressures."""


@dataclass(frozen=True, kw_only=True)
class ShiftedContact:
    """The contact pressure of a table at a separation that is smaller by ``shift``, m; the mean gap is unchanged."""

    table: AsperityTable
    shift: float

    @property
    def touching(self) -> float:
        """The separation at first contact, m."""
        return self.table.touching + self.shift

    @property
    def closest(self) -> float:
        """The smallest known separation, m."""
        return self.table.closest + self.shift

    def contact_pressure(self, separation: Array) -> Array:
        """The contact pressure, Pa."""
        return self.table.contact_pressure(separation - self.shift)

    def mean_gap(self, separation: Array) -> Array:
        """The mean gap, m."""
        return self.table.mean_gap(separation)


def _altered(film: FreeFilm, *, thicker: float = 0.0, contact: ContactLaw | None = None) -> FreeFilm:
    """The film with a viscosity that is larger by a relative change, or with another contact of its walls."""

    def changed(one: MovingFilm) -> MovingFilm:
        problem = replace(one.problem, viscosity=(1 + thicker) * one.problem.viscosity)
        return replace(one, problem=problem, contact=contact or one.contact)

    return replace(film, whole=changed(film.whole), solved=changed(film.solved))


def wall_errors(
    walls: Walls, film: FreeFilm, instant: Instant, ratio: float, *, tolerance: float
) -> Callable[[str], float]:
    """The uncertainty of every number of an equilibrium, or of an entry of its whirl, by flow factors and contact.

    The equilibrium is solved again with pressures of the film that are larger by the relative uncertainty of the flow
    factors and of a lay that is left out, as those of a thicker lubricant are, and with contact pressures at a
    separation that is smaller by their uncertainty. The changes of the numbers add up.

    Parameters
    ----------
    film, instant : the equilibrium on a grid.
    ratio : frequency of the motion over that of the rotation.
    tolerance : residual at which a film is solved.
    """
    if walls.factors is None:
        return lambda _name: 0.0
    least = float(instant.faces.thickness.min())
    of_film = walls.of_factors(least) + walls.of_lay(least, even=film.solved.halved)
    of_contact, moved = walls.of_contact(least)
    if not math.isfinite(of_film + of_contact):
        return lambda _name: math.inf
    own = grid_point(film, instant, ratio)
    direct = {name: of_film * abs(own.numbers[name]) for name in OF_FACTORS if name in own.numbers}
    if walls.contact is not None:
        direct |= {name: of_contact * abs(own.numbers[name]) for name in OF_CONTACT if name in own.numbers}

    altered = [_altered(film, thicker=of_film)] if of_film else []
    if walls.contact is not None and moved:
        altered.append(_altered(film, contact=ShiftedContact(table=walls.contact, shift=moved)))
    try:
        others = [grid_point(one, equilibrium(one, instant, tolerance=tolerance), ratio) for one in altered]
    except (InputError, ConvergenceError):  # the altered walls have no equilibrium
        return lambda _name: math.inf

    def error(name: str) -> float:
        if name in own.numbers:
            changes = sum(abs(other.numbers[name] - own.numbers[name]) for other in others)
            return changes + direct.get(name, 0.0)
        if own.whirl is None:
            return 0.0
        here = getattr(own.whirl, name)
        changes = sum(abs(getattr(other.whirl, name) - here) for other in others)
        return changes if math.isfinite(changes) else math.inf

    return error
