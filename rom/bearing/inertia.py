r"""The change of a converged film by inertia, to first order in the Reynolds number.

With the velocities of the Reynolds equation and the forces C and D of :mod:`roughfilm.rom.thin_film.inertia`, inertia
drives a flow while it changes the pressure by p₁,

    q₁ = -h³/(12η) ∇p₁ - ρ h²/(2η) C,    ∇·(θ q₁ + θ' p₁ q₀) = 0,

and adds the shear stress h/2 ∂p₁/∂x + ρD on the sliding wall. The density is ρθ: C and D are those of the mass ρθh in
place of h, as mass is conserved, and p₁ changes the density θ by θ' p₁, which the flow q₀ without inertia carries.

On a line this is :func:`roughfilm.rom.pocket.closed_form.inertia_pressure_gradient`. In cavities, and at ends and sides
with a prescribed pressure, p₁ = 0: the edges of the film do not move, and entrance losses are left out.
"""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.quantities import load_of, scene_positions
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.balance import CAVITY, FILM
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.thin_film import inertia as terms


@dataclass(frozen=True, kw_only=True)
class Inertia:
    """The changes by inertia.

    Attributes
    ----------
    pressure : p₁ at the nodes, Pa, shape (nx, ny).
    load, friction : changes of load and friction, N (N/m if infinitely wide).
    inlet_flow : change of the flow through the inlet, m³/s (m²/s if infinitely wide).
    """

    pressure: Array
    load: float
    friction: float
    inlet_flow: float


def inertia(scene: Bearing, solution: Solution) -> Inertia:
    """The first-order changes of a converged film by inertia.

    With roughness the velocities are those of a smooth film with the same mean gap, and p₁ drives the flow of the rough
    film without the cross flow of an oblique lay.

    Raises
    ------
    InputError
        Without a density, and on rings, where centrifugal forces act.
    """
    density, shape = scene.lubricant.density, solution.problem.shape
    if density is None:
        raise InputError("scene.lubricant.density: is missing; it is needed to estimate inertia")
    if shape.polar or shape.joined[0]:
        raise InputError("scene.geometry: inertia cannot be estimated on rings, where centrifugal forces act")
    h, problem, grid = solution.faces.thickness, solution.problem, solution.grid
    excess, per_pressure = problem.compression(solution.state.pressure)
    dense = (1 + excess) * h
    own = problem.viscosity if problem.at_nodes is None else problem.at_nodes.flow
    viscosity = own / problem.fluidity(solution.state.pressure)[0]
    speed = problem.speed
    mobility = problem.mobility(solution.state.pressure)[0]
    east, north = solution.network.conductance(mobility)
    wet = solution.kind != CAVITY
    a, b = _excess(solution, east / _behind(1 + excess, 0), north / _behind(1 + excess, 1), wet)
    through_x = terms.momentum_along(dense, a, speed)
    through_xy = terms.momentum_between(dense, a, b, speed)
    through_y = terms.momentum_across(dense, b)
    dx, dy = grid.spacing_x[:-1, None], grid.spacing_y[:-1]
    rise = speed * np.diff(dense, axis=0) / dx
    mean = _means(through_xy, 0)
    x_force = (
        np.diff(through_x, axis=0) / dx
        + _wet_slope(mean, 1, grid.y, _both(wet, 0))
        + rise * _means(terms.slope_along(a, speed), 0)
    )
    drive = -density * _means(dense * h / (2 * viscosity), 0) * x_force * grid.volume_y * _both(wet, 0)
    drive_y = np.zeros((h.shape[0], h.shape[1] - 1))
    if h.shape[1] > 1:
        climb = speed * _slope(dense, 0, grid.x)
        y_force = _wet_slope(_means(through_xy, 1), 0, grid.x, _both(wet, 1)) + np.diff(through_y, axis=1) / dy
        y_force += _means(climb * terms.slope_across(b), 1)
        drive_y = -density * _means(dense * h / (2 * viscosity), 1) * y_force * grid.volume_x[:, None] * _both(wet, 1)
    carried_x = _means(h * (speed / 2 + a), 0) * grid.volume_y * _both(wet, 0)
    carried_y = _means(h * b, 1) * grid.volume_x[:, None] * _both(wet, 1)
    pressure = _balanced(
        solution.kind == FILM, (east[:-1], north[:, :-1]), (carried_x, carried_y), per_pressure, (drive, drive_y)
    )

    flow = drive - east[:-1] * np.diff(pressure, axis=0) + carried_x * _means(per_pressure * pressure, 0)
    shear = np.diff(terms.shear_along(dense, a, speed), axis=0) / dx
    shear += _wet_slope(_means(terms.shear_between(dense, a, b, speed), 0), 1, grid.y, _both(wet, 0))
    shear += rise * _means(terms.shear_slope(a, speed), 0)
    stress = _means(h, 0) / 2 * np.diff(pressure, axis=0) / dx + density * shear * _both(wet, 0)
    x = scene_positions(solution)
    force = grid.areas * (solution.state.pressure + scene.lubricant.cavitation_pressure)
    return Inertia(
        pressure=pressure,
        load=load_of(scene, x, force + grid.areas * pressure) - load_of(scene, x, force),
        friction=float((stress * dx * grid.volume_y).sum()),
        inlet_flow=float(flow[0].sum()),
    )


