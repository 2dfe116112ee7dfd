"""The models of a pocket as data: their resolutions, tolerances and cost, and their solvers."""

from collections.abc import Callable
from typing import Unpack

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.ladder.model import About, Applicability, Model, Progress, Resolutions
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.pocket.plan.geometry import PlanGeometry
from roughfilm.rom.pocket.pressure import NODES
from roughfilm.rom.pocket.scene import Pocket

DEFAULT_CELLS = 400
"""Default number of cells along the film."""

CELL_SERIES = (50, 100, 200, 400)
"""Numbers of cells of a convergence study."""

MIN_CELLS = 12
"""Smallest number of cells along the film."""

MAX_CELLS = 4000
"""Largest number of cells along the film."""

FILM_RESIDUAL_TOLERANCE = 1e-11
"""Default tolerance of the residual."""

SCHEMES = ("linear_upwind", "upwind")
"""Advection schemes, the default first."""

FILM_PLAN_COLUMNS = Resolutions(least=16, most=256, default=64, series=(32, 64, 128))
"""Numbers of columns along a cell in plan of the thin-film equations."""

FILM_RESOLUTION_MEANING = "cells along the film, each with 10 polynomials across it"
FILM_RESIDUAL_MEANING = "largest imbalance of momentum in a cell, relative to the largest force in one"

NODE_SERIES = (2, 3, 4, 6, 8, 12, 16, 24)
"""Numbers of Gauss points of a convergence study."""

MIN_NODES = 2
"""Smallest number of Gauss points."""

MAX_NODES = 768
"""Largest number of Gauss points."""

QUADRATURE_RESIDUAL_TOLERANCE = 1e-7
"""Default tolerance of the residual."""

CAVITATING_CELLS = (64, 256, 1024)
"""Numbers of cells from coarse to fine along a film that may rupture, the last one by default."""

CAVITATING_RANGE = (8, 1_000_000)
"""Smallest and largest number of cells along a film that may rupture."""

CAVITATING_RESOLUTION_MEANING = "cells along the film"
CAVITATING_RESIDUAL_MEANING = "largest net flow into a node over the largest flow through a face"

QUADRATURE_RESOLUTION_MEANING = "Gauss points on each smooth piece of the gap"
QUADRATURE_RESIDUAL_MEANING = "mean mismatch of dp/dx between the nodes, relative to its mean size"
PLAN_RESIDUAL_MEANING = "in plan, largest net flow out of a column over the largest flow through a face"


PLAN_COLUMNS = Resolutions(least=8, most=512, default=64, series=(16, 32, 64, 128))
"""Numbers of columns along a cell in plan."""

PLAN_RESOLUTION_MEANING = "in plan, columns along the cell, and as many across per length"


def in_plan_or_not(grooves: Resolutions, plan: Resolutions = PLAN_COLUMNS) -> Callable[[Pocket], Resolutions]:
    """The resolutions of a model, for scenes with grooves and for cells in plan."""
    return lambda scene: plan if scene.in_plan else grooves


def computed(*, grooves: str, plan: str) -> Callable[..., Result]:
    """The solver of a model: the function ``solve`` of a module for grooves, and that of another for cells in plan."""
    of_grooves, of_plan = deferred(grooves, "solve"), deferred(plan, "solve")

    def compute(solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress) -> Result:
        result: Result = (of_plan if scene.in_plan else of_grooves)(solver, scene, request, progress)
        return result

    return compute


def film_cost(scene: Pocket, resolution: int) -> float:
    """Expected CPU seconds of the thin-film equations."""
    if not scene.in_plan:
        return 2.5e-3 + 5.7e-5 * resolution
    plan = scene.plan()
    return float(1.6e-4 * resolution**2 * plan.breadth / plan.length)


def film_model(*, applies: Callable[[Pocket], Applicability], **about: Unpack[About]) -> Model[Pocket]:
    """A model that solves the thin-film equations.

    The cost was measured for 50 to 800 cells over grooves, and for 32 to 128 columns of square cells in plan.
    """
    grooves = Resolutions(least=MIN_CELLS, most=MAX_CELLS, default=DEFAULT_CELLS, series=CELL_SERIES)
    return Model(
        **about,
        kind="pocket",
        resolutions=in_plan_or_not(grooves, FILM_PLAN_COLUMNS),
        resolution_meaning=f"{FILM_RESOLUTION_MEANING}; {PLAN_RESOLUTION_MEANING}",
        residual_meaning=FILM_RESIDUAL_MEANING,
        order=2,
        tolerance=FILM_RESIDUAL_TOLERANCE,
        tolerances=(1e-14, 1.0),
        schemes=SCHEMES,
        cost=film_cost,
        applies=applies,
        compute=computed(grooves="rom.pocket.solve", plan="rom.pocket.plan.film.solve"),
    )


def quadrature_cost(scene: Pocket, resolution: int) -> float:
    """The expected CPU time of the quadrature over grooves, and of finite volumes in plan with 32 to 256 columns, s."""
    if isinstance(scene.geometry, PlanGeometry):
        return 3e-3 + 3e-6 * resolution**2 * scene.geometry.breadth / scene.geometry.length
    return 2e-4 + 1e-7 * resolution**2


def quadrature_model(*, applies: Callable[[Pocket], Applicability], **about: Unpack[About]) -> Model[Pocket]:
    """A model of the Reynolds equation: quadrature over grooves, finite volumes in plan.

    The cost is that of the default rule (a half circle takes seconds).
    """
    return Model(
        **about,
        kind="pocket",
        resolutions=in_plan_or_not(Resolutions(least=MIN_NODES, most=MAX_NODES, default=NODES, series=NODE_SERIES)),
        resolution_meaning=f"{QUADRATURE_RESOLUTION_MEANING}; {PLAN_RESOLUTION_MEANING}",
        residual_meaning=f"{QUADRATURE_RESIDUAL_MEANING}; {PLAN_RESIDUAL_MEANING}",
        order=lambda scene: 2 if scene.in_plan else None,
        tolerance=QUADRATURE_RESIDUAL_TOLERANCE,
        tolerances=(1e-300, 1.0),
        cost=quadrature_cost,
        applies=applies,
        compute=computed(grooves="rom.pocket.quadrature", plan="rom.pocket.in_plan"),
    )


def cavitating_model(*, applies: Callable[[Pocket], Applicability], **about: Unpack[About]) -> Model[Pocket]:
    """A model whose film ruptures at the cavitation pressure; the cost was measured for 256 to 4096 cells.

    Cells in plan were measured with 32 to 128 columns.
    """
    least, most = CAVITATING_RANGE
    grooves = Resolutions(least=least, most=most, default=CAVITATING_CELLS[-1], series=CAVITATING_CELLS)
    return Model(
        **about,
        kind="pocket",
        resolutions=in_plan_or_not(grooves),
        resolution_meaning=f"{CAVITATING_RESOLUTION_MEANING}; {PLAN_RESOLUTION_MEANING}",
        residual_meaning=CAVITATING_RESIDUAL_MEANING,
        order=2,
        tolerance=RESIDUAL_TOLERANCE,
        cost=lambda scene, resolution: 5e-2 + 2.5e-5 * resolution**2 if scene.in_plan else 5e-3 + 2e-6 * resolution,
        applies=applies,
        compute=deferred("rom.pocket.cavitating.solve", "solve"),
    )
