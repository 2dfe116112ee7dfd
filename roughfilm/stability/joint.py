"""Surfaces whose valleys end at a periodic joint, and the usual joining of their edges."""

import numpy as np

from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.surface import Surface

EDGES_ONLY = {"form": "none", "outliers": {"points": 0}, "grid": {"points": "kept"}, "smoothing": 1}
"""A recipe that does nothing but join the edges, as it is usually done."""


def cut_grooves(
    shift: float, nodes: int = 192, *, grooves: int = 4, side: float = 1e-3, roughness: float = 1e-6
) -> Surface:
    """Sinusoidal grooves along x that meet their neighbours at the joint: z = √2 Sq cos 2π(n y/L − s x/L).

    Parameters
    ----------
    shift : s, by how much of their distance the grooves end beside where they begin; 0 and 1 make them periodic.
    nodes : along each side.
    grooves : n, across the surface.
    side, roughness : L and Sq, m.
    """
    x, y = np.meshgrid(*(np.arange(nodes) / nodes,) * 2, indexing="ij")
    heights = np.sqrt(2) * roughness * np.cos(2 * np.pi * (grooves * y - shift * x))
    return Surface(heights=heights, spacing=(side / nodes, side / nodes))


def joined(surface: Surface) -> Surface:
    """A surface with its edges joined as a preparation does, and nothing else done."""
    return prepare(surface, read_recipe(EDGES_ONLY)).joined
