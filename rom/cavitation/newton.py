"""Newton's method on an active set: film nodes with their pressure, cavity nodes with their filling fraction."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED, FLOODED, advance, settle_bank
from roughfilm.rom.cavitation.fluid import Fluid
from roughfilm.rom.cavitation.network import Network, State
from roughfilm.rom.cavitation.relaxation import relaxed
from roughfilm.rom.parts.allowance import spend

FIRST_ROUND_STEPS = 25
"""Largest number of Newton steps in the first round; from a good start 1 to 6 suffice. It doubles every round."""

ROUNDS = 5
"""Largest number of rounds of relaxation and Newton's method."""

FEW_ROUNDS = 3
"""The same of a film that only shows what another one may be: its last rounds take nine tenths of the time."""

DIVERGED_ROUNDS = 2
"""Number of rounds whose numbers are not finite after which further sweeps are of no use."""

_rounds: ContextVar[int] = ContextVar("_rounds", default=ROUNDS)


@contextmanager
def few_rounds() -> Iterator[None]:
    """Give up films early that do not converge in the block, as those of an estimate, which has another way."""
    before = _rounds.set(FEW_ROUNDS)
    try:
        yield
    finally:
        _rounds.reset(before)


SWEEPS_AFTER_STEP = 2
"""Relaxation sweeps after a Newton step in the plane that changed the kind of a node.

A step moves the boundary of a film by about one node; the sweeps move the rest of the boundary with it. They follow a
step only if it changed fewer nodes than all before, since steps and sweeps may otherwise move nodes to and fro.
"""

MOVING_REDUCTIONS = (1e-2, 1e-3)
"""Reduction of the residual by the linear solver in the first Newton step and in others, after changes of kinds.

The residual after such a step comes from nodes that change their kind, so that more accuracy has no use.
"""

STEP_REDUCTION = 1e-4
"""Largest reduction in the last step. A small residual may belong to a large error of the pressure elsewhere."""

SWEEPS_RATIO = 4
"""Ratio of the relaxation sweeps of two successive rounds."""

BALANCE_ROUNDOFF = 8 * float(np.finfo(float).eps)
"""Round-off of a node's balance relative to the flow that its pressure drives out."""


@dataclass(frozen=True)
class Linear:
    """The linear system of a Newton step: every balance and its derivatives by the unknowns around it."""

    kind: NDArray[np.int8]
    mobility: Array
    balance: Array
    centre: Array
    west: Array
    east: Array
    south: Array
    north: Array

    def image(self, values: Array) -> Array:
        """The derivatives of the balances times changes of the unknowns, shape (nx, ny)."""
        along = self.west * np.roll(values, 1, axis=0) + self.east * np.roll(values, -1, axis=0)
        across = self.south * np.roll(values, 1, axis=1) + self.north * np.roll(values, -1, axis=1)
        return np.asarray(self.centre * values + along + across)

    def adjoint(self, values: Array) -> Array:
        """The transposed derivatives of the balances times values at the nodes, shape (nx, ny)."""
        along = np.roll(self.west * values, -1, axis=0) + np.roll(self.east * values, 1, axis=0)
        across = np.roll(self.south * values, -1, axis=1) + np.roll(self.north * values, 1, axis=1)
        return np.asarray(self.centre * values + along + across)


@dataclass(frozen=True, kw_only=True)
class Settled:
    """A converged state; ``residual`` is the largest net flow into a node over the largest flow through a face.

    ``imbalance`` is the net flow into all nodes before a position along x, the largest over the positions of its mean
    over the rows, over the same flow: the relative error of the flow along the film. Both exceed the tolerance where
    round-off of the pressures prevents a better balance, for example at rest over deep pockets.
    """

    state: State
    kind: NDArray[np.int8]
    residual: float
    imbalance: float
    iterations: int


Step = Callable[[Network, Linear, float], Array]
"""step(network, linear, accuracy): the change of every unknown, shape (nx, ny).

``accuracy`` is the Euclidean norm of the linear residual at which an iterative solver stops, m³/s.
"""


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
    """The state in which inflow equals outflow at every node, from a start ``start``.

    The unknown is p where p > 0, and ξ where ξ < 1; a node changes its kind when its unknown leaves that range.
    Relaxation sweeps come first, and more of them if Newton's method does not converge. Without ``ruptures`` the
    pressure may be negative.

    Raises
    ------
    UnsettledError
        If the residual stays above the tolerance; the error holds the relaxed state.
    """
    state, rounds, iterations, diverged = start, _rounds.get() if ruptures else 1, 0, 0
    failed = ConvergenceError("")
    for number in range(rounds):
        spend(state.fill.size)
        before = state
        if ruptures:
            state = relaxed(network, fluid, state, sweeps * SWEEPS_RATIO**number)
        moved = bool(((state.fill < 1) != (before.fill < 1)).any())
        try:
            settled = newton(
                network,
                fluid,
                state,
                step,
                tolerance=tolerance,
                limit=FIRST_ROUND_STEPS * 2**number,
                ruptures=ruptures,
                moved=moved,
            )
        except ConvergenceError as error:
            iterations, failed = iterations + (error.iterations or 0), error
            diverged += error.outcome is Outcome.DIVERGED
            if diverged == DIVERGED_ROUNDS:
                break
        else:
            return replace(settled, iterations=iterations + settled.iterations)
    raise UnsettledError(str(failed), outcome=failed.outcome, state=state, iterations=iterations)


