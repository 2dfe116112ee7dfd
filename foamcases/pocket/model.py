"""The cases of a pocket in OpenFOAM as data: their resolutions and cost, and how they are written, run and read."""

from functools import partial

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.foamcases.openfoam.model import Cases
from roughfilm.rom.ladder.model import Resolutions
from roughfilm.rom.pocket.scene import Pocket

SOURCES = ("10.1115/1.1828067", "10.1063/1.168744", "10.1080/01495728408961817")
RESOLUTIONS = Resolutions(least=12, most=4000, default=240, series=(30, 60, 120, 240))


def cost(_scene: Pocket, resolution: int) -> float:
    """Expected CPU seconds of one run, 0.3 + 2.4 (resolution / 240)^2.4, measured with 60 to 480 columns."""
    return float(0.3 + 2.4 * (resolution / 240) ** 2.4)


CASES = Cases(
    kind="pocket",
    resolutions=RESOLUTIONS,
    resolution_meaning="mesh columns along the film, with a fifth as many layers across",
    residual_meaning="largest initial residual of velocity and pressure that a new process finds in the fields on disk",
    tolerance=1e-7,
    most_processes=lambda _scene, resolution: resolution // 2,
    cost=cost,
    write=deferred("foamcases.pocket.case", "write_case"),
    write_to_run=partial(deferred("foamcases.pocket.case", "write_case"), run=True),
    run=deferred("foamcases.pocket.run", "run_case"),
    kept_run=deferred("foamcases.pocket.run", "kept_run"),
    read=deferred("foamcases.pocket.cases", "read"),
)
