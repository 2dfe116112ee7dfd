"""Nonlinear Gauss-Seidel relaxation: slow, but convergent from any start, since the balances are an M-function."""

import numpy as np

from roughfilm.contact.foundation.compiled import compiled, inlined
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED
from roughfilm.rom.cavitation.fluid import Fluid
from roughfilm.rom.cavitation.network import Network, State
from roughfilm.rom.cavitation.oblique import wet


@inlined
def held(source, out, across, threshold):  # type: ignore[no-untyped-def]
    """The filling fraction ξ with out ξ + across g(ξ) = source, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(30):
        middle = 0.5 * (low + high)
        if out * middle + across * wet(middle, threshold)[0] > source:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


@compiled
def relax(couette, upstream, east, north, part_couette, part_east, storage, stored, supply, periodic_x, periodic_y, drift, threshold, fixed, banks, kind, pressure, fill, excess, excess_slope, sweeps):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """Relax along the flow, with ``east`` and ``north`` the conductances Kφ, and ϑ (``excess``) linear in p.

    Each sweep follows one row behind the one before, so that all sweeps use a row while it is in the cache.

    Every node takes the pressure that balances it or, if that is negative, the filling fraction: p >= 0, ξ <= 1.
    Source: Elrod and Adams 1975 for the two cases; Ortega and Rheinboldt 1970, theorem 13.5.9, for convergence.
    """
    nx, ny = couette.shape
    for front in range(nx + sweeps - 1):
        for i in range(min(front, nx - 1), max(front - sweeps, -1), -1):
            before = i - 1 if i > 0 else (nx - 1 if periodic_x else -1)
            after = i + 1 if i + 1 < nx else (0 if periodic_x else -1)
            for place in range(2 * ny if drift.size else ny):
                j = place if place < ny else 2 * ny - 1 - place
                if kind[i, j] == FIXED:
                    continue
                source = stored[i, j]
                drain = 0.0
                out = storage[i, j]
                weight = storage[i, j]
                if before >= 0:
                    c, w = couette[before, j], upstream[before, j]
                    g = east[before, j]
                    inflow = c * (fill[before, j] + w * excess[before, j]) + g * pressure[before, j]
                    least = inflow + c * (1.0 - w) * excess[i, j] - g * pressure[i, j]
                    choked = False
                    for part in range(part_couette.shape[0]):
                        inner = part_couette[part, before, j] * (fill[before, j] + w * excess[before, j])
                        inner += part_east[part, before, j] * pressure[before, j]
                        if inner < least:
                            least = inner
                            choked = True
                    source += least if choked else inflow
                    if not choked:
                        drain += g
                        weight -= c * (1.0 - w)
                elif supply.size:
                    source += supply[j]
                if after >= 0:
                    c, w = couette[i, j], upstream[i, j]
                    g = east[i, j]
                    carried = g * pressure[after, j] - c * (1.0 - w) * excess[after, j]
                    least = c * (fill[i, j] + w * excess[i, j]) + g * pressure[i, j] - carried
                    for part in range(part_couette.shape[0]):
                        inner = part_couette[part, i, j] * (fill[i, j] + w * excess[i, j])
                        inner += part_east[part, i, j] * pressure[i, j]
                        if inner < least:
                            least = inner
                            carried = 0.0
                            c, g = part_couette[part, i, j], part_east[part, i, j]
                    source += carried
                    drain += g
                    out += c
                    weight += c * w
                for side in range(2 if ny > 1 else 0):
                    if side == 0:
                        k = j - 1 if j > 0 else (ny - 1 if periodic_y else -1)
                        g = north[i, k] if k >= 0 else 0.0
                    else:
                        k = j + 1 if j + 1 < ny else (0 if periodic_y else -1)
                        g = north[i, j]
                    if k >= 0:
                        source += g * pressure[i, k]
                        drain += g
                across = edge = 0.0
                for side in range(2 if drift.size else 0):
                    face = j - 1 + side
                    if face < 0 or face >= ny - 1:
                        continue
                    k = face + 1 - side
                    d = drift[i, face] if side == 0 else -drift[i, face]
                    if d > 0.0 and not fixed[i, k]:
                        source += d * wet(fill[i, k], threshold[i, face])[0]
                    else:
                        across -= d
                        edge = threshold[i, face]
                left = source - out - across
                film = 0.0
                if left > 0.0 and not (banks[i, j]):
                    slope = weight * excess_slope[i, j]
                    film = (left - weight * excess[i, j] + slope * pressure[i, j]) / (drain + slope)
                if film > 0.0:
                    excess[i, j] = max(0.0, excess[i, j] + excess_slope[i, j] * (film - pressure[i, j]))
                    pressure[i, j] = film
                    fill[i, j] = 1.0
                    kind[i, j] = FILM
                else:
                    pressure[i, j] = excess[i, j] = 0.0
                    fill[i, j] = min(1.0, source / out) if out > 0.0 else 1.0
                    if across != 0.0:
                        fill[i, j] = held(source, out, across, edge)
                    kind[i, j] = CAVITY


def relaxed(network: Network, fluid: Fluid, state: State, sweeps: int) -> State:
    """The state after some sweeps, during which the cross flow of an oblique lay is kept constant."""
    pressure = np.where(network.fixed, network.pressure, state.pressure)
    fill = state.fill.copy()
    kind = np.where(network.fixed, np.int8(FIXED), np.where(fill < 1, np.int8(CAVITY), np.int8(FILM)))
    excess, slope = fluid.compression(pressure)
    banks = np.zeros(network.shape, dtype=bool)
    for bank in network.banks(banks):
        bank[:] = True
    mobility, stored = fluid.mobility(pressure)[0], network.stored
    if network.oblique is not None:
        stored = stored - network.oblique.image(mobility, pressure)
    relax(
        network.couette,
        network.upstream,
        *network.conductance(mobility),
        network.part_couette,
        network.part_east,
        network.storage,
        stored,
        network.supplied,
        *network.periodic,
        *network.drifting,
        network.fixed,
        banks,
        kind,
        pressure,
        fill,
        excess.copy(),
        slope,
        sweeps,
    )
    return State(pressure=pressure, fill=fill)
