"""The unit of velocity of a pad's case, and the pressure that drives its flow."""

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.scene import Bearing


def pressure_difference(scene: Bearing) -> float:
    """The pressure at the end where the sliding wall enters above that where it leaves, Pa."""
    return scene.inlet_pressure - scene.boundary.outlet.pressure


def velocity_unit(scene: Bearing) -> float:
    """The sliding speed, or the mean speed of the flow by pressure, Δp h²/(12 η L), if it is greater, m/s."""
    geometry = scene.geometry
    driven = abs(pressure_difference(scene)) * geometry.thinnest**2 / (12 * scene.lubricant.viscosity * geometry.length)
    return max(abs(scene.motion.speed), driven)


def reynolds_number(scene: Bearing) -> float:
    """The Reynolds number of the minimum film thickness and the velocity unit.

    Raises
    ------
    InputError
        Without a density.
    """
    lubricant = scene.lubricant
    if lubricant.density is None:
        raise InputError("scene.lubricant.density: is missing; give it, or take stokes, which leaves inertia out")
    return lubricant.density * velocity_unit(scene) * scene.geometry.thinnest / lubricant.viscosity
