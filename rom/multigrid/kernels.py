"""Loops over the rows of a multigrid hierarchy.

The rows of all levels have the same length m. Couplings along a row form a tridiagonal matrix T, cyclic if the row is
periodic. Couplings to the next row are ``east`` (same column), ``up`` (next column) and ``down`` (previous column).
Couplings out of the grid are 0, so that indices may wrap everywhere.

All arrays of a hierarchy have the same precision, single or double.

All loops that call each other are in this file, since the cache of a compiled loop depends on its own file alone.
Constants are passed as np.int64(0) or np.bool_(True), since numba compiles another version for a plain 0 or True. The
rows of a level are two arrays with the places of its parts, and not one array for each part, since the time to compile
grows with the number of arguments.
"""

import numpy as np

from roughfilm.contact.foundation.compiled import called, compiled, inlined
from roughfilm.rom.multigrid.rows import MIN_HOLE_WEIGHT, MIN_PIVOT, Rows


@called
def level_rows(rows, start, count):  # type: ignore[no-untyped-def]
    """The ``count`` rows of a level of which ``start`` rows are on finer levels; ``rows`` are those of the finest."""
    coarse = np.int64(-1) if start == 0 else rows.up + start
    down = np.int64(-1) if start == 0 else rows.down + start
    return Rows(
        rows.base,
        rows.solver,
        count,
        rows.leak + start,
        rows.centre + start,
        rows.north + start,
        rows.east + start,
        rows.inverse + start,
        rows.factor + start,
        rows.border if rows.border < 0 else rows.border + start,
        coarse,
        down,
    )


@called
def eliminate(rows, row, size, sums):  # type: ignore[no-untyped-def]
    """Factorise the T of the first ``size`` unknowns of a row, from both ends to the middle at the same time.

    ``sums`` are the row sums t of T, and become those of the remaining matrix: a pivot is t plus the next coupling.
    """
    centre, north = rows.base[rows.centre + row], rows.base[rows.north + row]
    inverse, factor = rows.solver[rows.inverse + row], rows.solver[rows.factor + row]
    middle = size // 2
    for j in range(middle):
        end = size - 1 - j
        pivot = sums[j] + north[j]
        inverse[j] = 1 / pivot if pivot > MIN_PIVOT * centre[j] else 0.0
        factor[j] = north[j] * inverse[j]
        sums[j + 1] += factor[j] * sums[j]
        if end > middle:
            pivot = sums[end] + north[end - 1]
            inverse[end] = 1 / pivot if pivot > MIN_PIVOT * centre[end] else 0.0
            factor[end] = north[end - 1] * inverse[end]
            sums[end - 1] += factor[end] * sums[end]
    inverse[middle] = 1 / sums[middle] if sums[middle] > MIN_PIVOT * centre[middle] else 0.0
    factor[middle] = 0.0


@called
def substitute(rows, first, second, size, totals, values, places):  # type: ignore[no-untyped-def]
    """Solve Tx = totals[0] of the ``first`` row and Tx = totals[1] of the ``second`` one, and overwrite the totals.

    Write the solutions to the two ``places``, rows of ``values``. Each solution goes from both ends to the middle and
    back. An unknown waits for the one before it; four independent sequences at the same time hide this wait.
    """
    one, two = values[places[0]], values[places[1]]
    inverse_one, inverse_two = rows.solver[rows.inverse + first], rows.solver[rows.inverse + second]
    factor_one, factor_two = rows.solver[rows.factor + first], rows.solver[rows.factor + second]
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
def solve_rows(rows, first, second, totals, values, places):  # type: ignore[no-untyped-def]
    """Solve Tx = total of two rows, or of one row twice, as ``substitute``; the last unknown of a ring comes last."""
    ring = rows.border >= 0
    last = totals.shape[1] - 1
    substitute(rows, first, second, last if ring else last + 1, totals, values, places)
    if not ring:
        return
    for side in range(1 if places[0] == places[1] else 2):
        row, x = second if side else first, values[places[side]]
        border = rows.solver[rows.border + row]
        closing = totals[side, last] + border[last] * x[0] + rows.solver[rows.factor + row, last] * x[last - 1]
        closing *= rows.solver[rows.inverse + row, last]
        for j in range(last):
            x[j] += closing * border[j]
        x[last] = closing


