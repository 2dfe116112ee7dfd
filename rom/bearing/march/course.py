"""What moves a bearing in time: speed, loads, path and body of a scene as functions of time."""

import math
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.free.equilibrium import equilibrium, holding
from roughfilm.rom.bearing.free.film import FreeFilm, free_film
from roughfilm.rom.bearing.free.walls import wall_of
from roughfilm.rom.bearing.geometry.lobes import DOWN, Lobes
from roughfilm.rom.bearing.geometry.pivoted import Pivoted, PivotedSector, Tilting
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.march.rough_walls import Walls
from roughfilm.rom.bearing.moving.body import Body, Start
from roughfilm.rom.bearing.moving.over_time import Curve
from roughfilm.rom.bearing.scene import Bearing, BearingLoad
from roughfilm.rom.cavitation.motion.coupled import Drive, settled
from roughfilm.rom.cavitation.motion.march import Course, Moving, begun
from roughfilm.rom.cavitation.motion.past import held

TURNS = 20
"""Turns of the shaft, or passages of the sliding wall, after which a march without a table ends."""

PERIODS = 5
"""Repetitions of a table after which a march ends."""

CLOSED = 0.9
"""Part of the film that a constant approach closes in a march without an end."""

FIRST_NARROWING = 0.5
"""Slope times length of a pad from which its equilibrium is sought, over the given film at its pivot."""

FIRST_CHANGE = 1e-4
"""Largest relative change of the film before the first time, by which a wall that moves squeezes it."""

STEPS_PER_TURN = 20
"""Least number of steps in a turn of the shaft."""

STEPS_PER_TABLE = 50
"""Least number of steps over a table, or over a march without one."""


