"""The near-orthogonal mesh of a gap: columns meet both walls at right angles, and layers cross them at right angles.

1. The coordinate ξ solves Laplace's equation in the gap and rises by 1 over the period (:mod:`.laplace`). Only its
   values on the walls are kept.
2. x and y are harmonic functions of ξ and its conjugate η, so that the mesh follows from the walls by Fourier series
   (:mod:`.harmonic`).
3. Both steps are repeated on the mesh they made, coarse, until the energy of ξ settles; the first grid has vertical
   columns.

Source: Thompson, Warsi and Mastin 1985, Numerical Grid Generation, ISBN 0-444-00985-X, chapters VI and X.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.conformal import harmonic, laplace
from roughfilm.foamcases.conformal.cells import convex
from roughfilm.foamcases.conformal.laplace import OnWalls, over_periods
from roughfilm.foamcases.conformal.wall import CROWDED_POINTS, Wall, wall_of
from roughfilm.rom.thin_film.columns import MIN_CORNER_DISTANCE, columns
from roughfilm.rom.thin_film.gap import Gap

COARSE = ((240, 20), (480, 20), (960, 20))
"""Columns and layers of the grids on which ξ is solved; a finer one is taken if cells of the mesh fold."""

ROUNDS = 8
"""Largest number of times that ξ is solved."""

SETTLED = 1e-5
"""Relative change of the energy of ξ at which it is settled."""

ARC_STEP = 0.1
"""Arc length of wall, beyond its length along x, for each column of the first grid, in film thicknesses."""

TABLE = 6001
"""Number of evenly spaced values of ξ over three periods at which the positions on the walls are tabulated."""

MAX_GROWTH = 20.0
"""Largest length of lower wall over that of film with the same rise of ξ, up to which columns count by length."""

SAME_PLACE = 1e-6
"""Distance in film thicknesses below which a corner is at the end of the period."""


@dataclass(frozen=True, kw_only=True)
class Places:
    """Positions on the walls by ξ, increasing: arc length of the lower wall and x of the upper one.

    Attributes
    ----------
    lower, upper : functions of ξ from -1 to 2.
    xi : values of ξ from -1 to 2 at which the functions are tabulated to invert them, increasing.
    energy : energy of ξ.
    """

    lower: Callable[[Array], Array]
    upper: Callable[[Array], Array]
    xi: Array
    energy: float


@dataclass(frozen=True, kw_only=True)
class Columns:
    """The columns of a mesh: ξ from 0 to 1, and the arc length at which each begins on the lower wall; shape (n,)."""

    xi: Array
    lower: Array


def orthogonal(gap: Gap, resolution: int, layers: int) -> Array:
    """The vertices of the near-orthogonal mesh of a gap, shape (columns + 1, layers + 1, 2), in film thicknesses.

    Layers count from the lower wall. Columns are as dense as :func:`roughfilm.rom.thin_film.columns.columns` makes them
    along the mean of both walls, and every corner of the gap is a vertex. The first column begins at the start of the
    period on the upper wall, and the last one is its copy one period later.

    Parameters
    ----------
    gap : the gap of a pocket.
    resolution : number of columns, about.
    layers : number of layers.

    Raises
    ------
    InputError
        If cells fold or are not convex, as they do at a sharp ridge between two grooves.
    """
    return _unfolded(
        gap, resolution, lambda wall, places: _period(wall, places, _columns(wall, places, resolution), layers)
    )


def between_ends(gap: Gap, resolution: int, layers: int) -> Array:
    """The vertices of the near-orthogonal mesh of a gap that is open at both ends, which are vertical.

    Shape and unit are those of :func:`orthogonal`. The mesh is half of that of the gap that is continued by its mirror
    image beyond its end: both mirror planes are lines ξ = constant of the conformal map.

    Parameters
    ----------
    gap : the gap from one end to the other; its thickness is needed between them only.
    resolution : number of columns, about.
    layers : number of layers.

    Raises
    ------
    InputError
        If cells fold or are not convex.
    """
    start, end = gap.breaks[0] / gap.film, gap.breaks[-1] / gap.film

    def mesh(wall: Wall, places: Places) -> Array:
        vertices = _mesh(wall, places, _columns(wall, places, resolution, until=0.5), layers)
        vertices[0, :, 0], vertices[-1, :, 0] = start, end
        return vertices

    return _unfolded(_mirrored(gap), resolution, mesh)


def _mirrored(gap: Gap) -> Gap:
    """The gap continued by its mirror image beyond its end, periodic over twice its length."""
    start, end = gap.breaks[0], gap.breaks[-1]

    def both(places: tuple[float, ...]) -> tuple[float, ...]:
        return tuple(sorted({*places, *(2 * end - place for place in places if place > start)}))

    def thickness(x: Array) -> Array:
        along = np.mod(x - start, 2 * (end - start))
        return gap.thickness(start + np.minimum(along, 2 * (end - start) - along))

    breaks = (*both(gap.breaks), 2 * end - start)
    return replace(gap, breaks=breaks, corners=both(gap.corners), thickness=thickness)


def _unfolded(gap: Gap, resolution: int, mesh: Callable[[Wall, Places], Array]) -> Array:
    """The mesh of a gap from the coarsest of the grids ``COARSE`` with which its cells are convex."""
    wall = wall_of(gap)
    for coarse in COARSE:
        vertices = mesh(wall, _settled(wall, *coarse))
        folded = ~convex(vertices).all(axis=1)
        if not folded.any():
            return vertices
    raise _folding(vertices[:-1, 0, 0][folded][0] * gap.film, resolution)


def _folding(place: float, resolution: int) -> InputError:
    return InputError(
        f"geometry: got a ridge so sharp at x = {place:.4g} m that cells of a mesh of {resolution} columns fold there; "
        "give the grooves more land between them or less steep walls, or change the resolution"
    )


def _settled(wall: Wall, resolution: int, layers: int) -> Places:
    """The positions on the walls, from a coarse grid that is replaced by the mesh it gives until ξ settles."""
    vertices, lower = _first_grid(wall, resolution, layers)
    energy = np.inf
    for _ in range(ROUNDS):
        found = laplace.solve(vertices)
        places = _places(wall, found, lower, vertices[:, -1, 0])
        if abs(found.energy - energy) < SETTLED * found.energy:
            break
        energy = found.energy
        spread = _columns(wall, places, resolution)
        vertices, lower = _period(wall, places, spread, layers), spread.lower
    return places


def _first_grid(wall: Wall, resolution: int, layers: int) -> tuple[Array, Array]:
    """A grid of vertical columns, more of them at steep walls, and their arc lengths on the lower wall."""
    crowded = columns(wall.gap, CROWDED_POINTS)
    along = np.interp(wall.x, crowded, np.linspace(0, resolution, crowded.size))
    count = along + (wall.arc - (wall.x - wall.x[0])) / ARC_STEP
    arc = np.interp(np.linspace(count[0], count[-1], int(count[-1]) + 1), count, wall.arc)
    lower = wall.points(arc)
    vertices = np.repeat(lower[:, None], layers + 1, axis=1)
    vertices[..., 1] = 1 - (1 - lower[:, 1:]) * np.linspace(1, 0, layers + 1)
    return vertices, arc


def _places(wall: Wall, found: OnWalls, lower: Array, upper: Array) -> Places:
    """The positions on the walls by ξ, from those at the nodes of a grid."""
    from scipy.interpolate import PchipInterpolator  # slow to import

    below, above = (over_periods(xi, xi[-1] - xi[0]) for xi in (found.lower, found.upper))
    return Places(
        lower=PchipInterpolator(below, over_periods(lower, wall.length)),
        upper=PchipInterpolator(above, over_periods(upper, wall.period)),
        xi=np.unique(np.concatenate([np.linspace(-1, 2, TABLE), below, above])),
        energy=found.energy,
    )


def _columns(wall: Wall, places: Places, resolution: int, *, until: float = 1.0) -> Columns:
    """The columns of a mesh up to ξ = ``until``, spread over the mean of the positions on both walls.

    There is one at every corner. At the bottom of a groove deeper than wide ξ hardly rises, and layers are thick. The
    lower wall counts there by ξ.
    """
    gap, film, table = wall.gap, wall.gap.film, places.xi
    lower = places.lower(table)
    moved = np.minimum(np.diff(lower), MAX_GROWTH * wall.period * np.diff(table))
    middle = (np.append(0.0, np.cumsum(moved)) + places.upper(table)) / 2
    start, end = np.interp([0.0, until], table, middle).tolist()
    if not end - start > SAME_PLACE:
        raise _folding(gap.breaks[0], resolution)

    def on_wall(breaks: tuple[float, ...]) -> Array:
        return np.asarray(np.interp(np.array(breaks) / film, wall.x, wall.arc))

    def counted(breaks: tuple[float, ...]) -> Array:
        """The means of the positions on both walls at breaks of the gap, in the period of the columns."""
        inside = np.interp(np.interp(on_wall(breaks), lower, table) % 1, table, middle)
        at_ends = (inside - start < SAME_PLACE) | (np.abs(end - inside) < SAME_PLACE)
        return np.where(at_ends, start, inside)

    corners, breaks = counted(gap.corners), counted(gap.breaks[:-1])
    within = [np.unique(places[places < end] * film).tolist() for places in (np.append(breaks, start), corners)]
    mean_gap = replace(gap, breaks=(*within[0], end * film), corners=tuple(within[1]))
    spread = columns(mean_gap, resolution)
    xi = np.interp(spread, middle, table)
    xi[[0, -1]] = 0, until
    arc = places.lower(xi)
    for corner, place in zip(corners, on_wall(gap.corners), strict=True):
        nearest = np.abs(spread - corner) < MIN_CORNER_DISTANCE
        arc[nearest] = place + wall.length * np.round((arc[nearest] - place) / wall.length)
    arc[-1] = arc[0] + until * wall.length
    return Columns(xi=xi, lower=arc)


def _period(wall: Wall, places: Places, spread: Columns, layers: int) -> Array:
    """The vertices of the mesh of a period, whose last column is the first one shifted."""
    vertices = _mesh(wall, places, spread, layers)
    vertices[-1] = vertices[0] + [wall.period, 0]
    return vertices


def _mesh(wall: Wall, places: Places, spread: Columns, layers: int) -> Array:
    """The vertices of the mesh with these columns, shape (columns + 1, layers + 1, 2)."""
    sampled, eta = harmonic.samples(places.energy, layers), np.linspace(0, 1, layers + 1)
    drift = wall.period * sampled
    below, above = wall.points(places.lower(sampled)), places.upper(sampled)
    vertices = np.empty((spread.xi.size, eta.size, 2))
    for axis, (lower, upper) in enumerate(((below[:, 0] - drift, above - drift), (below[:, 1], np.ones_like(above)))):
        vertices[..., axis] = harmonic.fill(lower, upper, places.energy, spread.xi, eta)
    vertices[..., 0] += wall.period * spread.xi[:, None]
    vertices[:, 0] = wall.points(spread.lower)
    vertices[:, -1, 0], vertices[:, -1, 1] = places.upper(spread.xi), 1
    return vertices
