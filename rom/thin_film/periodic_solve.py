"""Linear systems on a periodic row of cells, each coupled to a few neighbours on both sides."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array


def solve(blocks: Array, right: Array) -> Array:
    """Solve Σ_o blocks[i, r + o] x[i + o] = right[i], o = -r .. r, with i + o modulo the number of cells.

    Parameters
    ----------
    blocks
        Matrix blocks, shape (cells, 2r + 1, n, n), with at least 2r + 1 cells.
    right
        Right-hand sides, shape (cells, n, k).

    Returns
    -------
    array
        Solutions x, shape (cells, n, k).

    Raises
    ------
    LinAlgError
        If a block that is eliminated is singular.

    Notes
    -----
    Groups of r cells are coupled to the groups beside them alone, and cyclic reduction eliminates every second group
    until one is left. Cells that fill no group are eliminated first, by their Schur complement. Pivots are sought
    within a group, so that the method is for systems whose groups can be solved by themselves.

    R. W. Hockney, J. ACM 12 (1965) 95-113, doi:10.1145/321250.321259.
    """
    cells, width, n, _ = blocks.shape
    reach = width // 2
    left_over = cells % reach
    if not left_over:
        return _grouped(blocks, right)
    inner, size, count = cells - left_over, left_over * n, right.shape[2]
    within, rows, columns, corner = _apart(blocks, inner)
    answer = _grouped(within, np.concatenate([right[:inner], columns], axis=2))
    beside = rows @ answer[_ends(inner, reach)].reshape(2 * reach * n, -1)
    last = np.linalg.solve(corner - beside[:, count:], right[inner:].reshape(size, -1) - beside[:, :count])
    return np.concatenate([answer[:, :, :count] - answer[:, :, count:] @ last, last.reshape(left_over, n, count)])


def _ends(cells: int, reach: int) -> list[int]:
    """The cells at both ends of a row, which are coupled across its cut."""
    return [*range(reach), *range(cells - reach, cells)]


def _apart(blocks: Array, inner: int) -> tuple[Array, Array, Array, Array]:
    """The blocks of a ring of the first ``inner`` cells, and the couplings of the cells after them, the border.

    They are those of the border to the ends of the ring, shape (border, ends), those of the ring to the border, shape
    (inner, n, border), and those within the border, as matrices of unknowns.
    """
    cells, width, n, _ = blocks.shape
    reach, border = width // 2, cells - inner
    within, ends = blocks[:inner].copy(), _ends(inner, reach)
    place = {cell: number for number, cell in enumerate([*ends, *range(inner, cells)])}
    rows, columns = np.zeros((border, n, len(place), n)), np.zeros((inner, n, border, n))
    for i in ends:
        crossing = [o for o in range(-reach, reach + 1) if not 0 <= i + o < inner]
        within[i, [reach + o for o in crossing]] = 0.0
        for o in crossing:
            beside = (i + o) % cells
            if beside >= inner:
                columns[i, :, beside - inner] += blocks[i, reach + o]
            else:
                within[i, reach + o + (border if o < 0 else -border)] += blocks[i, reach + o]
    for i in range(inner, cells):
        for o in range(-reach, reach + 1):
            rows[i - inner, :, place[(i + o) % cells]] += blocks[i, reach + o]
    flat = rows.reshape(border * n, -1)
    return within, flat[:, : len(ends) * n], columns.reshape(inner, n, -1), flat[:, len(ends) * n :]


def _grouped(blocks: Array, right: Array) -> Array:
    """The solutions for a whole number of groups of r cells."""
    cells, width, n, _ = blocks.shape
    reach = width // 2
    groups = cells // reach
    parts = np.zeros((3, groups, reach, n, reach, n))
    for first in range(reach):
        for o in range(-reach, reach + 1):
            group, second = divmod(first + o, reach)
            parts[1 + group, :, first, :, second] = blocks[first::reach, reach + o]
    before, own, after = parts.reshape(3, groups, reach * n, reach * n)
    return _reduced(before, own, after, right.reshape(groups, reach * n, -1)).reshape(right.shape)


def _reduced(before: Array, own: Array, after: Array, right: Array) -> Array:
    """Solve before[i] x[i - 1] + own[i] x[i] + after[i] x[i + 1] = right[i] on a ring by cyclic reduction.

    The groups 1, 3, 5 .. are eliminated; of an odd number of groups the last and the first then stay beside each other.
    """
    groups, size, _ = own.shape
    if groups == 1:
        return np.asarray(np.linalg.solve(before + own + after, right), dtype=np.float64)
    odd = np.linalg.solve(own[1::2], np.concatenate([before[1::2], after[1::2], right[1::2]], axis=2))
    count = odd.shape[0]
    left, centre, right_of = before[::2].copy(), own[::2].copy(), after[::2].copy()
    known = right[::2].copy()
    following = (np.arange(count) + 1) % centre.shape[0]
    ahead, behind = right_of[:count] @ odd, left[following] @ odd
    right_of[:count] = -ahead[:, :, size : 2 * size]
    left[following] = -behind[:, :, :size]
    centre[:count] -= ahead[:, :, :size]
    known[:count] -= ahead[:, :, 2 * size :]
    centre[following] -= behind[:, :, size : 2 * size]
    known[following] -= behind[:, :, 2 * size :]
    answer = np.empty_like(right)
    answer[::2] = even = _reduced(left, centre, right_of, known)
    answer[1::2] = (
        odd[:, :, 2 * size :] - odd[:, :, :size] @ even[:count] - odd[:, :, size : 2 * size] @ even[following]
    )
    return answer
