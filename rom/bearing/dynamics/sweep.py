"""Equilibria, stiffness and damping of a bearing over speed and load."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from scipy.optimize import brentq

from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.timing import imports_apart, working_time
from roughfilm.rom.bearing.corners import infinite_flows
from roughfilm.rom.bearing.dynamics.balance import Equilibrium, balanced_equilibrium, leading_of, point_of
from roughfilm.rom.bearing.dynamics.point import DynamicPoint, finished, rotation_of
from roughfilm.rom.bearing.dynamics.transfer_errors import transfer_errors
from roughfilm.rom.bearing.dynamics.wall_errors import wall_errors
from roughfilm.rom.bearing.equilibrium.overload import refuse_overload
from roughfilm.rom.bearing.free.solve import placed
from roughfilm.rom.bearing.geometry.journal import Journal, Shaft
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.march.rough_walls import Walls, walls_of
from roughfilm.rom.bearing.outside import film_outside
from roughfilm.rom.bearing.scene import Bearing, BearingLoad, Inlet, Outlet
from roughfilm.rom.ladder.model import Progress, silent

RESOLUTION, MIN_CELLS, MAX_CELLS = 128, 32, 512
"""Default, smallest and largest number of cells along the film; there are half as many across."""

COARSENING = (4, 2, 1)
"""Cells along the finest grid over those of each grid, in the order in which they are solved."""

CELLS_PER_LOBE = 4
"""Smallest number of cells along a lobe of a coarser grid: with fewer its film is not resolved at all."""

ONSET_TOLERANCE = 1e-4
"""Relative error of the speed of onset at which its search stops."""

FREQUENCY_RATIOS = (0.0, 10.0)
"""Range of the frequency of the motion over that of the rotation."""


@dataclass(frozen=True, kw_only=True)
class Omitted:
    """A speed, m/s, at which there is no equilibrium, and why."""

    speed: float
    reason: str


@dataclass(frozen=True, kw_only=True)
class Onset:
    """The rotational speed at which a rigid rotor becomes unstable.

    Attributes
    ----------
    mass : mass in the bearing, kg.
    rotation : rotational speed, rad/s; infinite if the rotor is stable at all speeds of the points, NaN if it is
        unstable at the lowest.
    uncertainty : uncertainty of the speed, rad/s.
    """

    mass: float
    rotation: float
    uncertainty: float


@dataclass(frozen=True, kw_only=True)
class DynamicCurve:
    """The points under a load over the nominal area, ``pressure``, Pa, in order of speed.

    Attributes
    ----------
    omitted : the speeds without a point.
    onset : the speed at which a rotor of the given mass becomes unstable; None without a mass.
    """

    pressure: float
    points: tuple[DynamicPoint, ...]
    omitted: tuple[Omitted, ...] = ()
    onset: Onset | None = None

    __repr__ = brief


def dynamics(
    scene: Bearing,
    speeds: Sequence[float],
    pressures: Sequence[float],
    *,
    resolution: int = RESOLUTION,
    frequency_ratio: float = 1.0,
    mass: float | None = None,
    known: Sequence[DynamicPoint] = (),
    keep: Callable[[DynamicPoint], object] = lambda _point: None,
    progress: Progress = silent,
) -> tuple[DynamicCurve, ...]:
    """Compute equilibrium, stiffness and damping of a bearing at several speeds and loads.

    Films are solved on three grids with a quarter, half and all of the cells, each from the one before, from which the
    uncertainty is estimated; that of flow factors, of contact pressures and of a heat transfer that is estimated adds
    to it. Points without an equilibrium are left out.

    If the lubricant of the scene has a temperature (``thermoviscosity``, ``density`` and ``heat_capacity``), the film
    of each point, on each grid, has the one at which its heat is balanced
    (:func:`roughfilm.rom.bearing.thermal.exchange.temperatures`). Stiffness and damping are those of motions at this
    temperature: walls and lubricant warm much slower than a rotor vibrates.

    Parameters
    ----------
    scene : the bearing; its eccentricity has no effect, and of its speed only the sign, of its load only the angle.
    speeds : sliding speeds, m/s, above 0, in any order without repetition.
    pressures : loads over the nominal area, Pa.
    resolution : number of cells along the film; half as many are across.
    frequency_ratio : frequency of the motion over that of the rotation, of stiffness and damping; 0 of slow motions.
    mass : mass of a rigid rotor in the bearing, kg, whose onset of instability is sought.
    known : points that are not solved again.
    keep : called with each new point.

    Raises
    ------
    InputError
        If the walls of the bearing do not move freely, a speed or load is out of range, or no speed has an equilibrium
        under a load.
    ConvergenceError
        If no film converges under a load.
    """
    scene = free_bearing(scene)
    ordered = _checked(scene, speeds, pressures, resolution, frequency_ratio, mass)
    done = {(point.pressure, point.speed): point for point in known}
    walls, curves = walls_of(scene), []
    for number, pressure in enumerate(sorted(pressures)):
        points: list[DynamicPoint] = []
        omitted: list[Omitted] = []
        refused: InputError | ConvergenceError | None = None

        def at(speed: float, pressure: float = pressure) -> DynamicPoint:
            return dynamic_point(at_operation(scene, speed, pressure), walls, pressure, resolution, frequency_ratio)

        for count, speed in enumerate(ordered):
            progress((number + count / len(ordered)) / len(pressures), f"{speed:.4g} m/s, {pressure * 1e-6:.4g} MPa")
            point = done.get((pressure, speed))
            if point is None:
                try:
                    point = at(speed)
                except (InputError, ConvergenceError) as error:
                    if count == 0 and not any(pressure == kept for kept, _speed in done):
                        refuse_overload(at, ordered)
                    omitted.append(Omitted(speed=speed, reason=str(error)))
                    refused = refused or error
                    continue
                keep(point)
            points.append(point)
        if not points:
            assert refused is not None
            raise refused
        onset = None if mass is None else onset_of(scene, walls, points, mass, resolution, frequency_ratio)
        curves.append(DynamicCurve(pressure=pressure, points=tuple(points), omitted=tuple(omitted), onset=onset))
    return tuple(curves)


def at_operation(scene: Bearing, speed: float, pressure: float) -> Bearing:
    """The bearing at a sliding speed, m/s, in the direction of its own, and under a load over its nominal area, Pa."""
    load = scene.load or BearingLoad.model_construct(pressure=pressure)
    only = {"pressure": pressure, "force": None, "force_per_width": None}
    return scene.at_speed(math.copysign(speed, scene.motion.speed or 1.0)).model_copy(
        update={"load": load.model_copy(update=only)}
    )


@imports_apart()
def dynamic_point(
    scene: Bearing,
    walls: Walls,
    pressure: float,
    resolution: int,
    frequency_ratio: float,
) -> DynamicPoint:
    """The point of a bearing at its speed and load, which depends on no other point: a resumed sweep has the same.

    Parameters
    ----------
    walls : its walls, smooth or rough.
    """
    cpu = working_time()
    solved = list(_equilibria(scene, walls, resolution))
    points = [point_of(one, frequency_ratio) for one in reversed(solved)]
    if points[0].numbers.get("stiffness", 1.0) <= 0:
        raise InputError(
            "load: the equilibrium of the pad is not stable; move the pivot, or take another load or speed"
        )
    closest = -math.inf if walls.contact is not None else walls.closest
    if points[0].numbers["film_min"] <= closest:
        raise InputError(
            "load: the walls touch between the nodes of the grid; lower the load, or raise the speed or the viscosity"
        )
    points = [point for point in points if point.numbers["film_min"] > closest]
    speed, film, instant = abs(scene.motion.speed), solved[-1].film, solved[-1].instant
    rotation = rotation_of(scene, speed)
    middle, heated = solved[max(len(solved) - 2, 0)], solved[-1].temperatures
    of_walls, of_transfer = (errors(scene, walls, middle, frequency_ratio) for errors in (wall_errors, transfer_errors))
    shaft = ~film.wall.turns
    net_force = film.solved.force(instant.state.pressure) + film.solved.contact_at(instant.place).force + film.load
    load = math.hypot(*film.load[shaft])
    balance = math.hypot(*net_force[shaft]) / load
    numbers, uncertainty = finished(points, rotation, lambda name: of_walls(name) + of_transfer(name), balance)
    solution = film.solution(instant)
    uncertainty |= dict.fromkeys(infinite_flows(solution) & uncertainty.keys(), math.inf)
    return DynamicPoint(
        pressure=pressure,
        load=load,
        speed=speed,
        rotation=rotation,
        numbers=numbers,
        uncertainty=uncertainty,
        spectrum=points[0].spectrum,
        residual=max(instant.residual, instant.force_residual),
        estimated_heat_transfer=0.0 if heated is None else heated.estimated,
        leading=leading_of(scene, solved[-1]),
        cpu_s=working_time() - cpu,
        outside=(
            *film_outside(placed(film, instant), solution),
            *(() if (spots := walls.spots(numbers["film_min"])) is None else spots.outside),
            *_of_lubricant(scene, solved[-1]),
        ),
    )


def _of_lubricant(scene: Bearing, found: Equilibrium) -> list[str]:
    """The sentence on a film whose temperature is outside of the range of its lubricant."""
    heated = found.temperatures
    return [] if heated is None else scene.lubricant.beyond(heated.effective, heated.effective)


def _equilibria(scene: Bearing, walls: Walls, resolution: int) -> Iterator[Equilibrium]:
    """The equilibrium on each grid, from coarse to fine; coarse ones may be missing.

    A coarse grid may lack an equilibrium that the others have; two of them are taken to show that there is none.
    """
    coarse: Equilibrium | None = None
    refused = 0
    least = CELLS_PER_LOBE * scene.geometry.lobes if isinstance(scene.geometry, Lobes) else 0
    for coarsening in COARSENING:
        if coarsening != COARSENING[-1] and resolution // coarsening < least:
            continue
        cells = resolution // coarsening, resolution // coarsening // 2
        try:
            coarse = balanced_equilibrium(scene, walls, cells, coarse=coarse)
        except (InputError, ConvergenceError) as error:
            refused += isinstance(error, InputError)
            if coarsening == COARSENING[-1] or refused > 1:
                raise
            continue
        yield coarse


def onset_of(
    scene: Bearing,
    walls: Walls,
    points: Sequence[DynamicPoint],
    mass: float,
    resolution: int,
    frequency_ratio: float,
) -> Onset:
    """The lowest speed at which the critical mass falls to that of a rotor.

    Between the two points where it does, the speed is sought by further points.

    Parameters
    ----------
    walls : the walls of the bearing.
    points : points under one load in order of speed.
    mass : mass of the rotor in the bearing, kg.
    """
    excess = [_excess(point, mass) for point in points]
    if excess[0] > 0:
        return Onset(mass=mass, rotation=math.nan, uncertainty=math.inf)
    above = next((number for number, value in enumerate(excess) if value > 0), None)
    if above is None:
        return Onset(mass=mass, rotation=math.inf, uncertainty=math.inf)
    before, after = points[above - 1], points[above]
    if not math.isfinite(excess[above]):
        return Onset(mass=mass, rotation=after.rotation, uncertainty=after.rotation - before.rotation)
    tried: dict[float, DynamicPoint] = {before.speed: before, after.speed: after}

    def at(speed: float) -> float:
        if speed not in tried:
            operation = at_operation(scene, speed, before.pressure)
            tried[speed] = dynamic_point(operation, walls, before.pressure, resolution, frequency_ratio)
        return _excess(tried[speed], mass)

    speed = float(brentq(at, before.speed, after.speed, rtol=ONSET_TOLERANCE, xtol=ONSET_TOLERANCE * before.speed))
    at(speed)
    point = tried[speed]
    slope = (excess[above] - excess[above - 1]) / (after.rotation - before.rotation)
    error = point.uncertainty["critical_mass"] / point.numbers["critical_mass"] ** 2
    return Onset(mass=mass, rotation=point.rotation, uncertainty=error / slope + ONSET_TOLERANCE * point.rotation)


def _excess(point: DynamicPoint, mass: float) -> float:
    """1/M of the critical mass M of a point minus that of a rotor, 1/kg; above 0 if the rotor is unstable."""
    critical = point.numbers["critical_mass"]
    return (1 / critical if critical else math.inf) - 1 / mass


def _checked(
    scene: Bearing,
    speeds: Sequence[float],
    pressures: Sequence[float],
    resolution: int,
    frequency_ratio: float,
    mass: float | None,
) -> list[float]:
    """The speeds in increasing order; raises InputError for a number out of range."""
    for name, values in (("speeds", speeds), ("loads", pressures)):
        wrong = [value for value in values if not 0 < value < math.inf]
        if wrong or not values:
            got = f"got {wrong[0]!r}" if wrong else "are missing"
            raise InputError(f"{name}: {got}; give finite numbers above 0")
        if len(set(values)) < len(values):
            raise InputError(f"{name}: got the same number twice; give each once")
    if not MIN_CELLS <= resolution <= MAX_CELLS:
        raise InputError(f"resolution: got {resolution}; it must be {MIN_CELLS} to {MAX_CELLS} cells along the film")
    low, high = FREQUENCY_RATIOS
    if not low <= frequency_ratio <= high:
        raise InputError(f"frequency_ratio: got {frequency_ratio!r}; it must be {low:g} to {high:g}")
    if mass is not None and not 0 < mass < math.inf:
        raise InputError(f"mass: got {mass!r} kg; it must be a finite number above 0")
    if mass is not None and not isinstance(scene.geometry, Shaft):
        raise InputError(
            f"mass: got {mass:g} kg for a pad, which does not whirl; leave it out, or give a scene with a shaft"
        )
    return sorted(speeds)


def free_bearing(scene: Bearing) -> Bearing:
    """The bearing in the coordinates of its wall: a plain journal as one lobe around the shaft.

    Raises
    ------
    InputError
        If the walls of the bearing do not move freely, or its lubricant thins with shear.
    """
    scene.check_newtonian("an analysis of stiffness and damping")
    journal = scene.geometry
    if isinstance(journal, Journal):
        lines = scene.boundary.inlet != Inlet() or scene.boundary.outlet != Outlet()
        others = {"geometry.texture": journal.texture, "supply": scene.supply, "boundary": lines}
        if given := [name for name, value in others.items() if value]:
            raise InputError(
                f"{given[0]}: got one for a shaft that moves in its bore, where the line at the inlet has no place; "
                "leave it out, or take geometry.shape = 'lobes', to whose bore grooves and supplies are fixed"
            )
        if journal.width is None:
            raise InputError("geometry.width: is missing, but a bore without grooves is filled from its sides; give it")
        same = {name: getattr(journal, name) for name in ("radius", "clearance", "width")}
        return scene.model_copy(update={"geometry": Lobes.model_construct(shape="lobes", **same)})
    if not isinstance(journal, MovingWall):
        raise InputError(
            f"geometry.shape: got {journal.shape!r}; stiffness and damping are those of a wall that moves freely, take "
            "'journal', 'lobes' or a pad about its pivot"
        )
    return scene


def mass_of(scene: Bearing) -> float | None:
    """The mass of the rotor in the bearing, kg; None if the scene has none, or has a pad, which does not whirl."""
    return scene.body.mass if scene.body is not None and isinstance(scene.geometry, Shaft) else None
