"""Extension of a displacement from the free nodes to the whole grid, nearly as the half-space would deform there."""

from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics import kernels
from roughfilm.contact.mechanics.loop_ranges import Pieces
from roughfilm.contact.mechanics.transforms import Filter

CELL_NODES = 16
"""Number of nodes along a side of a cell; displacements off contact are constant in each cell."""

COUPLING = 1 / 3
"""Stiffness between the free nodes of a cell and its surroundings, over the stiffness of one node."""

STEPS = 6
"""Number of steps of the conjugate gradients that solve for the displacements of the cells."""

MIN_CELLS, PLAIN_ITERATIONS = 100, 30
"""Smallest number of cells and number of iterations; below both, the extension costs more than it saves."""

SAMPLES = 64
"""Number of wavenumbers along an axis in the mean that gives the stiffness of one node."""


class Extension:
    """Extension of a displacement from the free nodes of a grid to all others.

    The exact pressure that displaces the free nodes by r is |q|/2 applied to the whole displaced surface. Beside the
    free nodes that displacement follows from p = 0 there. It is taken as constant in cells of about 16 × 16 nodes, with
    values y that solve

        |q|/2 y + σ φ (y − r̄) = 0

    where φ is the fraction of free nodes in a cell, r̄ their mean displacement, and σ a third of the stiffness of one
    node, the mean of |q|/2 over all wavenumbers of the grid. In the first iterations on a small grid y is 0.

    Parameters
    ----------
    shape : number of nodes (nx, ny).
    spacing : (dx, dy), in the unit of the displacement, for E* = 1.
    pieces : ranges for the threads.
    """

    def __init__(self, shape: tuple[int, int], spacing: tuple[float, float], pieces: Pieces) -> None:
        self._shape, self._pieces = shape, pieces
        cells = (max(1, round(shape[0] / CELL_NODES)), max(1, round(shape[1] / CELL_NODES)))
        rows, columns = (np.arange(n) * m // n for n, m in zip(shape, cells, strict=True))
        self._row_cells, self._column_cells = rows.astype(np.int32), columns.astype(np.int32)
        self._column_bounds = np.searchsorted(columns, np.arange(cells[1] + 1)).astype(np.int32)
        self._nodes_per_cell = shape[0] * shape[1] / (cells[0] * cells[1])
        lengths = [n * d / m for n, d, m in zip(shape, spacing, cells, strict=True)]
        qx, qy = (2 * np.pi * np.fft.rfftfreq(m, length) for m, length in zip(cells, lengths, strict=True))
        self._stiffness = np.hypot(qx[:, None], qy[None, :]) / 2
        self._cells = cells
        samples = (np.arange(SAMPLES) + 0.5) / SAMPLES * np.pi
        qx, qy = (samples / d * (n > 1) for n, d in zip(shape, spacing, strict=True))
        self._coupling = COUPLING * float(np.hypot(qx[:, None], qy[None, :]).mean()) / 2
        self._sums = np.zeros((len(pieces.rows), 2, *cells))

    @cached_property
    def _filter(self) -> Filter:
        return Filter(self._cells, "float64", Team(1))

    def extend(self, index: Array, residual: Array, grid: Array, *, iteration: int) -> None:
        """Set the flat grid to the residual at the free nodes and to its extension elsewhere."""
        pieces = self._pieces
        if self._cells[0] * self._cells[1] < MIN_CELLS and iteration < PLAIN_ITERATIONS:
            pieces.scatter_alone(index, residual, grid)
            return
        cells = (self._shape[1], self._row_cells, self._column_cells)
        places = [(*entries, piece) for piece, entries in enumerate(pieces.free)]
        pieces.over(places, kernels.sum_cells, *cells, index, residual, self._sums)
        count, total = self._sums.sum(axis=0) * (self._coupling / self._nodes_per_cell)
        values = self._solved(count, total)
        pieces.over_rows(kernels.extend, self._row_cells, self._column_bounds, values, grid.reshape(self._shape))
        pieces.over_free(kernels.scatter, index, residual, grid)

    def _solved(self, coupling: Array, load: Array) -> Array:
        """Approximate solution y of |q|/2 y + c y = b, by conjugate gradients.

        The preconditioner has the mean of c in place of c, so that the product with the matrix needs no transforms.
        """
        mean = coupling.mean()
        variation, factors = coupling - mean, self._filter.cut(1 / (self._stiffness + mean))
        rest, correction = self._filter.source, self._filter.result
        rest[:] = load
        square, values, direction, image = 0.0, np.zeros_like(load), np.zeros_like(load), np.zeros_like(load)
        for _ in range(STEPS):
            self._filter.apply(factors)
            last, square = square, float(np.vdot(rest, correction))
            if square <= 0:
                break
            along = square / last if last > 0 else 0.0
            direction = correction + along * direction
            image = rest + variation * correction + along * image
            length = square / float(np.vdot(direction, image))
            values += length * direction
            rest -= length * image
        return values
