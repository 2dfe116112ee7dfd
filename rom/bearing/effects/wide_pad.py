"""The changes of an infinitely wide pad by inertia, slope and cavitation, each from two models on one grid."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.rom.bearing.keyed import KeyedScene, keyed
from roughfilm.rom.bearing.models.film import MODEL as FILM
from roughfilm.rom.bearing.models.film_slope import MODEL as FILM_SLOPE
from roughfilm.rom.bearing.models.reynolds import MODEL as REYNOLDS
from roughfilm.rom.bearing.models.reynolds_incompressible import MODEL as REYNOLDS_INCOMPRESSIBLE
from roughfilm.rom.bearing.numbers import without_inertia
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.wide_pad.model import MIN_CELLS
from roughfilm.rom.bearing.wide_pad.solve import GRIDS
from roughfilm.rom.ladder.kind import kind_of
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result


@dataclass(frozen=True, kw_only=True)
class WideFilm:
    """The film of an infinitely wide pad on one grid, by models that differ by one effect.

    Attributes
    ----------
    cells : number of cells along the film.
    film, creeping, slope : with inertia, without it, and with inertia and slope.
    """

    cells: int
    film: Result
    creeping: Result
    slope: Result

    def by_inertia(self, quantity: str) -> float:
        """The change of a quantity by inertia, in its unit."""
        return self.film[quantity].value - self.creeping[quantity].value

    def by_slope(self, quantity: str) -> float:
        """The change of a quantity by slope to second order, in its unit."""
        return self.slope[quantity].value - self.film[quantity].value


@dataclass(frozen=True, kw_only=True)
class WidePad:
    """An infinitely wide pad by models that differ by one effect, each pair of them on one grid.

    Attributes
    ----------
    resolved : the film with inertia, without it, and with slope.
    reynolds, cavitating : by the Reynolds equation without cavitation and with it.
    """

    resolved: WideFilm
    reynolds: Result
    cavitating: Result

    def part(self, quantity: str, change: Callable[[str], float], *results: Result) -> float:
        """The size of a change over that of the quantity in the film with inertia; 0 if one of the results lacks it."""
        film = self.resolved.film
        if any(quantity not in result.quantities for result in (film, *results)):
            return 0.0
        size = kind_of(film).scale_of(film, quantity)
        return abs(change(quantity)) / size if size > 0 else 0.0

    def by_inertia(self, quantity: str) -> float:
        """The relative change of a quantity by inertia."""
        return self.part(quantity, self.resolved.by_inertia, self.resolved.creeping)

    def by_slope(self, quantity: str) -> float:
        """The relative change of a quantity by slope to second order."""
        return self.part(quantity, self.resolved.by_slope, self.resolved.slope)

    def by_cavitation(self, quantity: str) -> float:
        """The relative change of a quantity by cavitation; 0 for a film that does not rupture."""
        if not self.ruptures:
            return 0.0
        pair = self.reynolds, self.cavitating
        return self.part(quantity, lambda name: pair[1][name].value - pair[0][name].value, *pair)

    @property
    def ruptures(self) -> bool:
        """Whether the film cavitates."""
        return self.cavitating["cavitated_fraction"].value > 0


def wide_pad(scene: Bearing) -> WidePad | None:
    """The quantities of an infinitely wide pad with and without effects; None where inertia is not resolved."""
    return _pad(keyed(scene))


def wide_films(scene: Bearing) -> tuple[WideFilm, ...]:
    """The film of an infinitely wide pad on grids from the default one of ``film`` to coarser ones.

    Empty where inertia is not resolved, because ``film`` does not apply or converge, or where the film ruptures.
    """
    pad = wide_pad(scene)
    if pad is None or pad.ruptures:
        return ()
    default = FILM.resolution_of(scene)
    films = [_film(keyed(scene), max(MIN_CELLS, round(part * default))) for part in reversed(GRIDS)]
    return () if films[0] is None else tuple(film for film in films if film is not None)


@lru_cache(maxsize=16)
def _pad(question: KeyedScene) -> WidePad | None:
    scene = question.scene
    if not FILM.applies(scene).applies:
        return None
    film = _film(question, FILM.resolutions_of(scene)[-2])
    if film is None:
        return None

    def solved(model: Model[Bearing]) -> Result:
        return model.solve(scene, Request(resolution=model.resolutions_of(scene)[-2]))

    try:
        return WidePad(resolved=film, reynolds=solved(REYNOLDS), cavitating=solved(REYNOLDS_INCOMPRESSIBLE))
    except ConvergenceError:
        return None


@lru_cache(maxsize=16)
def _film(question: KeyedScene, cells: int) -> WideFilm | None:
    scene, request = question.scene, Request(resolution=cells)
    try:
        return WideFilm(
            cells=cells,
            film=FILM.solve(scene, request),
            creeping=FILM.solve(without_inertia(scene), request),
            slope=FILM_SLOPE.solve(scene, request),
        )
    except ConvergenceError:
        return None
