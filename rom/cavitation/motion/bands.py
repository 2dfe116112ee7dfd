"""Direct solution of the balances of a film: a band matrix, and the first row of a periodic film apart."""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack, lu_factor, lu_solve

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import compiled
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.newton import Linear


@compiled
def write_bands(known, centre, west, east, south, north, begin, bands):  # type: ignore[no-untyped-def]
    """Write the matrix of the rows from ``begin`` on, cyclically, into LAPACK's band storage, which is zero before.

    There are as many rows as ``bands`` has columns for. Unknowns of ``known`` nodes do not change: 1 · change = 0.
    """
    nx, ny = centre.shape
    rows = bands.shape[1] // ny
    for row in range(rows):
        i = (begin + row) % nx
        before, after = (i - 1) % nx, (i + 1) % nx
        for j in range(ny):
            n = row * ny + j
            if known[i, j]:
                bands[2 * ny, n] = 1.0
                continue
            bands[2 * ny, n] = centre[i, j]
            if row > 0 and not known[before, j]:
                bands[3 * ny, n - ny] += west[i, j]
            if row + 1 < rows and not known[after, j]:
                bands[ny, n + ny] += east[i, j]
            if j > 0 and not known[i, j - 1]:
                bands[2 * ny + 1, n - 1] += south[i, j]
            if j + 1 < ny and not known[i, j + 1]:
                bands[2 * ny - 1, n + 1] += north[i, j]


class Bands:
    """The factors of the matrix of :class:`roughfilm.rom.cavitation.newton.Linear`, of a film not periodic in y.

    Nodes are numbered along y first, so that the bandwidth is the number ny of nodes across. In a film that is periodic
    in x, the ny unknowns x_s of one row s are eliminated last, with the remaining ones x_r:

        (A_ss - A_sr A_rr⁻¹ A_rs) x_s = b_s - A_sr A_rr⁻¹ b_r.

    A row of nodes without unknowns, such as a groove, is taken for s and needs no elimination. The cost is O(nx ny³).

    Parameters
    ----------
    linear : the derivatives of the balances.
    known : nodes whose unknown does not change, shape (nx, ny); their right-hand sides are zero.
    periodic : whether the film is periodic in x.

    Raises
    ------
    ConvergenceError
        If the matrix is singular.
    """

    def __init__(self, linear: Linear, known: NDArray[np.bool_], *, periodic: bool) -> None:
        nx, ny = self.shape = linear.centre.shape
        cuts = np.flatnonzero(known.all(axis=1)) if periodic else np.zeros(1, dtype=int)
        self.first = int(cuts[0]) if cuts.size else 0
        self.closed = not cuts.size
        parts = (linear.centre, linear.west, linear.east, linear.south, linear.north)
        bands = np.zeros((3 * ny + 1, (nx - int(self.closed)) * ny), order="F")
        write_bands(known, *parts, self.first + int(self.closed), bands)
        self.bands, self.pivots, fault = lapack.dgbtrf(bands, ny, ny, overwrite_ab=True)
        if fault:
            raise ConvergenceError("cavitation: the matrix of the film is singular", outcome=Outcome.DIVERGED)
        if self.closed:
            self._close(linear, known)

    def _close(self, linear: Linear, known: NDArray[np.bool_]) -> None:
        """Eliminate all rows but the first, which closes the film."""
        nx, ny = self.shape
        own, j = known[0], np.arange(ny)
        spread = np.zeros(((nx - 1) * ny, ny), order="F")
        spread[j, j] = np.where(own | known[1], 0.0, linear.west[1])
        spread[(nx - 2) * ny + j, j] += np.where(own | known[-1], 0.0, linear.east[-1])
        self.spread = self._solve(spread)
        self.west = np.where(own | known[-1], 0.0, linear.west[0])
        self.east = np.where(own | known[1], 0.0, linear.east[0])
        beside = own[1:] | own[:-1]
        inner = np.diag(np.where(own, 1.0, linear.centre[0]))
        inner += np.diag(np.where(beside, 0.0, linear.south[0, 1:]), -1)
        inner += np.diag(np.where(beside, 0.0, linear.north[0, :-1]), 1)
        after, before = self.spread[:ny], self.spread[-ny:]
        self.inner = lu_factor(inner - self.east[:, None] * after - self.west[:, None] * before)

    def _solve(self, columns: Array) -> Array:
        ny = self.shape[1]
        solved, _ = lapack.dgbtrs(self.bands, ny, ny, columns, self.pivots)
        return np.asarray(solved)

    def solve(self, sources: Array) -> Array:
        """The changes of the unknowns for right-hand sides, each of shape (nx, ny) in the last axis."""
        nx, ny = self.shape
        turned = np.roll(sources, -self.first, axis=0) if self.first else sources
        columns = np.asfortranarray(turned.reshape(nx * ny, -1))
        if self.closed:
            rest = self._solve(columns[ny:])
            inner = columns[:ny] - self.east[:, None] * rest[:ny] - self.west[:, None] * rest[-ny:]
            own = lu_solve(self.inner, inner)
            columns = np.concatenate([own, rest - self.spread @ own])
        else:
            columns = self._solve(columns)
        changes = columns.reshape(sources.shape)
        return np.roll(changes, self.first, axis=0) if self.first else changes
