"""Elastic or elastic-plastic contact of a rough surface with a rigid plane, without friction or adhesion."""

import math

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, unmasked
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics import kernels
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.half_space import Boundary, HalfSpace
from roughfilm.contact.mechanics.projected_gradients import minimise, plane_of, violation_of
from roughfilm.contact.mechanics.starts import refined, shifted, signed
from roughfilm.contact.surfaces.surface import MAX_LENGTH, MAX_POINTS, MIN_SPACING

COMPLEMENTARITY_TOLERANCE = 1e-8
"""Default tolerance of the complementarity, over the rms height."""

SEARCH_TOLERANCE_FRACTION = 0.9
"""Tolerance of the minimisation over that of the result, whose pressure is rescaled to the load afterwards."""

LOAD_TOLERANCE = 1e-8
"""Largest relative error of the load that the pressure carries."""

ROUNDING = 1e-14
"""Relative error of the load that is left to rounding."""

MAX_RESCALINGS = 50
"""Largest number of rescalings, each of which may bring further points to the hardness."""

MAX_ITERATIONS = 2000
"""Largest number of iterations on one grid."""

COARSEST_GRID_POINTS = 128
"""Smallest number of points along the shorter side of a coarser grid that provides a start."""

NODES_PER_THREAD = 1 << 18
"""Smallest number of nodes for each thread; with fewer, synchronisation costs more than a thread saves."""

COARSE_GRID_TOLERANCE = 0.03
"""Tolerance of the complementarity on coarser grids."""


