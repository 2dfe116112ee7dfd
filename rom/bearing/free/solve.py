"""The steady film of a bearing whose wall moves freely, on successively finer grids."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.equilibrium.estimate import CONTACT_FILM
from roughfilm.rom.bearing.free.equilibrium import equilibrium, refined
from roughfilm.rom.bearing.free.film import FreeFilm, free_film
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.pivoted import Pivoted, PivotedSector
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.fluid import ViscosityField
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.contact import ContactLaw
from roughfilm.rom.cavitation.motion.coupled import Drive, Instant, settled
from roughfilm.rom.cavitation.motion.past import held
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import FIRST_COARSENING, Level, Solution
from roughfilm.rom.ladder.model import Progress, silent

GRIDS = 4
"""Largest number of grids, the coarser ones for the uncertainty."""

LEAST_GRIDS = 3
"""Smallest number of grids: the values on two of them may agree by chance, and do not show an order."""

MIN_CELLS = 24
"""Smallest number of cells along the film of the grids beyond these."""

COARSEST_CELLS = 6
"""Smallest number of cells along the film of any coarser grid."""

ACROSS = 2
"""Cells along the film over those across it."""

RATE_AT_REST = 1e-6
"""Rate of a slow motion, 1/s, in place of a steady film at rest, whose cavities no flow determines."""

ECCENTRICITIES = ("eccentricity", "eccentricity_x", "eccentricity_y")
"""Quantities of the place of a shaft over the clearance."""

COARSE_CELLS = 48
"""Number of cells along the film on which the expected film is sought."""


@dataclass(frozen=True, kw_only=True)
class FreeSolution:
    """The steady film of a bearing on several grids.

    Attributes
    ----------
    films : the film on each grid, the finest first.
    instants : the film at its place on each grid.
    solved : cells and iterations of all solves.
    heated : the film over the whole width on each grid, with its temperatures; empty without temperatures.
    """

    films: tuple[FreeFilm, ...]
    instants: tuple[Instant, ...]
    solved: tuple[Level, ...]
    heated: tuple[Solution, ...] = ()

    @property
    def scenes(self) -> tuple[Bearing, ...]:
        """The scene with its wall where it is on each grid."""
        return tuple(placed(film, instant) for film, instant in zip(self.films, self.instants, strict=True))

    @property
    def solutions(self) -> tuple[Solution, ...]:
        """The film over the whole width on each grid."""
        return self.heated or tuple(
            film.solution(instant) for film, instant in zip(self.films, self.instants, strict=True)
        )

    @property
    def balance(self) -> float | None:
        """The relative net force on the wall on the finest grid; None where no coordinate is free."""
        return self.instants[0].force_residual if self.films[0].free.any() else None

    @property
    def apart(self) -> dict[str, float]:
        """The differences between the finest two grids of quantities of the place, from the motion of the whole wall.

        That of a single one, such as the least film or a coordinate, may be small by chance while the wall moves along
        the film. The least film is taken to change by the largest relative change of the film anywhere.
        """
        if len(self.films) < 2 or not self.films[0].free.any():
            return {}
        film, instant = self.films[0], self.instants[0]
        moved = self.instants[1].place - instant.place
        change = max(film.solved.closing(instant.place, sign * moved) for sign in (-1.0, 1.0))
        found = {"film_min": change * float(instant.faces.thickness.min())}
        if isinstance(film.scene.geometry, Lobes):
            shift, size = (float(np.hypot(*place[:2])) for place in (moved, instant.place))
            found |= dict.fromkeys(ECCENTRICITIES, shift / float(film.wall.unit[0]))
            turned = shift / size if size else math.inf
            found["attitude_angle"] = math.degrees(turned)
            if film.scene.geometry.lobes == 1 and not any(film.scene.geometry.misalignment):
                found |= {"film_min_angle": math.degrees(turned), "film_min_x": film.scene.geometry.radius * turned}
        return found


@dataclass(frozen=True, kw_only=True)
class PlacedFilm:
    """A film on a grid, at the place of its wall.

    Attributes
    ----------
    film : the film on its grid.
    instant : the film at the place of its wall.
    heated : the film over the whole width with its temperatures; None if they are not known.
    """

    film: FreeFilm
    instant: Instant
    heated: Solution | None = None

    @cached_property
    def solution(self) -> Solution:
        """The film over the whole width."""
        return self.film.solution(self.instant) if self.heated is None else self.heated


WithField = Callable[[ViscosityField | None, PlacedFilm | None], PlacedFilm]
"""at(viscosities, near), the film in equilibrium with viscosities, from one near it on the same grid."""


def placed(film: FreeFilm, instant: Instant) -> Bearing:
    """The scene with its wall at the coordinates of an instant."""
    assert isinstance(film.scene.geometry, MovingWall)
    return film.scene.moved(film.scene.geometry.at(instant.place))


def sizes(cells: int) -> list[tuple[int, int]]:
    """Cells along and across the film from the coarsest to the finest grid, which have few nodes in common."""
    along = [cells]
    while len(along) < GRIDS:
        coarser = 2 * round(FIRST_COARSENING * along[-1] / 2)
        if coarser < (COARSEST_CELLS if len(along) < LEAST_GRIDS else MIN_CELLS):
            break
        along.append(coarser)
    return [(size, max(2, round(size / ACROSS))) for size in reversed(along)]


def solve_free(
    scene: Bearing,
    cells: int,
    *,
    film: Callable[[Bearing], Problem] = Bearing.problem,
    ruptures: bool = True,
    contact: ContactLaw | None = None,
    tolerance: float,
    heated: Callable[[WithField], PlacedFilm] | None = None,
    progress: Progress = silent,
) -> FreeSolution:
    """Solve for the place of the wall at which the film carries the load of the scene, or the film at a given place.

    Grids that are too coarse for an equilibrium are left out. Quantities are second-order accurate in the cell size.

    Parameters
    ----------
    cells : number of cells along the film of the finest grid; across it there are half as many.
    film : film(scene), the problem that the model solves.
    ruptures : whether the film cavitates.
    contact : the contact pressure of the walls over the film thickness; None of walls that do not touch.
    tolerance : residual at which a film is solved.
    heated : heated(at), called on each grid: the film with the viscosities of its temperatures, from at(viscosities,
        near); None where viscosities do not depend on the film.

    Raises
    ------
    InputError
        If no film carries the load.
    ConvergenceError
        If the film or its equilibrium does not converge.
    """
    counts = sizes(cells)
    work = [float(nx) ** 2 for nx, _ in counts]
    films: list[FreeFilm] = []
    instants: list[Instant] = []
    solutions: list[Solution] = []
    solved: list[Level] = []
    for number, count in enumerate(counts):
        progress(sum(work[:number]) / sum(work), f"{count[0]} × {count[1]} cells")

        def at(
            viscosities: ViscosityField | None, near: PlacedFilm | None, count: tuple[int, int] = count
        ) -> PlacedFilm:
            varied = film if viscosities is None else lambda one: replace(film(one), viscosities=viscosities)
            one = free_film(scene, count, film=varied, ruptures=ruptures, contact=contact)
            start = near.instant if near else refined(films[-1], instants[-1], one) if films else None
            instant = equilibrium(one, start, tolerance=tolerance)
            return PlacedFilm(film=one, instant=instant)

        try:
            found = at(None, None) if heated is None else heated(at)
        except (InputError, ConvergenceError):
            if count == counts[-1]:
                raise
            films.clear()
            instants.clear()
            solutions.clear()
            continue
        one, instant = found.film, found.instant
        films.append(one)
        instants.append(instant)
        solutions += [] if found.heated is None else [found.heated]
        load = float((one.solved.grid.areas * instant.state.pressure).sum()) * one.solved.sides
        solved.append(Level(shape=one.whole.grid.shape, iterations=instant.iterations, load=load))
    return FreeSolution(
        films=tuple(films[::-1]),
        instants=tuple(instants[::-1]),
        solved=tuple(solved),
        heated=tuple(solutions[::-1]),
    )


def stiffness_of(film: FreeFilm, instant: Instant) -> Array:
    """The stiffness of film and contact; that of contact alone at rest, where no flow determines the cavities."""
    try:
        return coefficients(film.solved, instant, speed=film.solved.problem.speed).stiffness
    except ConvergenceError:
        return film.solved.contact_at(instant.place).stiffness


def approach(film: FreeFilm, instant: Instant, stiffness: Array) -> Array:
    """The change of the coordinates by a growing load that moves the wall by at most 1 m anywhere."""
    force = film.solved.force(instant.state.pressure) + film.solved.contact_at(instant.place).force
    moved = np.linalg.lstsq(stiffness, -force, rcond=None)[0]
    return np.asarray(moved / float(np.abs(film.solved.at_nodes @ moved).max()))


def closer(film: FreeFilm, instant: Instant, step: float, *, tolerance: float) -> Instant:
    """The film whose wall has moved by ``step``, m, in the direction in which a growing load moves it."""
    moved, count = step * approach(film, instant, stiffness_of(film, instant)), instant.place.size
    speed = film.solved.problem.speed
    slow = RATE_AT_REST, RATE_AT_REST * held(film.solved, instant)
    drive = Drive(
        speed=speed,
        force=np.zeros(count),
        stiffness=np.zeros((count, count)),
        free=np.zeros(count, dtype=bool),
        storage=(0.0, 0.0) if speed else slow,
    )
    return settled(film.solved, replace(instant, place=instant.place + moved), drive, tolerance=tolerance)


def expected_place(scene: Bearing) -> tuple[float, ...]:
    """The coordinates of the wall under the load of a scene, on a coarse grid and with smooth walls.

    Where asperities touch, the film is at least ``CONTACT_FILM`` times the rms height.
    """
    film, geometry = free_film(scene, (COARSE_CELLS, COARSE_CELLS // ACROSS)), scene.geometry
    assert isinstance(geometry, Lobes | Pivoted | PivotedSector)
    least = 0.0 if scene.asperities is None or scene.roughness is None else CONTACT_FILM * scene.roughness.rms
    try:
        place = equilibrium(film, None, tolerance=1e-8).place
    except (InputError, ConvergenceError):
        if not least:
            raise
        place = film.wall.place.copy()
        if isinstance(geometry, Lobes):
            place[:2] = geometry.clearance * film.load[:2] / np.hypot(*film.load[:2])
    there = geometry.at(place)
    if there.thinnest < least:
        place = there.at_film(min(least, geometry.widest)).wall.place[: place.size]
    return tuple(float(value) for value in place)
