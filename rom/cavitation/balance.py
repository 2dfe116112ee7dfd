"""Mass balances of the nodes of a film and their derivatives: the loops of Newton's method."""

import numpy as np

from roughfilm.contact.foundation.compiled import compiled, inlined

FILM, CAVITY, FIXED, FLOODED = 0, 1, 2, 3
"""Kinds of nodes by their unknown: the pressure; the filling fraction; none (given); none (oversupplied bank)."""


@inlined
def mean(first, second):  # type: ignore[no-untyped-def]
    """The logarithmic mean (a - b)/ln(a/b) of two mobilities, exact where φ is exponential in p."""
    total, difference = first + second, first - second
    if abs(difference) < 1e-3 * total:
        part = difference / total
        return 0.5 * total * (1.0 - part * part / 3.0)
    return difference / np.log(first / second) if first > 0.0 and second > 0.0 else 0.0


@inlined
def mean_and_slopes(first, second):  # type: ignore[no-untyped-def]
    """The logarithmic mean of two mobilities, and its derivatives by the first and the second."""
    total, difference = first + second, first - second
    if abs(difference) < 1e-3 * total:
        part = difference / total
        return 0.5 * total * (1.0 - part * part / 3.0), 0.5 - part / 3.0, 0.5 + part / 3.0
    if not (first > 0.0 and second > 0.0):
        return 0.0, 0.0, 0.0
    rate = 1.0 / np.log(first / second)
    between = difference * rate
    return between, (1.0 - between / first) * rate, (between / second - 1.0) * rate


@compiled
def linearise(couette, upstream, east, north, part_couette, part_east, storage, stored, supply, periodic_x, periodic_y, kind, pressure, fill, excess, excess_slope, mobility, mobility_slope, balance, centre, to_west, to_east, to_south, to_north):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """Compute outflow minus inflow of every node, and its derivatives by the unknowns of the node and its neighbours.

    Rows of nodes without an unknown become 1 · change = 0. Returns the largest flow through a face.
    """
    nx, ny = couette.shape
    largest = 0.0
    for i in range(nx):
        for j in range(ny):
            balance[i, j] = storage[i, j] * (fill[i, j] + excess[i, j]) - stored[i, j]
            centre[i, j] = storage[i, j] * (excess_slope[i, j] if kind[i, j] == FILM else 1.0)
            to_west[i, j] = to_east[i, j] = to_south[i, j] = to_north[i, j] = 0.0
    for i in range(nx if periodic_x else nx - 1):
        k = i + 1 if i + 1 < nx else 0
        for j in range(ny):
            c, w = couette[i, j], upstream[i, j]
            g = east[i, j]
            rise = pressure[k, j] - pressure[i, j]
            a, b = mobility[i, j], mobility[k, j]
            phi, by_a, by_b = mean_and_slopes(a, b)
            flow = c * (fill[i, j] + w * excess[i, j] + (1.0 - w) * excess[k, j]) - g * phi * rise
            by_left = by_right = 0.0
            if kind[i, j] == FILM:
                by_left = c * w * excess_slope[i, j] + g * phi - g * by_a * mobility_slope[i, j] * rise
            elif kind[i, j] == CAVITY:
                by_left = c
            if kind[k, j] == FILM:
                by_right = c * (1.0 - w) * excess_slope[k, j] - g * phi - g * by_b * mobility_slope[k, j] * rise
            phi, by_a, _ = mean_and_slopes(a, 1.0)
            for part in range(part_couette.shape[0]):
                c, g = part_couette[part, i, j], part_east[part, i, j]
                least = c * (fill[i, j] + w * excess[i, j]) + g * phi * pressure[i, j]
                if least < flow:
                    flow = least
                    by_left = by_right = 0.0
                    if kind[i, j] == FILM:
                        by_left = c * w * excess_slope[i, j] + g * phi
                        by_left += g * by_a * mobility_slope[i, j] * pressure[i, j]
                    elif kind[i, j] == CAVITY:
                        by_left = c
            largest = max(largest, abs(flow))
            balance[i, j] += flow
            balance[k, j] -= flow
            centre[i, j] += by_left
            to_east[i, j] += by_right
            centre[k, j] -= by_right
            to_west[k, j] -= by_left
    for j in range(supply.size):
        balance[0, j] -= supply[j]
    for i in range(nx if ny > 1 else 0):
        for j in range(ny if periodic_y else ny - 1):
            k = j + 1 if j + 1 < ny else 0
            g = north[i, j]
            rise = pressure[i, k] - pressure[i, j]
            a, b = mobility[i, j], mobility[i, k]
            phi, by_a, by_b = mean_and_slopes(a, b)
            flow = -g * phi * rise
            largest = max(largest, abs(flow))
            by_left = by_right = 0.0
            if kind[i, j] == FILM:
                by_left = g * phi - g * by_a * mobility_slope[i, j] * rise
            if kind[i, k] == FILM:
                by_right = -g * phi - g * by_b * mobility_slope[i, k] * rise
            balance[i, j] += flow
            balance[i, k] -= flow
            centre[i, j] += by_left
            to_north[i, j] += by_right
            centre[i, k] -= by_right
            to_south[i, k] -= by_left
    for i in range(nx):
        for j in range(ny):
            if kind[i, j] >= FIXED:
                centre[i, j] = 1.0
                to_west[i, j] = to_east[i, j] = to_south[i, j] = to_north[i, j] = 0.0
    return largest


