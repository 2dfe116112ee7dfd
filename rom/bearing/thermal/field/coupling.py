"""The film and the temperatures that agree with each other: a fixed point of viscosities."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.thermal.field.nodal import logarithms, own_logarithms
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.solve import Solution

FIELD_TOLERANCE = 1e-6
"""Largest change of ln η from the film to its temperatures at which the iteration stops."""

MAX_FILMS = 60
"""Largest number of films in one iteration; three to eight are usual."""

REMEMBERED = 3
"""Number of earlier iterations from which the next viscosities are extrapolated."""

MAX_GROWTH = 2.0
"""Ratio of a change of ln η to the one before from which on the extrapolation begins anew."""

MAX_STEP = 1.0
"""Largest change of ln η in one iteration."""

HOTTEST = 773.15
"""Temperature above which no lubricant stays liquid, K: the iteration ends as a thermal runaway."""

RUNAWAY = "lower the speed, the load or the viscosity, or cool the film by more supplied lubricant or its walls"
"""Remedy of a thermal runaway."""


class Heated(Protocol):
    """The temperatures of a film, as the energy equation gives them for its flows."""

    @property
    def temperature(self) -> Array:
        """Mean temperature across the film at the nodes, K, shape (nx, ny)."""
        ...

    @property
    def viscosities(self) -> Viscosities:
        """Viscosities at these temperatures at the nodes, each of shape (nx, ny)."""
        ...

    @property
    def residual(self) -> float:
        """Largest error of the energy balance of a node over the largest heat flow."""
        ...


class Film(Protocol):
    """A film of a bearing with its solution."""

    @property
    def solution(self) -> Solution:
        """The solution of the Reynolds equation."""
        ...


FilmT = TypeVar("FilmT", bound=Film)
HeatedT = TypeVar("HeatedT", bound=Heated)

Heating = Callable[[Solution, Any], HeatedT]
"""heating(solution, near): the temperatures of a film, from those of a film near it, which may be on another grid."""


@dataclass(frozen=True, kw_only=True)
class Coupled(Generic[FilmT, HeatedT]):
    """A film and its temperatures.

    Attributes
    ----------
    film : the film.
    heated : its temperatures.
    changes : largest difference of ln η between the viscosities of each film and those of its temperatures.
    """

    film: FilmT
    heated: HeatedT
    changes: tuple[float, ...]

    @property
    def contraction(self) -> float:
        """Mean ratio of successive changes; 0 if no film was solved again."""
        first, last, count = self.changes[0], self.changes[-1], len(self.changes) - 1
        return float((last / first) ** (1 / count)) if count and last > 0 else 0.0


def coupled(
    film: FilmT,
    again: Callable[[FilmT, Array], FilmT],
    heating: Heating[HeatedT],
    *,
    near: HeatedT | None = None,
    tolerance: float = FIELD_TOLERANCE,
) -> Coupled[FilmT, HeatedT]:
    """Solve for the film whose viscosities are those of its own temperatures.

    A film with the viscosities x, in the form (ln η_p, ln η_s, s) at its nodes, has temperatures with the viscosities
    g(x). The energy equation is solved with the viscosity of its own temperature, so that g depends on x by the flows
    alone; in bearings g contracts to about 0.1 to 0.4 of a difference. The next x is that of Anderson's method, the
    combination of ``REMEMBERED`` earlier films with the least difference g(x) - x, or g(x) itself where that grows.

    Parameters
    ----------
    film : a film, from whose viscosities the iteration starts.
    again : again(film, x), the film with other viscosities from the state of another one.
    heating : heating(solution, near), the temperatures of a film.
    near : temperatures of a film near this one.
    tolerance : largest component of g(x) - x at which the iteration stops.

    Raises
    ------
    ConvergenceError
        If the temperatures run away, or the iteration does not converge.

    Source: Anderson 1965, doi:10.1145/321296.321305; Walker and Ni 2011, doi:10.1137/10078356X.
    """
    memory, changes, hottest = Memory(), [], []
    heated = near
    for _ in range(MAX_FILMS):
        solution = film.solution
        heated = heating(solution, heated)
        used, following = own_logarithms(solution), logarithms(heated.viscosities)
        changes.append(float(np.abs(following - used).max()))
        hottest.append(float(heated.temperature.max()))
        if not hottest[-1] <= HOTTEST:
            raise ConvergenceError(_runaway(hottest), outcome=Outcome.DIVERGED, iterations=len(changes))
        if changes[-1] <= tolerance:
            return Coupled(film=film, heated=heated, changes=tuple(changes))
        film = again(film, memory.following(used, following, solution.grid.areas))
    raise ConvergenceError(
        f"temperature: the viscosity of the film and that at its temperatures differ by {changes[-1]:.1e} after "
        f"{MAX_FILMS} films, above the tolerance of {tolerance:.1e}; take more cells, or {RUNAWAY}",
        outcome=Outcome.STALLED,
        iterations=MAX_FILMS,
    )


def _runaway(hottest: list[float]) -> str:
    first, last = hottest[0] - ZERO_CELSIUS, hottest[-1] - ZERO_CELSIUS
    grew = f"grew from {first:.4g} to {last:.4g} degC" if len(hottest) > 1 else f"is {last:.4g} degC"
    return (
        f"temperature: thermal runaway, the greatest temperature of the film {grew}, above "
        f"{HOTTEST - ZERO_CELSIUS:.4g} degC, where no lubricant is liquid; {RUNAWAY}"
    )


@dataclass(kw_only=True)
class Memory:
    """The last iterations of a fixed point x = g(x), x and g of shape (3, nx, ny)."""

    points: list[Array] = field(default_factory=list)
    images: list[Array] = field(default_factory=list)

    def following(self, point: Array, image: Array, weights: Array) -> Array:
        """The next point by Anderson's method; ``weights``, shape (nx, ny), are those of the squares."""
        if self.points and _size(image - point) > MAX_GROWTH * _size(self.images[-1] - self.points[-1]):
            self.points.clear()
            self.images.clear()
        self.points = [*self.points[-REMEMBERED:], point]
        self.images = [*self.images[-REMEMBERED:], image]
        rest = image - point
        if len(self.points) == 1:
            return _limited(point, image)
        rests = [one - other for one, other in zip(self.images[:-1], self.points[:-1], strict=True)]
        differences = np.stack([rest - other for other in rests])
        weighted = differences * weights
        normal = np.tensordot(weighted, differences, axes=((1, 2, 3), (1, 2, 3)))
        wanted = np.tensordot(weighted, rest, axes=((1, 2, 3), (0, 1, 2)))
        shares = np.linalg.lstsq(normal, wanted, rcond=1e-12)[0]
        moved = np.stack([image - other for other in self.images[:-1]])
        return _limited(point, image - np.tensordot(shares, moved, axes=1))


def _size(rest: Array) -> float:
    return float(np.abs(rest).max())


def _limited(point: Array, following: Array) -> Array:
    """The next point, at most ``MAX_STEP`` away."""
    step = following - point
    return np.asarray(point + step * min(1.0, MAX_STEP / (_size(step) or 1.0)))
