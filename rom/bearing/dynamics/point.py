"""The equilibrium of a bearing at a speed and a load, with its stiffness and damping."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.dynamics.whirl import (
    RATIOS,
    RATIOS_OF_MEMORY,
    At,
    Matrices,
    Whirl,
    condensed,
    grows,
    rigid_whirl,
    slow_up_to,
    whirl_of,
)
from roughfilm.rom.bearing.free.equilibrium import holding
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.free.solve import placed
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.mixed.quantities import contact_quantities
from roughfilm.rom.bearing.quantities import bearing_quantities
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.uncertainty import beyond_half_a_turn
from roughfilm.rom.cavitation.evaluation.grids import grid_uncertainty
from roughfilm.rom.cavitation.motion.coefficients import SmallMotion
from roughfilm.rom.cavitation.motion.coupled import Instant

ENTRIES: Mapping[int, tuple[str, ...]] = {1: ("",), 2: ("_xx", "_xy", "_yx", "_yy")}
"""Endings of the names of the entries of a matrix by the number of its rows."""

STATIC: Mapping[str, str] = {
    "eccentricity": "1",
    "eccentricity_x": "1",
    "eccentricity_y": "1",
    "attitude_angle": "deg",
    "film_min": "m",
    "pressure_max": "Pa",
    "power_loss": "W",
    "power_loss_per_width": "W/m",
    "side_leakage": "m^3/s",
    "sommerfeld_number": "1",
}
"""Names and units of the quantities of the equilibrium, as those of a solved bearing."""

CONTACT: Mapping[str, str] = {
    "contact_share": "1",
    "contact_load": "N",
    "contact_pressure_max": "Pa",
    "contact_area": "1",
    "least_gap": "m",
}
"""The same of walls whose asperities may touch, as those of the model ``mixed``."""

TEMPERATURES: Mapping[str, str] = {"temperature": "degC", "outlet_temperature": "degC"}
"""The same of a bearing whose lubricant has a temperature: that of the film, and of the lubricant that leaves."""

UNITS: Mapping[str, str] = {
    **{f"stiffness{entry}": "N/m" for entries in ENTRIES.values() for entry in entries},
    **{f"damping{entry}": "N*s/m" for entries in ENTRIES.values() for entry in entries},
    **{f"whirl_stiffness{entry}": "N/m" for entry in ENTRIES[2]},
    **{f"whirl_damping{entry}": "N*s/m" for entry in ENTRIES[2]},
    "slow_ratio": "1",
    **STATIC,
    **CONTACT,
    **TEMPERATURES,
    "whirl_ratio": "1",
    "critical_mass": "kg",
}
"""Units of the numbers of a point of a bearing with a width."""


@dataclass(frozen=True, kw_only=True)
class DynamicPoint:
    """The equilibrium of a bearing at a speed and a load.

    Film and asperities exert the force δF = -K δq - B δq' on a wall that moves by δq from the equilibrium: a shaft
    along x and y, a pad towards the other wall. K and B are those at the frequency of the motion, ``stiffness`` and
    ``damping`` at that which was asked for, ``whirl_stiffness`` and ``whirl_damping`` at that of the whirl; up to
    ``slow_ratio`` times the rotation, at most 10, they are those of slow motions within 5 %. Where the lubricant has a
    temperature, the film has the one at which its heat is balanced, and keeps it during the motion δq.

    Attributes
    ----------
    pressure : load over the nominal area, Pa.
    load : load, N (N/m if infinitely wide).
    speed : sliding speed, m/s, above 0.
    rotation : rotational speed ω, rad/s; 0 where nothing turns.
    numbers : value of each quantity by its name, in SI units; per width of an infinitely wide bearing.
    uncertainty : uncertainty of each of them; infinite where it is unknown.
    spectrum : entries of stiffness and damping of a shaft by their names at the frequencies ``RATIOS_OF_MEMORY`` times
        the rotation; empty for other walls.
    residual : larger of the relative residuals of the film and of the forces.
    cpu_s : CPU time, s.
    estimated_heat_transfer : heat transfer to the surroundings that is estimated, as the scene gives none, W/K (W/(m K)
        if infinitely wide); 0 where the lubricant takes away more than it does.
    leading : the input on which the temperature depends most, in words; "" without a temperature, or where it is small.
    outside : the ways in which the film is outside the range of the model; the error of the numbers is then unknown.
    """

    pressure: float
    load: float
    speed: float
    rotation: float
    numbers: Mapping[str, float]
    uncertainty: Mapping[str, float] = field(default_factory=dict)
    spectrum: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    residual: float
    cpu_s: float
    estimated_heat_transfer: float = 0.0
    leading: str = ""
    outside: tuple[str, ...] = ()

    @property
    def temperature(self) -> float | None:
        """The temperature of the film, °C; None of a lubricant without one."""
        return self.numbers.get("temperature")

    @property
    def stiffness(self) -> Array:
        """K, N/m (N/m² if infinitely wide), shape (2, 2) of a shaft: rows are forces, columns displacements."""
        return self._matrix("stiffness")

    @property
    def damping(self) -> Array:
        """B, N s/m (N s/m² if infinitely wide), shape (2, 2) of a shaft."""
        return self._matrix("damping")

    def _matrix(self, name: str) -> Array:
        count = 1 if name in self.numbers else 2
        return np.array([self.numbers[f"{name}{entry}"] for entry in ENTRIES[count]]).reshape(count, count)

    def __getitem__(self, name: str) -> Quantity:
        """A quantity by its name, with the unit of a bearing with a width."""
        uncertainty = self.uncertainty.get(name, math.inf)
        return Quantity(
            value=self.numbers[name], unit=UNITS[name], uncertainty=uncertainty if math.isfinite(uncertainty) else None
        )


@dataclass(frozen=True, kw_only=True)
class GridPoint:
    """The numbers of a point on one grid without the whirl, and whirl and spectrum, which only a shaft has."""

    cells: float
    numbers: Mapping[str, float]
    whirl: Whirl | None
    spectrum: Mapping[str, tuple[float, ...]] = field(default_factory=dict)


def changes_of(name: str, own: GridPoint, others: Sequence[GridPoint]) -> list[float]:
    """How much a number, or an entry of the whirl, of other points differs from that of a point; none without it."""
    if name in own.numbers:
        return [abs(other.numbers[name] - own.numbers[name]) for other in others]
    return [] if own.whirl is None else [abs(getattr(one.whirl, name) - getattr(own.whirl, name)) for one in others]


def grid_point(film: FreeFilm, instant: Instant, ratio: float) -> GridPoint:
    """The numbers of an equilibrium on its grid.

    Parameters
    ----------
    ratio : frequency of the motion, of stiffness and damping, over that of the rotation.
    """
    scene, part = film.scene, film.free | ~film.wall.turns
    kept, among = ~film.wall.turns[part], np.ix_(part, part)
    rotation = rotation_of(scene, scene.motion.speed)
    motion = SmallMotion(film.solved, instant, speed=film.solved.problem.speed)
    aligned = holding(film, film.load)

    @cache
    def whole(frequency: float) -> Matrices:
        """K and B of all coordinates."""
        if frequency == 0:
            return (motion.slow.stiffness + aligned)[among], motion.slow.damping[among]
        impedance = motion.impedance(frequency)[among]
        return impedance.real + aligned[among], impedance.imag / frequency

    def at(frequency: float) -> Matrices:
        return condensed(*whole(frequency), kept, frequency)

    numbers = entries_of(at(ratio * rotation))
    static = static_quantities(film, instant)
    power = "power_loss" if scene.wide else "power_loss_per_width"
    numbers |= {name: static[name].value for name in (*STATIC, *CONTACT) if name in static and name != power}
    whirl, spectrum = None, {}
    if isinstance(scene.geometry, Shaft):
        entries = [entries_of(at(float(ratio) * rotation)) for ratio in RATIOS_OF_MEMORY]
        spectrum = {name: tuple(one[name] for one in entries) for name in entries[0]}
        whirl = _whirl(at, whole(0.0), kept, rotation, has_memory=motion.has_memory)
        frequency = math.sqrt(whirl.frequency_squared) if whirl.frequency_squared > 0 else math.nan
        at_whirl = at(frequency) if frequency > 0 else (np.full((2, 2), math.nan),) * 2
        numbers |= entries_of(at_whirl, beginning="whirl_")
        numbers["slow_ratio"] = slow_up_to(at, rotation, RATIOS_OF_MEMORY if motion.has_memory else RATIOS)
    cells = math.prod(count for count in film.whole.grid.shape if count > 1) ** 0.5
    return GridPoint(cells=cells, numbers=numbers, whirl=whirl, spectrum=spectrum)


def _whirl(at: At, slow: Matrices, kept: NDArray[np.bool_], rotation: float, *, has_memory: bool) -> Whirl:
    """The whirl of a rigid rotor on a film with pads that follow it."""
    if kept.all() and not has_memory:
        return rigid_whirl(*slow)
    stiffness, damping = (matrix[np.ix_(~kept, ~kept)] for matrix in slow)
    if not kept.all() and grows(stiffness, damping, rotation):
        return Whirl(inverse_mass=math.inf, frequency_squared=math.nan)
    return whirl_of(at, rotation, RATIOS_OF_MEMORY if has_memory else RATIOS)


def entries_of(matrices: Matrices, beginning: str = "") -> dict[str, float]:
    """The entries of stiffness and damping by their names, which begin with some letters."""
    return {
        f"{beginning}{name}": float(value)
        for matrix, values in zip(("stiffness", "damping"), matrices, strict=True)
        for name, value in zip(named(matrix, len(values)), values.flat, strict=True)
    }


def static_quantities(film: FreeFilm, instant: Instant) -> dict[str, Quantity]:
    """The quantities of an equilibrium, as those of a solved bearing."""
    quantities = bearing_quantities if film.scene.asperities is None else contact_quantities
    return quantities(placed(film, instant), film.solution(instant))


def named(matrix: str, rows: int) -> list[str]:
    """The names of the entries of a matrix, row by row."""
    return [f"{matrix}{entry}" for entry in ENTRIES[rows]]


def rotation_of(scene: Bearing, speed: float) -> float:
    """The rotational speed ω of a sliding speed, rad/s; 0 where nothing turns."""
    radius = scene.turning_radius
    return 0.0 if radius is None else abs(speed) / radius


def finished(
    points: Sequence[GridPoint],
    rotation: float,
    of_inputs: Callable[[str], float] = lambda _name: 0.0,
    balance: float = 0.0,
) -> tuple[dict[str, float], dict[str, float]]:
    """The numbers on the finest grid and their uncertainties.

    Those of mass and frequency of a whirl are had from 1/M and ν², which are finite where there is no whirl.

    Parameters
    ----------
    points : the point on each grid, from fine to coarse; a single one has no uncertainty.
    rotation : rotational speed ω, rad/s.
    of_inputs : the uncertainty of a number, or of an entry of the whirl, by flow factors, contact pressures and an
        estimated heat transfer.
    balance : relative error of the load.
    """
    cells, finest = [point.cells for point in points], points[0]
    numbers = dict(finest.numbers)
    uncertainty = {
        name: grid_uncertainty(cells, [point.numbers[name] for point in points])
        + of_inputs(name)
        + balance * abs(value)
        if len(points) > 1 and all(math.isfinite(point.numbers[name]) for point in points)
        else math.inf
        for name, value in numbers.items()
    }
    uncertainty |= dict.fromkeys(beyond_half_a_turn(uncertainty), math.inf)
    whirls = [point.whirl for point in points if point.whirl is not None]
    if not whirls:
        return numbers, uncertainty
    inverse, squared = ([getattr(whirl, name) for whirl in whirls] for name in ("inverse_mass", "frequency_squared"))
    numbers["critical_mass"] = 1 / inverse[0] if inverse[0] > 0 else math.inf
    numbers["whirl_ratio"] = math.sqrt(max(squared[0], 0.0)) / rotation if math.isfinite(squared[0]) else math.nan
    by_inputs = of_inputs("inverse_mass"), of_inputs("frequency_squared")
    uncertainty["critical_mass"] = _after(
        lambda value: 1 / value if value > 0 else math.inf, cells, inverse, by_inputs[0]
    )
    uncertainty["whirl_ratio"] = _after(
        lambda value: math.sqrt(max(value, 0.0)) / rotation, cells, squared, by_inputs[1]
    )
    return numbers, uncertainty


def _after(function: Callable[[float], float], cells: Sequence[float], values: Sequence[float], more: float) -> float:
    """The uncertainty of a monotonic function of a value, from both ends of its interval; infinite if it is unknown.

    ``more`` is the uncertainty of the value besides that of the grid.
    """
    if len(values) < 2 or not all(map(math.isfinite, (*values, more))):
        return math.inf
    here, error = function(values[0]), grid_uncertainty(cells, values) + more
    ends = function(values[0] - error), function(values[0] + error)
    if here == ends[0] == ends[1]:
        return 0.0
    return max(abs(end - here) for end in ends) if math.isfinite(here) else math.inf
