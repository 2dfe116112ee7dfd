"""A mixed film between elastic bodies, which deform under the pressures of film and asperities."""

from dataclasses import dataclass, replace
from math import exp

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.contact.mechanics.half_space import HalfSpace
from roughfilm.rom.bearing.equilibrium.balance import FilmsAtSpeed, balanced
from roughfilm.rom.bearing.geometry.journal import Journal
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.mixed.contact_load import asperity_load
from roughfilm.rom.bearing.mixed.film import MixedFilm, MixedState, mixed_problem, mixed_state
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.network import State
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution, solve

MAX_NEWTON_STEPS = 40
"""Largest number of Newton steps."""

MAX_HALVINGS = 12
"""Largest number of halvings of one Newton step."""

MIN_REDUCTION = 1e-4
"""Relative reduction of the residual that is required of a full Newton step."""

RIGID_TOLERANCE = 1e-3
"""Relative error of the load of the rigid film from which the deformation starts."""

DISPLACEMENT_FRACTION = 0.1
"""Tolerance of the displacement over that of the load."""

MAX_DISPLACEMENT_RATIO = 100.0
"""Largest displacement over that of the load on the longer side of the pad, W/E* times the side."""

MAX_KRYLOV_FILMS = 60
"""Largest number of films in the linear solve of one Newton step."""

LINEAR_TOLERANCE = 1e-2
"""Relative residual at which that linear solve stops."""

DIFFERENCE_STEP = 1e-4
"""Displacement over which derivatives are taken, over the separation of first contact."""