@dataclass(frozen=True, kw_only=True)
class Duty:
    """The motion of a bearing: what is given over time, and which coordinates move freely.

    Attributes
    ----------
    scene : the bearing.
    """

    scene: Bearing

    @cached_property
    def curves(self) -> dict[str, Curve]:
        """The columns of the table over time; none without a table."""
        table = self.scene.motion.over_time
        return {} if table is None else dict(table.table.curves)

    @cached_property
    def units(self) -> dict[str, str]:
        """The SI units of the columns."""
        table = self.scene.motion.over_time
        return {} if table is None else dict(table.table.units)

    @property
    def begin(self) -> float:
        """The first time, s: that of the table, or 0."""
        return next(iter(self.curves.values())).first if self.curves else 0.0

    @property
    def period(self) -> float | None:
        """The time after which the table repeats, s; that of a turn with an unbalance alone; None without one."""
        table = self.scene.motion.over_time
        if table is not None:
            return table.period
        return self.turn if self.body.unbalance is not None else None

    @property
    def turn(self) -> float | None:
        """The time of a turn of the shaft, or in which the sliding wall passes the film, s; None without sliding."""
        speed = abs(self.scene.motion.speed)
        return self.scene.geometry.length / speed if speed > 0 else None

    @property
    def body(self) -> Body:
        """The body; one without mass if the scene has none."""
        return self.scene.body or Body()

    @property
    def lobes(self) -> bool:
        """Whether the wall is a shaft in lobes."""
        return isinstance(self.scene.geometry, Lobes)

    @property
    def pivoted(self) -> Pivoted | PivotedSector | None:
        """The pad about a pivot; None of another wall."""
        geometry = self.scene.geometry
        return geometry if isinstance(geometry, Pivoted | PivotedSector) else None

    @property
    def approach(self) -> float:
        """The velocity at which the walls approach each other, m/s; 0 without one."""
        return float(getattr(self.scene.motion, "approach", None) or 0.0)

    @property
    def given_path(self) -> bool:
        """Whether the position of the shaft, or the film of another wall, is given."""
        if {"film", "eccentricity_x"} & self.curves.keys() or self.approach:
            return True
        return self.scene.load is None and not {"load", "load_x"} & self.curves.keys()

    @property
    def changes(self) -> bool:
        """Whether anything is given that changes in time."""
        return bool(self.curves) or self.approach != 0 or self.body.unbalance is not None

    def speed(self, time: float) -> float:
        """The sliding speed with its sign, m/s (rad/s where x is an angle)."""
        radius = self.scene.turning_radius or 1.0
        polar = not self.lobes and self.scene.turning_radius is not None
        curve = self.curves.get("speed")
        if curve is None:
            return self.scene.motion.speed / (radius if polar else 1.0)
        value = curve(time)
        if self.units["speed"] == "rad/s":
            return value if polar else value * radius
        return value / radius if polar else value

    def sliding_speed(self, time: float) -> float:
        """The sliding speed as that of a scene, m/s."""
        return self.speed(time) * (1.0 if self.lobes else self.scene.turning_radius or 1.0)

    def turned_by(self, time: float) -> tuple[float, float, float]:
        """The angle of the shaft since the first time, rad, its rotational speed, rad/s, and acceleration, rad/s²."""
        radius, curve = self.scene.turning_radius or 1.0, self.curves.get("speed")
        if curve is None:
            omega = self.scene.motion.speed / radius
            return omega * (time - self.begin), omega, 0.0
        scale = 1.0 if self.units["speed"] == "rad/s" else 1 / radius
        return scale * curve.since_first(time), scale * curve(time), scale * curve(time, 1)

    def load(self, time: float) -> Array:
        """The load on each coordinate, N (N m of an angle; per width if infinitely wide), without an unbalance.

        Coordinates of a pad that tilts across the sliding are three, also where a symmetric film has the first two.
        """
        curves, count = self.curves, len(wall_names(self.scene))
        force = np.zeros(count)
        if "load_x" in curves:
            force[:2] = curves["load_x"](time), curves["load_y"](time)
            return force
        given = self.scene.load
        if "load" in curves:
            size = curves["load"](time) / (self.scene.pieces or 1)
        elif given is not None:
            size = (self.scene.load_pressure or 0.0) * self.scene.nominal_area
        else:
            size = 0.0
        if self.pivoted is not None:
            return self.pivoted.forces(size, self.moments(time))
        if not self.lobes:
            force[0] = -size
            return force
        angle = curves["angle"](time) if "angle" in curves else -math.pi / 2 if given is None else given.angle
        force[:2] = size * math.cos(angle), size * math.sin(angle)
        return force

    def moments(self, time: float) -> tuple[float, float]:
        """The moments on a pad about the axes along x and y through its pivot, N m."""
        curves, given = self.curves, self.scene.load
        about_x, about_y = (
            curves[name](time) if name in curves else 0.0 if given is None else float(getattr(given, name))
            for name in ("moment_x", "moment_y")
        )
        return about_x, about_y

    def steady_load(self, time: float) -> BearingLoad | None:
        """The load at a time as that of a steady bearing; None without a force."""
        force, about = self.load(time), self.moments(time)
        size = float(np.hypot(*force[:2])) if self.lobes else abs(float(force[0]))
        if size == 0:
            return None
        return BearingLoad.model_construct(
            pressure=size / self.scene.nominal_area,
            angle=math.atan2(force[1], force[0]) if self.lobes else DOWN,
            moment_x=about[0],
            moment_y=about[1],
        )

    def force(self, time: float) -> Array:
        """The load on each coordinate with that of the unbalance, m e (ω² (cos φ, sin φ) + ω̇ (sin φ, -cos φ))."""
        force, unbalance = self.load(time), self.body.unbalance
        if unbalance is not None:
            angle, omega, change = self.turned_by(time)
            along, up = math.cos(angle), math.sin(angle)
            force[:2] += unbalance * np.array([omega**2 * along + change * up, omega**2 * up - change * along])
        return force

    def place(self, time: float, film: FreeFilm) -> Array:
        """The coordinates, of which those that are given have an effect."""
        place, curves = film.wall.place.copy(), self.curves
        if "eccentricity_x" in curves:
            place[:2] = film.wall.unit[0] * np.array([curves["eccentricity_x"](time), curves["eccentricity_y"](time)])
        elif "film" in curves:
            place[0] = curves["film"](time)
        elif self.approach:
            place += (time - self.begin) * self.closing(place.size)
        return place

    def closing(self, count: int) -> Array:
        """The velocity of the coordinates by which the walls approach each other, m/s; of a shaft from its inlet."""
        velocity, geometry = np.zeros(count), self.scene.geometry
        if isinstance(geometry, Lobes):
            velocity[:2] = self.approach * math.cos(geometry.first), self.approach * math.sin(geometry.first)
        else:
            velocity[0] = -self.approach
        return velocity

    def first_velocity(self, film: FreeFilm) -> Array:
        """The velocity of the given coordinates at the first time, m/s; 0 of those that move freely."""
        velocity, curves = np.zeros(film.wall.place.size), self.curves
        if "eccentricity_x" in curves:
            rates = [curves[name].cubic(self.begin, 1) for name in ("eccentricity_x", "eccentricity_y")]
            velocity[:2] = film.wall.unit[0] * np.array(rates)
        elif "film" in curves:
            velocity[0] = curves["film"].cubic(self.begin, 1)
        elif self.approach:
            velocity = self.closing(velocity.size)
        return velocity

    def free(self, film: FreeFilm) -> NDArray[np.bool_]:
        """Whether each coordinate moves as its forces make it move."""
        geometry = self.scene.geometry
        tilted = isinstance(geometry, MovingWall) and geometry.tilted
        return np.where(film.wall.turns, not tilted, not self.given_path)

    def default_end(self) -> float:
        """The time at which a march ends if none is given, s."""
        table = self.scene.motion.over_time
        if table is not None:
            return self.begin + (PERIODS * table.period if table.period else float(np.ptp(table.table.time)))
        if self.approach:
            film = self.scene.geometry.thinnest
            return CLOSED * film / self.approach if self.approach > 0 else film / -self.approach
        if self.turn is None:
            raise InputError("end: is missing for a wall that does not slide; give the last time")
        return TURNS * self.turn

    def largest_step(self, end: float) -> float:
        """The largest time step, s."""
        table = self.scene.motion.over_time
        lengths = [(end - self.begin) / STEPS_PER_TABLE]
        if table is not None:
            time = table.table.time
            lengths += [float(np.ptp(time)) / STEPS_PER_TABLE, 2 * float(np.median(np.diff(time)))]
        fastest = self.fastest_rate
        if fastest > 0:
            lengths.append(2 * math.pi / fastest / STEPS_PER_TURN)
        return min(lengths)

    @property
    def reverses(self) -> bool:
        """Whether the speed changes its sign."""
        table = self.scene.motion.over_time
        speeds = None if table is None else table.table.columns.get("speed")
        return speeds is not None and float(speeds.min()) < 0 < float(speeds.max())

    @cached_property
    def fastest_rate(self) -> float:
        """The largest rotational speed of the shaft, or 2π times the rate at which the wall passes the film, rad/s."""
        curve, geometry = self.curves.get("speed"), self.scene.geometry
        if curve is None:
            return 2 * math.pi * abs(self.scene.motion.speed) / geometry.length
        fastest = float(np.abs(curve.cubic(curve.cubic.x)).max())
        if self.units["speed"] == "rad/s":
            fastest *= self.scene.turning_radius or 1.0
        return 2 * math.pi * fastest / geometry.length


