"""Relaxation of the heat in a film, along the flow and back.

All functions take the heat of each point across the film, ``heat``, shape (nx, ny, points), and for each point the
flows ``along`` and ``beside`` through the faces towards i + 1 and j + 1, m³/s (m²/s if the film is infinitely wide),
and the factors ``reach_x`` and ``reach_y`` of the change upstream in the value at these faces, all of the same shape.
``inflow`` and ``fresh`` are scratch of shape (points,). Functions write into their last arrays.
"""

from roughfilm.contact.foundation.compiled import called, compiled, inlined
from roughfilm.rom.temperature.blocks import outflow


@inlined
def place(i, count, periodic):  # type: ignore[no-untyped-def]
    """The index of a neighbour, at an end that of the last node."""
    return i % count if periodic else min(max(i, 0), count - 1)


@called
def limit(flow, behind, own, next_one, after, ahead, back, slack, reach):  # type: ignore[no-untyped-def]
    """Write the factor of the change upstream in the value at a face, for every point.

    With the ratio r <= 1 of the change downstream, plus the slack, and the change upstream per length, it is half the
    ratio of lengths times r² (3 - 2 r). The value then lies between those of both nodes of the face, but for the slack.
    Behind a jump the factor falls to 0 as the iteration goes on; with 2 r it would stay at any value, and the result
    depend on the start. A positive flow passes the four nodes in their order, and the face between the middle ones.
    """
    for m in range(own.size):
        onward = flow[m] > 0.0
        change = own[m] - behind[m] if onward else next_one[m] - after[m]
        down = next_one[m] - own[m] if onward else own[m] - next_one[m]
        ratio = ahead if onward else back
        allowed, steep = max(down if change > 0.0 else -down, 0.0) + slack, ratio * abs(change)
        part = 1.0 if allowed >= steep else allowed / steep
        reach[m] = 0.5 * ratio * part * part * (3.0 - 2.0 * part)


@compiled
def reaches(heat, along, beside, ahead_x, back_x, ahead_y, back_y, periodic_x, periodic_y, slack, reach_x, reach_y):  # type: ignore[no-untyped-def]  # fmt: skip
    """Write the factors of the faces towards i + 1 and j + 1 of every point."""
    nx, ny, _ = heat.shape
    for i in range(nx):
        west, east = place(i - 1, nx, periodic_x), place(i + 1, nx, periodic_x)
        last = place(i + 2, nx, periodic_x)
        for j in range(ny):
            own, beyond = heat[i, j], heat[last, j]
            factors = ahead_x[i], back_x[i], slack, reach_x[i, j]
            limit(along[i, j], heat[west, j], own, heat[east, j], beyond, *factors)
            south, north = place(j - 1, ny, periodic_y), place(j + 1, ny, periodic_y)
            beyond = heat[i, place(j + 2, ny, periodic_y)]
            factors = ahead_y[j], back_y[j], slack, reach_y[i, j]
            limit(beside[i, j], heat[i, south], own, heat[i, north], beyond, *factors)


@inlined
def add(flow, sign, before, nearest, behind, reach, inflow):  # type: ignore[no-untyped-def]
    """Add the heat that enters a node through a face, less what of the heat that leaves depends on the node behind it.

    The value at the face is that of the node upstream and the change up to it times the factor of the face. Two nodes
    before the face, the own one and the one behind it follow each other; the flow times ``sign`` enters.
    """
    for m in range(inflow.size):
        f = sign * flow[m]
        inflow[m] += max(f, 0.0) * (nearest[m] + reach[m] * (nearest[m] - before[m]))
        inflow[m] -= min(f, 0.0) * reach[m] * behind[m]


