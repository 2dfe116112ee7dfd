"""Newton's method on an active set: which nodes are film, what their pressure is, how full the others are."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact.errors import ConvergenceError, Outcome
from rom.cavitation.balance import CAVITY, FILM, FIXED, FLOODED, advance, linearise, settle_inlet
from rom.cavitation.fluid import Fluid
from rom.cavitation.network import Network, State
from rom.gap import Array

LIMIT = 100
"""Steps, at most; from a coarser grid it takes 2 to 6."""


@dataclass(frozen=True)
class Linear:
    """A step of Newton's method: derivatives of every node's balance by its own unknown and those of its neighbours."""

    kind: NDArray[np.int8]
    mobility: Array
    balance: Array
    centre: Array
    west: Array
    east: Array
    south: Array
    north: Array


@dataclass(frozen=True, kw_only=True)
class Settled:
    """A state that balances: ``residual`` is the largest net flow into a node over the largest through a face."""

    state: State
    kind: NDArray[np.int8]
    residual: float
    iterations: int


Step = Callable[[Network, Linear, float], Array]
"""step(network, linear, accuracy): the change of every unknown, shape (nx, ny)."""


def settle(
    network: Network,
    fluid: Fluid,
    start: State,
    step: Step,
    *,
    tolerance: float,
    ruptures: bool = True,
    limit: int = LIMIT,
) -> Settled:
    """Find the state in which every node lets out what flows in, beginning from ``start``.

    Where p > 0 the unknown is p, where ξ < 1 it is ξ; a node changes over where its unknown leaves its range. Without
    ``ruptures`` the film bears any tension.

    Raises
    ------
    ConvergenceError
        If after ``limit`` steps nodes still change over, or the residual stays above the tolerance.
    """
    shape = network.shape
    pressure, fill = start.pressure.copy(), start.fill.copy()
    kind = np.where(fill < 1, np.int8(CAVITY), np.int8(FILM))
    supplied = network.supply is not None
    if supplied:
        pressure[0] = 0
        kind[0] = np.where(fill[0] < 1, CAVITY, FLOODED)
    kind[network.fixed] = FIXED
    pressure = np.where(network.fixed, network.pressure, pressure)
    fill = np.where(kind == CAVITY, fill, 1.0)
    pressure[kind == CAVITY] = 0
    parts = [np.empty(shape) for _ in range(6)]
    balance = parts[0]
    changed, residual = 1, np.inf
    for iteration in range(limit + 1):
        excess, excess_slope = fluid.compression(pressure)
        mobility, mobility_slope = fluid.mobility(pressure)
        largest = linearise(
            network.couette,
            network.upstream,
            network.east,
            network.north,
            network.storage,
            network.stored,
            network.supplied,
            *network.periodic,
            kind,
            pressure,
            fill,
            excess,
            excess_slope,
            mobility,
            mobility_slope,
            *parts,
        )
        if supplied:
            changed += settle_inlet(kind[0], balance[0])
        balance[kind >= FIXED] = 0
        residual = float(np.abs(balance).max()) / (largest or 1.0)
        if not np.isfinite(residual):
            break
        if changed == 0 and residual <= tolerance:
            return Settled(
                state=State(pressure=pressure, fill=fill), kind=kind, residual=residual, iterations=iteration
            )
        change = step(network, Linear(kind, mobility, *parts), tolerance * largest)
        if ruptures:
            changed = advance(kind.reshape(-1), pressure.reshape(-1), fill.reshape(-1), change.reshape(-1))
        else:
            pressure, changed = pressure + change, 0
    raise ConvergenceError(
        f"cavitation: {changed} nodes still change over and residual {residual:.1e} misses the tolerance "
        f"{tolerance:.1e} after {iteration} steps; take more nodes or a smaller change",
        outcome=Outcome.UNFINISHED if np.isfinite(residual) else Outcome.DIVERGED,
        iterations=iteration,
    )