@called
def add_next(rows, row, values, place, total):  # type: ignore[no-untyped-def]
    """Add to a row the products of its couplings with the next row, whose values are in row ``place``."""
    east, beside = rows.solver[rows.east + row], values[place]
    last = total.size - 1
    for j in range(last + 1):
        total[j] += east[j] * beside[j]
    if rows.up < 0:
        return
    up, down = rows.solver[rows.up + row], rows.solver[rows.down + row]
    for j in range(last):
        total[j] += up[j] * beside[j + 1]
    for j in range(1, last + 1):
        total[j] += down[j] * beside[j - 1]
    total[last] += up[last] * beside[0]
    total[0] += down[0] * beside[last]


@called
def add_previous(rows, row, values, place, total):  # type: ignore[no-untyped-def]
    """Add to a row the products of its couplings with the previous row, whose values are in row ``place``."""
    row = (row if row > 0 else rows.count) - 1
    east, beside = rows.solver[rows.east + row], values[place]
    last = total.size - 1
    for j in range(last + 1):
        total[j] += east[j] * beside[j]
    if rows.up < 0:
        return
    up, down = rows.solver[rows.up + row], rows.solver[rows.down + row]
    for j in range(1, last + 1):
        total[j] += up[j - 1] * beside[j - 1]
    for j in range(last):
        total[j] += down[j + 1] * beside[j + 1]
    total[0] += up[last] * beside[last]
    total[last] += down[0] * beside[0]


@inlined
def factorise_row(rows, row, work):  # type: ignore[no-untyped-def]
    """Compute the diagonal and factorise T; for a periodic row ``border`` is the response to its last unknown."""
    leak, centre, north = rows.base[rows.leak + row], rows.base[rows.centre + row], rows.base[rows.north + row]
    totals, sums = work[2:4], work[4]
    last = sums.size - 1
    for j in range(last + 1):
        sums[j] = leak[j]
        work[0, j] = 1.0
    add_previous(rows, row, work, np.int64(0), sums)
    add_next(rows, row, work, np.int64(0), sums)
    for j in range(last + 1):
        centre[j] = sums[j] + north[j] + north[j - 1 if j else last]
    if rows.border < 0:
        eliminate(rows, row, last + 1, sums)
        return
    for j in range(last + 1):
        totals[0, j] = sums[j]
        totals[1, j] = 0.0
    pivot = sums[last]
    totals[1, 0] = north[last]
    totals[1, last - 1] = north[last - 1]
    sums[0] += north[last]
    sums[last - 1] += north[last - 1]
    eliminate(rows, row, last, sums)
    substitute(rows, row, row, last, totals, work, (np.int64(0), np.int64(1)))
    pivot += north[last] * work[0, 0] + north[last - 1] * work[0, last - 1]
    border = rows.solver[rows.border + row]
    for j in range(last):
        border[j] = work[1, j]
    border[last] = north[last]
    rows.solver[rows.factor + row, last] = north[last - 1]
    rows.solver[rows.inverse + row, last] = 1 / pivot if pivot > MIN_PIVOT * centre[last] else 0.0


