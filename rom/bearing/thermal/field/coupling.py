"""The film and the temperatures that agree with each other: a fixed point of viscosities."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Generic, Protocol, TypeVar

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.rom.bearing.thermal.field.heated import Mixture
from roughfilm.rom.bearing.thermal.field.nodal import logarithms, own_logarithms
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.lubricants.thermal.law import celsius
from roughfilm.rom.temperature.anderson import AndersonAcceleration

FIELD_TOLERANCE = 2e-5
"""Root mean square over the film of the difference of ln η between a film and its temperatures, at which it stops."""

LARGEST_OVER_MEAN = 50.0
"""Largest difference at a node over this root mean square up to which the iteration stops.

Slopes of the temperature are limited at extrema and fronts, where a node may vary by up to 1e-3 between iterations.
"""

ACCEPTED, FALL = ((6, 1e-3), (20, 1e-2)), 0.5
"""Differences that are accepted, and stated, if in so many films they have not fallen to this part of the least before.

The larger one is met where the pressure jumps at a corner, or lubricant circulates, so that its direction changes with
every film at a few nodes.
"""

CARRIED = 0.2
"""Relative error of the load of a film that changes further, over the expected difference of its ln η."""

FIRST_ERROR, FIRST_FALL = 0.01, 0.3
"""That error for the first film of a finer grid; and the expected fall of the difference from the first film on."""

SOFTER_AT_INLET = 0.03
"""Change of ln η by 1 K, 1/K, by which errors of the temperature at the inlet count as those of ln η."""

MAX_FILMS = 60
"""Largest number of films in one iteration; three to eight are usual."""

REMEMBERED = 6
"""Number of earlier iterations from which the next viscosities, and the temperature at the inlet, are extrapolated."""

SAMPLES = 64
"""Number of nodes along each direction at least that count in the least squares of Anderson's method."""

HOTTEST = 773.15
"""Temperature above which no lubricant stays liquid, K: the iteration ends as a thermal runaway."""

MAX_HALVINGS = 4
"""Largest number of times that a step to a film that does not exist is halved."""

RUNAWAY = (
    "lower the speed, the load or the viscosity, supply more or colder lubricant, or take the model across with walls "
    "that take heat, table [heat]"
)
"""Remedy of a thermal runaway."""


SOFTENING = np.array([2.0, 2.0, 0.0])[:, None, None]
"""Steps of ln η_p, ln η_s and s by which a film is made less viscous if it has no temperatures."""

SOFTER_FILMS = 6
"""Largest number of these steps."""


