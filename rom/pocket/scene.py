"""The scene of a pocket: grooves or dimples under a sliding wall."""

from collections.abc import Mapping
from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from roughfilm.contact.foundation.entries import InUnit, Part, PositiveNumber
from roughfilm.contact.foundation.rounding import round_off
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.result import beyond_round_off
from roughfilm.rom.parts.fluid import Fluid
from roughfilm.rom.parts.surroundings import GaugePressure, Surroundings
from roughfilm.rom.pocket.geometry import AnyGroove, PocketGeometry
from roughfilm.rom.pocket.plan.geometry import PlanGeometry
from roughfilm.rom.pocket.plan.plan import Plan
from roughfilm.rom.thin_film.gap import Gap

Viscosity = Annotated[float, InUnit("Pa*s")]
Density = Annotated[float, InUnit("kg/m^3")]
Speed = Annotated[float, InUnit("m/s")]


class NewtonianLubricant(Fluid):
    """An incompressible Newtonian liquid.

    Attributes
    ----------
    viscosity : viscosity, Pa s.
    density : density, kg/m³.
    cavitation_pressure : cavitation pressure above ambient, Pa, at most 0; by default zero absolute pressure.
    """

    viscosity: Viscosity
    density: Density
    cavitation_pressure: GaugePressure | None = None


class PocketMotion(Part):
    """The speed of the upper wall, m/s, or the Reynolds number from which it follows.

    Attributes
    ----------
    speed : sliding speed of the upper wall, m/s.
    reynolds_number : Re = ρ u film/η, in place of the speed.
    """

    speed: Speed | None = None
    reynolds_number: PositiveNumber | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if (self.speed is None) == (self.reynolds_number is None):
            given = "neither" if self.speed is None else "both"
            raise ValueError(f"got {given} of speed and reynolds_number; give exactly one")
        return self


GROOVES, IN_PLAN = "grooves", "plan"
"""Tags of the two geometries of a pocket, which are no keys of a scene file."""


def geometry_tag(entries: Any) -> str:
    """The tag of a geometry: a cell in plan has a breadth and dimples."""
    if isinstance(entries, dict):
        return IN_PLAN if {"breadth", "dimples", "arrangement"} & entries.keys() else GROOVES
    return IN_PLAN if isinstance(entries, PlanGeometry) else GROOVES


LAWS_IN_PLAN = "dimples"
"""Name of the error laws of cells in plan in the table of laws."""


def in_plan(entries: Mapping[str, Any]) -> bool:
    """Whether entries of a scene, of which the geometry may be read already, are a cell in plan."""
    return geometry_tag(entries.get("geometry")) == IN_PLAN


AnyGeometry = Annotated[
    Annotated[PocketGeometry, Tag(GROOVES)] | Annotated[PlanGeometry, Tag(IN_PLAN)], Discriminator(geometry_tag)
]


