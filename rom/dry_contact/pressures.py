"""How much of a surface bears which pressure, in bins that all models of a scene share."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.estimates.estimate import Estimate
from roughfilm.rom.parts.pressed_surface import RoughContact

BINS = 40
NODES = 8
"""Of Gauss's rule in a bin."""

FINE = 60
"""Parts of a bin's width at which the load of a density is added up."""

FARTHEST = 8.0
"""E* g' from the mean pressure, where hardly any estimate has pressures left."""


def bin_edges(scene: RoughContact) -> Array:
    """To twice E* g' beyond the mean pressure, Pa; as many bins again below a hardness that lies within.

    From 0, or where all is in contact and pressures are all alike, from the least that is worth a bin.
    """
    bottom, top = _least(scene), scene.load.pressure + 2 * scene.pressure_unit
    if scene.hardness < top:
        lower, upper = np.linspace(bottom, scene.hardness, BINS + 1), np.linspace(scene.hardness, top, BINS + 1)
        return np.concatenate([lower, upper[1:]])
    return np.linspace(bottom, top, BINS + 1)


def _least(scene: RoughContact) -> float:
    return max(0.0, scene.load.pressure - FARTHEST * scene.pressure_unit)


def density_of_contact(contact: Contact, edges: Array) -> Array:
    """Part of the nominal area by pressure between 0 and the hardness, over the width of each bin, 1/Pa."""
    inside = contact.pressure[contact.in_contact & ~contact.plastic]
    counted, _ = np.histogram(inside, edges)
    return np.asarray(counted / contact.pressure.size / np.diff(edges))


def density_of_estimate(estimate: Estimate, edges: Array) -> Array:
    """The same of an estimate, in the middle of each bin by Gauss's rule; zeros where it has no such pressures."""
    density = estimate.pressure_density
    if density is None:
        return np.zeros(edges.size - 1)
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    return np.asarray(density(middle[:, None] + half[:, None] * nodes) @ weights / 2)


def load_mismatch(scene: RoughContact, estimate: Estimate) -> float:
    """By how much the load of an estimate's pressures, ∫ p f(p) dp + H A_p/A0, is off, relative to the load."""
    bounded = estimate.plastic_fraction > 0
    carried = scene.hardness * estimate.plastic_fraction if bounded else 0.0
    if estimate.pressure_density is not None:
        farthest = scene.load.pressure + FARTHEST * scene.pressure_unit
        top = min(scene.hardness, farthest) if bounded else farthest
        nodes, weights = np.polynomial.legendre.leggauss(NODES)
        edges = np.linspace(_least(scene), top, FINE * BINS + 1)
        middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
        pressure = middle[:, None] + half[:, None] * nodes
        carried += float(((pressure * estimate.pressure_density(pressure)) @ weights * half).sum())
    return abs(carried / scene.load.pressure - 1)
