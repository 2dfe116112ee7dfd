"""The viscosities of a film of a lubricant that thins with shear, node by node."""

import math
from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.lubricants.shear_thinning import ThinningCurve
from roughfilm.rom.shear_thinning.straight_gap import ShearedGap, thinned_across, thinned_by_flow


def thinned(
    solution: Solution,
    curve: ThinningCurve,
    *,
    viscosity: Array | None = None,
    gap: Array | None = None,
    start: Array | None = None,
) -> ShearedGap:
    """The viscosities by the law of shear thinning at the flows of a film, at its nodes and at the cavitation pressure.

    A film with these viscosities has other flows; the film of the law is the fixed point. With the potential
    W(γ̇) = ∫ τ dγ̇ the step to the next film is one of Kačanov's method: of all profiles with the flows of a film those
    of the law have the least ∫ W, and as η falls with the shear rate, the potential of the film with the frozen η(z) is
    above ∫ W for all other flows and equals it for these. Each step hence lowers the potential of the flows, as long as
    the ends of the film do not move. It multiplies an error by at most 1 - n, which a flow between two reservoirs
    attains. (With the pressure gradients of a film in place of its flows an error would grow by 1/n - 1 there.)

    Over averaged roughness the viscosities are those of a smooth film of the mean gap, with the mean pressure gradient.
    Cavities, without a pressure gradient, are sheared by u/h.

    Parameters
    ----------
    solution : a film, with its own viscosities.
    curve : fluidity over stress.
    viscosity : viscosity η₀ at rest at the nodes and the cavitation pressure, Pa s, shape (nx, ny), such as that at
        their temperatures; by default that of the problem.
    gap : mean gap at the nodes, m, shape (nx, ny); by default the film thickness.
    start : stress of a film near this one on the same grid, shape (nx, ny, 4).

    Returns
    -------
    ShearedGap
        Viscosities of shape (nx, ny), which under the pressure law of the problem are those of the law under pressure,
        and the stress.

    Raises
    ------
    ConvergenceError
        If the stress across the film does not converge at a node.

    Source: Heid and Wihler 2020, Mathematics of Computation 89, 2707, for Kačanov's method and its convergence.
    """
    problem, pressure = solution.problem, solution.state.pressure
    h = solution.faces.thickness if gap is None else gap
    at_rest = np.full(h.shape, problem.viscosity) if viscosity is None else viscosity
    under_pressure = at_rest / problem.piezoviscosity.fluidity(pressure, at_rest)[0]
    found = thinned_by_flow(curve, under_pressure, h, *_moved(solution, h), start)
    own_flow = found.viscosities.flow
    at_cavitation = at_rest * (own_flow / under_pressure) ** _steepness(problem, pressure)
    viscosities = replace(
        found.viscosities, flow=at_cavitation, shear=found.viscosities.shear / own_flow * at_cavitation
    )
    return replace(found, viscosities=viscosities)


def thinned_profiles(
    solution: Solution,
    curve: ThinningCurve,
    viscosity: Array,
    across: tuple[Array, Array],
    *,
    gap: Array | None = None,
    start: Array | None = None,
) -> tuple[Array, Array]:
    """The viscosities by the law of shear thinning at points across a film whose temperature varies across it.

    Parameters
    ----------
    solution : a film, with its own viscosities.
    curve : fluidity over stress.
    viscosity : viscosity η₀ at rest at the points and the cavitation pressure, Pa s, shape (nx, ny, points).
    across : points z/h from the sliding wall, and the weights of a quadrature over 0 to 1 at these points.
    gap : mean gap at the nodes, m, shape (nx, ny); by default the film thickness.
    start : stress of a film near this one on the same grid, shape (nx, ny, 4).

    Returns
    -------
    viscosity, stress
        Viscosity of the shape of ``viscosity``, Pa s, which under the pressure law of the problem is that of the law
        under pressure, and the stress.

    Raises
    ------
    ConvergenceError
        If the stress across the film does not converge at a node.
    """
    h = solution.faces.thickness if gap is None else gap
    pressure = np.broadcast_to(solution.state.pressure[..., None], viscosity.shape)
    under_pressure = viscosity / solution.problem.piezoviscosity.fluidity(pressure, viscosity)[0]
    found, stress = thinned_across(curve, under_pressure, across, h, *_moved(solution, h), start)
    return viscosity * (found / under_pressure) ** _steepness(solution.problem, pressure), stress


def _moved(solution: Solution, h: Array) -> tuple[Array, tuple[Array, Array]]:
    """The speed of the sliding wall, m/s, and the flow of a film less u h/2 along the sliding, m²/s, at its nodes."""
    problem, own = solution.problem, solution.problem.at_nodes
    flow = (problem.viscosity if own is None else own.flow) / problem.fluidity(solution.state.pressure)[0]
    speed = np.broadcast_to(problem.speed * (solution.grid.radius if problem.shape.polar else 1.0), h.shape)
    along, across = pressure_gradient(solution)
    carried = 0.0 if own is None else (own.carried - 1) * speed * h / 2
    return speed, (carried - h**3 / (12 * flow) * along, -(h**3) / (12 * flow) * across)


def pressure_gradient(solution: Solution) -> tuple[Array, Array]:
    """∂p/∂x and ∂p/∂y at the nodes, Pa/m, shape (nx, ny); second-order accurate inside of the film."""
    grid, pressure = solution.grid, solution.state.pressure
    along = _slope(pressure, grid.x, grid.spacing_x) / grid.radius
    across = np.zeros_like(pressure) if grid.y.size == 1 else _slope(pressure.T, grid.y, grid.spacing_y).T
    return along, across


def _slope(values: Array, places: Array, spacing: Array) -> Array:
    """The derivative of values over their first axis, periodic if the last node has a spacing."""
    if spacing[-1] == 0:
        return np.asarray(np.gradient(values, places, axis=0))
    around = np.concatenate([values[-1:], values, values[:1]])
    positions = np.concatenate([[places[0] - spacing[-1]], places, [places[-1] + spacing[-1]]])
    return np.asarray(np.gradient(around, positions, axis=0)[1:-1])


def _steepness(problem: Problem, pressure: Array) -> Array:
    """The derivative d ln η₀/d ln η of the pressure law: η is the viscosity under pressure, η₀ that at cavitation.

    ln η is linear in ln η₀ in every law, so that this number does not depend on η₀.
    """
    law, shape = problem.piezoviscosity, pressure.shape
    first, second = (np.log(law.fluidity(pressure, np.full(shape, one))[0]) for one in (1.0, math.e))
    return np.asarray(1 / (1 - (second - first)))