@inlined
def gather(heat, along, beside, reach_x, reach_y, periodic_x, periodic_y, i, j, inflow):  # type: ignore[no-untyped-def]
    """Write what flows into node (i, j) at every point, less what of the outflow depends on other nodes."""
    nx, ny, size = heat.shape
    west, east = place(i - 1, nx, periodic_x), place(i + 1, nx, periodic_x)
    for m in range(size):
        inflow[m] = 0.0
    if west != i:
        second = heat[place(i - 2, nx, periodic_x), j]
        add(along[west, j], 1.0, second, heat[west, j], heat[east, j], reach_x[west, j], inflow)
    if east != i:
        second = heat[place(i + 2, nx, periodic_x), j]
        add(along[i, j], -1.0, second, heat[east, j], heat[west, j], reach_x[i, j], inflow)
    south, north = place(j - 1, ny, periodic_y), place(j + 1, ny, periodic_y)
    if south != j:
        second = heat[i, place(j - 2, ny, periodic_y)]
        add(beside[i, south], 1.0, second, heat[i, south], heat[i, north], reach_y[i, south], inflow)
    if north != j:
        second = heat[i, place(j + 2, ny, periodic_y)]
        add(beside[i, j], -1.0, second, heat[i, north], heat[i, south], reach_y[i, j], inflow)


@called
def solve(own, base, by_wall, matrix, flux, temperature, inflow, fresh):  # type: ignore[no-untyped-def]
    """Solve the equations of a node for what flows in; returns the sum of all changes and a part of the flux."""
    size, taken, changed = own.size, 0.0, 0.0
    for m in range(size):
        fresh[m] = base[m] + by_wall[m] * temperature
        taken += flux[m] * inflow[m]
    for n in range(size):
        each, column = inflow[n], matrix[n]
        for m in range(size):
            fresh[m] += column[m] * each
    for m in range(size):
        changed += abs(fresh[m] - own[m])
        own[m] = fresh[m]
    return changed, taken


@compiled
def sweep(heat, along, beside, reach_x, reach_y, periodic_x, periodic_y, inverse, constant, wall, flux, flux_constant, flux_wall, filling, history, entry, outside, into_wall, rows, inflow, fresh):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """Solve the equations of the nodes one by one over the given rows, each row up and down.

    Returns the sum of all changes. A half-space takes up the heat of the rows before.
    """
    _, ny, _ = heat.shape
    changed = 0.0
    for row in range(rows.size):
        i = rows[row]
        if history.size:
            for j in range(ny):
                outside[i, j] = entry[i, j]
            for k in range(i):
                each = history[i, k]
                for j in range(ny):
                    outside[i, j] += each * filling[k, j] * into_wall[k, j]
        for turn in range(2 if ny > 1 else 1):
            for step in range(ny):
                j = ny - 1 - step if turn else step
                gather(heat, along, beside, reach_x, reach_y, periodic_x, periodic_y, i, j, inflow)
                temperature = outside[i, j]
                taken = flux_constant[i, j] + flux_wall[i, j] * temperature
                node = heat[i, j], constant[i, j], wall[i, j], inverse[i, j], flux[i, j]
                part, more = solve(*node, temperature, inflow, fresh)
                changed += part
                into_wall[i, j] = taken + more
    return changed


