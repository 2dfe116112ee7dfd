"""Read the result of a cell in plan whose OpenFOAM case was run."""

from pathlib import Path

from roughfilm.foamcases.openfoam.one_flow import Run
from roughfilm.foamcases.pocket.card import Card
from roughfilm.foamcases.pocket.plan.fields import read_cell
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.result import Field, Numerics, Result, SolverRun
from roughfilm.rom.pocket.plan.quantities import OnSlidingWall, plan_fields, plan_quantities
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity.warnings import cautions, ruptures

MAX_IMBALANCE = 0.005
"""Largest difference of the drags on both walls, over that on the sliding wall, without a warning."""


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
    unbalanced = (
        (f"the drags on both walls differ by {imbalance:.1%}; the mesh is too coarse or skew",)
        if imbalance > MAX_IMBALANCE
        else ()
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
        numerics=Numerics(
            residual=run.residual,
            iterations=run.tries[-1].iterations,
            cpu_s=run.cpu_s,
            wall_s=run.wall_s,
            degrees_of_freedom=4 * flow.pressure.size // (2 if card.mirrored else 1),
            resolution=card.resolution,
            tolerance=card.tolerance,
            scheme=card.scheme,
            processes=card.processes,
            runs=tuple(
                SolverRun(
                    outcome=str(t.outcome),
                    iterations=t.iterations,
                    recipe=t.recipe,
                    residual=run.residual if t is run.tries[-1] else None,
                    imbalance=imbalance if t is run.tries[-1] else None,
                )
                for t in run.tries
            ),
            details={
                "velocity_relaxation": card.relaxation,
                "reynolds_number": card.reynolds_number,
                "layers": card.layers,
                "mirrored": float(card.mirrored),
            },
        ),
        provenance=provenance(
            scene, model=solver.name, keeps=tuple(solver.keeps), sources=solver.sources, openfoam=run.version
        ),
        warnings=(*cautions(scene), *ruptures(scene, lowest - wall.edge_mean), *unbalanced, *run.warnings),
    )
