"""Parts of the film without a Dirichlet node, which the preconditioner fixes at one node to be regular."""

import numpy as np

from roughfilm.contact.foundation.compiled import called, compiled

LEAK_ROUNDOFF = 4e-15
"""Difference of the diagonal and the sum of couplings, over the diagonal, below which it is round-off."""


@compiled
def set_leak(centre, east, north, leak, seen, stack):  # type: ignore[no-untyped-def]
    """Write the diagonal minus all couplings to ``leak``, and fix each part without a leak at one node.

    Conjugate gradients lose only the free mean of the part. Arrays have the shape (n, m), ``stack`` (n m,).
    """
    count, length = centre.shape
    pending = np.int64(0)
    for row in range(count):
        for j in range(length):
            couplings = north[row, j] + north[row, j - 1] + east[row, j] + east[row - 1, j]
            rest = centre[row, j] - couplings
            leaky = rest > LEAK_ROUNDOFF * centre[row, j]
            leak[row, j] = rest if leaky else 0.0
            seen[row, j] = leaky or couplings == 0
            if leaky and couplings > 0:
                stack[pending] = row * length + j
                pending += 1
    spread(east, north, seen, stack, pending)
    for row in range(count):
        for j in range(length):
            if not seen[row, j]:
                leak[row, j] = centre[row, j]
                seen[row, j] = True
                stack[0] = row * length + j
                spread(east, north, seen, stack, np.int64(1))


@called
def spread(east, north, seen, stack, pending):  # type: ignore[no-untyped-def]
    """Mark all nodes connected to those ``pending`` on the stack as seen."""
    count, length = east.shape
    while pending:
        pending -= 1
        row, j = stack[pending] // length, stack[pending] % length
        before, back = (row if row > 0 else count) - 1, (j if j > 0 else length) - 1
        after, on = row + 1 if row + 1 < count else 0, j + 1 if j + 1 < length else 0
        if not seen[after, j] and east[row, j] > 0:
            seen[after, j] = True
            stack[pending] = after * length + j
            pending += 1
        if not seen[before, j] and east[before, j] > 0:
            seen[before, j] = True
            stack[pending] = before * length + j
            pending += 1
        if not seen[row, on] and north[row, j] > 0:
            seen[row, on] = True
            stack[pending] = row * length + on
            pending += 1
        if not seen[row, back] and north[row, back] > 0:
            seen[row, back] = True
            stack[pending] = row * length + back
            pending += 1
