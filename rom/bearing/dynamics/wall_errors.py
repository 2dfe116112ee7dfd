"""The errors of stiffness, damping and equilibrium by those of flow factors and contact pressures of rough walls."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.dynamics.balance import TOLERANCE, Equilibrium, point_of, temperatures_of
from roughfilm.rom.bearing.dynamics.point import GridPoint, changes_of, grid_point
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.march.rough_walls import Walls
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.balanced import MAX_SLOPE
from roughfilm.rom.cavitation.motion.contact import ContactLaw
from roughfilm.rom.cavitation.motion.coupled import Instant
from roughfilm.rom.cavitation.motion.film import MovingFilm

OF_FACTORS = ("side_leakage", "power_loss", "power_loss_per_width")
"""Numbers that flow factors change at an unchanged film and load."""

OF_VISCOSITY = ("sommerfeld_number",)
"""Numbers that the viscosity alone changes in proportion."""

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


def wall_errors(scene: Bearing, walls: Walls, found: Equilibrium, ratio: float) -> Callable[[str], float]:
    """The uncertainty of every number of an equilibrium, or of an entry of its whirl, by flow factors and contact.

    The equilibrium is solved again with pressures of the film that are larger by the relative uncertainty of the flow
    factors and of a lay that is left out, as those of a thicker lubricant are, and with contact pressures at a
    separation that is smaller by their uncertainty. The changes of the numbers add up. A balanced temperature T is
    uncertain by twice that relative uncertainty of its rise, by friction and by flows, and by what the other contact
    pressures change of it; the viscosity then is uncertain by abs(d ln η/dT) δT more.

    Parameters
    ----------
    scene : the bearing with the lubricant as it is supplied.
    walls : its walls.
    found : the equilibrium on a grid.
    ratio : frequency of the motion over that of the rotation.
    """
    if walls.factors is None:
        return lambda _name: 0.0
    film, instant = found.film, found.instant
    least = float(instant.faces.thickness.min())
    of_film = walls.of_factors(least) + walls.of_lay(least, even=film.solved.halved)
    of_contact, moved = walls.of_contact(least)
    if not math.isfinite(of_film + of_contact):
        return lambda _name: math.inf
    own = point_of(found, ratio)
    direct = {name: of_film * abs(own.numbers[name]) for name in OF_FACTORS if name in own.numbers}
    if walls.contact is not None:
        direct |= {name: of_contact * abs(own.numbers[name]) for name in OF_CONTACT if name in own.numbers}
    others: list[GridPoint] = []

    def altered(one: FreeFilm) -> Instant:
        moved_to = equilibrium(one, instant, tolerance=TOLERANCE)
        others.append(grid_point(one, moved_to, ratio))
        return moved_to

    try:
        by_contact: dict[str, float] = {}
        if walls.contact is not None and moved:
            closer = _altered(film, contact=ShiftedContact(table=walls.contact, shift=moved))
            place = altered(closer)
            if found.temperatures is not None:
                other = replace(found, temperatures=temperatures_of(scene, closer, place))
                by_contact = {name: abs(other.degrees[name] - value) for name, value in found.degrees.items()}
        direct |= (warmer := _of_temperature(scene, found, of_film, by_contact))
        of_viscosity = _thinning(film) * warmer.get("temperature", 0.0)
        direct |= {name: of_viscosity * abs(own.numbers[name]) for name in OF_VISCOSITY if name in own.numbers}
        if thicker := of_film + of_viscosity:
            altered(_altered(film, thicker=thicker))
    except (InputError, ConvergenceError):  # the altered walls have no equilibrium
        return lambda _name: math.inf

    def error(name: str) -> float:
        if name in found.degrees:
            return direct[name]
        changes = sum(changes_of(name, own, others))
        return changes + direct.get(name, 0.0) if math.isfinite(changes) else math.inf

    return error


def _of_temperature(
    scene: Bearing, found: Equilibrium, of_film: float, by_contact: Mapping[str, float]
) -> dict[str, float]:
    """The errors of the temperatures, K, where those that heat brings about grow with that of the film by S < 1.

    They are (2 δ |T - T₀| + δT_c)/(1 - S) with the relative error δ of friction and flows and δT_c by the contact.
    """
    supplied = 0.0 if scene.lubricant.temperature is None else scene.lubricant.temperature - ZERO_CELSIUS
    grown = 1 - min(max(found.slope, 0.0), MAX_SLOPE)
    return {
        name: (2 * of_film * abs(value - supplied) + by_contact.get(name, 0.0)) / grown
        for name, value in found.degrees.items()
    }


def _thinning(film: FreeFilm) -> float:
    """The relative fall of the viscosity over the temperature of a film, |d ln η/dT|, 1/K; 0 without a temperature."""
    lubricant = film.scene.lubricant
    if lubricant.lacking:
        return 0.0
    viscosity, fall = (float(one[0]) for one in lubricant.viscosity_at(np.array([lubricant.temperature])))
    return abs(fall / viscosity)
