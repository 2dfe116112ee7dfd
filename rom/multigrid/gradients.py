"""The operator on the finest grid, and the loops of conjugate gradients."""

import numpy as np

from roughfilm.contact.foundation.compiled import allocating, compiled


@compiled
def set_image(centre, east, north, p, across, along, image):  # type: ignore[no-untyped-def]
    """Write Ap to ``image``, return Σ p Ap; ``across``, ``along``: whether first and second direction are periodic."""
    count = p.shape[0]
    last = p.shape[1] - 1
    product = 0.0
    for row in range(count):
        own, out, weight, coupling = p[row], image[row], centre[row], north[row]
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
        for j in range(last + 1):
            product += out[j] * own[j]
    return product


@allocating
def apply(centre, east, north, p, periodic):  # type: ignore[no-untyped-def]
    """The product Ap, shape (nx, ny), with the operator of :class:`rom.multigrid.multigrid.Multigrid`."""
    image = np.empty(p.shape)
    set_image(centre, east, north, p, periodic[0], periodic[1], image)
    return image


@compiled
def dot(first, second):  # type: ignore[no-untyped-def]
    """The sum Σ first second of arrays of shape (nx, ny)."""
    total = 0.0
    for row in range(first.shape[0]):
        a, b = first[row], second[row]
        for j in range(a.size):
            total += a[j] * b[j]
    return total


@compiled
def weighed(values, weights):  # type: ignore[no-untyped-def]
    """The sum Σ values²/weights of arrays of shape (nx, ny)."""
    total = 0.0
    for row in range(values.shape[0]):
        a, weight = values[row], weights[row]
        for j in range(a.size):
            total += a[j] * a[j] / weight[j]
    return total


@compiled
def leave(b, image, residual, source):  # type: ignore[no-untyped-def]
    """Write b − Ap to the residual r and the ``source``, shape (nx, ny) each, and return Σr²."""
    square = 0.0
    for row in range(b.shape[0]):
        want, have, r, s = b[row], image[row], residual[row], source[row]
        for j in range(r.size):
            left = want[j] - have[j]
            r[j] = left
            s[j] = left
            square += left * left
    return square


@compiled
def advance(length, direction, image, p, residual, source):  # type: ignore[no-untyped-def]
    """Step by ``length`` t along d: p += t d, r −= t Ad, ``source`` = r, shape (nx, ny) each, and return Σr²."""
    square = 0.0
    for row in range(p.shape[0]):
        solution, d, r, change, s = p[row], direction[row], residual[row], image[row], source[row]
        for j in range(d.size):
            solution[j] += length * d[j]
        for j in range(d.size):
            left = r[j] - length * change[j]
            r[j] = left
            s[j] = left
            square += left * left
    return square


@compiled
def turn(part, steepest, direction):  # type: ignore[no-untyped-def]
    """Update the direction d = z + part d, shape (nx, ny)."""
    for row in range(direction.shape[0]):
        d, z = direction[row], steepest[row]
        for j in range(d.size):
            d[j] = z[j] + part * d[j]
