"""Leakage by direct simulation of all periods of the seal's length between two reservoirs."""

from dataclasses import replace

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.rom.ladder.model import Effect
from roughfilm.rom.seal.leakage.passage import Passage
from roughfilm.rom.seal.model import seal_model
from roughfilm.rom.seal.scene import Seal

MAX_NODES = 4_000_000
"""Largest number of nodes of all periods together."""


def flow(contact: Contact, scene: Seal) -> Passage:
    """The flow between the ends of the seal, with the corrector of a period in its middle."""
    from roughfilm.rom.seal.leakage.direct import direct_flow  # numba is slow to import

    count, nodes = periods(scene, contact.gap.size), contact.gap.shape[scene.axis]
    passage = direct_flow(contact.gap, contact.spacing, scene.axis, periods=count)
    first = count // 2 * nodes
    return replace(passage, corrector=passage.corrector.take(range(first, first + nodes), axis=scene.axis))


def periods(scene: Seal, nodes: int) -> int:
    """The number of periods of the surface, each of some nodes, in the length of the seal, limited by ``MAX_NODES``."""
    surface = scene.surface()
    side = surface.shape[scene.axis] * surface.spacing[scene.axis]
    return max(1, min(round(scene.flow.length / side), MAX_NODES // nodes))


def repeats(scene: Seal) -> int:
    """The number of periods on the surface's own nodes."""
    return periods(scene, scene.surface().heights.size)


MODEL = seal_model(
    name="direct_leakage",
    summary="contact of the surface, and flow between two reservoirs through all periods of the seal's length",
    keeps=frozenset({Effect.DEFORMATION, Effect.PLASTICITY, Effect.ROUGHNESS, Effect.FINITE_WAVES}),
    sources=("10.1016/S0043-1648(99)00113-1",),
    words=f"keeps every wave at its length, over the seal's length; at most {MAX_NODES:.0e} nodes",
    flow=flow,
    repeats=repeats,
)
