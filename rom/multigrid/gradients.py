"""The operator on the finest grid, and the loops of conjugate gradients.

Products and sums are computed in double precision; direction, image and residual are stored in that of the
preconditioner.
"""

import numpy as np

from roughfilm.contact.foundation.compiled import allocating, called, compiled


@called
def set_image_row(centre, east, north, p, row, across, along, out):  # type: ignore[no-untyped-def]
    """Write a row of Ap; ``across``, ``along``: whether first and second direction are periodic."""
    count = p.shape[0]
    last = p.shape[1] - 1
    own, weight, coupling = p[row], centre[row], north[row]
    for j in range(last + 1):
        out[j] = weight[j] * own[j]
    for j in range(last):
        out[j] -= coupling[j] * own[j + 1]
    for j in range(last):
        out[j + 1] -= coupling[j] * own[j]
    if along:
        out[last] -= coupling[last] * own[0]
        out[0] -= coupling[last] * own[last]
    if row > 0 or across:
        coupling, beside = east[row - 1], p[row - 1]
        for j in range(last + 1):
            out[j] -= coupling[j] * beside[j]
    if row + 1 < count or across:
        coupling, beside = east[row], p[(row + 1) % count]
        for j in range(last + 1):
            out[j] -= coupling[j] * beside[j]


@allocating
def apply(centre, east, north, p, periodic):  # type: ignore[no-untyped-def]
    """The product Ap, shape (nx, ny), with the operator of :class:`rom.multigrid.multigrid.Multigrid`."""
    image = np.empty(p.shape)
    for row in range(p.shape[0]):
        set_image_row(centre, east, north, p, row, periodic[0], periodic[1], image[row])
    return image


@compiled
def dot(first, second):  # type: ignore[no-untyped-def]
    """The sum Σ first second of arrays of shape (nx, ny)."""
    total = 0.0
    for row in range(first.shape[0]):
        a, b = first[row], second[row]
        for j in range(a.size):
            total += np.float64(a[j]) * b[j]
    return total


@compiled
def set_residual(centre, east, north, b, p, across, along, residual, work):  # type: ignore[no-untyped-def]
    """Write r = b − Ap, shape (nx, ny), and return Σr², Σ p(b + r) and Σ r²/centre; ``work`` is (m,)."""
    square = energy = weighed = 0.0
    for row in range(b.shape[0]):
        set_image_row(centre, east, north, p, row, across, along, work)
        want, own, weight, out = b[row], p[row], centre[row], residual[row]
        for j in range(work.size):
            left = want[j] - work[j]
            out[j] = left
            square += left * left
            energy += own[j] * (want[j] + left)
            weighed += left * left / weight[j]
    return square, energy, weighed


@compiled
def turn(part, steepest, direction):  # type: ignore[no-untyped-def]
    """Update the direction d = z + part d, shape (nx, ny)."""
    for row in range(direction.shape[0]):
        d, z = direction[row], steepest[row]
        for j in range(d.size):
            d[j] = z[j] + part * d[j]


@compiled
def set_image(centre, east, north, p, across, along, image, work):  # type: ignore[no-untyped-def]
    """Write Ap to ``image``, shape (nx, ny), and return Σ p Ap; ``work`` is (m,)."""
    product = 0.0
    for row in range(p.shape[0]):
        set_image_row(centre, east, north, p, row, across, along, work)
        own, out = p[row], image[row]
        for j in range(work.size):
            out[j] = work[j]
            product += work[j] * own[j]
    return product


@compiled
def advance(length, direction, image, p, residual):  # type: ignore[no-untyped-def]
    """Step by ``length`` t along d: p += t d, r −= t Ad, shape (nx, ny) each, and return Σr²."""
    square = 0.0
    for row in range(p.shape[0]):
        solution, d, r, change = p[row], direction[row], residual[row], image[row]
        for j in range(d.size):
            solution[j] += length * d[j]
        for j in range(d.size):
            left = r[j] - length * change[j]
            r[j] = left
            square += left * left
    return square
