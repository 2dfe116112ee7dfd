"""Linear systems on a row of cells against dense solutions."""

import numpy as np
import pytest

from roughfilm.rom.thin_film import periodic_solve as ring


@pytest.mark.parametrize("cells", [5, 6, 7, 8, 23, 24])
def test_a_ring_of_blocks_is_solved_like_the_whole_matrix(cells):
    random = np.random.default_rng(20050718)
    blocks = random.normal(size=(cells, 5, 3, 3)) + 6 * np.eye(3) * (np.arange(5) == 2)[:, None, None]
    right = random.normal(size=(cells, 3, 2))
    whole = np.zeros((3 * cells, 3 * cells))
    for i in range(cells):
        for o in range(-2, 3):
            j = (i + o) % cells
            whole[3 * i : 3 * i + 3, 3 * j : 3 * j + 3] += blocks[i, o + 2]
    expected = np.linalg.solve(whole, right.reshape(3 * cells, 2)).reshape(cells, 3, 2)
    assert ring.solve(blocks, right) == pytest.approx(expected, rel=1e-9, abs=1e-12)
