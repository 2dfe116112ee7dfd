"""The Reynolds equation of an incompressible liquid without cavitation."""

from roughfilm.rom.bearing.model import bearing_model, incompressible_film
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability, Effect


def applies(scene: Bearing) -> Applicability:
    """Whether the inlet is flooded, with the pressure scale."""
    theta = scene.boundary.inlet.theta
    if theta is not None and theta < 1:
        return Applicability(
            applies=False, reason=f"the inlet is starved (theta = {theta:g}), which needs a model with cavitation"
        )
    load = scene.load_pressure
    pressures = f"of {load:.3g} Pa in the mean" if load else f"of up to about {scene.pressure_unit:.3g} Pa"
    return Applicability(
        applies=True,
        reason=f"leaves out cavitation: pressures {pressures}, also below ambient; valid only if the film nowhere "
        "widens",
    )


MODEL = bearing_model(
    name="reynolds",
    summary="Reynolds equation without cavitation",
    keeps=frozenset({Effect.SIDE_FLOW}),
    sources=("10.1098/rstl.1886.0005",),
    applies=applies,
    film=incompressible_film,
    ruptures=False,
)
