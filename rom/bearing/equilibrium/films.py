"""The films of a model at any film thickness and speed, and the loads that they carry."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from roughfilm.rom.bearing.quantities import load_of, scene_positions
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.cavitation.solve import Solution, solve


@dataclass(frozen=True, kw_only=True)
class FilmState:
    """A converged film.

    Attributes
    ----------
    scene : the scene at the film thickness and speed.
    solution : the film.
    load : its load, N (N/m if infinitely wide).
    """

    scene: Bearing
    solution: Solution
    load: float


@dataclass(frozen=True, kw_only=True)
class ModelFilms:
    """The films of a model without asperities.

    Attributes
    ----------
    scene : the bearing; its film thickness and speed have no effect.
    film : film(scene), the problem that the model solves.
    ruptures : whether the film cavitates.
    cells : number of cells along and across.
    closest : the smallest film thickness that is tried, m.
    touching : the film thickness at which a search begins, m.
    residual : residual at which a film solve stops.
    """

    scene: Bearing
    film: Callable[[Bearing], Problem]
    ruptures: bool
    cells: int
    closest: float
    touching: float
    residual: float = RESIDUAL_TOLERANCE

    @property
    def widest(self) -> float:
        """The largest film thickness, m."""
        return self.scene.geometry.widest

    @cached_property
    def area(self) -> float:
        """The nominal area, m² (m if the model is infinitely wide)."""
        wide = self.film(self.scene.at_film(self.touching)).shape.wide
        return self.scene.nominal_area / ((self.scene.geometry.width or 1.0) if wide else 1.0)

    @property
    def remedy(self) -> str:
        """The remedy for a load that is too large."""
        if self.scene.supply:
            return "lower the load, or raise the pressures of the supplies"
        if self.scene.roughness is None:
            return "lower the load, or raise the speed or the viscosity"
        return "lower the load, or take the model mixed with [asperities], whose walls may touch"

    def contact_load(self, _film: float) -> float:
        """0, because no part of the load is known without solving a film."""
        return 0.0

    def at(self, film: float, speed: float, start: State | None = None) -> FilmState:
        """Solve the film at a minimum thickness, m, and a speed, m/s, starting from the state of another film."""
        scene, cells = self.scene.at_speed(speed).at_film(film), (self.cells, self.cells)
        solution = solve(self.film(scene), cells, start=start, tolerance=self.residual, ruptures=self.ruptures)
        force = solution.grid.areas * (solution.state.pressure + scene.lubricant.cavitation_pressure)
        return FilmState(scene=scene, solution=solution, load=load_of(scene, scene_positions(solution), force))
