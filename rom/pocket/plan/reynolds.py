"""The Reynolds equation over a cell in plan by finite volumes, with the exact flow between the middles of columns."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.pocket.plan.balance import Balance, outflow
from roughfilm.rom.pocket.plan.grid import (
    PARTS,
    PlanGrid,
    between_middles,
    places_between,
    running_means,
    within_columns,
)


@dataclass(frozen=True, kw_only=True)
class Faces:
    """Means over the faces between neighbouring columns, of the gap on the way from one middle to the next.

    Attributes
    ----------
    east, north : <h⁻³>⁻¹ towards greater x and y, shape (nx, ny).
    drag : <h⁻²>/<h⁻³> along x, shape (nx, ny): the thickness of a uniform film with the same flow by sliding.
    shear : 4<h⁻¹> - 3<h⁻²>²/<h⁻³> along x, shape (nx, ny): shear stress on the sliding wall between equal pressures.
    """

    east: Array
    north: Array
    drag: Array
    shear: Array


def faces_of(grid: PlanGrid) -> Faces:
    """The means over the faces of a grid: along the flow in series, over the breadth of a face side by side."""
    inverse = 1 / grid.lattice
    square = inverse * inverse
    cube = square * inverse
    one, two, three = (between_middles(values, 0) for values in (inverse, square, cube))
    east, drag, shear = (within_columns(values, 1) for values in (1 / three, two / three, 4 * one - 3 * two**2 / three))
    north = within_columns(1 / between_middles(cube, 1), 0)
    return Faces(east=east, north=north, drag=drag, shear=shear)


@dataclass(frozen=True, kw_only=True)
class PlanFilm:
    """A solution of the Reynolds equation over a cell in plan, in film thicknesses, speeds and η u / film.

    Attributes
    ----------
    grid, faces : the columns and their faces.
    balance : the equations of the pressure.
    pressure : pressure at the middles of the columns up to a constant, shape (nx, ny).
    along, across : flow per width through the faces towards greater x and y, shape (nx, ny).
    iterations : number of iterations of the solver.
    residual : the largest net flow out of a column over the largest flow through a face.
    """

    grid: PlanGrid
    faces: Faces
    balance: Balance
    pressure: Array
    along: Array
    across: Array
    iterations: int
    residual: float


def solve_film(grid: PlanGrid) -> PlanFilm:
    """Solve ∇·q = 0 with the flow q = h/2 e_x - h³/12 ∇p, periodic.

    Between two middles the flow along x is constant on every line, so that

        p' = 6/h² - 12 q/h³,    q = <h⁻²>/(2<h⁻³>) - (p₁ - p₀)/(12 Δx <h⁻³>),

    which is exact for a film that varies along x alone. The error is of second order in the size of the columns.
    """
    faces, (dx, dy) = faces_of(grid), grid.steps
    east, north = faces.east / 12 * dy / dx, faces.north / 12 * dx / dy
    balance = Balance(east, north)
    sliding = faces.drag / 2 * dy
    pressure, iterations = balance.pressure(-outflow(sliding, np.zeros_like(sliding)))
    along = sliding - east * (np.roll(pressure, -1, axis=0) - pressure)
    across = -north * (np.roll(pressure, -1, axis=1) - pressure)
    return PlanFilm(
        grid=grid,
        faces=faces,
        balance=balance,
        pressure=pressure,
        along=along / dy,
        across=across / dx,
        iterations=iterations,
        residual=float(np.abs(outflow(along, across)).max() / np.abs(along).max()),
    )


def shear_stress(film: PlanFilm) -> Array:
    """The mean shear stress on the sliding wall over the faces along x, between the middles, shape (nx, ny).

    It is 1/h + h/2 ∂p/∂x at a place, and 4<h⁻¹> - 6q<h⁻²> over a face.
    """
    rise = (np.roll(film.pressure, -1, axis=0) - film.pressure) / film.grid.steps[0]
    return np.asarray(film.faces.shear + film.faces.drag / 2 * rise)


@dataclass(frozen=True, kw_only=True)
class Lines:
    """The lines along x through the middles of columns: values at the places from each middle to the next.

    Attributes
    ----------
    thickness : film thickness, shape (nx, PARTS + 1, ny).
    opening : integral of h⁻³ from the middle to a place over Δx, of the same shape.
    drive : pressure by which a film without pressure flow would rise from the middle, of the same shape.
    """

    thickness: Array
    opening: Array
    drive: Array


def lines_of(grid: PlanGrid) -> Lines:
    """The lines of a grid, with the drive 6 ∫h⁻² dx of the sliding wall."""
    thickness = places_between(grid.lattice[:, ::PARTS])
    inverse = 1 / thickness
    square = inverse * inverse
    opening, sliding = running_means(square * inverse), running_means(square)
    return Lines(thickness=thickness, opening=opening, drive=6 * grid.steps[0] * sliding)


def pressure_on(lines: Lines, drive: Array, pressure: Array) -> Array:
    """The pressure on the lines through the middles, shape (PARTS nx, ny), from that at the middles.

    The drive raises it; the flow of pressure between two middles, constant on a line, corrects it to the next middle.
    """
    rise = np.roll(pressure, -1, axis=0) - pressure
    corrected = drive + (rise - drive[:, -1])[:, None] * lines.opening / lines.opening[:, -1:]
    return (pressure[:, None] + corrected[:, :-1]).reshape(-1, pressure.shape[1])


def along_lines(values: Array) -> Array:
    """Linear interpolation from values at the middles, shape (nx, ny), to the places of lines."""
    shares = np.linspace(0, 1, PARTS + 1)[:, None]
    return np.asarray(values[:, None] * (1 - shares) + np.roll(values, -1, axis=0)[:, None] * shares)


def flows_at_middles(film: PlanFilm) -> tuple[Array, Array]:
    """The flow per width along x and y at the middles of the columns, from the faces beside them, shape (nx, ny)."""
    return (film.along + np.roll(film.along, 1, axis=0)) / 2, (film.across + np.roll(film.across, 1, axis=1)) / 2


def reverse_flow(film: PlanFilm, lines: Lines) -> float:
    """The greatest reverse velocity along x over the sliding speed; 0 without reverse flow.

    With the flow q along x the velocity is Y + 6 a Y (1 - Y), a = q/h - 1/2, and flows back where 1 + 6a < 0.
    """
    flow = along_lines(flows_at_middles(film)[0])
    steepness = 6 * flow / lines.thickness - 2
    steepest = -highest((-steepness[:, :-1]).reshape(-1, flow.shape[2]))
    return steepest**2 / (4 * (1 - steepest)) if steepest < 0 else 0.0


def highest(values: Array) -> float:
    """The greatest value of a periodic field between its places, of parabolas through the greatest and its neighbours.

    It is p + gᵀ(-H)⁻¹g/2 with the central differences g and H where the field bends down in both directions, otherwise
    that along the axes in which it does.
    """
    i, j = (int(place) for place in np.unravel_index(np.argmax(values), values.shape))
    around = values.take(range(i - 1, i + 2), axis=0, mode="wrap").take(range(j - 1, j + 2), axis=1, mode="wrap")
    top = float(around[1, 1])
    slope = np.array([around[2, 1] - around[0, 1], around[1, 2] - around[1, 0]]) / 2
    mixed = (around[2, 2] - around[2, 0] - around[0, 2] + around[0, 0]) / 4
    bends = np.array([2 * top - around[2, 1] - around[0, 1], 2 * top - around[1, 2] - around[1, 0]])
    if bends.min() > 0 and bends.prod() > mixed**2:
        offset = np.linalg.solve([[bends[0], -mixed], [-mixed, bends[1]]], slope)
        if np.abs(offset).max() <= 1:
            return top + float(slope @ offset) / 2
    return top + max((float(s**2 / b) / 2 for s, b in zip(slope, bends, strict=True) if b > 0), default=0.0)
