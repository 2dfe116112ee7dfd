"""The equations of the points across a film at each node, inverted.

All functions take for each point across the film the flows ``along`` and ``beside`` through the faces of its node
towards i + 1 and j + 1, m³/s (m²/s if the film is infinitely wide), shape (nx, ny, points); ``before`` and ``below``
are the indices of the nodes i - 1 and j - 1, or -1 at an end. Functions write into their last arrays.
"""

from roughfilm.contact.foundation.compiled import called, compiled, inlined

LANES = 32
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
def exchange(along, beside, supply, drift, push, fixed, periodic_x, periodic_y, renewed, entering, leaving, stored):  # type: ignore[no-untyped-def]  # fmt: skip
    """Write the flows of every point into the film and out of it at the fixed nodes, and the rest of each balance.

    At the first and last nodes along the sliding each point takes in or gives off what its own faces lack. At other
    fixed nodes, those of sides and supplies, the flow from or to the outside has the profile of a flow by pressure. At
    nodes without any flow, whose temperature nothing else determines between walls that take no heat, each point takes
    in and gives off the small flow ``renewed``.
    """
    nx, ny, size = along.shape
    for i in range(nx):
        before = i - 1 if i > 0 else (nx - 1 if periodic_x else -1)
        ends = not periodic_x and (i == 0 or i == nx - 1)
        for j in range(ny):
            below = j - 1 if j > 0 else (ny - 1 if periodic_y else -1)
            rest, through = 0.0, 0.0
            for m in range(size):
                entering[i, j, m] = supply[j] * drift[i, j, m] if i == 0 and supply.size else 0.0
                leaving[i, j, m] = 0.0
                rest += divergence(along, beside, before, below, i, j, m) - entering[i, j, m]
                through += abs(along[i, j, m]) + abs(beside[i, j, m]) + entering[i, j, m]
                if before >= 0:
                    through += abs(along[before, j, m])
                if below >= 0:
                    through += abs(beside[i, below, m])
            if through == 0.0:
                entering[i, j, :] = renewed
                leaving[i, j, :] = renewed
                stored[i, j] = 0.0
                continue
            stored[i, j] = 0.0 if fixed[i, j] else rest
            if not fixed[i, j]:
                continue
            for m in range(size):
                taken = divergence(along, beside, before, below, i, j, m) if ends else rest * push[i, j, m]
                entering[i, j, m] = max(taken, 0.0)
                leaving[i, j, m] = max(-taken, 0.0)


@compiled
def upward_flows(along, beside, entering, leaving, stored, weights, rising, periodic_x, periodic_y, upward):  # type: ignore[no-untyped-def]  # fmt: skip
    """Write the flow through the surface of every point towards the fixed wall, times the weight of the point, m³/s.

    ``rising`` are the integrals of the basis up to the points, times the weights of these over those of the basis.
    """
    nx, ny, size = along.shape
    for i in range(nx):
        before = i - 1 if i > 0 else (nx - 1 if periodic_x else -1)
        for j in range(ny):
            below = j - 1 if j > 0 else (ny - 1 if periodic_y else -1)
            up = upward[i, j]
            up[:] = 0.0
            for n in range(size):
                out = divergence(along, beside, before, below, i, j, n)
                out += leaving[i, j, n] - entering[i, j, n] - weights[n] * stored[i, j]
                part = rising[n]
                for m in range(size):
                    up[m] -= part[m] * out


@compiled
def sources(entering, heat_in, power, added, temperature, supply, softening, heating, source):  # type: ignore[no-untyped-def]
    """Multiply the dissipation by the power of each node, and write what enters, all but its change by T - T₀."""
    nx, ny, size = heating.shape
    for i in range(nx):
        for j in range(ny):
            known = 1.0
            for m in range(size):
                known -= softening[i, j, m] * (temperature[i, j, m] - supply)
            for m in range(size):
                more = heating[i, j, m] * added[i, j]
                heating[i, j, m] *= power[i, j]
                source[i, j, m] = entering[i, j, m] * heat_in[i, j] + more + heating[i, j, m] * known


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
def invert(matrix, size, factor):  # type: ignore[no-untyped-def]
    """Replace matrices by their inverses; they are positive definite but for the conditions of walls.

    A row of ``matrix`` has those of all matrices, one after the other in each column; ``factor`` has their number.
    """
    lanes = factor.size
    for k in range(size):
        top = matrix[k]
        for w in range(lanes):
            factor[w] = 1.0 / top[k * lanes + w]
            top[k * lanes + w] = 1.0
        for c in range(size):
            for w in range(lanes):
                top[c * lanes + w] *= factor[w]
        for r in range(size):
            if r == k:
                continue
            row = matrix[r]
            for w in range(lanes):
                factor[w] = row[k * lanes + w]
                row[k * lanes + w] = 0.0
            for c in range(size):
                for w in range(lanes):
                    row[c * lanes + w] -= factor[w] * top[c * lanes + w]


@called
def multiply(matrix, row, right, size, total):  # type: ignore[no-untyped-def]
    """Write the products of a row of matrices with right-hand sides."""
    total[:] = 0.0
    for n in range(size):
        part, vector = matrix[row, n], right[n]
        for w in range(total.size):
            total[w] += part[w] * vector[w]


