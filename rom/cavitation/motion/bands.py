"""Direct solution of the balances of a film: by bands, or by a sparse matrix where it closes to a wide ring."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import compiled
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.cavitation.newton import Linear

WIDE = 48
"""Largest number of nodes across a ring that is solved by bands."""

PIVOT_THRESHOLD = 0.1
"""Size of a diagonal entry over the largest of its column from which on it is taken as the pivot of a ring."""


@compiled
def write_bands(known, centre, west, east, south, north, begin, bands):  # type: ignore[no-untyped-def]
    """Write the matrix of the rows from ``begin`` on, cyclically, into bands, which are zero before.

    Entry (r, n) of the matrix is ``bands[n, 2 ny + r - n]``, as in LAPACK. There are as many rows as ``bands`` has
    columns for. Unknowns of ``known`` nodes do not change: 1 · change = 0.
    """
    nx, ny = centre.shape
    rows = bands.shape[0] // ny
    for row in range(rows):
        i = (begin + row) % nx
        before, after = (i - 1) % nx, (i + 1) % nx
        for j in range(ny):
            n = row * ny + j
            if known[i, j]:
                bands[n, 2 * ny] = 1.0
                continue
            bands[n, 2 * ny] = centre[i, j]
            if row > 0 and not known[before, j]:
                bands[n - ny, 3 * ny] += west[i, j]
            if row + 1 < rows and not known[after, j]:
                bands[n + ny, ny] += east[i, j]
            if j > 0 and not known[i, j - 1]:
                bands[n - 1, 2 * ny + 1] += south[i, j]
            if j + 1 < ny and not known[i, j + 1]:
                bands[n + 1, 2 * ny - 1] += north[i, j]


@compiled
def factorise(bands, pivots):  # type: ignore[no-untyped-def]
    """Replace a band matrix by its factors L and U, with row exchanges; ``pivots[n]`` rows below n lies its pivot.

    Returns 0, or 1 if the matrix is singular. For bands as narrow as those of films it is as fast as LAPACK, whose
    threads would cost several times what they save.

    Source: Golub and Van Loan 2013, Matrix Computations, 4.3.
    """
    count, width = bands.shape[0], (bands.shape[1] - 1) // 3
    last = 0
    for n in range(count):
        below = min(width, count - 1 - n)
        own = bands[n, 2 * width :]
        largest, pivot = abs(own[0]), 0
        for r in range(1, below + 1):
            if abs(own[r]) > largest:
                largest, pivot = abs(own[r]), r
        if not largest > 0.0:
            return 1
        pivots[n] = pivot
        last = max(last, min(n + pivot + width, count - 1))
        if pivot:
            for k in range(last - n + 1):
                column = bands[n + k, 2 * width - k :]
                column[0], column[pivot] = column[pivot], column[0]
        inverse = 1 / own[0]
        for r in range(1, below + 1):
            own[r] *= inverse
        lower = own[1:]
        for k in range(1, last - n + 1):
            factor = bands[n + k, 2 * width - k]
            if factor != 0.0:
                column = bands[n + k, 2 * width - k + 1 :]
                for r in range(below):
                    column[r] -= factor * lower[r]
    return 0


@compiled
def substitute(bands, pivots, sides):  # type: ignore[no-untyped-def]
    """Replace right-hand sides, shape (sides, count), by the solutions, from the factors of :func:`factorise`."""
    count, width = bands.shape[0], (bands.shape[1] - 1) // 3
    height = width
    for n in range(count):
        if pivots[n]:
            height = 2 * width
    for side in range(sides.shape[0]):
        values = sides[side]
        for n in range(count):
            at = n + pivots[n]
            values[n], values[at] = values[at], values[n]
            if values[n] != 0.0:
                value, lower, rest = values[n], bands[n, 2 * width + 1 :], values[n + 1 :]
                for r in range(min(width, count - 1 - n)):
                    rest[r] -= lower[r] * value
        for n in range(count - 1, -1, -1):
            values[n] /= bands[n, 2 * width]
            above = min(n, height)
            value, upper, rest = values[n], bands[n, 2 * width - above :], values[n - above :]
            for r in range(above):
                rest[r] -= upper[r] * value


@compiled
def write_ring(known, centre, west, east, south, north, values, columns, begins):  # type: ignore[no-untyped-def]
    """Write the matrix of a film that is periodic in x by rows; returns the number of its entries."""
    nx, ny = centre.shape
    count = 0
    for i in range(nx):
        before, after = (i - 1) % nx, (i + 1) % nx
        for j in range(ny):
            begins[i * ny + j] = count
            values[count], columns[count] = (1.0 if known[i, j] else centre[i, j]), i * ny + j
            count += 1
            if known[i, j]:
                continue
            for row, column, part in (
                (before, j, west[i, j]),
                (after, j, east[i, j]),
                (i, j - 1, south[i, j]),
                (i, j + 1, north[i, j]),
            ):
                if 0 <= column < ny and not known[row, column]:
                    values[count], columns[count] = part, row * ny + column
                    count += 1
    begins[nx * ny] = count
    return count


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
        self.bands = np.zeros(((nx - int(self.closed)) * ny, 3 * ny + 1))
        self.pivots = np.empty(len(self.bands), dtype=np.int64)
        write_bands(known, *parts, self.first + int(self.closed), self.bands)
        if factorise(self.bands, self.pivots):
            raise _singular()
        if self.closed:
            self._close(linear, known)

    def _close(self, linear: Linear, known: NDArray[np.bool_]) -> None:
        """Eliminate all rows but the first, which closes the film."""
        nx, ny = self.shape
        own, j = known[0], np.arange(ny)
        self.spread = np.zeros((ny, (nx - 1) * ny))
        self.spread[j, j] = np.where(own | known[1], 0.0, linear.west[1])
        self.spread[j, (nx - 2) * ny + j] += np.where(own | known[-1], 0.0, linear.east[-1])
        substitute(self.bands, self.pivots, self.spread)
        self.west = np.where(own | known[-1], 0.0, linear.west[0])
        self.east = np.where(own | known[1], 0.0, linear.east[0])
        beside = own[1:] | own[:-1]
        inner = np.diag(np.where(own, 1.0, linear.centre[0]))
        inner += np.diag(np.where(beside, 0.0, linear.south[0, 1:]), -1)
        inner += np.diag(np.where(beside, 0.0, linear.north[0, :-1]), 1)
        after, before = self.spread[:, :ny].T, self.spread[:, -ny:].T
        self.inner = inner - self.east[:, None] * after - self.west[:, None] * before

    def _first_row(self, columns: Array) -> Array:
        """The unknowns of the row that is eliminated last, in the last axis.

        For so few unknowns LAPACK's ``gesv`` starts no threads, which ``getrs`` does; they cost more than the solution.
        """
        try:
            return np.asarray(np.linalg.solve(self.inner, columns.T).T)
        except np.linalg.LinAlgError:
            raise _singular() from None

    def solve(self, sources: Array) -> Array:
        """The changes of the unknowns for right-hand sides, each of shape (nx, ny) in the last axis."""
        nx, ny = self.shape
        turned = np.roll(sources, -self.first, axis=0) if self.first else sources
        sides = np.moveaxis(turned, -1, 0).copy().reshape(-1, nx * ny)
        rest = sides[:, ny:].copy() if self.closed else sides
        substitute(self.bands, self.pivots, rest)
        if self.closed:
            own = self._first_row(sides[:, :ny] - self.east * rest[:, :ny] - self.west * rest[:, -ny:])
            sides[:, :ny] = own
            sides[:, ny:] = rest - np.einsum("sj,jn->sn", own, self.spread)
        changes = np.moveaxis(sides.reshape(-1, nx, ny), 0, -1)
        return np.roll(changes, self.first, axis=0) if self.first else changes


class Ring:
    """The factors of the matrix of a wide film that is periodic in x, or of a complex one, by SuperLU.

    The order of elimination has the least degree, so that 256 × 129 nodes take a tenth of the time of bands, whose last
    row is full; up to about 40 nodes across bands are faster. Parameters and errors are those of :class:`Bands`.
    """

    def __init__(self, linear: Linear, known: NDArray[np.bool_]) -> None:
        self.shape = linear.centre.shape
        count = linear.centre.size
        values, columns = np.empty(5 * count, dtype=linear.centre.dtype), np.empty(5 * count, dtype=np.int32)
        begins = np.empty(count + 1, dtype=np.int32)
        parts = (linear.centre, linear.west, linear.east, linear.south, linear.north)
        entries = write_ring(known, *parts, values, columns, begins)
        transposed = csc_array((values[:entries], columns[:entries], begins), shape=(count, count))
        options = {"SymmetricMode": True}
        try:
            self.factors = splu(
                transposed, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=PIVOT_THRESHOLD, options=options
            )
        except RuntimeError:
            raise _singular() from None

    def solve(self, sources: Array) -> Array:
        """The changes of the unknowns for right-hand sides, each of shape (nx, ny) in the last axis."""
        sides = sources.reshape(self.shape[0] * self.shape[1], -1)
        return np.asarray(self.factors.solve(np.asfortranarray(sides), trans="T").reshape(sources.shape))


def factors_of(linear: Linear, known: NDArray[np.bool_], *, periodic: bool) -> Bands | Ring:
    """The factors of the matrix of a film, by bands if it is real and narrow or has a row of known nodes."""
    ring = periodic and not known.all(axis=1).any() and known.shape[1] > WIDE
    if ring or np.iscomplexobj(linear.centre):
        return Ring(linear, known)
    return Bands(linear, known, periodic=periodic)


def _singular() -> ConvergenceError:
    return ConvergenceError(
        "cavitation: the matrix of the film is singular, as where the pressures of a film diverge; take a thicker "
        "film, more cells, or another viscosity law",
        outcome=Outcome.DIVERGED,
    )
