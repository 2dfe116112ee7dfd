"""Read the result of a pocket's OpenFOAM case that was run."""

from pathlib import Path

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.one_flow import Run, numerics_of
from roughfilm.foamcases.pocket.card import Card
from roughfilm.foamcases.pocket.fields import read_channel
from roughfilm.foamcases.pocket.plan.cases import read_plan
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.result import Field, Result
from roughfilm.rom.pocket.scene import Pocket, pocket_quantities
from roughfilm.rom.pocket.validity.warnings import ruptures


def read(solver: Model[Pocket], scene: Pocket, directory: Path, run: Run) -> Result:
    """Read the result of a case that was run; errors as in :func:`roughfilm.foamcases.pocket.fields.read_channel`."""
    model, keeps, card = solver.name, solver.keeps, read_card(directory, Card)
    if bool(card.rows) != scene.in_plan:
        of = ("grooves", "a cell in plan")
        raise InputError(f"{directory}: holds a case of {of[bool(card.rows)]}, and the scene has {of[scene.in_plan]}")
    if scene.in_plan:
        return read_plan(solver, scene, directory, card, run)
    channel = read_channel(directory)
    film, pascal = scene.geometry.film, scene.pressure_unit
    lowest, highest = channel.pressure_range(0.0)
    return Result(
        model=model,
        quantities=pocket_quantities(
            scene,
            load=channel.mean(channel.wall_pressure),
            friction=channel.mean(channel.wall_shear),
            pressure_max=highest,
            pressure_min=lowest,
            backflow=channel.back_flow(),
            parts=channel.wall_pressure.size,
        ),
        fields={
            "position": Field(values=channel.position * film, unit="m"),
            "film_thickness": Field(values=scene.gap().thickness(channel.position * film), unit="m"),
            "pressure": Field(values=channel.wall_pressure * pascal, unit="Pa"),
            "shear_stress": Field(values=channel.wall_shear * pascal, unit="Pa"),
            "vertices": Field(values=channel.vertices * film, unit="m"),
            "cell_velocity": Field(values=channel.velocity * scene.speed, unit="m/s"),
            "cell_pressure": Field(values=channel.pressure * pascal, unit="Pa"),
        },
        numerics=numerics_of(card, run, unknowns=3 * card.columns * card.layers, details={}),
        provenance=provenance(scene, model=model, keeps=tuple(keeps), sources=solver.sources, openfoam=run.version),
        warnings=(*ruptures(scene, solver, lowest), *run.warnings),
    )
