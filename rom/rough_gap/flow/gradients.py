"""Velocity gradients of thin films between sloping walls at the middles of cells of four nodes, and their sums."""

from math import sqrt

import numpy as np

from roughfilm.contact.foundation.compiled import allocating

EVEN, CURVED, ODD = 0, 1, 2
"""The parts of ∇u across the gap in 1, t² - 1/3 and t, with t = 1 - 2s, whose mean squares are 1, 4/45 and 1/3."""


@allocating
def set_gradients(lower, gap, velocity, steps, part, out):  # type: ignore[no-untyped-def]
    """Write one part of √h ∂_k u_i, times the root of its mean square, shape (drives, k, i, nx, ny); 0 in contact.

    With m = ∇z₁ + b/2, b = ∇h, and U = 1 for the third drive, the three parts of ∂_k u_i are

        ∂_k v_i + v_i b_k/h - U δ_i1 (m_k + b_k/2)/h,
        -3/2 ∂_k v_i + 3 v_i b_k/h - 3/2 U δ_i1 b_k/h,
        (-6 v_i m_k + U δ_i1 (3 m_k + b_k/2))/h.
    """
    drives, _, count, length = velocity.shape
    slope, rise, change = np.empty(2), np.empty(2), np.empty(2)
    curved, odd = sqrt(4 / 45), sqrt(1 / 3)
    for i in range(count):
        on = i + 1 if i + 1 < count else 0
        for j in range(length):
            up = j + 1 if j + 1 < length else 0
            h = (gap[i, j] + gap[on, j] + gap[i, up] + gap[on, up]) / 4
            if h == 0:
                out[:, :, :, i, j] = 0
                continue
            rise[0] = (gap[on, j] + gap[on, up] - gap[i, j] - gap[i, up]) / (2 * steps[0])
            rise[1] = (gap[i, up] + gap[on, up] - gap[i, j] - gap[on, j]) / (2 * steps[1])
            slope[0] = (lower[on, j] + lower[on, up] - lower[i, j] - lower[i, up]) / (2 * steps[0]) + rise[0] / 2
            slope[1] = (lower[i, up] + lower[on, up] - lower[i, j] - lower[on, j]) / (2 * steps[1]) + rise[1] / 2
            root = sqrt(h)
            for drive in range(drives):
                for c in range(2):
                    one, two = velocity[drive, c, i, j], velocity[drive, c, on, j]
                    three, four = velocity[drive, c, i, up], velocity[drive, c, on, up]
                    v = (one + two + three + four) / 4
                    change[0] = (two + four - one - three) / (2 * steps[0])
                    change[1] = (three + four - one - two) / (2 * steps[1])
                    slides = 1.0 if drive == 2 and c == 0 else 0.0
                    for k in range(2):
                        m, b = slope[k], rise[k]
                        if part == EVEN:
                            value = change[k] + (v * b - slides * (m + b / 2)) / h
                        elif part == CURVED:
                            value = curved * (-1.5 * change[k] + (3 * v - 1.5 * slides) * b / h)
                        else:
                            value = odd * (-6 * v * m + slides * (3 * m + b / 2)) / h
                        out[drive, k, c, i, j] = root * value


@allocating
def add_wave_energies(waves, normal, filters, weights, sums):  # type: ignore[no-untyped-def]
    """Add sums of ∇u_i:∇u_j + (∇·u_i)(∇·u_j) of the filtered waves.

    ``waves`` are those of ∂_k u_i, shape (drives, k, i, nx, n), ``normal`` their directions, shape (2, nx, n),
    ``filters`` the factors of u along and across a direction, shape (2, nx, n), ``weights`` those of columns, (n,).
    """
    drives, _, _, count, length = waves.shape
    less = np.empty((drives, 5), dtype=np.complex128)
    for i in range(count):
        for j in range(length):
            x, y = normal[0, i, j], normal[1, i, j]
            push, keep = filters[0, i, j], filters[1, i, j]
            for drive in range(drives):
                for k in range(2):
                    one, two = waves[drive, k, 0, i, j], waves[drive, k, 1, i, j]
                    along = (push - keep) * (one * x + two * y)
                    less[drive, 2 * k], less[drive, 2 * k + 1] = keep * one + along * x, keep * two + along * y
                less[drive, 4] = less[drive, 0] + less[drive, 3]
            for first in range(drives):
                for second in range(drives):
                    part = 0.0
                    for c in range(5):
                        part += (less[first, c] * less[second, c].conjugate()).real
                    sums[first, second] += weights[j] * part


@allocating
def add_rise_energies(lower, gap, rise, steps, shapes, steep, heights, weights, sums):  # type: ignore[no-untyped-def]
    """Add sums of h ∇w_i·∇w_j over the gap by Gauss' rule.

    ``rise`` are the coefficients of w at the nodes, shape (drives, 4, nx, ny), ``shapes`` and ``steep`` their functions
    of s and the derivatives, shape (points, 4), ``heights`` and ``weights`` the s and weights of the points.
    """
    drives, parts, count, length = rise.shape
    value, along, aside = np.empty((drives, parts)), np.empty((drives, parts)), np.empty((drives, parts))
    w = np.empty((drives, 2))
    for i in range(count):
        on = i + 1 if i + 1 < count else 0
        for j in range(length):
            up = j + 1 if j + 1 < length else 0
            h = (gap[i, j] + gap[on, j] + gap[i, up] + gap[on, up]) / 4
            if h == 0:
                continue
            b_x = (gap[on, j] + gap[on, up] - gap[i, j] - gap[i, up]) / (2 * steps[0])
            b_y = (gap[i, up] + gap[on, up] - gap[i, j] - gap[on, j]) / (2 * steps[1])
            a_x = (lower[on, j] + lower[on, up] - lower[i, j] - lower[i, up]) / (2 * steps[0])
            a_y = (lower[i, up] + lower[on, up] - lower[i, j] - lower[on, j]) / (2 * steps[1])
            for drive in range(drives):
                for c in range(parts):
                    one, two = rise[drive, c, i, j], rise[drive, c, on, j]
                    three, four = rise[drive, c, i, up], rise[drive, c, on, up]
                    value[drive, c] = (one + two + three + four) / 4
                    along[drive, c] = (two + four - one - three) / (2 * steps[0])
                    aside[drive, c] = (three + four - one - two) / (2 * steps[1])
            for point in range(heights.size):
                tilt_x, tilt_y = (a_x + heights[point] * b_x) / h, (a_y + heights[point] * b_y) / h
                for drive in range(drives):
                    x = y = turn = 0.0
                    for c in range(parts):
                        x += shapes[point, c] * along[drive, c]
                        y += shapes[point, c] * aside[drive, c]
                        turn += steep[point, c] * value[drive, c]
                    w[drive, 0], w[drive, 1] = x - tilt_x * turn, y - tilt_y * turn
                for first in range(drives):
                    for second in range(drives):
                        product = w[first, 0] * w[second, 0] + w[first, 1] * w[second, 1]
                        sums[first, second] += weights[point] * h * product