def wall_names(scene: Bearing) -> tuple[str, ...]:
    """The names of the coordinates of a wall."""
    geometry = scene.geometry
    if isinstance(geometry, Lobes):
        return geometry.wall.names
    if isinstance(geometry, Tilting):
        return ("pivot_film", "slope_x", "slope_y")[: 2 + int(geometry.tilts_across)]
    return ("film",)


def refuse_unsupported(duty: Duty) -> None:
    """Raise InputError, in one line, for a scene that has no march."""
    scene = duty.scene
    scene.check_newtonian("a march")
    if scene.boundary.inlet.ram_factor and "speed" in duty.curves:
        raise InputError("boundary.inlet.ram_factor: got one with a speed over time; give the pressure of the inlet")
    geometry, ends = scene.geometry, scene.ends
    joined = (isinstance(geometry, Lobes) and not geometry.single) or (isinstance(geometry, Ring) and geometry.endless)
    if duty.reverses and not joined and ends.inlet not in (None, ends.outlet):
        raise InputError(
            f"boundary.inlet: got {scene.inlet_pressure!r} Pa, but the outlet has another pressure; with a speed that "
            "changes its sign the two ends change places, give both the same pressure"
        )
    if duty.approach and not duty.given_path:
        raise InputError("motion.approach: got one beside a load; give one of the two")
    start, heat = duty.body.start, scene.heat
    if start is not None and start.temperature is not None and (heat is None or heat.time_constant is None):
        raise InputError(
            "body.start.temperature: got one without heat.time_constant, so that the film has the temperature of its "
            "balance at once; give the time constant, or leave it out"
        )
    if duty.approach and scene.geometry.film is None:
        raise InputError("motion.approach: got one without geometry.film; give the film at the first time")