@compiled
def audit(heat, rise, along, beside, leaving, stored, upward, source, heating, softening, entering, heat_in, conduction, area, holds_0, resistance_0, outside_0, holds_1, resistance_1, outside_1, points, weights, slopes, stiffness, ends, reach_x, reach_y, periodic_x, periodic_y, rest, into_0, into_1):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """Write the fluxes into both walls of a given heat, and return sums over the film, W.

    ``rise`` are the temperatures above that of the supply, and what enters from outside is as in ``blocks``. A wall at
    a given temperature takes the flux that balances the node. Conduction depends on differences of the temperature
    across the film alone, so that its round-off is that of the differences.

    Returns
    -------
    residuals, power, generated, brought, entering, taken, conducted
        The sums of the sizes of all residuals, of the dissipation and its size, of the size of the heat that enters and
        of that heat, of the sizes of what the walls take, and of what the largest rise of each node would conduct.
    """
    nx, ny, size = heat.shape
    residuals, power, generated, brought, entered, taken, conducted = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(nx):
        before = i - 1 if i > 0 else (nx - 1 if periodic_x else -1)
        for j in range(ny):
            below = j - 1 if j > 0 else (ny - 1 if periodic_y else -1)
            gather(heat, along, beside, reach_x, reach_y, periodic_x, periodic_y, i, j, rest)
            own, t = heat[i, j], rise[i, j]
            low_end, high_end, softer, hottest, dissipated = 0.0, 0.0, 0.0, 0.0, 0.0
            for m in range(size):
                softer += softening[i, j, m] * t[m]
                low_end += ends[0, m] * t[m]
                high_end += ends[1, m] * t[m]
                hottest = max(hottest, abs(t[m]))
            for m in range(size):
                out = leaving[i, j, m] - weights[m] * stored[i, j]
                out += outflow(along, beside, reach_x, reach_y, before, below, i, j, m)
                taken_in = entering[i, j, m] * heat_in[i, j]
                more = source[i, j, m] + heating[i, j, m] * softer
                rest[m] += more - out * own[m]
                dissipated += more - taken_in
                brought += abs(taken_in)
                entered += taken_in
            for n in range(size):
                risen, lost = upward[i, j, n] * own[n], conduction[i, j] * (t[n] - t[0])
                slope, stiff = slopes[n], stiffness[n]
                for m in range(size):
                    rest[m] += slope[m] * risen - stiff[m] * lost
            total, high = 0.0, 0.0
            for m in range(size):
                total += rest[m]
                high += points[m] * rest[m]
            given_0, given_1 = resistance_0[i, j] == 0.0, resistance_1[i, j] == 0.0
            first = 0.0 if given_0 else holds_0 * (low_end - outside_0[i, j]) / resistance_0[i, j]
            second = 0.0 if given_1 else holds_1 * (high_end - outside_1[i, j]) / resistance_1[i, j]
            if given_0 and given_1:
                second = high / area[i, j]
                first = total / area[i, j] - second
            elif given_0:
                first = total / area[i, j] - second
            elif given_1:
                second = total / area[i, j] - first
            into_0[i, j], into_1[i, j] = first, second
            for m in range(size):
                residuals += abs(rest[m] - area[i, j] * (ends[0, m] * first + ends[1, m] * second))
            power += dissipated
            generated += abs(dissipated)
            taken += area[i, j] * (abs(first) + abs(second))
            conducted += conduction[i, j] * hottest
    return residuals, power, generated, brought, entered, taken, conducted


@compiled
def extremes(values):  # type: ignore[no-untyped-def]
    """The least and the greatest of all values, shape (nx, ny, N)."""
    least, greatest = values[0, 0, 0], values[0, 0, 0]
    nx, ny, size = values.shape
    for i in range(nx):
        for j in range(ny):
            for m in range(size):
                least = min(least, values[i, j, m])
                greatest = max(greatest, values[i, j, m])
    return least, greatest


@compiled
def summarise(temperature, heat, along, leaving, stored, weights, ends, periodic_x, mean, carried, peaks, low, high):  # type: ignore[no-untyped-def]  # fmt: skip
    """Write means across the film, the largest temperature at the points and the temperatures of the walls.

    Returns the heat that leaves and the heat that is stored, W.
    """
    nx, ny, size = temperature.shape
    out, kept = 0.0, 0.0
    for i in range(nx):
        before = i - 1 if i > 0 else (nx - 1 if periodic_x else 0)
        for j in range(ny):
            amount, moved, own = 0.0, 0.0, 0.0
            mean[i, j], low[i, j], high[i, j], peaks[i, j] = 0.0, 0.0, 0.0, temperature[i, j, 0]
            for m in range(size):
                t, flow = temperature[i, j, m], abs(along[i, j, m]) + abs(along[before, j, m])
                mean[i, j] += weights[m] * t
                low[i, j] += ends[0, m] * t
                high[i, j] += ends[1, m] * t
                peaks[i, j] = max(peaks[i, j], t)
                amount += flow
                moved += flow * t
                out += leaving[i, j, m] * heat[i, j, m]
                own += weights[m] * heat[i, j, m]
            carried[i, j] = moved / amount if amount > 0.0 else mean[i, j]
            kept -= stored[i, j] * own
    return out, kept
