"""The cases of a pocket in OpenFOAM as data: their resolutions and cost, and how they are written, run and read."""

from pathlib import Path

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.model import Cases, CaseWriter
from roughfilm.foamcases.pocket.card import layers_of
from roughfilm.rom.ladder.model import Resolutions
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.pocket.model import in_plan_or_not
from roughfilm.rom.pocket.scene import Pocket

SOURCES = ("10.1115/1.1828067", "10.1063/1.168744", "10.1080/01495728408961817")
GROOVE_COLUMNS = Resolutions(least=12, most=4000, default=240, series=(30, 60, 120, 240))
PLAN_COLUMNS = Resolutions(least=12, most=400, default=80, series=(20, 40, 80))


def cost(scene: Pocket, resolution: int) -> float:
    """Expected CPU seconds of one run.

    They are 0.3 + 2.4 (resolution / 240)^2.4 for grooves, measured with 60 to 480 columns. In plan they are
    0.4 + 1.25e-5 · cells · layers for the flow, with the cells of half a cell in plan if it is symmetric, and
    1.6e-5 · columns^1.35 for the mesh, measured with 24 to 144 columns of square cells.
    """
    if not scene.in_plan:
        return float(0.3 + 2.4 * (resolution / 240) ** 2.4)
    plan, layers = scene.plan(), layers_of(resolution)
    columns = resolution**2 * plan.breadth / plan.length
    solved = columns / (2 if plan.mirrored else 1)
    return float(0.4 + 1.25e-5 * solved * layers**2 + 1.6e-5 * columns**1.35)


def _writer(*, run: bool) -> CaseWriter[Pocket]:
    """The function that writes the case of a scene with grooves or in plan; ``run`` as in both."""
    grooves, plan = (deferred(f"foamcases.pocket.{place}case", "write_case") for place in ("", "plan."))

    def write(
        scene: Pocket, directory: Path, request: CheckedRequest, reynolds_number: float, dialect: Dialect
    ) -> None:
        (plan if scene.in_plan else grooves)(scene, directory, request, reynolds_number, dialect, run=run)

    return write


CASES = Cases(
    kind="pocket",
    resolutions=in_plan_or_not(GROOVE_COLUMNS, PLAN_COLUMNS),
    resolution_meaning="mesh columns along the film, with a fifth as many layers across",
    residual_meaning="largest initial residual of velocity and pressure that a new process finds in the fields on disk",
    tolerance=1e-7,
    most_processes=lambda _scene, resolution: resolution // 2,
    cost=cost,
    write=_writer(run=False),
    write_to_run=_writer(run=True),
    run=deferred("foamcases.pocket.run", "run_case"),
    kept_run=deferred("foamcases.pocket.run", "kept_run"),
    read=deferred("foamcases.pocket.cases", "read"),
)
