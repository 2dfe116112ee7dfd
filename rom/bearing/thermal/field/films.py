"""The films of a bearing with their temperatures: given, under a load, and with a wall that moves freely."""

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from typing import Any

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.equilibrium.balance import SeparableBearing
from roughfilm.rom.bearing.equilibrium.films import FilmState, ModelFilms
from roughfilm.rom.bearing.free.solve import PlacedFilm, WithField
from roughfilm.rom.bearing.mixed.film import MixedFilm, MixedState, mixed_problem
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.field.coupling import FIELD_TOLERANCE, Coupled, Heated, Heating, coupled
from roughfilm.rom.bearing.thermal.field.nodal import in_scene, nodal_field, own_logarithms
from roughfilm.rom.cavitation.fluid import ViscosityField
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.solve import Solution, with_viscosities

AnyFilms = ModelFilms | MixedFilm
AnyState = FilmState | MixedState


@dataclass(frozen=True, kw_only=True)
class HeatedSolution(Solution):
    """A film with its temperatures.

    Attributes
    ----------
    heated : the temperatures.
    changes : largest difference of ln η between the viscosities of each film of the iteration and those of its
        temperatures.
    """

    heated: Any
    changes: tuple[float, ...]


def heated_solution(solution: Solution, found: Coupled[Any, Any]) -> HeatedSolution:
    """The film with the temperatures of an iteration."""
    own = {one.name: getattr(solution, one.name) for one in fields(Solution)}
    return HeatedSolution(**own, heated=found.heated, changes=found.changes)


@dataclass(kw_only=True)
class LastFilm:
    """The temperatures of the last film, from which the next iteration starts.

    Attributes
    ----------
    heated : temperatures; None before the first film.
    viscosities : viscosities in the coordinates of the scene; None where they are those of the scene.
    """

    heated: Heated | None = None
    viscosities: ViscosityField | None = None

    def keep(self, solution: HeatedSolution) -> None:
        """Keep the temperatures and viscosities of a film."""
        varies = solution.problem.at_nodes is not None
        self.heated = solution.heated
        self.viscosities = in_scene(solution, own_logarithms(solution)) if varies else None


@dataclass(frozen=True)
class _Film:
    solution: Solution


@dataclass(frozen=True, kw_only=True)
class HeatedFilms:
    """The films of a bearing at any film thickness and speed, with the viscosities of their temperatures.

    Attributes
    ----------
    isothermal : the films with the viscosity of the scene.
    heating : the energy equation.
    last : the last film, whose temperatures start the next one, on another grid too.
    tolerance : tolerance of the iteration of films and temperatures.
    """

    isothermal: AnyFilms
    heating: Heating[Any]
    last: LastFilm
    tolerance: float = FIELD_TOLERANCE

    @property
    def area(self) -> float:
        """The nominal area, m² (m if infinitely wide)."""
        return self.isothermal.area

    @property
    def closest(self) -> float:
        """The smallest film thickness that is tried, m."""
        return self.isothermal.closest

    @property
    def touching(self) -> float:
        """The film thickness at which a search begins, m."""
        return self.isothermal.touching

    @property
    def widest(self) -> float:
        """The largest film thickness, m."""
        return self.isothermal.widest

    @property
    def remedy(self) -> str:
        """The remedy for a load that is too large."""
        return self.isothermal.remedy

    def contact_load(self, film: float) -> float:
        """The load of the asperities at a film thickness, m, in N."""
        return self.isothermal.contact_load(film)

    def at(self, film: float, speed: float, start: State | None = None) -> AnyState:
        """Solve the film at a minimum thickness, m, and a speed, m/s, starting from the state of another film."""
        first = _with_viscosities(self.isothermal, self.last.viscosities).at(film, speed, start)
        films = self.isothermal
        solution = heated_film(
            first.solution,
            self.heating,
            near=self.last.heated,
            residual=films.residual,
            ruptures=films.ruptures if isinstance(films, ModelFilms) else True,
            tolerance=self.tolerance,
        )
        self.last.keep(solution)
        return self.isothermal.state(first.scene, solution)


def _with_viscosities(films: AnyFilms, viscosities: ViscosityField | None) -> AnyFilms:
    """The films with other viscosities than those of their scene."""
    if viscosities is None:
        return films
    if isinstance(films, ModelFilms):
        plain = films.film
    else:
        asperities = films.asperities
        plain = films.film or (lambda scene: mixed_problem(scene, asperities))
    return replace(films, film=lambda scene: replace(plain(scene), viscosities=viscosities))


def heated_film(
    solution: Solution, heating: Heating[Any], *, near: Heated | None, residual: float, ruptures: bool, tolerance: float
) -> HeatedSolution:
    """The film of a solution with the viscosities of its temperatures.

    Parameters
    ----------
    near : temperatures of a film near this one.
    residual : residual at which a film is solved.
    ruptures : whether the film cavitates.
    tolerance : tolerance of the iteration of films and temperatures.

    Raises
    ------
    ConvergenceError
        If a film or its temperatures do not converge.
    """

    def again(film: _Film, values: Array) -> _Film:
        varied = nodal_field(film.solution, values)
        return _Film(with_viscosities(film.solution, varied, tolerance=residual, ruptures=ruptures))

    found = coupled(_Film(solution), again, heating, near=near, tolerance=tolerance)
    return heated_solution(found.film.solution, found)


@dataclass(frozen=True, kw_only=True)
class HeatedBearing:
    """The coupling of the films of one scene with their temperatures.

    Attributes
    ----------
    heating : the energy equation of the scene.
    last : the last film.
    tolerance : tolerance of the iteration of films and temperatures.
    """

    heating: Heating[Any]
    last: LastFilm = field(default_factory=LastFilm)
    tolerance: float = FIELD_TOLERANCE

    def film(self, *, tolerance: float, ruptures: bool) -> Callable[[Solution], Solution]:
        """heated(solution), the film on a grid with the viscosities of its temperatures.

        Parameters
        ----------
        tolerance : residual at which a film is solved.
        ruptures : whether the film cavitates.
        """

        def heated(solution: Solution) -> Solution:
            found = heated_film(
                solution,
                self.heating,
                near=self.last.heated,
                residual=tolerance,
                ruptures=ruptures,
                tolerance=self.tolerance,
            )
            self.last.keep(found)
            return found

        return heated

    def films(
        self, isothermal: Callable[[Bearing, int], SeparableBearing[Any]]
    ) -> Callable[[Bearing, int], SeparableBearing[Any]]:
        """films(scene, cells), the films among which that under a load is sought.

        Parameters
        ----------
        isothermal : the same films with the viscosity of the scene.
        """

        def films(scene: Bearing, cells: int) -> HeatedFilms:
            plain = isothermal(scene, cells)
            assert isinstance(plain, AnyFilms)
            return HeatedFilms(isothermal=plain, heating=self.heating, last=self.last, tolerance=self.tolerance)

        return films

    def placed(self) -> Callable[[WithField], PlacedFilm]:
        """heated(at), the film of a wall that moves freely on a grid, with the viscosities of its temperatures."""

        def heated(at: WithField) -> PlacedFilm:
            def again(film: PlacedFilm, values: Array) -> PlacedFilm:
                return at(in_scene(film.solution, values), film)

            found = coupled(
                at(self.last.viscosities, None), again, self.heating, near=self.last.heated, tolerance=self.tolerance
            )
            solution = heated_solution(found.film.solution, found)
            self.last.keep(solution)
            return replace(found.film, heated=solution)

        return heated
