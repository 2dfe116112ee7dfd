"""Whether a scene has the temperature of its lubricant."""

from roughfilm.rom.bearing.film import averaging_applies
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability


def has_temperature(scene: Bearing) -> Applicability:
    """Whether the lubricant of a scene has what the energy of a film needs, with the entries that are missing."""
    if missing := scene.lubricant.lacking:
        names = ", ".join(f"lubricant.{name}" for name in missing)
        return Applicability(applies=False, reason=f"the scene has no temperature: {names} missing")
    if scene.roughness is None:
        return Applicability(applies=True, reason="one temperature of the film; leaves out inertia and deformation")
    fits = averaging_applies(scene)
    return Applicability(applies=fits.applies, reason=f"one temperature of the film; {fits.reason}")
