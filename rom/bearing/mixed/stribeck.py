"""Stribeck curves: how friction, film and the asperities' share of a load change with speed."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import exp, inf

import numpy as np
import scipy

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.balance import STEEPNESS, Speed, balanced
from roughfilm.rom.bearing.mixed.film import MixedFilm, MixedState
from roughfilm.rom.bearing.mixed.lift_off import lift_off_speed
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.solve import load_loops
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.ladder.model import Progress, silent

RESOLUTION = 64
"""Cells along and across, by default."""

COARSEST, FINEST = 16, 1024

FINEST_BALANCE, COARSEST_BALANCE = 1e-10, 1e-2

TOLERANCE = 1e-6
"""Of the load that film and asperities carry together, by default."""


JUDGED = 5
"""Speeds at which half as many cells say how far off a curve is."""

EXTRAPOLATED, FARTHEST = 4, 0.4
"""Points from which the next separation is guessed, and how far its logarithm is at most from that of the last."""

POOR = 100.0
"""Times the speed by which 6ηuL/α² is the load: where walls of little shape lift off, if no speed asked for is near."""

STEP = 1e-3
"""Of the separation of touching: over which the asperities' slope is taken."""

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
"""Quantities of a point that depend on the grid and on the factors."""


@dataclass(frozen=True, kw_only=True)
class StribeckPoint:
    """A bearing under one load at one speed, walls where film and asperities carry it together.

    Forces are per width, N/m, of an infinitely wide bearing.

    Attributes
    ----------
    pressure : the load over the nominal area (of a journal diameter times width), Pa.
    speed : of the sliding wall, m/s.
    separation : α of the rigid mean planes at the narrowest place, m.
    least_gap : the mean gap there, m; the separation as long as nothing touches.
    load, film_load, contact_load : N.
    contact_share : of the load.
    friction : N; boundary friction and that of the film.
    friction_coefficient : friction over load.
    pressure_max : of the film, above ambient, Pa.
    contact_pressure_max : of the asperities, averaged over the roughness, Pa.
    contact_area : the part of the nominal area that touches.
    cavitated_fraction : the part of the film that is torn.
    balance : what the loads miss the one asked for by, relative to it.
    residual : of the film: the largest net flow into a node over the largest through a face.
    cpu_s : s.
    uncertainty : how far off quantities may be, in their units, by name; empty at points where it was not estimated.
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
    uncertainty: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class LiftOff:
    """Where the asperities just touch at the narrowest place: the film alone carries the load from this speed on.

    ``speed``, m/s, is NaN where none up to 1000 times the largest asked for lifts the wall (or, where all are low, up
    to 10⁵ times that by which 6ηuL/α² is the load), 0 where it floats at rest.
    """

    speed: float
    uncertainty: float


@dataclass(frozen=True, kw_only=True)
class StribeckCurve:
    """The points of one load in the order of their speeds, and its lift-off; ``pressure`` over the nominal area, Pa."""

    pressure: float
    points: tuple[StribeckPoint, ...]
    lift_off: LiftOff


def stribeck(
    scene: Bearing,
    speeds: Sequence[float],
    pressures: Sequence[float],
    *,
    asperities: Asperities | None = None,
    resolution: int = RESOLUTION,
    tolerance: float = TOLERANCE,
    known: Sequence[StribeckPoint] = (),
    keep: Callable[[StribeckPoint], object] = lambda _point: None,
    progress: Progress = silent,
) -> tuple[StribeckCurve, ...]:
    """Sweep the speed of a bearing with asperities at several loads.

    Parameters
    ----------
    scene : with ``asperities`` and a roughness; its speed and film do not count.
    speeds : of the sliding wall, m/s, 0 or more; in any order, each once.
    pressures : loads over the nominal area, Pa.
    asperities : of the rough wall; by default as the scene says.
    resolution : cells along and across.
    tolerance : of the balance of loads, relative.
    known : points that need not be solved again.
    keep : called with every new point as soon as it is done.

    Raises
    ------
    InputError
        If a load is more than the asperities' table or the surface can carry, naming the largest; if the pressures at
        the sides alone float the wall; for a scene without asperities.
    ConvergenceError
        If a film does not come into balance.
    """
    film = mixed_film(scene, asperities, resolution, tolerance)
    wanted = _checked(speeds, pressures)
    done = {(point.pressure, point.speed): point for point in known}
    coarse = replace(film, cells=resolution // 2)
    judged = {wanted[place] for place in np.linspace(0, len(wanted) - 1, JUDGED).round().astype(int)}
    states: dict[float, State] = {}
    curves: dict[float, list[StribeckPoint]] = {pressure: [] for pressure in sorted(pressures)}
    load_loops(scene.wide)
    for number, speed in enumerate(wanted):
        fine, rough = Speed(film=film, speed=speed), Speed(film=coarse, speed=speed)
        for count, (pressure, points) in enumerate(curves.items()):
            told = f"{speed:.4g} m/s, {pressure * 1e-6:.4g} MPa"
            progress((number + count / len(curves)) / len(wanted), told)
            before = point = done.get((pressure, speed))
            cpu = time.process_time()
            if point is None:
                guess, start = _extrapolated(points, film, fine), states.get(pressure)
                fine.steepness = rough.steepness = STEEPNESS if number == 0 else fine.steepness
                found = balanced(fine, pressure, tolerance=tolerance, guess=guess, start=start)
                states[pressure] = found.solution.state
                point = stribeck_point(found, film, pressure)
            if speed in judged and not point.uncertainty:
                near = balanced(rough, pressure, tolerance=tolerance, guess=point.separation + film.dip)
                other = stribeck_point(near, coarse, pressure)
                point = replace(point, uncertainty=uncertainties(point, other, film, fine))
            if point is not before:
                point = replace(point, cpu_s=point.cpu_s + time.process_time() - cpu)
                keep(point)
            points.append(point)
    found_curves = []
    for pressure, points in curves.items():
        progress(1.0, f"lift-off at {pressure * 1e-6:.4g} MPa")
        around = _crossing(points, film)
        lifts, other_lifts = (lift_off_speed(one, pressure, around, tolerance=tolerance) for one in (film, coarse))
        unsure = abs(lifts - other_lifts) + film.asperities.doubt_above(film.asperities.touching) * lifts
        lift_off = LiftOff(speed=lifts, uncertainty=unsure)
        found_curves.append(StribeckCurve(pressure=pressure, points=tuple(points), lift_off=lift_off))
    return tuple(found_curves)


def mixed_film(scene: Bearing, asperities: Asperities | None, resolution: int, tolerance: float) -> MixedFilm:
    """The film of a scene that tells what its asperities are.

    Raises
    ------
    InputError
        For a scene without asperities, or a resolution or tolerance out of range.
    """
    if scene.asperities is None:
        raise InputError("scene.asperities: is missing; say of what the walls are that touch")
    if not COARSEST <= resolution <= FINEST:
        raise InputError(f"resolution: got {resolution}; it must be {COARSEST} to {FINEST} cells along a side")
    if not FINEST_BALANCE <= tolerance < COARSEST_BALANCE:
        raise InputError(
            f"tolerance: got {tolerance!r}; it must be {FINEST_BALANCE:g} to {COARSEST_BALANCE:g} of the load"
        )
    wall = asperities_of(scene) if asperities is None else asperities
    return MixedFilm(scene=scene, asperities=wall, cells=resolution, accuracy=tolerance)


def stribeck_point(found: MixedState, film: MixedFilm, pressure: float) -> StribeckPoint:
    """What there is to tell of a mixed film under a load over the nominal area, Pa; without its cost."""
    separation = found.scene.geometry.film - film.dip
    load = pressure * film.area
    lowest = found.scene.lubricant.cavitation_pressure
    return StribeckPoint(
        pressure=pressure,
        speed=found.scene.motion.speed,
        separation=separation,
        least_gap=float(film.asperities.mean_gap(np.array([separation]))[0]),
        load=found.load,
        film_load=found.film_load,
        contact_load=found.contact_load,
        contact_share=found.contact_load / found.load,
        friction=found.friction,
        friction_coefficient=found.friction / found.load,
        pressure_max=float(found.solution.state.pressure.max()) + lowest,
        contact_pressure_max=found.contact.pressure_max,
        contact_area=found.contact.area_fraction,
        cavitated_fraction=found.cavitated_fraction,
        balance=abs(found.load / load - 1),
        residual=found.solution.residual,
        cpu_s=0.0,
    )


def _checked(speeds: Sequence[float], pressures: Sequence[float]) -> list[float]:
    """The speeds in order."""
    for name, values, least in (("speeds", speeds, "0 or more"), ("loads", pressures, "above 0")):
        wrong = [value for value in values if not (0 <= value < inf) or (value == 0 and name == "loads")]
        if wrong or not values:
            got = f"got {wrong[0]!r}" if wrong else "are missing"
            raise InputError(f"{name}: {got}; give numbers that are {least}, and finite")
        if len(set(values)) < len(values):
            raise InputError(f"{name}: got the same one twice; give each once")
    return sorted(speeds)


def _extrapolated(points: Sequence[StribeckPoint], walls: MixedFilm, at: Speed[MixedState]) -> float | None:
    """The film at the next speed, m, from the last points by logarithms."""
    if not points:
        return None
    dip = walls.dip
    last = at.distance(points[-1].separation + dip)
    before = [point for point in points if point.speed > 0][-EXTRAPOLATED:]
    if len(before) < 2:
        return points[-1].separation + dip
    speeds = np.log([point.speed for point in before])
    told = float(
        scipy.interpolate.BarycentricInterpolator(speeds, [at.distance(p.separation + dip) for p in before])(
            np.log(at.speed)
        )
    )
    return at.separation(min(max(told, last - FARTHEST), last + FARTHEST))


def uncertainties(
    point: StribeckPoint, other: StribeckPoint, walls: MixedFilm, at: Speed[MixedState]
) -> dict[str, float]:
    """How far off each quantity may be: what half the cells change it by, and by what factors and pressures are off.

    At second order what half the cells change is three times what is left. A film that carries δF less, and asperities
    that carry δC less than they should, are nearer by δα = -(δF + δC)/(F' + C') under the same load, and share it as
    they do there.
    """
    asperities, here = walls.asperities, np.array([point.separation])
    film, contact = point.film_load, point.contact_load
    unsure = asperities.doubt_above(point.separation)
    unsure_film, unsure_contact = unsure * abs(film), float(asperities.pressure_doubt(here)[0]) * abs(contact)
    place, step = point.separation + walls.dip, STEP * walls.touching
    shift = exp(at.distance(place))
    film_slope = at.steepness * abs(film) / shift
    contact_slope = (walls.contact_load(max(place - step, walls.closest)) - walls.contact_load(place)) / step
    slope = film_slope + contact_slope
    closer = (unsure_film + unsure_contact) / slope if slope > 0 else 0.0
    shared = (unsure_film * contact_slope + unsure_contact * film_slope) / slope if slope > 0 else 0.0
    boundary = walls.boundary_friction
    viscous = abs(point.friction - boundary * contact)
    rubbed = boundary * shared + (unsure + asperities.friction_doubt(point.separation) + closer / shift) * viscous
    relative = shared / contact if contact > 0 else 0.0
    more = {
        "separation": closer,
        "least_gap": closer,
        "film_load": shared,
        "contact_load": shared,
        "contact_share": shared / point.load,
        "friction": rubbed,
        "friction_coefficient": rubbed / point.load,
        "pressure_max": abs(point.pressure_max * shared / film) if film else 0.0,
        "contact_pressure_max": point.contact_pressure_max * relative,
        "contact_area": point.contact_area * relative,
    }
    return {name: abs(getattr(point, name) - getattr(other, name)) + more.get(name, 0.0) for name in UNCERTAIN}


def _crossing(points: Sequence[StribeckPoint], film: MixedFilm) -> float:
    """A speed near that at which a curve's separation passes that of touching, m/s, above 0.

    If none of those asked for lifts the wall, the largest of them, but at least ``POOR`` p α²/(6ηL).
    """
    thick = film.asperities.touching
    lifted = [point.speed for point in points if point.separation >= thick and point.speed > 0]
    least = POOR * points[0].pressure * thick**2 / (6 * film.scene.lubricant.viscosity * film.scene.geometry.length)
    return min(lifted) if lifted else max(*(point.speed for point in points), least)
