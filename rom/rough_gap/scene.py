"""The scene of a rough gap: two periodic walls and a liquid driven through the gap."""

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
from roughfilm.rom.parts.surroundings import Surroundings
from roughfilm.rom.pocket.scene import NewtonianLubricant
from roughfilm.rom.rough_gap.flow.range_of_validity import MAX_ROUGHNESS, expected_excess
from roughfilm.rom.rough_gap.geometry import GapGeometry
from roughfilm.rom.rough_gap.walls import Walls

MIN_LAYERS = 4
"""Smallest number of cells across the gap."""

MAX_LAYERS = 1000
"""Largest number of cells across the gap."""

MIN_OPEN_GAP = 0.01
"""Default gap over the mean gap below which the walls are in contact."""


def _layers(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError(f"got {value!r}; write a whole number of cells across the gap")
    return value


def _in_range(value: int) -> int:
    if not MIN_LAYERS <= value <= MAX_LAYERS:
        raise ValueError(f"got {value}; it must be {MIN_LAYERS} to {MAX_LAYERS} layers")
    return value


class GapDrive(Part):
    """The mean pressure gradient G, Pa/m, or the Reynolds number from which it follows.

    Re = ρ q/η with the flow per width q = h̄³G/(12η) of a smooth gap with the thickness of the mean gap.

    Attributes
    ----------
    pressure_gradient : mean pressure gradient, Pa/m.
    reynolds_number : Re = ρ q/η of the smooth gap, in place of the gradient.
    """

    pressure_gradient: Annotated[float, InUnit("Pa/m")] | None = None
    reynolds_number: PositiveNumber | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.pressure_gradient is None) == (self.reynolds_number is None):
            given = "neither" if self.pressure_gradient is None else "both"
            raise ValueError(f"got {given} of pressure_gradient and reynolds_number; give exactly one")
        return self


class GapMesh(Part):
    """The number of cells across the gap (by default a quarter of the columns), and the smallest open gap, m.

    In every model walls nearer than ``smallest_gap`` are in contact; the default is 0.01 of the mean gap.

    Attributes
    ----------
    layers : number of cells across the gap in OpenFOAM; by default a quarter of the columns.
    smallest_gap : gap below which the walls are in contact, m; by default 0.01 of the mean gap.
    """

    layers: Annotated[int, BeforeValidator(_layers), AfterValidator(_in_range)] | None = None
    smallest_gap: Length | None = None


