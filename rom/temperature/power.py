"""The power that a film turns into heat, and the parts of its flows by sliding and by pressure."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.evaluation.filling import filled_fraction
from roughfilm.rom.cavitation.evaluation.flows import flow_across, flow_along
from roughfilm.rom.cavitation.evaluation.friction import wall_stress
from roughfilm.rom.cavitation.solve import Solution


@dataclass(frozen=True, kw_only=True)
class Carriers:
    """What moves and heats the lubricant of a film, each of shape (nx, ny).

    Attributes
    ----------
    sliding : flow by sliding through the faces towards i + 1, m³/s (m²/s if infinitely wide).
    pressing : the rest of the flow through these faces, m³/s.
    across : flow through the faces towards j + 1, m³/s.
    power : power that the lubricant of the control volumes turns into heat, W (W/m if infinitely wide).
    filling : part of the width that is filled, 1 in the film.
    speed : speed of the wall at the nodes, m/s.
    gradient_x, gradient_y : ∂p/∂x and ∂p/∂y at the nodes over the ratio of viscosities by pressure, Pa/m.
    """

    sliding: Array
    pressing: Array
    across: Array
    power: Array
    filling: Array
    speed: Array
    gradient_x: Array
    gradient_y: Array


def carriers(solution: Solution) -> Carriers:
    """The flows through the faces of a film and the power that becomes heat in its control volumes.

    The power of a face is that of the friction on the sliding wall and what the pressures do on the flow, u F - q Δp;
    each of its two nodes gets half of it. The sum over the film is the power of sliding and of the supply.
    """
    grid, net, state, problem = solution.grid, solution.network, solution.state, solution.problem
    along, across = flow_along(solution), flow_across(solution)
    excess = problem.compression(state.pressure)[0]
    sliding = net.couette * (state.fill + net.upstream * excess + (1 - net.upstream) * np.roll(excess, -1, axis=0))
    if not net.periodic[0]:
        along[-1], sliding[-1] = 0.0, 0.0
    if not net.periodic[1]:
        across[:, -1] = 0.0
    speed = problem.speed * (grid.radius if problem.shape.polar else np.ones_like(grid.radius))
    areas = grid.spacing_x[:, None] * grid.radius * grid.volume_y
    rise_x = np.roll(state.pressure, -1, axis=0) - state.pressure
    rise_y = np.roll(state.pressure, -1, axis=1) - state.pressure
    density = 1 + excess
    along_power = speed * wall_stress(solution) * areas - along * rise_x * 2 / (density + np.roll(density, -1, axis=0))
    across_power = -across * rise_y * 2 / (density + np.roll(density, -1, axis=1))
    power = (along_power + np.roll(along_power, 1, axis=0) + across_power + np.roll(across_power, 1, axis=1)) / 2
    ratio = problem.fluidity(state.pressure)[0]
    return Carriers(
        sliding=sliding,
        pressing=along - sliding,
        across=across,
        power=power,
        filling=np.clip(filled_fraction(solution), LEAST_FILLING, 1.0),
        speed=np.broadcast_to(speed, grid.shape),
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
