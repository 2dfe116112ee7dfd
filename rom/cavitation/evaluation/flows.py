"""The flows through the faces of a film."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.solve import Solution

IMBALANCE_FACTOR = 10.0
"""Relative error of a quantity over the relative error of the flow along the film."""


def flow_along(solution: Solution) -> Array:
    """The flow through the faces towards i + 1 at cavitation density, m³/s (m²/s if wide), shape (nx, ny)."""
    net, state = solution.network, solution.state
    excess = solution.problem.compression(state.pressure)[0]
    mobility = solution.problem.mobility(state.pressure)[0]
    east = net.conductance(mobility)[0]
    ahead = np.roll(excess, -1, axis=0)
    drift = net.couette * (state.fill + net.upstream * excess + (1 - net.upstream) * ahead)
    rise = np.roll(state.pressure, -1, axis=0) - state.pressure
    flow = net.least_flow(drift - east * rise, state, excess, mobility)
    return np.asarray(flow + (0.0 if net.oblique is None else _oblique_flows(solution)[0]))


def _oblique_flows(solution: Solution) -> tuple[Array, Array]:
    """The additional flows of an oblique lay towards i + 1 and j + 1, m³/s."""
    assert solution.network.oblique is not None
    state, problem = solution.state, solution.problem
    excess, mobility = problem.compression(state.pressure)[0], problem.mobility(state.pressure)[0]
    return solution.network.oblique.flows(mobility, state.pressure, state.fill, excess)


def flow_across(solution: Solution) -> Array:
    """The flow through the faces towards j + 1 at cavitation density, m³/s, shape (nx, ny); zero for the last j."""
    net, state = solution.network, solution.state
    north = net.conductance(solution.problem.mobility(state.pressure)[0])[1]
    flow = -north * (np.roll(state.pressure, -1, axis=1) - state.pressure)
    return np.asarray(flow if net.oblique is None else flow + _oblique_flows(solution)[1])


def node_storage(solution: Solution) -> Array:
    """The flow that the nodes store where the walls move, m³/s at cavitation density, shape (nx, ny)."""
    net, excess = solution.network, solution.problem.compression(solution.state.pressure)[0]
    return np.asarray(net.storage * (solution.state.fill + excess) - net.stored)


def node_balances(solution: Solution) -> Array:
    """Outflow minus inflow of every node with what it stores, m³/s: at a fixed node what enters from outside."""
    return balances(solution, flow_along(solution), flow_across(solution))


def balances(solution: Solution, along: Array, across: Array) -> Array:
    """The balances of the nodes with flows through the faces, m³/s; sets those behind the last nodes to 0."""
    net = solution.network
    if not net.periodic[0]:
        along[-1] = 0.0
    if not net.periodic[1]:
        across[:, -1] = 0.0
    outflow = along - np.roll(along, 1, axis=0) + across - np.roll(across, 1, axis=1)
    return np.asarray(outflow + node_storage(solution))
