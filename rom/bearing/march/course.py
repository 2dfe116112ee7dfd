"""What moves a bearing in time: speed, loads, path and body of a scene as functions of time."""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.free.equilibrium import equilibrium
from roughfilm.rom.bearing.free.film import FreeFilm, free_film
from roughfilm.rom.bearing.free.walls import wall_of
from roughfilm.rom.bearing.geometry.journal import Journal
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.pivoted import Tilting
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.moving.body import Body, Start
from roughfilm.rom.bearing.moving.over_time import Curve
from roughfilm.rom.bearing.scene import Bearing, BearingLoad
from roughfilm.rom.cavitation.motion.coupled import Drive, settled
from roughfilm.rom.cavitation.motion.march import Course, Moving, begun

TURNS = 20
"""Turns of the shaft, or passages of the sliding wall, after which a march without a table ends."""

PERIODS = 5
"""Repetitions of a table after which a march ends."""

CLOSED = 0.9
"""Part of the film that a constant approach closes in a march without an end."""

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

    def turned_by(self, time: float) -> tuple[float, float, float]:
        """The angle of the shaft since the first time, rad, its rotational speed, rad/s, and acceleration, rad/s²."""
        radius, curve = self.scene.turning_radius or 1.0, self.curves.get("speed")
        if curve is None:
            omega = self.scene.motion.speed / radius
            return omega * (time - self.begin), omega, 0.0
        scale = 1.0 if self.units["speed"] == "rad/s" else 1 / radius
        return scale * curve.since_first(time), scale * curve(time), scale * curve(time, 1)

    def load(self, time: float) -> Array:
        """The load on each coordinate, N (N m of an angle; per width if infinitely wide), without an unbalance."""
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
            return force
        if not self.lobes:
            force[0] = -size
            return force
        angle = curves["angle"](time) if "angle" in curves else -math.pi / 2 if given is None else given.angle
        force[:2] = size * math.cos(angle), size * math.sin(angle)
        return force

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
            place[0] = film.wall.place[0] - self.approach * (time - self.begin)
        return place

    def free(self, film: FreeFilm) -> NDArray[np.bool_]:
        """Whether each coordinate moves as its forces make it move."""
        geometry = self.scene.geometry
        tilted = isinstance(geometry, Lobes) and geometry.tilts is not None
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
    return scene.geometry.wall.names if isinstance(scene.geometry, Lobes) else ("film",)


def refuse_unsupported(duty: Duty) -> None:
    """Raise InputError, in one line, for a scene that has no march."""
    scene = duty.scene
    if scene.asperities is not None or scene.roughness is not None:
        part = "asperities" if scene.asperities is not None else "roughness"
        raise InputError(f"{part}: got some, but a march has smooth walls; leave [{part}] out")
    if scene.boundary.inlet.ram_factor and "speed" in duty.curves:
        raise InputError("boundary.inlet.ram_factor: got one with a speed over time; give the pressure of the inlet")
    if isinstance(scene.geometry, Journal):
        wall_of(scene)
    if isinstance(scene.geometry, Tilting):
        raise InputError(
            f"geometry.shape: got {scene.geometry.shape!r}, which has no march; take a shape with a given tilt"
        )
    if duty.approach and not duty.given_path:
        raise InputError("motion.approach: got one beside a load; give one of the two")
    if duty.approach and scene.geometry.film is None:
        raise InputError("motion.approach: got one without geometry.film; give the film at the first time")