def film_at(duty: Duty, cells: tuple[int, int], walls: Walls | None = None) -> FreeFilm:
    """The film of a march on a grid, at the speed of the first time.

    Parameters
    ----------
    walls : the walls; smooth ones by default.
    """
    between = walls or Walls()
    made = partial(free_film, cells=cells, film=between.film, contact=between.contact, closest=between.closest)
    scene, start = duty.scene, duty.body.start or Start()
    times = duty.curves["speed"].cubic.x if "speed" in duty.curves else [duty.begin]
    speed = duty.sliding_speed(duty.begin) or max((duty.sliding_speed(float(time)) for time in times), key=abs)
    at_start = scene.model_copy(
        update={
            "motion": scene.motion.model_copy(update={"speed": speed, "approach": 0.0}),
            "load": None if duty.given_path else duty.steady_load(duty.begin),
        }
    )
    if duty.lobes:
        return made(at_start)
    film = start.film or (duty.curves["film"](duty.begin) if "film" in duty.curves else None)
    if film is None and scene.geometry.film is None and (scene.motion.speed == 0 or at_start.load is None):
        raise InputError("body.start.film: is missing for a first film without speed or load; give it")
    if duty.pivoted is None:
        return made(at_start, wall=wall_of(at_start, film))
    slopes = duty.pivoted.slopes or start.slopes or (0.0, 0.0)
    wall = None
    if film is not None or at_start.load is None:
        wall = duty.pivoted.model_copy(update={"film": film or duty.pivoted.film, "slopes": slopes}).wall
    if wall is not None and "film" in duty.curves:
        along = wall.place[1]
        if duty.pivoted.slopes is None and start.slopes is None:  # the parallel pad is in equilibrium, but unstable
            along = -FIRST_NARROWING * math.copysign(wall.unit[1], speed) if speed else 0.0
        wall = replace(wall, place=np.array([duty.curves["film"](duty.begin), along, *wall.place[2:]]))
    return made(at_start, wall=wall, halves="moment_x" not in duty.curves and slopes[1] == 0)


def course_of(duty: Duty, film: FreeFilm) -> Course:
    """What moves the wall of a film."""
    wall, scene = film.wall, duty.scene
    count = wall.place.size
    mass = np.zeros((count, count))
    if duty.body.mass is not None:
        moved = 2 if duty.lobes else 1
        mass[:moved, :moved] = duty.body.mass / (scene.pieces or 1) * np.eye(moved)
    if duty.body.inertia is not None:  # a slope along x turns the pad about the axis along y
        mass[1:, 1:] = np.diag(duty.body.inertia[::-1][: count - 1])
    resisted = "geometry.preload" if duty.pivoted is None else "body.inertia"
    return Course(
        free=duty.free(film),
        place=lambda time: duty.place(time, film),
        speed=lambda time: (-1 if film.turned else 1) * duty.speed(time),
        force=lambda time: duty.force(time)[:count],
        mass=mass,
        stiffness=holding(film, duty.load(duty.begin)[:count]),
        velocity_scale=_velocity_scale(duty, film),
        names=wall.names,
        remedies=tuple(resisted if turns else "body.mass" for turns in wall.turns),
    )


