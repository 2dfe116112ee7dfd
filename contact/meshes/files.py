"""Writing meshes to VTU, STL and Gmsh files with meshio."""

from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.meshes.mesh import CellType, Mesh, boundary, in_triangles

FORMATS = {".vtu": "vtu", ".stl": "stl", ".msh": "gmsh22"}
"""Format names of meshio by suffix; Gmsh 2.2 is the version that most programs read."""


def mesh_format(path: Path) -> str:
    """The format name of meshio for the suffix of a path; raises InputError for a suffix not in ``FORMATS``."""
    if path.suffix.lower() not in FORMATS:
        *first, last = FORMATS
        raise InputError(f"{path}: got the suffix {path.suffix!r}; write {', '.join(first)} or {last}")
    return FORMATS[path.suffix.lower()]


def write_mesh(mesh: Mesh, path: Path) -> Mesh:
    """Write a mesh to a file, completely or not at all, and return the mesh in the file.

    VTU (binary) and Gmsh 2.2 (text) keep cells and data in double precision. STL (binary) holds triangles in single
    precision and no data: quads are split, hexahedra are replaced by their closed boundary.

    Raises
    ------
    InputError
        For another suffix, a mesh without cells, lines in STL, or a path that cannot be written.
    """
    name = mesh_format(path)
    if len(mesh.cells) == 0:
        raise InputError(f"{path}: there is nothing to export, no cell is left; look at the gap or the mask")
    if name == "stl":
        mesh = _for_stl(mesh, path)
    import meshio  # slow to import and rarely needed

    point_data: dict[str, Any] = dict(mesh.point_data)
    cell_data: dict[str, list[Any]] = {key: [values] for key, values in mesh.cell_data.items()}
    if name == "gmsh22":
        # meshio 5.3.5 writes the repr of each number, which Gmsh cannot read for NumPy 2 scalars.
        point_data = {key: values.astype(object) for key, values in point_data.items()}
        cell_data = {key: [values.astype(object)] for key, (values,) in cell_data.items()}
        tags = np.ones(len(mesh.cells), dtype=np.int32)
        cell_data |= {"gmsh:physical": [tags], "gmsh:geometrical": [tags]}
    written = meshio.Mesh(mesh.points, [(mesh.cell_type.value, mesh.cells)], point_data, cell_data)
    options: dict[str, bool] = {"vtu": {}, "stl": {"binary": True}, "gmsh22": {"binary": False}}[name]
    with replacing(path) as scratch:
        meshio.write(scratch, written, file_format=name, **options)
    return mesh


def _for_stl(mesh: Mesh, path: Path) -> Mesh:
    if mesh.cell_type is CellType.LINE:
        raise InputError(f"{path}: STL holds triangles and this is a line; write .vtu or .msh")
    surface = boundary(mesh) if mesh.cell_type is CellType.HEXAHEDRON else in_triangles(mesh)
    surface = Mesh(points=surface.points, cell_type=surface.cell_type, cells=surface.cells)
    return surface.kept(_area(surface) > 0)


def _area(mesh: Mesh) -> Array:
    first, second, third = np.moveaxis(mesh.points[mesh.cells], 1, 0)
    return np.asarray(np.linalg.norm(np.cross(second - first, third - first), axis=1))
