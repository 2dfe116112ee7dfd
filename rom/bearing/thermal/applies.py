"""Whether a scene has the temperature of its lubricant."""

from dataclasses import replace

from roughfilm.rom.bearing.film import averaging_applies
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.tables import Conducting, HalfSpace, Heat
from roughfilm.rom.ladder.model import Applicability


def has_temperature(scene: Bearing, assumed: str = "one temperature of the film") -> Applicability:
    """Whether the lubricant of a scene has what the energy of a film needs, with the entries that are missing.

    Parameters
    ----------
    assumed : what the model assumes of the temperature, in words.
    """
    if missing := scene.lubricant.lacking:
        names = ", ".join(f"lubricant.{name}" for name in missing)
        return Applicability(applies=False, reason=f"the scene has no temperature: {names} missing")
    if scene.roughness is None:
        return Applicability(applies=True, reason=f"{assumed}; leaves out inertia and deformation")
    fits = averaging_applies(scene)
    return Applicability(applies=fits.applies, reason=f"{assumed}; {fits.reason}")


def adiabatic_applies(scene: Bearing) -> Applicability:
    """Whether the model of walls that take no heat applies, with the walls of the scene that it leaves out."""
    fits, heat = has_temperature(scene, "the mean temperature across the film"), scene.heat or Heat()
    walls = [name for name in ("fixed_wall", "sliding_wall") if getattr(heat, name).kind != "adiabatic"]
    if not fits.applies or not walls:
        return fits
    named = " and ".join(f"heat.{name}" for name in walls)
    return replace(fits, reason=f"{fits.reason}; leaves out {named}, as its walls take no heat")


def across_applies(scene: Bearing) -> Applicability:
    """Whether the model of the temperature across the film applies to the lubricant, the walls and the grooves."""
    fits, heat = has_temperature(scene, "the temperature from wall to wall"), scene.heat or Heat()
    if not fits.applies:
        return fits
    if scene.lubricant.conductivity is None:
        return Applicability(
            applies=False, reason="the scene has no temperature across: lubricant.conductivity missing"
        )
    for name in ("fixed_wall", "sliding_wall"):
        wall = getattr(heat, name)
        if isinstance(wall, Conducting) and wall.thickness is not None and wall.conductivity is None:
            return Applicability(applies=False, reason=f"heat.{name}: a thickness without a conductivity; give it")
    lobes = isinstance(scene.geometry, Lobes) and not scene.geometry.single
    if heat.carried_over < 1 and (lobes or scene.supply):
        why = (
            f"heat.carried_over is {heat.carried_over:g} behind {'gaps' if lobes else 'supplies'}, where this model "
            "carries all hot lubricant over; give 1, or take adiabatic"
        )
        return Applicability(applies=False, reason=why)
    if isinstance(heat.sliding_wall, HalfSpace) and (scene.motion.speed == 0 or scene.problem().shape.joined[0]):
        why = "heat.sliding_wall: a half space needs a film with an inlet past which it slides; take turning"
        return Applicability(applies=False, reason=why)
    return fits
