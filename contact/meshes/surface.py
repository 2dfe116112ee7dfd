"""A surface as a mesh of quads."""

import numpy as np

from roughfilm.contact.meshes.mesh import Mesh, grid
from roughfilm.contact.surfaces.surface import Surface


def surface_mesh(surface: Surface) -> Mesh:
    """The mesh of quads between the points of a surface, m, normals upward; over a whole period if periodic.

    Quads with an invalid corner are left out.
    """
    ends = (0, 1 if surface.periodic else 0)
    heights = np.pad(surface.heights, (ends, ends), mode="wrap")
    valid = np.pad(surface.valid, (ends, ends), mode="wrap")
    places = [np.arange(count) * step for count, step in zip(heights.shape, surface.spacing, strict=True)]
    mesh = grid(np.stack([*np.meshgrid(*places, indexing="ij"), heights], axis=-1))
    return mesh.kept(np.asarray(valid.ravel()[mesh.cells].all(axis=1)))
