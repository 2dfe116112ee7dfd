"""The Newton step in the plane: filling fractions eliminated along the flow, pressures by a Krylov method.

With the unknowns of cavities (c) and film (f) separated, a step solves

    A_ff δp + A_fc δξ = r_f,    A_cf δp + A_cc δξ = r_c.

A_cc is bidiagonal along the flow, so one sweep applies its inverse; BiCGSTAB solves the Schur complement
(A_ff − A_fc A_cc⁻¹ A_cf) δp. Its preconditioner is multigrid on a similar symmetric operator: the pressure flow inside
the film, with p = 0 where the film ends and no flow condition where it begins, since the flow out of a cavity does not
depend on the pressure. The flows of an oblique lay are in the operator, but not in its preconditioner.
"""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import compiled
from roughfilm.rom.cavitation.balance import CAVITY, FILM
from roughfilm.rom.cavitation.bicgstab import bicgstab
from roughfilm.rom.cavitation.network import Network
from roughfilm.rom.cavitation.newton import Linear
from roughfilm.rom.multigrid.gradients import dot
from roughfilm.rom.multigrid.multigrid import Multigrid

STEP_REDUCTION = 1e-4
"""Reduction of the linear residual in a Newton step; the film boundary still moves, so more accuracy has no use."""

KRYLOV_ITERATIONS = 200
"""Largest number of BiCGSTAB iterations."""


def plane_step(network: Network, linear: Linear, accuracy: float) -> Array:
    """The change of every unknown, shape (nx, ny); ConvergenceError where the Krylov method stalls."""
    parts = (linear.kind, linear.centre, linear.west, linear.east, linear.south, linear.north)
    source, nothing = -linear.balance, np.zeros(network.shape)

    lay = network.oblique
    ways = (network.periodic[0], lay is not None)

    def driven(pressure: Array) -> Array:
        if lay is None:
            return nothing
        return lay.image(linear.mobility, np.where(linear.kind == FILM, pressure, 0.0))

    def product(pressure: Array) -> Array:
        slanting = driven(pressure)
        carry(*parts, *ways, -slanting, pressure)
        image = np.empty(network.shape)
        film_image(*parts, pressure, image)
        return image if lay is None else np.where(linear.kind == FILM, image + slanting, 0.0)

    values, image = np.zeros(network.shape), np.zeros(network.shape)
    carry(*parts, *ways, source, values)
    film_image(*parts, values, image)
    wanted = np.where(linear.kind == FILM, source - image, 0.0)
    inverse = Multigrid(*conductances(network, linear), periodic=network.periodic)
    tolerance = max(STEP_REDUCTION * float(np.sqrt(dot(wanted, wanted))), accuracy / 10)
    values = bicgstab(product, inverse.cycle, wanted, tolerance=tolerance, limit=KRYLOV_ITERATIONS)
    values[linear.kind != FILM] = 0.0
    carry(*parts, *ways, source - driven(values), values)
    return values


def conductances(network: Network, linear: Linear) -> tuple[Array, Array, Array]:
    """The symmetric operator inside the film: centre, and couplings towards i+1 and j+1, each of shape (nx, ny)."""
    centre, east, north = (np.zeros(network.shape) for _ in range(3))
    to_east, to_north = network.conductance(linear.mobility)
    slopes = (linear.centre, linear.south, linear.north)
    feeds = np.zeros(network.shape, dtype=bool)
    couple(linear.kind, to_east, to_north, *network.periodic, *slopes, feeds, centre, east, north)
    return centre, east, north


@compiled
def couple(kind, east, north, periodic_x, periodic_y, by_self, by_south, by_north, feeds, centre, to_east, to_north):  # type: ignore[no-untyped-def]  # fmt: skip
    """Compute the couplings of film nodes; all other nodes are decoupled.

    ``by_self``, ``by_south`` and ``by_north`` are derivatives of the balances; they account for liquid that drifts back
    from a cavity beside the film. ``feeds`` is set to the cavities whose liquid drifts into the film.
    """
    nx, ny = kind.shape
    for _ in range(2 if periodic_x else 1):
        for i in range(nx - 1 if periodic_x else nx - 2, -1, -1):
            k = i + 1 if i + 1 < nx else 0
            for j in range(ny):
                feeds[i, j] = kind[i, j] == CAVITY and (kind[k, j] == FILM or feeds[k, j])
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
        for j in range(ny if periodic_y else ny - 1):
            k = j + 1 if j + 1 < ny else 0
            g = north[i, j]
            here, there = kind[i, j] == FILM, kind[i, k] == FILM
            if here and not feeds[i, k]:
                centre[i, j] += g * (1.0 + by_north[i, j] / by_self[i, k] if kind[i, k] == CAVITY else 1.0)
            if there and not feeds[i, j]:
                centre[i, k] += g * (1.0 + by_south[i, k] / by_self[i, j] if kind[i, j] == CAVITY else 1.0)
            if here and there:
                to_north[i, j] = g
    for i in range(nx):
        for j in range(ny):
            if kind[i, j] != FILM or centre[i, j] == 0.0:
                centre[i, j] = 1.0


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
            total = 0.0
            if kind[i, j] == FILM:
                below = j - 1 if j > 0 else ny - 1
                above = j + 1 if j + 1 < ny else 0
                total = centre[i, j] * values[i, j] + west[i, j] * values[before, j] + east[i, j] * values[after, j]
                total += south[i, j] * values[i, below] + north[i, j] * values[i, above]
            image[i, j] = total
