"""The temperature of a film in a march: it follows the balance of its heat with the time constant of the walls."""

from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.march.course import Duty, started
from roughfilm.rom.bearing.march.numbers import Observer
from roughfilm.rom.bearing.quantities import boundary_flows
from roughfilm.rom.bearing.supply.quantities import supply_values
from roughfilm.rom.bearing.thermal.balanced import balanced
from roughfilm.rom.bearing.thermal.exchange import Temperatures, coldest, exchange_of, temperatures
from roughfilm.rom.bearing.thermal.leading import leading_input
from roughfilm.rom.cavitation.motion.coupled import Instant
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.motion.march import Moving
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.lubricants.liquid import Liquid

FIRST_TOLERANCE = 1e-3
"""Error of the temperature at which a march without time constant begins, K."""


@dataclass(frozen=True, kw_only=True)
class HeatedMarch:
    """The temperature of a film that follows the balance of its heat, τ dT/dt = T_eq - T.

    T_eq is the temperature that friction, squeeze and flows of the instant bring about
    (:func:`roughfilm.rom.bearing.thermal.exchange.temperatures`). A film that takes up or gives off lubricant, as its
    walls move, takes it from the supply, or displaces lubricant that came from there. The heat that the lubricant in
    the film stores is left out against that of the walls. Without a time constant T is T_eq at all times.

    Attributes
    ----------
    duty : what moves the bearing.
    observer : the numbers of its film.
    part : heat transfer to still air over the one that is taken where none is given.
    """

    duty: Duty
    observer: Observer
    part: float = 1.0

    @property
    def time_constant(self) -> float:
        """The time constant τ, s."""
        heat = self.duty.scene.heat
        return (heat.time_constant if heat is not None else None) or 0.0

    @property
    def liquid(self) -> Liquid:
        """The lubricant over temperature."""
        return self.duty.scene.lubricant.liquid

    @property
    def coldest(self) -> float:
        """The lowest temperature of what takes the heat of the film away, K."""
        return coldest(self.duty.scene, self.liquid.temperature)

    def film(self, film: MovingFilm, temperature: float) -> MovingFilm:
        """The film whose lubricant has the viscosity at a temperature, K."""
        return film.with_viscosity(self.duty.scene.lubricant.at(temperature).viscosity)

    def whole(self, temperature: float, *, turned: bool) -> FreeFilm:
        """The film over the whole width, and its part that is solved, at a temperature, K."""
        free = self.observer.film.reversed if turned else self.observer.film
        return replace(free, whole=self.film(free.whole, temperature), solved=self.film(free.solved, temperature))

    def balanced(self, time: float, instant: Instant, velocity: Array, temperature: float, *, turned: bool) -> float:
        """The temperature T_eq, K, that the heat of a film brings about, as ``temperatures`` gives it."""
        return self.temperatures(time, instant, velocity, temperature, turned=turned).effective

    def estimated(self, moving: Moving) -> float:
        """The heat transfer to the surroundings that is estimated at a step, W/K; 0 where none is."""
        now = moving.now
        found = self.temperatures(now.time, moving.instant, now.velocity, moving.solved_at, turned=moving.turned)
        return found.estimated

    def leading(self, moving: Moving) -> str:
        """The input on which the temperature at a step depends most; "" if its effect is small."""
        now = moving.now
        film = self._evaluated(now.time, moving.instant, now.velocity, moving.solved_at, turned=moving.turned)
        return leading_input(self.duty.scene, *film, self.liquid, now.temperature)

    def temperatures(
        self, time: float, instant: Instant, velocity: Array, temperature: float, *, turned: bool
    ) -> Temperatures:
        """The temperatures that the heat of a film brings about, from the arguments of ``_evaluated``."""
        solution, quantities = self._evaluated(time, instant, velocity, temperature, turned=turned)
        exchange = exchange_of(self.duty.scene, solution, quantities, self.liquid.temperature)
        return temperatures(exchange, self.liquid, part=self.part)

    def _evaluated(
        self, time: float, instant: Instant, velocity: Array, temperature: float, *, turned: bool
    ) -> tuple[Solution, dict[str, Quantity]]:
        """A film as one of a steady problem, with its flows and its power.

        Parameters
        ----------
        time : time, s.
        instant : position of the wall at this time.
        velocity : velocity of the wall along its coordinates, m/s.
        temperature : temperature of the lubricant of the film, K.
        turned : whether the speed is negative.
        """
        seen = replace(self.observer, film=self.observer.film.reversed) if turned else self.observer
        scene, film = self.duty.scene, self.whole(temperature, turned=turned)
        moved = replace(film.whole.problem, speed=abs(self.duty.speed(time)))
        film = replace(film, whole=replace(film.whole, problem=moved))
        solution = _with_edges(film.solution(instant), film, velocity)
        flows, wide = boundary_flows(solution), scene.wide
        per, unit = ("_per_width", "m^2/s") if wide else ("", "m^3/s")
        amounts = {f"inlet_flow{per}": flows.inlet, f"outlet_flow{per}": flows.outlet}
        amounts |= {} if wide else {"side_leakage_low": flows.low, "side_leakage_high": flows.high}
        quantities = {name: Quantity(value=one, unit=unit) for name, one in amounts.items() if one is not None}
        supplies = supply_values(scene, solution)
        quantities |= {name: Quantity(value=value, unit=unit) for name, (value, unit) in supplies.items()}
        given = supplies[f"supply_flow{per}"][0] if supplies else 0.0
        displaced = (flows.outlet or 0.0) + flows.low + flows.high - (flows.inlet or 0.0) - given
        quantities[f"displaced_flow{per}"] = Quantity(value=displaced, unit=unit)
        power = seen.power(time, instant, velocity, temperature)
        quantities[f"power_loss{per}"] = Quantity(value=power, unit="W/m" if wide else "W")
        return solution, quantities

    def slope(self, balanced: float, temperature: float) -> float:
        """About dT_eq/dT where the film is at a temperature, K: that of a rise proportional to the viscosity."""
        rise = balanced - self.liquid.temperature
        viscosity, fall = (float(one[0]) for one in self.liquid.viscosity(np.array([temperature])))
        return min(rise * fall / viscosity, 0.0)

    def sensitivity(self, temperature: float) -> float:
        """|d ln η/dT| at a temperature, K."""
        viscosity, fall = (float(one[0]) for one in self.liquid.viscosity(np.array([temperature])))
        return abs(fall / viscosity)

    def started(self, *, tolerance: float) -> Moving:
        """The film at the first time: at the given or the supply temperature, or without time constant at T_eq.

        Raises
        ------
        InputError
            If there is no equilibrium with the first load, or the heat is not balanced.
        """
        start, supplied = self.duty.body.start, self.liquid.temperature
        given = supplied if start is None or start.temperature is None else start.temperature
        last: list[Moving] = []

        def equilibrium(temperature: float) -> float:
            moving = started(self.duty, self.whole(temperature, turned=False), tolerance=tolerance)
            now = replace(moving.now, temperature=temperature)
            found = self.balanced(now.time, moving.instant, now.velocity, temperature, turned=moving.turned)
            last[:] = [replace(moving, past=(now,), solved_at=temperature, balanced=found)]
            return found

        if self.time_constant:
            equilibrium(given)
        else:
            balanced(equilibrium, given, coldest=self.coldest, tolerance=FIRST_TOLERANCE)
        return last[0]


def _with_edges(solution: Solution, film: FreeFilm, velocity: Array) -> Solution:
    """The solution whose control volumes take up θ ∂h/∂t, so that flows through its edges contain that of the edges.

    Parameters
    ----------
    velocity : velocities of the coordinates of the wall.
    """
    rate = film.whole.gap_rate(solution.faces.thickness) * (film.whole.at_nodes @ velocity)
    storage = solution.grid.areas * rate
    return replace(solution, network=replace(solution.network, storage=storage, stored=np.zeros_like(storage)))
