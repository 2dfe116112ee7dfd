"""Loops over the rows of a multigrid hierarchy.

The rows of all levels have the same length m and are stored in arrays of shape (rows of all levels, m), the finest
level first. The couplings along a row form a tridiagonal matrix T, cyclic if the row is periodic. Couplings to the next
row are ``east`` (same column), ``up`` (next column) and ``down`` (previous column). Couplings out of the grid are 0, so
that indices may wrap everywhere.

All arrays of a hierarchy have the same precision, single or double.

All loops that call each other are in this file, since the cache of a compiled loop depends on its own file alone.
Constants are passed as np.int64(0) or np.bool_(True), since numba compiles another version for a plain 0 or True.
"""

import numpy as np

from roughfilm.contact.foundation.compiled import called, compiled, inlined
from roughfilm.rom.multigrid.rows import MIN_HOLE_WEIGHT, MIN_PIVOT, Rows


@called
def level_rows(rows, start, stop, finest):  # type: ignore[no-untyped-def]
    """The rows [start, stop) of one level; the ``finest`` first rows of the hierarchy have no up and down."""
    return Rows(
        rows.leak[start:stop],
        rows.centre[start:stop],
        rows.north[start:stop],
        rows.east[start:stop],
        rows.up[max(start - finest, 0) : stop - finest],
        rows.down[max(start - finest, 0) : stop - finest],
        rows.inverse[start:stop],
        rows.factor[start:stop],
        rows.border[start:stop],
    )


@called
def eliminate(rows, row, size, sums):  # type: ignore[no-untyped-def]
    """Factorise the T of the first ``size`` unknowns of a row, from both ends to the middle at the same time.

    ``sums`` are the row sums t of T, and become those of the remaining matrix: a pivot is t plus the next coupling.
    """
    centre, north, inverse, factor = rows.centre, rows.north, rows.inverse, rows.factor
    middle = size // 2
    for j in range(middle):
        end = size - 1 - j
        pivot = sums[j] + north[row, j]
        inverse[row, j] = 1 / pivot if pivot > MIN_PIVOT * centre[row, j] else 0.0
        factor[row, j] = north[row, j] * inverse[row, j]
        sums[j + 1] += factor[row, j] * sums[j]
        if end > middle:
            pivot = sums[end] + north[row, end - 1]
            inverse[row, end] = 1 / pivot if pivot > MIN_PIVOT * centre[row, end] else 0.0
            factor[row, end] = north[row, end - 1] * inverse[row, end]
            sums[end - 1] += factor[row, end] * sums[end]
    inverse[row, middle] = 1 / sums[middle] if sums[middle] > MIN_PIVOT * centre[row, middle] else 0.0
    factor[row, middle] = 0.0


