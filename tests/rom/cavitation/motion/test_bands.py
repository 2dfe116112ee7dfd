"""Direct solutions by bands, and of rings, against a general sparse solver."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import lil_array
from scipy.sparse.linalg import spsolve

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.cavitation.motion.bands import Bands, Ring, factors_of
from roughfilm.rom.cavitation.newton import Linear


def system(shape, *, periodic, seed):
    """A random system with a dominant diagonal: neighbours beyond the ends have no entries."""
    random = np.random.default_rng(seed)
    west, east, south, north = random.uniform(-1.0, 0.0, (4, *shape))
    if not periodic:
        west[0] = east[-1] = 0.0
    south[:, 0] = north[:, -1] = 0.0
    nothing = np.zeros(shape)
    centre = 4.5 + random.uniform(0.0, 1.0, shape)
    kind = np.zeros(shape, dtype=np.int8)
    return Linear(kind, nothing, nothing, centre, west, east, south, north)


def by_sparse(linear, known, sources):
    """The solution of the whole sparse system with 1 · change = 0 at known nodes."""
    nx, ny = known.shape
    matrix = lil_array((nx * ny, nx * ny))
    for i in range(nx):
        for j in range(ny):
            row = i * ny + j
            matrix[row, row] = 1.0 if known[i, j] else linear.centre[i, j]
            beside = (
                (i - 1, j, linear.west),
                (i + 1, j, linear.east),
                (i, j - 1, linear.south),
                (i, j + 1, linear.north),
            )
            for k, m, part in beside:
                if not known[i, j] and part[i, j] and not known[k % nx, m]:
                    matrix[row, (k % nx) * ny + m] += part[i, j]
    right = np.where(known[..., None], 0.0, sources).reshape(nx * ny, -1)
    return spsolve(matrix.tocsc(), right).reshape(sources.shape)


@pytest.mark.parametrize("ny", [1, 2, 5])
@pytest.mark.parametrize(
    ("periodic", "grooves"),
    [(False, ()), (False, (0, 8)), (True, ()), (True, (0,)), (True, (3, 4)), (True, (8,))],
    ids=["open", "open, fixed ends", "periodic", "groove at 0", "groove inside", "groove at the end"],
)
def test_bands_solve_what_a_sparse_solver_solves(ny, periodic, grooves):
    linear = system((9, ny), periodic=periodic, seed=ny)
    known = np.random.default_rng(1).random((9, ny)) < 0.2
    known[~np.isin(np.arange(9), grooves) & known.all(axis=1)] = False
    known[list(grooves)] = True
    sources = np.where(known[..., None], 0.0, np.random.default_rng(2).normal(size=(9, ny, 3)))
    ours = Bands(linear, known, periodic=periodic).solve(sources)
    np.testing.assert_allclose(ours, by_sparse(linear, known, sources), rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("periodic", [False, True])
def test_rows_are_exchanged_where_the_diagonal_is_small(periodic):
    linear = replace(
        system((9, 4), periodic=periodic, seed=3), centre=np.random.default_rng(4).normal(scale=0.3, size=(9, 4))
    )
    known = np.zeros((9, 4), dtype=bool)
    sources = np.random.default_rng(5).normal(size=(9, 4, 2))
    bands = Bands(linear, known, periodic=periodic)
    assert bands.pivots.any()
    np.testing.assert_allclose(bands.solve(sources), by_sparse(linear, known, sources), rtol=1e-9, atol=1e-10)


def test_wide_rings_are_solved_by_a_sparse_solver():
    linear = system((9, 60), periodic=True, seed=6)
    known = np.random.default_rng(7).random((9, 60)) < 0.2
    sources = np.where(known[..., None], 0.0, np.random.default_rng(8).normal(size=(9, 60, 3)))
    factors = factors_of(linear, known, periodic=True)
    assert isinstance(factors, Ring)
    np.testing.assert_allclose(factors.solve(sources), by_sparse(linear, known, sources), rtol=1e-11, atol=1e-12)
    known[4] = True
    assert isinstance(factors_of(linear, known, periodic=True), Bands)


@pytest.mark.parametrize(("shape", "periodic"), [((5, 2), False), ((5, 2), True), ((5, 60), True)])
def test_a_singular_matrix_is_an_error_in_one_line(shape, periodic):
    linear = system(shape, periodic=periodic, seed=0)
    for part in (linear.centre, linear.west, linear.east, linear.south, linear.north):
        part[2] = 0.0
    with pytest.raises(ConvergenceError, match="the matrix of the film is singular"):
        factors_of(linear, np.zeros(shape, dtype=bool), periodic=periodic)