def _velocity_scale(duty: Duty, film: FreeFilm) -> Array:
    """The size of the velocities of the coordinates, m/s (rad/s)."""
    unit, rate = film.wall.unit, duty.fastest_rate
    scale = rate * unit if duty.lobes else rate / (2 * math.pi) * unit
    columns = [name for name in ("film", "eccentricity_x", "eccentricity_y") if name in duty.curves]
    given = [duty.curves[name].fastest() * (1.0 if name == "film" else float(unit[0])) for name in columns]
    given.append(abs(duty.approach))
    scale = np.maximum(scale, max(given) * unit / unit[0])
    if scale.max() > 0:
        return np.asarray(scale)
    geometry = duty.scene.geometry
    reach = min(geometry.length, geometry.width or geometry.length)
    load = float(np.abs(duty.load(duty.begin)[: unit.size] * unit / unit[0]).max()) or 1.0
    closing = load * unit[0] ** 3 / (duty.scene.lubricant.viscosity * duty.scene.nominal_area * reach**2)
    return np.asarray(closing * unit / unit[0])


def started(duty: Duty, film: FreeFilm, *, tolerance: float) -> Moving:
    """The film at the first time, from which a march begins.

    It is the film at the given place, or in equilibrium with the first load; where nothing changes in time, a shaft
    starts in the middle of the bearing. A wall that has a velocity squeezes a film that has been steady before, by a
    change of ``FIRST_CHANGE`` of its thickness.

    Raises
    ------
    InputError
        If there is no equilibrium with the first load.
    """
    start, begin, count = duty.body.start or Start(), duty.begin, film.wall.place.size
    place, velocity = duty.place(begin, film), duty.first_velocity(film)
    if start.eccentricity is not None:
        place[:2] = np.array(start.eccentricity) * film.wall.unit[0]
    if start.velocity is not None:
        velocity[: len(start.velocity)] = start.velocity
    free, load = duty.free(film), duty.load(begin)[:count]
    given = start.eccentricity is not None or start.film is not None or (duty.given_path and duty.pivoted is None)
    speed = abs(duty.speed(begin))
    if not given and duty.changes and speed > 0 and (duty.given_path or np.abs(load).max() > 0):
        try:
            instant = equilibrium(film, None, tolerance=tolerance, load=load)
        except (InputError, ConvergenceError) as error:
            key = "eccentricity" if duty.lobes else "film"
            raise InputError(
                f"body.start.{key}: is missing, and the first load has no equilibrium ({error}); give it"
            ) from None
        return begun(film.solved, instant, time=begin, velocity=velocity)
    if (room := film.solved.room(place)) <= 0 and (film.solved.contact is not None or film.solved.closest > 0):
        key = "eccentricity" if duty.lobes else "film"
        raise InputError(
            f"body.start.{key}: the walls are {-room:.3g} m closer than flow factors and contact are known for at the "
            "first time; start further apart"
        )
    turning = free & film.wall.turns
    drive = Drive(
        speed=speed,
        force=np.zeros(count),
        stiffness=np.diag(np.where(turning, 1e-9 * film.wall.unit[0], 0.0)),
        free=np.zeros(count, dtype=bool),
    )
    rate = max(film.solved.closing(place, sign * velocity) for sign in (-1.0, 1.0)) / FIRST_CHANGE
    before = place - velocity / rate if rate > 0 else place
    instant = settled(film.solved, film.first(before), drive, tolerance=tolerance)
    if rate > 0:
        squeezed = replace(drive, storage=(rate, rate * held(film.solved, instant)))
        instant = settled(film.solved, replace(instant, place=place), squeezed, tolerance=tolerance)
    return begun(film.solved, replace(instant, place=place), time=begin, velocity=velocity)