@called
def substitute(rows, first, second, size, totals, values, places):  # type: ignore[no-untyped-def]
    """Solve Tx = totals[0] of the ``first`` row and Tx = totals[1] of the ``second`` one, and overwrite the totals.

    Write the solutions to the two ``places``, rows of ``values``. Each solution goes from both ends to the middle and
    back. An unknown waits for the one before it; four independent sequences at the same time hide this wait.
    """
    one, two = values[places[0]], values[places[1]]
    inverse_one, inverse_two = rows.inverse[first], rows.inverse[second]
    factor_one, factor_two = rows.factor[first], rows.factor[second]
    total_one, total_two = totals[0], totals[1]
    middle = size // 2
    pairs = size - 1 - middle
    left_one = right_one = left_two = right_two = total_one.dtype.type(0)
    before_one = after_one = before_two = after_two = left_one
    for j in range(pairs):
        end = size - 1 - j
        left_one = total_one[j] + before_one * left_one
        right_one = total_one[end] + after_one * right_one
        left_two = total_two[j] + before_two * left_two
        right_two = total_two[end] + after_two * right_two
        before_one, after_one = factor_one[j], factor_one[end]
        before_two, after_two = factor_two[j], factor_two[end]
        total_one[j], total_one[end] = left_one, right_one
        total_two[j], total_two[end] = left_two, right_two
    if pairs < middle:
        left_one = total_one[pairs] + before_one * left_one
        left_two = total_two[pairs] + before_two * left_two
        before_one, before_two = factor_one[pairs], factor_two[pairs]
        total_one[pairs], total_two[pairs] = left_one, left_two
    left_one = right_one = (total_one[middle] + before_one * left_one + after_one * right_one) * inverse_one[middle]
    left_two = right_two = (total_two[middle] + before_two * left_two + after_two * right_two) * inverse_two[middle]
    one[middle], two[middle] = left_one, left_two
    if pairs < middle:
        left_one = total_one[pairs] * inverse_one[pairs] + factor_one[pairs] * left_one
        left_two = total_two[pairs] * inverse_two[pairs] + factor_two[pairs] * left_two
        one[pairs], two[pairs] = left_one, left_two
    for j in range(pairs - 1, -1, -1):
        end = size - 1 - j
        left_one = total_one[j] * inverse_one[j] + factor_one[j] * left_one
        right_one = total_one[end] * inverse_one[end] + factor_one[end] * right_one
        left_two = total_two[j] * inverse_two[j] + factor_two[j] * left_two
        right_two = total_two[end] * inverse_two[end] + factor_two[end] * right_two
        one[j], one[end] = left_one, right_one
        two[j], two[end] = left_two, right_two


@called
def close_ring(rows, row, total, values):  # type: ignore[no-untyped-def]
    """Compute the last unknown of a periodic row and add its effect on the others, which ``substitute`` computed."""
    north, border = rows.north, rows.border
    last = total.size - 1
    closing = total[last] + north[row, last] * values[0] + north[row, last - 1] * values[last - 1]
    closing *= rows.inverse[row, last]
    for j in range(last):
        values[j] += closing * border[row, j]
    values[last] = closing


@called
def solve_rows(rows, first, second, totals, values, places):  # type: ignore[no-untyped-def]
    """Solve Tx = total of two rows, or of one row twice, as ``substitute``."""
    ring = rows.border.shape[1] > 0
    size = totals.shape[1]
    substitute(rows, first, second, size - 1 if ring else size, totals, values, places)
    if ring:
        close_ring(rows, first, totals[0], values[places[0]])
        if places[0] != places[1]:
            close_ring(rows, second, totals[1], values[places[1]])


@called
def add_next(rows, row, values, place, total):  # type: ignore[no-untyped-def]
    """Add to a row the products of its couplings with the next row, whose values are in row ``place``."""
    east, up, down = rows.east, rows.up, rows.down
    last = total.size - 1
    for j in range(last + 1):
        total[j] += east[row, j] * values[place, j]
    if up.shape[0] == 0:
        return
    for j in range(last):
        total[j] += up[row, j] * values[place, j + 1]
    for j in range(1, last + 1):
        total[j] += down[row, j] * values[place, j - 1]
    total[last] += up[row, last] * values[place, 0]
    total[0] += down[row, 0] * values[place, last]


@called
def add_previous(rows, row, values, place, total):  # type: ignore[no-untyped-def]
    """Add to a row the products of its couplings with the previous row, whose values are in row ``place``."""
    east, up, down = rows.east, rows.up, rows.down
    last = total.size - 1
    row = (row if row > 0 else east.shape[0]) - 1
    for j in range(last + 1):
        total[j] += east[row, j] * values[place, j]
    if up.shape[0] == 0:
        return
    for j in range(1, last + 1):
        total[j] += up[row, j - 1] * values[place, j - 1]
    for j in range(last):
        total[j] += down[row, j + 1] * values[place, j + 1]
    total[0] += up[row, last] * values[place, last]
    total[last] += down[row, 0] * values[place, 0]


