"""Leakage by flow factors of periodic roughness."""

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.rom.ladder.model import Effect
from roughfilm.rom.seal.leakage.passage import Passage
from roughfilm.rom.seal.model import seal_model
from roughfilm.rom.seal.scene import Seal


def flow(contact: Contact, scene: Seal) -> Passage:
    """The flow from the cell problem."""
    from roughfilm.rom.seal.leakage.homogenized import homogenized_leakage  # numba is slow to import

    leakage = homogenized_leakage(contact.gap, contact.spacing)
    return (leakage.along, leakage.across)[scene.axis]


MODEL = seal_model(
    name="homogenized_leakage",
    summary="contact of the surface, and flow factors of its gap for an infinitely short period",
    keeps=frozenset({Effect.DEFORMATION, Effect.PLASTICITY, Effect.ROUGHNESS}),
    sources=("10.1016/S0043-1648(99)00113-1", "10.1016/j.triboint.2006.02.069"),
    words="averages over infinitely many periods: a path that does not close on itself is sealed",
    flow=flow,
)
