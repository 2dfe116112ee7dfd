"""Newton's method on an active set: which nodes are film, what their pressure is, how full the others are."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED, FLOODED, advance, settle_bank
from roughfilm.rom.cavitation.fluid import Fluid
from roughfilm.rom.cavitation.network import Network, State
from roughfilm.rom.cavitation.relaxation import relaxed

STEPS = 25
"""Of Newton's method in the first round, at most; from a good start it takes 1 to 6."""

ROUNDS, MORE = 5, 4
"""Where a round fails, so many times as many sweeps of relaxation go before the next one, of twice as many steps."""


ROUNDING = 8 * float(np.finfo(float).eps)
"""Of what pressure drives out of a node: nodes are not known to balance better."""


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
    """A state that balances: ``residual`` is the largest net flow into a node over the largest through a face.

    It is above the tolerance where pressures have no digits left to balance better, as at rest over deep pockets.
    """

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
    sweeps: int,
    tolerance: float,
    ruptures: bool = True,
) -> Settled:
    """Find the state in which every node lets out what flows in, beginning from ``start``.

    Where p > 0 the unknown is p, where ξ < 1 it is ξ; a node changes over where its unknown leaves its range. Some
    sweeps of relaxation go first, and more of them where Newton's method runs in circles. Without ``ruptures`` the film
    bears any tension.

    Raises
    ------
    UnsettledError
        If the residual stays above the tolerance; it holds the relaxed state.
    """
    state, rounds, iterations = start, ROUNDS if ruptures else 1, 0
    failed = ConvergenceError("")
    for number in range(rounds):
        if ruptures:
            state = relaxed(network, fluid, state, sweeps * MORE**number)
        try:
            found = newton(network, fluid, state, step, tolerance=tolerance, limit=STEPS * 2**number, ruptures=ruptures)
        except ConvergenceError as error:
            iterations, failed = iterations + (error.iterations or 0), error
        else:
            return replace(found, iterations=iterations + found.iterations)
    raise UnsettledError(str(failed), outcome=failed.outcome, state=state, iterations=iterations)


class UnsettledError(ConvergenceError):
    """No state balances that could be found; ``state`` is as near as relaxation comes."""

    def __init__(self, message: str, *, outcome: Outcome, state: State, iterations: int) -> None:
        super().__init__(message, outcome=outcome, iterations=iterations)
        self.state = state


def newton(
    network: Network, fluid: Fluid, start: State, step: Step, *, tolerance: float, limit: int, ruptures: bool
) -> Settled:
    """One round of Newton's method; raises ConvergenceError after ``limit`` steps, or where numbers overflow."""
    pressure, fill, kind = _begun(network, start)
    parts = [np.empty(network.shape) for _ in range(6)]
    balance = parts[0]
    changed, residual = 0, np.inf
    for iteration in range(limit + 1):
        mobility = fluid.mobility(pressure)
        largest = network.linearise(kind, pressure, fill, (*fluid.compression(pressure), *mobility), parts)
        for bank, rest in zip(network.banks(kind), network.banks(balance), strict=True):
            settle_bank(bank, rest)
        balance[kind >= FIXED] = 0
        residual = float(np.abs(balance).max()) / (largest or 1.0)
        if not np.isfinite(residual):
            break
        if residual <= tolerance or _rounded(balance, parts[1] * pressure, tolerance * largest):
            state = State(pressure=pressure, fill=fill)
            return Settled(state=state, kind=kind, residual=residual, iterations=iteration)
        change = step(network, Linear(kind, mobility[0], *parts), tolerance * largest)
        if ruptures:
            changed = advance(kind.reshape(-1), pressure.reshape(-1), fill.reshape(-1), change.reshape(-1))
        else:
            pressure = pressure + change
    finite = np.isfinite(residual)
    told = (
        f"the residual of {residual:.1e} misses the tolerance of {tolerance:.1e}, {changed} nodes still change between "
        "film and cavity; take more cells"
        if finite
        else "pressures grow beyond all bounds: no film of such a lubricant may exist; take a law that bears them"
    )
    outcome = Outcome.UNFINISHED if finite else Outcome.DIVERGED
    raise ConvergenceError(f"cavitation: {told}", outcome=outcome, iterations=iteration)


def _rounded(balance: Array, driven: Array, least: float) -> bool:
    """Whether every node balances as well as the digits of its pressure let it, or to ``least``."""
    return not (np.abs(balance) > np.maximum(least, ROUNDING * np.abs(driven))).any()


def _begun(network: Network, start: State) -> tuple[Array, Array, NDArray[np.int8]]:
    """Pressure, filled part and kind of every node, as ``start`` has them."""
    kind = np.where(start.fill < 1, np.int8(CAVITY), np.int8(FILM))
    for bank, fill in zip(network.banks(kind), network.banks(start.fill), strict=True):
        bank[:] = np.where(fill < 1, CAVITY, FLOODED)
    kind[network.fixed] = FIXED
    pressure = np.where(network.fixed, network.pressure, np.where(kind == FILM, start.pressure, 0.0))
    return pressure, np.where(kind == CAVITY, start.fill, 1.0), kind
