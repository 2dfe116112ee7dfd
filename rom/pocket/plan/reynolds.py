"""The Reynolds equation over a cell in plan by finite volumes."""

import time

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.timing import working_time
from roughfilm.rom.ladder.model import Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Numerics, Result
from roughfilm.rom.pocket.plan.grid import PlanGrid, plan_grid
from roughfilm.rom.pocket.plan.quantities import OnSlidingWall, plan_fields, plan_quantities
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.warnings import cautions, ruptures


def flows(grid: PlanGrid, pressure: Array) -> tuple[Array, Array]:
    """The flow per width through the faces towards greater x and y, in speed times film, shape (nx, ny).

        q = h/2 e_x - h³/12 ∇p,

    with pressure in η u / film, periodic.
    """
    dx, dy = grid.steps
    along = grid.east / 2 - grid.east**3 / 12 * (np.roll(pressure, -1, axis=0) - pressure) / dx
    across = -(grid.north**3) / 12 * (np.roll(pressure, -1, axis=1) - pressure) / dy
    return along, across


def imbalance(grid: PlanGrid, pressure: Array) -> Array:
    """The flow out of each column, shape (nx, ny)."""
    dx, dy = grid.steps
    along, across = flows(grid, pressure)
    return np.asarray((along - np.roll(along, 1, axis=0)) * dy + (across - np.roll(across, 1, axis=1)) * dx)


def pressure_of(grid: PlanGrid) -> Array:
    """The periodic pressure whose flows balance, zero in the first column, shape (nx, ny)."""
    shape, (dx, dy) = grid.thickness.shape, grid.steps
    number = np.arange(grid.thickness.size).reshape(shape)
    rows, columns, values = [], [], []
    pairs = (
        (np.roll(number, -1, axis=0), grid.east**3 / 12 * dy / dx),
        (np.roll(number, -1, axis=1), grid.north**3 / 12 * dx / dy),
    )
    for other, conductance in pairs:
        for here, there in ((number, other), (other, number)):
            rows += [here, here]
            columns += [here, there]
            values += [conductance, -conductance]
    entries = np.concatenate([one.ravel() for one in values])
    places = tuple(np.concatenate([one.ravel() for one in ones]) for ones in (rows, columns))
    matrix = scipy.sparse.csc_array(scipy.sparse.coo_array((entries, places)))[1:, 1:]
    into = -imbalance(grid, np.zeros(shape)).ravel()[1:]
    return np.concatenate([[0.0], scipy.sparse.linalg.spsolve(matrix, into)]).reshape(shape)


def solve(solver: Model[Pocket], scene: Pocket, request: CheckedRequest, progress: Progress) -> Result:
    """Solve ∇·(h³/12 ∇p) = 1/2 ∂h/∂x over a periodic cell, in film thicknesses and η u / film.

    The error is of second order in the length of a column.
    """
    wall, cpu = time.perf_counter(), working_time()
    progress(0.0, f"{request.resolution} columns along the cell")
    grid = plan_grid(scene.plan(), request.resolution)
    pressure = pressure_of(grid)
    dx, dy = grid.steps
    along, _ = flows(grid, pressure)
    residual = float(np.abs(imbalance(grid, pressure)).max() / (np.abs(along).max() * dy))
    h = grid.thickness
    slope = (np.roll(pressure, -1, axis=0) - np.roll(pressure, 1, axis=0)) / (2 * dx)
    on_wall = OnSlidingWall(x=grid.x, y=grid.y, thickness=h, pressure=pressure, shear_stress=1 / h + h / 2 * slope)
    steepness = np.minimum(1 - h**2 / 2 * slope, 0.0)  # of the velocity at the fixed wall, times h
    backflow = float((steepness**2 / (4 * (1 - steepness))).max())
    lowest = float(pressure.min()) - on_wall.edge_mean
    return Result(
        model=solver.name,
        quantities=plan_quantities(scene, on_wall, backflow=backflow),
        fields=plan_fields(scene, on_wall),
        provenance=provenance(scene, model=solver.name, keeps=tuple(solver.keeps), sources=solver.sources),
        numerics=Numerics(
            residual=residual,
            iterations=1,
            cpu_s=working_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=pressure.size,
            resolution=request.resolution,
            tolerance=request.tolerance,
            scheme=request.scheme,
        ),
        warnings=(*cautions(scene), *ruptures(scene, lowest)),
    )
