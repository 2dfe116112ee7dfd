"""Distribution of contact pressure over the surface, in bins that all models of a scene share."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.rom.parts.pressed_surface import RoughContact

BINS = 40
"""Number of bins below the hardness, and above it if that is in range."""

GAUSS_POINTS = 8
"""Number of Gauss points in a bin."""

BIN_PARTS = 60
"""Number of parts of a bin over which the load of a density is integrated."""

PRESSURE_RANGE = 8.0
"""Distance from the mean pressure over E* g' beyond which the density of estimates is negligible."""


def bin_edges(scene: RoughContact) -> Array:
    """The edges of the bins of pressure, Pa, up to 2 E* g' above the mean pressure, with an edge at the hardness.

    The first edge is 0, or 8 E* g' below the mean pressure if that is higher.
    """
    bottom, top = _smallest_pressure(scene), scene.load.pressure + 2 * scene.pressure_unit
    if scene.hardness < top:
        lower, upper = np.linspace(bottom, scene.hardness, BINS + 1), np.linspace(scene.hardness, top, BINS + 1)
        return np.concatenate([lower, upper[1:]])
    return np.linspace(bottom, top, BINS + 1)


def _smallest_pressure(scene: RoughContact) -> float:
    return max(0.0, scene.load.pressure - PRESSURE_RANGE * scene.pressure_unit)


def density_of_contact(contact: Contact, edges: Array) -> Array:
    """The fraction of the nominal area in each bin of pressures below the hardness, over the bin's width, 1/Pa."""
    inside = contact.pressure[contact.in_contact & ~contact.plastic]
    counted, _ = np.histogram(inside, edges)
    return np.asarray(counted / contact.pressure.size / np.diff(edges))


def density_of_estimate(estimate: Estimate, edges: Array) -> Array:
    """The mean pressure density of an estimate over each bin, 1/Pa; zeros if it has none."""
    density = estimate.pressure_density
    if density is None:
        return np.zeros(edges.size - 1)
    nodes, weights = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    return np.asarray(density(middle[:, None] + half[:, None] * nodes) @ weights / 2)


def load_mismatch(scene: RoughContact, estimate: Estimate) -> float:
    """The relative difference of the load of an estimate's pressures, ∫ p f(p) dp + H A_p/A0, from the load."""
    bounded = estimate.plastic_fraction > 0
    carried = scene.hardness * estimate.plastic_fraction if bounded else 0.0
    if estimate.pressure_density is not None:
        limit = scene.load.pressure + PRESSURE_RANGE * scene.pressure_unit
        top = min(scene.hardness, limit) if bounded else limit
        nodes, weights = np.polynomial.legendre.leggauss(GAUSS_POINTS)
        edges = np.linspace(_smallest_pressure(scene), top, BIN_PARTS * BINS + 1)
        middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
        pressure = middle[:, None] + half[:, None] * nodes
        carried += float(((pressure * estimate.pressure_density(pressure)) @ weights * half).sum())
    return abs(carried / scene.load.pressure - 1)
