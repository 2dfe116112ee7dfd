"""Fused loops over the grid: each reads and writes every array once, in pieces that threads share.

A piece is the range of nodes [low, high). Its free nodes, those whose pressure may change, are listed at the front of the same
range of ``index``, and what belongs to them stands at the same places of ``residual`` and ``move``.
"""

from typing import Any

import numpy as np
from numba import njit

_jit: Any = njit(nogil=True, cache=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz", "arcp"})


@_jit
def advance(low, high, fraction, image, gap, plane, pressure, hardness, source, index, residual, out):  # type: ignore[no-untyped-def]
    """g += t K∗s; list the free nodes and their residual g − plane, in ``source`` for the transform too."""
    count = low
    total = 0.0
    worst = 0.0
    for node in range(low, high):
        value = gap[node] + fraction * image[node]
        gap[node] = value
        difference = value - plane
        p = pressure[node]
        if (p > 0 or difference < 0) and (p < hardness or difference > 0):
            index[count] = node
            residual[count] = difference
            source[node] = difference
            count += 1
            total += difference
            worst = max(worst, abs(difference))
        else:
            source[node] = 0
    out[0] = count
    out[1] = total
    out[2] = worst


@_jit
def centre(low, end, mean, source, index, residual):  # type: ignore[no-untyped-def]
    """Take the mean from the residual of the free nodes."""
    for place in range(low, end):
        value = residual[place] - mean
        residual[place] = value
        source[index[place]] = value


@_jit
def products(low, end, preconditioned, step, image, index, residual, out):  # type: ignore[no-untyped-def]
    """Σz, Σs, ΣKs, ΣzKs, Σzr, Σsr over the free nodes."""
    z_sum = s_sum = k_sum = zk = zr = sr = 0.0
    for place in range(low, end):
        node = index[place]
        z = np.float64(preconditioned[node])
        s = np.float64(step[node])
        k = np.float64(image[node])
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


@_jit
def direct(low, end, scale, z_mean, conjugate, s_mean, preconditioned, step, index, move):  # type: ignore[no-untyped-def]
    """The move along the conjugate direction, α (−(z − z̄) + b (s − s̄))."""
    for place in range(low, end):
        node = index[place]
        move[place] = scale * (z_mean - preconditioned[node] + conjugate * (step[node] - s_mean))


@_jit
def descend(low, end, scale, residual, move):  # type: ignore[no-untyped-def]
    """The move down the gradient, −α r."""
    for place in range(low, end):
        move[place] = -scale * residual[place]


@_jit
def excess(low, end, shift, pressure, hardness, index, move, out):  # type: ignore[no-untyped-def]
    """What clip(p + move + shift) − p adds up to, how many nodes keep within bounds, and how far the nearest are beyond."""
    total = 0.0
    within = 0
    below = -np.inf
    above = np.inf
    for place in range(low, end):
        p = pressure[index[place]]
        moved = p + move[place] + shift
        if moved < 0:
            below = max(below, moved)
            moved = 0.0
        elif moved > hardness:
            above = min(above, moved)
            moved = hardness
        else:
            within += 1
        total += moved - p
    out[0] = total
    out[1] = within
    out[2] = below
    out[3] = above


@_jit
def displace(low, end, shift, pressure, hardness, index, move, residual, step, out):  # type: ignore[no-untyped-def]
    """The step s = clip(p + move + shift) − p, its Σrs, and how many times it fits between the bounds."""
    slope = 0.0
    room = np.inf
    for place in range(low, end):
        node = index[place]
        p = pressure[node]
        s = min(max(p + move[place] + shift, 0.0), hardness) - p
        step[node] = s
        slope += s * residual[place]
        if s < 0:
            room = min(room, -p / s)
        elif s > 0:
            room = min(room, (hardness - p) / s)
    out[0] = slope
    out[1] = room


@_jit
def curvature(low, end, step, image, index, out):  # type: ignore[no-untyped-def]
    """ΣsKs and Σss."""
    bend = 0.0
    square = 0.0
    for place in range(low, end):
        node = index[place]
        s = np.float64(step[node])
        bend += s * np.float64(image[node])
        square += s * s
    out[0] = bend
    out[1] = square


@_jit
def press_on(low, end, fraction, shift, pressure, hardness, index, move, gap, image, out):  # type: ignore[no-untyped-def]
    """Carry out a part t of the step on p; Σg and the number of nodes with 0 < p < H, with g as it becomes."""
    total = 0.0
    count = 0
    for place in range(low, end):
        node = index[place]
        p = pressure[node]
        if fraction == 1.0:
            p = min(max(p + move[place] + shift, 0.0), hardness)
        else:
            s = min(max(p + move[place] + shift, 0.0), hardness) - p
            p = min(max(p + fraction * s, 0.0), hardness)
        pressure[node] = p
        if 0 < p < hardness:
            total += gap[node] + fraction * image[node]
            count += 1
    out[0] = total
    out[1] = count


@_jit
def scale_modes(low, high, spectrum, factors):  # type: ignore[no-untyped-def]
    """Multiply every mode by its real factor."""
    for mode in range(low, high):
        spectrum[mode] *= factors[mode]
