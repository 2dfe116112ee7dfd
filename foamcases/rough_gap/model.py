"""The cases of a rough gap in OpenFOAM as data: their resolutions and cost, and how they are written, run and read."""

from functools import partial

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.foamcases.openfoam.model import Cases
from roughfilm.rom.ladder.model import Resolutions
from roughfilm.rom.parts.pressed_surface import MIN_SIDE_POINTS
from roughfilm.rom.rough_gap.scene import RoughGap

SOURCES = ("10.1063/1.168744", "10.1080/01495728408961817")
RESOLUTIONS = (16, 32, 64)
"""Numbers of columns along the longer side; the last is the default."""

TOLERANCE = 1e-5
"""Default tolerance: the remaining relative change of a flow, or the residual, at which a run ends."""


def resolutions(scene: RoughGap) -> Resolutions:
    """The resolutions of a scene: the entries of ``RESOLUTIONS`` up to the points along the surface's longer side.

    If the surface has fewer points than the least entry, the only resolution of the series is their number.
    """
    own = max(scene.surface().shape)
    series = tuple(n for n in RESOLUTIONS if n <= own) or (own,)
    return Resolutions(least=min(own, MIN_SIDE_POINTS), most=own, default=min(own, RESOLUTIONS[-1]), series=series)


def most_processes(scene: RoughGap, resolution: int) -> int:
    """The largest number of processes: one for every two columns of the mesh, and at least 1."""
    from roughfilm.foamcases.rough_gap.case import columns_of  # slow to import

    nx, ny = columns_of(scene, resolution)
    return max(1, nx * ny // 2)


def cost(scene: RoughGap, resolution: int) -> float:
    """Expected CPU seconds of all three drives, 2 + 3 · 6e-6 s · cells · layers, measured with 8 to 128 columns.

    The number of iterations is about four times the number of layers, and up to twice as large between walls whose
    period is as short as the gap is high.
    """
    from roughfilm.foamcases.rough_gap.case import layers_of  # slow to import

    nx, ny = scene.surface().shape
    layers = layers_of(scene, resolution)
    cells = resolution**2 * min(nx, ny) / max(nx, ny) * layers
    return float(2 + 3 * 6e-6 * cells * layers)


CASES = Cases(
    kind="rough_gap",
    resolutions=resolutions,
    resolution_meaning="mesh columns along the longer side, by default with a quarter as many layers across",
    residual_meaning="largest part of a flow by which iterating on would change it, by what a new process does to it",
    tolerance=TOLERANCE,
    most_processes=most_processes,
    cost=cost,
    write=deferred("foamcases.rough_gap.case", "write_gap_case"),
    write_to_run=partial(deferred("foamcases.rough_gap.case", "write_gap_case"), run=True),
    run=deferred("foamcases.rough_gap.run", "run_gap"),
    kept_run=deferred("foamcases.rough_gap.run", "kept_run"),
    read=deferred("foamcases.rough_gap.cases", "read"),
)
