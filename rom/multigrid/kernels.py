"""Loops over the rows of a multigrid hierarchy.

The rows of all levels have one length m and stand one below the other in arrays of shape (rows of all levels, m), the
finest level first. A row with its couplings along itself is a tridiagonal matrix T, cyclic if the row is a ring; to the
next row lead ``east`` (same column), ``up`` (one column on) and ``down`` (one column back). Couplings out of the grid
are 0, so that indices may wrap everywhere.

All loops that call each other stand in this file: a compiled loop is kept until its own file changes, not another one.
"""

from typing import Any, NamedTuple

import numpy as np

from contact.compiled import compiled

GROUNDED = 1e-12
"""Of its diagonal: an unknown with a smaller pivot is set to 0, as the mean of its component is free."""


class Rows(NamedTuple):
    """A matrix by rows and their factors, shape (rows, m) each.

    ``up`` and ``down`` have no columns on the finest level, and ``border`` has none unless rows are rings. ``factor``
    is the coupling towards the middle of the row times the ``inverse`` of the pivot.
    """

    centre: Any
    north: Any
    east: Any
    up: Any
    down: Any
    inverse: Any
    factor: Any
    border: Any


@compiled
def level_rows(rows, start, stop, finest):  # type: ignore[no-untyped-def]
    """The rows [start, stop) of one level; ``finest`` counts those of the finest, which have no up and down."""
    return Rows(
        rows.centre[start:stop],
        rows.north[start:stop],
        rows.east[start:stop],
        rows.up[start - finest : stop - finest] if start else np.zeros((stop, 0)),
        rows.down[start - finest : stop - finest] if start else np.zeros((stop, 0)),
        rows.inverse[start:stop],
        rows.factor[start:stop],
        rows.border[start:stop],
    )


@compiled
def inverted(pivot, centre):  # type: ignore[no-untyped-def]
    """1/pivot, or 0 where the pivot is but rounding."""
    return 1 / pivot if pivot > GROUNDED * centre else 0.0


@compiled
def eliminate(centre, north, inverse, factor):  # type: ignore[no-untyped-def]
    """Factorise a tridiagonal T from both ends to the middle, which are two chains for the processor to work on."""
    size = inverse.size
    middle = size // 2
    left = right = 0.0
    for j in range(middle):
        end = size - 1 - j
        inverse[j] = inverted(centre[j] - (north[j - 1] * left if j else 0.0), centre[j])
        left = factor[j] = north[j] * inverse[j]
        if end > middle:
            inverse[end] = inverted(centre[end] - (north[end] * right if j else 0.0), centre[end])
            right = factor[end] = north[end - 1] * inverse[end]
    pivot = centre[middle]
    pivot -= north[middle - 1] * left if middle > 0 else 0.0
    pivot -= north[middle] * right if middle + 1 < size else 0.0
    inverse[middle] = inverted(pivot, centre[middle])
    factor[middle] = 0.0


@compiled
def substitute(total, inverse, factor, values):  # type: ignore[no-untyped-def]
    """Solve Tx = total for the ``values`` x, to the middle and back; ``total`` is used up."""
    size = inverse.size
    middle = size // 2
    pairs = size - 1 - middle
    left = right = before = after = 0.0
    for j in range(pairs):
        end = size - 1 - j
        left = total[j] + before * left
        right = total[end] + after * right
        before, after = factor[j], factor[end]
        total[j], total[end] = left, right
    if pairs < middle:
        left = total[pairs] + before * left
        before = factor[pairs]
        total[pairs] = left
    left = right = (total[middle] + before * left + after * right) * inverse[middle]
    values[middle] = left
    if pairs < middle:
        left = total[pairs] * inverse[pairs] + factor[pairs] * left
        values[pairs] = left
    for j in range(pairs - 1, -1, -1):
        end = size - 1 - j
        left = total[j] * inverse[j] + factor[j] * left
        right = total[end] * inverse[end] + factor[end] * right
        values[j], values[end] = left, right


@compiled
def factorise_row(rows, row):  # type: ignore[no-untyped-def]
    """Factorise T; of a ring the last unknown apart, with the others' answer to it in the ``border``."""
    centre, north, inverse, factor = rows.centre[row], rows.north[row], rows.inverse[row], rows.factor[row]
    border = rows.border[row]
    if border.size == 0:
        eliminate(centre, north, inverse, factor)
        return
    last = centre.size - 1
    eliminate(centre, north, inverse[:last], factor[:last])
    border[:] = 0.0
    border[0] = north[last]
    border[last - 1] = north[last - 1]
    substitute(border[:last].copy(), inverse[:last], factor[:last], border)
    pivot = centre[last] - north[last] * border[0] - north[last - 1] * border[last - 1]
    inverse[last] = inverted(pivot, centre[last])


