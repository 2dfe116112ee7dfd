"""The film under a given load: how far apart film and asperities together hold the walls."""

from rom.bearing import Bearing
from rom.ladder import Progress, silent
from rom.mixed.asperities import Asperities
from rom.mixed.stribeck import StribeckPoint


def equilibrium(
    scene: Bearing,
    pressure: float,
    *,
    asperities: Asperities | None = None,
    resolution: int = 64,
    tolerance: float = 1e-6,
    progress: Progress = silent,
) -> StribeckPoint:
    """The separation at which film and asperities carry a load, at the scene's speed."""
    raise NotImplementedError
