"""A mixed film between bodies that bend: pressures of film and asperities push the walls apart all around."""

from dataclasses import dataclass, replace
from math import exp

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.contact.mechanics.half_space import HalfSpace
from roughfilm.rom.bearing.mixed.balance import Speed, balanced
from roughfilm.rom.bearing.mixed.film import MixedFilm, MixedState, mixed_problem, mixed_state
from roughfilm.rom.bearing.mixed.touching import touching
from roughfilm.rom.bearing.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shapes import Journal
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution, solve

STEPS, HALVINGS, ENOUGH = 40, 12, 1e-4
"""Of Newton's method, and of one of its steps, at most; and by which part a whole step makes the residual smaller."""

ROUGHLY, SPARE = 1e-3, 0.1
"""Accuracy of the rigid film from which bending begins; and that of the displacement, over that of the load."""

MOST_BENT = 100.0
"""Times the load over E* and the pad's longer side: further than this bodies are not bent."""

KRYLOV, FORCING = 60, 1e-2
"""Films in a step, at most, and by how much they reduce its residual."""

DIFFERENCE = 1e-4
"""Of the size of the unknowns: over which derivatives are taken."""


@dataclass(frozen=True, kw_only=True)
class ElasticState:
    """A mixed film and the bodies that it bends, in balance.

    Attributes
    ----------
    mixed : the film, its asperities and their loads; the ``film`` of its scene is what it would be without bending.
    x, y : middles of the elements of the bodies' surface, m, four to a cell of the film.
    displacement : by which the walls are bent apart, m, shape (x, y).
    separation : α with it, m.
    pressure : of film and asperities together, above ambient, Pa.
    residual : the largest error of the displacement, over α at the first touch or the largest displacement.
    films : that were solved.
    """

    mixed: MixedState
    x: Array
    y: Array
    displacement: Array
    separation: Array
    pressure: Array
    residual: float
    films: int

    @property
    def load(self) -> float:
        """Of film and asperities together, N."""
        return self.mixed.load

    @property
    def solution(self) -> Solution:
        """The film."""
        return self.mixed.solution


def elastic_equilibrium(
    film: MixedFilm, composite_modulus: float, pressure: float, speed: float, *, tolerance: float = 1e-6
) -> ElasticState:
    """The rigid approach and the bending at which film and asperities carry a load between elastic bodies.

        α(x) = α₀ + shape(x) + u(x),    u = K ∗ (p + p_c)/E*,    ∫ (p + p_c) dA = W,

    K that of a half-space with a free surface around the pad, pressures uniform on elements (Love). For each α₀ that
    the balance of load asks for Newton's method finds u. What a change of u does to film and asperities is seen from
    films that are solved for it, within GMRES, as the operator is the identity and a compact one.

    Parameters
    ----------
    composite_modulus : E* of the two bodies, Pa.
    pressure : the load over the nominal area, Pa.
    speed : m/s.
    tolerance : of the load and of the displacement, as ``residual`` has it.

    Raises
    ------
    InputError
        For a bearing that is no pad over a rectangle, or a load that its walls do not carry.
    ConvergenceError
        If the displacement or the load does not come to the tolerance.

    Valid for bodies much larger than the pad. Sources: Sahlin 2008, E.3.2; Love 1929, doi:10.1098/rsta.1929.0009.
    """
    geometry = film.scene.geometry
    if isinstance(geometry, Journal | Ring) or geometry.width is None:
        raise InputError("scene.geometry: an elastic body needs a pad over a rectangle, with a width")
    if not 0 < composite_modulus < float("inf"):
        raise InputError(f"composite modulus: got {composite_modulus!r} Pa; it must be above 0 and finite")
    start = balanced(Speed(film=film, speed=speed), pressure, tolerance=ROUGHLY)
    bodies = ElasticBodies(film, composite_modulus, pressure, accuracy=SPARE * tolerance)
    guess = bodies.begin(start)
    at = Speed(film=bodies, speed=speed)
    at.steepness *= exp(at.distance(guess)) / start.scene.geometry.film
    found = balanced(at, pressure, tolerance=tolerance, guess=guess)
    closest = film.asperities.closest
    if found.separation.min() <= closest:
        raise InputError(
            f"load: {pressure:.6g} Pa presses the bent walls closer than the table reaches, {closest:.4g} m; lower it, "
            "or make a table that reaches further"
        )
    return found