@compiled
def solve_row(rows, row, total, values):  # type: ignore[no-untyped-def]
    """Solve Tx = total for the ``values`` x of a row; ``total`` is used up."""
    inverse, factor, border = rows.inverse[row], rows.factor[row], rows.border[row]
    if border.size == 0:
        substitute(total, inverse, factor, values)
        return
    north = rows.north[row]
    last = total.size - 1
    substitute(total, inverse[:last], factor[:last], values)
    closing = (total[last] + north[last] * values[0] + north[last - 1] * values[last - 1]) * inverse[last]
    for j in range(last):
        values[j] += closing * border[j]
    values[last] = closing


@compiled
def add_next(rows, row, values, total):  # type: ignore[no-untyped-def]
    """Add to a row what its couplings bring from the ``values`` of the next row."""
    east, up, down = rows.east[row], rows.up[row], rows.down[row]
    last = total.size - 1
    if up.size == 0:
        for j in range(total.size):
            total[j] += east[j] * values[j]
        return
    total[0] += east[0] * values[0] + up[0] * values[min(1, last)] + down[0] * values[last]
    for j in range(1, last):
        total[j] += east[j] * values[j] + up[j] * values[j + 1] + down[j] * values[j - 1]
    if last > 0:
        total[last] += east[last] * values[last] + up[last] * values[0] + down[last] * values[last - 1]


@compiled
def add_previous(rows, row, values, total):  # type: ignore[no-untyped-def]
    """Add to a row what the couplings of the row before it bring from its ``values``."""
    east, up, down = rows.east[row - 1], rows.up[row - 1], rows.down[row - 1]
    last = total.size - 1
    if up.size == 0:
        for j in range(total.size):
            total[j] += east[j] * values[j]
        return
    total[0] += east[0] * values[0] + up[last] * values[last] + down[min(1, last)] * values[min(1, last)]
    for j in range(1, last):
        total[j] += east[j] * values[j] + up[j - 1] * values[j - 1] + down[j + 1] * values[j + 1]
    if last > 0:
        total[last] += east[last] * values[last] + up[last - 1] * values[last - 1] + down[0] * values[0]


@compiled
def add_own(centre, north, rows, row, between, share, forward):  # type: ignore[no-untyped-def]
    """Add to a coarse row's T what an odd row brings by its share S: STS − SB − BᵀS.

    B are the couplings ``between`` two rows, from the odd row to the even one (``forward``) or the other way.
    """
    east, up, down = rows.east[between], rows.up[between], rows.down[between]
    own, along = rows.centre[row], rows.north[row]
    last = centre.size - 1
    for j in range(last + 1):
        centre[j] += share[j] * (share[j] * own[j] - 2 * east[j])
    for j in range(last):
        north[j] += share[j] * along[j] * share[j + 1]
    north[last] += share[last] * along[last] * share[0]
    if up.size == 0:
        return
    if forward:
        for j in range(last):
            north[j] += share[j] * up[j] + share[j + 1] * down[j + 1]
        north[last] += share[last] * up[last] + share[0] * down[0]
    else:
        for j in range(last):
            north[j] += share[j + 1] * up[j] + share[j] * down[j + 1]
        north[last] += share[0] * up[last] + share[last] * down[0]


@compiled
def set_coupling(east, up, down, rows, row, first, second):  # type: ignore[no-untyped-def]
    """Set a coarse row's couplings to the next one, across an odd row with the shares F and S: BS + FB − FTS."""
    own, along = rows.centre[row], rows.north[row]
    last = east.size - 1
    before, after = rows.east[row - 1], rows.east[row]
    for j in range(last + 1):
        east[j] = before[j] * second[j] + first[j] * (after[j] - own[j] * second[j])
    for j in range(last):
        up[j] = first[j] * along[j] * second[j + 1]
        down[j + 1] = first[j + 1] * along[j] * second[j]
    up[last] = first[last] * along[last] * second[0]
    down[0] = first[0] * along[last] * second[last]
    if rows.up.shape[1] == 0:
        return
    before, after = rows.up[row - 1], rows.up[row]
    for j in range(last):
        up[j] += before[j] * second[j + 1] + first[j] * after[j]
    up[last] += before[last] * second[0] + first[last] * after[last]
    before, after = rows.down[row - 1], rows.down[row]
    for j in range(1, last + 1):
        down[j] += before[j] * second[j - 1] + first[j] * after[j]
    down[0] += before[0] * second[last] + first[0] * after[0]