class RoughGap(RoughScene):
    """One period of a gap between a rough wall at rest and another wall, with steady isothermal incompressible flow.

    There are three drives: the mean pressure gradient along x, the same along y, and, if the upper wall is flat, its
    sliding along x at the speed at which a smooth gap has the same flow as under the gradient. Under a gradient the
    lowest pressure at the outlet of the period is ambient; under sliding the mean pressure of the period is.

    The fields of a result are ``gap``, m, and ``flow``, the magnitude of the flow per width under the gradient along x,
    m²/s, of shape (nx, ny). Models that resolve the film add ``vertices`` (nx+1, ny+1, nz+1, 3), ``kept`` (nx, ny), and
    ``cell_velocity`` (nx, ny, nz, 3) and ``cell_pressure`` (nx, ny, nz) of the same flow.
    """

    kind: Literal["rough_gap"]
    geometry: GapGeometry
    lubricant: NewtonianLubricant
    flow: GapDrive
    solid: RoughBody | None = None
    counter: Counter | None = None
    load: Load | None = None
    mesh: GapMesh = Field(default_factory=GapMesh)
    boundary: Surroundings = Field(default_factory=Surroundings)

    @model_validator(mode="after")
    def _cavitates_below_ambient(self) -> Self:
        self.boundary.cavitation_pressure(self.lubricant.cavitation_pressure)
        return self

    @model_validator(mode="after")
    def _is_a_gap(self) -> Self:
        if self.load is None:
            if self.solid is not None or self.counter is not None:
                raise ValueError("load: is missing; give [load] with a pressure, or leave the solids out")
            if self.geometry.mean_gap is None:
                raise ValueError("geometry.mean_gap: is missing; give it, or [solid] and [load] that press the walls")
        else:
            if self.solid is None:
                raise ValueError("solid: is missing; give the solid that the load presses")
            if self.geometry.mean_gap is not None:
                raise ValueError("geometry.mean_gap: the load determines the gap; leave mean_gap or [load] out")
            if self.load.pressure > hardness(self.solid):
                raise ValueError(f"load.pressure: got {self.load.pressure:.6g} Pa, above the hardness; lower the load")
        self._walls_do_not_cross()
        try:
            number = self.reynolds_number
            derived = [self.pressure_gradient, self.nominal_flow, self.sliding_speed]
        except (OverflowError, ZeroDivisionError):
            number, derived = math.nan, []
        if not all(1e-100 < value < 1e100 for value in (number, *derived)):
            raise ValueError("flow: values derived from lubricant, gap and drive overflow; check the units")
        if not 1e-12 <= number <= 1e12:
            raise ValueError(f"flow: got Reynolds number {number:.3g}; it must be 1e-12 to 1e12, check the units")
        return self

    def _walls_do_not_cross(self) -> None:
        if self.geometry.mean_gap is None:
            return
        lower, upper = self.geometry.heights()
        nearest = float((upper - lower).min())
        if self.geometry.mean_gap + nearest < 0:
            raise ValueError(
                f"geometry.mean_gap: got {self.geometry.mean_gap:.6g} m, with which the walls cross; it must be above "
                f"{-nearest:.6g} m, raise it or press the walls with [solid] and [load]"
            )

    @property
    def mean_gap(self) -> float:
        """The mean gap h̄ on the surface's own points including contact, m; the unit of length inside the solvers."""
        if self.geometry.mean_gap is not None:
            return self.geometry.mean_gap
        return self._walls(max(self.surface().shape)).mean_gap

    @property
    def smallest_gap(self) -> float:
        """The gap below which the walls are in contact, m."""
        return MIN_OPEN_GAP * self.mean_gap if self.mesh.smallest_gap is None else self.mesh.smallest_gap

    @property
    def layers(self) -> int | None:
        """The number of cells across the gap; None for the default."""
        return self.mesh.layers

    @property
    def viscosity(self) -> float:
        """Viscosity η, Pa s."""
        return self.lubricant.viscosity

    @property
    def density(self) -> float:
        """Density ρ, kg/m³."""
        return self.lubricant.density

    @property
    def cavitation_pressure(self) -> float:
        """The cavitation pressure above ambient, Pa."""
        return self.boundary.cavitation_pressure(self.lubricant.cavitation_pressure)

    @property
    def pressure_gradient(self) -> float:
        """Mean pressure gradient G, Pa/m."""
        if self.flow.pressure_gradient is not None:
            return self.flow.pressure_gradient
        assert self.flow.reynolds_number is not None
        return 12 * self.flow.reynolds_number * self.viscosity**2 / (self.density * self.mean_gap**3)

    @property
    def reynolds_number(self) -> float:
        """Reynolds number ρ q/η of a smooth gap with the thickness of the mean gap."""
        if self.flow.reynolds_number is not None:
            return self.flow.reynolds_number
        return self.density * self.mean_gap**3 * self.pressure_gradient / (12 * self.viscosity**2)

    @property
    def nominal_flow(self) -> float:
        """Flow per width q = h̄³G/(12η) of a smooth gap with the thickness of the mean gap, m²/s."""
        return self.mean_gap**3 * self.pressure_gradient / (12 * self.viscosity)

    @property
    def sliding_speed(self) -> float:
        """Sliding speed u = 2q/h̄ at which a smooth gap has the nominal flow without a gradient, m/s."""
        return 2 * self.nominal_flow / self.mean_gap

    def surface(self) -> Surface:
        """The lower wall."""
        return self.geometry.read()

    @property
    def rms_height(self) -> float:
        """Rms height √(Sq² + Sq²) of both undeformed walls, m."""
        return _roughness(self.geometry.model_dump_json(exclude_none=True))[0]

    @property
    def rms_slope(self) -> float:
        """Rms slope g' = √(<|∇z|²>) of both undeformed walls together."""
        return _roughness(self.geometry.model_dump_json(exclude_none=True))[1]

    @property
    def slope_excess(self) -> float | None:
        """The larger relative flow error of thin-film theory along x or y, from the spectrum.

        The estimate is of second order in roughness over gap, for any wavelength. It is None if Sq/h̄ is above 0.3, or
        if a load presses the walls together.
        """
        if self.load is not None:
            return None
        return _slope_excess(self.geometry.model_dump_json(exclude_none=True))

    @property
    def gap_over_wavelength(self) -> float:
        """The ratio h̄/λ, with λ = 2π Sq/g' the wavelength of a wave of that height and slope; 0 for flat walls."""
        return self.mean_gap * self.rms_slope / (2 * np.pi * self.rms_height) if self.rms_height > 0 else 0.0

    def walls(self, resolution: int) -> Walls:
        """The walls on a number of nodes along the longer side, without the waves that these cannot represent.

        Walls nearer than :attr:`smallest_gap` are in contact; a load presses the surface on these nodes.

        Raises
        ------
        InputError
            If there are more nodes than points of the surface, if the walls cross without these waves, or if they touch
            everywhere.
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
    """Rms height Sq, m, and rms slope g' of both walls together."""
    geometry = GapGeometry.model_validate_json(geometry_text)
    rough = [heights for heights in geometry.heights() if np.ptp(heights) > 0]
    moments = [wave_power(heights, geometry.read().spacing).moments for heights in rough]
    return sum(one.m0 for one in moments) ** 0.5, sum(one.rms_slope**2 for one in moments) ** 0.5


@lru_cache(maxsize=4)
def _slope_excess(geometry_text: str) -> float | None:
    resolution = max(GapGeometry.model_validate_json(geometry_text).read().shape)
    walls = _walls(geometry_text, None, resolution)
    return float(expected_excess(walls).max()) if walls.gap.std() <= MAX_ROUGHNESS * walls.mean_gap else None


@lru_cache(maxsize=8)
def _walls(geometry_text: str, pressing: tuple[float, float, float] | None, resolution: int) -> Walls:
    geometry = GapGeometry.model_validate_json(geometry_text)
    length, width = geometry.read().size
    nx, ny = geometry.read().shape
    ratio = resolution / max(nx, ny)
    shape = max(2, round(nx * ratio)), max(2, round(ny * ratio))
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
            f"resolution: got {resolution}; the walls cross without the waves that it cannot represent, raise it"
        )
    return walls
