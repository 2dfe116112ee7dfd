"""A rough gap: two walls that repeat themselves in both directions, and a liquid driven through between them."""

import math
from functools import lru_cache
from typing import Annotated, Literal, Self

import numpy as np
from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from roughfilm.contact.foundation.entries import InUnit, Length, Part, PositiveNumber
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.parts.pressed_surface import Load, RoughScene
from roughfilm.rom.parts.restriction import restricted
from roughfilm.rom.parts.solids import Counter, RoughBody, composite_modulus, hardness
from roughfilm.rom.pocket.scene import NewtonianLubricant
from roughfilm.rom.rough_gap.flow.range_of_validity import ROUGHEST, expected_excess
from roughfilm.rom.rough_gap.geometry import GapGeometry
from roughfilm.rom.rough_gap.walls import Walls

FEWEST_LAYERS = 4
"""Cells across the gap."""

SMALLEST = 0.01
"""Of the mean gap: where the walls are nearer to each other than this, they count as touching."""


def _layers(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError(f"got {value!r}; write a whole number of cells across the gap")
    return value


def _enough(value: int) -> int:
    if not FEWEST_LAYERS <= value <= 1000:
        raise ValueError(f"got {value}; too few or too many layers, it must be {FEWEST_LAYERS} to 1000")
    return value


class Drive(Part):
    """What drives the flow: the mean pressure gradient G, Pa/m, or the Reynolds number that gives it; exactly one.

    Re = ρ q/η with the flow per width q = h̄³G/(12η) of a smooth gap as thick as the mean one.
    """

    pressure_gradient: Annotated[float, InUnit("Pa/m")] | None = None
    reynolds_number: PositiveNumber | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.pressure_gradient is None) == (self.reynolds_number is None):
            found = "neither" if self.pressure_gradient is None else "both"
            raise ValueError(f"got {found} of pressure_gradient and reynolds_number; give exactly one")
        return self


class Mesh(Part):
    """How the gap is cut: cells across it (by default a quarter of the columns), and the smallest gap that is open, m.

    Where the walls are nearer to each other than ``smallest_gap`` they count as touching, for every model; by default
    where they are nearer than ``SMALLEST`` of the mean gap.
    """

    layers: Annotated[int, BeforeValidator(_layers), AfterValidator(_enough)] | None = None
    smallest_gap: Length | None = None


