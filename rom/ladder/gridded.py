"""Fields of a result with names of their dimensions and coordinates, as xarray takes them."""

from collections.abc import Mapping
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

AXES = ("x", "y", "z")

Variable = tuple[tuple[str, ...], NDArray[Any], dict[str, Any]]
"""Names of the dimensions of an array, the array, and its attributes."""

Shapes = Mapping[str, tuple[int, ...]]


def gridded(fields: Mapping[str, tuple[NDArray[Any], str]]) -> tuple[dict[str, Variable], dict[str, Variable]]:
    """The fields and their coordinates; fields along the same points share their dimensions.

    Parameters
    ----------
    fields : array and unit of each field, by name.

    Returns
    -------
    fields, coordinates
        ``position`` along a wall, ``x`` and ``y`` of a grid, and the edges of intervals are coordinates, so are
        ``cell_x``, ``cell_y`` and ``cell_z``, the centres of the cells between ``vertices``.
    """
    arrays = {name: values for name, (values, _) in fields.items()}
    named = _dimensions({name: values.shape for name, values in arrays.items()})
    variables: dict[str, Variable] = {
        name: (named[name], values, {"units": unit}) for name, (values, unit) in fields.items()
    }
    coordinates = {name: variables.pop(name) for name in fields if name == "position" or name.endswith("_edges")}
    if all(axis in fields and arrays[axis].ndim == 2 for axis in ("x", "y")):
        for number, axis in enumerate(("x", "y")):
            _, values, attributes = variables.pop(axis)
            coordinates[axis] = ((axis,), values.take(0, axis=1 - number), attributes)
    if "vertices" in fields:
        vertices, unit = fields["vertices"]
        centres = _centres(vertices)
        for number in range(centres.shape[-1]):
            along = tuple(f"{axis}_cell" for axis in AXES[: centres.ndim - 1])
            coordinates[f"cell_{AXES[number]}"] = (along, centres[..., number], {"units": unit})
    return variables, coordinates


def _dimensions(shapes: Shapes) -> dict[str, tuple[str, ...]]:
    """The names of the dimensions of every field; a name whose size another field contradicts is its own."""
    sizes: dict[str, int] = {}
    named = {}
    for name, shape in shapes.items():
        found = _named(name, shape, shapes)
        if any(sizes.setdefault(one, size) != size for one, size in zip(found, shape, strict=True)):
            found = tuple(f"{name}_{number}" for number in range(len(shape)))
        named[name] = found
    return named


def _named(name: str, shape: tuple[int, ...], shapes: Shapes) -> tuple[str, ...]:
    deep = len(shapes.get("vertices", ())) - 1
    if name == "vertices":
        return (*(f"{axis}_vertex" for axis in AXES[:deep]), "component")
    if deep > 0 and (name == "kept" or name.startswith("cell_")):
        cells = tuple(f"{axis}_cell" for axis in AXES[:deep])[: len(shape)]
        return (*cells, *(f"component{'' if number == 0 else number}" for number in range(len(shape) - len(cells))))
    if len(shape) == 1:
        return ("position",) if "position" in shapes else (name,) if name.endswith("_edges") else ("interval",)
    return AXES[: len(shape)] if len(shape) <= len(AXES) else tuple(f"{name}_{i}" for i in range(len(shape)))


def _centres(vertices: NDArray[Any]) -> NDArray[Any]:
    """The mean position of the corners of every cell, shape (nx, ny, 2) or (nx, ny, nz, 3)."""
    ends = (slice(None, -1), slice(1, None))
    corners = [vertices[part] for part in product(ends, repeat=vertices.ndim - 1)]
    return np.mean(corners, axis=0)  # type: ignore[no-any-return]
