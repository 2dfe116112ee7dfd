"""A film between two rigid walls, one of which is displaced: its thickness is linear in a few coordinates."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate
from typing import cast

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.compiled import compiled
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.cavitation.discretise import Faces, faces_of, network, positions
from roughfilm.rom.cavitation.fluid import Viscosities
from roughfilm.rom.cavitation.grid import Grid, quarters
from roughfilm.rom.cavitation.motion.contact import ContactForce, ContactLaw, contact_force
from roughfilm.rom.cavitation.network import Network, Values
from roughfilm.rom.cavitation.problem import Inflow, Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import mirrored

TINY = float(np.finfo(float).tiny)
"""Distance of walls, m, in place of one that is 0 or less by round-off."""

JOINT = 1e-12
"""Distance from the end of a periodic film, over its length, up to which a position is at its beginning."""

GAP_STEP = 1e-5
"""Step of the separation for the derivative of the mean gap, over the largest approach."""


@compiled
def displace(rest, modes, place, thickness):  # type: ignore[no-untyped-def]
    """Write h₀ + Σ q_k n_k at all positions."""
    for n in range(rest.size):
        thickness[n] = rest[n]
    for k in range(place.size):
        mode, moved = modes[:, k], place[k]
        for n in range(rest.size):
            thickness[n] += mode[n] * moved


OF_GEOMETRY = ("_sampled", "at_nodes", "covered", "restricted", "_beside", "weights", "reach", "_between", "_quarters")
"""Values of a film that its geometry alone determines; the last two are those of rough walls."""

Normal = Callable[[Array, Array], Array]
"""normal(x, y), the derivative ∂h/∂q of the film thickness by a coordinate, vectorised."""


@dataclass(frozen=True, kw_only=True)
class MovingFilm:
    """The film h = h₀ + Σ q_k n_k(x, y) on a grid.

    Attributes
    ----------
    problem : the film at q = 0; its thickness, which may be negative there, is h₀.
    grid : the grid.
    normals : n_k = ∂h/∂q_k of each coordinate.
    inflows : parts of the film in which lubricant is supplied.
    ambient : pressure on the other sides of the walls above cavitation pressure, Pa.
    halved : whether y = low is a line of symmetry, through which nothing flows, in place of a side.
    ruptures : whether the film cavitates.
    refills : whether liquid at the cavitation pressure fills every cavity at once from outside, as from the sides of a
        bore that are at this pressure: p >= 0, and ∂p/∂n = 0 where the film ruptures and where it forms again.
    contact : the contact pressure over the film thickness; None of walls that do not touch.
    closest : smallest film thickness of walls that do not touch, m, such as that of which flow factors are known.
    turns : whether each coordinate is the tilt of a pad, on which no pressure in the gaps beside it acts; by default
        none is.
    """

    problem: Problem
    grid: Grid
    normals: tuple[Normal, ...]
    inflows: tuple[Inflow, ...] = ()
    ambient: float = 0.0
    halved: bool = False
    ruptures: bool = True
    refills: bool = False
    contact: ContactLaw | None = None
    closest: float = 0.0
    turns: NDArray[np.bool_] | None = None

    @cached_property
    def _sampled(self) -> tuple[Array, Array, list[tuple[int, ...]]]:
        """h₀, and n of each coordinate in its last axis, at all positions of samples; the shape of each of these."""
        places = list(positions(self.grid))
        rest = np.concatenate([np.asarray(self.problem.shape.thickness(x, y)).ravel() for x, y in places])
        modes = np.concatenate([self.modes(x, y).reshape(-1, len(self.normals)) for x, y in places])
        return rest, np.asfortranarray(modes), [x.shape for x, _ in places]

    def modes(self, x: Array, y: Array) -> Array:
        """∂h/∂q of each coordinate at positions, in the last axis."""
        return np.stack([np.broadcast_to(normal(x, y), x.shape) for normal in self.normals], axis=-1)

    @cached_property
    def at_nodes(self) -> Array:
        """∂h/∂q at the nodes, shape (nx, ny, coordinates)."""
        x, y = np.meshgrid(self.grid.x, self.grid.y, indexing="ij")
        return self.modes(x, y)

    @cached_property
    def covered(self) -> tuple[NDArray[np.bool_], ...]:
        """The nodes of every inflow, each at least one."""
        x, y = np.meshgrid(self.grid.x, self.grid.y, indexing="ij")
        return tuple(np.asarray(inflow.covers(x, y)) for inflow in self.inflows)

    @cached_property
    def restricted(self) -> tuple[int, ...]:
        """The numbers of the inflows behind restrictors."""
        return tuple(number for number, inflow in enumerate(self.inflows) if inflow.restrictor is not None)

    @property
    def sides(self) -> float:
        """The number of halves of the film: forces and flows of the nodes count as often."""
        return 2.0 if self.halved else 1.0

    def shape(self, place: Array) -> Shape:
        """The shape of the film at coordinates q."""
        rest = self.problem.shape.thickness

        def thickness(x: Array, y: Array) -> Array:
            x, y = np.broadcast_arrays(x, y)
            return np.asarray(rest(x, y) + self.modes(x, y) @ place)

        return replace(self.problem.shape, thickness=thickness)

    def with_viscosity(self, viscosity: float) -> "MovingFilm":
        """The film of a liquid with another viscosity, Pa s, at the cavitation pressure; sampled values are shared."""
        if viscosity == self.problem.viscosity:
            return self
        other = replace(self, problem=replace(self.problem, viscosity=viscosity))
        for name in OF_GEOMETRY if self.contact is not None or self.closest else OF_GEOMETRY[:-2]:
            other.__dict__[name] = getattr(self, name)
        return other

    def faces(self, place: Array) -> Faces:
        """The film sampled on the grid at coordinates q."""
        rest, modes, shapes = self._sampled
        all_thickness, ends = np.empty(rest.size), accumulate(math.prod(shape) for shape in shapes)
        displace(rest, modes, place, all_thickness)
        parts = (all_thickness[end - math.prod(shape) : end] for end, shape in zip(ends, shapes, strict=True))
        thickness = (part.reshape(shape) for part, shape in zip(parts, shapes, strict=True))
        return faces_of(thickness, self.shape(place), self.grid)

    def gap_at(self, place: Array) -> Array:
        """The mean gap at the nodes at coordinates q, m."""
        rest, modes = self._beside
        return self.gap(rest + modes @ place)

    def gap(self, thickness: Array) -> Array:
        """The mean gap at film thicknesses, m; where asperities are flattened it exceeds the separation."""
        return thickness if self.contact is None else self.contact.mean_gap(thickness)

    def gap_rate(self, thickness: Array) -> Array:
        """The derivative of the mean gap by the film thickness, 1 without contact."""
        if self.contact is None:
            return np.ones_like(thickness)
        step = GAP_STEP * (self.contact.touching - self.contact.closest)
        below, above = np.maximum(thickness - step, self.contact.closest), thickness + step
        return np.asarray((self.gap(above) - self.gap(below)) / (above - below))

    def network(
        self,
        faces: Faces,
        pressures: Array,
        *,
        speed: float,
        storage: tuple[float | Array, Array | float] | None = None,
        of_gap: float | Array = 0.0,
    ) -> Network:
        """The network of the film, with the pressure of each inflow in the film, Pa above cavitation pressure.

        ``speed`` and ``storage`` are those of :func:`roughfilm.rom.cavitation.discretise.network`, with the further
        term of :class:`roughfilm.rom.cavitation.motion.coupled.Drive`.
        """
        net = network(
            self.grid,
            faces,
            self.problem.ends,
            speed=speed,
            viscosity=self.problem.viscosity,
            compressibility=self.problem.initial_compressibility,
            storage=storage,
            ruptures=self.ruptures,
            viscosities=self.problem.at_nodes,
        )
        if self.refills:
            net = net.with_whole_faces()
        if storage is not None:
            volumes = self.grid.areas * self.gap(faces.thickness)
            net = replace(net, storage=volumes * storage[0], stored=net.stored - volumes * of_gap)
        if net.oblique is not None:
            raise InputError(
                "roughness: got an averaged oblique lay for walls that move freely; take roughness along or across the "
                "sliding"
            )
        if self.halved:
            inner = slice(None) if net.periodic[0] else slice(1, -1)
            net.fixed[inner, 0] = False
            if not net.periodic[0]:
                self._open_middle(net, faces, speed)
        for nodes, pressure in zip(self.covered, pressures, strict=True):
            net.fixed[nodes], net.pressure[nodes] = True, pressure
        return net

    def _open_middle(self, net: Network, faces: Faces, speed: float) -> None:
        """Give the ends of the line of symmetry the conditions of the inlet and the outlet, in place of the side's."""
        ends, grid = self.problem.ends, self.grid
        net.pressure[-1, 0] = ends.outlet
        if net.supply is None:
            net.pressure[0, 0] = ends.inlet
        else:
            net.fixed[0, 0] = False
            net.supply[0] = 0.5 * speed * grid.volume_y[0] * grid.radius[0] * ends.theta * faces.thickness[0, 0]

    def turned_round(self, values: Values) -> Values:
        """Values at the nodes of the film at those of the one mirrored in x, in the first axis."""
        back = values[::-1]
        return cast(Values, np.roll(back, 1, axis=0) if self.problem.shape.joined[0] else back.copy())

    @cached_property
    def mirrored(self) -> "MovingFilm":
        """The film mirrored in x; its wall slides towards increasing x at the same speed."""
        breaks, grid, joined = self.problem.shape.breaks, self.grid, self.problem.shape.joined[0]
        ends, last = breaks[0] + breaks[-1], breaks[-1] - JOINT * self.problem.shape.length
        x = self.turned_round(ends - grid.x)

        def back(place: Array) -> Array:
            """The position before, that of the joint of a periodic film at its beginning."""
            before = ends - place
            return np.where(before > last, before - self.problem.shape.length, before) if joined else before

        def covers(inflow: Inflow) -> Inflow:
            return replace(inflow, covers=lambda x, y: inflow.covers(back(x), y))

        def normal(one: Normal) -> Normal:
            return lambda x, y: one(ends - x, y)

        return replace(
            self,
            problem=replace(
                mirrored(self.problem),
                speed=abs(self.problem.speed),
                inflows=tuple(map(covers, self.problem.inflows)),
                at_nodes=self._turned_round(self.problem.at_nodes),
            ),
            grid=replace(
                grid,
                x=np.append(breaks[0], x[1:]) if joined else x,
                spacing_x=grid.spacing_x[::-1] if joined else np.append(grid.spacing_x[-2::-1], 0.0),
                volume_x=self.turned_round(grid.volume_x),
            ),
            normals=tuple(map(normal, self.normals)),
            inflows=tuple(map(covers, self.inflows)),
        )

    def _turned_round(self, viscosities: Viscosities | None) -> Viscosities | None:
        """The viscosities at the nodes of the film at those of the one mirrored in x."""
        if viscosities is None:
            return None
        return Viscosities(
            flow=self.turned_round(viscosities.flow),
            shear=self.turned_round(viscosities.shear),
            carried=self.turned_round(viscosities.carried),
        )

    def force(self, pressure: Array) -> Array:
        """∫ (p - p_ambient) ∂h/∂q dA of each coordinate, N (N m of an angle), from p at the nodes, Pa."""
        return np.asarray((pressure - self.ambient).ravel() @ self.weights)

    def contact_at(self, place: Array) -> ContactForce:
        """The forces of the contact of the walls at coordinates q, with one point in each quarter of a control volume.

        Raises
        ------
        InputError
            If the walls are closer than the contact pressure is known for.
        """
        if self.contact is None:
            zero = np.zeros(place.size)
            return ContactForce(force=zero, stiffness=np.zeros((place.size, place.size)), sizes=zero)
        rest, modes, weights = self._quarters
        return contact_force(self.contact, rest + modes @ place, modes, weights)

    @cached_property
    def _quarters(self) -> tuple[Array, Array, Array]:
        """h₀ and n at the points of the contact, and the force by a pressure there, which acts at the node, m²."""
        shape = self.problem.shape
        points = [
            (shape.thickness(x, y)[area > 0], self.modes(x, y)[area > 0], (area[..., None] * self.at_nodes)[area > 0])
            for x, y, area in quarters(shape, self.grid)
        ]
        rest, modes, weights = (np.concatenate(parts) for parts in zip(*points, strict=True))
        return rest, modes, self.sides * weights

    def room(self, place: Array) -> float:
        """The least film thickness minus the smallest that has a solution, m, where the film is sampled.

        The latter is ``closest``, or with contact the smallest separation whose contact pressure is known.
        """
        return min(float(gap.min()) for gap, _ in self._gaps(place))

    def closing(self, place: Array, moved: Array) -> float:
        """The largest fraction of the distances of :meth:`room` that a change of the coordinates closes."""
        return max(float((-(modes @ moved) / np.maximum(gap, TINY)).max()) for gap, modes in self._gaps(place))

    def _gaps(self, place: Array) -> Iterator[tuple[Array, Array]]:
        """The distances of :meth:`room` and ∂h/∂q: at the nodes, and of rough walls wherever the film is sampled.

        The smallest separation of flattened walls may be as near between nodes as it is far from 0 at them.
        """
        smallest = self.closest if self.contact is None else self.contact.closest
        if self.contact is None and smallest == 0:
            rest, modes = self._beside
            yield rest + modes @ place, self.at_nodes
            return
        for rest, modes in (self._sampled[:2], self._between, self._quarters[:2]):
            yield rest + modes @ place - smallest, modes

    @cached_property
    def _between(self) -> tuple[Array, Array]:
        """h₀ and n in the middle between nodes along the film, where averaged roughness is sampled."""
        x, y = np.meshgrid(self.grid.x + self.grid.spacing_x / 2, self.grid.y, indexing="ij")
        return self.problem.shape.thickness(x, y), self.modes(x, y)

    @cached_property
    def _beside(self) -> tuple[Array, Array]:
        """h₀ and n at the nodes, the mean over both sides of a step, as the film thickness has it."""
        rest, modes, (shape, *_) = self._sampled
        count = math.prod(shape)
        return rest[:count].reshape(shape).mean(axis=0), modes[:count].reshape(*shape, -1).mean(axis=0)

    @cached_property
    def weights(self) -> Array:
        """The force on each coordinate by a pressure at each node, m² (m³ of an angle), shape (nodes, coordinates)."""
        areas = np.repeat(self.grid.areas[..., None], len(self.normals), axis=-1)
        if self.problem.shape.idle and self.turns is not None:
            with_film = np.sum([area for _, _, area in quarters(self.problem.shape, self.grid)], axis=0)
            areas[..., self.turns] = with_film[..., None]
        return self.sides * (areas * self.at_nodes).reshape(-1, len(self.normals))

    @cached_property
    def reach(self) -> Array:
        """The largest |∂h/∂q| of each coordinate."""
        return np.asarray(np.abs(self.at_nodes).max(axis=(0, 1)))