def _excess(solution: Solution, east: Array, north: Array, wet: NDArray[np.bool_]) -> tuple[Array, Array]:
    """The a and b of the nodes, m/s: mean flow through the adjacent faces over the thickness, minus that of sliding.

    Only faces between two wet nodes count. An edge of the film lies anywhere in the cell between a wet node and a
    cavity, so that the pressure difference over that cell is not the gradient in the film.
    """
    grid, h, pressure = solution.grid, solution.faces.thickness, solution.state.pressure
    along = (solution.network.couette[:-1] - east[:-1] * np.diff(pressure, axis=0)) / grid.volume_y
    known = _both(wet, 0)
    sliding = np.where(_node_means(np.ones_like(along), known, 0) > 0, solution.problem.speed / 2, 0.0)
    a = _node_means(along, known, 0) / h - sliding
    if h.shape[1] == 1:
        return a, np.zeros_like(a)
    across = -north[:, :-1] * np.diff(pressure, axis=1) / grid.volume_x[:, None]
    b = _node_means(across, _both(wet, 1), 1) / h
    if solution.problem.ends.sides is None:
        b[:, [0, -1]] = 0.0
    return a, b


def _node_means(values: Array, counted: NDArray[np.bool_], axis: int) -> Array:
    """The mean over those of the faces before and behind each node that are counted, zero where there is none."""
    ends = [(1, 1) if axis == number else (0, 0) for number in range(2)]
    padded, weights = np.pad(np.where(counted, values, 0.0), ends), np.pad(counted.astype(float), ends)
    number = 2 * _means(weights, axis)
    return np.asarray(2 * _means(padded, axis) / np.maximum(number, 1.0))


def _behind(values: Array, axis: int) -> Array:
    """The mean of the values at each node and at the next one along an axis, of the same shape."""
    return np.asarray((values + np.roll(values, -1, axis=axis)) / 2)


def _balanced(
    free: NDArray[np.bool_],
    conductances: tuple[Array, Array],
    carried: tuple[Array, Array],
    per_pressure: Array,
    drives: tuple[Array, Array],
) -> Array:
    """The pressure at free nodes, zero elsewhere, whose flow balances the driven flow at each of them.

    Each argument of two arrays has the faces towards i + 1 and j + 1. The density θ' p₁, with θ' = ``per_pressure`` at
    the nodes, is carried by the flow without inertia, m³/s.
    """
    (drive_x, drive_y), number = drives, np.full(free.shape, -1)
    number[free] = np.arange(free.sum())
    into = np.zeros(free.shape)
    into[:-1] -= drive_x
    into[1:] += drive_x
    into[:, :-1] -= drive_y
    into[:, 1:] += drive_y
    rows, columns, values = [], [], []
    along, across = (slice(None, -1), slice(None)), (slice(None), slice(None, -1))
    behind = (slice(1, None), slice(None)), (slice(None), slice(1, None))
    for begin, end, conductance, flow in zip((along, across), behind, conductances, carried, strict=True):
        for near, far, out in ((begin, end, flow), (end, begin, -flow)):
            here, there = number[near], number[far]
            known, both = here >= 0, (here >= 0) & (there >= 0)
            rows += [here[known], here[both]]
            columns += [here[known], there[both]]
            values += [(conductance + out / 2 * per_pressure[near])[known]]
            values += [(-conductance + out / 2 * per_pressure[far])[both]]
    size = int(free.sum())
    solution = np.zeros(free.shape)
    if size:
        entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
        solution[free] = scipy.sparse.linalg.spsolve(
            scipy.sparse.csc_array(scipy.sparse.coo_array(entries, shape=(size, size))), into[free]
        )
    return solution


def _slope(values: Array, axis: int, places: Array) -> Array:
    """The derivative at the nodes; zero with a single node."""
    if values.shape[axis] == 1:
        return np.zeros_like(values)
    return np.asarray(np.gradient(values, places, axis=axis))


def _wet_slope(values: Array, axis: int, places: Array, wet: NDArray[np.bool_]) -> Array:
    """The derivative, one-sided next to a place that is not wet, and zero between two of them."""
    if values.shape[axis] == 1:
        return np.zeros_like(values)
    moved, counted = np.moveaxis(values, axis, 0), np.moveaxis(wet, axis, 0)
    steps, both = np.diff(moved, axis=0) / np.diff(places)[:, None], counted[1:] & counted[:-1]
    before, behind = np.zeros(counted.shape, dtype=bool), np.zeros(counted.shape, dtype=bool)
    before[1:], behind[:-1] = both, both
    one_sided = np.moveaxis(_node_means(steps, both, 0), 0, axis)
    return np.where(np.moveaxis(before & behind, 0, axis), _slope(values, axis, places), one_sided)


def _means(values: Array, axis: int) -> Array:
    """The mean values on the faces between the nodes."""
    moved = np.moveaxis(values, axis, 0)
    return np.moveaxis((moved[1:] + moved[:-1]) / 2, 0, axis)


def _both(values: NDArray[np.bool_], axis: int) -> NDArray[np.bool_]:
    """Whether the nodes on both sides of each face are true."""
    moved = np.moveaxis(values, axis, 0)
    return np.moveaxis(moved[1:] & moved[:-1], 0, axis)
