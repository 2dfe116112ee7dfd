"""The search for the film under a load whose temperature its heat determines, at each speed of a curve."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Self

from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.film import MixedState
from roughfilm.rom.bearing.mixed.search.separation import Known, Search, Slopes
from roughfilm.rom.bearing.quantities import bearing_quantities
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.balanced import balanced
from roughfilm.rom.bearing.thermal.exchange import coldest, exchange_of, temperatures
from roughfilm.rom.bearing.thermal.leading import leading_input

TEMPERATURE_TOLERANCE = 1e-4
"""Error of the temperature of a film at which its search stops, K."""

OperatingPoint = tuple[float, float]
"""Speed, m/s, and load over the nominal area, Pa."""


@dataclass(kw_only=True)
class HeatedSearch:
    """The films of a bearing at the temperature at which the heat of each is balanced.

    Attributes
    ----------
    isothermal : the films at any given temperature.
    part : heat transfer to still air over the one that is taken where none is given.
    """

    isothermal: Search
    part: float = 1.0
    _known: dict[float, tuple[float, float]] = field(default_factory=dict)
    _last: dict[OperatingPoint, tuple[float, Search]] = field(default_factory=dict)

    @property
    def scene(self) -> Bearing:
        """The bearing with the lubricant as it is supplied."""
        return self.isothermal.scene

    @property
    def asperities(self) -> Asperities:
        """Flow factors and contact pressures."""
        return self.isothermal.asperities

    @property
    def dip(self) -> float:
        """The least film thickness of the geometry minus the separation at the narrowest place, m."""
        return self.isothermal.dip

    @property
    def area(self) -> float:
        """The nominal area, m² (m if infinitely wide)."""
        return self.isothermal.area

    def at(self, temperature: float) -> Search:
        """The films whose lubricant has a temperature, K."""
        return self.isothermal.of(self.scene.at_temperature(temperature))

    def solved(self, speed: float, pressure: float, known: Known) -> MixedState:
        """The film at a speed under a load, with its temperature, from the films that were solved before."""
        near = list(known)

        def film(search: Search) -> MixedState:
            state = search.solved(speed, pressure, near)
            near[:] = [(speed, state.scene.geometry.thinnest - search.dip)]
            return state

        return self._balanced(film, speed, pressure)

    def again(self, speed: float, pressure: float, separation: float) -> MixedState:
        """The film of a point that was solved before."""
        return self._balanced(lambda search: search.again(speed, pressure, separation), speed, pressure)

    def _balanced(self, film: Callable[[Search], MixedState], speed: float, pressure: float) -> MixedState:
        """The film at the temperature that its heat brings about, from that of the last film under the same load."""
        supplied = self.scene.lubricant.liquid.temperature
        first, slope = self._known.get(pressure, (supplied, 0.0))
        last: list[tuple[MixedState, Search]] = []

        def equilibrium(temperature: float) -> float:
            search = self.at(temperature)
            state = heated_state(film(search), self.scene, part=self.part)
            last[:] = [(state, search)]
            assert state.temperatures is not None
            return state.temperatures.effective

        found = balanced(
            equilibrium,
            first,
            slope=slope,
            coldest=coldest(self.scene, supplied),
            tolerance=TEMPERATURE_TOLERANCE,
        )
        self._known[pressure] = found.temperature, min(found.slope, 0.0)
        (state, search) = last[0]
        self._last[speed, pressure] = found.temperature, search
        return state

    def slopes(self, speed: float, pressure: float, separation: float, film_load: float) -> Slopes:
        """The slopes of the loads at a point, at its temperature."""
        if (speed, pressure) not in self._last:
            self.again(speed, pressure, separation)
        _, search = self._last[speed, pressure]
        return search.slopes(speed, pressure, separation, film_load)

    def lift_off(self, pressure: float, near: float) -> float:
        """The lift-off speed, m/s, at which the film has the temperature of its heat; NaN if the wall does not lift."""
        supplied = self.scene.lubricant.liquid.temperature
        found = [near]

        def equilibrium(temperature: float) -> float:
            search = self.at(temperature)
            found[:] = [search.lift_off(pressure, found[0] if math.isfinite(found[0]) else near)]
            if not 0 < found[0] < math.inf:
                return temperature
            again = search.again(found[0], pressure, self.asperities.touching)
            state = heated_state(again, self.scene, part=self.part)
            assert state.temperatures is not None
            return state.temperatures.effective

        balanced(equilibrium, supplied, coldest=coldest(self.scene, supplied), tolerance=TEMPERATURE_TOLERANCE)
        return found[0]

    def of(self, scene: Bearing) -> Self:
        """The films of another scene with the same walls."""
        return replace(self, isothermal=self.isothermal.of(scene), _known={}, _last={})

    def anew(self) -> Self:
        """The films of which none was solved before."""
        return replace(self, isothermal=self.isothermal.anew(), _known={}, _last={})

    def coarser(self) -> Self:
        """The films on a grid of half as many cells."""
        return replace(self, isothermal=self.isothermal.coarser(), _known=dict(self._known), _last={})

    def with_part(self, part: float) -> Self:
        """The films whose bearing gives off a part of the heat that it is estimated to."""
        return replace(self, part=part, _known=dict(self._known), _last={})


def heated_state(state: MixedState, scene: Bearing, *, part: float = 1.0) -> MixedState:
    """The film with the temperatures that its heat brings about.

    Parameters
    ----------
    scene : the bearing with the lubricant as it is supplied.
    part : heat transfer to still air over the one that is taken where none is given.
    """
    liquid = scene.lubricant.liquid
    quantities = bearing_quantities(state.scene, state.solution, state.contact.force)
    exchange = exchange_of(state.scene, state.solution, quantities, liquid.temperature)
    return replace(state, temperatures=temperatures(exchange, liquid, part=part))


def leading_of(state: MixedState, scene: Bearing) -> str:
    """The input on which the temperature of a film depends most; "" of an isothermal film, or if it is small.

    Parameters
    ----------
    scene : the bearing with the lubricant as it is supplied.
    """
    if state.temperatures is None:
        return ""
    quantities = bearing_quantities(state.scene, state.solution, state.contact.force)
    at = state.temperatures.effective
    return leading_input(state.scene, state.solution, quantities, scene.lubricant.liquid, at)


def with_temperature(search: Search) -> Search:
    """The films at their own temperatures if the lubricant of the scene has one, else the given films."""
    return search if search.scene.lubricant.lacking else HeatedSearch(isothermal=search)
