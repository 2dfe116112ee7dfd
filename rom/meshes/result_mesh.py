"""Meshes of results whose fields have positions, with the fields as data."""

from collections.abc import Mapping

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.meshes.mesh import Mesh, grid
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.result import Field, Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.meshes.walls_mesh import periodic
from roughfilm.rom.parts.pressed_surface import RoughContact
from roughfilm.rom.pocket.plan.plan import Plan
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.rough_gap.scene import RoughGap

PLACES = {"vertices", "kept", "x", "y"}
"""Fields that give the positions of the others."""


def result_mesh(result: Result) -> Mesh:
    """The mesh of a result, in m, with its fields as data of cells or points, in their units.

    A result with ``vertices``, (nx+1, ny+1, 2) or (nx+1, ny+1, nz+1, 3), gives quadrilaterals or hexahedra with all
    fields of shape (nx, ny, ...) or (nx, ny, nz, ...), without the cells where ``kept``, (nx, ny), is 0. A result with
    ``x`` and ``y``, (nx, ny), gives quadrilaterals between these points (x in rad is an angle, y the radius), or lines
    if ny = 1; for a cell in plan these points are the middles of the quadrilaterals. A dry contact, a seal or a rough
    gap gives quadrilaterals over one period of its surface.

    Raises
    ------
    InputError
        If the result has no such fields, their shapes do not fit each other, or its surface cannot be read.
    """
    fields = result.fields
    if "vertices" in fields:
        return _cells(fields)
    scene = _scene(result)
    if "x" in fields and "y" in fields:
        return _columns(fields, scene.plan()) if isinstance(scene, Pocket) and scene.in_plan else _plane(fields)
    plane = {name: field for name, field in fields.items() if field.values.ndim == 2}
    if not plane or not isinstance(scene, RoughContact | RoughGap):
        raise InputError(
            f"result of {result.model}: none of its fields ({', '.join(sorted(fields)) or 'it has none'}) has "
            "positions in a plane or in space; export a result of a model that resolves the film or the surface"
        )
    return _period(plane, scene.surface().size)


def labelled(name: str, field: Field) -> str:
    """The name of a field in a mesh, with its unit."""
    return name if field.unit == "1" else f"{name} ({field.unit})"


def _cells(fields: Mapping[str, Field]) -> Mesh:
    vertices = fields["vertices"].values
    if vertices.shape[-1:] not in ((2,), (3,)) or vertices.ndim != vertices.shape[-1] + 1 or min(vertices.shape) < 2:
        raise _misshapen("vertices", vertices.shape, "(nx+1, ny+1, 2) or (nx+1, ny+1, nz+1, 3)")
    mesh = grid(_in_space(vertices))
    shape = tuple(size - 1 for size in vertices.shape[:-1])
    data = _data(fields, shape)
    mesh = Mesh(points=mesh.points, cell_type=mesh.cell_type, cells=mesh.cells, cell_data=data)
    if "kept" not in fields:
        return mesh
    kept = fields["kept"].values > 0
    if kept.shape != shape[:2]:
        raise _misshapen("kept", kept.shape, str(shape[:2]))
    return mesh.kept(np.repeat(kept.ravel(), mesh.cells.shape[0] // kept.size))


def _columns(fields: Mapping[str, Field], plan: Plan) -> Mesh:
    """The columns of a cell in plan from their middles: each face is as far from the middle before as from the next."""
    shape, faces = fields["x"].values.shape, []
    if len(shape) != 2 or fields["y"].values.shape != shape:
        raise _misshapen("x", shape, f"(nx, ny), as the shape of y, {fields['y'].values.shape}")
    for middles, side in ((fields["x"].values[:, 0], plan.length), (fields["y"].values[0], plan.breadth)):
        ends = [-side / 2]
        for middle in middles:
            ends.append(2 * middle - ends[-1])
        faces.append(np.array(ends))
    mesh = grid(_in_space(np.stack(np.meshgrid(*faces, indexing="ij"), axis=-1)))
    return Mesh(points=mesh.points, cell_type=mesh.cell_type, cells=mesh.cells, cell_data=_data(fields, shape))


def _plane(fields: Mapping[str, Field]) -> Mesh:
    x, y = fields["x"].values, fields["y"].values
    if x.ndim != 2 or x.shape[0] < 2 or y.shape != x.shape:
        raise _misshapen("x", x.shape, f"(nx, ny) with nx above 1, as the shape of y, {y.shape}")
    places = np.stack([y * np.cos(x), y * np.sin(x)] if fields["x"].unit == "rad" else [x, y], axis=-1)
    points = _in_space(places[:, 0] if x.shape[1] == 1 else places)
    mesh = grid(points)
    return Mesh(points=mesh.points, cell_type=mesh.cell_type, cells=mesh.cells, point_data=_data(fields, x.shape))


def _period(fields: Mapping[str, Field], size: tuple[float, float]) -> Mesh:
    shape = next(iter(fields.values())).values.shape
    ends = [np.linspace(0.0, length, count + 1) for length, count in zip(size, shape, strict=True)]
    mesh = grid(_in_space(np.stack(np.meshgrid(*ends, indexing="ij"), axis=-1)))
    whole = {
        name: Field(values=periodic(field.values), unit=field.unit)
        for name, field in fields.items()
        if field.values.shape == shape
    }
    nodes = (shape[0] + 1, shape[1] + 1)
    return Mesh(points=mesh.points, cell_type=mesh.cell_type, cells=mesh.cells, point_data=_data(whole, nodes))


def _misshapen(name: str, shape: tuple[int, ...], allowed: str) -> InputError:
    return InputError(f"field {name}: has the shape {shape}; it must be {allowed}; the file is damaged, solve it again")


def _data(fields: Mapping[str, Field], shape: tuple[int, ...]) -> dict[str, Array]:
    """The fields with one number or one vector, of three components, for each position of that shape."""
    data = {}
    for name, field in fields.items():
        rest = field.values.shape[len(shape) :]
        if name in PLACES or field.values.shape[: len(shape)] != shape or rest not in ((), (2,), (3,)):
            continue
        values = field.values.astype(float)
        data[labelled(name, field)] = _in_space(values).reshape(-1, 3) if rest else values.ravel()
    return data


def _in_space(vectors: Array) -> Array:
    missing = 3 - vectors.shape[-1]
    return np.pad(vectors, [(0, 0)] * (vectors.ndim - 1) + [(0, missing)])


def _scene(result: Result) -> Scene | None:
    entries = result.provenance.get("scene")
    return read_scene(entries) if isinstance(entries, dict) else None
