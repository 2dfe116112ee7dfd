"""The Newton step in the plane: filling fractions eliminated along the flow, pressures by a Krylov method.

With the unknowns of cavities (c) and film (f) separated, a step solves

    A_ff δp + A_fc δξ = r_f,    A_cf δp + A_cc δξ = r_c.

BiCGSTAB solves the Schur complement (A_ff − A_fc A_cc⁻¹ A_cf) δp. Its preconditioner has two stages:

1. Multigrid on a symmetric operator: the pressure flow inside the film, with p = 0 where the film ends. A cavity node
   returns what the film behind it drives into it, and, if the next node is film, what the films beside it drive into
   it; this is no loss. A cavity releases other liquid far downstream, which is a loss.
2. One sweep downstream that solves the balances of one row across the flow after the other. Cavity nodes before a film
   are eliminated. The rows carry what a cavity receives, so that all cavities balance after the sweep.

Along a front oblique to the flow the pressure depends on that upstream along the front; only the sweep includes this.

Cavities do not yet balance where liquid drifts between them, or where the sweep of a periodic film begins with a row
that has cavities; another sweep over the cavities alone applies A_cc⁻¹. The flows of an oblique lay are in the
operator, but not in its preconditioner.
"""

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import compiled
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED
from roughfilm.rom.cavitation.bicgstab import bicgstab
from roughfilm.rom.cavitation.network import Network
from roughfilm.rom.cavitation.newton import Linear
from roughfilm.rom.multigrid.multigrid import Multigrid

KRYLOV_ITERATIONS = 200
"""Largest number of BiCGSTAB iterations."""


def plane_step(network: Network, linear: Linear, accuracy: float) -> Array:
    """The change of every unknown, shape (nx, ny); ConvergenceError where the Krylov method stalls."""
    matrix = (linear.kind, linear.centre, linear.west, linear.east, linear.south, linear.north)
    inverse, factor, work = np.empty(network.shape), np.empty(network.shape), np.empty(network.shape[1])
    factorise(*matrix, inverse, factor)
    drifts = network.oblique is not None
    first, crossed = first_row(linear.kind) if network.periodic[0] else (0, False)
    unbalanced = crossed or (drifts and bool((linear.kind == CAVITY).any()))
    multigrid = Multigrid(*conductances(network, linear), periodic=network.periodic)

    def driven(values: Array) -> Array | float:
        if network.oblique is None:
            return 0.0
        return network.oblique.image(linear.mobility, np.where(linear.kind == FILM, values, 0.0))

    def product(values: Array) -> Array:
        image = np.empty(network.shape)
        film_image(*matrix, values, image)
        return image if network.oblique is None else np.where(linear.kind == FILM, image + driven(values), 0.0)

    def improve(source: Array, values: Array) -> None:
        sweep(*matrix[:5], inverse, factor, first, source, values, work)
        if unbalanced:
            carry(*matrix, network.periodic[0], drifts, np.asarray(source - driven(values)), values)

    def precondition(residual: Array) -> Array:
        values = np.where(linear.kind == FILM, multigrid.cycle(residual), 0.0)
        improve(residual, values)
        return values

    source, start = -linear.balance, np.zeros(network.shape)
    improve(source, start)
    rest = np.where(linear.kind == FILM, source - product(start), 0.0)
    return start + bicgstab(product, precondition, rest, tolerance=accuracy, limit=KRYLOV_ITERATIONS)


def conductances(network: Network, linear: Linear) -> tuple[Array, Array, Array]:
    """The symmetric operator inside the film: centre, and couplings towards i+1 and j+1, each of shape (nx, ny)."""
    centre, east, north = (np.zeros(network.shape) for _ in range(3))
    to_east, to_north = network.conductance(linear.mobility)
    slopes = (linear.centre, linear.south, linear.north)
    couple(linear.kind, to_east, to_north, *network.periodic, *slopes, centre, east, north)
    return centre, east, north


def first_row(kind: NDArray[np.int8]) -> tuple[int, bool]:
    """The row that has the fewest cavity nodes together with the row before it, and whether it has any."""
    cavities = np.count_nonzero(kind == CAVITY, axis=1)
    first = int((cavities + np.roll(cavities, 1)).argmin())
    return first, bool(cavities[first])


