"""A film and the asperities that reach through it, at any separation of the walls and any speed."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.touching import Touching, quarters, touching
from roughfilm.rom.bearing.quantities import carried, friction, nominal_area
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shapes import Journal
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.grid import Grid, grid
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.cavitation.solve import Solution, solve
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap, GapFactors

SEEPING = 1e-6
"""Of a smooth film's flow factors, at the least: it keeps the pressure of sealed places defined, by hardly a drop."""

SPARE, LEAST_RESIDUAL = 0.1, 1e-12
"""Of the load's accuracy, what residuals may take; and the residual of a film, at the least."""


@dataclass(frozen=True, kw_only=True)
class MixedState:
    """A mixed film in balance; ``load`` and ``contact_load`` in N, N/m if infinitely wide, of a journal as vectors.

    Attributes
    ----------
    scene : at this separation and speed.
    solution : the film.
    contact : the asperities.
    load : of film and asperities together.
    contact_load : of the asperities alone.
    friction : boundary friction, and that of the film, N.
    """

    scene: Bearing
    solution: Solution
    contact: Touching
    load: float
    contact_load: float
    friction: float

    @property
    def film_load(self) -> float:
        """What the film adds to the load of the asperities, N."""
        return self.load - self.contact_load

    @property
    def cavitated_fraction(self) -> float:
        """The part of the film that is torn."""
        areas = self.solution.grid.areas
        return float(areas[self.solution.kind == CAVITY].sum() / areas.sum())


@dataclass(frozen=True, kw_only=True)
class MixedFilm:
    """A bearing with asperities on a grid of ``cells`` along and across; its own film and speed do not count.

    ``accuracy`` is that of the load, relative; the film's own residual adds up over the cells and is kept below it.
    """

    scene: Bearing
    asperities: Asperities
    cells: int
    accuracy: float = 1e-6

    @cached_property
    def grid(self) -> Grid:
        """The nodes, the same at all separations."""
        return grid(self.scene.geometry.film_shape(), (self.cells, self.cells))

    @property
    def boundary_friction(self) -> float:
        """Friction over load where asperities touch."""
        assert self.scene.asperities is not None
        return self.scene.asperities.friction

    @cached_property
    def area(self) -> float:
        """Nominal area, m²; m if infinitely wide."""
        return nominal_area(self.scene, self.grid)

    @cached_property
    def dip(self) -> float:
        """How much nearer than ``film`` the walls come at the narrowest place, m; 0 unless waves reach below it."""
        geometry = self.scene.geometry
        thickness = geometry.film_shape().thickness(*np.meshgrid(self.grid.x, self.grid.y, indexing="ij"))
        return max(0.0, geometry.film - float(thickness.min()))

    @cached_property
    def closest(self) -> float:
        """The least film at which the asperities are known everywhere, m; below 0 where tips are crushed."""
        return self.asperities.closest + self.dip

    @cached_property
    def touching(self) -> float:
        """The film at which the walls begin to touch, m."""
        return self.asperities.touching + self.dip

    @property
    def residual(self) -> float:
        """That the film may have."""
        return min(max(SPARE * self.accuracy / self.cells, LEAST_RESIDUAL), RESIDUAL_TOLERANCE)

    @property
    def widest(self) -> float:
        """The thickest film that the geometry allows, m."""
        return widest_film(self.scene)

    def scene_at(self, film: float, speed: float) -> Bearing:
        """The scene with another least film, m, and speed, m/s."""
        motion = self.scene.motion.model_copy(update={"speed": speed})
        return self.scene.model_copy(update={"geometry": self.scene.geometry.at_film(film), "motion": motion})

    def at(self, film: float, speed: float, start: State | None = None) -> MixedState:
        """Solve the film of a least thickness, m, at a speed, m/s, from the state of another if there is one."""
        scene = self.scene_at(film, speed)
        problem, cells = mixed_problem(scene, self.asperities), (self.cells, self.cells)
        found = solve(problem, cells, start=start, tolerance=self.residual)
        contact = touching(found.problem.shape, found.grid, self.asperities)
        return mixed_state(scene, found, contact)

    @cached_property
    def _floor(self) -> tuple[Array, Array]:
        """How far above the film each height of a wall that shifts as a whole lies, m, and its area; no higher than
        can touch.
        """
        geometry = self.scene.geometry
        parts = list(quarters(geometry.film_shape(), self.grid))
        above = np.concatenate([separation.ravel() for separation, _ in parts]) - geometry.film
        areas = np.concatenate([area.ravel() for _, area in parts])
        low = above < self.asperities.touching - self.asperities.closest
        heights, which = np.unique(np.maximum(above[low], -self.dip), return_inverse=True)
        merged: Array = np.bincount(which, weights=areas[low], minlength=heights.size).astype(np.float64)
        return heights, merged

    def contact_load(self, film: float) -> float:
        """What the asperities alone carry at a least film, N."""
        scene = self.scene_at(film, 0.0)
        if not isinstance(scene.geometry, Journal):
            above, areas = self._floor
            return float((areas * self.asperities.contact_pressure(film + above)).sum())
        force = touching(scene.geometry.film_shape(), self.grid, self.asperities).force
        return carried(scene, self.grid.x, force)


def widest_film(scene: Bearing) -> float:
    """The thickest least film that a geometry allows, m."""
    return scene.geometry.clearance if isinstance(scene.geometry, Journal) else scene.geometry.length


def mixed_problem(scene: Bearing, asperities: Asperities) -> Problem:
    """The film of a scene, averaged over its asperities."""
    problem = scene.problem()
    return replace(problem, shape=replace(problem.shape, roughness=Seeping(asperities, asperities.mean_gap)))


def mixed_state(scene: Bearing, found: Solution, contact: Touching) -> MixedState:
    """Loads and friction of a film and its asperities."""
    assert scene.asperities is not None
    x = -found.grid.x if found.turned else found.grid.x
    film = found.grid.areas * (found.state.pressure + scene.lubricant.cavitation_pressure)
    return MixedState(
        scene=scene,
        solution=found,
        contact=contact,
        load=carried(scene, x, film + contact.force),
        contact_load=carried(scene, x, contact.force),
        friction=friction(found) + scene.asperities.friction * float(contact.force.sum()),
    )


@dataclass(frozen=True)
class Seeping:
    """Flow factors that let at least ``SEEPING`` of a smooth film through, so that no place is cut off.

    ``mean_gap`` is that of rough walls over the separation, m, where the two are not the same.
    """

    factors: FactorsOverGap
    mean_gap: Callable[[Array], Array] = np.asarray

    def __call__(self, separation: Array, /) -> GapFactors:
        """The factors, each of the shape of ``separation``."""
        found, h = self.factors(separation), self.mean_gap(separation)
        least = SEEPING * h**3
        sealed = (found.along < least) | (found.across < least)
        return replace(
            found,
            along=np.maximum(found.along, least),
            across=np.maximum(found.across, least),
            cross=np.where(sealed, 0.0, found.cross),
            drag=np.maximum(found.drag, SEEPING * h),
        )
