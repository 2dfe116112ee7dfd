"""Press a rough surface against a flat plane: elastic or elastic-plastic contact without friction or adhesion."""

import math
from functools import cached_property

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.half_space import Boundary, HalfSpace
from roughfilm.contact.mechanics.loop_ranges import Pieces
from roughfilm.contact.mechanics.projected_gradients import minimise, plane_of, violation_of
from roughfilm.contact.mechanics.starts import refined, shifted, signed
from roughfilm.contact.surfaces.surface import MAX_LENGTH, MAX_POINTS, MIN_SPACING

COMPLEMENTARITY_TOLERANCE = 1e-8
"""Of the complementarity, over the rms height."""

SEARCH_TOLERANCE_FRACTION = 0.9
"""The search goes to this part of the tolerance, as what it finds is rounded to the load and judged afresh."""

MAX_ITERATIONS = 2000

COARSEST_GRID_POINTS = 128
"""Points along the shorter side of the coarsest grid that a search begins on."""

NODES_PER_THREAD = 1 << 18
"""Nodes for each thread, at least: with fewer, waiting for each other costs more than is shared."""

COARSE_GRID_TOLERANCE = 0.03
"""Tolerance of the coarser grids."""


class Press:
    """A rough surface ready to be pressed, its transforms planned.

    At a load W it finds p with 0 <= p <= H and mean W such that the deformed gap h1 + K∗p − g00 is 0 where 0 < p < H,
    >= 0 where p = 0, and <= 0 where p = H, where the surface floats to the plane by u_p = g00 − (h1 + K∗p).
    h1 = max z − z is the gap of the undeformed surface under the plane that touches it.

    Parameters
    ----------
    heights : z, shape (nx, ny), m, upward. A side of one node makes it line contact, in plane strain.
    spacing : (dx, dy), m.
    composite_modulus : E*, Pa; see ``roughfilm.contact.mechanics.solid``.
    hardness : H, Pa.
    boundary : "periodic": K answers 2/(E* |q|) to the wave vector q, and the mean pressure moves nothing; "free": the
        surface stands alone on the half-space, K is Love's (a line load's displacement is then against one a grid
        length away). It costs four times as much.
    threads : that share the work.

    Raises
    ------
    InputError
        If something is out of range or not finite.

    Notes
    -----
    Every node is a pixel of constant pressure. Against a smooth surface the area of contact converges with the first
    order of the spacing, mean gap and approach with the second; on a rough surface pixels must resolve the shortest
    wave. Source: thesis, E.2.2, Eqs. E.5–E.12.
    """

    def __init__(
        self,
        heights: Array,
        spacing: tuple[float, float],
        composite_modulus: float,
        *,
        hardness: float = math.inf,
        boundary: Boundary = "periodic",
        threads: int = 1,
    ) -> None:
        self.heights = _checked_heights(heights)
        self.spacing = _checked_spacing(spacing)
        if not (composite_modulus > 0 and math.isfinite(composite_modulus)):
            raise InputError(f"contact: got a composite modulus of {composite_modulus:g} Pa; it must be above 0")
        if not hardness > 0:
            raise InputError(f"contact: got a hardness of {hardness:g} Pa; it must be above 0, leave it out if elastic")
        if boundary not in ("periodic", "free"):
            raise InputError(f"contact: got boundary {boundary!r}; it must be periodic or free")
        if threads < 1:
            raise InputError(f"contact: got {threads} threads; it must be 1 or more")
        self.composite_modulus, self.hardness, self.boundary = composite_modulus, hardness, boundary
        shape = self.heights.shape
        self._grid = shape if boundary == "periodic" else _doubled(shape)
        self._part = tuple(slice(n) for n in shape)
        self._length = max(n * d for n, d in zip(shape, self.spacing, strict=True))
        self._down = self.heights.mean() - self.heights
        self._team = Team(min(threads, max(1, math.prod(self._grid) // NODES_PER_THREAD)))
        self._threads = threads
        dx, dy = self.spacing
        self._half_space = HalfSpace(self._grid, (dx / self._length, dy / self._length), boundary, self._team)

    def at(self, load: float, *, tolerance: float = COMPLEMENTARITY_TOLERANCE, start: Contact | None = None) -> Contact:
        """The contact under a mean pressure over the nominal area.

        Parameters
        ----------
        load : W, Pa, above 0 and at most H.
        tolerance : of the complementarity, over the rms height.
        start : the contact of this surface under another load, to begin from; by default that under this load on a grid
            twice as coarse, roughly.

        Raises
        ------
        InputError
            If the load or the tolerance is out of range, or ``start`` has another shape.
        ConvergenceError
            If the conditions of contact stay broken by more than the tolerance.
        """
        if not (load > 0 and math.isfinite(load)):
            raise InputError(f"contact: got a load of {load:g} Pa; it must be above 0 and finite")
        if load > self.hardness:
            raise InputError(
                f"contact: got a load of {load:g} Pa, above the hardness of {self.hardness:g} Pa, "
                "which is all that the whole area can bear; lower the load"
            )
        if not 1e-13 <= tolerance < 1:
            raise InputError(f"contact: got a tolerance of {tolerance:g}; it must be 1e-13 to 1")
        if start is not None and start.pressure.shape != self.heights.shape:
            raise InputError(f"contact: got a start of shape {start.pressure.shape}; it must be {self.heights.shape}")
        if load == self.hardness:
            return self.contact_of(load, np.full(self.heights.shape, self.hardness), 0)
        if self.boundary == "periodic":
            least, most = self._full_contact
            if load + least >= 0 and load + most <= self.hardness:
                return self.contact_of(load, load + self._full_pressure(), 0)
        return self._search(load, tolerance, start)

    @cached_property
    def _full_contact(self) -> tuple[float, float]:
        """The least and the most that full contact adds to the mean pressure, Pa."""
        pressure = self._full_pressure()
        return float(pressure.min()), float(pressure.max())

    def _full_pressure(self) -> Array:
        """What full contact adds to the mean pressure, Pa."""
        return -self.composite_modulus * self._half_space.pressure(self._down / self._length)

    def _search(self, load: float, tolerance: float, start: Contact | None) -> Contact:
        unit = self._unit(load)
        pressure_unit = self.composite_modulus * unit / self._length
        hardness = self.hardness / pressure_unit
        found, iterations = minimise(
            self._half_space,
            self._spread(self._down / unit, math.inf),
            self._spread((self._begin(load) if start is None else self._moved(start, load)) / pressure_unit, 0.0),
            hardness,
            tolerance=SEARCH_TOLERANCE_FRACTION * tolerance,
            most_iterations=MAX_ITERATIONS,
            pieces=Pieces(math.prod(self._grid), self._team),
        )
        found = found.reshape(self._grid)[self._part]
        found = np.where(found >= hardness, self.hardness, found * pressure_unit)
        contact = self.contact_of(load, _scaled(found, load, self.hardness), iterations)
        if contact.complementarity > tolerance:
            raise ConvergenceError(
                f"contact: {Outcome.STALLED} with the conditions of contact broken by {contact.complementarity:.2g} "
                f"of the rms height once computed afresh, above {tolerance:.2g}; ask for a looser tolerance",
                outcome=Outcome.STALLED,
                iterations=iterations,
            )
        return contact

    def _begin(self, load: float) -> Array:
        """Pressure to begin from: that of a grid twice as coarse, which costs a fourth; the load, on a small one."""
        everywhere = np.full(self.heights.shape, load)
        if min(self.heights.shape) < 2 * COARSEST_GRID_POINTS or any(n % 2 for n in self.heights.shape):
            return everywhere
        dx, dy = self.spacing
        coarser = Press(
            self.heights[::2, ::2],
            (2 * dx, 2 * dy),
            self.composite_modulus,
            hardness=self.hardness,
            boundary=self.boundary,
            threads=self._threads,
        )
        try:
            found = coarser.at(load, tolerance=COARSE_GRID_TOLERANCE)
        except ConvergenceError:
            return everywhere
        return shifted(refined(signed(found, self.composite_modulus)), load, self.hardness)

    def _moved(self, start: Contact, load: float) -> Array:
        """The pressure at another load brought to this one."""
        return shifted(signed(start, self.composite_modulus), load, self.hardness)

    def _spread(self, values: Array | float, beyond: float) -> Array:
        """Values at the surface's nodes, and another beyond them, over the whole grid, flat."""
        grid = np.full(self._grid, beyond)
        grid[self._part] = values
        return grid.reshape(-1)

    def _unit(self, load: float) -> float:
        """The rms height, or for a flat punch what the load moves, m."""
        return float(self._down.std()) or load / self.composite_modulus * self._length

    def contact_of(self, load: float, pressure: Array, iterations: int) -> Contact:
        """What a pressure does, and how well it keeps the conditions of contact, computed afresh."""
        base = load if self.boundary == "periodic" else 0.0
        elastic = self._half_space.displacement((pressure - base) / self.composite_modulus) * self._length
        deformed = self._down + elastic
        plane = plane_of(pressure, deformed, self.hardness)
        violation = violation_of(pressure, deformed, plane, self.hardness)
        over = np.subtract(deformed, plane, out=deformed)
        return Contact(
            load=load,
            hardness=self.hardness,
            heights=self.heights,
            spacing=self.spacing,
            pressure=pressure,
            elastic_displacement=elastic,
            plastic_displacement=np.where(pressure >= self.hardness, np.maximum(-over, 0), 0.0),
            approach=plane - float(self._down.min()),
            gap=np.where(pressure > 0, 0.0, np.maximum(over, 0)),
            complementarity=violation / self._unit(load),
            iterations=iterations,
        )


def _checked_heights(heights: Array) -> Array:
    array = np.array(heights, dtype=np.float64)
    if array.ndim != 2 or array.size < 2:
        raise InputError(f"contact: got heights of shape {array.shape}; give (nx, ny), one of them 1 in line contact")
    if array.size > MAX_POINTS:
        raise InputError(f"contact: got {array.size} heights; at most {MAX_POINTS} can be pressed")
    if not np.isfinite(array).all():
        raise InputError("contact: got heights that are not finite; fill them first")
    if np.abs(array).max() > MAX_LENGTH:
        raise InputError(f"contact: got a height of {np.abs(array).max():.3g} m; look at the unit")
    array.flags.writeable = False
    return array


def _checked_spacing(spacing: tuple[float, float]) -> tuple[float, float]:
    if len(spacing) != 2 or not all(MIN_SPACING <= length < MAX_LENGTH for length in spacing):
        raise InputError(f"contact: got spacing {spacing!r}; give two lengths in m, 1e-15 or more")
    dx, dy = spacing
    return float(dx), float(dy)


def _doubled(shape: tuple[int, ...]) -> tuple[int, int]:
    nx, ny = (1 if n == 1 else scipy.fft.next_fast_len(2 * n, real=True) for n in shape)
    return nx, ny


def _scaled(pressure: Array, load: float, hardness: float) -> Array:
    """A pressure of another load brought to this one within its bounds; uniform where that cannot be done."""
    for _ in range(50):
        inside = (pressure > 0) & (pressure < hardness)
        missing = load * pressure.size - pressure.sum()
        carried = pressure[inside].sum()
        if abs(missing) <= 1e-14 * load * pressure.size:
            return pressure
        if not inside.any() or missing <= -carried:
            break
        pressure = np.where(inside, np.minimum(pressure * (1 + missing / carried), hardness), pressure)
    return np.full(pressure.shape, load)
