"""The equations of the points across a film at each node, inverted."""

from roughfilm.contact.foundation.compiled import called, compiled, inlined

LANES = 16
"""Number of nodes whose matrices are inverted at a time."""


@inlined
def divergence(along, beside, before, below, i, j, m):  # type: ignore[no-untyped-def]
    """The flow of point m out of node (i, j) minus the flow into it, m³/s; before and below are -1 at the ends."""
    out = along[i, j, m] + beside[i, j, m]
    if before >= 0:
        out -= along[before, j, m]
    if below >= 0:
        out -= beside[i, below, m]
    return out


@compiled
def exchange(along, beside, supply, drift, push, fixed, periodic_x, periodic_y, entering, leaving, stored):  # type: ignore[no-untyped-def]  # fmt: skip
    """Write the flows of every point into the film and out of it at the fixed nodes, and the rest of each balance.

    At the first and last nodes along the sliding each point takes in or gives off what its own faces lack. At other
    fixed nodes, those of sides and supplies, the flow from or to the outside has the profile of a flow by pressure.
    """
    nx, ny, size = along.shape
    for i in range(nx):
        before = i - 1 if i > 0 else (nx - 1 if periodic_x else -1)
        ends = not periodic_x and (i == 0 or i == nx - 1)
        for j in range(ny):
            below = j - 1 if j > 0 else (ny - 1 if periodic_y else -1)
            rest = 0.0
            for m in range(size):
                entering[i, j, m] = supply[j] * drift[i, j, m] if i == 0 and supply.size else 0.0
                leaving[i, j, m] = 0.0
                rest += divergence(along, beside, before, below, i, j, m) - entering[i, j, m]
            stored[i, j] = 0.0 if fixed[i, j] else rest
            if not fixed[i, j]:
                continue
            for m in range(size):
                taken = divergence(along, beside, before, below, i, j, m) if ends else rest * push[i, j, m]
                entering[i, j, m] = max(taken, 0.0)
                leaving[i, j, m] = max(-taken, 0.0)


@compiled
def upward_flows(along, beside, entering, leaving, stored, weights, integrals, periodic_x, periodic_y, upward):  # type: ignore[no-untyped-def]  # fmt: skip
    """Write the flow through the surface of every point towards the fixed wall, times the weight of the point, m³/s."""
    nx, ny, size = along.shape
    for i in range(nx):
        before = i - 1 if i > 0 else (nx - 1 if periodic_x else -1)
        for j in range(ny):
            below = j - 1 if j > 0 else (ny - 1 if periodic_y else -1)
            for m in range(size):
                upward[i, j, m] = 0.0
            for n in range(size):
                out = divergence(along, beside, before, below, i, j, n)
                out += leaving[i, j, n] - entering[i, j, n] - weights[n] * stored[i, j]
                for m in range(size):
                    upward[i, j, m] -= weights[m] * integrals[m, n] / weights[n] * out


@inlined
def outflow(along, beside, reach_x, reach_y, before, below, i, j, m):  # type: ignore[no-untyped-def]
    """The flow of point m out of node (i, j) through faces, m³/s, each times the weight of the node in its value."""
    out = max(along[i, j, m], 0.0) * (1 + reach_x[i, j, m])
    out += max(beside[i, j, m], 0.0) * (1 + reach_y[i, j, m])
    if before >= 0:
        out += max(-along[before, j, m], 0.0) * (1 + reach_x[before, j, m])
    if below >= 0:
        out += max(-beside[i, below, m], 0.0) * (1 + reach_y[i, below, m])
    return out


@called
def invert(matrix, size, lanes):  # type: ignore[no-untyped-def]
    """Replace matrices (size, size, lanes), positive definite but for the conditions of walls, by their inverses."""
    for k in range(size):
        for w in range(lanes):
            matrix[k, k, w] = 1.0 / matrix[k, k, w]
        for c in range(size):
            if c != k:
                for w in range(lanes):
                    matrix[k, c, w] *= matrix[k, k, w]
        for r in range(size):
            if r != k:
                for c in range(size):
                    if c != k:
                        for w in range(lanes):
                            matrix[r, c, w] -= matrix[r, k, w] * matrix[k, c, w]
                for w in range(lanes):
                    matrix[r, k, w] *= -matrix[k, k, w]


@compiled
def blocks(along, beside, leaving, stored, upward, source, conduction, area, inverse_capacity, offset, holds_0, resistance_0, holds_1, resistance_1, outside_1, weights, slopes, stiffness, ends, reach_x, reach_y, periodic_x, periodic_y, scratch, right, inverse, constant, wall, flux, flux_constant, flux_wall):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """Write the solution of the equations of each node, E = constant + wall T + inverse b, and the flux into the wall.

    E is the heat per volume at the points, T the temperature outside of the condition of the sliding wall, and b what
    flows in. The flux is flux_constant + flux_wall T + flux b. The temperature at the points is offset + E
    inverse_capacity, above that of the supply as all temperatures. The conditions of both walls are equations with the
    fluxes into them as unknowns.
    """
    nx, ny, size = along.shape
    lanes = scratch.shape[2]
    for i in range(nx):
        before = i - 1 if i > 0 else (nx - 1 if periodic_x else -1)
        for start in range(0, ny, lanes):
            count = min(lanes, ny - start)
            for m in range(size):
                for n in range(size):
                    slope, stiff = slopes[n, m], stiffness[m, n]
                    for w in range(count):
                        j = start + w
                        conducted = stiff * conduction[i, j] * inverse_capacity[i, j, n]
                        scratch[m, n, w] = conducted - slope * upward[i, j, n]
            for w in range(count):
                j = start + w
                below = j - 1 if j > 0 else (ny - 1 if periodic_y else -1)
                low, high = 0.0, 0.0
                for m in range(size):
                    out = leaving[i, j, m] - weights[m] * stored[i, j]
                    scratch[m, m, w] += out + outflow(along, beside, reach_x, reach_y, before, below, i, j, m)
                    scratch[m, size, w] = area[i, j] * ends[0, m]
                    scratch[m, size + 1, w] = area[i, j] * ends[1, m]
                    scratch[size, m, w] = holds_0 * ends[0, m] * inverse_capacity[i, j, m]
                    scratch[size + 1, m, w] = holds_1 * ends[1, m] * inverse_capacity[i, j, m]
                    conducted = 0.0
                    for n in range(size):
                        conducted += stiffness[m, n] * offset[i, j, n]
                    right[m, w] = source[i, j, m] - conduction[i, j] * conducted
                    low += ends[0, m] * offset[i, j, m]
                    high += ends[1, m] * offset[i, j, m]
                right[size, w] = -holds_0 * low
                right[size + 1, w] = holds_1 * (outside_1[i, j] - high)
                scratch[size, size, w] = -resistance_0[i, j]
                scratch[size, size + 1, w] = 0.0
                scratch[size + 1, size, w] = 0.0
                scratch[size + 1, size + 1, w] = -resistance_1[i, j]
            invert(scratch, size + 2, count)
            for w in range(count):
                j = start + w
                for m in range(size):
                    total = 0.0
                    for n in range(size + 2):
                        total += scratch[m, n, w] * right[n, w]
                    constant[i, j, m] = total
                    wall[i, j, m] = holds_0 * scratch[m, size, w]
                    flux[i, j, m] = scratch[size, m, w]
                    for n in range(size):
                        inverse[i, j, n, m] = scratch[m, n, w]
                total = 0.0
                for n in range(size + 2):
                    total += scratch[size, n, w] * right[n, w]
                flux_constant[i, j] = total
                flux_wall[i, j] = holds_0 * scratch[size, size, w]
