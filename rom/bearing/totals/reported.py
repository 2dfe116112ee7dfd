"""The quantities of a bearing in the order in which people read them."""

from collections.abc import Mapping

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.geometry.lobes import MAX_LOBES
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.supply.tables import MAX_SUPPLIES

REPORTED: Mapping[str, str] = {
    "load": "load",
    "bearing_load": "load, whole bearing",
    "load_per_width": "load per width",
    "film_min": "least film thickness",
    "friction_coefficient": "friction coefficient",
    "power_loss": "power loss",
    "bearing_power_loss": "power loss, whole bearing",
    "power_loss_per_width": "power loss per width",
    "temperature_max": "highest temperature",
    "temperature_mean": "mean temperature of the film",
    "effective_temperature": "effective temperature of the film",
    "inlet_temperature": "temperature at the inlet",
    "outlet_temperature": "temperature of the outflow",
    "shaft_temperature": "temperature of the shaft",
    "heat_generated": "heat generated",
    "bearing_heat_generated": "heat generated, whole bearing",
    "heat_generated_per_width": "heat generated per width",
    "heat_to_lubricant": "heat to the lubricant",
    "bearing_heat_to_lubricant": "heat to the lubricant, whole bearing",
    "heat_to_lubricant_per_width": "heat to the lubricant per width",
    "heat_to_fixed_wall": "heat to the fixed wall",
    "bearing_heat_to_fixed_wall": "heat to the fixed wall, whole bearing",
    "heat_to_fixed_wall_per_width": "heat to the fixed wall per width",
    "heat_to_sliding_wall": "heat to the sliding wall",
    "bearing_heat_to_sliding_wall": "heat to the sliding wall, whole bearing",
    "heat_to_sliding_wall_per_width": "heat to the sliding wall per width",
    "heat_to_surroundings": "heat to the surroundings",
    "bearing_heat_to_surroundings": "heat to the surroundings, whole bearing",
    "heat_to_surroundings_per_width": "heat to the surroundings per width",
    "pressure_max": "peak pressure",
    "inlet_flow": "flow in",
    "bearing_inlet_flow": "flow in, whole bearing",
    "inlet_flow_per_width": "flow in per width",
    "outlet_flow": "flow out",
    "bearing_outlet_flow": "flow out, whole bearing",
    "outlet_flow_per_width": "flow out per width",
    "displaced_flow": "flow displaced by the approach",
    "bearing_displaced_flow": "flow displaced by the approach, whole bearing",
    "displaced_flow_per_width": "flow displaced by the approach per width",
    "side_leakage": "side leakage",
    "bearing_side_leakage": "side leakage, whole bearing",
    "side_leakage_low": "side leakage, low side",
    "side_leakage_high": "side leakage, high side",
    "supply_flow": "flow supplied",
    "bearing_supply_flow": "flow supplied, whole bearing",
    "supply_flow_per_width": "flow supplied per width",
    **{
        name: title
        for number in range(1, MAX_SUPPLIES + 1)
        for name, title in {
            f"supply_{number}_flow": f"flow of supply {number}",
            f"supply_{number}_flow_per_width": f"flow of supply {number} per width",
            f"supply_{number}_pressure": f"pressure in supply {number}",
        }.items()
    },
    "friction": "friction",
    "bearing_friction": "friction, whole bearing",
    "friction_per_width": "friction per width",
    "torque": "torque",
    "bearing_torque": "torque, whole bearing",
    "torque_per_width": "torque per width",
    "specific_load": "specific load",
    "contact_share": "share of the load by contact",
    "contact_load": "load by contact",
    "bearing_contact_load": "load by contact, whole bearing",
    "contact_load_per_width": "load by contact per width",
    "film_load": "load by the film",
    "bearing_film_load": "load by the film, whole bearing",
    "film_load_per_width": "load by the film per width",
    "contact_area": "contact area over nominal area",
    "contact_pressure_max": "peak contact pressure",
    "least_gap": "least mean gap",
    "flash_temperature": "flash temperature above the walls, estimate",
    "flash_temperature_low": "flash temperature, low estimate",
    "flash_temperature_high": "flash temperature, high estimate",
    "eccentricity": "eccentricity",
    "eccentricity_x": "eccentricity along x",
    "eccentricity_y": "eccentricity along y",
    "pivot_film": "film at the pivot",
    "slope_x": "slope along the sliding",
    "slope_y": "slope across the sliding",
    "moment_x": "moment about x",
    "moment_y": "moment about y",
    "attitude_angle": "attitude angle",
    "film_min_angle": "angle of the least film",
    "film_min_x": "place of the least film along",
    "film_min_y": "place of the least film across",
    "temperature_max_x": "place of the highest temperature along",
    "temperature_max_y": "place of the highest temperature across",
    **{f"tilt_{number}": f"tilt of pad {number}" for number in range(1, MAX_LOBES + 1)},
    "cavitated_fraction": "cavitated fraction",
    "film_start": "film begins at x/L",
    "rupture": "film ruptures at x/L",
    "theta_min": "least density ratio",
    "sommerfeld_number": "Sommerfeld number",
    "hersey_number": "Hersey number",
}
"""The titles of the quantities of a bearing, in the order of tables."""


def in_order(scene: Bearing, quantities: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """The quantities in the order of ``REPORTED``, then the others; under a load the film is the first."""
    first = () if scene.load is None else ("film_min",)
    return {name: quantities[name] for name in dict.fromkeys((*first, *REPORTED, *quantities)) if name in quantities}
