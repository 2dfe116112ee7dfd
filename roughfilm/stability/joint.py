"""Surfaces whose valleys end at a periodic joint, and the joining of their edges."""

import numpy as np

from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.surface import Surface

EDGES_ONLY = {
    "form": "none",
    "outliers": {"limit": 0.0},
    "grid": {"points": "kept"},
    "edges": {"method": "blended"},
    "smoothing": 1,
}
"""Recipe that joins the edges as the source does and changes nothing else."""


def cut_grooves(
    shift: float, nodes: int = 192, *, grooves: int = 4, side: float = 1e-3, roughness: float = 1e-6
) -> Surface:
    """A surface of sinusoidal grooves whose ends are shifted at the periodic joint: z = √2 Sq cos 2π(n y/L − s x/L).

    Parameters
    ----------
    shift : s, distance in y between the end and the start of a groove, over the distance of grooves; the surface is
        periodic for 0 and 1.
    nodes : number of nodes along each side.
    grooves : n, number of grooves across the surface.
    side, roughness : side L of the surface and rms height Sq, m.
    """
    x, y = np.meshgrid(*(np.arange(nodes) / nodes,) * 2, indexing="ij")
    heights = np.sqrt(2) * roughness * np.cos(2 * np.pi * (grooves * y - shift * x))
    return Surface(heights=heights, spacing=(side / nodes, side / nodes))


def joined(surface: Surface) -> Surface:
    """The surface after a preparation that joins its edges and changes nothing else."""
    return prepare(surface, read_recipe(EDGES_ONLY)).joined