@called
def add_own(coarse, place, rows, row, between, share, forward):  # type: ignore[no-untyped-def]
    """Add to the couplings along a coarse row those of STS − SB − BᵀS of an odd row with interpolation weights S.

    B are the couplings ``between`` two rows, from the odd row to the even one (``forward``) or the other way.
    """
    north, along = rows.base[coarse.north + place], rows.base[rows.north + row]
    last = north.size - 1
    for j in range(last):
        north[j] += share[j] * along[j] * share[j + 1]
    north[last] += share[last] * along[last] * share[0]
    if rows.up < 0:
        return
    up, down = rows.solver[rows.up + between], rows.solver[rows.down + between]
    if forward:
        for j in range(last):
            north[j] += share[j] * up[j] + share[j + 1] * down[j + 1]
        north[last] += share[last] * up[last] + share[0] * down[0]
    else:
        for j in range(last):
            north[j] += share[j + 1] * up[j] + share[j] * down[j + 1]
        north[last] += share[0] * up[last] + share[last] * down[0]


@inlined
def set_coupling(coarse, place, rows, row, first, second):  # type: ignore[no-untyped-def]
    """Compute a coarse row's couplings to the next, BS + FB − FTS, across an odd row of interpolation weights F, S."""
    east, up = rows.solver[coarse.east + place], rows.solver[coarse.up + place]
    down = rows.solver[coarse.down + place]
    own, along = rows.base[rows.centre + row], rows.base[rows.north + row]
    last = east.size - 1
    before, after = rows.solver[rows.east + row - 1], rows.solver[rows.east + row]
    for j in range(last + 1):
        east[j] = before[j] * second[j] + first[j] * (after[j] - own[j] * second[j])
    for j in range(last):
        up[j] = first[j] * along[j] * second[j + 1]
        down[j + 1] = first[j + 1] * along[j] * second[j]
    up[last] = first[last] * along[last] * second[0]
    down[0] = first[0] * along[last] * second[last]
    if rows.up < 0:
        return
    before, after = rows.solver[rows.up + row - 1], rows.solver[rows.up + row]
    for j in range(last):
        up[j] += before[j] * second[j + 1] + first[j] * after[j]
    up[last] += before[last] * second[0] + first[last] * after[last]
    before, after = rows.solver[rows.down + row - 1], rows.solver[rows.down + row]
    for j in range(1, last + 1):
        down[j] += before[j] * second[j - 1] + first[j] * after[j]
    down[0] += before[0] * second[last] + first[0] * after[0]


@inlined
def share(rows, row, work):  # type: ignore[no-untyped-def]
    """Compute the interpolation weights T⁻¹B1 of an odd row from the previous and next rows in ``work[:2]``.

    A weight below ``MIN_HOLE_WEIGHT`` of a node outside the problem is set to 0, since it is round-off.
    """
    totals = work[2:4]
    totals[:] = 0.0
    work[4, :] = 1.0
    add_previous(rows, row, work, np.int64(4), totals[0])
    add_next(rows, row, work, np.int64(4), totals[1])
    solve_rows(rows, row, row, totals, work, (np.int64(0), np.int64(1)))
    for side in range(2):
        centre = rows.base[rows.centre + (row + 2 * side - 1) % rows.count]
        for j in range(totals.shape[1]):
            if abs(work[side, j]) < MIN_HOLE_WEIGHT and centre[j] == 0.0:
                work[side, j] = 0.0


@inlined
def leaks(rows, row, work):  # type: ignore[no-untyped-def]
    """Whether an odd row leaks; ``work[4]`` is then the loss of its unknowns for ones in the rows beside it."""
    totals = work[2:4]
    any_leak = False
    for j in range(totals.shape[1]):
        totals[0, j] = totals[1, j] = rows.base[rows.leak + row, j]
        any_leak |= totals[0, j] > 0
    if any_leak:
        solve_rows(rows, row, row, totals, work, (np.int64(4), np.int64(4)))
    return any_leak


