"""The parts of the flows of a film by sliding and by pressure, and the power that becomes heat."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.evaluation.filling import filled_fraction
from roughfilm.rom.cavitation.grid import gaps
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.temperature.dissipation import dissipation, film_flows, passed


@dataclass(frozen=True, kw_only=True)
class Carriers:
    """What moves and heats the lubricant of a film, each of shape (nx, ny).

    Attributes
    ----------
    sliding : flow by sliding through the faces towards i + 1, m³/s (m²/s if infinitely wide).
    pressing : the rest of the flow through them, m³/s.
    across : flow through the faces towards j + 1, m³/s.
    fluid_power : power that the lubricant of the control volumes turns into heat, over the viscosity η_s of its shear,
        W/(Pa s); the flows are those of the film whatever its viscosity is.
    added : further power that heats the lubricant, W, with the same profile across the film.
    filling : part of the width that is filled, 1 in the film.
    speed : speed of the wall at the nodes, m/s.
    flowing : whether lubricant flows through the nodes; True for all nodes of a film in which none flows.
    gradient_x, gradient_y : ∂p/∂x and ∂p/∂y at the nodes over the ratio of viscosities by pressure, Pa/m.
    """

    sliding: Array
    pressing: Array
    across: Array
    fluid_power: Array
    added: Array
    filling: Array
    speed: Array
    flowing: NDArray[np.bool_]
    gradient_x: Array
    gradient_y: Array


def carriers(solution: Solution, carried_over: float = 1.0) -> Carriers:
    """The flows through the faces of a film, its power, and the gradients that shape both across the film.

    What a gap between two films passes on has the profile of flow by sliding.

    Parameters
    ----------
    carried_over : part of the lubricant that a film discharges into a gap which enters the next one at most.
    """
    grid, net, state, problem = solution.grid, solution.network, solution.state, solution.problem
    flows = film_flows(solution, carried_over)
    excess = problem.compression(state.pressure)[0]
    sliding = net.couette * (state.fill + net.upstream * excess + (1 - net.upstream) * np.roll(excess, -1, axis=0))
    if not net.periodic[0]:
        sliding[-1] = 0.0
    for nodes in gaps(problem.shape, grid):
        sliding[nodes[:-1]] = flows.along[nodes[:-1]]
    speed = problem.speed * (grid.radius if problem.shape.polar else np.ones_like(grid.radius))
    rise_x = np.roll(state.pressure, -1, axis=0) - state.pressure
    rise_y = np.roll(state.pressure, -1, axis=1) - state.pressure
    ratio = problem.fluidity(state.pressure)[0]
    own = problem.viscosity if problem.at_nodes is None else problem.at_nodes.shear
    return Carriers(
        sliding=sliding,
        pressing=flows.along - sliding,
        across=flows.across,
        fluid_power=dissipation(solution, flows) / own,
        added=np.zeros(grid.shape),
        filling=np.clip(filled_fraction(solution), LEAST_FILLING, 1.0),
        speed=np.broadcast_to(speed, grid.shape),
        flowing=passed(flows),
        gradient_x=ratio * _slope(rise_x, grid.spacing_x[:, None] * grid.radius, 0),
        gradient_y=ratio * _slope(rise_y, np.broadcast_to(grid.spacing_y, grid.shape), 1),
    )


LEAST_FILLING = 1e-6
"""Least filled part of a cavity, which keeps the equation of an empty place regular."""


def _slope(rise: Array, lengths: Array, axis: int) -> Array:
    """The slope at the nodes, the mean of those of the faces on both sides, weighted by their lengths."""
    inside = np.where(lengths > 0, rise, 0.0)
    total = lengths + np.roll(lengths, 1, axis=axis)
    both = inside + np.roll(inside, 1, axis=axis)
    return np.asarray(np.divide(both, total, out=np.zeros_like(rise), where=total > 0))