class Press:
    """A solver for the contact of one rough surface at any load.

    At a load W the pressure p, 0 <= p <= H, has the mean W, and the deformed gap h1 + K∗p − g00 is 0 where 0 < p < H,
    >= 0 where p = 0 and <= 0 where p = H, where the surface deforms plastically by u_p = g00 − (h1 + K∗p).
    h1 = max z − z is the gap of the undeformed surface under the plane that touches it.

    Parameters
    ----------
    heights : z, shape (nx, ny), m, upward. A side of one node means line contact, in plane strain.
    spacing : (dx, dy), m.
    composite_modulus : E*, Pa; see ``roughfilm.contact.mechanics.solid``.
    hardness : H, Pa; infinite for an elastic solid.
    boundary : "periodic": K has the transfer function 2/(E* |q|), 0 for the mean pressure; "free": K is that of Love
        for a single surface on a half-space, at four times the cost; displacements in line contact are relative to a
        point one grid length away.
    threads : number of threads, 1 or more.

    Raises
    ------
    InputError
        If an argument is out of range or not finite.

    Notes
    -----
    Every node is a pixel of constant pressure. For a smooth surface the contact area converges with the first order of
    the spacing, mean gap and approach with the second; for a rough surface pixels must resolve the shortest wave.
    Source: thesis, E.2.2, Eqs. E.5–E.12.
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
        self._length = max(n * d for n, d in zip(shape, self.spacing, strict=True))
        self._highest = float(self.heights.max() - self.heights.mean())
        self._rms = float(self.heights.std())
        self._team = Team(min(threads, max(1, math.prod(self._grid) // NODES_PER_THREAD)))
        self._threads = threads
        dx, dy = self.spacing
        self._half_space = HalfSpace(self._grid, (dx / self._length, dy / self._length), boundary, self._team)

    def at(self, load: float, *, tolerance: float = COMPLEMENTARITY_TOLERANCE, start: Contact | None = None) -> Contact:
        """The contact under a mean pressure over the nominal area.

        Parameters
        ----------
        load : W, Pa, above 0 and at most H.
        tolerance : largest complementarity, over the rms height, 1e-13 to 1.
        start : contact of this surface at another load, as a start; by default the contact at this load on a grid twice
            as coarse.

        Raises
        ------
        InputError
            If the load or the tolerance is out of range, or ``start`` has another shape.
        ConvergenceError
            If the complementarity stays above the tolerance.
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
        contact = self.contact_of(load, *self._pressure(load, tolerance, start))
        excess = abs(contact.pressure.mean() / load - 1)
        if contact.complementarity > tolerance or excess > LOAD_TOLERANCE:
            raise ConvergenceError(
                f"contact: {Outcome.STALLED} with the conditions of contact broken by {contact.complementarity:.2g} "
                f"of the rms height and the load by {excess:.2g} of it once computed afresh, above {tolerance:.2g} and "
                f"{LOAD_TOLERANCE:g}; ask for a looser tolerance",
                outcome=Outcome.STALLED,
                iterations=contact.iterations,
            )
        return contact

    def _pressure(self, load: float, tolerance: float, start: Contact | None) -> tuple[Array, int]:
        """The pressure, shape (nx, ny), Pa, and the number of iterations."""
        if load == self.hardness:
            return np.full(self.heights.shape, self.hardness), 0
        if start is None:
            initial = self._initial(load)
        else:
            initial = shifted(signed(start, self.composite_modulus), load, self.hardness)
        if (full := self._full_contact(load, initial)) is not None:
            return full, 0
        pressure, iterations = self._search(load, tolerance, initial)
        full = self._full_contact(load, pressure)
        return pressure if full is None else full, iterations

    def _full_contact(self, load: float, pressure: Array) -> Array | None:
        """The pressure of full contact, Pa, if it is between 0 and H; it is computed where that of the search is."""
        if self.boundary == "free" or pressure.min() <= 0 or pressure.max() >= self.hardness:
            return None
        displacement = np.subtract(self.heights, self.heights.mean())
        displacement *= self.composite_modulus / self._length
        displacement = self._half_space.pressure(displacement) + load
        return displacement if displacement.min() >= 0 and displacement.max() <= self.hardness else None

    def _search(self, load: float, tolerance: float, initial: Array) -> tuple[Array, int]:
        unit = self._unit(load)
        pressure_unit = self.composite_modulus * unit / self._length
        hardness = self.hardness / pressure_unit
        initial /= pressure_unit
        pressure, iterations = minimise(
            self._half_space,
            self.heights,
            unit,
            self._padded(initial),
            hardness,
            tolerance=SEARCH_TOLERANCE_FRACTION * tolerance,
            most_iterations=MAX_ITERATIONS,
            team=self._team,
        )
        plastic = pressure >= hardness
        pressure *= pressure_unit
        pressure[plastic] = self.hardness
        return _scaled(pressure, load, self.hardness), iterations

    def _initial(self, load: float) -> Array:
        """Start pressure, Pa: that on a grid twice as coarse, at a fourth of the cost, or the load on a small grid."""
        uniform = np.full(self.heights.shape, load)
        if min(self.heights.shape) < 2 * COARSEST_GRID_POINTS or any(n % 2 for n in self.heights.shape):
            return uniform
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
            contact = coarser.at(load, tolerance=COARSE_GRID_TOLERANCE)
        except ConvergenceError:
            return uniform
        return shifted(refined(signed(contact, self.composite_modulus)), load, self.hardness)

    def _padded(self, pressure: Array) -> Array:
        """The pressure on the whole grid, flat; 0 outside the surface."""
        if pressure.shape == self._grid:
            return pressure.reshape(-1)
        grid = np.zeros(self._grid)
        grid[tuple(slice(n) for n in pressure.shape)] = pressure
        return grid.reshape(-1)

    def _unit(self, load: float) -> float:
        """The unit of length of the minimisation, m: the rms height, or the displacement scale of a flat punch."""
        return self._rms or load / self.composite_modulus * self._length

    def contact_of(self, load: float, pressure: Array, iterations: int) -> Contact:
        """The contact state of a pressure, shape (nx, ny), Pa, with displacement and complementarity recomputed."""
        base = load if self.boundary == "periodic" else 0.0
        elastic = self._half_space.displacement((pressure - base) / self.composite_modulus) * self._length
        gap = self.heights.mean() - self.heights
        gap += elastic
        plane = plane_of(pressure, gap, self.hardness)
        violation = violation_of(pressure, gap, plane, self.hardness)
        plastic = np.zeros(pressure.shape)
        yielded = pressure >= self.hardness
        plastic[yielded] = np.maximum(plane - gap[yielded], 0)
        kernels.separate(pressure.reshape(-1), gap.reshape(-1), plane)
        return Contact(
            load=load,
            hardness=self.hardness,
            heights=self.heights,
            spacing=self.spacing,
            pressure=pressure,
            elastic_displacement=elastic,
            plastic_displacement=plastic,
            approach=plane + self._highest,
            gap=gap,
            complementarity=violation / self._unit(load),
            iterations=iterations,
        )


def _checked_heights(heights: Array) -> Array:
    array = np.array(unmasked("contact", heights), dtype=np.float64, order="C")  # kernels write to flat views
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
    """The pressure with the mean ``load`` to rounding, rescaled where it is between 0 and the hardness.

    Points at the hardness may carry the whole load; the others then carry nothing.
    """
    for _ in range(MAX_RESCALINGS):
        inside = (pressure > 0) & (pressure < hardness)
        carried = pressure[inside].sum()
        missing = load * pressure.size - pressure.sum()
        if carried == 0 or abs(missing) <= ROUNDING * load * pressure.size:
            break
        factor = max(1 + missing / carried, 0.0)
        pressure = np.where(inside, np.minimum(pressure * factor, hardness), pressure)
    return pressure
