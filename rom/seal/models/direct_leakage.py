"""Leakage by direct simulation: through all periods of the seal's length between two reservoirs."""

from dataclasses import replace

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.rom.ladder.model import Effect
from roughfilm.rom.seal.leakage.passage import Passage
from roughfilm.rom.seal.model import seal_model
from roughfilm.rom.seal.scene import Seal

MOST_NODES = 4_000_000
"""Of all periods together."""


def flow(found: Contact, scene: Seal) -> Passage:
    """Between the ends of the seal; the corrector is that of a period in its middle."""
    from roughfilm.rom.seal.leakage.direct import direct_flow  # numba is slow to import

    count, nodes = periods(scene, found.gap.size), found.gap.shape[scene.axis]
    passage = direct_flow(found.gap, found.spacing, scene.axis, periods=count)
    first = count // 2 * nodes
    return replace(passage, corrector=passage.corrector.take(range(first, first + nodes), axis=scene.axis))


def periods(scene: Seal, nodes: int) -> int:
    """How many of the surface's periods, of so many nodes, the seal is long, at least one; as many as are taken."""
    surface = scene.surface()
    side = surface.shape[scene.axis] * surface.spacing[scene.axis]
    return max(1, min(round(scene.flow.length / side), MOST_NODES // nodes))


def repeats(scene: Seal) -> int:
    """The periods of the surface on its own nodes."""
    return periods(scene, scene.surface().heights.size)


MODEL = seal_model(
    name="direct_leakage",
    summary="the surface pressed, and the flow solved between two reservoirs through the periods of the seal's length",
    keeps=frozenset({Effect.DEFORMATION, Effect.PLASTICITY, Effect.ROUGHNESS, Effect.FINITE_WAVES}),
    sources=("10.1016/S0043-1648(99)00113-1",),
    words=f"every wave as long as it is, over the seal's length; at most {MOST_NODES:.0e} nodes",
    flow=flow,
    repeats=repeats,
)
