"""The models of a bearing as data: allowed grids, cost, and the factory that the models share."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, Unpack

from roughfilm.contact.foundation.deferred import deferred
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.roughness import Sinusoid
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.ladder.model import About, Applicability, Effect, Model, Resolutions

if TYPE_CHECKING:
    from roughfilm.rom.cavitation.problem import Problem

RESOLUTION_MEANING = "cells along the sliding direction, and as many across if the bearing has a width"
RESIDUAL_MEANING = "largest net flow into a node over the largest flow through a face"
SOURCES = ("10.1115/1.3251669", "10.1016/j.triboint.2007.02.021")

ISOTHERMAL_EFFECTS = frozenset(
    {
        Effect.SIDE_FLOW,
        Effect.CAVITATION,
        Effect.PRESSURE_DEPENDENCE,
        Effect.ROUGHNESS,
        Effect.DEFORMATION,
        Effect.PLASTICITY,
    }
)
"""Effects of the isothermal film that a scene needs: smooth walls, averaged roughness, or asperities that touch."""

LINE_CELLS = (64, 256, 1024, 4096)
"""Numbers of cells from coarse to fine along an infinitely wide film."""

PLANE_CELLS = (32, 64, 128, 256)
"""Numbers of cells from coarse to fine along a side of a film with a width."""

MIN_CELLS = 8
"""Smallest number of cells along a side."""

MAX_CELLS = {True: 4_000_000, False: 2048}
"""Largest number of cells along a side, for an infinitely wide film (True) and for others."""

FILMS_UNDER_LOAD = 2.0
"""CPU time on the finest grid under a load over that of a given film."""

SEARCH_S = 5e-2
"""CPU time of the search for the film under a load on the coarse grids, s."""

FREE_START_S, FREE_S, FREE_CELLS = 0.05, 0.5, 256
"""CPU times of a wall that moves freely, s: on coarse grids, and on the finest one of so many cells along the film.

Half of a symmetric width is solved, by banded elimination, whose part ``FREE_ELIMINATION_S`` grows with the fourth
power of the cells.
"""

FREE_ELIMINATION_S = 0.01

_solve = deferred("rom.bearing.solve", "solve")


def cost(scene: Bearing, cells: int, *, wide: bool, in_plane: float, oblique: float) -> float:
    """The expected CPU seconds; ``in_plane`` and ``oblique`` as in :func:`bearing_model`."""
    if isinstance(scene.geometry, MovingWall) and not (wide or scene.wide):
        halves, size = 1 if scene.geometry.symmetric else 2, (cells / FREE_CELLS) ** 2
        return FREE_START_S + halves * size * (FREE_S + FREE_ELIMINATION_S * halves * size)
    films, search = (1.0, 0.0) if scene.load is None else (FILMS_UNDER_LOAD, SEARCH_S)
    if wide or scene.wide:
        return search + films * (4e-3 + 8e-7 * cells)
    ridges = isinstance(scene.roughness, Sinusoid) and all(scene.roughness.waves)
    return search + films * (1e-2 + in_plane * (oblique if ridges else 1.0) * cells**2)


def smooth_wall_applies(scene: Bearing, *, applies: Callable[[Bearing], Applicability]) -> Applicability:
    """Whether a model without roughness applies, with the roughness that it leaves out."""
    fits = applies(scene)
    if not fits.applies or scene.roughness is None:
        return fits
    rms = scene.roughness.rms
    of = f"rms height {rms:.2g} m" if scene.load else f"rms height over film = {rms / scene.geometry.thinnest:.2g}"
    return replace(fits, reason=f"{fits.reason}; treats the wall as smooth: {of}")


def newtonian_applies(scene: Bearing, *, applies: Callable[[Bearing], Applicability]) -> Applicability:
    """Whether a model without shear thinning applies, with the law that it leaves out."""
    fits = applies(scene)
    if not fits.applies or scene.lubricant.shear_thinning is None:
        return fits
    return replace(
        fits, reason=f"{fits.reason}; treats the lubricant as Newtonian: leaves out lubricant.shear_thinning"
    )


def smooth_resolutions(scene: Bearing) -> tuple[int, ...]:
    """The numbers of cells from coarse to fine for a smooth wall."""
    return LINE_CELLS if scene.wide else PLANE_CELLS


def incompressible_film(scene: Bearing) -> "Problem":
    """The problem of the smooth film of a lubricant that pressure does not change."""
    from roughfilm.rom.cavitation.problem import unchanging  # slow to import

    return unchanging(scene.problem())


def bearing_model(
    *,
    applies: Callable[[Bearing], Applicability],
    film: Callable[[Bearing], "Problem"] = Bearing.problem,
    resolutions: Callable[[Bearing], tuple[int, ...]] = smooth_resolutions,
    ruptures: bool = True,
    solve: Callable[..., Any] = _solve,
    searched: Callable[[Bearing], Any] | None = None,
    wide: bool = False,
    in_plane: float = 2e-6,
    oblique: float = 1.0,
    **about: Unpack[About],
) -> Model[Bearing]:
    """A model of a bearing.

    Parameters
    ----------
    applies : applies(scene), whether the model applies.
    film : film(scene), the problem that the model solves.
    resolutions : numbers of cells from coarse to fine, the finest of which is the default.
    ruptures : whether the film cavitates.
    solve : the solver, as :func:`roughfilm.rom.bearing.solve.solve`.
    searched : searched(scene), the films among which that under a load is sought; None for a smooth wall.
    wide : whether the model solves a single line of any film.
    in_plane : expected CPU seconds for each cell of a film with a width.
    oblique : factor of ``in_plane`` for ridges that run neither along nor across the sliding.
    about : name, summary, effects and sources of the model.
    """

    def offered(scene: Bearing) -> Resolutions:
        series = LINE_CELLS if wide else resolutions(scene)
        return Resolutions(least=MIN_CELLS, most=MAX_CELLS[wide or scene.wide], default=series[-1], series=series)

    if Effect.ROUGHNESS not in about["keeps"]:
        applies = partial(smooth_wall_applies, applies=applies)
    if Effect.SHEAR_THINNING not in about["keeps"]:
        applies = partial(newtonian_applies, applies=applies)
    return Model(
        **about,
        kind="bearing",
        resolutions=offered,
        resolution_meaning=RESOLUTION_MEANING,
        residual_meaning=RESIDUAL_MEANING,
        order=2,
        tolerance=RESIDUAL_TOLERANCE,
        cost=partial(cost, wide=wide, in_plane=in_plane, oblique=oblique),
        applies=applies,
        compute=partial(solve, film=film, ruptures=ruptures, searched=searched),
    )
