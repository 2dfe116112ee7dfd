"""Read the result of a cell in plan whose OpenFOAM case was run."""

from pathlib import Path

import numpy as np

from roughfilm.foamcases.openfoam.one_flow import Run, numerics_of
from roughfilm.foamcases.pocket.card import Card
from roughfilm.foamcases.pocket.plan.fields import read_cell
from roughfilm.rom.ladder.model import Effect, Model
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.result import Field, Result
from roughfilm.rom.pocket.plan.quantities import OnSlidingWall, plan_fields, plan_quantities
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.warnings import inertia_warnings, ruptures

MAX_IMBALANCE = 0.005
"""Largest difference of the drags on both walls, over that on the sliding wall, without a warning."""

MIN_COLUMNS = 2.0
"""Least extent of a dimple or ramp over the width of the narrowest columns without a warning."""


def read_plan(solver: Model[Pocket], scene: Pocket, directory: Path, card: Card, run: Run) -> Result:
    """Read the result of a case that was run; errors as in :func:`roughfilm.foamcases.pocket.plan.fields.read_cell`."""
    flow, plan = read_cell(directory, card), scene.plan()
    film, pascal = plan.film, scene.pressure_unit
    x, y = flow.sides
    middle_x, middle_y = (x[1:] + x[:-1])[:, None] / 2, (y[1:] + y[:-1]) / 2
    wall = OnSlidingWall(
        x=x,
        y=y,
        thickness=plan.thickness(middle_x * film, middle_y * film) / film,
        pressure=flow.wall_pressure,
        shear_stress=flow.wall_shear,
    )
    lowest, highest = flow.pressure_range()
    imbalance = flow.imbalance()
    remarks = [] if Effect.INERTIA in solver.keeps else [*inertia_warnings(scene)]
    if imbalance > MAX_IMBALANCE:
        remarks.append(f"the drags on both walls differ by {imbalance:.1%}; the mesh is too coarse or skew")
    column = film * min(np.diff(x).min(), np.diff(y).min())
    if plan.smallest < MIN_COLUMNS * column:
        remarks.append(
            f"the least extent of a dimple or of the ramp at its rim, {plan.smallest:.3g} m, is below {MIN_COLUMNS:g} "
            f"of the narrowest columns, {column:.3g} m: its wall is not resolved; take more columns or a wider edge"
        )
    return Result(
        model=solver.name,
        quantities=plan_quantities(scene, wall, backflow=flow.back_flow(), pressure_range=(lowest, highest)),
        fields={
            **plan_fields(scene, wall),
            "vertices": Field(values=flow.vertices * film, unit="m"),
            "cell_velocity": Field(values=flow.velocity * scene.speed, unit="m/s"),
            "cell_pressure": Field(values=(flow.pressure - wall.edge_mean) * pascal, unit="Pa"),
        },
        numerics=numerics_of(
            card,
            run,
            unknowns=4 * flow.pressure.size // (2 if card.mirrored else 1),
            details={"layers": card.layers, "mirrored": float(card.mirrored)},
            imbalance=imbalance,
        ),
        provenance=provenance(
            scene, model=solver.name, keeps=tuple(solver.keeps), sources=solver.sources, openfoam=run.version
        ),
        warnings=(*ruptures(scene, solver, lowest - wall.edge_mean), *remarks, *run.warnings),
    )