@inlined
def coarsen(fine, coarse, work):  # type: ignore[no-untyped-def]
    """Compute Galerkin's operator PᵀAP on the even rows.

    P is the identity on even rows, and has the weights T⁻¹B1 (Schaffer) on odd rows.
    """
    base, solver = fine.base, fine.solver
    count, coarse_count = fine.count, coarse.count
    first, second = work[0], work[1]
    length = base.shape[1]
    for row in range(coarse_count):
        for j in range(length):
            base[coarse.leak + row, j] = base[fine.leak + 2 * row, j]
            base[coarse.north + row, j] = base[fine.north + 2 * row, j]
    if count % 2:
        for j in range(length):
            solver[coarse.east + coarse_count - 1, j] = solver[fine.east + count - 1, j]
            solver[coarse.up + coarse_count - 1, j] = solver[fine.up + count - 1, j] if fine.up >= 0 else 0.0
            solver[coarse.down + coarse_count - 1, j] = solver[fine.down + count - 1, j] if fine.up >= 0 else 0.0
    for row in range(1, count, 2):
        share(fine, row, work)
        left, right = row // 2, (row // 2 + 1) % coarse_count
        if leaks(fine, row, work):
            add_next(fine, row - 1, work, np.int64(4), base[coarse.leak + left])
            add_previous(fine, (row + 1) % count, work, np.int64(4), base[coarse.leak + right])
        add_own(coarse, left, fine, row, row - 1, first, np.bool_(False))
        add_own(coarse, right, fine, row, row, second, np.bool_(True))
        set_coupling(coarse, left, fine, row, first, second)
    if coarse_count == 1:
        for j in range(length):
            after = j + 1 if j + 1 < length else 0
            base[coarse.north, j] += solver[coarse.up, j] + solver[coarse.down, after]
        for j in range(length):
            solver[coarse.east, j] = solver[coarse.up, j] = solver[coarse.down, j] = 0.0


@inlined
def silence(rows):  # type: ignore[no-untyped-def]
    """Remove unknowns without couplings from the coarse levels, since the smoother alone solves them."""
    for row in range(rows.count):
        north, east = rows.base[rows.north + row], rows.solver[rows.east + row]
        before = rows.solver[rows.east + (row if row > 0 else rows.count) - 1]
        for j in range(north.size):
            if north[j] + north[j - 1] + east[j] + before[j] == 0.0:
                rows.base[rows.leak + row, j] = 0.0
                rows.base[rows.centre + row, j] = 0.0


@compiled
def set_up(counts, rows, work):  # type: ignore[no-untyped-def]
    """Factorise all rows and compute the coarse levels; ``counts`` are the rows of each level, ``work`` is (5, m)."""
    start = np.int64(0)
    for level in range(counts.size):
        fine = level_rows(rows, start, counts[level])
        start += counts[level]
        for row in range(counts[level]):
            factorise_row(fine, row, work)
        if level == 0:
            silence(fine)
        if level + 1 < counts.size:
            coarsen(fine, level_rows(rows, start, counts[level + 1]), work)


@called
def relax(rows, row, other, previous, following, source, values, totals):  # type: ignore[no-untyped-def]
    """Solve the equations of two rows without couplings between them, or of one row if ``other`` is the same one.

    ``previous`` and ``following``: whether the rows beside ``row`` have values; those beside another row have.
    """
    for side in range(2):
        place, total = other if side else row, totals[side]
        for j in range(total.size):
            total[j] = source[place, j]
        if previous or place != row:
            add_previous(rows, place, values, (place if place > 0 else rows.count) - 1, total)
        if following or place != row:
            add_next(rows, place, values, place + 1 if place + 1 < rows.count else 0, total)
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
        here = level_rows(rows, start, count)
        descend(here, across and count % 2 == 1, source[start:stop], values[start:stop], source[stop:end], totals)
        start = stop
    last = level_rows(rows, start, np.int64(1))
    relax(last, np.int64(0), np.int64(0), np.bool_(False), np.bool_(False), source[start:], values[start:], totals)
    for level in range(counts.size - 2, -1, -1):
        count = counts[level]
        stop, start = start, start - count
        end = stop + counts[level + 1]
        here = level_rows(rows, start, count)
        ascend(here, source[start:stop], values[start:stop], values[stop:end], totals)
