"""Fused loops over ranges of the grid, which read and write every array once; threads process separate ranges.

A range holds the nodes [low, high). Its free nodes, whose pressure may change, are listed at the front of the same
range of ``index``; the same entries of ``residual``, ``held`` (pressure), ``move``, ``taken`` (step s) and
``move_image`` (K∗s) belong to them, so that most loops access memory in order.
"""

import numpy as np

from roughfilm.contact.foundation.compiled import compiled

OFF, INSIDE, HARD = 0, 1, 2
"""Values of ``state``: p = 0, 0 < p < H, p = H."""

WORD = 8
"""Number of nodes tested together, as most are far from contact; ranges begin at whole words."""

LISTED = 4
"""Flag in ``state`` of a free node, whose pressure is in the list; other nodes have theirs in the grid."""


ROUNDING = 1e-15
"""Distance of a pressure from the hardness, over the hardness, that is rounding."""


@compiled
def advance(low, high, fraction, image, gap, plane, state, touched):  # type: ignore[no-untyped-def]
    """Add t K∗s to the gap g, and mark the nodes that may be free: listed ones, p > 0, g < g00."""
    part = np.float32(fraction)
    level = np.float32(plane)
    image, gap, state, touched = image[low:high], gap[low:high], state[low:high], touched[low:high]
    for node in range(gap.size):
        value = gap[node] + part * image[node]
        gap[node] = value
        touched[node] = (state[node] != 0) | (value < level)


@compiled
def gather(low, high, words, gap, plane, image, state, pressure, source, step, held, taken, index, residual, now_held, now_taken, move_image, out):  # type: ignore[no-untyped-def]  # fmt: skip  # noqa: E501
    """List the free nodes among the marked ones with residual g − g00, pressure, s and K∗s; eight marks are a word.

    Nodes that were free before have pressure and step in the old lists, in the same order; all others in the grids.
    """
    level = np.float32(plane)
    count = before = 0
    total = 0.0
    worst = np.float32(0)
    words, gap, image, state = words[low // WORD : -(-high // WORD)], gap[low:high], image[low:high], state[low:high]
    pressure, source, step, held, taken = pressure[low:high], source[low:high], step[low:high], held[low:], taken[low:]
    index, residual, now_held, now_taken = index[low:high], residual[low:high], now_held[low:high], now_taken[low:high]
    move_image = move_image[low:high]
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
                now_held[count] = held[before] if listed else pressure[node]
                now_taken[count] = taken[before] if listed else 0
                move_image[count] = image[node]
                state[node] = kind | LISTED
                count += 1
                total += difference
                worst = max(worst, abs(difference))
            elif listed:
                pressure[node] = held[before]
                state[node] = kind
                source[node] = 0
                step[node] = 0
            before += listed != 0
    out[0] = low + count
    out[1] = total
    out[2] = worst


@compiled
def spread(low, end, index, held, pressure):  # type: ignore[no-untyped-def]
    """Copy the pressure of the free nodes to the grid."""
    index, held = index[low:end], held[low:end]
    for place in range(index.size):
        pressure[index[place]] = held[place]


@compiled
def centre(low, end, mean, source, index, residual):  # type: ignore[no-untyped-def]
    """Subtract the mean from the residual of the free nodes and copy it to the grid."""
    offset = np.float32(mean)
    index, residual = index[low:end], residual[low:end]
    for place in range(index.size):
        value = residual[place] - offset
        residual[place] = value
        source[index[place]] = value


@compiled
def products(low, end, preconditioned, index, residual, taken, move_image, move, out):  # type: ignore[no-untyped-def]
    """Copy z to the list of free nodes; returns Σz, Σs, ΣKs, ΣzKs, Σzr, Σsr."""
    z_sum = s_sum = k_sum = zk = zr = sr = 0.0
    index, residual, move = index[low:end], residual[low:end], move[low:end]
    taken, move_image = taken[low:end], move_image[low:end]
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
def direct(low, end, length, z_mean, conjugate, s_mean, move, taken):  # type: ignore[no-untyped-def]
    """Replace z by the move along the conjugate direction, α (−(z − z̄) + b (s − s̄))."""
    back, along = np.float32(-length), np.float32(length * conjugate)
    offset = np.float32(length * (z_mean - conjugate * s_mean))
    move, taken = move[low:end], taken[low:end]
    for place in range(move.size):
        move[place] = back * move[place] + along * taken[place] + offset


@compiled
def descend(low, end, length, residual, move):  # type: ignore[no-untyped-def]
    """Set the move down the gradient, −α r."""
    residual, move = residual[low:end], move[low:end]
    for place in range(move.size):
        move[place] = -length * residual[place]


@compiled
def excess(low, end, shift, held, hardness, move, out):  # type: ignore[no-untyped-def]
    """Return the sum of clip(p + move + λ) − p, and the number of nodes that are not clipped."""
    total = 0.0
    within = 0
    held, move = held[low:end], move[low:end]
    for place in range(held.size):
        p = held[place]
        moved = p + move[place] + shift
        kept = min(max(moved, 0.0), hardness)
        total += kept - p
        within += kept == moved
    out[0] = total
    out[1] = within


@compiled
def beyond(low, end, shift, held, hardness, move, out):  # type: ignore[no-untyped-def]
    """Return the largest value of p + move + λ below 0 and the smallest above H."""
    below = -np.inf
    above = np.inf
    held, move = held[low:end], move[low:end]
    for place in range(held.size):
        moved = held[place] + move[place] + shift
        below = max(below, moved if moved < 0 else -np.inf)
        above = min(above, moved if moved > hardness else np.inf)
    out[0] = below
    out[1] = above


@compiled
def displace(low, end, shift, held, hardness, index, move, residual, taken, step, out):  # type: ignore[no-untyped-def]
    """Compute the step s = clip(p + move + λ) − p; returns Σrs and the largest multiple of s within the bounds."""
    slope = 0.0
    room = np.inf
    index, held, move = index[low:end], held[low:end], move[low:end]
    residual, taken = residual[low:end], taken[low:end]
    for place in range(index.size):
        p = held[place]
        s = min(max(p + move[place] + shift, 0.0), hardness) - p
        taken[place] = s
        step[index[place]] = s
        slope += s * residual[place]
        bound = hardness if s > 0 else 0.0
        if s * room > bound - p if s > 0 else s * room < bound - p:
            room = (bound - p) / s
    out[0] = slope
    out[1] = room


@compiled
def curvature(low, end, image, index, taken, move_image, out):  # type: ignore[no-untyped-def]
    """Copy K∗s to the list of free nodes; returns ΣsKs and Σss."""
    bend = 0.0
    square = 0.0
    index, taken, move_image = index[low:end], taken[low:end], move_image[low:end]
    for place in range(index.size):
        k = image[index[place]]
        move_image[place] = k
        s = np.float64(taken[place])
        bend += s * k
        square += s * s
    out[0] = bend
    out[1] = square


@compiled
def press_on(low, end, fraction, shift, held, hardness, index, move, residual, move_image, state, out):  # type: ignore[no-untyped-def]  # fmt: skip
    """Add t times the step to the pressure; returns Σ(r + t Ks) over nodes with 0 < p < H, and their number."""
    total = 0.0
    count = 0
    index, held, move = index[low:end], held[low:end], move[low:end]
    residual, move_image = residual[low:end], move_image[low:end]
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
def scale_modes(spectrum, left, factors):  # type: ignore[no-untyped-def]
    """Multiply the modes of the columns from ``left`` on by real factors."""
    rows, columns = factors.shape
    for row in range(rows):
        for column in range(columns):
            spectrum[row, left + column] *= factors[row, column]
