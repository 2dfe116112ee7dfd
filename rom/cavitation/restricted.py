"""Films that are fed behind restrictors, whose pressures in the film are sought."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.balance import FILM, FIXED
from roughfilm.rom.cavitation.fluid import Fluid
from roughfilm.rom.cavitation.network import Network, State
from roughfilm.rom.cavitation.newton import Linear, Settled, Step
from roughfilm.rom.cavitation.problem import Inflow

Nodes = NDArray[np.bool_]

ITERATIONS = 30
"""Largest number of films with other pressures behind the restrictors."""

FALL = 0.5
"""Ratio of successive differences of flows above which they no longer fall, but have the size of the residuals."""

INNER_ITERATIONS = 200
"""Largest number of Newton steps for the pressures at which given linear flows pass the restrictors."""

INNER_TOLERANCE = 1e-13
"""Relative change of a pressure at which these steps stop."""

ROUND_OFF = 64 * float(np.finfo(float).eps)
"""Round-off of a flow over those that its pressures drive, where a film is so thin that both pressures are equal."""

RESPONSE_ACCURACY = 1e-3
"""Residual of a response to a pressure behind a restrictor, over the norm of its source."""

LOWERED = 0.1
"""Factor of a pressure above cavitation pressure in a step that would take it below."""

EMPTY = 1e-6
"""Pressure behind a restrictor over the largest one of the supplies below which the film empties its supply."""


def first_pressures(inflows: tuple[Inflow, ...], covered: tuple[Nodes, ...], start: State | None) -> Array:
    """The pressures of the inflows in the film from which an iteration starts: those of a state, or of the supplies."""
    given = np.array([one.pressure if one.restrictor is None else one.pressure / 2 for one in inflows])
    if start is None:
        return given
    free = np.array([one.restrictor is not None for one in inflows])
    return np.where(free, [float(start.pressure[nodes].mean()) for nodes in covered], given)


def fed(
    network: Network,
    fluid: Fluid,
    inflows: tuple[Inflow, ...],
    covered: tuple[Nodes, ...],
    settled: Callable[[State | None], Settled],
    step: Step,
    pressures: Array,
    *,
    tolerance: float,
    ruptures: bool,
) -> Settled:
    """The film in which what passes each restrictor enters the film.

    The flows Q into the film change almost linearly with the pressures p behind the restrictors. Each iteration solves
    the film, its derivatives D = ∂Q/∂p by Newton's matrix, and then Q + D (p₊ - p) = R(p_s - p₊) with the flows R of
    the restrictors.

    Parameters
    ----------
    network : the film, in which this function sets the pressures of the inflows.
    covered : the nodes of each inflow.
    settled : settled(start), the film with the pressures of the network, from a start or without one.
    step : the linear solver.
    pressures : the pressures of the inflows in the film from which the iteration starts, Pa.

    Raises
    ------
    ConvergenceError
        If a film or the pressures do not converge, or a film takes in more than a restrictor passes.
    """
    free = [number for number, one in enumerate(inflows) if one.restrictor is not None]
    pressures = pressures.copy()
    for nodes, pressure in zip(covered, pressures, strict=True):
        network.fixed[nodes], network.pressure[nodes] = True, pressure
    found, wrong = settled(None), np.inf
    steps = found.iterations
    for iteration in range(ITERATIONS if free else 0):
        flows, slopes, largest, rest = _flows(network, fluid, found, [covered[number] for number in free], step)
        passed, steepness = _passed(inflows, free, pressures[free])
        before, wrong = wrong, float(np.abs(flows - passed).max()) / largest
        drops = np.maximum([abs(inflows[number].pressure) for number in free], np.abs(pressures[free]))
        rounded = (np.abs(flows - passed) <= ROUND_OFF * (steepness + np.abs(slopes).sum(axis=1)) * drops).all()
        if wrong <= tolerance or rounded or (wrong > FALL * before and wrong <= rest / largest):
            return replace(found, residual=max(found.residual, wrong), iterations=steps)
        if iteration == ITERATIONS - 1:
            break
        pressures[free] = _balanced(inflows, free, flows, slopes, pressures[free], ruptures=ruptures)
        for number in free:
            network.pressure[covered[number]] = pressures[number]
        found = settled(found.state)
        steps += found.iterations
    if not free:
        return found
    lowest = int(np.argmin(pressures[free]))
    scale = max(float(np.abs(found.state.pressure).max()), *(one.pressure for one in inflows))
    if ruptures and pressures[free][lowest] <= EMPTY * scale:
        raise ConvergenceError(
            f"supply.{free[lowest]}: the film takes in more than the restrictor passes, and its pressure falls to "
            "that of cavitation; raise the pressure of the supply or widen the restrictor",
            outcome=Outcome.STALLED,
            iterations=ITERATIONS,
        )
    raise ConvergenceError(
        f"supply: the flows through the restrictors differ by {wrong:.1e} of the largest flow from those into the film "
        f"after {ITERATIONS} films; take more cells",
        outcome=Outcome.UNFINISHED,
        iterations=ITERATIONS,
    )


def _flows(
    network: Network, fluid: Fluid, found: Settled, covered: list[Nodes], step: Step
) -> tuple[Array, Array, float, float]:
    """The flows into the film from restrictors, m³/s, their derivatives by the pressures, and two further flows, m³/s.

    The latter are the largest flow through a face and the sum of the sizes of all balances of nodes with an unknown.
    """
    state, kind = found.state, found.kind
    within = kind.copy()
    for nodes in covered:
        within[nodes] = FILM
    parts = [np.empty(network.shape) for _ in range(6)]
    mobility = fluid.mobility(state.pressure)
    laws = (*fluid.compression(state.pressure), *mobility)
    largest = network.linearise(within, state.pressure, state.fill, laws, parts) or 1.0
    linear = Linear(kind, mobility[0], *parts)
    known = kind >= FIXED
    flows = np.array([float(linear.balance[nodes].sum()) for nodes in covered])
    slopes = np.empty((len(covered), len(covered)))
    beside = (np.where(known, 0.0, part) for part in (linear.west, linear.east, linear.south, linear.north))
    eliminated = Linear(kind, mobility[0], linear.balance, np.where(known, 1.0, linear.centre), *beside)
    for column, nodes in enumerate(covered):
        raised = nodes.astype(float)
        source = np.where(known, 0.0, linear.image(raised))
        size = float(np.sqrt((source * source).sum()))
        change = step(network, replace(eliminated, balance=source), RESPONSE_ACCURACY * size) if size else 0.0
        image = linear.image(raised + change)
        slopes[:, column] = [float(image[others].sum()) for others in covered]
    return flows, slopes, largest, float(np.abs(linear.balance[~known]).sum())


def _passed(inflows: tuple[Inflow, ...], free: list[int], pressures: Array) -> tuple[Array, Array]:
    """The flows through the restrictors, m³/s, and their derivatives by the pressure drop, m³/(Pa s)."""
    flows = []
    for number, pressure in zip(free, pressures, strict=True):
        restrictor = inflows[number].restrictor
        assert restrictor is not None
        flows.append(restrictor.flow(inflows[number].pressure - float(pressure)))
    return np.array([flow for flow, _ in flows]), np.array([slope for _, slope in flows])


def _balanced(
    inflows: tuple[Inflow, ...], free: list[int], flows: Array, slopes: Array, pressures: Array, *, ruptures: bool
) -> Array:
    """The pressures at which the flows, linear in them, pass the restrictors.

    Raises
    ------
    ConvergenceError
        If no change of the pressures changes the flows, as where the law of viscosity stops the film of a given flow.
    """
    found = pressures.copy()

    def excess(trial: Array) -> Array:
        return np.asarray(flows + slopes @ (trial - pressures) - _passed(inflows, free, trial)[0])

    rest = excess(found)
    for _ in range(INNER_ITERATIONS):
        try:
            change = -np.linalg.solve(slopes + np.diag(_passed(inflows, free, found)[1]), rest)
        except np.linalg.LinAlgError:
            raise ConvergenceError(
                f"supply.{free[int(np.argmax(np.abs(found)))]}: no pressure passes its flow through the film; lower "
                "the flow, take a thicker film, or another viscosity law",
                outcome=Outcome.DIVERGED,
            ) from None
        part = 1.0
        while part > 1e-6 and np.abs(excess(found + part * change)).max() >= np.abs(rest).max():
            part /= 2
        found = found + part * change
        rest = excess(found)
        if (np.abs(part * change) <= INNER_TOLERANCE * np.abs(found)).all() or part <= 1e-6:
            break
    return np.where(ruptures & (found <= 0), LOWERED * pressures, found) if ruptures else found
