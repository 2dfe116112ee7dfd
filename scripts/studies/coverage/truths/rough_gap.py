"""The truth of a rough gap: Stokes flow by finite elements between ridges across x, else by a model on finer grids."""

from dataclasses import replace
from typing import Any, cast

import numpy as np
import scipy.sparse.linalg
from numpy.typing import NDArray
from skfem import MeshTri1, MeshTri2

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.rough_gap.models.slope_corrected import MODEL as SLOPE_CORRECTED
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import Walls
from scripts.studies.coverage.finer import on_finer_surface
from scripts.studies.coverage.finite_elements.spaces import Spaces
from scripts.studies.coverage.surfaces import refined
from scripts.studies.coverage.truth import Truth

FINER = 2
"""Number of points along a side over that of a surface, of the solution that states the neglected slope."""

ROWS = (5, 8)
"""Numbers of rows of cells across the gap of the two meshes."""

CELL_ASPECT = 2.0
"""Length of a cell over its height at the mean gap, unless ``CELLS_OF_WAVE`` asks for shorter cells."""

CELLS_OF_WAVE = 5
"""Number of cells along the shortest wave of the walls, over that of rows divided by four."""

FLATNESS = 1e-9
"""Largest change of a wall along y, over the mean gap, of walls that count as ridges across x."""

MAX_CREEPING = 0.1
"""Largest Re g' at which inertia changes the flow by less than 2e-4."""

SAFETY_FACTOR = 2.0
"""Uncertainty over the change from the coarser mesh to the finer one, whose error is several times smaller."""

THIN_FILM_POINTS = 4096
"""Number of points of the means of thin-film theory, which converge exponentially."""

LEAST_UNCERTAINTY = 1e-7
"""Least relative uncertainty."""


def truth(scene: RoughGap) -> Truth:
    """Return the factors of a gap in Stokes flow, and those of the models' own equations.

    They are the truth of the scene where the flow is creeping. Between ridges across x they are found by finite
    elements, between other walls by ``slope_corrected`` on finer grids, with the uncertainty that it states.

    Raises
    ------
    ConvergenceError
        If no model solves a gap between surfaces on finer grids.
    """
    walls = scene.walls(max(scene.surface().shape))
    ridged = max(float(np.ptp(wall, axis=1).max()) for wall in (walls.lower, walls.upper)) < FLATNESS * scene.mean_gap
    open_gap = scene.load is None and walls.gap.min() > 0
    found = between_ridges(scene, walls) if ridged and open_gap else between_surfaces(scene)
    if scene.reynolds_number * scene.rms_slope <= MAX_CREEPING:
        return found
    return replace(found, values={}, uncertainty={})


def between_ridges(scene: RoughGap, walls: Walls) -> Truth:
    """Return the factors of a gap between ridges across x, by finite elements."""
    mean = scene.mean_gap
    lower, upper = walls.lower[:, 0] / mean, walls.upper[:, 0] / mean
    coarse, fine = (ridge_factors(lower, upper, walls.size[0] / mean, rows) for rows in ROWS)
    thin = thin_film_factors(lower, upper)
    if not walls.slides:
        del fine["B1"], fine["friction"]
    uncertainty = {
        name: SAFETY_FACTOR * abs(value - coarse[name]) + LEAST_UNCERTAINTY * abs(value) for name, value in fine.items()
    }
    stokes = {name: (value, uncertainty[name]) for name, value in fine.items()}
    return Truth(
        values=fine,
        uncertainty=uncertainty,
        method=f"Taylor-Hood finite elements, cubics and quadratics, on {ROWS[0]} and {ROWS[1]} rows of cells",
        own={
            "smooth_gap": dict.fromkeys(fine, (1.0, LEAST_UNCERTAINTY)),
            "homogenized": {name: (thin[name], LEAST_UNCERTAINTY * thin[name]) for name in fine},
            "slope_corrected": stokes,
            "stokes": stokes,
        },
    )


def between_surfaces(scene: RoughGap) -> Truth:
    """Return the factors of a gap between surfaces, by ``slope_corrected`` on finer grids.

    Friction is left out where the walls touch, as it has no limit there.
    """
    found = on_finer_surface(scene)
    limits = found.own["slope_corrected"]
    try:
        stated = SLOPE_CORRECTED.solve(cast(RoughGap, refined(scene, FINER))).quantities
    except (ConvergenceError, InputError) as error:
        raise ConvergenceError(f"slope_corrected on a finer grid: {error}") from error
    touching = bool((scene.walls(max(scene.surface().shape)).gap <= 0).any())
    values = {name: value for name, (value, _) in limits.items() if not (touching and name == "friction")}
    uncertainty = {name: limits[name][1] + (stated[name].uncertainty or 0.0) for name in values}
    return replace(
        found,
        values=values,
        uncertainty=uncertainty,
        own={**found.own, "stokes": {name: (value, uncertainty[name]) for name, value in values.items()}},
        by="slope_corrected",
    )


def thin_film_factors(lower: Array, upper: Array) -> dict[str, float]:
    """Return A₁₁, A₂₂, B₁ and friction of thin-film theory, <h⁻³>⁻¹, <h³>, <h⁻²>/<h⁻³>, 4<h⁻¹> - 3<h⁻²>²/<h⁻³>."""
    places = np.arange(THIN_FILM_POINTS) / THIN_FILM_POINTS
    h = _interpolated(upper, places) - _interpolated(lower, places)
    one, two, three = (float(np.mean(h**-power)) for power in (1, 2, 3))
    return {
        "A11": 1 / three,
        "A22": float(np.mean(h**3)),
        "B1": two / three,
        "friction": 4 * one - 3 * two**2 / three,
    }


