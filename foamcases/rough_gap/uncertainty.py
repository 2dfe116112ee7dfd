"""The uncertainty of the factors of a gap on one mesh, from thin-film theory on the same nodes."""

from dataclasses import replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.rough_gap.flow.corrected import slope_corrected
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors, of_thin_film
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import Walls

COLUMN_FACTOR = 1.25
"""Uncertainty over the change of the thin-film factors when columns get the mean height of their corners."""

LAYER_FACTOR = 3.0
"""Uncertainty over the change by slope, times N²; N is the number of layers.

With this and the other factors, the errors of 41 sinusoids are at most three quarters of their uncertainties. Their
amplitudes are 0.05 to 0.95 and their lengths 0.5 to 20 mean gaps, on 16, 32 and 64 columns with 4 to 32 layers.
"""

WAVE_FACTOR = 0.5
"""Uncertainty over the change by slope, over (k/N)²; k is the wave number of the walls times the mean gap."""

SLOPE_FACTOR = 0.5
"""Uncertainty over the change by slope, over (1 + g'²)(k dx)²; dx is the longer side of a column over the mean gap."""

MAX_RIDGE_NODES = 2
"""Largest number of nodes of a side along which the walls do not change; ``SLOPE_FACTOR`` leaves this side out."""


def uncertainties(
    factors: RoughGapFactors, scene: RoughGap, walls: Walls, layers: int
) -> tuple[RoughGapFactors, RoughGapFactors]:
    """The uncertainties of the factors on one mesh, and the factors of thin-film theory on its nodes.

    Both are relative to a smooth gap with the thickness of the mean gap. The uncertainty is a sum: the parts of
    ``COLUMN_FACTOR``, ``LAYER_FACTOR``, ``WAVE_FACTOR`` and ``SLOPE_FACTOR``, and the change by waves too short for the
    nodes, by the theory of small slopes. It is of second order in columns and layers where the walls are smooth
    and open. It leaves out the error of inertia.

    Parameters
    ----------
    factors : the factors on the mesh.
    scene : the rough gap.
    walls : the walls of the scene on the nodes of the mesh.
    layers : number of cells across the gap.

    Returns
    -------
    tuple[RoughGapFactors, RoughGapFactors]
        The uncertainties, and the factors of thin-film theory; both are the latter if contact closes every column.

    Raises
    ------
    ConvergenceError
        If a cell problem of thin films does not meet its tolerance.
    """
    mean, slides = scene.mean_gap, walls.slides

    def thin_film(gap: Array) -> RoughGapFactors:
        return of_thin_film(solve_cell(gap, walls.spacing).factors, slides=slides).scaled(1 / mean)

    thin = thin_film(walls.gap)
    own, values = _main(thin), _main(factors)
    k, side = 2 * np.pi * scene.gap_over_wavelength, max(walls.spacing) / mean
    if min(walls.lower.shape) <= MAX_RIDGE_NODES:
        side = walls.spacing[int(np.argmax(walls.lower.shape))] / mean
    fraction = LAYER_FACTOR / layers**2 + WAVE_FACTOR * (k / layers) ** 2
    fraction += SLOPE_FACTOR * (1 + scene.rms_slope**2) * (k * side) ** 2
    relative = fraction * _over(values - own, own)
    columns = _column_heights(walls.gap)
    if not columns.any():
        return thin, thin
    relative += COLUMN_FACTOR * _over(_main(thin_film(columns)) - own, own)
    finest = max(scene.surface().shape)
    if finest > max(walls.lower.shape):
        part, whole = (_main(slope_corrected(one).corrected) for one in (walls, scene.walls(finest)))
        relative += _over(whole - part, part)
    errors = np.abs(values) * relative
    a = np.sqrt(np.outer(errors[:2], errors[:2]))
    return replace(factors, pressure=a, shear=np.full(2, errors[2]), friction=float(errors[3])), thin


def _main(factors: RoughGapFactors) -> Array:
    return np.array([*np.diag(factors.pressure), factors.shear[0], factors.friction])


def _over(change: Array, value: Array) -> Array:
    return np.divide(np.abs(change), np.abs(value), out=np.zeros_like(value), where=value != 0)


def _column_heights(gap: Array) -> Array:
    """The mean gap at the four corners of each column, 0 where a corner is in contact, shape (nx, ny)."""
    corners = np.array([np.roll(gap, (-i, -j), axis=(0, 1)) for i in range(2) for j in range(2)])
    return np.asarray(np.where((corners == 0).any(axis=0), 0.0, corners.mean(axis=0)))
