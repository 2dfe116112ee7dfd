"""Direct solution of the balances of a film: a band matrix, and the first row of a periodic film apart."""

import numpy as np
from scipy.linalg import lapack, lu_factor, lu_solve

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.balance import FIXED
from roughfilm.rom.cavitation.newton import Linear


class Bands:
    """The factors of the matrix of :class:`roughfilm.rom.cavitation.newton.Linear`, of a film not periodic in y.

    Nodes are numbered along y first, so that the bandwidth is the number ny of nodes across. In a film that is periodic
    in x, the ny unknowns x_s of one row s are eliminated last, with the remaining ones x_r:

        (A_ss - A_sr A_rr⁻¹ A_rs) x_s = b_s - A_sr A_rr⁻¹ b_r.

    A row of nodes without unknowns, such as a groove, is taken for s and needs no elimination. The cost is O(nx ny³).

    Raises
    ------
    ConvergenceError
        If the matrix is singular.
    """

    def __init__(self, linear: Linear, *, periodic: bool) -> None:
        nx, ny = linear.centre.shape
        parts = [linear.centre, linear.west, linear.east, linear.south, linear.north]
        known = np.flatnonzero((linear.kind >= FIXED).all(axis=1))
        self.first = int(known[0]) if periodic and known.size else 0
        self.closed = periodic and not known.size
        self.shape = (nx, ny)
        if self.first:
            parts = [np.roll(part, -self.first, axis=0) for part in parts]
        self.row = [part[0] for part in parts]
        self._factor(*(part[int(self.closed) :].ravel() for part in parts))
        if not self.closed:
            return
        centre, west, east, south, north = self.row
        spread = np.zeros(((nx - 1) * ny, ny), order="F")
        j = np.arange(ny)
        spread[j, j] = parts[1][1]
        spread[(nx - 2) * ny + j, j] += parts[2][-1]
        self.spread = self._solve(spread)
        after, before = self.spread[:ny], self.spread[-ny:]
        inner = np.diag(centre) + np.diag(south[1:], -1) + np.diag(north[:-1], 1)
        self.inner = lu_factor(inner - east[:, None] * after - west[:, None] * before)

    def _factor(self, centre: Array, west: Array, east: Array, south: Array, north: Array) -> None:
        ny, count = self.shape[1], centre.size
        bands = np.zeros((3 * ny + 1, count), order="F")
        bands[2 * ny] = centre
        bands[ny, ny:] += east[:-ny]
        bands[3 * ny, :-ny] += west[ny:]
        bands[2 * ny - 1, 1:] += north[:-1]
        bands[2 * ny + 1, :-1] += south[1:]
        self.bands, self.pivots, fault = lapack.dgbtrf(bands, ny, ny, overwrite_ab=True)
        if fault:
            raise ConvergenceError("cavitation: the matrix of the film is singular", outcome=Outcome.DIVERGED)

    def _solve(self, columns: Array) -> Array:
        ny = self.shape[1]
        solved, _ = lapack.dgbtrs(self.bands, ny, ny, columns, self.pivots)
        return np.asarray(solved)

    def solve(self, sources: Array) -> Array:
        """The unknowns for right-hand sides, each of shape (nx, ny) in the last axis."""
        nx, ny = self.shape
        turned = np.roll(sources, -self.first, axis=0) if self.first else sources
        columns = np.asfortranarray(turned.reshape(nx * ny, -1))
        if self.closed:
            rest = self._solve(columns[ny:])
            _, west, east, _, _ = self.row
            inner = columns[:ny] - east[:, None] * rest[:ny] - west[:, None] * rest[-ny:]
            own = lu_solve(self.inner, inner)
            columns = np.concatenate([own, rest - self.spread @ own])
        else:
            columns = self._solve(columns)
        found = columns.reshape(sources.shape)
        return np.roll(found, self.first, axis=0) if self.first else found
