"""Stribeck curves: friction, film thickness and contact load over speed."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from math import inf, isclose

import numpy as np

from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.timing import imports_apart, working_time
from roughfilm.contact.foundation.units import ZERO_CELSIUS
from roughfilm.rom.bearing.equilibrium.overload import refuse_overload
from roughfilm.rom.bearing.flash import FlashTemperature, flash_temperature
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.film import MixedFilm, MixedState
from roughfilm.rom.bearing.mixed.search.heated import HeatedSearch, leading_of, with_temperature
from roughfilm.rom.bearing.mixed.search.separation import Search, SeparationSearch, Slopes
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.outside import film_outside
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.thermal.exchange import ESTIMATED
from roughfilm.rom.cavitation.evaluation.peak import peak_pressure
from roughfilm.rom.ladder.model import Progress, silent

RESOLUTION = 64
"""Default number of cells along and across."""

MIN_CELLS = 16
"""Smallest number of cells along a side."""

MAX_CELLS = 1024
"""Largest number of cells along a side."""

LOAD_TOLERANCE = 1e-6
"""Default relative error of the load at which the search stops."""

MIN_TOLERANCE = 1e-10
"""Smallest tolerance of the load."""

MAX_TOLERANCE = 1e-2
"""Upper limit of the tolerance of the load."""

UNCERTAINTY_SPEEDS = 5
"""Number of speeds at which the uncertainty is estimated with half as many cells, besides that of the scene."""

SAME_SPEED = 1e-9
"""Relative difference up to which a speed of a curve is that of the scene."""

LIFT_OFF_SPEED_RATIO = 100.0
"""Guess of the lift-off speed over the speed at which 6ηuL/α² equals the load, if no requested speed lifts the wall."""

UNCERTAIN = (
    "separation",
    "least_gap",
    "film_load",
    "contact_load",
    "contact_share",
    "friction",
    "friction_coefficient",
    "pressure_max",
    "contact_pressure_max",
    "contact_area",
    "cavitated_fraction",
)
"""Quantities of a point that have an uncertainty."""

TEMPERATURES = ("temperature", "outlet_temperature")
"""The temperatures of a point of a bearing whose lubricant has one, which have an uncertainty too."""


@dataclass(frozen=True, kw_only=True)
class StribeckPoint:
    """The equilibrium of a bearing under one load at one speed.

    Forces of an infinitely wide bearing are per width, N/m.

    Attributes
    ----------
    pressure : load over the nominal area (of a journal bearing: diameter times width), Pa.
    speed : sliding speed, m/s.
    separation : separation α of the undeformed mean planes at the narrowest place, m.
    least_gap : mean gap at the narrowest place, m, which equals the separation without contact.
    load, film_load, contact_load : load, its part carried by the film, and its part carried by asperities, N.
    contact_share : contact load over load.
    friction : boundary friction plus friction of the film, N.
    friction_coefficient : friction over load.
    pressure_max : maximum pressure of the film above ambient, Pa.
    contact_pressure_max : maximum contact pressure, averaged over the roughness, Pa.
    contact_area : fraction of the nominal area in contact.
    cavitated_fraction : cavitated fraction of the film.
    temperature : effective temperature of the film by its heat balance, °C; None where the scene has no temperature.
    outlet_temperature : temperature of the lubricant that leaves, °C; None where the scene has no temperature.
    estimated_heat_transfer : heat transfer to the surroundings that is estimated, as the scene gives none, W/K (W/(m K)
        if infinitely wide); None where the scene has no temperature, 0 where the lubricant takes away more.
    leading : the input on which the temperature depends most, in words; "" without a temperature, or where it is small.
    flash_temperature, flash_temperature_low, flash_temperature_high : estimate of how much hotter the spots in contact
        are than the walls at the largest contact pressure, and its range, K; None without ``asperities.solid_heat`` and
        where nothing touches.
    balance : relative error of the load.
    residual : residual of the film: the largest net flow into a node over the largest flow through a face.
    cpu_s : CPU time, s.
    uncertainty : uncertainty of quantities by name, in their units; empty where it was not estimated.
    scatter : for a wall that is known in several windows, the half width of the 95 % confidence interval of a quantity
        by its name, from how the windows differ; it lacks quantities whose scatter is unknown, for one surface all.
    window_interval : 95 % prediction interval of a quantity for a bearing whose wall repeats one further window.
    outside : the ways in which the film is outside the range of the model; the error of the numbers is then unknown.
    """

    pressure: float
    speed: float
    separation: float
    least_gap: float
    load: float
    film_load: float
    contact_load: float
    contact_share: float
    friction: float
    friction_coefficient: float
    pressure_max: float
    contact_pressure_max: float
    contact_area: float
    cavitated_fraction: float
    balance: float
    residual: float
    cpu_s: float
    temperature: float | None = None
    outlet_temperature: float | None = None
    estimated_heat_transfer: float | None = None
    flash_temperature: float | None = None
    flash_temperature_low: float | None = None
    flash_temperature_high: float | None = None
    uncertainty: Mapping[str, float] = field(default_factory=dict)
    scatter: Mapping[str, float] = field(default_factory=dict)
    window_interval: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    leading: str = ""
    outside: tuple[str, ...] = ()

    @property
    def flash(self) -> FlashTemperature | None:
        """The flash temperature with its range; None where it was not estimated."""
        mean, low, high = self.flash_temperature, self.flash_temperature_low, self.flash_temperature_high
        return None if mean is None or low is None or high is None else FlashTemperature(mean=mean, low=low, high=high)


@dataclass(frozen=True, kw_only=True)
class LiftOff:
    """The lift-off speed with its uncertainty, m/s, above which the film alone carries the load.

    It is 0 if the film carries the load at rest. It is NaN if the wall does not lift off at 1000 times the largest
    requested speed, or at 10⁵ times the speed at which 6ηuL/α² equals the load, whichever is larger. ``scatter`` and
    ``window_interval`` are those of the mean over several windows; None for one surface, and where they are unknown.
    """

    speed: float
    uncertainty: float
    scatter: float | None = None
    window_interval: tuple[float, float] | None = None


NEVER_TOUCHING = LiftOff(speed=0.0, uncertainty=0.0)
"""The lift-off speed of walls without asperities, whose load the film carries at any speed of the curve."""


@dataclass(frozen=True, kw_only=True)
class StribeckCurve:
    """The points of a load over the nominal area, ``pressure``, Pa, in order of speed, and the lift-off speed."""

    pressure: float
    points: tuple[StribeckPoint, ...]
    lift_off: LiftOff

    __repr__ = brief


@imports_apart()
def stribeck(
    scene: Bearing,
    speeds: Sequence[float],
    pressures: Sequence[float],
    *,
    asperities: Asperities | None = None,
    resolution: int = RESOLUTION,
    tolerance: float = LOAD_TOLERANCE,
    known: Sequence[StribeckPoint] = (),
    keep: Callable[[StribeckPoint], object] = lambda _point: None,
    progress: Progress = silent,
) -> tuple[StribeckCurve, ...]:
    """Compute Stribeck curves of a bearing at several loads.

    Without asperities the film alone carries the load, the contact share is 0, and the curve leaves out the speeds at
    which no film carries it. If the lubricant of the scene has a temperature (``thermoviscosity``, ``density`` and
    ``heat_capacity``), each film has the one at which its heat is balanced, with the friction of the asperities in it
    (:func:`roughfilm.rom.bearing.thermal.exchange.temperatures`). With ``asperities.solid_heat`` each point has an
    estimate of the flash temperature of its asperities (:func:`roughfilm.rom.bearing.flash.rise_of_spots`).

    Parameters
    ----------
    scene : the bearing; its film thickness has no effect, and its speed only one on where there are uncertainties.
    speeds : sliding speeds, m/s, 0 or more, without asperities above 0, in any order without repetition.
    pressures : loads over the nominal area, Pa.
    asperities : asperities of the rough wall; by default those of the scene.
    resolution : number of cells along and across.
    tolerance : relative error of the load.
    known : points that are not solved again.
    keep : called with each new point.

    Raises
    ------
    InputError
        If the asperities cannot carry a load, if the pressures at the sides alone carry more than a load, if no speed
        of a bearing without asperities carries a load, or if the lubricant thins with shear.
    ConvergenceError
        If a film or the load does not converge.
    """
    scene.check_newtonian("a Stribeck curve")
    ordered = _checked(speeds, pressures)
    search = with_temperature(curve_search(scene, asperities, ordered, pressures, resolution, tolerance))
    touches = scene.asperities is not None
    done = {(point.pressure, point.speed): point for point in known}
    estimated = {ordered[i] for i in np.linspace(0, len(ordered) - 1, UNCERTAINTY_SPEEDS).round().astype(int)}
    estimated |= {speed for speed in ordered if isclose(speed, abs(scene.motion.speed), rel_tol=SAME_SPEED)}
    curves: dict[float, list[StribeckPoint]] = {pressure: [] for pressure in sorted(pressures)}
    refused: dict[float, InputError | ConvergenceError] = {}
    for number, speed in enumerate(ordered):
        for count, (pressure, points) in enumerate(curves.items()):
            words = f"{speed:.4g} m/s, {pressure * 1e-6:.4g} MPa"
            progress((number + count / len(curves)) / len(ordered), words)
            point = before = done.get((pressure, speed))
            cpu, here = working_time(), search.anew()  # a resumed curve has the points of one that was not stopped
            if point is None:
                try:
                    state = here.solved(speed, pressure, [(one.speed, one.separation) for one in points])
                except (InputError, ConvergenceError) as error:
                    if touches:
                        raise
                    if number == 0 and not any(pressure == kept for kept, _speed in done):
                        refuse_overload(partial(_solved, search, pressure), ordered)
                    refused[pressure] = error
                    continue
                point = _with_flash(stribeck_point(state, here, pressure), state.scene)
            if speed in estimated and not point.uncertainty:
                point = replace(point, uncertainty=_uncertainty(point, here))
            if point is not before:
                point = replace(point, cpu_s=point.cpu_s + working_time() - cpu)
                keep(point)
            points.append(point)
    finished = []
    for pressure, points in curves.items():
        if not points:
            raise refused[pressure]
        if not touches:
            finished.append(StribeckCurve(pressure=pressure, points=tuple(points), lift_off=NEVER_TOUCHING))
            continue
        progress(1.0, f"lift-off at {pressure * 1e-6:.4g} MPa")
        lift_off = _lift_off(search, points)
        finished.append(StribeckCurve(pressure=pressure, points=tuple(points), lift_off=lift_off))
    return tuple(finished)


def _solved(search: Search, pressure: float, speed: float) -> MixedState:
    return search.solved(speed, pressure, ())


def curve_search(
    scene: Bearing,
    asperities: Asperities | None,
    speeds: Sequence[float],
    pressures: Sequence[float],
    resolution: int,
    tolerance: float,
) -> Search:
    """The films of a curve: mixed ones of a scene with asperities, and those of walls that never touch of others.

    The search is over the separation of the walls, or over the place of a wall that moves freely.

    Raises
    ------
    InputError
        If the resolution or tolerance is out of range, or a speed is 0 without asperities.
    """
    _check_range(resolution, tolerance)
    if scene.asperities is not None:
        wall = asperities_of(scene) if asperities is None else asperities
        film = MixedFilm(scene=scene, asperities=wall, cells=resolution, accuracy=tolerance)
    elif min(speeds) == 0:
        raise InputError(
            "speeds: got 0; without sliding a film without asperities carries no load, give speeds above 0 or add "
            "[asperities] to the scene"
        )
    else:
        from roughfilm.rom.bearing.mixed.parted import parted_film  # only curves without asperities need it

        film = parted_film(scene, speeds, pressures, resolution, tolerance)
    if not isinstance(scene.geometry, MovingWall):
        return SeparationSearch(film=film)
    from roughfilm.rom.bearing.mixed.search.place import PlaceSearch  # only walls that move freely need it

    return PlaceSearch(
        scene=scene,
        asperities=film.asperities,
        cells=resolution,
        residual=film.residual,
        accuracy=tolerance,
        film=film.film,
    )


def _uncertainty(point: StribeckPoint, search: Search) -> dict[str, float]:
    """The uncertainty of a point from a grid with half as many cells; empty if that grid does not carry the load.

    Where a heat transfer is estimated, the point is sought on that grid with both ends of its range too. It is empty if
    one of them has no film.
    """
    coarse = search.coarser()
    try:
        near = coarse.solved(point.speed, point.pressure, [(point.speed, point.separation)])
    except (InputError, ConvergenceError):
        if search.scene.asperities is not None:
            raise
        return {}
    slopes = search.slopes(point.speed, point.pressure, point.separation, point.film_load)
    middle = stribeck_point(near, coarse, point.pressure)
    found = uncertainties(point, middle, search, slopes)
    if not (isinstance(coarse, HeatedSearch) and middle.estimated_heat_transfer):
        return found
    ends = []
    for part in ESTIMATED:
        other = coarse.with_part(part)
        try:
            state = other.solved(point.speed, point.pressure, [(middle.speed, middle.separation)])
        except (InputError, ConvergenceError):
            return {}
        ends.append(stribeck_point(state, other, point.pressure))
    return {
        name: one + max(abs(getattr(end, name) - getattr(middle, name)) for end in ends) for name, one in found.items()
    }


def _lift_off(search: Search, points: Sequence[StribeckPoint]) -> LiftOff:
    """The lift-off speed under the load of some points, with its uncertainty as that of a point."""
    pressure, near = points[0].pressure, _lift_off_guess(points, search)
    search, coarse = search.anew(), search.coarser()
    speed, coarse_speed = (one.lift_off(pressure, near) for one in (search, coarse))
    error = abs(speed - coarse_speed) + search.asperities.factor_uncertainty(search.asperities.touching) * speed
    if isinstance(coarse, HeatedSearch) and any(point.estimated_heat_transfer for point in points):
        try:
            ends = [coarse.with_part(part).lift_off(pressure, near) for part in ESTIMATED]
        except (InputError, ConvergenceError):
            ends = [inf]
        error += max(abs(end - coarse_speed) for end in ends)
    return LiftOff(speed=speed, uncertainty=error)


def _check_range(resolution: int, tolerance: float) -> None:
    """Raise InputError if the resolution or the tolerance is out of range."""
    if not MIN_CELLS <= resolution <= MAX_CELLS:
        raise InputError(f"resolution: got {resolution}; it must be {MIN_CELLS} to {MAX_CELLS} cells along a side")
    if not MIN_TOLERANCE <= tolerance < MAX_TOLERANCE:
        raise InputError(
            f"tolerance: got {tolerance!r}; it must be at least {MIN_TOLERANCE:g} and below {MAX_TOLERANCE:g}"
        )


def stribeck_point(state: MixedState, search: Search, pressure: float) -> StribeckPoint:
    """The point of a mixed film under a load over the nominal area, Pa, without its CPU time."""
    separation = state.scene.geometry.thinnest - search.dip
    load = pressure * search.area
    lowest, heated = state.scene.lubricant.cavitation_pressure, state.temperatures
    return StribeckPoint(
        pressure=pressure,
        speed=state.scene.motion.speed,
        separation=separation,
        least_gap=float(search.asperities.mean_gap(np.array([separation]))[0]),
        load=state.load,
        film_load=state.film_load,
        contact_load=state.contact_load,
        contact_share=state.contact_load / state.load,
        friction=state.friction,
        friction_coefficient=state.friction / state.load,
        pressure_max=peak_pressure(state.solution) + lowest,
        contact_pressure_max=state.contact.pressure_max,
        contact_area=state.contact.area_fraction,
        cavitated_fraction=state.cavitated_fraction,
        balance=abs(state.load / load - 1),
        residual=state.solution.residual,
        cpu_s=0.0,
        temperature=None if heated is None else heated.effective - ZERO_CELSIUS,
        outlet_temperature=None if heated is None else heated.outlet - ZERO_CELSIUS,
        estimated_heat_transfer=None if heated is None else heated.estimated,
        leading=leading_of(state, search.scene),
        outside=(
            *film_outside(state.scene, state.solution),
            *search.asperities.spot_pressures(separation).outside,
            *([] if heated is None else search.scene.lubricant.beyond(heated.effective, heated.effective)),
        ),
    )


def _with_flash(point: StribeckPoint, scene: Bearing) -> StribeckPoint:
    """The point with the flash temperature of its asperities, if the scene at this speed has solids that conduct."""
    flash = flash_temperature(scene, point.contact_pressure_max, scene.boundary_friction)
    if flash is None:
        return point
    return replace(
        point,
        flash_temperature=flash.mean,
        flash_temperature_low=flash.low,
        flash_temperature_high=flash.high,
    )


def _checked(speeds: Sequence[float], pressures: Sequence[float]) -> list[float]:
    """The speeds in increasing order; raises InputError for speeds or loads out of range."""
    for name, values, least in (("speeds", speeds, "0 or more"), ("loads", pressures, "above 0")):
        wrong = [value for value in values if not (0 <= value < inf) or (value == 0 and name == "loads")]
        if wrong or not values:
            got = f"got {wrong[0]!r}" if wrong else "are missing"
            raise InputError(f"{name}: {got}; give finite numbers that are {least}")
        if len(set(values)) < len(values):
            raise InputError(f"{name}: got the same number twice; give each once")
    return sorted(speeds)


def uncertainties(point: StribeckPoint, other: StribeckPoint, search: Search, slopes: Slopes) -> dict[str, float]:
    """The uncertainty of each quantity: its change with half the cells, plus that of factors and contact pressures.

    At second order the change with half the cells is three times the remaining error. Errors δF and δC of the loads of
    film and asperities at constant separation change the separation under a constant load by δα = -(δF + δC)/(F' + C').
    Errors of the flow factors change the heat and the flows, and so the temperature T by up to twice their part of its
    rise, which changes the load of the film by |d ln η/dT| δT.
    """
    asperities, here = search.asperities, np.array([point.separation])
    film, contact = point.film_load, point.contact_load
    relative_factors = asperities.factor_uncertainty(point.separation) + slopes.left_out
    of_temperature = 0.0
    if point.temperature is not None:
        lubricant, at = search.scene.lubricant, point.temperature + ZERO_CELSIUS
        viscosity, fall = (float(one[0]) for one in lubricant.viscosity_at(np.array([at])))
        of_temperature = 2 * relative_factors * abs(at - lubricant.liquid.temperature)
        relative_factors += abs(fall / viscosity) * of_temperature
    film_error, contact_error = (
        relative_factors * abs(film),
        float(asperities.pressure_uncertainty(here)[0]) * abs(contact),
    )
    slope = slopes.film + slopes.contact
    of_separation = (film_error + contact_error) / slope if slope > 0 else 0.0
    of_loads = (film_error * slopes.contact + contact_error * slopes.film) / slope if slope > 0 else 0.0
    boundary = search.scene.boundary_friction
    viscous = abs(point.friction - boundary * contact)
    relative_shear = asperities.friction_uncertainty(point.separation)
    of_friction = boundary * of_loads + (relative_factors + relative_shear + of_separation / slopes.length) * viscous
    relative = of_loads / contact if contact > 0 else 0.0
    of_factors = {
        "separation": of_separation,
        "least_gap": of_separation,
        "film_load": of_loads,
        "contact_load": of_loads,
        "contact_share": of_loads / point.load,
        "friction": of_friction,
        "friction_coefficient": of_friction / point.load,
        "pressure_max": abs(point.pressure_max * of_loads / film) if film else 0.0,
        "contact_pressure_max": point.contact_pressure_max * relative,
        "contact_area": point.contact_area * relative,
        **dict.fromkeys(TEMPERATURES, of_temperature),
    }
    names = UNCERTAIN if point.temperature is None else (*UNCERTAIN, *TEMPERATURES)
    return {name: abs(getattr(point, name) - getattr(other, name)) + of_factors.get(name, 0.0) for name in names}


def _lift_off_guess(points: Sequence[StribeckPoint], search: Search) -> float:
    """The smallest requested speed that lifts the wall, m/s.

    If there is none, the largest requested speed, but at least ``LIFT_OFF_SPEED_RATIO`` p α²/(6ηL).
    """
    thick = search.asperities.touching
    lifted = [point.speed for point in points if point.separation >= thick and point.speed > 0]
    least = (
        LIFT_OFF_SPEED_RATIO
        * points[0].pressure
        * thick**2
        / (6 * search.scene.lubricant.viscosity * search.scene.geometry.length)
    )
    return min(lifted) if lifted else max(*(point.speed for point in points), least)