def film_at(duty: Duty, cells: tuple[int, int]) -> FreeFilm:
    """The film of a march on a grid, at the speed of the first time."""
    scene, start = duty.scene, duty.body.start or Start()
    speeds = duty.curves["speed"].cubic(duty.curves["speed"].cubic.x) if "speed" in duty.curves else [0.0]
    radius = scene.turning_radius or 1.0
    speed = duty.speed(duty.begin) * (1.0 if duty.lobes else radius) or float(max(speeds, key=abs))
    at_start = scene.model_copy(
        update={
            "motion": scene.motion.model_copy(update={"speed": speed, "approach": 0.0}),
            "load": _first_load(duty),
        }
    )
    film = None
    if not isinstance(scene.geometry, MovingWall):
        film = start.film or (duty.curves["film"](duty.begin) if "film" in duty.curves else None)
        if film is None and scene.geometry.film is None and (scene.motion.speed == 0 or at_start.load is None):
            raise InputError("body.start.film: is missing for a first film without speed or load; give it")
    moving = isinstance(scene.geometry, MovingWall)
    return free_film(at_start, cells, wall=None if moving else wall_of(at_start, film))


def _first_load(duty: Duty) -> BearingLoad | None:
    """The load at the first time; None of a given path, and of no load."""
    force, area = duty.load(duty.begin), duty.scene.nominal_area
    size = float(np.hypot(*force[:2])) if duty.lobes else abs(float(force[0]))
    if duty.given_path or size == 0:
        return None
    angle = math.atan2(force[1], force[0]) if duty.lobes else -math.pi / 2
    return BearingLoad.model_construct(pressure=size / area, angle=angle)


def course_of(duty: Duty, film: FreeFilm) -> Course:
    """What moves the wall of a film."""
    wall, scene = film.wall, duty.scene
    count = wall.place.size
    mass = np.zeros((count, count))
    if duty.body.mass is not None:
        moved = 2 if duty.lobes else 1
        mass[:moved, :moved] = duty.body.mass / (scene.pieces or 1) * np.eye(moved)
    return Course(
        free=duty.free(film),
        place=lambda time: duty.place(time, film),
        speed=lambda time: abs(duty.speed(time)),
        force=duty.force,
        mass=mass,
        stiffness=np.zeros((count, count)),
        velocity_scale=_velocity_scale(duty, film),
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
    load = float(np.abs(duty.load(duty.begin)).max()) or 1.0
    closing = load * unit[0] ** 3 / (duty.scene.lubricant.viscosity * duty.scene.nominal_area * reach**2)
    return np.asarray(closing * unit / unit[0])


def started(duty: Duty, film: FreeFilm, *, tolerance: float) -> Moving:
    """The film at the first time, from which a march begins.

    It is the steady film at the given place, or in equilibrium with the first load; where nothing changes in time, a
    shaft starts in the middle of the bearing.

    Raises
    ------
    InputError
        If there is no equilibrium with the first load.
    """
    start, begin, count = duty.body.start or Start(), duty.begin, film.wall.place.size
    place, velocity = duty.place(begin, film), np.zeros(count)
    if start.eccentricity is not None:
        place[:2] = np.array(start.eccentricity) * film.wall.unit[0]
    if start.velocity is not None:
        velocity[: len(start.velocity)] = start.velocity
    elif duty.approach:
        velocity[0] = -duty.approach
    free = duty.free(film)
    given = start.eccentricity is not None or start.film is not None or duty.given_path
    speed = abs(duty.speed(begin))
    if not given and duty.changes and speed > 0 and np.abs(duty.load(begin)).max() > 0:
        try:
            instant = equilibrium(film, None, tolerance=tolerance)
        except (InputError, ConvergenceError) as error:
            key = "eccentricity" if duty.lobes else "film"
            raise InputError(
                f"body.start.{key}: is missing, and the first load has no equilibrium ({error}); give it"
            ) from None
        return begun(film.solved, instant, time=begin, velocity=velocity)
    held = free & film.wall.turns
    drive = Drive(
        speed=speed,
        force=np.zeros(count),
        stiffness=np.diag(np.where(held, 1e-9 * film.wall.unit[0], 0.0)),
        free=np.zeros(count, dtype=bool),
    )
    instant = settled(film.solved, film.first(place), drive, tolerance=tolerance)
    return begun(film.solved, replace(instant, place=place), time=begin, velocity=velocity)