class RoughGap(RoughScene):
    """One period of a gap between a rough wall at rest and another wall, in a steady, isothermal, incompressible flow.

    The flow is driven three times: by the mean pressure gradient along x, by the same along y, and by the upper wall
    sliding along x, if it is flat, so fast that a smooth gap would carry as much as under that gradient.

    ``fields`` of its results: ``gap``, m, and ``flow``, the size of the flow per width under the gradient along x,
    m²/s, both of shape (nx, ny). Models that resolve the film add ``vertices`` (nx+1, ny+1, nz+1, 3), ``kept``
    (nx, ny), and of the same flow ``cell_velocity`` (nx, ny, nz, 3) and ``cell_pressure`` (nx, ny, nz).
    """

    kind: Literal["rough_gap"]
    geometry: GapGeometry
    lubricant: NewtonianLubricant
    flow: Drive
    solid: RoughBody | None = None
    counter: Counter | None = None
    load: Load | None = None
    mesh: Mesh = Field(default_factory=Mesh)

    @model_validator(mode="after")
    def _is_a_gap(self) -> Self:
        if self.load is None:
            if self.solid is not None or self.counter is not None:
                raise ValueError("load: is missing; give [load] with a pressure, or leave the solids out")
            if self.geometry.mean_gap is None:
                raise ValueError("geometry.mean_gap: is missing; give it, or [solid] and [load] that press the walls")
        else:
            if self.solid is None:
                raise ValueError("solid: is missing; a load needs the solid that it presses")
            if self.geometry.mean_gap is not None:
                raise ValueError("geometry.mean_gap: the load makes the gap; leave mean_gap or [load] out")
            if self.load.pressure > hardness(self.solid):
                raise ValueError(f"load.pressure: got {self.load.pressure:.6g} Pa, above the hardness; lower the load")
        self._walls_do_not_cross()
        try:
            number = self.reynolds_number
            derived = [self.pressure_gradient, self.nominal_flow, self.sliding_speed]
        except (OverflowError, ZeroDivisionError):
            number, derived = math.nan, []
        if not all(1e-100 < value < 1e100 for value in (number, *derived)):
            raise ValueError("flow: lubricant, gap and drive give numbers beyond reckoning; look at the units")
        if not 1e-12 <= number <= 1e12:
            raise ValueError(f"flow: got Reynolds number {number:.3g}; it must be 1e-12 to 1e12, look at the units")
        return self

    def _walls_do_not_cross(self) -> None:
        if self.geometry.mean_gap is None:
            return
        lower, upper = self.geometry.heights()
        nearest = float((upper - lower).min())
        if self.geometry.mean_gap + nearest < 0:
            raise ValueError(
                f"geometry.mean_gap: got {self.geometry.mean_gap:.6g} m, but the walls cross, as they come up to "
                f"{-nearest:.6g} m nearer than on average; raise it above that, or press them with [solid] and [load]"
            )

    @property
    def mean_gap(self) -> float:
        """h̄ on the surface's own points, m, contact among them; the unit of length inside the solvers."""
        if self.geometry.mean_gap is not None:
            return self.geometry.mean_gap
        return self._walls(max(self.surface().shape)).mean_gap

    @property
    def smallest_gap(self) -> float:
        """Below it the walls count as touching, m."""
        return SMALLEST * self.mean_gap if self.mesh.smallest_gap is None else self.mesh.smallest_gap

    @property
    def layers(self) -> int | None:
        """Cells across the gap; None for the default."""
        return self.mesh.layers

    @property
    def viscosity(self) -> float:
        """η, Pa s."""
        return self.lubricant.viscosity

    @property
    def density(self) -> float:
        """ρ, kg/m³."""
        return self.lubricant.density

    @property
    def pressure_gradient(self) -> float:
        """G, Pa/m."""
        if self.flow.pressure_gradient is not None:
            return self.flow.pressure_gradient
        assert self.flow.reynolds_number is not None
        return 12 * self.flow.reynolds_number * self.viscosity**2 / (self.density * self.mean_gap**3)

    @property
    def reynolds_number(self) -> float:
        """Re = ρ q/η of a smooth gap as thick as the mean one."""
        if self.flow.reynolds_number is not None:
            return self.flow.reynolds_number
        return self.density * self.mean_gap**3 * self.pressure_gradient / (12 * self.viscosity**2)

    @property
    def nominal_flow(self) -> float:
        """Flow per width q = h̄³G/(12η), m²/s, of a smooth gap as thick as the mean one."""
        return self.mean_gap**3 * self.pressure_gradient / (12 * self.viscosity)

    @property
    def sliding_speed(self) -> float:
        """Speed u = 2q/h̄, m/s: at it a smooth gap carries the nominal flow without a gradient."""
        return 2 * self.nominal_flow / self.mean_gap

    def surface(self) -> Surface:
        """The lower wall."""
        return self.geometry.read()

    @property
    def rms_height(self) -> float:
        """Sq of the walls, m: √(Sq² + Sq²) of both, before a load presses them."""
        return _roughness(self.geometry.model_dump_json(exclude_none=True))[0]

    @property
    def rms_slope(self) -> float:
        """Slope g' = √(<|∇z|²>) of the walls, summed over both."""
        return _roughness(self.geometry.model_dump_json(exclude_none=True))[1]

    @property
    def slope_excess(self) -> float | None:
        """What thin-film theory lets too much through, at most, along x or y, over Stokes flow; from the spectrum.

        Of second order in roughness over gap, for any wavelength; None where that means nothing: where Sq/h̄ is above
        0.3, or a load presses the walls together.
        """
        if self.load is not None:
            return None
        return _slope_excess(self.geometry.model_dump_json(exclude_none=True))

    @property
    def gap_over_wavelength(self) -> float:
        """h̄/λ with λ = 2π Sq/g', the wavelength of a single wave of that height and slope; 0 if both are flat."""
        return self.mean_gap * self.rms_slope / (2 * np.pi * self.rms_height) if self.rms_height > 0 else 0.0

    def walls(self, resolution: int) -> Walls:
        """The walls with so many nodes along the longer side, less the waves that these cannot hold.

        They touch where they are nearer than :attr:`smallest_gap`; a load presses the surface on these nodes.

        Raises InputError for more nodes than the surface has points, if walls without these waves would cross, or if
        nothing is left open.
        """
        own = max(self.surface().shape)
        if not 2 <= resolution <= own:
            raise InputError(f"resolution: got {resolution}; the surface has {own} points, take 2 to {own}")
        walls = self._walls(resolution).closed_below(self.smallest_gap)
        if not walls.gap.any():
            raise InputError("scene: the walls touch everywhere; there is no film, lower the load or the smallest gap")
        return walls

    def _walls(self, resolution: int) -> Walls:
        pressing = None
        if self.load is not None:
            assert self.solid is not None
            pressing = (composite_modulus(self.solid, self.counter), hardness(self.solid), self.load.pressure)
        return _walls(self.geometry.model_dump_json(exclude_none=True), pressing, resolution)


@lru_cache(maxsize=4)
def _roughness(geometry_text: str) -> tuple[float, float]:
    """Sq, m, and g' of both walls."""
    geometry = GapGeometry.model_validate_json(geometry_text)
    rough = [heights for heights in geometry.heights() if np.ptp(heights) > 0]
    moments = [wave_power(heights, geometry.read().spacing).moments for heights in rough]
    return sum(one.m0 for one in moments) ** 0.5, sum(one.rms_slope**2 for one in moments) ** 0.5


@lru_cache(maxsize=4)
def _slope_excess(geometry_text: str) -> float | None:
    resolution = max(GapGeometry.model_validate_json(geometry_text).read().shape)
    walls = _walls(geometry_text, None, resolution)
    return float(expected_excess(walls).max()) if walls.gap.std() <= ROUGHEST * walls.mean_gap else None


@lru_cache(maxsize=8)
def _walls(geometry_text: str, pressing: tuple[float, float, float] | None, resolution: int) -> Walls:
    geometry = GapGeometry.model_validate_json(geometry_text)
    length, width = geometry.read().size
    nx, ny = geometry.read().shape
    part = resolution / max(nx, ny)
    shape = max(2, round(nx * part)), max(2, round(ny * part))
    spacing = length / shape[0], width / shape[1]
    lower, upper = (restricted(heights, shape) for heights in geometry.heights())
    if pressing is not None:
        from roughfilm.contact.mechanics.press import Press  # numba is slow to import

        modulus, limit, pressure = pressing
        gap = Press(lower - upper, spacing, modulus, hardness=limit).at(pressure).gap
        return Walls(lower=upper - gap, upper=upper, spacing=spacing)
    assert geometry.mean_gap is not None
    walls = Walls(lower=lower, upper=upper + geometry.mean_gap, spacing=spacing)
    if walls.gap.min() < 0:
        raise InputError(
            f"resolution: got {resolution}; without the waves that it cannot hold the walls cross, take more nodes"
        )
    return walls