class ElasticBodies:
    """A mixed film between elastic bodies, by α₀, how far apart they would be if they did not bend.

    It keeps the displacement that it found last, from which the next search begins.
    """

    def __init__(self, film: MixedFilm, composite_modulus: float, pressure: float, *, accuracy: float) -> None:
        self.film, self.modulus, self.accuracy = film, composite_modulus, accuracy
        geometry = film.scene.geometry
        sides = np.array([geometry.length, geometry.width])
        self.count = 2 * film.cells
        self.spacing = sides / self.count
        self.x, self.y = ((np.arange(self.count) + 0.5) * step for step in self.spacing)
        self.half_space = HalfSpace((2 * self.count, 2 * self.count), (self.spacing[0], self.spacing[1]), "free")
        self.displacement = np.zeros((self.count, self.count))
        self.state: State | None = None
        self.films = 0
        self.area, self.touching, self.widest = film.area, film.touching, film.widest
        self.closest = film.closest - MOST_BENT * pressure / composite_modulus * float(sides.max())

    def begin(self, rigid: MixedState) -> float:
        """Bend as the pressures of rigid bodies would; returns the α₀ at which they are as near as those, m."""
        self.state = rigid.solution.state
        pressure = self._on_elements(rigid.solution) + self._asperities(rigid.scene.geometry.film_shape())
        self.displacement = self._bent(pressure)
        return rigid.scene.geometry.film - float(self.displacement.min())

    def contact_load(self, _separation: float) -> float:
        """None is known before the bodies are bent."""
        return 0.0

    def at(self, separation: float, speed: float, _start: State | None = None) -> ElasticState:
        """The bending at an α₀, m, and a speed, m/s.

        Raises
        ------
        ConvergenceError
            If it does not come to the accuracy.
        """
        scene = self.film.scene_at(separation, speed)
        problem = mixed_problem(scene, self.film.asperities)
        values, height = self.displacement, self.film.touching
        found, rest = self._solved(problem, values)
        for _ in range(STEPS):
            worst = float(np.abs(rest).max()) / max(height, float(np.abs(values).max()))
            if worst <= self.accuracy:
                return self._told(scene, found, values, worst)
            change = self._step(problem, values, rest)
            part = 1.0
            for _ in range(HALVINGS):
                found, tried = self._solved(problem, values + part * change)
                if np.linalg.norm(tried) < (1 - ENOUGH * part) * np.linalg.norm(rest):
                    break
                part /= 2
            else:
                break
            values, rest = values + part * change, tried
        raise ConvergenceError(
            f"elastic body: the residual of {worst:.1e} misses the tolerance of {self.accuracy:.1e}; take stiffer "
            "bodies or a lower load",
            outcome=Outcome.STALLED,
            iterations=STEPS,
        )

    def _step(self, problem: Problem, values: Array, rest: Array) -> Array:
        """What takes the residual away, to first order."""
        height = self.film.touching

        def product(way: Array) -> Array:
            step = DIFFERENCE * height / (float(np.abs(way).max()) or 1.0)
            moved = values + step * way.reshape(values.shape)
            return ((self._solved(problem, moved)[1] - rest) / step).reshape(-1)

        operator = scipy.sparse.linalg.LinearOperator((values.size, values.size), matvec=product, dtype=np.float64)
        change, _ = scipy.sparse.linalg.gmres(
            operator, -rest.reshape(-1) / height, rtol=FORCING, restart=KRYLOV, maxiter=1
        )
        return np.asarray(height * change.reshape(values.shape))

    def _solved(self, problem: Problem, displacement: Array) -> tuple[Solution, Array]:
        """The film between bodies bent by u, m, and u less the displacement that its pressures make."""
        shape = self._shape(problem.shape, displacement)
        cells = (self.film.cells, self.film.cells)
        found = solve(replace(problem, shape=shape), cells, start=self.state, tolerance=self.film.residual)
        self.state = found.state
        self.films += 1
        return found, displacement - self._bent(self._on_elements(found) + self._asperities(shape))

    def _bent(self, pressure: Array) -> Array:
        """The displacement that pressures on the elements make, m."""
        return np.asarray(self.half_space.displacement(pressure) / self.modulus)

    def _shape(self, rigid: Shape, displacement: Array) -> Shape:
        """The film's shape with the bending added; nowhere closer than the asperities are known."""
        around = np.pad(displacement, 1, mode="reflect", reflect_type="odd")  # goes on evenly beyond the edges
        closest = self.film.asperities.closest

        def thickness(x: Array, y: Array) -> Array:
            places = np.array(np.broadcast_arrays(x / self.spacing[0] + 0.5, y / self.spacing[1] + 0.5))
            bent = rigid.thickness(x, y) + scipy.ndimage.map_coordinates(around, places, order=1, mode="nearest")
            return np.asarray(np.maximum(bent, closest))

        return replace(rigid, thickness=thickness)

    def _on_elements(self, found: Solution) -> Array:
        """The film's pressure above ambient in the middles of the elements, linear between the nodes."""
        low, high = found.problem.shape.breaks[0], found.problem.shape.breaks[-1]
        pressure = found.state.pressure + self.film.scene.lubricant.cavitation_pressure
        x = found.grid.x
        if found.turned:
            x, pressure = (low + high - x)[::-1], pressure[::-1]
        between = scipy.interpolate.RegularGridInterpolator((x, found.grid.y), pressure)
        return np.asarray(between(tuple(np.meshgrid(self.x, self.y, indexing="ij"))))

    def _asperities(self, shape: Shape) -> Array:
        """Contact pressure on the elements."""
        return np.asarray(self.film.asperities.contact_pressure(self._separation(shape)))

    def _separation(self, shape: Shape) -> Array:
        """The separation of the walls in the middles of the elements, m."""
        return np.asarray(shape.thickness(*np.meshgrid(self.x, self.y, indexing="ij")))

    def _told(self, scene: Bearing, found: Solution, displacement: Array, worst: float) -> ElasticState:
        """The state of a displacement that balances."""
        self.displacement = displacement
        rigid = scene.geometry.film_shape()
        shape = self._shape(rigid, displacement)
        contact = touching(found.problem.shape, found.grid, self.film.asperities)
        return ElasticState(
            mixed=mixed_state(scene, found, contact),
            x=self.x,
            y=self.y,
            displacement=displacement,
            separation=self._separation(shape),
            pressure=self._on_elements(found) + self._asperities(shape),
            residual=worst,
            films=self.films,
        )
