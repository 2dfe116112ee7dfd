"""The power that a film dissipates, balanced with the power of its sliding wall and of the pressures at its ends."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.evaluation.flows import balances, flow_across, flow_along, node_storage
from roughfilm.rom.cavitation.evaluation.friction import pull_across, pull_along, radius_between
from roughfilm.rom.cavitation.grid import gaps
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import Solution

STILL = 1e-9
"""Flow through a node over the largest flow through a face up to which its lubricant is at rest."""

GAUSS_POINTS = 5
"""Points of the integral of 1/θ over the pressure."""


@dataclass(frozen=True, kw_only=True)
class Flows:
    """The flows of a film, m³/s at cavitation density (m²/s if wide), shape (nx, ny).

    Attributes
    ----------
    along, across : flows through the faces towards i + 1 and j + 1; 0 for the last i or j unless these are periodic.
    entering : flow into a node from outside the film; negative where liquid leaves.
    stored : flow that a node stores where the walls move.
    """

    along: Array
    across: Array
    entering: Array
    stored: Array


def film_flows(solution: Solution, carried_over: float = 1.0) -> Flows:
    """The flows of a film.

    A gap between two films passes on a part of what the one before it discharges (:func:`passed_on`). The rest leaves
    at its first node, and new lubricant enters at its last one: the film thickness in the gap has no effect.

    Parameters
    ----------
    carried_over : largest part of the lubricant that a film discharges into a gap which the gap passes on.
    """
    along, across = flow_along(solution), flow_across(solution)
    for nodes in gaps(solution.problem.shape, solution.grid):
        along[nodes[:-1]] = passed_on(along[nodes[0] - 1], along[nodes[-1]], carried_over)
        across[nodes] = 0.0
    entering = balances(solution, along, across)
    return Flows(along=along, across=across, entering=entering, stored=node_storage(solution))


def passed_on(leaving: Array, entering: Array, carried_over: float) -> Array:
    """The lubricant that leaves a film and enters the next one, min(c Q_out, Q_in), at least 0, m³/s, in its rows.

    Parameters
    ----------
    leaving, entering : flows Q_out out of the film before a gap and Q_in into the one behind it, m³/s, shape (rows,).
    carried_over : c, the part of Q_out that may enter again.
    """
    return np.clip(carried_over * leaving, 0.0, np.maximum(entering, 0.0))


def flowing(solution: Solution) -> NDArray[np.bool_]:
    """Whether lubricant flows through the nodes, shape (nx, ny); at all nodes of a film in which none flows.

    Nodes without a flow, such as corners between edges of one pressure beside a wall at rest, have no temperature of
    the film.
    """
    return passed(film_flows(solution))


def passed(flows: Flows) -> NDArray[np.bool_]:
    """Whether lubricant flows through the nodes, shape (nx, ny), as :func:`flowing`, from the flows of the film."""
    sizes = np.abs(flows.along), np.abs(flows.across)
    through = sum(one + np.roll(one, 1, axis=axis) for axis, one in enumerate(sizes))
    moves = np.asarray(through > STILL * max(float(one.max()) for one in sizes))
    return moves if moves.any() else np.ones_like(moves)


def dissipation(solution: Solution, flows: Flows) -> Array:
    """The power that the film dissipates in the control volumes of its nodes, W (W/m if wide), shape (nx, ny).

    The film of a face gets the power of the sliding wall and what its flow F loses from one node to the next,

        W = u T + F (P_i - P_j),    P = ∫ dp/θ,

    with the force T on the wall. Where the film is full, W is the shear η u²/h and the flow by pressure 12 η q_p²/h³.
    A node has the share η_i/(η_i + η_j) of the power of a face. Summed over the film, the powers are those of the
    friction and of the flows Q into the film, to round-off: Σ W = u Σ T + Σ P Q, less P times what nodes store.
    Second-order accurate. A film that ruptures inside of a face may have W < 0 there.
    """
    problem, grid, net = solution.problem, solution.grid, solution.network
    potential = pressure_potential(problem, solution.state.pressure)
    speed = problem.speed * (grid.radius if problem.shape.polar else 1.0)
    along = speed * grid.volume_y * pull_along(solution)
    along += flows.along * (potential - np.roll(potential, -1, axis=0))
    viscosity = viscosities_under_pressure(solution)
    total = _shared(along, viscosity, axis=0, periodic=net.periodic[0])
    if grid.shape[1] == 1:
        return total
    across = flows.across * (potential - np.roll(potential, -1, axis=1))
    rough = solution.faces.averaged
    if rough is not None:
        towards = radius_between(grid) if problem.shape.polar else 1.0
        across[:, :-1] += problem.speed * towards * pull_across(solution, rough)
    return total + _shared(across, viscosity, axis=1, periodic=net.periodic[1])


def _shared(power: Array, viscosity: Array, *, axis: int, periodic: bool) -> Array:
    """The powers of the faces towards the next node along an axis, divided between their two nodes."""
    if not periodic:
        power[(-1,) if axis == 0 else (slice(None), -1)] = 0.0
    own = power * (viscosity / (viscosity + np.roll(viscosity, -1, axis=axis)))
    return np.asarray(own + np.roll(power - own, 1, axis=axis))


def viscosities_under_pressure(solution: Solution) -> Array:
    """The viscosity of the shear at the nodes under their pressure, Pa s, shape (nx, ny)."""
    problem = solution.problem
    viscosity = problem.viscosity if problem.at_nodes is None else problem.at_nodes.shear
    return np.asarray(viscosity / problem.fluidity(solution.state.pressure)[0])


def pressure_potential(problem: Problem, pressure: Array) -> Array:
    """P = ∫ dp/θ from the cavitation pressure, Pa: the work of the pressure on a volume at cavitation density."""
    if problem.initial_compressibility == 0:
        return pressure
    places, weights = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    points = zip((places + 1) / 2, weights / 2, strict=True)
    return np.asarray(
        sum(weight * pressure / (1 + problem.compression(place * pressure)[0]) for place, weight in points)
    )
