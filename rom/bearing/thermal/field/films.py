"""The films of a bearing with their temperatures: given, under a load, and with a wall that moves freely."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.equilibrium.balance import SeparableBearing
from roughfilm.rom.bearing.equilibrium.films import FilmState, ModelFilms
from roughfilm.rom.bearing.equilibrium.grids import Search
from roughfilm.rom.bearing.free.solve import PlacedFilm, WithField
from roughfilm.rom.bearing.mixed.film import RESIDUAL_FRACTION, MixedFilm, MixedState, mixed_problem
from roughfilm.rom.bearing.thermal.field.coupling import (
    CARRIED,
    FIELD_TOLERANCE,
    FIRST_ERROR,
    Again,
    Coupled,
    FilmT,
    Heated,
    Heating,
    contraction,
    coupled,
)
from roughfilm.rom.bearing.thermal.field.nodal import in_scene, nodal_field, own_logarithms
from roughfilm.rom.cavitation.fluid import ViscosityField
from roughfilm.rom.cavitation.solve import Solution, with_viscosities

AnyFilms = ModelFilms | MixedFilm
AnyState = FilmState | MixedState


@dataclass(frozen=True, kw_only=True)
class HeatedSolution(Solution):
    """A film with its temperatures.

    Attributes
    ----------
    heated : the temperatures.
    changes : root mean square of the difference of ln η between the viscosities of each film of the iteration and
        those of its temperatures.
    largest : largest difference of the last film at a node.
    """

    heated: Any
    changes: tuple[float, ...]
    largest: float

    @property
    def contraction(self) -> float:
        """Mean ratio of successive changes; 0 if no film was solved again."""
        return contraction(self.changes)


def heated_solution(solution: Solution, found: Coupled[Any, Any]) -> HeatedSolution:
    """The film with the temperatures of an iteration."""
    own = {one.name: getattr(solution, one.name) for one in fields(Solution)}
    return HeatedSolution(**own, heated=found.heated, changes=found.changes, largest=found.largest)


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


def growth(solution: Solution, values: Array) -> float:
    """The factor by which the load of a film grows with other viscosities, ln η_p first, shape (3, nx, ny).

    Viscosities that change by one factor change the pressure by it; others are weighted by the pressure.
    """
    weights = solution.grid.areas * np.maximum(solution.state.pressure, 0.0)
    total = float(weights.sum())
    change = float((weights * (values[0] - own_logarithms(solution)[0])).sum()) / total if total > 0 else 0.0
    return math.exp(change)


@dataclass(frozen=True)
class _Film:
    solution: Solution


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


def _with_residual(films: AnyFilms, error: float) -> AnyFilms:
    """The films with a residual that is small enough for a relative error of their load."""
    if isinstance(films, ModelFilms):
        return replace(films, residual=max(films.residual, RESIDUAL_FRACTION * error / films.cells))
    return replace(films, accuracy=max(films.accuracy, error))


@dataclass(frozen=True, kw_only=True)
class HeatedBearing:
    """The coupling of the films of one scene with their temperatures.

    Attributes
    ----------
    heating : the energy equation of the scene.
    tolerance : tolerance of the iteration of films and temperatures.
    last : the last film.
    """

    heating: Heating[Any]
    tolerance: float = FIELD_TOLERANCE
    last: LastFilm = field(default_factory=LastFilm)

    def film(self, *, tolerance: float, ruptures: bool) -> Callable[[Solution], Solution]:
        """heated(solution), the film on a grid with the viscosities of its temperatures.

        Parameters
        ----------
        tolerance : residual at which a film is solved.
        ruptures : whether the film cavitates.
        """

        def heated(solution: Solution) -> Solution:
            def again(film: _Film, values: Array, _error: float) -> _Film:
                varied = nodal_field(film.solution, values)
                return _Film(with_viscosities(film.solution, varied, tolerance=tolerance, ruptures=ruptures))

            return self._coupled(_Film(solution), again)[1]

        return heated

    def loaded(self) -> Callable[[SeparableBearing[Any], Search[Any]], Any]:
        """heated(films, search), the film of a grid that carries a load with the viscosities of its temperatures.

        The load is sought among films with given viscosities, and the viscosities are those of the film that was found.
        A load that is small against what the residual of a film changes is sought again with its smallest residual.
        """

        def heated(films: SeparableBearing[Any], search: Search[Any]) -> AnyState:
            assert isinstance(films, AnyFilms)

            def carrying(
                near: AnyState | None, viscosities: ViscosityField | None, error: float, growth: float = 1.0
            ) -> AnyState:
                varied = _with_viscosities(films, viscosities)
                try:
                    rough: AnyState = search(_with_residual(varied, error), near, error=error, growth=growth)
                except (InputError, ConvergenceError):
                    if error == 0:
                        raise
                else:
                    return rough
                exact: AnyState = search(varied, near, growth=growth)
                return exact

            def again(near: AnyState, values: Array, error: float) -> AnyState:
                return carrying(near, in_scene(near.solution, values), error, growth(near.solution, values))

            error = 0.0 if self.last.heated is None else FIRST_ERROR
            first = carrying(None, self.last.viscosities, error)
            film, solution = self._coupled(first, again, error, CARRIED)
            loaded: AnyState = replace(film, solution=solution)
            return loaded

        return heated

    def placed(self) -> Callable[[WithField], PlacedFilm]:
        """heated(at), the film of a wall that moves freely on a grid, with the viscosities of its temperatures.

        Those of a film of which half of the width is solved are the same in both halves: differences of the tolerance
        would leave out the other half, and grow.
        """

        def heated(at: WithField) -> PlacedFilm:
            def again(film: PlacedFilm, values: Array, _error: float) -> PlacedFilm:
                even = (values + values[..., ::-1]) / 2 if film.film.solved.halved else values
                return at(in_scene(film.solution, even), film)

            film, solution = self._coupled(at(self.last.viscosities, None), again)
            return replace(film, heated=solution)

        return heated

    def _coupled(
        self, first: FilmT, again: Again[FilmT], error: float = 0.0, carried: float = 0.0
    ) -> tuple[FilmT, HeatedSolution]:
        """The film that agrees with its temperatures, from a first one, and its solution with the temperatures."""
        near, tolerance = self.last.heated, self.tolerance
        found = coupled(first, again, self.heating, near=near, tolerance=tolerance, error=error, carried=carried)
        solution = heated_solution(found.film.solution, found)
        self.last.keep(solution)
        return found.film, solution
