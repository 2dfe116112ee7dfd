"""The operator on the finest grid, and the loops of conjugate gradients.

Products and sums are computed in double precision; direction, image and residual are stored in that of the
preconditioner.
"""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import called, compiled


@called
def set_image_row(centre, east, north, p, row, out):  # type: ignore[no-untyped-def]
    """Write a row of Ap; couplings out of the grid are 0."""
    count, length = p.shape
    last = length - 1
    own, weight, along = p[row], centre[row], north[row]
    previous, next_one = p[row - 1 if row else count - 1], p[row + 1 if row < count - 1 else 0]
    back, forth = east[row - 1 if row else count - 1], east[row]
    for j in range(length):
        out[j] = weight[j] * own[j] - back[j] * previous[j] - forth[j] * next_one[j]
    out[0] -= along[last] * own[last]
    out[last] -= along[last] * own[0]
    if last:
        out[0] -= along[0] * own[1]
        out[last] -= along[last - 1] * own[last - 1]
    inside, left, right, coupling_left, coupling_right = (
        out[1:last],
        own[: last - 1],
        own[2:],
        along[: last - 1],
        along[1:],
    )
    for j in range(last - 1):
        inside[j] -= coupling_left[j] * left[j] + coupling_right[j] * right[j]


def apply(centre: Array, east: Array, north: Array, p: Array, periodic: tuple[bool, bool]) -> Array:
    """The product Ap, shape (nx, ny), with the operator of :class:`rom.multigrid.multigrid.Multigrid`."""
    east, north = (np.array(part, dtype=np.float64) for part in (east, north))
    if not periodic[0]:
        east[-1] = 0
    if not periodic[1]:
        north[:, -1] = 0
    image = np.empty(p.shape)
    set_image(np.ascontiguousarray(centre), east, north, np.ascontiguousarray(p), image, np.empty(p.shape[1]))
    return image


@compiled
def set_image(centre, east, north, p, image, work):  # type: ignore[no-untyped-def]
    """Write Ap to ``image``, shape (nx, ny), and return Σ p Ap; ``work`` is (m,)."""
    product = 0.0
    for row in range(p.shape[0]):
        set_image_row(centre, east, north, p, row, work)
        own, out = p[row], image[row]
        for j in range(work.size):
            out[j] = work[j]
            product += work[j] * own[j]
    return product


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
def set_residual(centre, east, north, b, p, residual, work):  # type: ignore[no-untyped-def]
    """Write r = b − Ap, shape (nx, ny), and return Σr² and Σ p(b + r); ``work`` is (m,)."""
    square = energy = 0.0
    for row in range(b.shape[0]):
        set_image_row(centre, east, north, p, row, work)
        want, own, out = b[row], p[row], residual[row]
        for j in range(work.size):
            left = want[j] - work[j]
            out[j] = left
            square += left * left
            energy += own[j] * (want[j] + left)
    return square, energy


@compiled
def weighed(values, weights):  # type: ignore[no-untyped-def]
    """The sum Σ values²/weights of arrays of shape (nx, ny)."""
    total = 0.0
    for row in range(values.shape[0]):
        a, weight = values[row], weights[row]
        for j in range(a.size):
            total += np.float64(a[j]) * a[j] / weight[j]
    return total


@compiled
def turn(part, steepest, direction):  # type: ignore[no-untyped-def]
    """Update the direction d = z + part d, shape (nx, ny)."""
    for row in range(direction.shape[0]):
        d, z = direction[row], steepest[row]
        for j in range(d.size):
            d[j] = z[j] + part * d[j]


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
