"""A pocket: grooves under a sliding wall."""

from typing import Annotated, Literal, Self

from pydantic import model_validator

from roughfilm.contact.foundation.entries import InUnit, Part, PositiveNumber
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.pocket.gap import Gap
from roughfilm.rom.pocket.geometry import AnyGroove, PocketGeometry

Viscosity = Annotated[float, InUnit("Pa*s")]
Density = Annotated[float, InUnit("kg/m^3")]
Speed = Annotated[float, InUnit("m/s")]


class Lubricant(Part):
    """A Newtonian, incompressible liquid: viscosity in Pa s, density in kg/m³."""

    viscosity: Viscosity
    density: Density


class Motion(Part):
    """How fast the upper wall slides: its speed in m/s, or the Reynolds number that gives it; exactly one."""

    speed: Speed | None = None
    reynolds_number: PositiveNumber | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.speed is None) == (self.reynolds_number is None):
            found = "neither" if self.speed is None else "both"
            raise ValueError(f"got {found} of speed and reynolds_number; give exactly one")
        return self


class Pocket(Scene):
    """A groove under a sliding wall: steady, isothermal, incompressible, periodic, no mean pressure drop.

    ``fields`` of its results, all along the sliding (upper) wall: ``position``, ``film_thickness`` (m), ``pressure``
    and ``shear_stress`` (Pa). Models that resolve the film add ``vertices`` (nx+1, ny+1, 2), ``cell_velocity``
    (nx, ny, 2) and ``cell_pressure`` (nx, ny).
    """

    kind: Literal["pocket"]
    geometry: PocketGeometry
    lubricant: Lubricant
    motion: Motion

    @model_validator(mode="after")
    def _reynolds_number_stays_in_range(self) -> Self:
        if not 1e-12 <= self.reynolds_number <= 1e12:
            raise ValueError(
                f"motion: got Reynolds number {self.reynolds_number:.3g}; it must be 1e-12 to 1e12, look at the units"
            )
        return self

    @property
    def speed(self) -> float:
        """Sliding speed u of the upper wall, m/s."""
        if self.motion.speed is not None:
            return self.motion.speed
        assert self.motion.reynolds_number is not None
        return self.motion.reynolds_number * self.lubricant.viscosity / (self.lubricant.density * self.geometry.film)

    @property
    def reynolds_number(self) -> float:
        """Re = ρ u Ly / η, with Ly the film thickness outside the groove."""
        if self.motion.reynolds_number is not None:
            return self.motion.reynolds_number
        return self.lubricant.density * self.speed * self.geometry.film / self.lubricant.viscosity

    @property
    def pressure_unit(self) -> float:
        """η u / Ly, Pa: the unit of pressure and shear stress inside the solvers."""
        return self.lubricant.viscosity * self.speed / self.geometry.film

    @property
    def plus_factor(self) -> float:
        """What turns p / (η u / Ly) into the thesis's p+ = 100 p Ly² / (η u Lx)."""
        return 100 * self.geometry.film / self.geometry.length

    @property
    def grooves(self) -> tuple[AnyGroove, ...]:
        """The grooves of the lower wall."""
        return self.geometry.grooves

    @property
    def reduced_reynolds_number(self) -> float:
        """Re Ly / w of the narrowest groove: inertia against viscous stress where the film changes fastest."""
        return self.reynolds_number * self.geometry.film / min(groove.width for groove in self.grooves)

    @property
    def depth(self) -> float:
        """Depth of the deepest groove over the film thickness outside, d / Ly."""
        return max(groove.depth for groove in self.grooves) / self.geometry.film

    @property
    def aspect(self) -> float:
        """2d / w of the groove where it is greatest: its mean slope if the lowest point is in the middle."""
        return max(2 * groove.depth / groove.width for groove in self.grooves)

    @property
    def slope(self) -> float:
        """Mean slope of the steepest groove, from its lowest point to the nearer edge: 2d / w if it is symmetric."""
        return max(groove.slope for groove in self.grooves)

    def gap(self) -> Gap:
        """The gap this scene's geometry leaves open."""
        return self.geometry.gap()


def pocket_quantities(
    scene: Pocket, *, load: float, friction: float, pressure_max: float, pressure_min: float, backflow: float
) -> dict[str, Quantity]:
    """The quantities of a pocket scene from forces per area and pressures in units of η u / Ly.

    p+ = 100 p Ly² / (η u Lx) with p = 0 at the periodic boundary; load and friction likewise, per area of the sliding
    wall, so that smooth parallel walls have friction_plus = 100 Ly / Lx. ``backflow`` is a fraction of the speed.
    """
    plus, pascal = scene.plus_factor, scene.pressure_unit
    return {
        "load_plus": Quantity(value=load * plus, unit="1"),
        "friction_plus": Quantity(value=friction * plus, unit="1"),
        "pressure_max_plus": Quantity(value=pressure_max * plus, unit="1"),
        "pressure_min_plus": Quantity(value=pressure_min * plus, unit="1"),
        "load_per_area": Quantity(value=load * pascal, unit="Pa"),
        "friction_per_area": Quantity(value=friction * pascal, unit="Pa"),
        "backflow": Quantity(value=backflow, unit="1"),
    }
