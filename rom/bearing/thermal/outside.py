"""Temperatures of a bearing outside of the range of its lubricant."""

from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.result import Result

OF_FILM = ("effective_temperature", "inlet_temperature", "outlet_temperature", "temperature_max")
"""The quantities that are temperatures of the lubricant, °C."""


def outside_of_lubricant(scene: Bearing, result: Result | None) -> list[str]:
    """The sentence that the lubricant leaves the range of its law of viscosity; none inside of it.

    Parameters
    ----------
    result : the solution, whose film and flows count; without it the lubricant counts as it is supplied.
    """
    if scene.lubricant.temperature is None:
        return []
    found = [scene.lubricant.temperature]
    if result is not None:
        found += [result[name].value + ZERO_CELSIUS for name in OF_FILM if name in result.quantities]
        if "temperature" in result.fields:
            found.append(float(result.fields["temperature"].values.min()) + ZERO_CELSIUS)
    return scene.lubricant.beyond(min(found), max(found))
