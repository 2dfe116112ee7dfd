"""Read the result of a pad's OpenFOAM case that was run."""

from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.rounding import round_off
from roughfilm.foamcases.bearing.case import PadCard
from roughfilm.foamcases.bearing.fields import PadFlow, read_pad
from roughfilm.foamcases.bearing.units import pressure_difference, velocity_unit
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.openfoam.one_flow import Run, numerics_of
from roughfilm.rom.bearing.outside import channel_outside
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.totals.reported import in_order
from roughfilm.rom.bearing.warnings import rupture_warnings
from roughfilm.rom.bearing.wide_pad.gap import pad_gap
from roughfilm.rom.bearing.wide_pad.quantities import pad_quantities
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.result import Field, Result


def read(solver: Model[Bearing], scene: Bearing, directory: Path, run: Run) -> Result:
    """Read the result of a case that was run; errors as in :func:`roughfilm.foamcases.bearing.fields.read_pad`."""
    card, film, speed = read_card(directory, PadCard), scene.geometry.thinnest, velocity_unit(scene)
    pascal = scene.lubricant.viscosity * speed / film
    driven, outlet = pressure_difference(scene) / pascal, scene.boundary.outlet.pressure
    flow = read_pad(directory, speed=abs(scene.motion.speed) / speed, inlet=driven)
    lowest, highest = flow.channel.pressure_range(driven, 0.0)
    through = flow.flow * speed * film
    thickness, pressures = pad_gap(scene).thickness(flow.channel.position * film), np.array([lowest, highest]) * pascal
    warnings = [
        *rupture_warnings(outlet + pressures - scene.lubricant.cavitation_pressure),
        *run.warnings,
    ]
    return Result(
        model=solver.name,
        quantities=in_order(
            scene,
            pad_quantities(
                scene,
                load=flow.load * pascal * film + outlet * scene.geometry.length,
                friction=flow.friction * pascal * film,
                inlet_flow=float(through[0]),
                outlet_flow=float(through[-1]),
                pressure_max=outlet + highest * pascal,
                rounding=round_off(max(abs(lowest), abs(highest)) * pascal + abs(outlet), through.size),
            ),
        ),
        fields=_fields(scene, flow, speed, pascal),
        numerics=numerics_of(
            card,
            run,
            unknowns=3 * int(flow.kept.sum()),
            details={"force_imbalance": flow.force_imbalance, "mass_imbalance": flow.mass_imbalance},
        ),
        provenance=provenance(
            scene, model=solver.name, keeps=tuple(solver.keeps), sources=solver.sources, openfoam=run.version
        ),
        warnings=tuple(warnings),
        outside=channel_outside(scene, thickness, float(through[0]), outlet + pressures),
    )


def _fields(scene: Bearing, flow: PadFlow, speed: float, pascal: float) -> dict[str, Field]:
    """The fields on the sliding wall, shape (nx, 1), and in the cells, in the coordinates of the scene."""
    film, outlet, channel = scene.geometry.thinnest, scene.boundary.outlet.pressure, flow.channel
    x = channel.position * film
    values = {
        "x": (x[:, None], "m"),
        "y": (np.zeros((x.size, 1)), "m"),
        "film_thickness": (pad_gap(scene).thickness(x)[:, None], "m"),
        "pressure": (outlet + channel.wall_pressure[:, None] * pascal, "Pa"),
        "density_ratio": (np.ones((x.size, 1)), "1"),
        "shear_stress": (channel.wall_shear[:, None] * pascal, "Pa"),
        "vertices": (channel.vertices * film, "m"),
        "cell_velocity": (channel.velocity * speed, "m/s"),
        "cell_pressure": (np.where(flow.kept, outlet + channel.pressure * pascal, 0.0), "Pa"),
    }
    if not flow.kept.all():
        values["kept"] = (flow.kept.astype(float), "1")
    if scene.motion.speed < 0:  # the mesh runs along the motion
        length, turn = scene.geometry.length, np.array([-1.0, 1.0])
        values = {name: (field[::-1], unit) for name, (field, unit) in values.items()}
        values["x"] = (length - values["x"][0], "m")
        values["vertices"] = (values["vertices"][0] * turn + [length, 0.0], "m")
        values["cell_velocity"] = (values["cell_velocity"][0] * turn, "m/s")
    return {name: Field(values=np.ascontiguousarray(one), unit=unit) for name, (one, unit) in values.items()}
