"""The Reynolds equation of a bearing: an incompressible liquid that bears any tension."""

from roughfilm.rom.bearing.model import bearing_model, unchanging_film
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability, Effect


def applies(scene: Bearing) -> Applicability:
    """Wherever the inlet is full; says what is left out."""
    theta = scene.boundary.inlet.theta
    if theta is not None and theta < 1:
        return Applicability(applies=False, reason=f"the inlet is starved (theta = {theta:g}), which it cannot know")
    told = f"leaves out cavitation: pressures reach about {scene.pressure_unit:.3g} Pa, below ambient too"
    return Applicability(applies=True, reason=told + "; right only where the film nowhere widens")


MODEL = bearing_model(
    name="reynolds",
    summary="Reynolds equation, incompressible, without cavitation: the plainest film",
    keeps=frozenset({Effect.SIDE_FLOW}),
    sources=("10.1098/rstl.1886.0005",),
    applies=applies,
    film=unchanging_film,
    ruptures=False,
)