@compiled
def couple(kind, east, north, periodic_x, periodic_y, by_self, by_south, by_north, centre, to_east, to_north):  # type: ignore[no-untyped-def]  # fmt: skip
    """Compute the couplings of film nodes; all other nodes are decoupled.

    ``by_self``, ``by_south`` and ``by_north`` are derivatives of the balances; they account for liquid that drifts back
    from a cavity beside the film.
    """
    nx, ny = kind.shape
    for i in range(nx if periodic_x else nx - 1):
        k = i + 1 if i + 1 < nx else 0
        for j in range(ny):
            g = east[i, j]
            here, there = kind[i, j] == FILM, kind[k, j] == FILM
            if here:
                centre[i, j] += g
            if there and kind[i, j] != CAVITY:
                centre[k, j] += g
            if here and there:
                to_east[i, j] = g
    for i in range(nx):
        after = i + 1 if i + 1 < nx else (0 if periodic_x else i)
        for j in range(ny if periodic_y else ny - 1):
            k = j + 1 if j + 1 < ny else 0
            g = north[i, j]
            here, there = kind[i, j] == FILM, kind[i, k] == FILM
            if here and not (kind[i, k] == CAVITY and kind[after, k] == FILM):
                centre[i, j] += g * (1.0 + by_north[i, j] / by_self[i, k] if kind[i, k] == CAVITY else 1.0)
            if there and not (kind[i, j] == CAVITY and kind[after, j] == FILM):
                centre[i, k] += g * (1.0 + by_south[i, k] / by_self[i, j] if kind[i, j] == CAVITY else 1.0)
            if here and there:
                to_north[i, j] = g
    for i in range(nx):
        for j in range(ny):
            if kind[i, j] != FILM or centre[i, j] == 0.0:
                centre[i, j] = 1.0


@compiled
def factorise(kind, centre, west, east, south, north, inverse, factor):  # type: ignore[no-untyped-def]
    """Factorise the rows across the flow without the cavity nodes before a film, which are eliminated.

    The change of a node without an unknown is 0.
    """
    nx, ny = kind.shape
    for i in range(nx):
        before = i - 1 if i > 0 else nx - 1
        last = 0.0
        for j in range(ny):
            pivot = centre[i, j] - south[i, j] * last
            if kind[i, j] == FILM and kind[before, j] == CAVITY:
                pivot -= west[i, j] * east[before, j] / centre[before, j]
            inverse[i, j] = 1.0 / pivot if kind[i, j] < FIXED else 0.0
            last = north[i, j] * inverse[i, j]
            factor[i, j] = last


@compiled
def sweep(kind, centre, west, east, south, inverse, factor, first, source, values, work):  # type: ignore[no-untyped-def]
    """Solve the rows across the flow one after the other downstream, from row ``first`` on, in place."""
    nx, ny = kind.shape
    for number in range(nx):
        i = (first + number) % nx
        before = i - 1 if i > 0 else nx - 1
        after = i + 1 if i + 1 < nx else 0
        for j in range(ny):
            rest = source[i, j] - west[i, j] * values[before, j]
            ahead = east[i, j] * values[after, j]
            eliminated = kind[i, j] == CAVITY and kind[after, j] == FILM and number + 1 < nx
            work[j] = rest if eliminated else rest - ahead
        last = 0.0
        for j in range(ny):
            last = (work[j] - south[i, j] * last) * inverse[i, j]
            work[j] = last
        last = 0.0
        for j in range(ny - 1, -1, -1):
            last = work[j] - factor[i, j] * last
            work[j] = last
        for j in range(ny):
            values[i, j] = work[j]
            if kind[i, j] == FILM and kind[before, j] == CAVITY and number > 0:
                values[before, j] -= east[before, j] / centre[before, j] * work[j]


@compiled
def carry(kind, centre, west, east, south, north, periodic_x, drifts, source, values):  # type: ignore[no-untyped-def]
    """Compute the filling fractions that balance the cavities at given pressures beside them.

    With drift across the sliding (``drifts``) every row is swept upwards and then downwards.
    """
    nx, ny = kind.shape
    for _ in range(2 if periodic_x else 1):
        for i in range(nx):
            before = i - 1 if i > 0 else nx - 1
            after = i + 1 if i + 1 < nx else 0
            for place in range(2 * ny if drifts else ny):
                j = place if place < ny else 2 * ny - 1 - place
                if kind[i, j] == CAVITY:
                    below = j - 1 if j > 0 else ny - 1
                    above = j + 1 if j + 1 < ny else 0
                    rest = source[i, j] - east[i, j] * values[after, j] - west[i, j] * values[before, j]
                    rest -= south[i, j] * values[i, below] + north[i, j] * values[i, above]
                    values[i, j] = rest / centre[i, j]


@compiled
def film_image(kind, centre, west, east, south, north, values, image):  # type: ignore[no-untyped-def]
    """Compute the matrix product A x at the film nodes; zero elsewhere."""
    nx, ny = kind.shape
    for i in range(nx):
        before = i - 1 if i > 0 else nx - 1
        after = i + 1 if i + 1 < nx else 0
        for j in range(ny):
            image[i, j] = centre[i, j] * values[i, j] + west[i, j] * values[before, j] + east[i, j] * values[after, j]
        for j in range(1, ny):
            image[i, j] += south[i, j] * values[i, j - 1]
        for j in range(ny - 1):
            image[i, j] += north[i, j] * values[i, j + 1]
        image[i, 0] += south[i, 0] * values[i, ny - 1]
        image[i, ny - 1] += north[i, ny - 1] * values[i, 0]
        for j in range(ny):
            image[i, j] = image[i, j] if kind[i, j] == FILM else 0.0