class UnsettledError(ConvergenceError):
    """No converged state was found; ``state`` is the result of relaxation."""

    def __init__(self, message: str, *, outcome: Outcome, state: State, iterations: int) -> None:
        super().__init__(message, outcome=outcome, iterations=iterations)
        self.state = state


def newton(
    network: Network,
    fluid: Fluid,
    start: State,
    step: Step,
    *,
    tolerance: float,
    limit: int,
    ruptures: bool,
    moved: bool,
) -> Settled:
    """The state after one round of Newton's method; ConvergenceError after ``limit`` steps or on overflow.

    ``moved`` is whether nodes changed their kind on the way to the start.
    """
    pressure, fill, kind = _begun(network, start)
    parts = [np.empty(network.shape) for _ in range(6)]
    balance = parts[0]
    changed, fewest, residual, before, reduction = int(moved), np.inf, np.inf, np.inf, 0.0
    relaxes = ruptures and network.shape[1] > 1 and network.oblique is None and not network.storage.any()
    for iteration in range(limit + 1):
        mobility = fluid.mobility(pressure)
        largest = network.linearise(kind, pressure, fill, (*fluid.compression(pressure), *mobility), parts)
        for bank, rest in zip(network.banks(kind), network.banks(balance), strict=True):
            settle_bank(bank, rest)
        balance[kind >= FIXED] = 0
        before, residual = residual, float(np.abs(balance).max()) / (largest or 1.0)
        if not np.isfinite(residual):
            break
        settled = residual <= tolerance and reduction <= STEP_REDUCTION
        if settled or _rounded(balance, parts[1] * pressure, tolerance * largest):
            state = State(pressure=pressure, fill=fill)
            imbalance = float(np.abs(np.cumsum(balance, axis=0)).mean(axis=1).max()) / (largest or 1.0)
            return Settled(state=state, kind=kind, residual=residual, imbalance=imbalance, iterations=iteration)
        if changed:
            reduction = MOVING_REDUCTIONS[min(iteration, 1)]
        else:
            reduction = min(STEP_REDUCTION, 0.1 * (residual / before) ** 2) if iteration else STEP_REDUCTION
        accuracy = max(0.1 * tolerance * largest, reduction * float(np.sqrt((balance * balance).sum())))
        spend(kind.size)
        change = step(network, Linear(kind, mobility[0], *parts), accuracy)
        if ruptures:
            changed = advance(kind.reshape(-1), pressure.reshape(-1), fill.reshape(-1), change.reshape(-1))
            if relaxes and 0 < changed < fewest:
                fewest = changed
                again = relaxed(network, fluid, State(pressure=pressure, fill=fill), SWEEPS_AFTER_STEP)
                pressure, fill, kind = _begun(network, again)
        else:
            pressure = pressure + change
    finite = np.isfinite(residual)
    reason = (
        f"the residual of {residual:.1e} misses the tolerance of {tolerance:.1e}, {changed} nodes still change between "
        "film and cavity; take more cells"
        if finite
        else "the pressures diverge, and this lubricant may have no solution; take another viscosity or density law"
    )
    outcome = Outcome.UNFINISHED if finite else Outcome.DIVERGED
    raise ConvergenceError(f"cavitation: {reason}", outcome=outcome, iterations=iteration)


def _rounded(balance: Array, driven: Array, least: float) -> bool:
    """Whether every node balances to ``least`` or to the round-off of its pressure."""
    return not (np.abs(balance) > np.maximum(least, BALANCE_ROUNDOFF * np.abs(driven))).any()


def _begun(network: Network, start: State) -> tuple[Array, Array, NDArray[np.int8]]:
    """Pressure, filling fraction and kind of every node at the start."""
    kind = np.where(start.fill < 1, np.int8(CAVITY), np.int8(FILM))
    for bank, fill in zip(network.banks(kind), network.banks(start.fill), strict=True):
        bank[:] = np.where(fill < 1, CAVITY, FLOODED)
    kind[network.fixed] = FIXED
    pressure = np.where(network.fixed, network.pressure, np.where(kind == FILM, start.pressure, 0.0))
    return pressure, np.where(kind == CAVITY, start.fill, 1.0), kind
