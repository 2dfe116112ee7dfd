"""The cases of an infinitely wide pad in OpenFOAM as data: their resolutions and cost, and the scenes they apply to."""

from functools import partial

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.foamcases.bearing.mesh import (
    DEFAULT_COLUMNS,
    DEFAULT_LAYERS,
    MOST_COLUMNS,
    default_columns,
    layers_of,
    step_obstacle,
)
from roughfilm.foamcases.openfoam.model import Cases
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.wide_pad.gap import film_obstacle
from roughfilm.rom.ladder.model import Applicability, Resolutions

SOURCES = ("10.1063/1.168744", "10.1080/01495728408961817", "10.1243/13506501JET433")


def resolutions(scene: Bearing) -> Resolutions:
    """The allowed and default numbers of columns."""
    default = default_columns(scene)
    return Resolutions(
        least=12, most=MOST_COLUMNS, default=default, series=tuple(default // part for part in (8, 4, 2, 1))
    )


def cost(scene: Bearing, resolution: int) -> float:
    """Expected CPU seconds of one run: 0.35 + 2.7 (columns/240) (layers/48)^1.7, measured with 60 to 720 columns.

    Strong inertia takes more iterations: twice as many at Re h/L = 4, and eight times as many at 30.
    """
    columns, layers = resolution / DEFAULT_COLUMNS, layers_of(scene, resolution) / DEFAULT_LAYERS
    return float(0.35 + 2.7 * columns * layers**1.7)


def pad_applies(scene: Bearing, *, left_out: str) -> Applicability:
    """Whether a case can be written for a scene, with the reason, or the effects that are left out."""
    obstacle = film_obstacle(scene) or step_obstacle(scene)
    return Applicability(applies=obstacle is None, reason=obstacle or left_out)


CASES = Cases(
    kind="bearing",
    resolutions=resolutions,
    resolution_meaning="mesh columns along the film, with layers in proportion, 48 at the default",
    residual_meaning="largest initial residual of velocity and pressure that a new process finds in the fields on disk",
    tolerance=1e-7,
    most_processes=lambda _scene, resolution: resolution // 2,
    cost=cost,
    write=deferred("foamcases.bearing.case", "write_pad_case"),
    write_to_run=partial(deferred("foamcases.bearing.case", "write_pad_case"), run=True),
    run=deferred("foamcases.bearing.run", "run_pad"),
    kept_run=deferred("foamcases.bearing.run", "kept_run"),
    read=deferred("foamcases.bearing.cases", "read"),
)
