"""The models of a bearing as data: their resolutions and cost, and what each solves and reads off its film."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Unpack

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.deferred import deferred
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.ladder.model import About, Applicability, Effect, Model, Resolutions

if TYPE_CHECKING:
    from roughfilm.rom.cavitation.problem import Problem
    from roughfilm.rom.cavitation.solve import Solution

RESOLUTION_MEANING = "cells along the sliding, and as many across where the bearing has a width"
RESIDUAL_MEANING = "largest net flow into a node over the largest flow through a face"
WIDE, PLANE = (64, 256, 1024, 4096), (32, 64, 128, 256)
"""Cells, for infinitely wide bearings and for others."""

LEAST, MOST = 8, {True: 4_000_000, False: 2048}

RESOLVED = 8
"""Cells that a wave or a pocket needs for its load to be within a few per cent."""

SOURCES = ("10.1115/1.3251669", "10.1016/j.triboint.2007.02.021")

Values = dict[str, tuple[Array, str]]
"""Fields over the grid, shape (nx, ny), with their units."""

_bearing_quantities = deferred("rom.bearing.quantities", "bearing_quantities")


def _film_alone(scene: Bearing, _found: "Solution", quantities: Mapping[str, Quantity]) -> dict[str, float]:
    doubt = 0.0 if scene.roughness is None else scene.roughness.doubt(scene.geometry.film)
    return {name: abs(quantity.value) * doubt for name, quantity in quantities.items()}


@dataclass(frozen=True, kw_only=True)
class Reading:
    """What is read off a film in balance.

    Attributes
    ----------
    quantities : quantities(scene, solution).
    doubt : doubt(scene, solution, quantities): by how much each may be off as factors are, in its unit.
    fields : fields(scene, solution), beside those that every film has.
    """

    quantities: Callable[[Bearing, "Solution"], dict[str, Quantity]] = _bearing_quantities
    doubt: Callable[[Bearing, "Solution", Mapping[str, Quantity]], Mapping[str, float]] = _film_alone
    fields: Callable[[Bearing, "Solution"], Values] = lambda _scene, _found: {}


def cost(scene: Bearing, cells: int, *, wide: bool, in_plane: float) -> float:
    """Expected CPU seconds; ``in_plane`` for each cell of a film with a width."""
    return 4e-3 + 8e-7 * cells if wide or scene.wide else 1e-2 + in_plane * cells**2


def roughness_left_out(scene: Bearing, *, told: Callable[[Bearing], Applicability]) -> Applicability:
    """What a rung says of itself, and how rough the wall is that it takes for smooth."""
    fits = told(scene)
    if not fits.applies or scene.roughness is None:
        return fits
    part = scene.roughness.rms / scene.geometry.film
    return replace(fits, reason=f"{fits.reason}; takes the wall for smooth: rms height over film = {part:.2g}")


def smooth_resolutions(scene: Bearing) -> tuple[int, ...]:
    """Cells from coarse to fine, for a wall without roughness."""
    return WIDE if scene.wide else PLANE


def line_resolutions(scene: Bearing) -> tuple[int, ...]:  # noqa: ARG001
    """The same where one line is all that is solved."""
    return WIDE


def unchanging_film(scene: Bearing) -> "Problem":
    """The smooth film of a lubricant that pressure does not change."""
    from roughfilm.rom.cavitation.problem import unchanging  # slow to import

    return unchanging(scene.problem())


def bearing_model(
    *,
    applies: Callable[[Bearing], Applicability],
    film: Callable[[Bearing], "Problem"] = Bearing.problem,
    resolutions: Callable[[Bearing], tuple[int, ...]] = smooth_resolutions,
    ruptures: bool = True,
    reading: Reading = Reading(),
    wide: bool = False,
    in_plane: float = 2e-6,
    **about: Unpack[About],
) -> Model[Bearing]:
    """A model of a bearing: ``film`` gives the equations that it solves; one that is ``wide`` solves a single line.

    ``resolutions`` go from coarse to fine; the finest is the default. ``in_plane``: expected CPU seconds for each cell
    of a film with a width. ``reading``: the quantities and fields that it reads off the film.
    """

    def offered(scene: Bearing) -> Resolutions:
        series = resolutions(scene)
        return Resolutions(least=LEAST, most=MOST[wide or scene.wide], default=series[-1], series=series)

    if Effect.ROUGHNESS not in about["keeps"]:
        applies = partial(roughness_left_out, told=applies)
    return Model(
        **about,
        kind="bearing",
        resolutions=offered,
        resolution_meaning=RESOLUTION_MEANING,
        residual_meaning=RESIDUAL_MEANING,
        order=2,
        tolerance=RESIDUAL_TOLERANCE,
        cost=partial(cost, wide=wide, in_plane=in_plane),
        applies=applies,
        compute=partial(deferred("rom.bearing.solve", "solve"), film=film, ruptures=ruptures, reading=reading),
    )