@compiled
def conduct(east, north, mobility, periodic_x, periodic_y, to_east, to_north):  # type: ignore[no-untyped-def]
    """Compute the conductances K φ of the faces towards i + 1 and j + 1."""
    nx, ny = east.shape
    for i in range(nx):
        k = i + 1 if i + 1 < nx else 0
        for j in range(ny):
            to_east[i, j] = east[i, j] * mean(mobility[i, j], mobility[k, j]) if k or periodic_x else 0.0
            k_north = j + 1 if j + 1 < ny else 0
            to_north[i, j] = north[i, j] * mean(mobility[i, j], mobility[i, k_north]) if k_north or periodic_y else 0.0


@compiled
def rupture(part_couette, part_east, upstream, pressure, fill, excess, mobility, flow):  # type: ignore[no-untyped-def]
    """Replace the flow of each face towards i + 1 by the least that a film rupturing inside the face carries."""
    for part in range(part_couette.shape[0]):
        for i in range(flow.shape[0]):
            for j in range(flow.shape[1]):
                least = part_couette[part, i, j] * (fill[i, j] + upstream[i, j] * excess[i, j])
                least += part_east[part, i, j] * mean(mobility[i, j], 1.0) * pressure[i, j]
                flow[i, j] = min(flow[i, j], least)


@compiled
def advance(kind, pressure, fill, change):  # type: ignore[no-untyped-def]
    """Add the change to the unknowns; nodes with p < 0 become cavity, with ξ > 1 film. Returns how many changed."""
    changed = 0
    for node in range(kind.size):
        if kind[node] == FILM:
            pressure[node] += change[node]
            if pressure[node] < 0.0:
                pressure[node] = 0.0
                kind[node] = CAVITY
                changed += 1
        elif kind[node] == CAVITY:
            fill[node] += change[node]
            if fill[node] > 1.0:
                fill[node] = 1.0
                kind[node] = FILM
                changed += 1
    return changed


@compiled
def settle_bank(kind, balance):  # type: ignore[no-untyped-def]
    """Flood the full nodes of a bank, and turn those into cavity whose supply is too small. Returns how many."""
    changed = 0
    for j in range(kind.size):
        if kind[j] == FILM:
            kind[j] = FLOODED
        elif kind[j] == FLOODED and balance[j] > 0.0:
            kind[j] = CAVITY
            changed += 1
    return changed


@compiled
def along(lower, centre, upper, right_hand_side, scratch):  # type: ignore[no-untyped-def]
    """Solve a tridiagonal system, lower[n] x[n-1] + centre[n] x[n] + upper[n] x[n+1] = right_hand_side[n], in place."""
    n = centre.size
    pivot = centre[0]
    right_hand_side[0] /= pivot
    for i in range(1, n):
        scratch[i] = upper[i - 1] / pivot
        pivot = centre[i] - lower[i] * scratch[i]
        right_hand_side[i] = (right_hand_side[i] - lower[i] * right_hand_side[i - 1]) / pivot
    for i in range(n - 2, -1, -1):
        right_hand_side[i] -= scratch[i + 1] * right_hand_side[i + 1]
