"""The search for the place of a wall that moves freely, at each speed of a curve: a shaft in lobes, or a pad."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import nan
from typing import Self

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.equilibrium.balance import ORIGIN_DISTANCE
from roughfilm.rom.bearing.free.equilibrium import equilibrium, refined
from roughfilm.rom.bearing.free.film import FreeFilm, free_film
from roughfilm.rom.bearing.free.lay import lay_error
from roughfilm.rom.bearing.free.solve import ACROSS, COARSE_CELLS, approach, placed, stiffness_of
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.contact_load import asperity_load
from roughfilm.rom.bearing.mixed.film import MixedState, mixed_problem, mixed_state
from roughfilm.rom.bearing.mixed.search.lift_off import lift_off_speed
from roughfilm.rom.bearing.mixed.search.separation import Known, Slopes
from roughfilm.rom.bearing.scene import Bearing, BearingLoad
from roughfilm.rom.cavitation.motion.coupled import Instant
from roughfilm.rom.cavitation.problem import Problem


@dataclass(kw_only=True)
class PlaceSearch:
    """The search over the coordinates of a wall; the load has the direction of that of the scene.

    Attributes
    ----------
    scene : the bearing; its film, speed and the size of its load have no effect.
    asperities : flow factors and contact pressures.
    cells : number of cells along the film; across it there are half as many.
    residual : residual at which a film is solved.
    accuracy : relative error of the lift-off speed.
    film : film(scene), the problem of a film; None for that with the flow factors of the asperities.
    """

    scene: Bearing
    asperities: Asperities
    cells: int
    residual: float
    accuracy: float
    film: Callable[[Bearing], Problem] | None = None
    _near: dict[tuple[int, float], Instant] = field(default_factory=dict)

    @property
    def dip(self) -> float:
        """0: the geometry gives the separation."""
        return 0.0

    @cached_property
    def area(self) -> float:
        """The nominal area, m² (m if infinitely wide)."""
        return self.scene.nominal_area

    def _free(self, speed: float, pressure: float, cells: int) -> FreeFilm:
        load = self.scene.load
        kept = {} if load is None else {name: getattr(load, name) for name in ("angle", "moment_x", "moment_y")}
        loaded = BearingLoad.model_construct(pressure=pressure, **kept)
        scene = self.scene.at_speed(speed).model_copy(update={"load": loaded})
        problem = self.film or (lambda one: mixed_problem(one, self.asperities))
        contact = None if self.scene.asperities is None else self.asperities
        return free_film(scene, (cells, max(2, round(cells / ACROSS))), film=problem, contact=contact)

    def _settled(self, speed: float, pressure: float, cells: int) -> tuple[FreeFilm, Instant]:
        """The film in equilibrium, from that at the speed before, or from a coarser grid."""
        film = self._free(speed, pressure, cells)
        start = self._near.get((cells, pressure))
        if start is None and cells > COARSE_CELLS:
            try:
                start = refined(*self._settled(speed, pressure, max(cells // 2, COARSE_CELLS)), film)
            except (InputError, ConvergenceError):  # the coarser grid has no equilibrium
                start = None
        instant = equilibrium(film, start, tolerance=self.residual)
        self._near[cells, pressure] = instant
        return film, instant

    def solved(self, speed: float, pressure: float, _known: Known = ()) -> MixedState:
        """The film at a speed under a load, from the film at the speed before."""
        film, instant = self._settled(speed, pressure, self.cells)
        solution = film.solution(instant)
        contact = asperity_load(solution.problem.shape, solution.grid, self.asperities)
        return mixed_state(placed(film, instant), solution, contact)

    def again(self, speed: float, pressure: float, _separation: float) -> MixedState:
        """The film of a point, solved again."""
        return self.solved(speed, pressure)

    def slopes(self, speed: float, pressure: float, separation: float, _film_load: float) -> Slopes:
        """The slopes by the stiffness of film and contact, as a growing load moves the wall."""
        film, instant = self._settled(speed, pressure, self.cells)
        whole, contact = stiffness_of(film, instant), film.solved.contact_at(instant.place)
        moved, force = approach(film, instant, whole), -film.load / float(np.linalg.norm(film.load))
        by_contact = -float(force @ contact.stiffness @ moved)
        return Slopes(
            film=-float(force @ whole @ moved) - by_contact,
            contact=by_contact,
            length=separation - min(0.0, self.asperities.closest - ORIGIN_DISTANCE * self.asperities.touching),
            left_out=lay_error(film.solution(instant), even=film.solved.halved),
        )

    def lift_off(self, pressure: float, near: float) -> float:
        """The speed at which the separation under the load is that of first contact, m/s."""
        touching = self.asperities.touching
        if touching >= self.scene.geometry.widest:
            return nan

        def excess(speed: float) -> float:
            try:
                film, instant = self._settled(speed, pressure, self.cells)
            except InputError:  # no film carries the load at so low a speed
                return -1.0
            return placed(film, instant).geometry.thinnest / touching - 1

        return lift_off_speed(excess, near, tolerance=self.accuracy)

    def coarser(self) -> Self:
        """The films on a grid of half as many cells."""
        return replace(self, cells=self.cells // 2, _near={})

    def of(self, scene: Bearing) -> Self:
        """The films of a scene with another lubricant, whose search starts from those that were solved before."""
        return replace(self, scene=scene)

    def anew(self) -> Self:
        """The films of which none was solved before."""
        return replace(self, _near={})
