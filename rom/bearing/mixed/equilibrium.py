"""The mixed film under a given load."""

from dataclasses import replace

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.timing import imports_apart, working_time
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.stribeck import LOAD_TOLERANCE, RESOLUTION, StribeckPoint, curve_search, stribeck_point
from roughfilm.rom.bearing.scene import Bearing


@imports_apart()
def equilibrium(
    scene: Bearing,
    pressure: float,
    *,
    asperities: Asperities | None = None,
    resolution: int = RESOLUTION,
    tolerance: float = LOAD_TOLERANCE,
) -> StribeckPoint:
    """Solve for the separation at which film and asperities carry a load at the speed of the scene.

    A pad moves as a rigid body without tilting; a journal changes its eccentricity, and loads add up as vectors. The
    film thickness of the scene has no effect.

    Parameters
    ----------
    pressure : the load over the nominal area, Pa.
    asperities, resolution, tolerance : parameters of :func:`roughfilm.rom.bearing.mixed.stribeck.stribeck`.

    Raises
    ------
    InputError
        If the load cannot be carried, the scene has no asperities, or a number is out of range.
    ConvergenceError
        If a film or the load does not converge.
    """
    if not 0 < pressure < float("inf"):
        raise InputError(f"load: got {pressure!r} Pa; it must be above 0 and finite")
    cpu = working_time()
    if scene.asperities is None:
        raise InputError("scene.asperities: is missing; give the solids of the walls")
    search = curve_search(scene, asperities, [scene.motion.speed], [pressure], resolution, tolerance)
    state = search.solved(scene.motion.speed, pressure, ())
    return replace(stribeck_point(state, search, pressure), cpu_s=working_time() - cpu)
