"""Fused loops over ranges of the grid, which read and write every array once; threads process separate ranges.

The free nodes, whose pressure may change, are in lists: ``index``, and for each entry of it ``residual``, ``held``
(pressure), ``move``, ``taken`` (step s) and ``move_image`` (K∗s), so that most loops access memory in order. A range of
nodes [low, high) has the entries [first, end). Other nodes have p = 0 or p = H by their ``state``.
"""

import numpy as np

from roughfilm.contact.foundation.compiled import compiled

OFF, INSIDE, HARD = 0, 1, 2
"""Values of ``state``: p = 0, 0 < p < H, p = H."""

WORD = 8
"""Number of nodes tested together, as most are far from contact; ranges begin at whole words."""

LISTED = 4
"""Flag in ``state`` of a free node."""

ROUNDING = 1e-15
"""Distance of a pressure from the hardness, over the hardness, that is rounding."""


@compiled
def advance(low, high, fraction, image, gap, plane, state, touched, out):  # type: ignore[no-untyped-def]
    """Add t K∗s to the gap g, mark the nodes that may be free (listed, p > 0 or g < g00), and return their number."""
    part = np.float32(fraction)
    level = np.float32(plane)
    image, gap, state, touched = image[low:high], gap[low:high], state[low:high], touched[low:high]
    count = np.int32(0)
    for node in range(gap.size):
        value = gap[node] + part * image[node]
        gap[node] = value
        mark = (state[node] != 0) | (value < level)
        touched[node] = mark
        count += mark
    out[0] = count


