"""The film of a bearing whose wall moves as a rigid body, on a grid."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.equilibrium.expected import fed_film
from roughfilm.rom.bearing.free.lay import straight
from roughfilm.rom.bearing.free.walls import bearing_at
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.pivoted import Pivoted, PivotedSector
from roughfilm.rom.bearing.geometry.rigid import MovingWall, RigidWall
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.supply.patches import in_the_middle
from roughfilm.rom.cavitation.balance import CAVITY, FLOODED
from roughfilm.rom.cavitation.grid import doubled, grid
from roughfilm.rom.cavitation.motion.contact import ContactLaw
from roughfilm.rom.cavitation.motion.coupled import Instant, full_film
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.network import State, Values
from roughfilm.rom.cavitation.problem import Inflow, Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Level, Solution, mirrored, mirrored_inflow

WEDGE_LOAD = 0.16
"""Load of an infinitely wide pad over η u L²/h², whose film narrows to about half its thickness."""

FIRST_FILM, MAX_FIRST_FILM = 1e-6, 1e-2
"""Smallest and largest film over the length of a pad at which the search for an equilibrium begins."""

AT_EDGE = 1e-9
"""Distance from the edge of a groove, over the length of the film, up to which a node lies on it."""


@dataclass(frozen=True, kw_only=True)
class FreeFilm:
    """The film of a bearing on a grid, and the part of it that is solved.

    Attributes
    ----------
    scene : the bearing.
    wall : the coordinates of its wall.
    whole : the film over the whole width.
    solved : the film that is solved: half of the width where the film is symmetric about its middle.
    turned : whether the wall slides towards decreasing x, so that the films are mirrored in x.
    """

    scene: Bearing
    wall: RigidWall
    whole: MovingFilm
    solved: MovingFilm
    turned: bool

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """Whether each coordinate is sought: the shaft under a load, and pads without a given tilt."""
        geometry = self.scene.geometry
        tilted = isinstance(geometry, MovingWall) and geometry.tilted
        return np.where(self.wall.turns, not tilted, self.scene.load is not None)

    @cached_property
    def load(self) -> Array:
        """The load of the scene on each coordinate, N (N m of an angle; per width if infinitely wide)."""
        line = self.whole.problem.shape.wide
        return load_of_scene(self.scene)[: self.wall.place.size] / ((self.scene.geometry.width or 1.0) if line else 1.0)

    @cached_property
    def reversed(self) -> "FreeFilm":
        """The film mirrored in x, for a wall that slides in the other direction at the same speed."""
        return replace(self, whole=self.whole.mirrored, solved=self.solved.mirrored, turned=not self.turned)

    def first(self, place: Array) -> Instant:
        """A full film at given coordinates, from which an iteration starts."""
        return full_film(self.solved, place)

    def widened(self, values: Values) -> Values:
        """Values over the whole width from those of the film that is solved."""
        return cast(Values, np.concatenate([values[:, :0:-1], values], axis=1)) if self.solved.halved else values

    def solution(self, instant: Instant, *, coarser: Solution | None = None) -> Solution:
        """The film at an instant over the whole width, as that of a given film thickness."""
        film = self.whole
        problem = replace(film.problem, shape=film.shape(instant.place))
        faces = film.faces(instant.place)
        net = film.network(faces, instant.pressures, speed=problem.speed)
        state = State(pressure=self.widened(instant.state.pressure), fill=self.widened(instant.state.fill))
        load = float((film.grid.areas * state.pressure).sum())
        refilled = film.refills & (instant.kind == FLOODED)
        kind = np.where(refilled, np.int8(CAVITY), instant.kind)  # which holds liquid alone
        return Solution(
            problem=problem,
            turned=self.turned,
            grid=film.grid,
            faces=faces,
            network=net,
            state=state,
            kind=self.widened(kind),
            residual=instant.residual,
            imbalance=0.0,
            levels=(Level(shape=film.grid.shape, iterations=instant.iterations, load=load),),
            coarser=coarser,
        )


def free_film(
    scene: Bearing,
    cells: tuple[int, int],
    *,
    film: Callable[[Bearing], Problem] = Bearing.problem,
    ruptures: bool = True,
    contact: ContactLaw | None = None,
    wall: RigidWall | None = None,
    halves: bool = True,
    closest: float = 0.0,
) -> FreeFilm:
    """The film of a bearing on about ``cells`` equal cells along and across.

    Parameters
    ----------
    film : film(scene), the problem that the model solves.
    ruptures : whether the film cavitates.
    contact : the contact pressure of the walls over the film thickness; None of walls that do not touch.
    wall : the coordinates of the wall; by default those of a shaft in lobes or of a pad about a pivot.
    halves : whether half of the width is solved where the film is symmetric about its middle.
    closest : smallest film thickness of walls that do not touch, m.
    """
    if wall is None:
        moving = _started(scene, contact)
        wall, placed = moving.wall, scene.moved(moving.at(moving.wall.place))
    else:
        placed = bearing_at(scene, wall.place)
    problem = film(placed)
    if problem.shape.roughness is not None and scene.roughness is not None:
        problem = straight(problem, scene.roughness.rms)
    even = halves and _even(scene, problem.shape)
    wall = wall.first(2) if "slope_y" in wall.names and (even or problem.shape.wide) else wall
    modes, shaped = wall.normals, problem.shape.thickness
    at_rest = replace(
        problem,
        shape=replace(
            problem.shape,
            thickness=lambda x, y: (
                shaped(x, y) - sum(n(x, y) * q for n, q in zip(wall.normals, wall.place, strict=True))
            ),
        ),
    )
    gaps = _gaps(scene)
    turned = problem.speed < 0
    if turned:
        ends = problem.shape.breaks[0] + problem.shape.breaks[-1]
        at_rest = mirrored(at_rest)
        modes = tuple(_mirrored(normal, ends) for normal in modes)
        gaps = tuple(mirrored_inflow(one, ends) for one in gaps)
    half = _half(at_rest) if even else None
    count = max(cells[1] // 2, 1)
    upper = None if half is None else grid(half.shape, (cells[0], count))
    nodes = grid(at_rest.shape, (cells[0], 2 * count)) if upper is None else doubled(upper)
    whole = MovingFilm(
        problem=at_rest.on(nodes),
        grid=nodes,
        normals=modes,
        inflows=(*gaps, *at_rest.inflows),
        ambient=-scene.lubricant.cavitation_pressure,
        ruptures=ruptures,
        refills=ruptures and refilled(scene),
        contact=contact,
        closest=closest,
        turns=wall.turns,
    )
    solved = whole if half is None or upper is None else replace(whole, problem=half.on(upper), grid=upper, halved=True)
    return FreeFilm(scene=scene, wall=wall, whole=whole, solved=solved, turned=turned)


def refilled(scene: Bearing) -> bool:
    """Whether liquid from the sides fills all cavities of a bearing: a bore without gaps that nothing else supplies."""
    geometry, sides = scene.geometry, scene.boundary.sides
    unsupplied = isinstance(geometry, Lobes) and geometry.joined and not scene.wide and not scene.supply
    return unsupplied and max(sides.low, sides.high) <= scene.lubricant.cavitation_pressure


def _mirrored(function: Callable[[Array, Array], Values], ends: float) -> Callable[[Array, Array], Values]:
    return lambda x, y: function(ends - x, y)


def _even(scene: Bearing, shape: Shape) -> bool:
    """Whether the film has a width and is symmetric about the middle of it in equilibrium."""
    geometry, sides, load = scene.geometry, scene.boundary.sides, scene.load
    rough = scene.roughness is not None and shape.roughness is None
    turning = load is not None and load.moment_x != 0
    even = isinstance(geometry, MovingWall) and geometry.symmetric and in_the_middle(scene.supply_patches, shape.across)
    return even and sides.low == sides.high and not (shape.wide or rough or turning)


def _half(whole: Problem) -> Problem:
    """The half of the width beyond its middle."""
    shape = whole.shape
    low, high = shape.across
    middle = (low + high) / 2
    steps = tuple(step for step in shape.steps_across if step > middle)
    return replace(whole, shape=replace(shape, across=(middle, high), steps_across=steps))


def _gaps(scene: Bearing) -> tuple[Inflow, ...]:
    """The gaps between lobes, in which the pressure is that of the inlet."""
    geometry = scene.geometry
    if not isinstance(geometry, MovingWall):
        return ()
    length = scene.geometry.length
    edge, pressure = AT_EDGE * length, scene.inlet_pressure - scene.lubricant.cavitation_pressure

    def gap(begin: float, end: float) -> Inflow:
        def covers(x: Array, y: Array) -> NDArray[np.bool_]:
            turned = np.mod(x - begin + edge, length)
            return np.asarray((turned <= end - begin + 2 * edge) & np.isfinite(y))

        return Inflow(covers=covers, pressure=pressure)

    return tuple(gap(begin, end) for begin, end in geometry.gaps())


def load_of_scene(scene: Bearing) -> Array:
    """The load of a scene on each coordinate of its geometry, N (N/m if infinitely wide); 0 without a load."""
    geometry, load = scene.geometry, scene.load
    size = 0.0 if scene.load_pressure is None else scene.load_pressure * scene.nominal_area
    if isinstance(geometry, Pivoted | PivotedSector):
        return geometry.forces(size, (0.0, 0.0) if load is None else (load.moment_x, load.moment_y))
    if not isinstance(geometry, Lobes):
        return np.array([-size])
    force = np.zeros(len(geometry.wall.names))
    if load is not None:
        force[:2] = size * np.cos(load.angle), size * np.sin(load.angle)
    return force


def _started(scene: Bearing, contact: ContactLaw | None) -> Lobes | Pivoted | PivotedSector:
    """The shape from which the equilibrium is sought: a shaft as given or in the middle, a pad that narrows to half.

    Infinitely wide such pads carry 0.16 η u L²/h². Walls that may touch start apart.
    """
    geometry, pressure = scene.geometry, scene.load_pressure
    assert isinstance(geometry, Lobes | Pivoted | PivotedSector)
    if not isinstance(geometry, Pivoted | PivotedSector) or pressure is None:
        return geometry
    share = 1.0 if geometry.width is None else 1 / (1 + (geometry.length / geometry.width) ** 2)
    sheared = scene.lubricant.viscosity * abs(scene.motion.speed) * geometry.length
    film = max(math.sqrt(WEDGE_LOAD * share * sheared / pressure), fed_film(scene), FIRST_FILM * geometry.length)
    film = min(film, MAX_FIRST_FILM * geometry.length)
    film = film if contact is None else max(film, contact.touching)
    return geometry.started(film, reverse=scene.motion.speed < 0)
