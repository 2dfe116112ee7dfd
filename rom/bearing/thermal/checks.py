"""Checks of the heat in a scene, against its lubricant."""

from collections.abc import Mapping

from roughfilm.rom.bearing.lubricant import BearingLubricant
from roughfilm.rom.bearing.thermal.tables import Heat
from roughfilm.rom.lubricants.thermal.law import celsius

COLDER, WARMER = 200.0, 500.0
"""Largest differences of a temperature in a scene from that of the supplied lubricant, K; a larger one is a typing
error such as K in place of degC, and no lubricant stays liquid over it."""


def check_heat(lubricant: BearingLubricant, heat: Heat | None, others: Mapping[str, float | None]) -> None:
    """Raise ValueError for heat in a scene without temperature, and for temperatures far from the lubricant's.

    Parameters
    ----------
    lubricant : the lubricant of the scene.
    heat : its table [heat].
    others : other temperatures of the scene, K, by their keys.
    """
    given = {key: one for key, one in {**others, **_temperatures(heat)}.items() if one is not None}
    place = next(iter(given), None) if heat is None else "heat"
    if place is None:
        return
    if lubricant.lacking:
        *first, last = (f"lubricant.{key}" for key in lubricant.lacking)
        missing = f"{', '.join(first)} and {last}" if first else last
        raise ValueError(
            f"{place}: got {'a table' if place == 'heat' else 'a temperature'}, but the scene has no temperature "
            f"without {missing}; give {'them' if first else 'it'}, name an oil, or leave {place} out"
        )
    supplied = lubricant.temperature
    assert supplied is not None
    for key, temperature in given.items():
        if not supplied - COLDER <= temperature <= supplied + WARMER:
            raise ValueError(
                f"{key}: got {celsius(temperature)}; it must be from {celsius(supplied - COLDER)} to "
                f"{celsius(supplied + WARMER)}, {COLDER:g} K below to {WARMER:g} K above lubricant.temperature; check "
                "the unit"
            )


def _temperatures(heat: Heat | None) -> dict[str, float | None]:
    """The temperatures of a table [heat], K, by their keys."""
    if heat is None:
        return {}
    walls = {
        f"heat.{wall}.{key}": getattr(getattr(heat, wall), key, None)
        for wall in ("fixed_wall", "sliding_wall")
        for key in ("temperature", "surroundings")
    }
    return {**walls, "heat.surroundings": heat.surroundings}
