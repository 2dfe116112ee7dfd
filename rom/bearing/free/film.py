"""The film of a bearing whose wall moves as a rigid body, on a grid."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.rigid import RigidWall
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.grid import grid
from roughfilm.rom.cavitation.motion.contact import ContactLaw
from roughfilm.rom.cavitation.motion.coupled import Instant, kinds
from roughfilm.rom.cavitation.motion.film import Inflow, MovingFilm
from roughfilm.rom.cavitation.network import State, Values
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.solve import Level, Solution, mirrored

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
        assert isinstance(geometry, Lobes)
        return np.where(self.wall.turns, geometry.tilts is None, self.scene.load is not None)

    @cached_property
    def load(self) -> Array:
        """The load of the scene on each coordinate, N (N m of an angle; per width if infinitely wide)."""
        line = self.whole.problem.shape.wide
        return load_of_scene(self.scene) / ((self.scene.geometry.width or 1.0) if line else 1.0)

    def first(self, place: Array) -> Instant:
        """A full film at ambient pressure and given coordinates, from which an iteration starts."""
        film = self.solved
        faces = film.faces(place)
        pressures = np.array([inflow.pressure for inflow in film.inflows])
        net = film.network(faces, pressures, speed=film.problem.speed)
        state = State(pressure=np.where(net.fixed, net.pressure, 0.0), fill=np.ones(net.shape))
        return Instant(
            place=place,
            pressures=pressures,
            state=state,
            kind=kinds(net, state),
            faces=faces,
            network=net,
            balance=np.zeros(net.shape),
            residual=np.inf,
            force_residual=np.inf,
            iterations=0,
        )

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
        return Solution(
            problem=problem,
            turned=self.turned,
            grid=film.grid,
            faces=faces,
            network=net,
            state=state,
            kind=self.widened(instant.kind),
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
) -> FreeFilm:
    """The film of a bearing on about ``cells`` equal cells along and across.

    Parameters
    ----------
    film : film(scene), the problem that the model solves.
    ruptures : whether the film cavitates.
    contact : the contact pressure of the walls over the film thickness; None of walls that do not touch.
    """
    geometry = scene.geometry
    assert isinstance(geometry, Lobes)
    wall, placed = geometry.wall, scene.moved(geometry.at(geometry.wall.place))
    problem = film(placed)
    modes, place, shaped = wall.normals, wall.place, problem.shape.thickness
    at_rest = replace(
        problem,
        shape=replace(
            problem.shape,
            thickness=lambda x, y: shaped(x, y) - sum(n(x, y) * q for n, q in zip(modes, place, strict=True)),
        ),
    )
    inflows = _inflows(scene, geometry)
    turned = problem.speed < 0
    if turned:
        ends = problem.shape.breaks[0] + problem.shape.breaks[-1]
        at_rest = mirrored(at_rest)
        modes = tuple(_mirrored(normal, ends) for normal in modes)
        inflows = tuple(replace(one, covers=_mirrored(one.covers, ends)) for one in inflows)
    whole = MovingFilm(
        problem=at_rest,
        grid=grid(at_rest.shape, (cells[0], 2 * max(cells[1] // 2, 1))),
        normals=modes,
        inflows=inflows,
        ambient=-scene.lubricant.cavitation_pressure,
        ruptures=ruptures,
        contact=contact,
    )
    return FreeFilm(scene=scene, wall=wall, whole=whole, solved=_half(scene, whole, cells), turned=turned)


def _mirrored(function: Callable[[Array, Array], Values], ends: float) -> Callable[[Array, Array], Values]:
    return lambda x, y: function(ends - x, y)


def _half(scene: Bearing, whole: MovingFilm, cells: tuple[int, int]) -> MovingFilm:
    """The half of the width beyond its middle, if the film is symmetric about it; else the whole film."""
    geometry, shape = scene.geometry, whole.problem.shape
    assert isinstance(geometry, Lobes)
    sides = scene.boundary.sides
    rough = scene.roughness is not None and shape.roughness is None
    if shape.wide or rough or not geometry.symmetric or sides.low != sides.high:
        return whole
    low, high = shape.across
    half = replace(shape, across=((low + high) / 2, high))
    return replace(
        whole,
        problem=replace(whole.problem, shape=half),
        grid=grid(half, (cells[0], max(cells[1] // 2, 1))),
        halved=True,
    )


def _inflows(scene: Bearing, geometry: Lobes) -> tuple[Inflow, ...]:
    """The gaps between lobes, in which the pressure is that of the inlet."""
    edge, pressure = AT_EDGE * geometry.length, scene.inlet_pressure - scene.lubricant.cavitation_pressure

    def gap(begin: float, end: float) -> Inflow:
        def covers(x: Array, y: Array) -> NDArray[np.bool_]:
            turned = np.mod(x - begin + edge, geometry.length)
            return np.asarray((turned <= end - begin + 2 * edge) & np.isfinite(y))

        return Inflow(covers=covers, pressure=pressure)

    return tuple(gap(begin, end) for begin, end in geometry.gaps())


def load_of_scene(scene: Bearing) -> Array:
    """The load of a scene on each coordinate of its wall, N (N/m if infinitely wide); 0 without a load."""
    geometry, load = scene.geometry, scene.load
    assert isinstance(geometry, Lobes)
    force = np.zeros(len(geometry.wall.names))
    if load is None or scene.load_pressure is None:
        return force
    size = scene.load_pressure * scene.nominal_area
    force[:2] = size * np.cos(load.angle), size * np.sin(load.angle)
    return force
