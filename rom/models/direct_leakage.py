"""Leakage by direct simulation: through one period between two reservoirs."""

from contact.mechanics.contact import Contact
from rom.ladder import Effect
from rom.leakage.passage import Passage
from rom.seal_rung import seal_model


def flow(found: Contact, axis: int) -> Passage:
    """Between the ends of the period."""
    from rom.leakage.direct import direct_flow  # numba is slow to import

    return direct_flow(found.gap, found.spacing, axis)


MODEL = seal_model(
    name="direct_leakage",
    summary="the surface pressed, and the flow through one period of its gap solved between two reservoirs",
    keeps=frozenset({Effect.DEFORMATION, Effect.PLASTICITY, Effect.ROUGHNESS, Effect.FINITE_WAVES}),
    sources=("10.1016/S0043-1648(99)00113-1",),
    words="every wave as long as it is; one period stands for the length of the seal",
    flow=flow,
)
