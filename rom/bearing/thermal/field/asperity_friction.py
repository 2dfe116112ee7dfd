"""The heat of asperities in contact, and their coefficient of friction at the temperature of the film."""

from dataclasses import dataclass

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.asperity_contact import BoundaryFriction
from roughfilm.rom.bearing.mixed.contact_load import asperity_load
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.asperity_heat import asperity_heat
from roughfilm.rom.bearing.thermal.field.heated import HeatedFilm, start_of
from roughfilm.rom.cavitation.solve import Solution


@dataclass(frozen=True)
class AsperityFriction:
    """The heat of asperities at the nodes, W, shape (nx, ny), and their coefficient of friction."""

    power: Array
    friction: float


def asperity_friction(scene: Bearing, solution: Solution, near: HeatedFilm | None) -> AsperityFriction | None:
    """The heat of the asperities of a film; None without asperities.

    A coefficient over temperature is that at the mean temperature of the contact, weighted by its pressure.

    Parameters
    ----------
    near : temperatures of a film near this one; without one the lubricant has the temperature of the supply.

    Raises
    ------
    InputError
        If that temperature lies outside of the table of the coefficient.
    """
    if scene.asperities is None:
        return None
    force = asperity_load(solution.problem.shape, solution.grid, asperities_of(scene)).force
    temperature, pressed = start_of(near, solution), float(force.sum())
    at_contact = scene.lubricant.temperature
    if temperature is not None and pressed > 0:
        at_contact = float((force * temperature).sum()) / pressed
    friction = scene.asperities.friction_at(at_contact)
    return AsperityFriction(asperity_heat(solution, force, friction), friction)


def with_friction(scene: Bearing, friction: float | None) -> Bearing:
    """The scene with one coefficient of boundary friction in place of a table over temperature."""
    asperities = scene.asperities
    if friction is None or asperities is None or asperities.friction.constant is not None:
        return scene
    constant = asperities.model_copy(update={"friction": BoundaryFriction(constant=friction)})
    return scene.model_copy(update={"asperities": constant})