def ridge_factors(lower: Array, upper: Array, period: float, rows: int) -> dict[str, float]:
    """Return A₁₁, A₂₂, B₁ and friction of plane Stokes flow between two walls with a mean gap of 1.

    A gradient of 12 with a viscosity of 1 drives the flow A₁₁ across the ridges and A₂₂ along them. The upper wall,
    sliding at 1, drives the flow B₁/2; friction is the dissipation of this flow.

    Parameters
    ----------
    lower, upper : heights at equidistant nodes of one period, for trigonometric interpolation.
    period : length of the period in mean gaps.
    rows : number of rows of cells across the gap.
    """
    mesh = channel(lower, upper, period, rows)
    spaces = Spaces(mesh)
    blocks = {
        ("u", "u"): spaces.stiffness,
        ("v", "v"): spaces.stiffness,
        ("p", "u"): -spaces.divergence[0],
        ("p", "v"): -spaces.divergence[1],
        ("u", "p"): -spaces.divergence[0].transpose(0, 2, 1),
        ("v", "p"): -spaces.divergence[1].transpose(0, 2, 1),
    }
    solver = scipy.sparse.linalg.splu(spaces.matrix(blocks))
    ones = np.einsum("eiq,eq->ei", spaces.shapes, spaces.weights)
    integral, no_velocity = spaces.vector(ones), np.zeros(spaces.nodes.shape[1])
    no_pressure = np.zeros(spaces.pressure_nodes.shape[1])
    driven = spaces.expanded(solver.solve(spaces.reduced(12 * integral, no_velocity, no_pressure)))
    wall = no_velocity.copy()
    wall[spaces.top] = 1.0
    on_wall = wall[spaces.of_element]
    strained = spaces.vector(np.einsum("eij,ej->ei", spaces.stiffness, on_wall))
    pumped = spaces.vector(np.einsum("epi,ei->ep", spaces.divergence[0], on_wall), pressure=True)
    sliding = spaces.expanded(solver.solve(spaces.reduced(-strained, no_velocity, pumped)))
    u, v = (sliding.u + wall)[spaces.of_element], sliding.v[spaces.of_element]
    dissipation = sum(np.einsum("ei,eij,ej->", one, spaces.stiffness, one) for one in (u, v))
    free = spaces.number_u[spaces.of_element]
    along = scipy.sparse.linalg.spsolve(*_scalar(spaces, free, ones))
    return {
        "A11": float(integral @ driven.u) / period,
        "A22": float(integral @ np.append(12 * along, 0.0)[spaces.number_u]) / period,
        "B1": 2 * float(integral @ (sliding.u + wall)) / period,
        "friction": float(dissipation) / period,
    }


def _scalar(spaces: Spaces, numbers: NDArray[np.integer[Any]], ones: Array) -> tuple[scipy.sparse.csc_matrix, Array]:
    """Return the matrix and the right-hand side of -∇²w = 1 for the unknowns of u."""
    rows, columns = (np.broadcast_to(one, spaces.stiffness.shape) for one in (numbers[:, :, None], numbers[:, None, :]))
    kept = (rows >= 0) & (columns >= 0)
    count = int(numbers.max()) + 1
    matrix = scipy.sparse.coo_matrix((spaces.stiffness[kept], (rows[kept], columns[kept])), shape=(count, count))
    inside = numbers >= 0
    return matrix.tocsc(), np.bincount(numbers[inside], ones[inside], count).astype(np.float64)


def channel(lower: Array, upper: Array, period: float, rows: int) -> MeshTri2:
    """Return triangles with curved sides between two walls, in columns of halved cells.

    The upper wall is at y = 1 where it is flat; a middle of a side lies half-way between its ends in the coordinates
    x and (y - z₁)/(z₂ - z₁).
    """
    waves = max(_highest_wave(lower), _highest_wave(upper))
    columns = int(np.ceil(max(period * rows / CELL_ASPECT, waves * CELLS_OF_WAVE * rows / 4)))
    shift = 1 - float(upper.mean())

    def placed(x: Array, s: Array) -> Array:
        low, high = (_interpolated(wall, x / period + 0.5) + shift for wall in (lower, upper))
        return np.stack([x, low + s * (high - low)])

    x = period * (np.arange(columns + 1) / columns - 0.5)
    s = (1 - np.cos(np.pi * np.arange(rows + 1) / rows)) / 2
    grid = [np.ravel(one) for one in np.broadcast_arrays(x[:, None], s)]
    number = np.arange(grid[0].size).reshape(columns + 1, rows + 1)
    a, b, c, d = (number[i : columns + i, j : rows + j].ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    straight = MeshTri1(placed(*grid), np.hstack([np.stack([a, b, c]), np.stack([a, c, d])]))
    curved = MeshTri2.from_mesh(straight)
    middles = [one[straight.facets].mean(axis=0) for one in grid]
    curved.doflocs[:, curved.dofs.facet_dofs[0]] = placed(*middles)
    return curved


def _highest_wave(wall: Array) -> int:
    """Return the number of the shortest wave with more than 1e-6 of the height."""
    spectrum = np.abs(np.fft.rfft(wall - wall.mean()))
    return int(np.flatnonzero(spectrum > 1e-6 * spectrum.max())[-1]) if spectrum.max() > 0 else 1


def _interpolated(wall: Array, places: Array) -> Array:
    """Return the trigonometric interpolation of a wall at places, in periods."""
    spectrum = np.fft.rfft(wall, norm="forward")
    orders = np.arange(_highest_wave(wall) + 1)
    waves = np.exp(2j * np.pi * orders * places[:, None]) * spectrum[: orders.size]
    return np.asarray((waves.real * np.where(orders > 0, 2, 1)).sum(axis=1))
