"""The numbers of a film at one time of a march."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.corners import differs
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.march.course import Duty
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.mixed.contact_load import asperity_load
from roughfilm.rom.bearing.outside import reynolds_numbers
from roughfilm.rom.cavitation.balance import CAVITY, FIXED, FLOODED
from roughfilm.rom.cavitation.evaluation.filling import density_ratio
from roughfilm.rom.cavitation.evaluation.friction import drag_of_rows, radius_between
from roughfilm.rom.cavitation.evaluation.peak import peak_pressure
from roughfilm.rom.cavitation.motion.coupled import Instant
from roughfilm.rom.cavitation.motion.march import Moving
from roughfilm.rom.cavitation.newton import BALANCE_ROUNDOFF
from roughfilm.rom.cavitation.solve import Solution

FORCES = {
    "eccentricity_x": "force_x",
    "eccentricity_y": "force_y",
    "film": "force",
    "pivot_film": "force",
    "slope_x": "moment_y",
    "slope_y": "moment_x",
}
"""The names of the forces on the coordinates but the tilts of pads in lobes."""


ENTERING = ("gap", "supply", "inlet")
"""How the names of flows into the film begin; the others leave it."""


@dataclass(frozen=True, kw_only=True)
class Observer:
    """The numbers of every step of a march.

    Attributes
    ----------
    duty : what moves the bearing.
    film : its film.
    asperities : those of walls that may touch; None of others.
    heated : whether the film has a temperature.
    """

    duty: Duty
    film: FreeFilm
    asperities: AsperityTable | None = None
    heated: bool = False

    @cached_property
    def units(self) -> Mapping[str, str]:
        """The names of the numbers, in order, with their units."""
        wall, wide = self.film.wall, self.duty.scene.wide
        force, flow, volume = ("N/m", "m^2/s", "m^2") if wide else ("N", "m^3/s", "m^3")
        turning = "N" if wide else "N*m"
        units = {"time": "s", "speed": "m/s"}
        for name, turns in zip(wall.names, wall.turns, strict=True):
            units[name] = "rad" if turns else "1" if name.startswith("eccentricity") else "m"
        for name, turns in zip(wall.names, wall.turns, strict=True):
            units[f"{name}_velocity"] = "rad/s" if turns else "m/s"
        units |= {"film_min": "m", "film_min_x": "m", "film_min_y": "m"}
        units |= {"pressure_max": "Pa", "pressure_max_x": "m", "pressure_max_y": "m"}
        for name, turns in zip(self._forces, wall.turns, strict=True):
            units[f"film_{name}"] = turning if turns else force
            units[f"load_{name}"] = turning if turns else force
            if self.asperities is not None:
                units[f"contact_{name}"] = turning if turns else force
        if self.asperities is not None:
            units |= {"contact_load": force, "contact_pressure_max": "Pa", "contact_area": "1"}
        units |= {"friction": force, "power_sliding": "W/m" if wide else "W", "power_squeeze": "W/m" if wide else "W"}
        units["power_loss"] = units["power_sliding"]
        if self._turns:
            units["torque"] = turning
        units |= dict.fromkeys(self._places, flow) | dict.fromkeys(self._pressures, "Pa")
        units |= {"volume": volume, "volume_rate": flow, "flow_imbalance": "1"}
        units |= {"cavitated_fraction": "1", **dict.fromkeys(self.reynolds, "1")}
        if self.heated:
            units |= {"temperature": "degC", "balanced_temperature": "degC", "estimated_heat_transfer": "W/K"}
        return units | {
            "step": "s",
            "order": "1",
            "error": "1",
            "residual": "1",
            "force_residual": "1",
            "iterations": "1",
        }

    @cached_property
    def reynolds(self) -> tuple[str, ...]:
        """The names of the Reynolds numbers of a film: of sliding, of the flow by pressure, of a shaft's clearance."""
        shaft = ("reynolds_number_of_clearance",) if isinstance(self.duty.scene.geometry, Shaft) else ()
        return ("reynolds_number_of_sliding", "reynolds_number_of_pressure", *shaft)

    @property
    def _forces(self) -> tuple[str, ...]:
        """The names of the force on each coordinate."""
        return tuple(
            f"moment_{name.removeprefix('tilt_')}" if name.startswith("tilt_") else FORCES[name]
            for name in self.film.wall.names
        )

    @property
    def _signs(self) -> Array:
        """The sign of each of these forces: a moment about y acts against a slope along x."""
        return np.array([-1.0 if name == "slope_x" else 1.0 for name in self.film.wall.names])

    @property
    def _turns(self) -> bool:
        return self.duty.scene.turning_radius is not None

    @cached_property
    def _places(self) -> dict[str, NDArray[np.bool_]]:
        """The nodes through which lubricant enters, or leaves, by the name of the flow."""
        film, places = self.film.solved, {}
        left = np.ones(film.grid.shape, dtype=bool)
        for name, nodes in zip(self._inflows, film.covered, strict=True):
            places[f"{name}_flow"] = nodes & left
            left &= ~nodes
        if not film.problem.shape.joined[0]:
            for name, row in (("inlet_flow", 0), ("outlet_flow", -1)):
                nodes = np.zeros_like(left)
                nodes[row] = left[row]
                places[name] = nodes
                left &= ~nodes
        if film.problem.ends.sides is not None:
            for name, column in (("side_flow_low", 0), ("side_flow_high", -1)):
                nodes = np.zeros_like(left)
                nodes[:, -1 if film.halved else column] = left[:, -1 if film.halved else column]
                places[name] = nodes
        return places

    @cached_property
    def _back(self) -> Self:
        """The numbers while the wall slides in the direction opposite to that of the film."""
        return replace(self, film=self.film.reversed)

    @cached_property
    def _inflows(self) -> tuple[str, ...]:
        """The names of the inflows: the gaps between lobes, then the supplies of the scene."""
        supplies = len(self.duty.scene.supply)
        gaps = len(self.film.solved.inflows) - supplies
        return tuple(f"{kind}_{number + 1}" for kind, n in (("gap", gaps), ("supply", supplies)) for number in range(n))

    @cached_property
    def _pressures(self) -> dict[str, NDArray[np.bool_]]:
        """The nodes of each supply, by the name of its pressure in the film."""
        nodes = dict(zip(self._inflows, self.film.solved.covered, strict=True))
        return {f"{name}_pressure": nodes[name] for name in self._inflows if name.startswith("supply")}

    @cached_property
    def infinite_flows(self) -> frozenset[str]:
        """The names of flows that are infinite where the film is full at corners between edges of other pressures."""
        film, names = self.film.solved, set()
        ends = film.problem.ends
        if ends.sides is None:
            return frozenset()
        given = {"inlet_flow": ends.inlet, "outlet_flow": ends.outlet}
        given |= {f"{name}_flow": one.pressure for name, one in zip(self._inflows, film.inflows, strict=True)}
        for place, nodes in self._places.items():
            pressure = given.get(place)
            for side, beside, other in (("low", -2 if film.halved else 1, ends.sides[0]), ("high", -2, ends.sides[1])):
                if pressure is not None and nodes[:, beside].any() and differs(pressure, other):
                    names |= {place, f"side_flow_{side}"}
        return frozenset(names)

    def row(self, moving: Moving, estimated: float = 0.0) -> Array:
        """The numbers of a step, in the order of ``units``, with the heat transfer that is estimated, W/K."""
        return (self._back if moving.turned else self)._row(moving, estimated)

    def _row(self, moving: Moving, estimated: float) -> Array:
        instant, film, time = moving.instant, self.film.solved, moving.now.time
        wall, speed = self.film.wall, self.duty.speed(time)
        velocity, scale = moving.now.velocity, np.where(wall.turns, 1.0, wall.unit[0])
        solution = self._solution(instant, abs(speed), moving.solved_at)
        force, load = film.force(instant.state.pressure), self.duty.force(time)[: wall.place.size]
        contact, rubbed, touching = self._contact(instant)
        friction, torque, power = self._friction(solution, rubbed)
        squeeze = -float(force @ velocity)
        flows, stored, rate, imbalance = self._flows(instant)
        radius = (self.duty.scene.turning_radius or 1.0) if film.problem.shape.polar else 1.0
        values = [time, speed * radius, *(instant.place / (scale if self.duty.lobes else 1.0)), *velocity]
        values += [*self.least(instant.faces.thickness), *self._peak(solution)]
        parts = [self._signs * part for part in (force, load, *contact)]
        values += [number for numbers in zip(*parts, strict=True) for number in numbers] + touching
        values += [friction, power, squeeze, power + squeeze, *([torque] if self._turns else []), *flows]
        lowest = self.duty.scene.lubricant.cavitation_pressure
        values += [float(instant.state.pressure[nodes].max()) + lowest for nodes in self._pressures.values()]
        empty = instant.kind == (FLOODED if film.refills else CAVITY)
        cavitated = float(film.grid.areas[empty].sum() / film.grid.areas.sum())
        found = reynolds_numbers(self.duty.scene, solution)
        numbers = (found.shear, found.pressure, found.clearance)[: len(self.reynolds)]
        values += [stored, rate, imbalance, cavitated, *numbers]
        if self.heated:
            values += [moving.now.temperature - ZERO_CELSIUS, moving.balanced - ZERO_CELSIUS, estimated]
        values += [moving.step, moving.order, moving.error]
        return np.array([*values, self._residual(instant), instant.force_residual, instant.iterations], dtype=float)

    def fields(self, moving: Moving) -> dict[str, tuple[Array, str]]:
        """Film thickness, pressure above ambient and density ratio over the whole width, shape (nx, ny)."""
        instant, at = moving.instant, self._back if moving.turned else self
        lowest, film = self.duty.scene.lubricant.cavitation_pressure, self.film
        found = {
            "film_thickness": (instant.faces.thickness, "m"),
            "pressure": (instant.state.pressure + lowest, "Pa"),
            "density_ratio": (density_ratio(at._solution(instant, film.solved.problem.speed)), "1"),
        }

        def placed(values: Array) -> Array:
            """Values over the whole width in order of the positions of the scene."""
            values = film.widened(film.solved.turned_round(values) if moving.turned else values)
            return values[::-1] if film.turned else values

        return {name: (placed(values), unit) for name, (values, unit) in found.items()}

    @cached_property
    def grid(self) -> dict[str, tuple[Array, str]]:
        """The positions of the nodes over the whole width: x, m (rad where x is an angle), and y, m."""
        grid, polar = self.film.whole.grid, self.film.whole.problem.shape.polar
        x = self._ends - grid.x[::-1] if self.film.turned else grid.x
        return {"x": (x, "rad" if polar else "m"), "y": (grid.y, "m")}

    @property
    def _ends(self) -> float:
        breaks = self.film.solved.problem.shape.breaks
        return breaks[0] + breaks[-1]

    def power(self, time: float, instant: Instant, velocity: Array, temperature: float) -> float:
        """The power of friction and squeeze of a film whose liquid has a temperature, K, in W."""
        solution = self._solution(instant, abs(self.duty.speed(time)), temperature)
        _, rubbed, _ = self._contact(instant)
        return self._friction(solution, rubbed)[2] - float(self.film.solved.force(instant.state.pressure) @ velocity)

    def _solution(self, instant: Instant, speed: float, temperature: float = math.nan) -> Solution:
        """The film that is solved as one of a steady problem, with the viscosity at a temperature, K, if it has one."""
        film, lubricant = self.film.solved, self.duty.scene.lubricant
        viscosity = film.problem.viscosity if math.isnan(temperature) else lubricant.at(temperature).viscosity
        return Solution(
            problem=replace(film.problem, speed=speed, viscosity=viscosity),
            turned=self.film.turned,
            grid=film.grid,
            faces=instant.faces,
            network=instant.network,
            state=instant.state,
            kind=instant.kind,
            residual=instant.residual,
            imbalance=0.0,
            levels=(),
            coarser=None,
        )

    def least(self, thickness: Array) -> tuple[float, float, float]:
        """The least film thickness, m, with its place; along x that of a parabola through three nodes."""
        grid, shape = self.film.solved.grid, self.film.solved.problem.shape
        i, j = np.unravel_index(int(np.argmin(thickness)), thickness.shape)
        least, x = float(thickness[i, j]), float(grid.x[i])
        periodic, count = shape.joined[0], grid.x.size
        if count > 2 and (periodic or 0 < i < count - 1):
            before, after = float(thickness[i - 1, j]), float(thickness[(i + 1) % count, j])
            bend, slope = before - 2 * least + after, (after - before) / 2
            step = float(grid.spacing_x[i])
            even = abs(step - float(grid.spacing_x[i - 1])) <= 1e-6 * step
            if (
                even
                and not bool((np.abs(x - np.array(shape.breaks)) <= 1e-6 * step).any())
                and bend > 0
                and abs(slope) <= bend
            ):
                least -= slope**2 / (2 * bend)
                x -= step * slope / bend
        return least, self._along(x), self._across(int(j))

    def _along(self, x: float) -> float:
        """The position in the direction of the scene's x, m."""
        shape = self.film.solved.problem.shape
        x = self._ends - x if self.film.turned else x
        return x * (self.duty.scene.turning_radius or 1.0) if shape.polar else x

    def _across(self, j: int) -> float:
        return float(self.film.solved.grid.y[j])

    def _peak(self, solution: Solution) -> tuple[float, float, float]:
        """The largest pressure above ambient, Pa, with its place."""
        pressure = solution.state.pressure
        i, j = np.unravel_index(int(np.argmax(pressure)), pressure.shape)
        top = peak_pressure(solution) + self.duty.scene.lubricant.cavitation_pressure
        return top, self._along(float(solution.grid.x[i])), self._across(int(j))

    def _contact(self, instant: Instant) -> tuple[list[Array], Array | float, list[float]]:
        """The force of contact on each coordinate, boundary friction of the rows, N, and the numbers of the contact.

        The latter are the load, N, the largest pressure, Pa, and the fraction of the area in contact.
        """
        film, scene = self.film.solved, self.duty.scene
        if self.asperities is None or scene.asperities is None:
            return [], 0.0, []
        force = film.contact_at(instant.place).force
        found = asperity_load(film.shape(instant.place), film.grid, self.asperities)
        load = float(np.hypot(*force[:2])) if self.duty.lobes else float(force[0])
        rubbed = scene.boundary_friction * found.force.sum(axis=0)
        return [force], rubbed, [load, found.pressure_max, found.area_fraction]

    def _friction(self, solution: Solution, rubbed: Array | float) -> tuple[float, float, float]:
        """The friction on the sliding wall, N, with boundary friction of the rows, its torque, N m, and power, W."""
        film, grid = self.film.solved, solution.grid
        drag = drag_of_rows(solution, halved=film.halved)
        drag = replace(drag, rows=drag.rows + rubbed)
        force = film.sides * float(drag.rows.sum() + drag.between.sum())
        radius, speed = self.duty.scene.turning_radius, solution.problem.speed
        if not film.problem.shape.polar:
            return force, force * (radius or 0.0), speed * force
        torque = film.sides * float((drag.rows * grid.radius).sum() + (drag.between * radius_between(grid)).sum())
        return force, torque, speed * torque

    def _residual(self, instant: Instant) -> float:
        """The residual of a step; 0 where no balance exceeds the round-off of the stored volume over the step."""
        open_by = np.abs(np.where(instant.kind >= FIXED, 0.0, instant.balance)).max()
        small = BALANCE_ROUNDOFF * instant.network.storage.max()
        return instant.residual if open_by > small or small == 0 else 0.0

    def _flows(self, instant: Instant) -> tuple[list[float], float, float, float]:
        """The flows that enter through each place, m³/s, the volume at cavitation density, its rate and the imbalance.

        The flow through the sides counts outwards, as that through the outlet; what refills cavities from there is not
        in it. The imbalance is that of all flows with
        the storage, over the largest of them, of those along the film and of what passes its edges. It is 0 below the
        round-off of the stored volume over a step, and where no flow exceeds the round-off of those that the pressures
        drive, as at rest.
        """
        film, net = self.film.solved, instant.network
        areas, excess = film.grid.areas, film.problem.compression(instant.state.pressure)[0]
        filled = instant.state.fill + excess
        outside = np.where(instant.kind >= FIXED, instant.balance, 0.0)
        if net.supplied.size:
            outside = outside.copy()
            outside[0] += net.supplied
        flows = []
        for name, nodes in self._places.items():
            flow = float(outside[nodes].sum())
            if name.startswith("side"):
                flows.append(-flow)
            else:
                flows.append((-film.sides if name == "outlet_flow" else film.sides) * flow)
        stored = film.sides * float((areas * film.gap(instant.faces.thickness) * filled).sum())
        rate = film.sides * float((net.storage * filled - net.stored).sum())
        refilled = film.sides * float(outside[instant.kind == FLOODED].sum()) if film.refills else 0.0
        entering = refilled + sum(
            flow if name.startswith(ENTERING) else -flow for name, flow in zip(self._places, flows, strict=True)
        )
        passing = film.sides * float(np.abs(net.couette * filled).sum(axis=1).max())
        through = film.sides / 2 * float(np.abs(outside).sum())
        largest, missing = max([passing, through, abs(rate), *map(abs, flows)]), entering - rate
        small = BALANCE_ROUNDOFF * film.sides * float(net.storage.sum())
        driven = BALANCE_ROUNDOFF * film.sides * float(((net.east + net.north) * np.abs(instant.state.pressure)).sum())
        return flows, stored, rate, missing / largest if abs(missing) > small and largest > driven else 0.0
