"""The film under a load on successively finer grids, each of which starts the search on the next."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.equilibrium.balance import FilmsAtSpeed, SeparableBearing, expected, robustly_balanced
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.interpolation import carried
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.solve import Level, Solution, coarsening
from roughfilm.rom.ladder.model import Progress, silent

LOAD_TOLERANCE = 1e-7
"""Relative error of the load at which the search stops."""

FILM_RESIDUAL = 1e-11
"""Residual at which a film solve stops."""

GRIDS = 4
"""Largest number of grids, the coarser ones for the uncertainty."""

MIN_GRID_CELLS = 16
"""Smallest number of cells along a side of a coarser grid."""

FILM_STEP = 1e-3
"""Relative change of the film thickness over which derivatives are taken."""

ORDER = 2
"""Order at which the film thickness is extrapolated to the next grid."""

PRESCRIBED = ("load", "load_per_width", "specific_load")
"""Quantities that the load prescribes."""

OF_THE_WALLS = ("film", "film_min", "film_min_x", "film_min_y", "eccentricity")
"""Quantities that follow from the film thickness alone."""

LOAD_RATIOS = {"friction_coefficient": "friction_per_width", "contact_share": "contact_load_per_width"}
"""Quantities over the load, by the quantity in their numerator."""


class BearingState(Protocol):
    """A converged film with its load and its scene."""

    @property
    def scene(self) -> Bearing:
        """The scene at the film thickness and speed."""
        ...

    @property
    def load(self) -> float:
        """The load of film and asperities, N (N/m if infinitely wide)."""
        ...

    @property
    def solution(self) -> Solution:
        """The film, whose state can start the next film."""
        ...


StateT = TypeVar("StateT", bound=BearingState)


class Search(Protocol[StateT]):
    """The search for the film that carries the load on a grid."""

    def __call__(
        self, among: SeparableBearing[StateT], near: StateT | None, *, error: float = 0.0, growth: float = 1.0
    ) -> StateT:
        """Search for the film among some that carries the load.

        Parameters
        ----------
        among : the films.
        near : a film near it on the same grid; None for the start from the grids before.
        error : relative error of the load at which the search stops, if it is larger than its tolerance.
        growth : expected load of the film at the separation of ``near`` over that of ``near``.
        """
        ...


@dataclass(frozen=True, kw_only=True)
class Equilibrium(Generic[StateT]):
    """The film under a load on several grids.

    Attributes
    ----------
    states : the films, the finest grid first.
    thicker : a film that is thicker by ``FILM_STEP`` than that of ``compared``.
    compared : the place in ``states`` of the film to which ``thicker`` is compared.
    balance : relative error of the load on the finest grid.
    solved : cells and iterations of all films in their order.
    films : number of films on each grid, the finest first.
    """

    states: tuple[StateT, ...]
    thicker: StateT | None
    compared: int
    balance: float
    solved: tuple[Level, ...]
    films: tuple[int, ...]


def under_load(
    bearing: Callable[[int], SeparableBearing[StateT]],
    pressure: float,
    cells: int,
    *,
    speed: float,
    guess: float | None = None,
    sensitive: bool = False,
    heated: Callable[[SeparableBearing[StateT], Search[StateT]], StateT] | None = None,
    progress: Progress = silent,
) -> Equilibrium[StateT]:
    """Solve for the film thickness at which a bearing carries a load, on successively finer grids.

    Grids that are too coarse to carry the load are left out.

    Parameters
    ----------
    bearing : bearing(cells), the films on a grid of so many cells along and across.
    pressure : the load over the nominal area, Pa.
    cells : number of cells along a side of the finest grid.
    speed : sliding speed, m/s.
    guess : initial film thickness, m.
    sensitive : whether a thicker film is solved too, for derivatives.
    heated : heated(films, search), called on each grid: the film that carries the load with the viscosities of its
        temperatures; None where viscosities do not depend on the film.

    Raises
    ------
    InputError
        If no film thickness gives the load.
    ConvergenceError
        If a film or the load does not converge.
    """
    sizes = [size for size, _ in coarsening((cells, cells), wide=True)][-GRIDS:]
    sizes = [size for size in sizes if size >= MIN_GRID_CELLS or size == cells]
    work = [float(size) ** 2 for size in sizes]
    states: list[StateT] = []
    searches: list[list[FilmsAtSpeed[StateT]]] = []
    start: State | None = None
    for count, size in enumerate(sizes):
        progress(sum(work[:count]) / sum(work), f"{size} cells along a side")
        films, searched = bearing(size), list[FilmsAtSpeed[StateT]]()
        if states:
            known = sizes[count - len(states) : count + 1]
            near = extrapolated(known, [state.scene.geometry.thinnest for state in states])
            guess = min(max(near, films.closest), films.widest)
            start = _on(states[-1].solution, size)

        def search(
            among: SeparableBearing[StateT],
            near: StateT | None,
            *,
            error: float = 0.0,
            growth: float = 1.0,
            guess: float | None = guess,
            start: State | None = start,
            searched: list[FilmsAtSpeed[StateT]] = searched,
        ) -> StateT:
            at, before = FilmsAtSpeed(film=among, speed=speed), searched or (searches[-1] if searches else [])
            if before:
                at.steepness = before[-1].steepness
            searched.append(at)
            if near is not None:
                separation, start = near.scene.geometry.thinnest, near.solution.state
                film_load = growth * (near.load - among.contact_load(separation))
                guess = expected(at, separation, film_load, pressure)
            return robustly_balanced(at, pressure, tolerance=max(LOAD_TOLERANCE, error), guess=guess, start=start)

        try:
            state = search(films, None) if heated is None else heated(films, search)
        except (InputError, ConvergenceError):
            if size == cells:
                raise
            states.clear()
            searches.clear()
            start = None
            continue
        states.append(state)
        searches.append(searched)
    compared, thicker = min(1, len(states) - 1), None
    if sensitive:
        state = states[-1 - compared]
        film = (1 + FILM_STEP) * state.scene.geometry.thinnest
        thicker = searches[-1 - compared][-1].film.at(film, speed, state.solution.state)
    return Equilibrium(
        states=tuple(reversed(states)),
        thicker=thicker,
        compared=compared,
        balance=abs(states[-1].load / (pressure * searches[-1][-1].film.area) - 1),
        solved=tuple(level for of_grid in searches for at in of_grid for level in at.solved),
        films=tuple(sum(len(at.loads) for at in of_grid) for of_grid in reversed(searches)),
    )


def extrapolated(sizes: list[int], films: list[float]) -> float:
    """The film thickness on the last of ``sizes`` from those on the grids before it, m, at second order."""
    if len(films) < 2:
        return films[-1]
    *_, before, last, following = (float(size) ** -ORDER for size in sizes)
    return films[-1] + (films[-1] - films[-2]) * (following - last) / (last - before)


def _on(solution: Solution, size: int) -> State:
    """The state of a film on a finer grid."""
    shape = solution.problem.shape
    return carried(solution.state, solution.grid, grid(shape, (size, size)), shape.joined)


def converted(
    own: Mapping[str, float], values: Mapping[str, float], others: Mapping[str, float], step: float
) -> dict[str, float]:
    """The uncertainties under a load that follow from those at constant film thickness.

    An error δW of the load at constant film thickness changes the film thickness by δW/(-dW/dh). The uncertainty of a
    quantity is its own one at constant film thickness, with its sign, plus its change with the film thickness.

    Parameters
    ----------
    own : uncertainties at constant film thickness by quantity.
    values, others : the quantities of a film, and of one that is thicker by ``step``, m.
    """
    slope = (values["load_per_width"] - others["load_per_width"]) / step
    of_film = own["load_per_width"] / slope if slope > 0 else math.inf
    at_film = {name: 0.0 if name in OF_THE_WALLS else math.copysign(own[name], values[name]) for name in own}
    uncertainties = {
        name: abs(at_film[name] + (others[name] - values[name]) / step * of_film)
        for name in own
        if name in others and name not in PRESCRIBED
    }
    for ratio, name in LOAD_RATIOS.items():
        if ratio in values and name in uncertainties:
            uncertainties[ratio] = uncertainties[name] / values["load_per_width"]
    return uncertainties | dict.fromkeys(PRESCRIBED, 0.0) | {"film": of_film}
