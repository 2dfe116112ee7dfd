"""How far off the factors of a gap on one mesh may be, by what thin-film theory makes of the same nodes."""

from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.rough_gap.flow.corrected import slope_corrected
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors, of_thin_film
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import Walls

COLUMNS = 1.25
"""Of what thin films change by if columns have the mean height of their corners, as a mesh has it."""

LAYERS, SHORT, STEEP = 3.0, 0.5, 0.5
"""Of what slope changes: over the square of the layers N; times (k/N)², k the wave number of the walls over the mean
gap; times (1 + g'²)(k dx)², dx the longer side of a column over it.

With all, the factors of 41 sinusoids of amplitude 0.05 to 0.95, 0.5 to 20 mean gaps long, on 16, 32 and 64 columns with
4 to 32 layers, were within their bars of the exact ones, the nearest at three quarters of its own.
"""

RIDGES = 2
"""Nodes, at most, along which nothing changes: the columns' length there is of no account."""


def error_bars(
    found: RoughGapFactors, scene: RoughGap, walls: Walls, layers: int
) -> tuple[RoughGapFactors, RoughGapFactors]:
    """Error bars of the factors on one mesh, and thin-film theory's factors on its nodes; all over the mean gap's.

    The bars are sums of ``COLUMNS``, of what ``LAYERS``, ``SHORT`` and ``STEEP`` measure, and of what the waves that
    the nodes cannot hold change in theory for small slopes. What a mesh does to inertia they leave out.

    Parameters
    ----------
    found : what the mesh gave.
    walls : of the scene on the nodes of the mesh.
    layers : cells across.

    Raises
    ------
    ConvergenceError
        If a cell problem of thin films does not meet its tolerance.

    Of second order in columns and layers where the walls are smooth and open.
    """
    mean, slides = scene.mean_gap, walls.slides

    def thin_film(gap: Array) -> RoughGapFactors:
        return of_thin_film(solve_cell(gap, walls.spacing).factors, slides=slides).scaled(1 / mean)

    thin = thin_film(walls.gap)
    own, values = _main(thin), _main(found)
    k, side = 2 * np.pi * scene.gap_over_wavelength, max(walls.spacing) / mean
    if min(walls.lower.shape) <= RIDGES:
        side = walls.spacing[int(np.argmax(walls.lower.shape))] / mean
    share = LAYERS / layers**2 + SHORT * (k / layers) ** 2 + STEEP * (1 + scene.rms_slope**2) * (k * side) ** 2
    relative = share * _over(values - own, own)
    columns = _column_heights(walls.gap)
    if not columns.any():
        return thin, thin
    relative += COLUMNS * _over(_main(thin_film(columns)) - own, own)
    finest = max(scene.surface().shape)
    if finest > max(walls.lower.shape):
        part, whole = (_main(slope_corrected(one).corrected) for one in (walls, scene.walls(finest)))
        relative += _over(whole - part, part)
    bars = np.abs(values) * relative
    a = np.sqrt(np.outer(bars[:2], bars[:2]))
    return replace(found, pressure=a, shear=np.full(2, bars[2]), friction=float(bars[3])), thin


def _main(factors: RoughGapFactors) -> Array:
    return np.array([*np.diag(factors.pressure), factors.shear[0], factors.friction])


def _over(change: Array, value: Array) -> Array:
    return np.divide(np.abs(change), np.abs(value), out=np.zeros_like(value), where=value != 0)


def _column_heights(gap: Array) -> Array:
    """Mean of the four corners of each column, 0 where one is in contact."""
    corners = np.array([np.roll(gap, (-i, -j), axis=(0, 1)) for i in range(2) for j in range(2)])
    return np.asarray(np.where((corners == 0).any(axis=0), 0.0, corners.mean(axis=0)))
