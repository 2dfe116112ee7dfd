"""Mixed films: a film and the asperities in contact, at any separation of the walls and any speed."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.film import FlooredFlowFactors
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.contact_load import AsperityLoad, asperity_load
from roughfilm.rom.bearing.quantities import load_of, nominal_area, scene_positions
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.exchange import Temperatures
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.evaluation.friction import friction
from roughfilm.rom.cavitation.grid import Grid, grid, quarters
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution, solve

RESIDUAL_FRACTION = 0.1
"""Fraction of the error of the load that the residuals of the film may cause."""

SEPARATION_STEP = 1e-5
"""Step of the separation over that of first contact, over which the slope of the mean gap is taken."""

MIN_RESIDUAL = 1e-12
"""Smallest residual that is required of a film."""


@dataclass(frozen=True, kw_only=True)
class MixedState:
    """A converged mixed film; forces in N (N/m if infinitely wide), in a journal bearing magnitudes of vectors.

    Attributes
    ----------
    scene : the scene at this separation and speed.
    solution : the film.
    contact : the contact of the asperities.
    load : load of film and asperities together.
    contact_load : load of the asperities alone.
    friction : boundary friction plus friction of the film.
    temperatures : temperatures that the heat of the film brings about; None of an isothermal film.
    """

    scene: Bearing
    solution: Solution
    contact: AsperityLoad
    load: float
    contact_load: float
    friction: float
    temperatures: Temperatures | None = None

    @property
    def film_load(self) -> float:
        """The load minus the contact load, N."""
        return self.load - self.contact_load

    @property
    def cavitated_fraction(self) -> float:
        """The cavitated fraction of the area of the film."""
        areas = self.solution.grid.areas
        return float(areas[self.solution.kind == CAVITY].sum() / areas.sum())


@dataclass(frozen=True, kw_only=True)
class MixedFilm:
    """A bearing with asperities at any separation and speed.

    Attributes
    ----------
    scene : the bearing; its film thickness and speed have no effect.
    asperities : flow factors and contact pressures.
    cells : number of cells along and across.
    accuracy : relative error of the load, which determines the residual of the film.
    film : film(scene), the problem of a film; None for that with the flow factors of the asperities.
    first : film thickness at which a search begins, m; None for that of first contact.
    """

    scene: Bearing
    asperities: Asperities
    cells: int
    accuracy: float = 1e-6
    film: Callable[[Bearing], Problem] | None = None
    first: float | None = None

    @cached_property
    def grid(self) -> Grid:
        """The grid, the same at all separations."""
        return grid(self._shape, (self.cells, self.cells))

    @property
    def _reference(self) -> float:
        """The film thickness at which the geometry is sampled, m."""
        film = self.scene.geometry.film
        return self.asperities.touching if film is None else film

    @property
    def _shape(self) -> Shape:
        """The shape of the film at the reference film thickness."""
        return self.scene.geometry.at_film(self._reference).film_shape()

    @cached_property
    def area(self) -> float:
        """The nominal area, m² (m if infinitely wide)."""
        return nominal_area(self.scene, self.grid)

    @cached_property
    def dip(self) -> float:
        """The film thickness of the geometry minus its minimum on the grid, m; above 0 only for wavy walls."""
        thickness = self._shape.thickness(*np.meshgrid(self.grid.x, self.grid.y, indexing="ij"))
        return max(0.0, self._reference - float(thickness.min()))

    @cached_property
    def closest(self) -> float:
        """The smallest film thickness that can be solved, m; negative where asperities are flattened."""
        return self.asperities.closest + self.dip

    @cached_property
    def touching(self) -> float:
        """The film thickness at first contact, m, or at which the search begins."""
        return self.asperities.touching + self.dip if self.first is None else self.first

    @property
    def residual(self) -> float:
        """The residual at which a film solve stops; residuals accumulate over the cells."""
        return min(max(RESIDUAL_FRACTION * self.accuracy / self.cells, MIN_RESIDUAL), RESIDUAL_TOLERANCE)

    @property
    def widest(self) -> float:
        """The largest film thickness of the geometry, m."""
        return self.scene.geometry.widest

    @property
    def remedy(self) -> str:
        """The remedy for a load that is too large."""
        if self.scene.asperities is not None:
            return "lower the load, or make a table with larger loads"
        if self.scene.roughness is None:
            return "lower the load, or raise the speed or the viscosity"
        return "lower the load, or add [asperities], so that the walls may touch"

    def scene_at(self, film: float, speed: float) -> Bearing:
        """The scene at another film thickness, m, and speed, m/s."""
        return self.scene.at_speed(speed).at_film(film)

    def at(self, film: float, speed: float, start: State | None = None) -> MixedState:
        """Solve the film at a minimum thickness, m, and a speed, m/s, starting from the state of another film."""
        scene = self.scene_at(film, speed)
        problem = mixed_problem(scene, self.asperities) if self.film is None else self.film(scene)
        cells = (self.cells, self.cells)
        solution = solve(problem, cells, start=start, tolerance=self.residual)
        contact = asperity_load(solution.problem.shape, solution.grid, self.asperities)
        return mixed_state(scene, solution, contact)

    @cached_property
    def _contact_heights(self) -> tuple[Array, Array]:
        """The distinct separations minus the film thickness where contact is possible, m, and their areas, m²."""
        points = list(quarters(self._shape, self.grid))
        above = np.concatenate([self._shape.thickness(x, y).ravel() for x, y, _ in points]) - self._reference
        areas = np.concatenate([area.ravel() for _, _, area in points])
        low = above < self.asperities.touching - self.asperities.closest
        heights, which = np.unique(np.maximum(above[low], -self.dip), return_inverse=True)
        merged: Array = np.bincount(which, weights=areas[low], minlength=heights.size).astype(np.float64)
        return heights, merged

    def contact_load(self, film: float) -> float:
        """The load of the asperities at a film thickness, N."""
        scene = self.scene_at(film, 0.0)
        if not isinstance(scene.geometry, Shaft):
            above, areas = self._contact_heights
            return float((areas * self.asperities.contact_pressure(film + above)).sum())
        force = asperity_load(scene.geometry.film_shape(), self.grid, self.asperities).force
        return load_of(scene, self.grid.x, force)


def mixed_problem(scene: Bearing, asperities: Asperities) -> Problem:
    """The problem of a film with the flow factors of its asperities, whose mean gap changes with the separation."""
    problem = scene.problem()
    shape = replace(problem.shape, roughness=FlooredFlowFactors(asperities, asperities.mean_gap))
    opening, thickness = problem.opening, problem.shape.thickness
    if opening is None:
        return replace(problem, shape=shape)
    step = SEPARATION_STEP * asperities.touching

    def of_gap(x: Array, y: Array) -> Array:
        """The rate of the mean gap, m/s, which in plastic contact falls slower than the separation."""
        h = thickness(x, y)
        slope = (asperities.mean_gap(h + step) - asperities.mean_gap(h)) / step
        return np.asarray(opening(x, y) * slope)

    return replace(problem, shape=shape, opening=of_gap)


def mixed_state(scene: Bearing, solution: Solution, contact: AsperityLoad) -> MixedState:
    """The mixed film with its loads and friction, from the film and the contact of its asperities."""
    boundary = scene.boundary_friction
    x = scene_positions(solution)
    film = solution.grid.areas * (solution.state.pressure + scene.lubricant.cavitation_pressure)
    return MixedState(
        scene=scene,
        solution=solution,
        contact=contact,
        load=load_of(scene, x, film + contact.force),
        contact_load=load_of(scene, x, contact.force),
        friction=friction(solution) + boundary * float(contact.force.sum()),
    )
