"""The quantities of an infinitely wide pad from the forces and flows of its film."""

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.quantities import numbers_of_load
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.totals.least_film import least_film
from roughfilm.rom.ladder.result import beyond_round_off

MIN_LOAD_OVER_PRESSURE = 1e-6
"""Mean pressure over the largest one below which no friction coefficient is given."""


def pad_quantities(
    scene: Bearing,
    *,
    load: float,
    friction: float,
    inlet_flow: float,
    outlet_flow: float,
    pressure_max: float,
    rounding: float,
) -> dict[str, Quantity]:
    """The quantities of a film without cavities, as those of the Reynolds equation.

    Parameters
    ----------
    load : integral of the pressure above ambient on the sliding wall, N/m.
    friction : force on the sliding wall against its motion, N/m.
    inlet_flow, outlet_flow : flow in through the end where the wall enters, and out where it leaves, m²/s.
    pressure_max : largest pressure above ambient on the sliding wall, Pa.
    rounding : round-off of the pressure, Pa.
    """
    geometry, specific = scene.geometry, load / scene.nominal_area
    least = least_film(geometry, turned=scene.motion.speed < 0)
    values: dict[str, tuple[float, str]] = {
        "load_per_width": (load, "N/m"),
        "film_min": (least.thickness, "m"),
        "power_loss_per_width": (abs(scene.motion.speed) * friction, "W/m"),
        "pressure_max": (pressure_max, "Pa"),
        "inlet_flow_per_width": (inlet_flow, "m^2/s"),
        "outlet_flow_per_width": (outlet_flow, "m^2/s"),
        "friction_per_width": (friction, "N/m"),
        "specific_load": (specific, "Pa"),
        "film_min_x": (least.x, "m"),
    }
    if specific > max(rounding, MIN_LOAD_OVER_PRESSURE * abs(pressure_max)):
        values["friction_coefficient"] = (friction / load, "1")
        values |= {name: (number, "1") for name, number in numbers_of_load(scene, specific).items()}
    found = {name: Quantity(value=value, unit=unit) for name, (value, unit) in values.items()}
    sizes = {"load_per_width": rounding * scene.nominal_area, "specific_load": rounding, "pressure_max": rounding}
    return found | {name: beyond_round_off(found[name], size) for name, size in sizes.items()}
