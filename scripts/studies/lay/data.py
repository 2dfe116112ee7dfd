"""Made and measured surfaces turned against the flow: flow factors of the cell and of the box."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import atan2

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.lay import box_factors, turned
from roughfilm.rom.homogenization.patir_cheng import PatirCheng, patir_cheng

POINTS, SIDE, ROUGHNESS = 256, 1e-3, 1e-6
"""Nodes a side, its length, m, and Sq, m, of the made surfaces."""

TURNS = ((5, 0), (5, 1), (5, 2), (4, 3), (4, 4), (3, 4), (2, 5), (1, 5), (0, 5))
"""Pairs p, q: wave vectors multiplied by p + iq turn a periodic pattern by the angle of p + iq and scale it."""

WAVES = {"grooves": ((0, 2, 0.4),), "crossed grooves": ((1, 2, 0.4), (-1, 2, 1.3))}
"""Before turning: whole wave vectors of the families of grooves, and phases that put no mirror line on a side."""

RANDOM = "random lay"
CORRELATION, STRETCH = 30e-6, 6.0
"""Correlation length of the random surfaces, m, and its ratio along and across the lay."""

TEXTURES = (*WAVES, RANDOM)
THICKNESSES = (3.0, 2.0, 1.0)
"""Separations over Sq: thick, thin, and with contact."""

SEEDS = tuple(range(811, 819))
LENGTHS = (1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8)
"""Lengths of boxes divided by their widths."""

RESOLVED_DETERMINANT = 1e-3
"""Fraction of A₁₁A₂₂ below which det A is only a discretisation error."""


@dataclass(frozen=True, kw_only=True)
class FactorPair:
    """One gap: factors of the cell and of the box, over those of a smooth film as thick as the mean gap.

    Attributes
    ----------
    contact : the part of the nodes where the gap is closed.
    error : uncertainty of A divided by its largest entry.
    """

    cell: FlowFactors
    box: PatirCheng
    contact: float
    error: float

    @property
    def short(self) -> tuple[float, float]:
        """Relative differences of φ₁ and φ₂ to A₁₁ and A₂₂; nan where these are 0."""
        own = np.diag(self.cell.pressure)
        with np.errstate(divide="ignore", invalid="ignore"):
            first, second = np.where(own > 0, self.box.pressure / own - 1, np.nan)
        return float(first), float(second)


def gap_at(heights: Array, separation: float) -> Array:
    """max(separation − heights, 0): the gap under a flat wall, undeformed."""
    return np.asarray(np.maximum(separation - heights, 0.0))


def compare(gap: Array, spacing: tuple[float, float]) -> FactorPair:
    """Return both kinds of factors of a gap."""
    found = flow_factors(gap, spacing)
    pressure = found.factors.pressure
    return FactorPair(
        cell=found.factors.relative,
        box=patir_cheng(gap, spacing).relative,
        contact=found.contact,
        error=float(found.uncertainty.pressure.max() / max(pressure.max(), 1e-300)),
    )


def angle(turn: tuple[int, int]) -> float:
    """Return the angle of the lay from x towards y, rad."""
    return atan2(turn[1], turn[0])


def heights_of(texture: str, turn: tuple[int, int], points: int = POINTS, seed: int = SEEDS[0]) -> Array:
    """Return a made surface with turned lay, of mean 0 and rms ``ROUGHNESS``."""
    if texture == RANDOM:
        return gaussian(
            size=(SIDE, SIDE),
            points=(points, points),
            seed=seed,
            rms_height=ROUGHNESS,
            correlation_length=CORRELATION,
            anisotropy=STRETCH,
            lay_angle=angle(turn),
        ).heights
    x, y = np.meshgrid(*(np.arange(points) / points,) * 2, indexing="ij")
    families = []
    for m, n, phase in WAVES[texture]:
        wave = complex(m, n) * complex(*turn)
        families.append(np.cos(2 * np.pi * (wave.real * x + wave.imag * y) + phase))
    heights = -np.max(families, axis=0)
    heights -= heights.mean()
    return np.asarray(heights * (ROUGHNESS / heights.std()))


def isotropic(seed: int, points: int = POINTS) -> Surface:
    """Return a random surface without lay."""
    return gaussian(
        size=(SIDE, SIDE),
        points=(points, points),
        seed=seed,
        rms_height=ROUGHNESS,
        correlation_length=CORRELATION,
    )


def grooves_exactly(thickness: float) -> tuple[Array, Array]:
    """(<h⁻³>⁻¹, <h³>) over <h>³ and (<h⁻²>/<h⁻³>, <h>) over <h> of sinusoidal grooves, by their profile."""
    h = np.maximum(thickness - np.sqrt(2) * np.cos(2 * np.pi * (np.arange(20000) + 0.5) / 20000), 0)
    mean = h.mean()
    if not h.min() > 0:
        return np.array([0.0, (h**3).mean() / mean**3]), np.array([0.0, 1.0])
    cube = 1 / (h**-3.0).mean()
    return np.array([cube, (h**3).mean()]) / mean**3, np.array([cube * (h**-2.0).mean(), mean]) / mean


def box_of(tensor: Array, size: tuple[float, float]) -> Array:
    """:func:`box_factors`, or nan where det A is not resolved."""
    if np.linalg.det(tensor) < RESOLVED_DETERMINANT * tensor[0, 0] * tensor[1, 1]:
        return np.array([np.nan, np.nan])
    try:
        return box_factors(tensor, size)
    except InputError:
        return np.array([np.nan, np.nan])


@dataclass(frozen=True, kw_only=True)
class Turned:
    """Flow factors of the made surfaces at all turns.

    Attributes
    ----------
    found : by texture, thickness and turn.
    isotropic : by thickness, one for each seed.
    straight : A and B of lay along x, as (across, along) by texture and thickness: exact for grooves.
    boxes : length over width of boxes filled with grooves at 45°, and φ₁ of each over <h>³.
    """

    found: Mapping[tuple[str, float, tuple[int, int]], FactorPair]
    isotropic: Mapping[float, Sequence[FactorPair]]
    straight: Mapping[tuple[str, float], tuple[Array, Array]]
    boxes: tuple[Array, Array]

    def tensor(self, texture: str, thickness: float, turn: float) -> Array:
        """Return A of the lay along x, rotated."""
        return turned(self.straight[texture, thickness][0], turn)

    def drag(self, texture: str, thickness: float, turn: float) -> Array:
        """Return B of the lay along x, rotated."""
        return turned(self.straight[texture, thickness][1], turn)[:, 0]


def turn_all(advance: Callable[[str], None], *, points: int = POINTS, coarser: int = 1) -> Turned:
    """Compute every texture at every turn and seed, or every n-th only; ``advance`` is called ``PARTS`` times."""
    found = {}
    chosen, spacing = TURNS[::coarser], (SIDE / points, SIDE / points)
    for texture in TEXTURES:
        advance(texture)
        for turn in chosen:
            heights = heights_of(texture, turn, points)
            for thickness in THICKNESSES:
                found[texture, thickness, turn] = compare(gap_at(heights, thickness * ROUGHNESS), spacing)
    straight = {}
    for texture, thickness in product(TEXTURES, THICKNESSES):
        first, last = (found[texture, thickness, turn].cell for turn in (chosen[0], chosen[-1]))
        computed = np.diag(first.pressure)[::-1], np.array([last.shear[0], first.shear[0]])
        straight[texture, thickness] = grooves_exactly(thickness) if texture == "grooves" else computed
    advance("isotropic")
    made = [isotropic(seed, points) for seed in SEEDS[::coarser]]
    return Turned(
        found=found,
        isotropic={
            thickness: [compare(gap_at(one.heights, thickness * ROUGHNESS), one.spacing) for one in made]
            for thickness in THICKNESSES
        },
        straight=straight,
        boxes=_boxes(),
    )


PARTS = len(TEXTURES) + 1


def _boxes(thickness: float = 2.0, points: int = 96, waves: int = 4) -> tuple[Array, Array]:
    x, y = np.meshgrid(*(np.arange(points) / points,) * 2, indexing="ij")
    cell = thickness - np.sqrt(2) * np.cos(2 * np.pi * waves * (x - y))
    factors = []
    for length in LENGTHS:
        tiles = (max(1, round(length)), max(1, round(1 / length)))
        factors.append(patir_cheng(np.tile(cell, tiles), (1.0, 1.0)).relative.pressure[0])
    return np.array(LENGTHS), np.array(factors)