@called
def factorise_row(rows, row, work):  # type: ignore[no-untyped-def]
    """Compute the diagonal and factorise T; for a periodic row ``border`` is the response to its last unknown."""
    north, border = rows.north, rows.border
    totals, sums = work[2:4], work[4]
    last = sums.size - 1
    for j in range(last + 1):
        sums[j] = rows.leak[row, j]
        work[0, j] = 1.0
    add_previous(rows, row, work, np.int64(0), sums)
    add_next(rows, row, work, np.int64(0), sums)
    for j in range(last + 1):
        rows.centre[row, j] = sums[j] + north[row, j] + north[row, j - 1 if j else last]
    if border.shape[1] == 0:
        eliminate(rows, row, last + 1, sums)
        return
    for j in range(last + 1):
        totals[0, j] = sums[j]
        totals[1, j] = 0.0
    pivot = sums[last]
    totals[1, 0] = north[row, last]
    totals[1, last - 1] = north[row, last - 1]
    sums[0] += north[row, last]
    sums[last - 1] += north[row, last - 1]
    eliminate(rows, row, last, sums)
    substitute(rows, row, row, last, totals, work, (np.int64(0), np.int64(1)))
    pivot += north[row, last] * work[0, 0] + north[row, last - 1] * work[0, last - 1]
    rows.inverse[row, last] = 1 / pivot if pivot > MIN_PIVOT * rows.centre[row, last] else 0.0
    for j in range(last):
        border[row, j] = work[1, j]


@called
def add_own(north, rows, row, between, share, forward):  # type: ignore[no-untyped-def]
    """Add to the couplings along a coarse row those of STS − SB − BᵀS of an odd row with interpolation weights S.

    B are the couplings ``between`` two rows, from the odd row to the even one (``forward``) or the other way.
    """
    along = rows.north[row]
    last = north.size - 1
    for j in range(last):
        north[j] += share[j] * along[j] * share[j + 1]
    north[last] += share[last] * along[last] * share[0]
    if rows.up.shape[0] == 0:
        return
    up, down = rows.up[between], rows.down[between]
    if forward:
        for j in range(last):
            north[j] += share[j] * up[j] + share[j + 1] * down[j + 1]
        north[last] += share[last] * up[last] + share[0] * down[0]
    else:
        for j in range(last):
            north[j] += share[j + 1] * up[j] + share[j] * down[j + 1]
        north[last] += share[0] * up[last] + share[last] * down[0]


@called
def set_coupling(east, up, down, rows, row, first, second):  # type: ignore[no-untyped-def]
    """Compute a coarse row's couplings to the next, BS + FB − FTS, across an odd row of interpolation weights F, S."""
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
    if rows.up.shape[0] == 0:
        return
    before, after = rows.up[row - 1], rows.up[row]
    for j in range(last):
        up[j] += before[j] * second[j + 1] + first[j] * after[j]
    up[last] += before[last] * second[0] + first[last] * after[last]
    before, after = rows.down[row - 1], rows.down[row]
    for j in range(1, last + 1):
        down[j] += before[j] * second[j - 1] + first[j] * after[j]
    down[0] += before[0] * second[last] + first[0] * after[0]


@called
def share(rows, row, work):  # type: ignore[no-untyped-def]
    """Compute the interpolation weights T⁻¹B1 of an odd row from the previous and next rows in ``work[:2]``.

    A weight below ``MIN_HOLE_WEIGHT`` of a node outside the problem is set to 0, since it is round-off.
    """
    totals, centre = work[2:4], rows.centre
    totals[:] = 0.0
    work[4, :] = 1.0
    add_previous(rows, row, work, np.int64(4), totals[0])
    add_next(rows, row, work, np.int64(4), totals[1])
    solve_rows(rows, row, row, totals, work, (np.int64(0), np.int64(1)))
    for side in range(2):
        beside = (row + 2 * side - 1) % centre.shape[0]
        for j in range(totals.shape[1]):
            if abs(work[side, j]) < MIN_HOLE_WEIGHT and centre[beside, j] == 0.0:
                work[side, j] = 0.0


