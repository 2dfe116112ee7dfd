"""Leakage by flow factors: through roughness that goes on and on."""

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.rom.ladder.model import Effect
from roughfilm.rom.seal.leakage.passage import Passage
from roughfilm.rom.seal.model import seal_model
from roughfilm.rom.seal.scene import Seal


def flow(found: Contact, scene: Seal) -> Passage:
    """From the cell."""
    from roughfilm.rom.seal.leakage.homogenized import homogenized_leakage  # numba is slow to import

    leakage = homogenized_leakage(found.gap, found.spacing)
    return (leakage.along, leakage.across)[scene.axis]


MODEL = seal_model(
    name="homogenized_leakage",
    summary="the surface pressed, and the flow through its gap averaged as if its period were infinitely short",
    keeps=frozenset({Effect.DEFORMATION, Effect.PLASTICITY, Effect.ROUGHNESS}),
    sources=("10.1016/S0043-1648(99)00113-1", "10.1016/j.triboint.2006.02.069"),
    words="averages over infinitely many periods: what does not come out where it went in is sealed",
    flow=flow,
)