class Heated(Protocol):
    """The temperatures of a film, as the energy equation gives them for its flows; a dataclass."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    @property
    def temperature(self) -> Array:
        """Mean temperature across the film at the nodes, K, shape (nx, ny)."""
        ...

    @property
    def viscosities(self) -> Viscosities:
        """Viscosities at these temperatures at the nodes, each of shape (nx, ny)."""
        ...

    @property
    def settled(self) -> bool:
        """Whether they meet the tolerance of the energy equation; further steps for the same film do if not."""
        ...

    @property
    def inlet(self) -> Mixture | None:
        """The mixture at the inlet; None without hot lubricant that enters again."""
        ...


class Film(Protocol):
    """A film of a bearing with its solution."""

    @property
    def solution(self) -> Solution:
        """The solution of the Reynolds equation."""
        ...


FilmT = TypeVar("FilmT", bound=Film)

Again = Callable[[FilmT, Array, float], FilmT]
"""again(film, x, error), the film with viscosities x from another one, with this relative error of its load or that of
its tolerance if larger."""
HeatedT = TypeVar("HeatedT", bound=Heated)

Heating = Callable[[Solution, Any], HeatedT]
"""heating(solution, near): the temperatures of a film, from those of a film near it, which may be on another grid."""


@dataclass(frozen=True)
class Point:
    """A point of the iteration.

    Attributes
    ----------
    fields : ln η_p, ln η_s and s at the nodes, shape (3, nx, ny).
    inlet : temperature at the inlet, K; None without hot lubricant that enters again.
    """

    fields: Array
    inlet: float | None = None


@dataclass(frozen=True, kw_only=True)
class Coupled(Generic[FilmT, HeatedT]):
    """A film and its temperatures.

    Attributes
    ----------
    film : the film.
    heated : its temperatures.
    changes : root mean square of the difference of ln η between the viscosities of each film and those of its
        temperatures.
    largest : largest difference of the last film at a node.
    """

    film: FilmT
    heated: HeatedT
    changes: tuple[float, ...]
    largest: float


def coupled(
    film: FilmT,
    again: Again[FilmT],
    heating: Heating[HeatedT],
    *,
    near: HeatedT | None = None,
    tolerance: float = FIELD_TOLERANCE,
    error: float = 0.0,
    carried: float = 0.0,
) -> Coupled[FilmT, HeatedT]:
    """Solve for the film whose viscosities are those of its own temperatures.

    A film with the viscosities x, in the form (ln η_p, ln η_s, s) at its nodes, has temperatures with the viscosities
    g(x). The energy equation is solved with the viscosity of its own temperature, so that g depends on x by the flows
    alone, and a change of all viscosities by one factor does not change it; a change δF/F of the flows changes g by
    less than that (:func:`roughfilm.rom.temperature.mean.mean_temperature`). Measured contractions are 0.01 to 0.1 in
    pads and 0.05 to 0.6 in journal bearings, up to an eccentricity of 0.95. The next x is that of Anderson's method,
    the combination of ``REMEMBERED`` earlier films with the least difference g(x) - x, or g(x) itself where the
    combination is farther from it than x is. The temperature at the inlet is one more unknown of it, whose g is the
    mixture of new and returning lubricant. Under a load the film of each x carries it to the part ``carried`` of the
    expected difference g(x) - x, and the last film to the tolerance of the search.

    Parameters
    ----------
    film : a film, from whose viscosities the iteration starts.
    again : again(film, x, error), the film with other viscosities from the state of another one.
    heating : heating(solution, near), the temperatures of a film.
    near : temperatures of a film near this one.
    tolerance : root mean square of g(x) - x over the film at which the iteration stops.
    error : relative error of the load of the first film; 0 if it meets the tolerance of its search.
    carried : relative error of the load of a film that changes further, over the expected difference of its ln η; 0 if
        all films meet the tolerance.

    Raises
    ------
    ConvergenceError
        If the temperatures run away, or the iteration does not converge.

    Source: Anderson 1965, doi:10.1145/321296.321305; Walker and Ni 2011, doi:10.1137/10078356X.
    """
    memory = AndersonAcceleration(remembered=REMEMBERED)
    changes: list[float] = []
    hottest: list[float] = []
    film, heated = _with_temperatures(film, again, heating, near)
    for _ in range(MAX_FILMS):
        used, following = own_logarithms(film.solution), logarithms(heated.viscosities)
        areas, rest = film.solution.grid.areas, following - used
        changes.append(_mean_size(rest, areas))
        hottest.append(float(heated.temperature.max()))
        if not hottest[-1] <= HOTTEST:
            raise _runaway(hottest)
        small = changes[-1] <= tolerance and _size(rest) <= LARGEST_OVER_MEAN * tolerance
        if (small or _stalls(changes)) and heated.settled:
            if error == 0:
                return Coupled(film=film, heated=heated, changes=tuple(changes), largest=_size(rest))
            error = 0.0
            film = again(film, used, error)
            heated = heating(film.solution, heated)
            continue
        if small:
            heated = heating(film.solution, heated)
            continue
        error = carried * _expected(changes, tolerance)
        point, image = _at_inlet(used, following, heated.inlet)
        step = point, _following(memory, point, image, areas)
        film, heated = _stepped(film, heated, again, heating, step, error, hottest)
    raise ConvergenceError(
        f"temperature: the viscosity of the film and that at its temperatures differ by {changes[-1]:.1e} after "
        f"{MAX_FILMS} films, above the tolerance of {tolerance:.1e}; take more cells, or {RUNAWAY}",
        outcome=Outcome.STALLED,
        iterations=MAX_FILMS,
    )


def _expected(changes: Sequence[float], tolerance: float) -> float:
    """The expected difference of the next film; 0 if it is expected to be the last one."""
    fall = min(changes[-1] / changes[-2], 1.0) if len(changes) > 1 and changes[-2] > 0 else FIRST_FALL
    expected = fall * changes[-1]
    return expected if expected > tolerance else 0.0


def _at_inlet(used: Array, following: Array, inlet: Mixture | None) -> tuple[Point, Point]:
    """A point of the iteration and its image."""
    if inlet is None:
        return Point(used), Point(following)
    if inlet.response is not None:
        following = following + (inlet.following - inlet.temperature) * inlet.response
    return Point(used, inlet.temperature), Point(following, inlet.following)


def _stepped(
    film: FilmT,
    heated: HeatedT,
    again: Again[FilmT],
    heating: Heating[HeatedT],
    step: tuple[Point, Point],
    error: float,
    hottest: Sequence[float],
) -> tuple[FilmT, HeatedT]:
    """The film with the next viscosities and its temperatures; with a part of the step where there is no such film.

    Under a load a step from a cold film may go beyond the solution, so that no film carries the load, or the
    friction of asperities is too large.

    Parameters
    ----------
    step : the last point and the next one.
    error : relative error of the load of the film.
    hottest : largest temperatures of the films before, K.
    """
    last, following = step
    for halvings in range(MAX_HALVINGS + 1):
        part = 1 / 2**halvings
        near = heated
        if heated.inlet is not None and following.inlet is not None and last.inlet is not None:
            entering = last.inlet + part * (following.inlet - last.inlet)
            near = replace(heated, inlet=replace(heated.inlet, temperature=entering, error=0.0))
        try:
            found = again(film, last.fields + part * (following.fields - last.fields), error)
            temperatures = heating(found.solution, near)
        except (InputError, ConvergenceError):
            if halvings == MAX_HALVINGS:
                raise
            continue
        if float(temperatures.temperature.max()) <= HOTTEST:
            return found, temperatures
    raise _runaway([*hottest, float(temperatures.temperature.max())])


def _with_temperatures(
    film: FilmT, again: Again[FilmT], heating: Heating[HeatedT], near: HeatedT | None
) -> tuple[FilmT, HeatedT]:
    """The first film and its temperatures, of less viscosity where too little lubricant flows for any temperature.

    The flow that the pressure of a supply or a side drives grows as the viscosity falls, so that it may carry the heat
    of a warm film where it does not carry that of a cold one.
    """
    first = None
    for _ in range(SOFTER_FILMS + 1):
        try:
            return film, heating(film.solution, near)
        except ConvergenceError as error:
            first = first or error
            film = again(film, own_logarithms(film.solution) - SOFTENING, 0.0)
    assert first is not None
    raise first


def _stalls(changes: Sequence[float]) -> bool:
    """Whether differences are small and no longer fall, as where slopes of the temperature are limited."""
    return any(
        len(changes) > films and changes[-1] <= accepted and min(changes[-films:]) > FALL * min(changes[:-films])
        for films, accepted in ACCEPTED
    )


def contraction(changes: Sequence[float]) -> float:
    """The mean ratio of successive differences of an iteration; 0 if there is one alone."""
    first, last, count = changes[0], changes[-1], len(changes) - 1
    return float((last / first) ** (1 / count)) if count and last > 0 else 0.0


def _runaway(hottest: Sequence[float]) -> ConvergenceError:
    """The answer that temperatures run away."""
    last = celsius(hottest[-1])
    grew = f"grew from {celsius(hottest[0])} to {last}" if len(hottest) > 1 else f"is {last}"
    return ConvergenceError(
        f"temperature: thermal runaway, the greatest temperature of the film {grew}, above "
        f"{celsius(HOTTEST)}, where no lubricant is liquid; {RUNAWAY}",
        outcome=Outcome.DIVERGED,
        iterations=len(hottest),
    )


def _following(memory: AndersonAcceleration, point: Point, image: Point, areas: Array) -> Point:
    """The next point of the iteration, by Anderson's method or, where that is farther away than the last, the image."""
    rest = image.fields - point.fields
    entered = 0.0 if point.inlet is None or image.inlet is None else image.inlet - point.inlet
    found = memory.following(_weighted(rest, entered, areas), np.append(image.fields, image.inlet or 0.0))
    fields = found[:-1].reshape(rest.shape)
    if _size(fields - image.fields) > _size(rest):
        return image
    return Point(fields, None if image.inlet is None else float(found[-1]))


def _weighted(rest: Array, entered: float, areas: Array) -> Array:
    """The differences of some nodes and of the inlet, whose sum of squares is weighted by the areas."""
    some = tuple(slice(None, None, max(1, count // SAMPLES)) for count in areas.shape)
    weights = np.sqrt(areas[some] / areas[some].sum())
    return np.append(rest[:, *some] * weights, SOFTER_AT_INLET * entered)


def _mean_size(rest: Array, areas: Array) -> float:
    """The largest root mean square over the film of the three components."""
    return float(np.sqrt(((areas * rest * rest).sum(axis=(1, 2)) / areas.sum()).max()))


def _size(rest: Array) -> float:
    return float(np.abs(rest).max())