@dataclass(frozen=True, kw_only=True)
class ElasticState:
    """A converged mixed film between elastic bodies.

    Attributes
    ----------
    mixed : the film with its asperities and loads; the film thickness of its scene is that without deformation.
    x, y : centres of the surface elements of the bodies, m, four elements in a cell of the film.
    displacement : elastic increase of the separation, m, shape (x, y).
    separation : α with the displacement, m, shape (x, y).
    pressure : pressure of film and asperities together, above ambient, Pa, shape (x, y).
    residual : largest error of the displacement, over the larger of α at first contact and the largest displacement.
    films : number of film solves.
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
        """The load of film and asperities together, N."""
        return self.mixed.load

    @property
    def solution(self) -> Solution:
        """The film."""
        return self.mixed.solution


def elastic_equilibrium(
    film: MixedFilm, composite_modulus: float, pressure: float, speed: float, *, tolerance: float = 1e-6
) -> ElasticState:
    """Solve for the rigid separation and the deformation at which film and asperities carry a load.

        α(x) = α₀ + shape(x) + u(x),    u = K ∗ (p + p_c)/E*,    ∫ (p + p_c) dA = W,

    with the kernel K of a half-space with a free surface around the pad and uniform pressures on the elements (Love).
    Newton's method solves for u at each α₀ of the load balance, with GMRES and finite differences of film solves.

    Parameters
    ----------
    composite_modulus : E* of the two bodies, Pa.
    pressure : the load over the nominal area, Pa.
    speed : sliding speed, m/s.
    tolerance : relative error of the load; that of the displacement is ``DISPLACEMENT_FRACTION`` times as large.

    Raises
    ------
    InputError
        If the bearing is not a pad over a rectangle, or its walls cannot carry the load.
    ConvergenceError
        If the displacement or the load does not converge.

    Valid for bodies much larger than the pad. Sources: Sahlin 2008, E.3.2; Love 1929, doi:10.1098/rsta.1929.0009.
    """
    geometry = film.scene.geometry
    if isinstance(geometry, Journal | Ring) or geometry.width is None:
        raise InputError("scene.geometry: elastic bodies need a pad over a rectangle with a width")
    if not 0 < composite_modulus < float("inf"):
        raise InputError(f"composite modulus: got {composite_modulus!r} Pa; it must be above 0 and finite")
    start = balanced(FilmsAtSpeed(film=film, speed=speed), pressure, tolerance=RIGID_TOLERANCE)
    bodies = ElasticBodies(film, composite_modulus, pressure, accuracy=DISPLACEMENT_FRACTION * tolerance)
    guess = bodies.begin(start)
    at = FilmsAtSpeed(film=bodies, speed=speed)
    at.steepness *= exp(at.distance(guess)) / start.scene.geometry.thinnest
    state = balanced(at, pressure, tolerance=tolerance, guess=guess)
    closest = film.asperities.closest
    if state.separation.min() <= closest:
        raise InputError(
            f"load: got {pressure:.6g} Pa, which presses the walls closer than the smallest separation of the table, "
            f"{closest:.4g} m; lower the load, or make a table with larger loads"
        )
    return state


class ElasticBodies:
    """A mixed film between elastic bodies as a function of the rigid separation α₀.

    The last displacement is stored and starts the next search.
    """

    def __init__(self, film: MixedFilm, composite_modulus: float, pressure: float, *, accuracy: float) -> None:
        self.film, self.modulus, self.accuracy = film, composite_modulus, accuracy
        geometry = film.scene.geometry
        sides = np.array([geometry.length, geometry.width])
        self.cells, self.count = film.cells, 2 * film.cells
        self.spacing = sides / self.count
        self.x, self.y = ((np.arange(self.count) + 0.5) * step for step in self.spacing)
        self.half_space = HalfSpace((2 * self.count, 2 * self.count), (self.spacing[0], self.spacing[1]), "free")
        self.displacement = np.zeros((self.count, self.count))
        self.state: State | None = None
        self.films = 0
        self.area, self.touching, self.widest = film.area, film.touching, film.widest
        self.remedy = film.remedy
        self.closest = film.closest - MAX_DISPLACEMENT_RATIO * pressure / composite_modulus * float(sides.max())

    def begin(self, rigid: MixedState) -> float:
        """Deform the bodies under the pressures of a rigid film; return the α₀ with the same minimum film, m."""
        self.state = rigid.solution.state
        pressure = self._on_elements(rigid.solution) + self._asperities(rigid.scene.geometry.film_shape())
        self.displacement = self._deformation(pressure)
        return rigid.scene.geometry.thinnest - float(self.displacement.min())

    def contact_load(self, _separation: float) -> float:
        """0, because no part of the load is known without solving a film."""
        return 0.0

    def at(self, separation: float, speed: float, _start: State | None = None) -> ElasticState:
        """Solve for the displacement at a rigid separation α₀, m, and a speed, m/s.

        Raises
        ------
        ConvergenceError
            If the displacement does not converge.
        """
        scene = self.film.scene_at(separation, speed)
        problem = mixed_problem(scene, self.film.asperities)
        values, height = self.displacement, self.film.touching
        solution, rest = self._solved(problem, values)
        for _ in range(MAX_NEWTON_STEPS):
            worst = float(np.abs(rest).max()) / max(height, float(np.abs(values).max()))
            if worst <= self.accuracy:
                return self._state(scene, solution, values, worst)
            change = self._step(problem, values, rest)
            fraction = 1.0
            for _ in range(MAX_HALVINGS):
                solution, tried = self._solved(problem, values + fraction * change)
                if np.linalg.norm(tried) < (1 - MIN_REDUCTION * fraction) * np.linalg.norm(rest):
                    break
                fraction /= 2
            else:
                break
            values, rest = values + fraction * change, tried
        raise ConvergenceError(
            f"elastic body: the residual is {worst:.1e}, above the tolerance of {self.accuracy:.1e}; take stiffer "
            "bodies or a lower load",
            outcome=Outcome.STALLED,
            iterations=MAX_NEWTON_STEPS,
        )

    def _step(self, problem: Problem, values: Array, rest: Array) -> Array:
        """The Newton step from the residual ``rest``."""
        height = self.film.touching

        def product(direction: Array) -> Array:
            step = DIFFERENCE_STEP * height / (float(np.abs(direction).max()) or 1.0)
            moved = values + step * direction.reshape(values.shape)
            return ((self._solved(problem, moved)[1] - rest) / step).reshape(-1)

        operator = scipy.sparse.linalg.LinearOperator((values.size, values.size), matvec=product, dtype=np.float64)
        change, _ = scipy.sparse.linalg.gmres(
            operator, -rest.reshape(-1) / height, rtol=LINEAR_TOLERANCE, restart=MAX_KRYLOV_FILMS, maxiter=1
        )
        return np.asarray(height * change.reshape(values.shape))

    def _solved(self, problem: Problem, displacement: Array) -> tuple[Solution, Array]:
        """The film at a displacement u, m, and u minus the displacement by its pressures, m."""
        shape = self._shape(problem.shape, displacement)
        cells = (self.film.cells, self.film.cells)
        solution = solve(replace(problem, shape=shape), cells, start=self.state, tolerance=self.film.residual)
        self.state = solution.state
        self.films += 1
        return solution, displacement - self._deformation(self._on_elements(solution) + self._asperities(shape))

    def _deformation(self, pressure: Array) -> Array:
        """The displacement by pressures on the elements, m."""
        return np.asarray(self.half_space.displacement(pressure) / self.modulus)

    def _shape(self, rigid: Shape, displacement: Array) -> Shape:
        """The shape of the film with the displacement, at least the smallest separation of the asperities."""
        around = np.pad(displacement, 1, mode="reflect", reflect_type="odd")  # linear extrapolation beyond the edges
        closest = self.film.asperities.closest

        def thickness(x: Array, y: Array) -> Array:
            places = np.array(np.broadcast_arrays(x / self.spacing[0] + 0.5, y / self.spacing[1] + 0.5))
            deformed = rigid.thickness(x, y) + scipy.ndimage.map_coordinates(around, places, order=1, mode="nearest")
            return np.asarray(np.maximum(deformed, closest))

        return replace(rigid, thickness=thickness)

    def _on_elements(self, solution: Solution) -> Array:
        """The pressure of the film above ambient at the centres of the elements, Pa, linear between the nodes."""
        low, high = solution.problem.shape.breaks[0], solution.problem.shape.breaks[-1]
        pressure = solution.state.pressure + self.film.scene.lubricant.cavitation_pressure
        x = solution.grid.x
        if solution.turned:
            x, pressure = (low + high - x)[::-1], pressure[::-1]
        between = scipy.interpolate.RegularGridInterpolator((x, solution.grid.y), pressure)
        return np.asarray(between(tuple(np.meshgrid(self.x, self.y, indexing="ij"))))

    def _asperities(self, shape: Shape) -> Array:
        """The contact pressure on the elements, Pa."""
        return np.asarray(self.film.asperities.contact_pressure(self._separation(shape)))

    def _separation(self, shape: Shape) -> Array:
        """The separation of the walls at the centres of the elements, m."""
        return np.asarray(shape.thickness(*np.meshgrid(self.x, self.y, indexing="ij")))

    def _state(self, scene: Bearing, solution: Solution, displacement: Array, worst: float) -> ElasticState:
        """The state of a converged displacement."""
        self.displacement = displacement
        rigid = scene.geometry.film_shape()
        shape = self._shape(rigid, displacement)
        contact = asperity_load(solution.problem.shape, solution.grid, self.film.asperities)
        return ElasticState(
            mixed=mixed_state(scene, solution, contact),
            x=self.x,
            y=self.y,
            displacement=displacement,
            separation=self._separation(shape),
            pressure=self._on_elements(solution) + self._asperities(shape),
            residual=worst,
            films=self.films,
        )