class Pocket(Scene):
    """Grooves or dimples under a sliding wall: steady, isothermal, incompressible flow without mean pressure drop.

    The flow over grooves is two-dimensional and periodic along the sliding direction. A geometry with a ``breadth`` is
    a cell in plan, whose flow is three-dimensional and periodic in both directions.

    All pressures count from ambient pressure, which is the pressure at the periodic boundary on the sliding wall; in
    plan it is its mean over that boundary, the edges x = ±length/2 of the cell.

    The fields of a result along the sliding (upper) wall are ``position`` and ``film_thickness``, m, ``pressure`` and
    ``shear_stress``, Pa. Models that resolve the film add ``vertices`` (nx+1, ny+1, 2), ``cell_velocity`` (nx, ny, 2)
    and ``cell_pressure`` (nx, ny). In plan the fields are ``x`` and ``y``, m, ``film_thickness``, ``pressure`` and
    ``shear_stress``, all (nx, ny), and ``vertices`` (nx+1, ny+1, nz+1, 3), ``cell_velocity`` (nx, ny, nz, 3) and
    ``cell_pressure`` (nx, ny, nz). A model with cavitation adds ``density_ratio``, the fraction θ of the gap that is
    full of liquid.
    """

    kind: Literal["pocket"]
    geometry: AnyGeometry
    lubricant: NewtonianLubricant
    motion: PocketMotion
    boundary: Surroundings = Field(default_factory=Surroundings)

    @model_validator(mode="after")
    def _reynolds_number_stays_in_range(self) -> Self:
        if not 1e-12 <= self.reynolds_number <= 1e12:
            raise ValueError(
                f"motion: got Reynolds number {self.reynolds_number:.3g}; it must be 1e-12 to 1e12, check the units"
            )
        return self

    @model_validator(mode="after")
    def _cavitates_below_ambient(self) -> Self:
        self.boundary.cavitation_pressure(self.lubricant.cavitation_pressure)
        return self

    @property
    def cavitation_pressure(self) -> float:
        """The cavitation pressure above ambient, Pa."""
        return self.boundary.cavitation_pressure(self.lubricant.cavitation_pressure)

    @property
    def speed(self) -> float:
        """Sliding speed u of the upper wall, m/s."""
        if self.motion.speed is not None:
            return self.motion.speed
        assert self.motion.reynolds_number is not None
        return self.motion.reynolds_number * self.lubricant.viscosity / (self.lubricant.density * self.geometry.film)

    @property
    def reynolds_number(self) -> float:
        """The Reynolds number Re = ρ u Ly / η, with Ly the film thickness outside the groove."""
        if self.motion.reynolds_number is not None:
            return self.motion.reynolds_number
        return self.lubricant.density * self.speed * self.geometry.film / self.lubricant.viscosity

    @property
    def pressure_unit(self) -> float:
        """The unit of pressure and shear stress inside the solvers, η u / Ly, Pa."""
        return self.lubricant.viscosity * self.speed / self.geometry.film

    @property
    def plus_factor(self) -> float:
        """The ratio of the thesis's p+ = 100 p Ly² / (η u Lx) to p / (η u / Ly)."""
        return 100 * self.geometry.film / self.geometry.length

    @property
    def in_plan(self) -> bool:
        """Whether the geometry is a cell in plan, with dimples and a breadth."""
        return isinstance(self.geometry, PlanGeometry)

    @property
    def grooves(self) -> tuple[AnyGroove, ...]:
        """The grooves of the lower wall of a scene that is not in plan."""
        assert isinstance(self.geometry, PocketGeometry)
        return self.geometry.grooves

    @property
    def reduced_reynolds_number(self) -> float:
        """The ratio of inertia to viscous stress at the narrowest groove or dimple, Re Ly / w."""
        return self.reynolds_number * self.geometry.film / self.geometry.narrowest

    @property
    def depth(self) -> float:
        """Depth of the deepest groove or dimple over the film thickness outside, d / Ly."""
        return self.geometry.depth / self.geometry.film

    @property
    def aspect(self) -> float:
        """The largest 2d / w of the grooves or dimples, with the least extent w."""
        return self.geometry.aspect

    @property
    def slope(self) -> float:
        """Mean slope of the steepest groove or dimple from its greatest depth to the nearer edge."""
        return self.geometry.slope

    @property
    def covered(self) -> float:
        """The part of the cell in plan that dimples cover."""
        assert isinstance(self.geometry, PlanGeometry)
        return self.geometry.covered

    def gap(self) -> Gap:
        """The gap between the walls of a scene that is not in plan."""
        assert isinstance(self.geometry, PocketGeometry)
        return self.geometry.gap()

    def plan(self) -> Plan:
        """The gap over the cell of a scene in plan."""
        assert isinstance(self.geometry, PlanGeometry)
        return self.geometry.plan()


TITLES = {
    "load_plus": "load",
    "load_from_corner_plus": "load, pressure zero at the corner",
    "friction_plus": "friction",
    "pressure_max_plus": "peak pressure",
    "pressure_min_plus": "least pressure",
    "backflow": "reverse flow",
}
"""The names of the dimensionless quantities in a sentence."""


def pocket_quantities(
    scene: Pocket,
    *,
    load: float,
    friction: float,
    pressure_max: float,
    pressure_min: float,
    backflow: float,
    parts: int,
    offset: float = 0.0,
) -> dict[str, Quantity]:
    """The quantities of a pocket scene from forces per area and pressures in units of η u / Ly.

    p+ = 100 p Ly² / (η u Lx) with p = 0 at the periodic boundary. Load and friction have the same scale, per area of
    the sliding wall, so that smooth parallel walls have friction_plus = 100 Ly / Lx. ``backflow`` is a speed ratio.
    The load is the mean of ``parts`` pressures, whose zero was moved by ``offset``; below their round-off it is 0.
    """
    plus, pascal = scene.plus_factor, scene.pressure_unit
    rounding = round_off(max(abs(pressure_max), abs(pressure_min)) + abs(offset), parts)
    return {
        "load_plus": beyond_round_off(Quantity(value=load * plus, unit="1"), rounding * plus),
        "friction_plus": Quantity(value=friction * plus, unit="1"),
        "pressure_max_plus": Quantity(value=pressure_max * plus, unit="1"),
        "pressure_min_plus": Quantity(value=pressure_min * plus, unit="1"),
        "load_per_area": beyond_round_off(Quantity(value=load * pascal, unit="Pa"), rounding * pascal),
        "friction_per_area": Quantity(value=friction * pascal, unit="Pa"),
        "backflow": Quantity(value=backflow, unit="1"),
    }