@called
def leaks(rows, row, work):  # type: ignore[no-untyped-def]
    """Whether an odd row leaks; ``work[4]`` is then the loss of its unknowns for ones in the rows beside it."""
    totals = work[2:4]
    any_leak = False
    for j in range(totals.shape[1]):
        totals[0, j] = totals[1, j] = rows.leak[row, j]
        any_leak |= totals[0, j] > 0
    if any_leak:
        solve_rows(rows, row, row, totals, work, (np.int64(4), np.int64(4)))
    return any_leak


@inlined
def coarsen(fine, coarse, work):  # type: ignore[no-untyped-def]
    """Compute Galerkin's operator PᵀAP on the even rows.

    P is the identity on even rows, and has the weights T⁻¹B1 (Schaffer) on odd rows.
    """
    count, coarse_count = fine.centre.shape[0], coarse.centre.shape[0]
    first, second = work[0], work[1]
    length = fine.centre.shape[1]
    for row in range(coarse_count):
        for j in range(length):
            coarse.leak[row, j] = fine.leak[2 * row, j]
            coarse.north[row, j] = fine.north[2 * row, j]
    if count % 2:
        for j in range(length):
            coarse.east[coarse_count - 1, j] = fine.east[count - 1, j]
            coarse.up[coarse_count - 1, j] = fine.up[count - 1, j] if fine.up.shape[0] else 0.0
            coarse.down[coarse_count - 1, j] = fine.down[count - 1, j] if fine.up.shape[0] else 0.0
    for row in range(1, count, 2):
        share(fine, row, work)
        left, right = row // 2, (row // 2 + 1) % coarse_count
        if leaks(fine, row, work):
            add_next(fine, row - 1, work, np.int64(4), coarse.leak[left])
            add_previous(fine, (row + 1) % count, work, np.int64(4), coarse.leak[right])
        add_own(coarse.north[left], fine, row, row - 1, first, np.bool_(False))
        add_own(coarse.north[right], fine, row, row, second, np.bool_(True))
        set_coupling(coarse.east[left], coarse.up[left], coarse.down[left], fine, row, first, second)
    if coarse_count == 1:
        for j in range(length):
            coarse.north[0, j] += coarse.up[0, j] + coarse.down[0, j + 1 if j + 1 < length else 0]
        coarse.east[0, :] = coarse.up[0, :] = coarse.down[0, :] = 0.0


@inlined
def silence(rows):  # type: ignore[no-untyped-def]
    """Remove unknowns without couplings from the coarse levels, since the smoother alone solves them."""
    north, east = rows.north, rows.east
    for row in range(north.shape[0]):
        for j in range(north.shape[1]):
            if north[row, j] + north[row, j - 1] + east[row, j] + east[row - 1, j] == 0.0:
                rows.leak[row, j] = 0.0
                rows.centre[row, j] = 0.0


@compiled
def set_up(counts, rows, work):  # type: ignore[no-untyped-def]
    """Factorise all rows and compute the coarse levels; ``counts`` are the rows of each level, ``work`` is (5, m)."""
    start = np.int64(0)
    for level in range(counts.size):
        stop = start + counts[level]
        fine = level_rows(rows, start, stop, counts[0])
        for row in range(counts[level]):
            factorise_row(fine, row, work)
        if level == 0:
            silence(fine)
        if level + 1 < counts.size:
            coarsen(fine, level_rows(rows, stop, stop + counts[level + 1], counts[0]), work)
        start = stop


@called
def gather(rows, row, previous, following, source, values, total):  # type: ignore[no-untyped-def]
    """Compute the right-hand side of a row; ``previous`` and ``following``: whether those rows have values."""
    count = values.shape[0]
    for j in range(total.size):
        total[j] = source[row, j]
    if previous:
        add_previous(rows, row, values, (row if row > 0 else count) - 1, total)
    if following:
        add_next(rows, row, values, row + 1 if row + 1 < count else 0, total)


