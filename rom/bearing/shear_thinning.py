"""Films of bearings whose lubricant thins with shear."""

from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.quantities import Fields
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.solve import solve
from roughfilm.rom.bearing.thermal.field.films import HeatedBearing, HeatedSolution
from roughfilm.rom.bearing.thermal.field.nodal import between_nodes
from roughfilm.rom.bearing.thermal.field.residual import iteration
from roughfilm.rom.bearing.thermal.isothermal import isothermal_model
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.ladder.model import Model, Progress
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.lubricants.shear_thinning import ThinningCurve
from roughfilm.rom.shear_thinning.film import thinned

THINNING_TOLERANCE = 1e-6
"""Largest difference of ln η between a film and the law at its flows at which the iteration stops."""


@dataclass(frozen=True)
class ThinnedFilm:
    """The viscosities of a film at its shear on a grid, at the one temperature of its lubricant, K, and its stress."""

    grid: Grid
    temperature: Array
    viscosities: Viscosities
    stress: Array
    settled: bool = True
    inlet: None = None


@dataclass(frozen=True)
class Thinning:
    """The shear thinning of the films of a scene at one temperature.

    Attributes
    ----------
    curve : fluidity over stress.
    temperature : temperature of the lubricant, K; 0 if it is not known.
    """

    curve: ThinningCurve
    temperature: float

    def __call__(self, solution: Solution, near: ThinnedFilm | None) -> ThinnedFilm:
        """The viscosities by the law at the flows of a film; ConvergenceError if a stress does not converge."""
        start = None if near is None else stress_on(solution, near.stress, near.grid)
        found = thinned(solution, self.curve, gap=mean_gap(solution), start=start)
        temperature = np.full(solution.grid.shape, self.temperature)
        return ThinnedFilm(solution.grid, temperature, found.viscosities, found.stress)


def stress_on(solution: Solution, stress: Array, grid: Grid) -> Array:
    """The stress of a film near a solution at its nodes, shape (nx, ny, 4), from that on another grid."""
    if stress.shape[:2] == solution.grid.shape:
        return stress
    x, y = np.meshgrid(solution.grid.x, solution.grid.y, indexing="ij")
    parts, joined = np.moveaxis(stress, -1, 0), solution.problem.shape.joined
    return between_nodes(parts, grid, joined, x.ravel(), y.ravel()).T.reshape(*solution.grid.shape, 4)


def mean_gap(solution: Solution) -> Array:
    """The mean gap at the nodes, m, which where asperities are flattened is larger than the film thickness."""
    gap = getattr(solution.problem.shape.roughness, "mean_gap", np.asarray)
    return np.asarray(gap(solution.faces.thickness))


def thinning(scene: Bearing) -> HeatedBearing | None:
    """The coupling of the films of a scene with the shear thinning of its lubricant; None without such a law."""
    lubricant = scene.lubricant
    if lubricant.shear_thinning is None:
        return None
    curve = lubricant.shear_thinning.curve(lubricant.viscosity)
    return HeatedBearing(heating=Thinning(curve, lubricant.temperature or 0.0), tolerance=THINNING_TOLERANCE)


def solve_thinned(solver: Model[Bearing], scene: Bearing, request: CheckedRequest, progress: Progress) -> Result:
    """Solve the film of a bearing whose lubricant thins with shear, and estimate the uncertainty of its quantities.

    The film is that of the isothermal model that the scene needs, with viscosities at the nodes that are those of the
    law at its own flows (:func:`roughfilm.rom.shear_thinning.film.thinned`).

    Parameters
    ----------
    solver : the model.
    request : the numerical options.

    Raises
    ------
    InputError
        If no film carries the load of the scene.
    ConvergenceError
        If the film, its load or its viscosities do not converge.
    """
    base = isothermal_model(scene)

    def fields(one: Bearing, solution: Solution) -> Fields:
        return {**base.outputs.fields(one, solution), "viscosity": (viscosity_field(solution), "Pa*s")}

    return solve(
        solver,
        scene,
        request,
        progress,
        film=base.film,
        ruptures=True,
        outputs=replace(base.outputs, fields=fields, details=details),
        heat=thinning(scene),
        **base.more,
    )


def details(solution: Solution) -> dict[str, float]:
    """The numbers of the iteration of film and viscosities, for the numerics of a result.

    They are those of :func:`roughfilm.rom.bearing.thermal.field.residual.iteration`, and ``thinned_films``, the number
    of films on the grid.
    """
    if not isinstance(solution, HeatedSolution):
        return {}
    return {**iteration(solution), "thinned_films": float(len(solution.changes))}


def viscosity_field(solution: Solution) -> Array:
    """The viscosity of the shear by sliding, h/∫ dz/η, at the nodes under their pressure, Pa s."""
    own = solution.problem.at_nodes
    viscosity = solution.problem.viscosity if own is None else own.shear
    return np.asarray(viscosity / solution.problem.fluidity(solution.state.pressure)[0])
