"""The models of a pocket as data: their resolutions, tolerances and cost, and their solvers."""

from collections.abc import Callable
from typing import Unpack

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.ladder.model import About, Applicability, Model, Resolutions
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


def film_model(*, applies: Callable[[Pocket], Applicability], **about: Unpack[About]) -> Model[Pocket]:
    """A model that solves the thin-film equations; the cost was measured for 50 to 800 cells."""
    return Model(
        **about,
        kind="pocket",
        resolutions=Resolutions(least=MIN_CELLS, most=MAX_CELLS, default=DEFAULT_CELLS, series=CELL_SERIES),
        resolution_meaning=FILM_RESOLUTION_MEANING,
        residual_meaning=FILM_RESIDUAL_MEANING,
        order=2,
        tolerance=FILM_RESIDUAL_TOLERANCE,
        tolerances=(1e-14, 1.0),
        schemes=SCHEMES,
        cost=lambda _scene, resolution: 2.5e-3 + 5.7e-5 * resolution,
        applies=applies,
        compute=deferred("rom.pocket.solve", "solve"),
    )


def quadrature_model(*, applies: Callable[[Pocket], Applicability], **about: Unpack[About]) -> Model[Pocket]:
    """A model that uses quadrature; the cost is that of the default rule (a half circle takes seconds)."""
    return Model(
        **about,
        kind="pocket",
        resolutions=Resolutions(least=MIN_NODES, most=MAX_NODES, default=NODES, series=NODE_SERIES),
        resolution_meaning=QUADRATURE_RESOLUTION_MEANING,
        residual_meaning=QUADRATURE_RESIDUAL_MEANING,
        order=None,
        tolerance=QUADRATURE_RESIDUAL_TOLERANCE,
        tolerances=(1e-300, 1.0),
        cost=lambda _scene, resolution: 2e-4 + 1e-7 * resolution**2,
        applies=applies,
        compute=deferred("rom.pocket.quadrature", "solve"),
    )


def cavitating_model(*, applies: Callable[[Pocket], Applicability], **about: Unpack[About]) -> Model[Pocket]:
    """A model whose film ruptures at the cavitation pressure; the cost was measured for 256 to 4096 cells."""
    least, most = CAVITATING_RANGE
    return Model(
        **about,
        kind="pocket",
        resolutions=Resolutions(least=least, most=most, default=CAVITATING_CELLS[-1], series=CAVITATING_CELLS),
        resolution_meaning=CAVITATING_RESOLUTION_MEANING,
        residual_meaning=CAVITATING_RESIDUAL_MEANING,
        order=2,
        tolerance=RESIDUAL_TOLERANCE,
        cost=lambda _scene, resolution: 5e-3 + 2e-6 * resolution,
        applies=applies,
        compute=deferred("rom.pocket.cavitating.solve", "solve"),
    )