@called
def relax(rows, row, other, previous, following, source, values, totals):  # type: ignore[no-untyped-def]
    """Solve the equations of a row as in ``gather`` and, if it is ``other``, of another row with both its neighbours.

    No coupling leads from one row to the other.
    """
    gather(rows, row, previous, following, source, values, totals[0])
    if row == other:
        for j in range(totals.shape[1]):
            totals[1, j] = totals[0, j]
    else:
        gather(rows, other, np.bool_(True), np.bool_(True), source, values, totals[1])
    solve_rows(rows, row, other, totals, values, (row, other))


@called
def bring_down(rows, row, values, left):  # type: ignore[no-untyped-def]
    """Compute the residual ``left`` of an even row, which was solved before the rows beside it."""
    count = values.shape[0]
    left[:] = 0.0
    add_previous(rows, row, values, (row if row > 0 else count) - 1, left)
    if row + 1 < count:
        add_next(rows, row, values, row + 1, left)


@inlined
def descend(rows, seam, source, values, remainder, totals):  # type: ignore[no-untyped-def]
    """Relax even rows from 0, then odd rows, and compute the residuals of even rows.

    At a ``seam`` the last row, an even one, is coupled to the first and follows it. The order keeps rows in the cache.
    """
    count = values.shape[0]
    for row in range(0, min(count, 4), 2):
        relax(rows, row, row, np.bool_(False), seam and row + 1 == count, source, values, totals)
    for odd in range(1, count, 2):
        row = odd + 3
        if row < count:
            relax(rows, row, odd, np.bool_(False), seam and row + 1 == count, source, values, totals)
        else:
            relax(rows, odd, odd, np.bool_(True), np.bool_(True), source, values, totals)
        if odd > 1:
            bring_down(rows, odd - 1, values, remainder[odd // 2])
    if count > 2 and count % 2:
        bring_down(rows, count - 1, values, remainder[count // 2])
    bring_down(rows, np.int64(0), values, remainder[0])


@inlined
def ascend(rows, source, values, correction, totals):  # type: ignore[no-untyped-def]
    """Add the correction to even rows, then relax odd rows and even rows, from the last to the first."""
    count, last = values.shape[0], (values.shape[0] - 1) // 2 * 2
    add_row(values[0], correction[0])
    if last > 0:
        add_row(values[last], correction[last // 2])
    if count % 2 == 0:
        relax(rows, count - 1, count - 1, np.bool_(True), np.bool_(True), source, values, totals)
    for row in range(last, 0, -2):
        if row > 2:
            add_row(values[row - 2], correction[row // 2 - 1])
        solved = row + 2 if row < last else row - 1
        relax(rows, solved, row - 1, np.bool_(True), np.bool_(True), source, values, totals)
    for row in range(min(last, 2), -1, -2):
        relax(rows, row, row, np.bool_(True), np.bool_(True), source, values, totals)


@inlined
def add_row(values, correction):  # type: ignore[no-untyped-def]
    """Add a coarse row to a fine one."""
    for j in range(values.size):
        values[j] += correction[j]


@compiled
def cycle(counts, rows, across, source, values, totals):  # type: ignore[no-untyped-def]
    """Compute one V-cycle from 0: ``values`` of the finest level from its ``source``, arrays of all levels.

    Odd rows are solved exactly before and after the next level, so that their residual is 0 and they need no
    interpolation.
    """
    start = np.int64(0)
    for level in range(counts.size - 1):
        count = counts[level]
        stop = start + count
        end = stop + counts[level + 1]
        here = level_rows(rows, start, stop, counts[0])
        descend(here, across and count % 2 == 1, source[start:stop], values[start:stop], source[stop:end], totals)
        start = stop
    last = level_rows(rows, start, start + 1, counts[0])
    relax(last, np.int64(0), np.int64(0), np.bool_(False), np.bool_(False), source[start:], values[start:], totals)
    for level in range(counts.size - 2, -1, -1):
        count = counts[level]
        stop, start = start, start - count
        end = stop + counts[level + 1]
        here = level_rows(rows, start, stop, counts[0])
        ascend(here, source[start:stop], values[start:stop], values[stop:end], totals)
