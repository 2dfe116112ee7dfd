"""Write the case directory of an infinitely wide pad, with a README and a script to run it by hand."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.bearing.dictionaries import SIDES, STEPS, pad_dictionaries
from roughfilm.foamcases.bearing.mesh import Plane, layers_of, plane_of, step_obstacle
from roughfilm.foamcases.bearing.units import pressure_difference, velocity_unit
from roughfilm.foamcases.openfoam.block_mesh import in_space, write_block
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.dictionaries import write_files
from roughfilm.foamcases.openfoam.iterate import Settled
from roughfilm.foamcases.openfoam.one_flow import write_flow
from roughfilm.foamcases.openfoam.relaxation import velocity_relaxation
from roughfilm.foamcases.openfoam.residuals import PLANE, Judged, judged_fields
from roughfilm.foamcases.openfoam.settling import settled_within
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.wide_pad.gap import film_obstacle
from roughfilm.rom.ladder.request import CheckedRequest

COLUMNS_PER_LAYER = 5
"""Number of columns for each layer in the rule for the relaxation of velocity; only the layers matter in a long pad."""

MIN_SLOPE = 1e-4
"""Largest slope of the still wall up to which the velocity across the film is round-off."""

README = """\
The film of an infinitely wide pad between two end sections, for OpenFOAM's simpleFoam. Run it with ./Allrun

Lengths are in minimum film thicknesses, velocities in V = {speed:.12g} m/s, so nu = 1 / Re with V and this film, and
  p [Pa]    = p * {pressure:.12g} + {outlet:.12g}   above ambient pressure
  U [m/s]   = U * {speed:.12g}
  x, y [m]  = x, y * {film:.12g}
The upper wall (patch "upper", y = 1) slides along x. The pressure is uniform over "inlet", where the sliding wall
enters, and over "outlet", where it leaves.
"""


@dataclass(frozen=True, kw_only=True)
class PadCard:
    """The options with which a case was written, which are needed to run it and read it back.

    Attributes
    ----------
    film_layers : number of layers in the minimum film thickness; a wall with steps has more below it.
    lowest : the lowest layer of each column that is in the liquid; empty where all layers are.
    judged : the fields whose residuals are judged, the main velocity first.
    """

    columns: int
    layers: int
    film_layers: int
    reynolds_number: float
    resolution: int
    tolerance: float
    scheme: str
    processes: int
    dialect: str
    lowest: list[int]
    judged: list[str]

    @property
    def relaxation(self) -> float:
        """The relaxation of velocity in SIMPLEC."""
        return velocity_relaxation(COLUMNS_PER_LAYER * self.film_layers)

    @property
    def criteria(self) -> Judged:
        """The criteria of a converged flow."""
        return Judged(fields=tuple(self.judged))

    @property
    def settles(self) -> bool:
        """Whether the run ends by its mean velocity, since the residual of the velocity across is round-off."""
        return tuple(self.judged) != PLANE

    def settled(self, directory: Path) -> Settled | None:
        """The test that ends the run of the case in a directory; None if residuals end it."""
        return settled_within(self.tolerance, directory, self.criteria) if self.settles else None


def write_pad_case(
    scene: Bearing,
    directory: Path,
    request: CheckedRequest,
    reynolds_number: float,
    dialect: Dialect,
    *,
    run: bool = False,
) -> None:
    """Write the case of a scene completely or not at all.

    Parameters
    ----------
    scene : an infinitely wide pad.
    directory : the directory of the case, which is made; it may exist if it is empty.
    request : numerical options. The resolution is the number of mesh columns along the film, about, as columns begin
        and end at every corner of the wall; the layers are in proportion.
    reynolds_number : the Reynolds number of film and velocity unit at which the case is run; the model chooses it.
    dialect : the dialect of OpenFOAM in which the case is written.
    run : whether the case is to be run by this library at once, which needs no dictionaries of a second try.

    Raises
    ------
    InputError
        If the film is not resolved by OpenFOAM, the wall has no mesh of this resolution, or the directory is not empty
        or cannot be written.
    """
    if obstacle := film_obstacle(scene) or step_obstacle(scene):
        raise InputError(f"scene: has no OpenFOAM case, as {obstacle}")
    mesh, film, speed = plane_of(scene, request.resolution), scene.geometry.thinnest, velocity_unit(scene)
    stepped, inclined = bool(mesh.lowest.any()), _steepest(mesh) > MIN_SLOPE
    along, across = np.diff(mesh.vertices[..., 0], axis=0), np.diff(mesh.vertices[..., 1], axis=1)
    card = PadCard(
        columns=mesh.kept.shape[0],
        layers=mesh.kept.shape[1],
        film_layers=layers_of(scene, request.resolution),
        reynolds_number=reynolds_number,
        resolution=request.resolution,
        tolerance=request.tolerance,
        scheme=request.scheme,
        processes=request.processes,
        dialect=dialect.name,
        lowest=mesh.lowest.tolist() if stepped else [],
        judged=list(judged_fields(PLANE, along, across)) if inclined else ["Ux", "p"],
    )
    pascal = scene.lubricant.viscosity * speed / film
    readme = README.format(
        pressure=pascal * reynolds_number, outlet=scene.boundary.outlet.pressure, speed=speed, film=film
    )

    def fill(place: Path) -> None:
        write_block(in_space(mesh.vertices), SIDES, place, kept=mesh.kept[..., None], cut=STEPS)
        files = pad_dictionaries(
            dialect=dialect,
            viscosity=1 / reynolds_number,
            speed=abs(scene.motion.speed) / speed,
            pressure=pressure_difference(scene) / (pascal * reynolds_number),
            stepped=stepped,
            settles=card.settles,
            tolerance=request.tolerance,
            scheme=request.scheme,
            processes=request.processes,
            relaxation=card.relaxation,
        )
        write_files(place, files)

    write_flow(directory, fill, card, card.criteria, dialect, readme=readme, run=run, settles=card.settles)


def _steepest(mesh: Plane) -> float:
    """The largest slope of the still wall; infinite where it has steps."""
    if mesh.lowest.any():
        return np.inf
    run, climb = np.abs(np.diff(mesh.vertices[:, 0], axis=0)).T
    return float((climb / np.maximum(run, np.finfo(float).tiny)).max())
