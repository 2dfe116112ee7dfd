"""The film under a given load: how far apart film and asperities together hold the walls."""

import time
from dataclasses import replace

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.balance import Speed, balanced
from roughfilm.rom.bearing.mixed.stribeck import RESOLUTION, TOLERANCE, StribeckPoint, mixed_film, stribeck_point
from roughfilm.rom.bearing.scene import Bearing


def equilibrium(
    scene: Bearing,
    pressure: float,
    *,
    asperities: Asperities | None = None,
    resolution: int = RESOLUTION,
    tolerance: float = TOLERANCE,
) -> StribeckPoint:
    """The separation at which film and asperities carry a load at the scene's speed; a pad moves as one rigid body.

    A journal changes its eccentricity, and loads add up as vectors. The film of the scene does not count.

    Parameters
    ----------
    pressure : the load over the nominal area, Pa.
    asperities, resolution, tolerance : as for :func:`roughfilm.rom.bearing.mixed.stribeck.stribeck`.

    Raises
    ------
    InputError
        As there.
    ConvergenceError
        If a film or the load does not come into balance.
    """
    if not 0 < pressure < float("inf"):
        raise InputError(f"load: got {pressure!r} Pa; it must be above 0 and finite")
    cpu = time.process_time()
    film = mixed_film(scene, asperities, resolution, tolerance)
    found = balanced(Speed(film=film, speed=scene.motion.speed), pressure, tolerance=tolerance)
    return replace(stribeck_point(found, film, pressure), cpu_s=time.process_time() - cpu)
