"""The network of a film: the conductance of every face, integrated over the film thickness inside it."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import unreordered
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.cavitation.averaged import Averaged, averaged
from roughfilm.rom.cavitation.balance import conduct
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.network import Network
from roughfilm.rom.cavitation.oblique import Oblique
from roughfilm.rom.cavitation.shape import Shape

GAUSS = (-0.5 / sqrt(3), 0.5 / sqrt(3))
"""Gauss points in spacings from the middle of a face: the integrals of h⁻² and h⁻³ are fourth-order accurate."""

QUARTERS = (0.25, 0.75)
"""Positions across a control volume at which a face is sampled, so that a step at a node counts on both sides."""

PARTS = (0.25, 0.5, 0.75)
"""Parts of a face along the flow, from its upstream node, after which a film may rupture; they are evenly spaced."""

AROUND = (-0.25, 0.25)
"""Positions along the flow at which faces across it are sampled, in spacings before and behind a node."""

BESIDE = (-1e-9, 1e-9)
"""Positions, in spacings, at which the film at a node is sampled: the mean over both sides of a step."""


@dataclass(frozen=True, kw_only=True)
class Ends:
    """Boundary conditions: pressures above cavitation pressure, Pa, and the filling of the inlet.

    ``inlet`` is None for a starved inlet, where θ = ``theta`` <= 1 holds instead of a pressure; ``sides`` is None for
    sides without flow. ``anchor`` is the position (x, y) and the pressure, Pa, of the one full node of a film that is
    periodic in both directions, whose pressure nothing else determines.
    """

    inlet: float | None = None
    theta: float = 1.0
    outlet: float = 0.0
    sides: tuple[float, float] | None = None
    anchor: tuple[float, float, float] | None = None


@dataclass(frozen=True, kw_only=True)
class Faces:
    """Film thickness integrated over the faces, shape (nx, ny), independent of speed, ends and pressure.

    ``thickness`` is that of the nodes, m; ``mean`` = <h⁻²>/<h⁻³> between (i, j) and (i+1, j) is the thickness of a
    uniform film with the same Couette flow; ``east`` and ``north`` are <h⁻³>⁻¹, m³, towards i+1 and j+1. With averaged
    roughness 1/A₁₁ and 1/A₂₂ replace h⁻³, B₁/A₁₁ replaces h⁻², and ``averaged`` holds the remaining coefficients.
    ``parts`` are ``mean`` and ``east`` of the first parts of the faces, ``PARTS`` of them, shape (2, parts, nx, ny).
    """

    thickness: Array
    mean: Array
    east: Array
    north: Array
    parts: Array
    averaged: Averaged | None = None


def faces(shape: Shape, grid: Grid) -> Faces:
    """The film sampled on a grid; flows are fourth-order accurate where h is smooth along them."""
    return faces_of((shape.thickness(x, y) for x, y in positions(grid)), shape, grid)


def positions(grid: Grid) -> Iterator[tuple[Array, Array]]:
    """The positions (x, y) at which a film is sampled on a grid, in the order in which :func:`faces_of` takes it.

    They are those beside the nodes, shape (2, nx, ny), for each strip of a control volume the Gauss points and the
    parts of the faces along the flow, and for each side of a node the Gauss points of the faces across it.
    """
    (nx, ny), x, y = grid.shape, grid.x[:, None], grid.y
    yield _places([x + _towards(grid, part) for part in BESIDE], y)
    begins = y - np.append(grid.spacing_y[-1], grid.spacing_y[:-1]) / 2
    last = nx if grid.spacing_x[-1] else nx - 1
    dx, along = grid.spacing_x[:last, None], x[:last]
    points = [along + (0.5 + point) * dx for point in GAUSS]
    points += [along + (part - PARTS[0] / 2) * dx for part in PARTS]
    for strip in [y] if ny == 1 else [begins + part * grid.volume_y for part in QUARTERS]:
        yield _places(points, strip)
    if ny > 1:
        last = ny if grid.spacing_y[-1] else ny - 1
        dy, across = grid.spacing_y[:last], y[:last]
        for part in AROUND:
            yield _places([x + _towards(grid, part)], np.array([across + (0.5 + point) * dy for point in GAUSS]))


def _places(x: list[Array], y: Array) -> tuple[Array, Array]:
    """Positions of shape (points, nx, ny) from lists of x, each of shape (nx, 1), and of y, shape (ny,)."""
    x_of_all, y_of_all = np.broadcast_arrays(np.array(x), y.reshape(-1, 1, y.shape[-1]))
    return x_of_all, y_of_all


def faces_of(thickness: Iterator[Array], shape: Shape, grid: Grid) -> Faces:
    """The film on a grid from its thickness at the ``positions``, m, and the roughness of its shape."""
    nx, ny = grid.shape
    mean, east, north = (np.zeros((nx, ny)) for _ in range(3))
    beside = next(thickness) / len(BESIDE)
    parts = np.zeros((2, len(PARTS), nx, ny))
    strips = 1 if ny == 1 else len(QUARTERS)
    for _ in range(strips):
        add_along(*_resistance(shape, next(thickness)), strips, mean, east, parts)
    if ny > 1:
        for _ in AROUND:
            add_across(_resistance_across(shape, next(thickness)), north)
    rough = None if shape.roughness is None else averaged(shape, shape.roughness, grid)
    return Faces(thickness=beside[0] + beside[1], mean=mean, east=east, north=north, parts=parts, averaged=rough)


@unreordered
def add_along(square, cube, strips, mean, east, parts):  # type: ignore[no-untyped-def]
    """Add the flow along a strip of every face, from h⁻² and h⁻³ at its Gauss points and its parts, which are summed.

    Loops over one row each are vectorised.
    """
    points, last, ny = square.shape
    weight = 1 / strips
    for i in range(last):
        first, second, between, towards = cube[0, i], cube[1, i], mean[i], east[i]
        along, ahead = square[0, i], square[1, i]
        for j in range(ny):
            flow = weight / (first[j] + second[j])
            between[j] += (along[j] + ahead[j]) * flow
            towards[j] += 2 * flow
        for part in range(points - 2):
            squared, cubed = square[2 + part, i], cube[2 + part, i]
            if part:
                before, behind = square[1 + part, i], cube[1 + part, i]
                for j in range(ny):
                    squared[j] += before[j]
                    cubed[j] += behind[j]
            between, towards = parts[0, part, i], parts[1, part, i]
            for j in range(ny):
                flow = weight / cubed[j]
                between[j] += squared[j] * flow
                towards[j] += flow / PARTS[0]


@unreordered
def add_across(cube, north):  # type: ignore[no-untyped-def]
    """Add the flow across a half of every face, from h⁻³ at its Gauss points."""
    _, nx, last = cube.shape
    for i in range(nx):
        for j in range(last):
            north[i, j] += 2 / (cube[0, i, j] + cube[1, i, j]) / 2


def _resistance(shape: Shape, h: Array) -> tuple[Array, Array]:
    """h⁻² and h⁻³, or B₁/A₁₁ and 1/A₁₁ with averaged roughness."""
    if shape.roughness is None:
        square, cube = np.empty(h.shape), np.empty(h.shape)
        invert(np.ravel(h), square.reshape(-1), cube.reshape(-1))
        return square, cube
    factors = shape.roughness(h)
    return factors.drag / factors.along, 1 / factors.along


def _resistance_across(shape: Shape, h: Array) -> Array:
    """h⁻³, or 1/A₂₂ with averaged roughness."""
    if shape.roughness is None:
        return _resistance(shape, h)[1]
    return np.asarray(1 / shape.roughness(h).across)


@unreordered
def invert(thickness, square, cube):  # type: ignore[no-untyped-def]
    """Write h⁻² and h⁻³."""
    for n in range(thickness.size):
        inverse = 1 / thickness[n]
        square[n] = inverse * inverse
        cube[n] = square[n] * inverse


def _towards(grid: Grid, part: float) -> Array:
    """Offsets from the nodes along x, zero where they would leave the film, shape (nx, 1)."""
    if part > 0:
        return part * grid.spacing_x[:, None]
    before = np.append(grid.spacing_x[-1], grid.spacing_x[:-1])
    return part * before[:, None]


def network(
    grid: Grid,
    faces: Faces,
    ends: Ends,
    *,
    speed: float,
    viscosity: float,
    compressibility: float,
    storage: tuple[float | Array, float | Array] | None = None,
    ruptures: bool = True,
    viscosities: Viscosities | None = None,
) -> Network:
    """The network of a film.

    Parameters
    ----------
    speed : speed of the sliding wall towards increasing x, >= 0, m/s; rad/s where x is an angle.
    viscosity : viscosity at the cavitation pressure, Pa s.
    compressibility : dθ/dp at the cavitation pressure, 1/Pa.
    storage : in transient flow, the rate a, 1/s, and s, m/s, of ∂(θh)/∂t = a θh - s; each a number or of shape
        (nx, ny).
    ruptures : whether the film cavitates.
    viscosities : viscosities at the nodes, at the cavitation pressure, where they are not ``viscosity``.

    Raises
    ------
    InputError
        If the roughness is averaged with an oblique lay and the film is periodic in y.
    """
    nx, ny = grid.shape
    across = grid.volume_y * grid.radius
    couette, upstream, east, north = (np.empty((nx, ny)) for _ in range(4))
    part_couette, part_east = (np.empty((len(PARTS) if ruptures else 0, nx, ny)) for _ in range(2))
    integrals = faces.mean, faces.east, faces.north, faces.parts
    lengths = grid.spacing_x, grid.spacing_y, grid.volume_x, grid.volume_y, grid.radius
    flows = couette, upstream, east, north, part_couette, part_east
    weigh(*integrals, *lengths, float(speed), float(viscosity), float(compressibility), *flows)
    cross = None if faces.averaged is None else faces.averaged.cross
    if viscosities is not None:
        cross = _varied(viscosity, viscosities, compressibility, flows, cross)
    fixed, pressure = np.zeros((nx, ny), dtype=bool), np.zeros((nx, ny))
    supply = None
    if grid.spacing_x[-1] == 0:
        fixed[-1], pressure[-1] = True, ends.outlet
        if ends.inlet is None:
            supply = 0.5 * speed * across * ends.theta * faces.thickness[0]
        else:
            fixed[0], pressure[0] = True, ends.inlet
    if ends.sides is not None:
        for j, side in zip((0, -1), ends.sides, strict=True):
            fixed[:, j], pressure[:, j] = True, side
        if supply is not None:
            supply[[0, -1]] = 0
    if supply is not None:
        north[0] = 0
    if ends.anchor is not None:
        x, y, given = ends.anchor
        node = int(np.abs(grid.x - x).argmin()), int(np.abs(grid.y - y).argmin())
        fixed[node], pressure[node] = True, given
    lay = _oblique(grid, faces, cross, north, fixed, speed, viscosity, compressibility, supplied=supply is not None)
    spills = (False, False)
    if lay is not None and ruptures and ends.sides is not None:
        spills = (ends.sides[0] <= 0, ends.sides[1] <= 0)
        within = slice(None) if grid.spacing_x[-1] else slice(1, -1)
        for j, empties in zip((0, -1), spills, strict=True):
            fixed[within, j] &= not empties
    rate, stored = (0.0, 0.0) if storage is None else storage
    return Network(
        couette=couette,
        upstream=upstream,
        east=east,
        north=north,
        supply=supply,
        fixed=fixed,
        pressure=pressure,
        part_couette=part_couette,
        part_east=part_east,
        storage=grid.areas * faces.thickness * rate,
        stored=grid.areas * stored,
        periodic=(bool(grid.spacing_x[-1]), bool(grid.spacing_y[-1])),
        oblique=lay,
        spills=spills,
    )


@unreordered
def weigh(mean, over_east, over_north, parts, spacing_x, spacing_y, volume_x, volume_y, radius, speed, viscosity, compressibility, couette, upstream, east, north, part_couette, part_east):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """Write the flows of the faces by sliding and by pressure, of the integrals over their thickness.

    Faces without a film, behind the last node, have none.
    """
    nx, ny = mean.shape
    for i in range(nx):
        for j in range(ny):
            slides = 0.5 * speed * (volume_y[j] * radius[j])
            resistance = 12 * viscosity * radius[j] * spacing_x[i]
            couette[i, j] = slides * mean[i, j]
            east[i, j] = over_east[i, j] * volume_y[j] / resistance if over_east[i, j] != 0.0 else 0.0
            advected = couette[i, j] * compressibility
            upstream[i, j] = max(0.5, 1 - east[i, j] / advected) if advected != 0.0 else 0.5
            for part in range(part_east.shape[0]):
                part_couette[part, i, j] = slides * parts[0, part, i, j]
                through = parts[1, part, i, j]
                part_east[part, i, j] = through * volume_y[j] / resistance if through != 0.0 else 0.0
            north[i, j] = 0.0
            if over_north[i, j] != 0.0:
                towards = (radius[j] + radius[j + 1 if j + 1 < ny else 0]) / 2
                north[i, j] = over_north[i, j] * volume_x[i] * towards / (12 * viscosity * spacing_y[j])


def _varied(
    viscosity: float,
    viscosities: Viscosities,
    compressibility: float,
    flows: tuple[Array, ...],
    cross: Array | None,
) -> Array | None:
    """Multiply the flows of the faces for the viscosities at the nodes; returns A₁₂ of the cells, multiplied too.

    A film that ruptures inside of a face has the viscosities of its upstream node. Second-order accurate.
    """
    couette, upstream, east, north, part_couette, part_east = flows
    fluidity, carried = viscosity / viscosities.flow, viscosities.carried
    conduct(east.copy(), north.copy(), fluidity, True, True, east, north)  # faces without a film stay at 0
    couette *= (carried + np.roll(carried, -1, axis=0)) / 2
    part_couette *= carried
    part_east *= fluidity
    advected = couette * compressibility
    if compressibility:
        upstream[advected != 0] = np.maximum(0.5, 1 - east[advected != 0] / advected[advected != 0])
    if cross is None:
        return None
    pairs = (fluidity + np.roll(fluidity, -1, axis=0)) / 2
    return np.asarray(cross * (pairs + np.roll(pairs, -1, axis=1)) / 2)


def _oblique(
    grid: Grid,
    faces: Faces,
    cross: Array | None,
    north: Array,
    fixed: NDArray[np.bool_],
    speed: float,
    viscosity: float,
    compressibility: float,
    *,
    supplied: bool,
) -> Oblique | None:
    """The flows that an oblique lay adds in the plane, None without one; there is no drift along a starved inlet."""
    rough = faces.averaged
    if rough is None or cross is None or grid.shape[1] == 1 or not (cross.any() or rough.drag_across.any()):
        return None
    if grid.spacing_y[-1]:
        raise InputError(
            "roughness: got a film periodic across the sliding; an averaged oblique lay needs a film with two sides"
        )
    towards = (grid.radius + np.roll(grid.radius, -1)) / 2
    drift = 0.5 * speed * grid.volume_x[:, None] * towards * towards * rough.drag_across
    if supplied:
        drift[0] = 0
    with np.errstate(divide="ignore", invalid="ignore"):
        upstream = np.maximum(0.5, 1 - north / (np.abs(drift) * compressibility))
    upstream[drift * compressibility == 0] = 0.5
    return Oblique(
        cross=cross / (12 * viscosity),
        drift=drift,
        upstream=upstream,
        threshold=rough.threshold_across,
        fixed=fixed,
        periodic=bool(grid.spacing_x[-1]),
    )
