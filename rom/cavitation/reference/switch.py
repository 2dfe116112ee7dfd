"""The cavitation algorithm of Paper B for a line, with density as the unknown and a switch of the pressure flow."""

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.cavitation.grid import Grid, grid
from roughfilm.rom.cavitation.problem import Problem

MAX_STEPS = 3000
"""Largest number of fixed-point steps."""

CHANGE_TOLERANCE = 1e-8
"""Relative change of θ in a step at which the solver stops."""

MAX_RETURNS = 50
"""Number of returns of the switch to earlier states after which the steps count as cyclic."""

STALLED_STEPS = 200
"""Number of steps at a constant switch that do not halve the change, after which the solver stops."""

INVERSION_STEPS = 60
"""Largest number of Newton steps from density to pressure."""


@dataclass(frozen=True, kw_only=True)
class Switched:
    """A film of the switch algorithm: density ratio θ and pressure above cavitation pressure, Pa, at the nodes."""

    grid: Grid
    theta: Array
    pressure: Array
    iterations: int

    @property
    def load(self) -> float:
        """The load ∫ p dx, N/m."""
        return float((self.grid.volume_x * self.pressure).sum())


def switched(problem: Problem, cells: int, *, limit: int = MAX_STEPS) -> Switched:
    """Solve (u/2) d(θh)/dx - d/dx(θ h³/12η g dp/dθ dθ/dx) = 0 with the switch g = 1 where θ > 1, else 0.

    The Couette term has second-order backward differences, the Poiseuille term central ones: the pressure gradient is
    dp/dθ (g₂(θ₂ - 1) - g₁(θ₁ - 1)) over the distance, so that a cavity has cavitation pressure. Each step
    θₙ = f(θₙ₋₁) takes g, dp/dθ and η from the one before, from a full film at cavitation pressure. The position of g
    between nodes is that of Elrod's scheme, since the paper does not state it.

    The method is for infinitely wide films that slide towards increasing x, with a compressible lubricant. The film
    must not reach a starved inlet, whose density is given.

    Raises
    ------
    InputError
        If the film is not of that kind.
    ConvergenceError
        If the change is above 1e-8 after ``limit`` steps, if it stalls at a constant switch, if the switch returns to
        earlier states, or if densities leave the range of the lubricant's law.

    Sources: Sahlin et al. 2007, doi:10.1016/j.triboint.2007.02.021; Elrod 1981, doi:10.1115/1.3251669.
    """
    shape, ends = problem.shape, problem.ends
    if not shape.wide or any(shape.joined) or problem.speed <= 0:
        raise InputError("shape: got a film with sides, joined ends or reversed sliding; the switch algorithm has none")
    if problem.initial_compressibility == 0:
        raise InputError("compressibility: got an incompressible lubricant; the switch algorithm needs dp/dθ")
    nodes = grid(shape, (cells, 1))
    thickness: Array = shape.thickness(nodes.x, np.zeros_like(nodes.x))
    step = np.diff(nodes.x)
    if np.ptp(step) > 1e-6 * step.mean():
        raise InputError("shape: got breaks between equal cells; the switch algorithm needs equal cells")
    at = np.array([ends.inlet or 0.0, ends.outlet])
    given = 1 + problem.compression(at)[0]
    first, last = (ends.theta if ends.inlet is None else float(given[0])), float(given[1])
    theta, pressure = np.ones_like(nodes.x), np.zeros_like(nodes.x)
    theta[0], theta[-1] = first, last
    seen: set[bytes] = set()
    returns, before = 0, b""
    least, rested = np.inf, 0
    for iteration in range(1, limit + 1):
        film = np.asarray(theta > 1) if iteration > 1 else np.ones(theta.size, dtype=np.bool_)
        switch = np.packbits(film).tobytes()
        returns += switch != before and switch in seen
        if switch != before:
            least, rested = np.inf, 0
        seen.add(switch)
        before = switch
        if returns > MAX_RETURNS:
            raise _failed("the switch repeats earlier states", Outcome.UNSTEADY, iteration)
        density = _solved(problem, thickness, float(step.mean()), theta, pressure, film)
        if not np.isfinite(density).all():
            raise _failed("densities diverge", Outcome.DIVERGED, iteration)
        change = float(np.abs(density - theta).max()) / float(np.abs(density).max())
        theta, pressure = density, _pressure(problem, density, iteration)
        if change < CHANGE_TOLERANCE:
            return Switched(grid=nodes, theta=theta, pressure=pressure, iterations=iteration)
        rested += 1
        if change < least / 2:
            least, rested = change, 0
        elif rested > STALLED_STEPS:
            raise _failed(f"the change stays near {least:.1e} at a constant switch", Outcome.STALLED, iteration)
    raise _failed(f"relative change {change:.1e} misses {CHANGE_TOLERANCE:g}", Outcome.UNFINISHED, limit)


def _solved(
    problem: Problem, thickness: Array, step: float, theta: Array, pressure: Array, film: NDArray[np.bool_]
) -> Array:
    """The θ of all nodes after one step, from the switch, dp/dθ and viscosity of the step before."""
    n = theta.size
    mobility = problem.mobility(pressure)[0] / problem.compression(pressure)[1]
    cubed = mobility * thickness**3 / (12 * problem.viscosity * step)
    face = (cubed[:-1] + cubed[1:]) / 2
    carried = problem.speed / 2 * thickness
    # bands of row i: columns i + 1, i, i - 1, i - 2
    bands = np.zeros((4, n))
    right = np.zeros(n)
    bands[1, [0, -1]] = 1.0
    right[0], right[-1] = theta[0], theta[-1]
    inner = np.arange(1, n - 1)
    bands[1, inner] += 1.5 * carried[inner]
    bands[2, inner - 1] -= 2.0 * carried[inner - 1]
    bands[3, inner[1:] - 2] += 0.5 * carried[inner[1:] - 2]
    bands[2, 0] += 0.5 * carried[0]  # the western face of the first inner node is the inlet
    switch = film.astype(float)
    bands[1, inner] += (face[inner - 1] + face[inner]) * switch[inner]
    bands[2, inner - 1] -= face[inner - 1] * switch[inner - 1]
    bands[0, inner + 1] -= face[inner] * switch[inner + 1]
    right[inner] += (
        (face[inner - 1] + face[inner]) * switch[inner]
        - face[inner - 1] * switch[inner - 1]
        - face[inner] * switch[inner + 1]
    )
    return np.asarray(scipy.linalg.solve_banded((2, 1), bands, right, check_finite=False))


def _pressure(problem: Problem, theta: Array, iteration: int) -> Array:
    """The pressure at every density; 0 in cavities."""
    excess = np.maximum(theta - 1, 0.0)
    pressure = np.log1p(excess) / problem.initial_compressibility
    for _ in range(INVERSION_STEPS):
        with np.errstate(all="ignore"):
            value, slope = problem.compression(pressure)
            change = (excess - value) / slope
        pressure = pressure + change
        if not np.isfinite(pressure).all():
            break
        if np.abs(change).max() <= 1e-13 * (pressure.max() or 1.0):
            return pressure
    raise _failed("densities leave the range of the law of compressibility", Outcome.DIVERGED, iteration)


def _failed(what: str, outcome: Outcome, iterations: int) -> ConvergenceError:
    return ConvergenceError(
        f"switch algorithm: {what} after {iterations} steps; take the default solver",
        outcome=outcome,
        iterations=iterations,
    )
