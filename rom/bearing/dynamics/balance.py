"""The equilibrium of a bearing on a grid, at the temperature at which the heat of its film is balanced."""

from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.dynamics.point import GridPoint, grid_point, static_quantities
from roughfilm.rom.bearing.free.equilibrium import equilibrium, refined
from roughfilm.rom.bearing.free.film import FreeFilm, free_film
from roughfilm.rom.bearing.march.rough_walls import Walls
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.balanced import balanced
from roughfilm.rom.bearing.thermal.exchange import Temperatures, coldest, exchange_of, temperatures
from roughfilm.rom.bearing.thermal.leading import leading_input
from roughfilm.rom.cavitation.motion.coupled import Instant

TOLERANCE = 1e-9
"""Residual at which a film is solved."""

TEMPERATURE_TOLERANCE = 1e-5
"""Error of the temperature of a film at which its search stops, K."""

MAX_FILM_RATIO = 3.0
"""Largest ratio of the least films of a start and of the equilibrium that Newton's method finds from it."""


@dataclass(frozen=True, kw_only=True)
class Equilibrium:
    """The equilibrium of a bearing on a grid.

    Attributes
    ----------
    film : the film, whose scene has the lubricant at the temperature of the film.
    instant : its state.
    cells : numbers of cells along and across.
    temperatures : the temperatures that its heat brings about; None of a lubricant without temperature.
    slope : change of the temperature T_eq that the heat brings about with that of the film, dT_eq/dT.
    """

    film: FreeFilm
    instant: Instant
    cells: tuple[int, int]
    temperatures: Temperatures | None = None
    slope: float = 0.0

    @property
    def degrees(self) -> dict[str, float]:
        """The temperatures of the film and of the lubricant that leaves, °C, by name; empty without a temperature."""
        found = self.temperatures
        if found is None:
            return {}
        return {"temperature": found.effective - ZERO_CELSIUS, "outlet_temperature": found.outlet - ZERO_CELSIUS}


def balanced_equilibrium(
    scene: Bearing,
    walls: Walls,
    cells: tuple[int, int],
    *,
    coarse: Equilibrium | None = None,
    part: float = 1.0,
) -> Equilibrium:
    """The equilibrium of a bearing on a grid, with the heat of its film balanced if its lubricant has a temperature.

    The film has the viscosity at its temperature T, which is the one that its heat brings about, T_eq(T) = T, as in the
    model ``heat_balance`` (:func:`roughfilm.rom.bearing.thermal.exchange.temperatures`). The search begins at the
    temperature on a coarser grid, else at that of the supply. Where the temperature leaves
    the viscosity as it is, the film stays that of the supplied lubricant to the last bit.

    Parameters
    ----------
    scene : the bearing with the lubricant as it is supplied.
    walls : its walls, smooth or rough.
    cells : numbers of cells along and across.
    coarse : the equilibrium on a coarser grid, or with another heat transfer.
    part : heat transfer to still air over the one that is taken where none is given.

    Raises
    ------
    InputError
        If there is no equilibrium, nothing takes the heat away, or friction heats the film without end.
    ConvergenceError
        If the film or its temperature does not converge.
    """

    def settled(film: FreeFilm, near: Instant | None) -> Instant:
        if near is None and coarse is not None:
            near = refined(coarse.film, coarse.instant, film)
        with np.errstate(all="ignore"):  # pressures that are not finite end the iteration with an error
            instant = equilibrium(film, near, tolerance=TOLERANCE)
            if near is not None and _far(near, instant):
                instant = equilibrium(film, None, tolerance=TOLERANCE)
        return instant

    def film_of(bearing: Bearing) -> FreeFilm:
        return free_film(bearing, cells, film=walls.film, contact=walls.contact, closest=walls.closest)

    if scene.lubricant.lacking:
        film = film_of(scene)
        return Equilibrium(film=film, instant=settled(film, None), cells=cells)
    last: list[Equilibrium] = []

    def brought_about(temperature: float) -> float:
        hot = scene.at_temperature(temperature)
        before = last[0] if last else None
        if before is None or hot.inlet_pressure != before.film.scene.inlet_pressure:  # a ram's depends on the density
            film = film_of(hot)
        else:
            film = _with_lubricant_of(before.film, hot)
        if before is not None and film.solved is before.film.solved:
            instant = before.instant
        else:
            instant = settled(film, None if before is None else before.instant)
        found = temperatures_of(scene, film, instant, part)
        last[:] = [Equilibrium(film=film, instant=instant, cells=cells, temperatures=found)]
        return found.effective

    supplied = scene.lubricant.liquid.temperature
    guess = None if coarse is None else coarse.temperatures
    found = balanced(
        brought_about,
        supplied if guess is None else guess.effective,
        slope=0.0 if coarse is None else min(coarse.slope, 0.0),
        coldest=coldest(scene, supplied),
        tolerance=TEMPERATURE_TOLERANCE,
    )
    return replace(last[0], slope=found.slope)


def temperatures_of(scene: Bearing, film: FreeFilm, instant: Instant, part: float = 1.0) -> Temperatures:
    """The temperatures that the heat of a film in equilibrium brings about.

    Parameters
    ----------
    scene : the bearing with the lubricant as it is supplied.
    film, instant : the equilibrium, whose scene has the lubricant at the temperature of the film.
    part : heat transfer to still air over the one that is taken where none is given.

    Raises
    ------
    ConvergenceError
        If the heat belongs to no temperature.
    """
    liquid, solution = scene.lubricant.liquid, film.solution(instant)
    exchange = exchange_of(film.scene, solution, static_quantities(film, instant), liquid.temperature)
    return temperatures(exchange, liquid, part=part)


def leading_of(scene: Bearing, found: Equilibrium) -> str:
    """The input on which the temperature of an equilibrium depends most; "" without one, or if it is small."""
    if found.temperatures is None:
        return ""
    film, liquid = found.film, scene.lubricant.liquid
    quantities = static_quantities(film, found.instant)
    return leading_input(film.scene, film.solution(found.instant), quantities, liquid, found.temperatures.effective)


def point_of(found: Equilibrium, ratio: float) -> GridPoint:
    """The numbers of an equilibrium on its grid, with its temperatures.

    Parameters
    ----------
    ratio : frequency of the motion, of stiffness and damping, over that of the rotation.
    """
    point = grid_point(found.film, found.instant, ratio)
    return replace(point, numbers={**point.numbers, **found.degrees})


def _with_lubricant_of(film: FreeFilm, hot: Bearing) -> FreeFilm:
    """The film with its lubricant at another temperature; what was sampled of the geometry is shared."""
    whole, solved = (one.with_viscosity(hot.lubricant.viscosity) for one in (film.whole, film.solved))
    return replace(film, scene=hot, whole=whole, solved=solved)


def _far(start: Instant, found: Instant) -> bool:
    """Whether the least film is so far from that of the start that it may be an equilibrium that is not stable."""
    ratio = float(found.faces.thickness.min() / start.faces.thickness.min())
    return not 1 / MAX_FILM_RATIO < ratio < MAX_FILM_RATIO
