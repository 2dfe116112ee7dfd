"""The Reynolds equation with cavitation, for any law of compressibility and viscosity."""

from roughfilm.rom.bearing.model import SOURCES, bearing_model
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Applicability, Effect


def applies(scene: Bearing) -> Applicability:  # noqa: ARG001
    """Always, with the effects that are left out."""
    return Applicability(applies=True, reason="leaves out inertia, heat and deformation")


MODEL = bearing_model(
    name="reynolds_cavitating",
    summary="adds cavitation, for any compressibility",
    keeps=frozenset({Effect.SIDE_FLOW, Effect.CAVITATION, Effect.PRESSURE_DEPENDENCE}),
    sources=SOURCES,
    applies=applies,
)
