"""The unit of velocity of a pad's case, and the pressure that drives its flow."""

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
    """The Reynolds number of the minimum film thickness and the velocity unit; 0 without a density."""
    lubricant = scene.lubricant
    return (lubricant.density or 0.0) * velocity_unit(scene) * scene.geometry.thinnest / lubricant.viscosity
