"""Whether a scene has the temperature of its lubricant."""

from dataclasses import replace

from roughfilm.rom.bearing.film import averaging_applies
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.exchange import leaves_through_the_wall
from roughfilm.rom.bearing.thermal.tables import HalfSpace, Heat
from roughfilm.rom.ladder.model import Applicability

WALLS = ("fixed_wall", "sliding_wall")
SURROUNDINGS = ("heat_transfer",)


def has_temperature(scene: Bearing, taken: str) -> Applicability:
    """Whether the lubricant of a scene has what the energy of a film needs, with the entries that are missing.

    Parameters
    ----------
    taken : the temperature that the model takes, in words.
    """
    if missing := scene.lubricant.lacking:
        names = ", ".join(f"lubricant.{name}" for name in missing)
        return Applicability(applies=False, reason=f"the scene has no temperature: {names} missing")
    if scene.roughness is None:
        return Applicability(applies=True, reason=f"takes {taken}; leaves out inertia and deformation")
    fits = averaging_applies(scene)
    return Applicability(applies=fits.applies, reason=f"takes {taken}; {fits.reason}" if fits.applies else fits.reason)


def _without(fits: Applicability, scene: Bearing, keys: tuple[str, ...]) -> Applicability:
    """The same, with the given keys of the table [heat] that the model leaves out."""
    given = {} if scene.heat is None else {key: getattr(scene.heat, key) for key in keys}
    left = [f"heat.{key}" for key, one in given.items() if one is not None and getattr(one, "kind", "") != "adiabatic"]
    if not fits.applies or not left:
        return fits
    return replace(fits, reason=f"{fits.reason}; leaves out {' and '.join(left)}")


def heat_balance_applies(scene: Bearing) -> Applicability:
    """Whether the model of one temperature applies, with the walls of the scene that it leaves out."""
    return _without(has_temperature(scene, "one temperature for the film"), scene, WALLS)


def _stays(scene: Bearing) -> bool:
    """Whether lubricant stays at a place: where walls that approach without sliding displace it to all sides alike."""
    if scene.motion.speed != 0 or scene.motion.approach <= 0 or scene.supply:
        return False
    ends = scene.ends
    return len({ends.outlet, ends.outlet if ends.inlet is None else ends.inlet, *(ends.sides or ())}) == 1


UNSTEADY = Applicability(
    applies=False,
    reason="walls that take no heat and only approach each other have no steady temperature over the film, whose "
    "lubricant stays where it flows to all sides; take heat_balance or roughfilm march, or a wall that takes heat",
)


def adiabatic_applies(scene: Bearing) -> Applicability:
    """Whether the model of walls that take no heat applies, with what takes heat in the scene and is left out."""
    if not scene.lubricant.lacking and _stays(scene):
        return UNSTEADY
    return _without(has_temperature(scene, "the mean temperature across the film"), scene, WALLS + SURROUNDINGS)


def across_applies(scene: Bearing) -> Applicability:
    """Whether the model of the temperature across the film applies to the lubricant, the walls and the grooves."""
    fits, heat = has_temperature(scene, "the temperature from wall to wall"), scene.heat or Heat()
    if not fits.applies:
        return fits
    if _stays(scene) and heat.insulated and not leaves_through_the_wall(scene):
        return UNSTEADY
    if scene.lubricant.conductivity is None:
        return Applicability(
            applies=False, reason="the scene has no temperature across: lubricant.conductivity missing"
        )
    if heat.carried_over < 1 and scene.supply:
        why = (
            f"heat.carried_over is {heat.carried_over:g} behind supplies, where this model carries all hot lubricant "
            "over; give 1, or take adiabatic"
        )
        return Applicability(applies=False, reason=why)
    ring = isinstance(scene.geometry, Ring) and scene.geometry.endless
    endless = ring or (isinstance(scene.geometry, Lobes) and not scene.geometry.single)
    if isinstance(heat.sliding_wall, HalfSpace) and (scene.motion.speed == 0 or endless):
        why = "heat.sliding_wall: a half space needs a film with an inlet past which it slides; take turning"
        return Applicability(applies=False, reason=why)
    return fits if leaves_through_the_wall(scene) else _without(fits, scene, SURROUNDINGS)