@compiled
def coarsen(fine, coarse, work):  # type: ignore[no-untyped-def]
    """Galerkin's operator PᵀAP on the even rows.

    P keeps even rows, and gives odd ones what they take from ones in the row before and after, T⁻¹B1 (Schaffer).
    """
    count, coarse_count = fine.centre.shape[0], coarse.centre.shape[0]
    first, second, total, ones = work[0], work[1], work[2], work[3]
    ones[:] = 1.0
    coarse.centre[:] = fine.centre[::2]
    coarse.north[:] = fine.north[::2]
    if count % 2:
        coarse.east[-1] = fine.east[-1]
        coarse.up[-1] = 0.0
        coarse.down[-1] = 0.0
        if fine.up.shape[1]:
            coarse.up[-1] = fine.up[-1]
            coarse.down[-1] = fine.down[-1]
    for row in range(1, count, 2):
        total[:] = 0.0
        add_previous(fine, row, ones, total)
        solve_row(fine, row, total, first)
        total[:] = 0.0
        add_next(fine, row, ones, total)
        solve_row(fine, row, total, second)
        left, right = row // 2, (row // 2 + 1) % coarse_count
        add_own(coarse.centre[left], coarse.north[left], fine, row, row - 1, first, False)
        add_own(coarse.centre[right], coarse.north[right], fine, row, row, second, True)
        set_coupling(coarse.east[left], coarse.up[left], coarse.down[left], fine, row, first, second)
    if coarse_count == 1:
        fold(coarse.centre[0], coarse.north[0], coarse.east[0], coarse.up[0], coarse.down[0])


@compiled
def fold(centre, north, east, up, down):  # type: ignore[no-untyped-def]
    """Take the couplings of a single row to itself into its own T."""
    last = centre.size - 1
    for j in range(last + 1):
        centre[j] -= 2 * east[j]
        north[j] += up[j] + down[j + 1 if j < last else 0]
    east[:] = 0.0
    up[:] = 0.0
    down[:] = 0.0


@compiled
def silence(rows):  # type: ignore[no-untyped-def]
    """Take unknowns without couplings out of the finest level's matrix, not its factors: the smoother solves them."""
    north, east = rows.north, rows.east
    for row in range(north.shape[0]):
        for j in range(north.shape[1]):
            if north[row, j] + north[row, j - 1] + east[row, j] + east[row - 1, j] == 0.0:
                rows.centre[row, j] = 0.0


@compiled
def set_up(counts, rows, work):  # type: ignore[no-untyped-def]
    """Factorise all rows and make the coarse levels; ``counts`` has the rows of each level, ``work`` shape (4, m)."""
    start = 0
    for level in range(counts.size):
        stop = start + counts[level]
        fine = level_rows(rows, start, stop, counts[0])
        for row in range(counts[level]):
            factorise_row(fine, row)
        if level == 0:
            silence(fine)
        if level + 1 < counts.size:
            coarsen(fine, level_rows(rows, stop, stop + counts[level + 1], counts[0]), work)
        start = stop


@compiled
def relax(rows, row, source, values, total):  # type: ignore[no-untyped-def]
    """Solve a row's equations with the values in the rows beside it."""
    total[:] = source[row]
    add_previous(rows, row, values[row - 1], total)
    add_next(rows, row, values[(row + 1) % values.shape[0]], total)
    solve_row(rows, row, total, values[row])


@compiled
def descend(rows, seam, source, values, coarse_source, total):  # type: ignore[no-untyped-def]
    """Smooth from 0, even rows first, and bring what remains in these to the next level.

    At a ``seam`` the last row, an even one, is coupled to the first.
    """
    count = values.shape[0]
    for row in range(0, count, 2):
        total[:] = source[row]
        if seam and row == count - 1:
            add_next(rows, row, values[0], total)
        solve_row(rows, row, total, values[row])
    for row in range(1, count, 2):
        relax(rows, row, source, values, total)
    for row in range(0, count, 2):
        remainder = coarse_source[row // 2]
        remainder[:] = 0.0
        add_previous(rows, row, values[row - 1], remainder)
        if row + 1 < count:
            add_next(rows, row, values[row + 1], remainder)


@compiled
def ascend(rows, source, values, coarse_values, total):  # type: ignore[no-untyped-def]
    """Correct the even rows by the next level, and smooth in the reverse order."""
    count = values.shape[0]
    for row in range(0, count, 2):
        values[row] += coarse_values[row // 2]
    for row in range(1, count, 2):
        relax(rows, row, source, values, total)
    for row in range(count - 2 + count % 2, -1, -2):
        relax(rows, row, source, values, total)


@compiled
def cycle(counts, rows, across, source, values, total):  # type: ignore[no-untyped-def]
    """One V-cycle from 0: ``values`` of the finest level from its ``source``, arrays of all levels.

    Odd rows are solved exactly after the even ones, and again after the correction: nothing of their residual is left
    to bring down, and nothing to interpolate.
    """
    start = 0
    for level in range(counts.size - 1):
        stop = start + counts[level]
        end = stop + counts[level + 1]
        seam = across and counts[level] % 2 == 1
        here = level_rows(rows, start, stop, counts[0])
        descend(here, seam, source[start:stop], values[start:stop], source[stop:end], total)
        start = stop
    total[:] = source[start]
    solve_row(rows, start, total, values[start])
    for level in range(counts.size - 2, -1, -1):
        stop, start = start, start - counts[level]
        here = level_rows(rows, start, stop, counts[0])
        ascend(here, source[start:stop], values[start:stop], values[stop : stop + counts[level + 1]], total)
