"""The models of infinitely wide pads with inertia as data: their resolutions, cost and solver."""

from typing import Unpack

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.wide_pad.gap import thin_film_obstacle
from roughfilm.rom.ladder.model import About, Applicability, Model, Resolutions

DEFAULT_CELLS = 400
"""Default number of cells along a film without short features."""

CELLS_OF_FEATURE = 16
"""Number of cells over the shortest feature of the wall at the default resolution, if it is far from the others."""

MIN_CELLS = 24
"""Smallest number of cells along the film."""

MAX_CELLS = 8000
"""Largest number of cells along the film."""

RESIDUAL_TOLERANCE = 1e-7
"""Default tolerance of the residual; in pads of 5 to 20 pockets it changes load and friction by less than 1e-8."""


def resolutions(scene: Bearing) -> Resolutions:
    """The allowed and default numbers of cells: at least ``CELLS_OF_FEATURE`` for the shortest feature of the wall."""
    features = scene.geometry.length / scene.geometry.film_shape().finest[0]
    default = min(max(DEFAULT_CELLS, 8 * round(CELLS_OF_FEATURE * features / 8)), MAX_CELLS)
    return Resolutions(
        least=MIN_CELLS, most=MAX_CELLS, default=default, series=tuple(default // part for part in (8, 4, 2, 1))
    )


def wide_pad_model(*, left_out: str, **about: Unpack[About]) -> Model[Bearing]:
    """A model that solves the thin-film Navier-Stokes equations; the cost was measured for 50 to 3200 cells.

    Parameters
    ----------
    left_out : the effects that the model keeps and leaves out, in words.
    about : name, summary, effects and sources of the model.
    """

    def applies(scene: Bearing) -> Applicability:
        obstacle = thin_film_obstacle(scene)
        return Applicability(applies=obstacle is None, reason=obstacle or left_out)

    return Model(
        **about,
        kind="bearing",
        resolutions=resolutions,
        resolution_meaning="cells along the film",
        residual_meaning="largest imbalance of momentum in a cell, relative to the largest force in one",
        order=2,
        tolerance=RESIDUAL_TOLERANCE,
        tolerances=(1e-14, 1.0),
        cost=lambda _scene, cells: 5e-3 + 1.2e-4 * cells,
        applies=applies,
        compute=deferred("rom.bearing.wide_pad.solve", "solve"),
    )