@compiled
def blocks(along, beside, leaving, stored, upward, source, heating, softening, conduction, area, inverse_capacity, offset, holds_0, resistance_0, holds_1, resistance_1, outside_1, given_0, given_1, weights, slopes, stiffness, ends, reach_x, reach_y, periodic_x, periodic_y, scratch, rows, right, pulls, lanes, inverse, constant, wall, flux, flux_constant, flux_wall):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """Write the solution of the equations of each node, E = constant + wall T + inverse b, and the flux into the wall.

    E is the heat per volume at the points, T the temperature outside of the condition of the sliding wall, and b what
    flows in. The flux is flux_constant + flux_wall T + flux b. The temperature at the points is offset + E
    inverse_capacity, above that of the supply as all temperatures. What enters from outside is source + heating times
    the sum of softening times the temperatures. The flux into a wall with a resistance is that of the temperature at
    the wall; the conditions of walls that are at a given temperature anywhere, ``given_0`` and ``given_1``, are
    equations with the fluxes into them as unknowns. ``rows`` is a view of ``scratch``, the matrices of some nodes of a
    row.
    """
    nx, ny, size = along.shape
    inverses, rises, offsets, heats, softens = lanes[0], lanes[1], lanes[2], lanes[3], lanes[4]
    factor, total, shift, softer, pull_0, pull_1 = pulls[0], pulls[1], pulls[2], pulls[3], pulls[4], pulls[5]
    first = size
    second = size + 1 if given_0 else size
    order = second + 1 if given_1 else second
    for i in range(nx):
        before = i - 1 if i > 0 else (nx - 1 if periodic_x else -1)
        for start in range(0, ny, total.size):
            count = min(total.size, ny - start)
            for w in range(count):
                j = start + w
                shift[w] = conduction[i, j]
                pull_0[w] = 0.0 if given_0 else area[i, j] * holds_0 / resistance_0[i, j]
                pull_1[w] = 0.0 if given_1 else area[i, j] * holds_1 / resistance_1[i, j]
                softer[w] = 0.0
                for n in range(size):
                    inverses[n, w] = inverse_capacity[i, j, n]
                    rises[n, w] = upward[i, j, n]
                    offsets[n, w] = offset[i, j, n]
                    heats[n, w] = heating[i, j, n]
                    softens[n, w] = softening[i, j, n] * inverse_capacity[i, j, n]
                    softer[w] += softening[i, j, n] * offset[i, j, n]
                    right[n, w] = source[i, j, n] + pull_1[w] * ends[1, n] * outside_1[i, j]
            for m in range(size):
                for n in range(size):
                    slope, stiff, low, high = (
                        slopes[n, m],
                        stiffness[m, n],
                        ends[0, m] * ends[0, n],
                        ends[1, m] * ends[1, n],
                    )
                    block, each, risen, given, known = scratch[m, n], inverses[n], rises[n], offsets[n], right[m]
                    heated, softened = heats[m], softens[n]
                    for w in range(total.size):
                        conducted = stiff * shift[w] + low * pull_0[w] + high * pull_1[w]
                        block[w] = conducted * each[w] - slope * risen[w] - heated[w] * softened[w]
                        known[w] -= conducted * given[w]
                for w in range(total.size):
                    right[m, w] += heats[m, w] * softer[w]
            for w in range(count):
                j = start + w
                below = j - 1 if j > 0 else (ny - 1 if periodic_y else -1)
                for m in range(size):
                    out = leaving[i, j, m] - weights[m] * stored[i, j]
                    scratch[m, m, w] += out + outflow(along, beside, reach_x, reach_y, before, below, i, j, m)
            if given_0:
                border(scratch, right, 0, first, order, area, resistance_0, i, start, count, ends, inverses, offsets)
            if given_1:
                border(scratch, right, 1, second, order, area, resistance_1, i, start, count, ends, inverses, offsets)
                for w in range(count):
                    right[second, w] += outside_1[i, start + w]
            invert(rows, order, factor)
            for m in range(size):
                multiply(scratch, m, right, order, total)
                for w in range(count):
                    constant[i, start + w, m] = total[w]
            for w in range(count):
                j = start + w
                for n in range(size):
                    for m in range(size):
                        inverse[i, j, n, m] = scratch[m, n, w]
                if given_0:
                    flux_constant[i, j], flux_wall[i, j] = 0.0, scratch[first, first, w]
                    for n in range(order):
                        flux_constant[i, j] += scratch[first, n, w] * right[n, w]
                    for n in range(size):
                        wall[i, j, n] = scratch[n, first, w]
                        flux[i, j, n] = scratch[first, n, w]
                    continue
                taken = holds_0 / resistance_0[i, j]
                flux_constant[i, j], flux_wall[i, j] = 0.0, -taken
                for m in range(size):
                    wall[i, j, m], flux[i, j, m] = 0.0, 0.0
                if taken == 0.0:
                    continue
                for n in range(size):
                    low, each = pull_0[w] * ends[0, n], taken * ends[0, n] * inverses[n, w]
                    flux_constant[i, j] += taken * ends[0, n] * offsets[n, w] + each * constant[i, j, n]
                    for m in range(size):
                        wall[i, j, m] += low * inverse[i, j, n, m]
                        flux[i, j, m] += each * inverse[i, j, m, n]
                for n in range(size):
                    flux_wall[i, j] += taken * ends[0, n] * inverses[n, w] * wall[i, j, n]


@called
def border(scratch, right, end, row, order, area, resistance, i, start, count, ends, inverses, offsets):  # type: ignore[no-untyped-def]
    """Write the condition of a wall as an equation, and the flux into it into the equations of the points."""
    size = inverses.shape[0]
    for w in range(count):
        for n in range(size, order):
            scratch[row, n, w] = 0.0
        scratch[row, row, w] = -resistance[i, start + w]
        right[row, w] = 0.0
        for m in range(size):
            scratch[m, row, w] = area[i, start + w] * ends[end, m]
            scratch[row, m, w] = ends[end, m] * inverses[m, w]
            right[row, w] -= ends[end, m] * offsets[m, w]
