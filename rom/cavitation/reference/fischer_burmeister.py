"""Newton's method of Fischer–Burmeister type for the equations of the default solver on a line, without a start."""

from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import allocating
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED, along
from roughfilm.rom.cavitation.fluid import Fluid
from roughfilm.rom.cavitation.network import Network, State

NEWTON_STEPS = 500
"""Largest number of Newton steps."""

EPSILON = np.finfo(float).eps
"""Cavity fraction added in the derivatives of F, which do not exist where both arguments are zero."""


@dataclass(frozen=True, kw_only=True)
class Balanced:
    """A converged state; ``residual`` is the largest net flow into a node over the largest flow through a face."""

    state: State
    residual: float
    iterations: int


def fischer_burmeister(
    network: Network, fluid: Fluid, *, pressure_unit: float, tolerance: float = 1e-9, limit: int = NEWTON_STEPS
) -> Balanced:
    """Solve G(p, c) = 0 and F(p, c) = p + c - √(p² + c²) = 0 with the cavity fraction c = 1 - ξ and p over its unit.

    G are the balances of ``network``; F = 0 means p >= 0, c >= 0, p c = 0. Newton's method solves both together: at
    every node the unknown with the larger derivative of F is eliminated, and the tridiagonal Schur complement is
    solved. Full steps are projected to 0 <= p, 0 <= c <= 1, from a full film at cavitation pressure. The excess supply
    of a starved inlet is the unknown in place of its pressure. The method is for lines that are not periodic.

    Parameters
    ----------
    pressure_unit : scale of the pressures relative to c, Pa.
    tolerance : tolerance of G, over the largest flow through a face, and of F.
    limit : largest number of steps.

    Raises
    ------
    InputError
        If the network is not such a line.
    ConvergenceError
        If either is above the tolerance after ``limit`` steps, or a number overflows.

    Source: Woloszynski, Podsiadlo and Stachowiak 2015, doi:10.1007/s11249-015-0487-4.
    """
    if network.shape[1] > 1 or network.periodic[0]:
        raise InputError(f"network: got {network.shape} nodes, periodic {network.periodic}; it must be an open line")
    network = network.with_whole_faces()
    pressure = np.where(network.fixed, network.pressure, 0.0)
    cavity = np.zeros(network.shape)
    supplied = network.supply is not None
    surplus = 0.0
    unit = float(network.couette.max()) or 1.0
    kinds = [np.where(network.fixed, np.int8(FIXED), np.int8(kind)) for kind in (FILM, CAVITY)]
    by_pressure, by_fill = ([np.empty(network.shape) for _ in range(6)] for _ in kinds)
    residual = np.inf
    for iteration in range(limit + 1):
        with np.errstate(all="ignore"):
            laws = (*fluid.compression(pressure), *fluid.mobility(pressure))
        for kind, parts in zip(kinds, (by_pressure, by_fill), strict=True):
            largest = network.linearise(kind, pressure, 1 - cavity, laws, parts)
        balance = by_pressure[0]
        scaled = pressure[:, 0] / pressure_unit
        if supplied:
            balance[0] += surplus * unit
            scaled[0] = surplus
            by_pressure[1][0], by_pressure[3][0], by_pressure[2][1] = unit / pressure_unit, by_pressure[3][0], 0.0
        balance[network.fixed] = 0
        residual = float(np.abs(balance).max()) / (largest or 1.0)
        broken = np.abs(scaled + cavity[:, 0] - np.hypot(scaled, cavity[:, 0]))
        broken[network.fixed[:, 0]] = 0
        if not np.isfinite(residual):
            break
        if max(residual, float(broken.max())) <= tolerance:
            return Balanced(state=State(pressure=pressure, fill=1 - cavity), residual=residual, iterations=iteration)
        change, opened = _step(network, by_pressure, by_fill, scaled, cavity[:, 0], pressure_unit)
        if supplied:
            surplus = max(surplus + change[0], 0.0)
            change[0] = 0
        pressure[:, 0] = np.maximum(pressure[:, 0] + change * pressure_unit, 0.0)
        cavity[:, 0] = np.clip(cavity[:, 0] + opened, 0.0, 1.0)
    raise ConvergenceError(
        f"fischer_burmeister: residual {residual:.1e} misses the tolerance {tolerance:.1e} after {iteration} steps; "
        "take the default solver",
        outcome=Outcome.UNFINISHED if np.isfinite(residual) else Outcome.DIVERGED,
        iterations=iteration,
    )


def _step(
    network: Network, by_pressure: list[Array], by_fill: list[Array], pressure: Array, cavity: Array, unit: float
) -> tuple[Array, Array]:
    """The changes of the pressure, over its unit, and of the cavity fraction."""
    size = np.hypot(pressure, cavity + EPSILON)
    by_p, by_c = 1 - pressure / size, 1 - cavity / size
    merit = pressure + cavity - np.hypot(pressure, cavity)
    fixed = network.fixed[:, 0]
    by_p[fixed], by_c[fixed], merit[fixed] = 0.0, 1.0, 0.0
    right, lower, centre, upper = (np.empty_like(pressure) for _ in range(4))
    balance, centre_p, west_p, east_p = (part[:, 0] for part in by_pressure[:4])
    centre_f, west_f, east_f = (part[:, 0] for part in by_fill[1:4])
    keeps = reduced(
        balance,
        centre_p,
        west_p,
        east_p,
        centre_f,
        west_f,
        east_f,
        by_p,
        by_c,
        merit,
        unit,
        lower,
        centre,
        upper,
        right,
    )
    along(lower, centre, upper, right, np.empty_like(right))
    with np.errstate(all="ignore"):
        other = np.where(keeps, (-merit - by_p * right) / by_c, (-merit - by_c * right) / by_p)
    change, opened = np.where(keeps, right, other), np.where(keeps, other, right)
    change[fixed] = opened[fixed] = 0
    return change, opened


@allocating
def reduced(balance, centre_p, west_p, east_p, centre_f, west_f, east_f, by_p, by_c, merit, unit, lower, centre, upper, right):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """Compute the Schur complement by columns; returns the nodes where the cavity fraction is eliminated.

    Derivatives ``_p`` are by the pressure, ``_f`` by the filling fraction; unknowns are p over ``unit`` and the cavity
    fraction.
    """
    n = balance.size
    keeps = by_c >= by_p
    for i in range(n):
        right[i] = -balance[i]
        lower[i] = upper[i] = 0.0
    for j in range(n):
        entry = 0.0
        if keeps[j]:
            ratio, known = by_p[j] / by_c[j], merit[j] / by_c[j]
        else:
            ratio, known = by_c[j] / by_p[j], merit[j] / by_p[j]
        for side in range(3):
            i = j + side - 1
            if i < 0 or i >= n:
                continue
            # derivatives of the balance of node i by the unknowns of node j
            if side == 0:
                p, c = east_p[i] * unit, -east_f[i]
            elif side == 1:
                p, c = centre_p[i] * unit, -centre_f[i]
            else:
                p, c = west_p[i] * unit, -west_f[i]
            if keeps[j]:
                entry = p - c * ratio
                right[i] += c * known
            else:
                entry = c - p * ratio
                right[i] += p * known
            if side == 0:
                upper[i] = entry
            elif side == 1:
                centre[i] = entry
            else:
                lower[i] = entry
    return keeps
