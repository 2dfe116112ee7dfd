"""Fused loops over the grid: each reads and writes every array once, in pieces that threads share.

A piece is the range of nodes [low, high). Its free nodes, those whose pressure may change, are listed at the front of
the same range of ``index``; what belongs to them stands at the same places of ``residual``, ``held`` (their pressure),
``move`` and ``taken`` (their step), so that most loops run through memory in order.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numba import njit

_njit: Any = partial(njit, nogil=True, error_model="numpy", fastmath={"reassoc", "contract", "nsz", "arcp"})


def _jit(loop: Callable[..., None]) -> Any:
    """Compiled at the first call; kept for the next run where there is a place for it."""
    try:
        return _njit(cache=True)(loop)
    except RuntimeError:
        return _njit(loop)


@_jit
def advance(low, high, fraction, image, gap, plane, pressure, hardness, source, index, residual, held, out):  # type: ignore[no-untyped-def]
    """Let g grow by t K∗s; list the free nodes, their residual g − plane (in ``source`` too) and pressure."""
    part = np.float32(fraction)
    level = np.float32(plane)
    count = low
    total = 0.0
    worst = np.float32(0)
    for node in range(low, high):
        value = gap[node] + part * image[node]
        gap[node] = value
        difference = value - level
        p = pressure[node]
        if (p > 0 or difference < 0) and (p < hardness or difference > 0):
            index[count] = node
            residual[count] = difference
            held[count] = p
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
    offset = np.float32(mean)
    for place in range(low, end):
        value = residual[place] - offset
        residual[place] = value
        source[index[place]] = value


@_jit
def products(low, end, preconditioned, step, image, index, residual, move, taken, out):  # type: ignore[no-untyped-def]
    """Gather z and s of the free nodes; Σz, Σs, ΣKs, ΣzKs, Σzr, Σsr."""
    z_sum = s_sum = k_sum = zk = zr = sr = 0.0
    for place in range(low, end):
        node = index[place]
        z = preconditioned[node]
        s = step[node]
        move[place] = z
        taken[place] = s
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
def direct(low, end, length, z_mean, conjugate, s_mean, move, taken):  # type: ignore[no-untyped-def]
    """From z, the move along the conjugate direction, α (−(z − z̄) + b (s − s̄))."""
    back, along = np.float32(-length), np.float32(length * conjugate)
    offset = np.float32(length * (z_mean - conjugate * s_mean))
    for place in range(low, end):
        move[place] = back * move[place] + along * taken[place] + offset


@_jit
def descend(low, end, length, residual, move):  # type: ignore[no-untyped-def]
    """The move down the gradient, −α r."""
    for place in range(low, end):
        move[place] = -length * residual[place]


@_jit
def excess(low, end, shift, held, hardness, move, out):  # type: ignore[no-untyped-def]
    """What clip(p + move + λ) − p adds up to, how many nodes keep within bounds, and how far the nearest are beyond."""
    total = 0.0
    within = 0
    below = -np.inf
    above = np.inf
    for place in range(low, end):
        p = held[place]
        moved = p + move[place] + shift
        kept = min(max(moved, 0.0), hardness)
        total += kept - p
        within += kept == moved
        below = max(below, moved if moved < 0 else -np.inf)
        above = min(above, moved if moved > hardness else np.inf)
    out[0] = total
    out[1] = within
    out[2] = below
    out[3] = above


@_jit
def displace(low, end, shift, held, hardness, index, move, residual, taken, step, out):  # type: ignore[no-untyped-def]
    """The step s = clip(p + move + λ) − p, its Σrs, and how many times it fits between the bounds."""
    slope = 0.0
    room = np.inf
    for place in range(low, end):
        p = held[place]
        s = min(max(p + move[place] + shift, 0.0), hardness) - p
        taken[place] = s
        step[index[place]] = s
        slope += s * residual[place]
        if s < 0:
            room = min(room, -p / s)
        elif s > 0:
            room = min(room, (hardness - p) / s)
    out[0] = slope
    out[1] = room


@_jit
def curvature(low, end, image, index, taken, move_image, out):  # type: ignore[no-untyped-def]
    """Gather Ks of the free nodes; ΣsKs and Σss."""
    bend = 0.0
    square = 0.0
    for place in range(low, end):
        k = image[index[place]]
        move_image[place] = k
        s = np.float64(taken[place])
        bend += s * k
        square += s * s
    out[0] = bend
    out[1] = square


@_jit
def press_on(low, end, fraction, shift, held, hardness, index, move, residual, move_image, pressure, out):  # type: ignore[no-untyped-def]
    """Carry out a part t of the step; Σ(r + t Ks) over the nodes with 0 < p < H, and their number."""
    total = 0.0
    count = 0
    for place in range(low, end):
        p = held[place]
        s = min(max(p + move[place] + shift, 0.0), hardness) - p
        p = min(max(p + fraction * s, 0.0), hardness)
        pressure[index[place]] = p
        if 0 < p < hardness:
            total += residual[place] + fraction * move_image[place]
            count += 1
    out[0] = total
    out[1] = count


@_jit
def scale_modes(low, high, spectrum, factors):  # type: ignore[no-untyped-def]
    """Multiply every mode by its real factor."""
    for mode in range(low, high):
        spectrum[mode] *= factors[mode]
