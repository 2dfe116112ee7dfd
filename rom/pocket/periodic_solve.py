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
        If the system without the coupling of the last cell to the first is singular.

    Notes
    -----
    Banded elimination with partial pivoting solves the system without the periodic coupling, which the Woodbury
    identity adds.
    """
    from scipy.linalg import solve_banded  # slow to import, and most commands do without

    cells, width, n, _ = blocks.shape
    reach = width // 2
    band = (reach + 1) * n - 1
    banded = np.zeros((2 * band + 1, cells * n))
    r = np.arange(n)
    at_cut = np.array([*range(cells - reach, cells), *range(reach)])
    place = {int(cell): number for number, cell in enumerate(at_cut)}
    across_cut = np.zeros((cells, n, 2 * reach, n))
    for o in range(-reach, reach + 1):
        rows = np.arange(max(0, -o), cells - max(0, o))
        row = rows[:, None, None] * n + r[:, None]
        column = (rows[:, None, None] + o) * n + r
        banded[band + row - column, np.broadcast_to(column, (rows.size, n, n))] = blocks[rows, reach + o]
        for i in (*range(-o), *range(cells - max(0, o), cells)):
            across_cut[i, :, place[(i + o) % cells]] += blocks[i, reach + o]
    known = np.concatenate([right.reshape(cells * n, -1), across_cut.reshape(cells * n, -1)], axis=1)
    answer = solve_banded((band, band), banded, known, overwrite_ab=True, overwrite_b=True, check_finite=False)
    count = right.shape[2]
    inner, outer = answer[:, :count], answer[:, count:]
    chosen = (at_cut[:, None] * n + r).ravel()
    meeting = np.linalg.solve(np.eye(chosen.size) + outer[chosen], inner[chosen])
    return np.asarray((inner - outer @ meeting).reshape(cells, n, count))