@compiled
def gather(low, high, before, first, words, gap, plane, image, state, hardness, held, taken, index, residual, now_held, now_taken, move_image, out):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """List the free nodes among the marked ones with residual g − g00, pressure, s and K∗s; eight marks are a word.

    Nodes that were free before have pressure and step in the old lists, in the same order, from entry ``before`` on.
    The new entries begin at ``first``; returns their number, Σ(g − g00) and the largest |g − g00|.
    """
    level = np.float32(plane)
    count = first
    total = 0.0
    worst = np.float32(0)
    words, gap, image, state = words[low // WORD : -(-high // WORD)], gap[low:high], image[low:high], state[low:high]
    for word in range(words.size):
        if words[word] == 0:
            continue
        for part in range(min(WORD, gap.size - word * WORD)):
            node = word * WORD + part
            difference = gap[node] - level
            known = state[node]
            kind = known & 3
            listed = known & LISTED
            if kind == INSIDE or (kind == OFF and difference < 0) or (kind == HARD and difference > 0):
                index[count] = low + node
                residual[count] = difference
                now_held[count] = held[before] if listed else hardness if kind == HARD else 0.0
                now_taken[count] = taken[before] if listed else 0
                move_image[count] = image[node]
                state[node] = kind | LISTED
                count += 1
                total += difference
                worst = max(worst, abs(difference))
            elif listed:
                state[node] = kind
            before += listed != 0
    out[0] = count - first
    out[1] = total
    out[2] = worst


@compiled
def centre(first, end, mean, residual):  # type: ignore[no-untyped-def]
    """Subtract the mean from the residual of the free nodes."""
    offset = np.float32(mean)
    residual = residual[first:end]
    for place in range(residual.size):
        residual[place] -= offset


@compiled
def sum_cells(first, end, piece, columns, row_cells, column_cells, index, residual, sums):  # type: ignore[no-untyped-def]  # fmt: skip
    """Sum the number of free nodes and their residuals in each cell."""
    index, residual, sums = index[first:end], residual[first:end], sums[piece]
    sums[:] = 0
    beginning = row = 0
    for place in range(index.size):
        node = index[place]
        while node >= beginning + columns:
            beginning += columns
            row += 1
        cell_row, cell_column = row_cells[row], column_cells[node - beginning]
        sums[0, cell_row, cell_column] += 1
        sums[1, cell_row, cell_column] += residual[place]


@compiled
def extend(low, high, row_cells, column_bounds, cells, grid):  # type: ignore[no-untyped-def]
    """Set each node of the rows to the value of its cell."""
    for row in range(low, high):
        if row > low and row_cells[row] == row_cells[row - 1]:
            for column in range(grid.shape[1]):
                grid[row, column] = grid[row - 1, column]
            continue
        for cell in range(cells.shape[1]):
            grid[row, column_bounds[cell] : column_bounds[cell + 1]] = cells[row_cells[row], cell]


@compiled
def scatter(first, end, index, values, grid):  # type: ignore[no-untyped-def]
    """Copy values of the free nodes to the flat grid."""
    index, values = index[first:end], values[first:end]
    for place in range(index.size):
        grid[index[place]] = values[place]


@compiled
def scatter_alone(low, high, first, end, index, values, grid):  # type: ignore[no-untyped-def]
    """Copy values of the free nodes to the flat grid, and set its other nodes to 0."""
    grid[low:high] = 0
    for place in range(first, end):
        grid[index[place]] = values[place]


@compiled
def spread(first, end, index, held, columns, grid):  # type: ignore[no-untyped-def]
    """Copy the pressure of the free nodes to a grid of rows."""
    index, held = index[first:end], held[first:end]
    for place in range(index.size):
        node = index[place]
        grid[node // columns, node % columns] = held[place]


@compiled
def load(low, high, state, hardness, grid):  # type: ignore[no-untyped-def]
    """Set the pressure of the nodes that are not free, 0 or H, in rows of a grid."""
    for row in range(low, high):
        for column in range(grid.shape[1]):
            grid[row, column] = hardness if state[row, column] == HARD else 0.0


@compiled
def deformed_levels(low, high, state, heights, height, unit, displacement, out):  # type: ignore[no-untyped-def]
    """Return Σ(h + u) and the number of nodes where 0 < p < H, and the largest h + u at H and the smallest at 0.

    The gap of the undeformed surface is h = (z̄ − z)/unit.
    """
    total = 0.0
    count = 0
    most = -np.inf
    least = np.inf
    for row in range(low, min(high, heights.shape[0])):
        for column in range(heights.shape[1]):
            value = (height - heights[row, column]) / unit + displacement[row, column]
            kind = state[row, column] & 3
            total += value if kind == INSIDE else 0.0
            count += kind == INSIDE
            most = max(most, value if kind == HARD else -np.inf)
            least = min(least, value if kind == OFF else np.inf)
    out[0] = total
    out[1] = count
    out[2] = most
    out[3] = least


@compiled
def open_gap(low, high, plane, heights, height, unit, displacement, gap):  # type: ignore[no-untyped-def]
    """Set the gap to h + u − g00."""
    for row in range(low, min(high, heights.shape[0])):
        for column in range(heights.shape[1]):
            gap[row, column] = (height - heights[row, column]) / unit + displacement[row, column] - plane


@compiled
def products(first, end, preconditioned, index, residual, taken, move_image, move, out):  # type: ignore[no-untyped-def]
    """Copy z to the list of free nodes; returns Σz, Σs, ΣKs, ΣzKs, Σzr, Σsr."""
    z_sum = s_sum = k_sum = zk = zr = sr = 0.0
    index, residual, move = index[first:end], residual[first:end], move[first:end]
    taken, move_image = taken[first:end], move_image[first:end]
    for place in range(index.size):
        z = np.float64(preconditioned[index[place]])
        move[place] = z
        s = np.float64(taken[place])
        k = np.float64(move_image[place])
        r = np.float64(residual[place])
        z_sum += z
        s_sum += s
        k_sum += k
        zk += z * k
        zr += z * r
        sr += s * r
    out[0] = z_sum
    out[1] = s_sum
    out[2] = k_sum
    out[3] = zk
    out[4] = zr
    out[5] = sr


@compiled
def direct(first, end, length, z_mean, conjugate, s_mean, move, taken):  # type: ignore[no-untyped-def]
    """Replace z by the move along the conjugate direction, α (−(z − z̄) + b (s − s̄))."""
    back, along = np.float32(-length), np.float32(length * conjugate)
    offset = np.float32(length * (z_mean - conjugate * s_mean))
    move, taken = move[first:end], taken[first:end]
    for place in range(move.size):
        move[place] = back * move[place] + along * taken[place] + offset


@compiled
def descend(first, end, length, residual, move):  # type: ignore[no-untyped-def]
    """Set the move down the gradient, −α r."""
    residual, move = residual[first:end], move[first:end]
    for place in range(move.size):
        move[place] = -length * residual[place]


@compiled
def excess(first, end, shift, held, hardness, move, out):  # type: ignore[no-untyped-def]
    """Return the sum of clip(p + move + λ) − p, and the number of nodes that are not clipped."""
    total = 0.0
    within = 0
    held, move = held[first:end], move[first:end]
    for place in range(held.size):
        p = held[place]
        moved = p + move[place] + shift
        kept = min(max(moved, 0.0), hardness)
        total += kept - p
        within += kept == moved
    out[0] = total
    out[1] = within


@compiled
def beyond(first, end, shift, held, hardness, move, out):  # type: ignore[no-untyped-def]
    """Return the largest value of p + move + λ below 0 and the smallest above H."""
    below = -np.inf
    above = np.inf
    held, move = held[first:end], move[first:end]
    for place in range(held.size):
        moved = held[place] + move[place] + shift
        below = max(below, moved if moved < 0 else -np.inf)
        above = min(above, moved if moved > hardness else np.inf)
    out[0] = below
    out[1] = above


@compiled
def displace(first, end, shift, held, hardness, move, residual, taken, out):  # type: ignore[no-untyped-def]
    """Compute the step s = clip(p + move + λ) − p; returns Σrs and the largest multiple of s within the bounds."""
    slope = 0.0
    room = np.inf
    held, move = held[first:end], move[first:end]
    residual, taken = residual[first:end], taken[first:end]
    for place in range(held.size):
        p = held[place]
        s = min(max(p + move[place] + shift, 0.0), hardness) - p
        taken[place] = s
        slope += s * residual[place]
        bound = hardness if s > 0 else 0.0
        if s * room > bound - p if s > 0 else s * room < bound - p:
            room = (bound - p) / s
    out[0] = slope
    out[1] = room


@compiled
def curvature(first, end, image, index, taken, move_image, out):  # type: ignore[no-untyped-def]
    """Copy K∗s to the list of free nodes; returns ΣsKs and Σss."""
    bend = 0.0
    square = 0.0
    index, taken, move_image = index[first:end], taken[first:end], move_image[first:end]
    for place in range(index.size):
        k = image[index[place]]
        move_image[place] = k
        s = np.float64(taken[place])
        bend += s * k
        square += s * s
    out[0] = bend
    out[1] = square


@compiled
def press_on(first, end, fraction, shift, held, hardness, index, move, residual, move_image, state, out):  # type: ignore[no-untyped-def]  # fmt: skip
    """Add t times the step to the pressure; returns Σ(r + t Ks) over nodes with 0 < p < H, and their number."""
    total = 0.0
    count = 0
    index, held, move = index[first:end], held[first:end], move[first:end]
    residual, move_image = residual[first:end], move_image[first:end]
    for place in range(index.size):
        p = held[place]
        s = min(max(p + move[place] + shift, 0.0), hardness) - p
        p = min(max(p + fraction * s, 0.0), hardness)
        if hardness - p < ROUNDING * hardness:
            p = hardness
        held[place] = p
        inside = 0 < p < hardness
        state[index[place]] = LISTED | (INSIDE if inside else HARD if p > 0 else OFF)
        total += residual[place] + fraction * move_image[place] if inside else 0.0
        count += inside
    out[0] = total
    out[1] = count


@compiled
def levels(pressure, gap, hardness, out):  # type: ignore[no-untyped-def]
    """Return Σg where 0 < p < H, the number of these nodes, the largest g where p = H and the smallest where p = 0."""
    total = 0.0
    count = 0
    most = -np.inf
    least = np.inf
    for node in range(gap.size):
        p, g = pressure[node], gap[node]
        inside = 0 < p < hardness
        total += g if inside else 0.0
        count += inside
        most = max(most, g if p >= hardness else -np.inf)
        least = min(least, g if p <= 0 else np.inf)
    out[0] = total
    out[1] = count
    out[2] = most
    out[3] = least


@compiled
def violation(pressure, gap, plane, hardness, out):  # type: ignore[no-untyped-def]
    """Return the largest of |g − g00| where 0 < p < H, g00 − g where p = 0 and g − g00 where p = H, and 0."""
    worst = 0.0
    for node in range(gap.size):
        p, difference = pressure[node], gap[node] - plane
        worst = max(worst, difference if p > 0 else 0.0)
        worst = max(worst, -difference if p < hardness else 0.0)
    out[0] = worst


@compiled
def separate(pressure, deformed, plane):  # type: ignore[no-untyped-def]
    """Replace h + u by the gap, h + u − g00 where p = 0, at least 0."""
    for node in range(deformed.size):
        deformed[node] = max(deformed[node] - plane, 0.0) if pressure[node] <= 0 else 0.0


@compiled
def smooth_edges(pressure, elastic, gap, hardness, step_gap, step_pressure, out):  # type: ignore[no-untyped-def]
    """Return the number of edges between elastic and open pixels of a periodic grid, without steps of the surface."""
    rows, columns = pressure.shape
    count = 0
    for row in range(rows):
        for column in range(columns):
            p = pressure[row, column]
            if 0 < p < hardness:
                u = elastic[row, column]
                for side in range(4):
                    x, y = (1 if side == 0 else -1 if side == 1 else 0), (1 if side == 2 else -1 if side == 3 else 0)
                    beside = (row + x) % rows, (column + y) % columns
                    if pressure[beside] <= 0:
                        behind = pressure[(row - x) % rows, (column - y) % columns]
                        rise = u - elastic[beside]
                        step = gap[beside] > step_gap * rise and behind > 0 and p >= step_pressure * behind
                        count += not step
    out[0] = count


@compiled
def clipped_sum(field, shift, most, out):  # type: ignore[no-untyped-def]
    """Return Σ clip(p + λ, 0, H), and the number of nodes that are not clipped."""
    total = 0.0
    count = 0
    for node in range(field.size):
        moved = field[node] + shift
        kept = min(max(moved, 0.0), most)
        total += kept
        count += kept == moved
    out[0] = total
    out[1] = count


@compiled
def refine(coarse, fine):  # type: ignore[no-untyped-def]
    """Interpolate a periodic field linearly to a grid twice as fine."""
    rows, columns = coarse.shape
    for row in range(rows):
        here, below = coarse[row], coarse[(row + 1) % rows]
        for column in range(columns):
            right = column + 1 if column + 1 < columns else 0
            fine[2 * row, 2 * column] = here[column]
            fine[2 * row, 2 * column + 1] = (here[column] + here[right]) / 2
            fine[2 * row + 1, 2 * column] = (here[column] + below[column]) / 2
            fine[2 * row + 1, 2 * column + 1] = (here[column] + below[column] + here[right] + below[right]) / 4


@compiled
def scale_modes(spectrum, left, factors):  # type: ignore[no-untyped-def]
    """Multiply the modes of the columns from ``left`` on by real factors, which rows of opposite sign share."""
    rows, columns = spectrum.shape[0], factors.shape[1]
    for row in range(rows):
        mirrored = min(row, rows - row)
        for column in range(columns):
            spectrum[row, left + column] *= factors[mirrored, column]
