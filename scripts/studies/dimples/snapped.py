"""A cell in plan on a mesh of snappyHexMesh, which shares nothing with the mesh of the library but OpenFOAM itself."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.foamcases.openfoam.fields import internal_field, last_fields
from roughfilm.foamcases.openfoam.program import succeed
from roughfilm.foamcases.pocket.plan.case import sides
from roughfilm.foamcases.rough_gap.dictionaries import Drive
from roughfilm.foamcases.snappy.snapped import run_snapped, write_snapped
from roughfilm.foamcases.snappy.solid import Box, Carved, repeated
from roughfilm.rom.meshes.walls_mesh import GapPart, wall_mesh
from roughfilm.rom.pocket.plan.quantities import OnSlidingWall, plan_quantities
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.rough_gap.walls import Walls

LAYERS_PER_COLUMN = 0.13
"""Number of cells across the film over the number along the cell; no whole number of them fits the film."""

POINTS = 360
"""Number of points of the wall along each side."""

TOLERANCE = 1e-6
"""Remaining relative change of the mean velocity at which a run ends, and the residual."""


def snapped(words: str, scene: Pocket, columns: int, _lean: float = 1.0) -> Mapping[str, Any]:
    """The row of a mirrored scene, with its dimple in the middle, on equal cells that are snapped to the wall.

    Parameters
    ----------
    words : name of the row.
    scene : the scene; half of its cell is solved.
    columns : number of columns along the cell, as many per length across.
    """
    plan = scene.plan()
    length, breadth = plan.length / plan.film, plan.breadth / plan.film
    x, y = (np.arange(POINTS) / POINTS * side for side in (plan.length, plan.breadth))
    thickness = plan.thickness(x[:, None] - plan.length / 2, y[None]) / plan.film
    step = 1 / (np.floor(columns * LAYERS_PER_COLUMN) + 0.4)
    layers = int(np.ceil(thickness.max() / step)) + 1
    rows = round(columns * breadth / length / 2)
    box = Box(size=(length, breadth / 2), bottom=1 - layers * step, top=1.0, cells=(columns, rows, layers))
    walls = Walls(lower=1 - thickness, upper=np.ones_like(thickness), spacing=(length / POINTS, breadth / POINTS))
    solid = repeated(wall_mesh(walls, GapPart.LOWER), (length, breadth))
    inside = (0.3 * length + 0.01, 0.2 * breadth + 0.013, 0.517)
    with scratch_directory() as place:
        case = Path(place) / "case"
        write_snapped(
            Carved(box=box, solid=solid, inside=inside),
            case,
            drive=Drive(name="sliding", speed=1.0),
            reynolds_number=scene.reynolds_number,
            tolerance=TOLERANCE,
            scheme="linear_upwind",
            sides=sides(mirrored=True),
        )
        flow = run_snapped(case)
        succeed(case, ["postProcess", "-func", "writeCellCentres", "-latestTime"], "log.centres")
        last = last_fields(case)
        centre, velocity = (internal_field(last / name, 3) for name in ("C", "U"))
        pressure = internal_field(last / "p", 1)[:, 0] * scene.reynolds_number
    by_layer = []
    for layer in (0, 1):
        chosen = np.flatnonzero(np.abs((1 - centre[:, 2]) / step - layer - 0.5) < 0.4)
        if chosen.size != columns * rows:
            raise ConvergenceError(f"snappyHexMesh: layer {layer} below the sliding wall has {chosen.size} cells")
        order = chosen[np.lexsort((np.round(centre[chosen, 1], 3), np.round(centre[chosen, 0], 3)))]
        by_layer.append(order.reshape(columns, rows))
    near, far = by_layer
    distances = 1 - centre[near, 2], 1 - centre[far, 2]
    half = (pressure[near] * distances[1] - pressure[far] * distances[0]) / (distances[1] - distances[0])
    shear = (1 - velocity[near, 0]) / distances[0]
    wall = OnSlidingWall(
        x=np.linspace(-length / 2, length / 2, columns + 1),
        y=np.linspace(-breadth / 2, breadth / 2, 2 * rows + 1),
        thickness=np.ones((columns, 2 * rows)),
        pressure=np.concatenate([half[:, ::-1], half], axis=1),
        shear_stress=np.concatenate([shear[:, ::-1], shear], axis=1),
    )
    found = plan_quantities(scene, wall, backflow=0.0)
    return {
        "case": words,
        "columns": columns,
        **{name: quantity.value for name, quantity in found.items()},
        "iterations": flow.iterations,
        "cpu_s": flow.cpu_s,
        "cells": flow.cells,
        "volume": flow.volume,
    }
