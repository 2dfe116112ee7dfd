"""Scenes of bearings: a lubricant film between a shaped fixed wall and a flat sliding wall."""

import math
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

import numpy as np
from pydantic import BeforeValidator, Field, ValidationInfo, field_validator, model_validator

from roughfilm.contact.foundation.entries import Angle, InUnit, Part, PositiveNumber, plain_number
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import rotational_speed, with_unit
from roughfilm.rom.bearing.asperity_contact import AsperityContact
from roughfilm.rom.bearing.geometry.journal import Journal, Shaft
from roughfilm.rom.bearing.geometry.lobes import DOWN, Lobes
from roughfilm.rom.bearing.geometry.pivoted import Tilting
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.geometry.shapes import SHAPES, AnyShape
from roughfilm.rom.bearing.lubricant import BearingLubricant
from roughfilm.rom.bearing.moving.body import Body
from roughfilm.rom.bearing.moving.checks import check_motion
from roughfilm.rom.bearing.moving.over_time import OverTime
from roughfilm.rom.bearing.roughness import AnyRoughness, RoughSurface, Sinusoid, StoredTable
from roughfilm.rom.bearing.supply.patches import Patch, patches, supplied
from roughfilm.rom.bearing.supply.tables import MAX_SUPPLIES, AnySupply
from roughfilm.rom.bearing.thermal.checks import check_heat
from roughfilm.rom.bearing.thermal.tables import Heat, Temperature
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.lubricants.viscosity import LOG_VISCOSITY, Roelands
from roughfilm.rom.parts.surroundings import GaugePressure

if TYPE_CHECKING:
    from roughfilm.rom.cavitation.discretise import Ends
    from roughfilm.rom.cavitation.problem import Inflow, Problem
    from roughfilm.rom.cavitation.shape import Thickness

Speed = Annotated[float, InUnit("m/s", any_sign=True)]
Pressure = Annotated[float, InUnit("Pa")]
Force = Annotated[float, InUnit("N")]
Moment = Annotated[float, InUnit("N*m", any_sign=True)]
ForcePerWidth = Annotated[float, InUnit("N/m")]


class BearingMotion(Part):
    """The speed of the flat wall, m/s, on a ring at the mean radius; negative if the wall slides towards the inlet.

    In the file of a shaft, a sector or a washer it may be a rotational speed, such as "3000 rpm".

    Attributes
    ----------
    speed : sliding speed, m/s; of a shaft, a sector or a washer also a rotational speed, "3000 rpm".
    approach : velocity V at which the walls approach each other, ∂h/∂t = -V, m/s, negative if they part; of a journal
        that of the shaft towards its narrowest place, ∂h/∂t = V cos φ with the angle φ from the widest place.
    over_time : speed, load or path over time, for a march; steady films have the speed and the load of the scene. With
        a list of speeds, ``speed`` is the first of them by default.
    """

    speed: Speed
    approach: Speed = 0.0
    over_time: OverTime | None = None

    @model_validator(mode="before")
    @classmethod
    def _first_speed(cls, entries: Any) -> Any:
        columns = entries.get("over_time") if isinstance(entries, dict) and "speed" not in entries else None
        speeds = columns.get("speed") if isinstance(columns, dict) else None
        return entries | {"speed": speeds[0]} if isinstance(speeds, list | tuple) and speeds else entries


class Inlet(Part):
    """The pressure above ambient, Pa, or the density ratio θ at the inlet; ambient pressure by default.

    The inlet of a shaft in several lobes is the gaps between them.

    θ < 1 is starved, θ = 1 flooded at cavitation pressure, and θ > 1 pressurised by the law of compressibility. The ram
    pressure ``ram_factor`` ρ u²/2 of the liquid that meets the bearing at the sliding speed u adds to the pressure.

    Attributes
    ----------
    theta : density ratio at the inlet; below 1 starved, 1 flooded, above 1 pressurised.
    pressure : pressure at the inlet above ambient, Pa, in place of theta.
    ram_factor : ram pressure over ρ u²/2, which is added to the pressure at the inlet.
    temperature : temperature of the new lubricant there, K; by default that of the supplied lubricant.
    """

    theta: PositiveNumber | None = None
    pressure: GaugePressure | None = None
    ram_factor: Annotated[float, BeforeValidator(plain_number)] = 0.0
    temperature: Temperature | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        if self.theta is not None and self.pressure is not None:
            raise ValueError("got both theta and pressure; give one of them")
        if self.theta is not None and self.ram_factor:
            raise ValueError("got theta, which determines the pressure, and ram_factor; give one of them")
        return self


class Outlet(Part):
    """The pressure at the outlet above ambient, Pa; by default ambient, in a journal bearing that of the inlet.

    Attributes
    ----------
    pressure : pressure at the outlet above ambient, Pa.
    """

    pressure: GaugePressure = 0.0


class Sides(Part):
    """The pressures above ambient, Pa, at y = 0 or the inner radius, and at y = width or the outer radius.

    Attributes
    ----------
    low : pressure above ambient at y = 0 or the inner radius, Pa.
    high : pressure above ambient at y = width or the outer radius, Pa.
    """

    low: GaugePressure = 0.0
    high: GaugePressure = 0.0


class BearingBoundary(Part):
    """The boundary conditions of the film."""

    inlet: Inlet = Field(default_factory=Inlet)
    outlet: Outlet = Field(default_factory=Outlet)
    sides: Sides = Field(default_factory=Sides)


class BearingLoad(Part):
    """The load that the bearing carries; exactly one entry is given.

    Attributes
    ----------
    pressure : load over the nominal area (of a journal bearing: diameter times width), Pa.
    force : load of the whole bearing, of a ring with all of its pieces, N.
    force_per_width : load over the width of an infinitely wide bearing, N/m.
    angle : direction of the load on a shaft in lobes, and in a march on any shaft, from the x axis towards the y axis,
        rad; by default -90°, down.
    moment_x, moment_y : moments on a pivoted pad about the axes along x, the sliding, and along y through its pivot,
        N m; z points from the sliding wall to the pad. Each pad of a bearing has them.
    """

    pressure: Pressure | None = None
    force: Force | None = None
    force_per_width: ForcePerWidth | None = None
    angle: Angle = DOWN
    moment_x: Moment = 0.0
    moment_y: Moment = 0.0

    @model_validator(mode="after")
    def _one_of_three(self) -> Self:
        given = [name for name in ("pressure", "force", "force_per_width") if getattr(self, name) is not None]
        if not given:
            raise ValueError("is empty; give pressure, force or force_per_width")
        if len(given) > 1:
            raise ValueError(f"got {' and '.join(given)}; give one of them")
        return self


class Bearing(Scene):
    """A bearing: steady isothermal flow in a thin film with cavitation; pressures are above ambient.

    If the fixed wall is rough, the geometry describes the mean gap. With ``asperities`` it describes the separation α
    of the mean planes of the undeformed walls, which equals the mean gap until the walls touch. With a load every model
    solves for the film that carries it (:mod:`roughfilm.rom.bearing.equilibrium`); the film of the geometry, if it is
    given, is then the first value of the search.

    Fields of the results, of the shape of the grid: ``x``, ``y`` (m, or rad and m), ``film_thickness`` (m),
    ``pressure`` (Pa), ``density_ratio`` θ (1), which below 1 is the fraction of the gap filled with liquid.

    Attributes
    ----------
    supply : grooves, holes and pockets inside of the film in which lubricant is supplied.
    heat : walls and surroundings of the film, for models with temperature.
    """

    kind: Literal["bearing"]
    geometry: Annotated[AnyShape, Field(discriminator="shape")]
    lubricant: BearingLubricant
    motion: BearingMotion
    boundary: BearingBoundary = Field(default_factory=BearingBoundary)
    roughness: AnyRoughness | None = None
    asperities: AsperityContact | None = None
    load: BearingLoad | None = None
    heat: Heat | None = None
    body: Body | None = None
    supply: Annotated[tuple[AnySupply, ...], Field(max_length=MAX_SUPPLIES)] = ()

    @field_validator("geometry", mode="before")
    @classmethod
    def _names_a_shape(cls, entries: Any) -> Any:
        named = entries.get("shape") if isinstance(entries, dict) else None
        if isinstance(entries, dict) and not (isinstance(named, str) and named in SHAPES):
            got = f"got {named!r:.60}" if "shape" in entries else "is missing"
            raise ValueError(f"shape: {got}; it must be {', '.join(map(repr, SHAPES))}")
        return entries

    @field_validator("motion", mode="before")
    @classmethod
    def _slides(cls, entries: Any, info: ValidationInfo) -> Any:
        """The motion, with the sliding speed at the radius of the geometry in place of a rotational speed."""
        geometry = info.data.get("geometry")
        if not isinstance(entries, dict) or not isinstance(geometry, Shaft | Ring | None):
            return entries
        # Without a geometry, which has a fault then, any speed will do.
        radius = 1.0 if geometry is None else geometry.radius

        def sliding(speed: Any) -> Any:
            turning = rotational_speed(speed)
            return speed if turning is None else with_unit(turning * radius, "m/s")

        entries = {**entries, "speed": sliding(entries["speed"])} if "speed" in entries else entries
        table = entries.get("over_time")
        if not isinstance(table, dict) or not isinstance(table.get("speed"), list | tuple):
            return entries
        return {**entries, "over_time": {**table, "speed": [sliding(speed) for speed in table["speed"]]}}

    @model_validator(mode="after")
    def _can_be_solved(self) -> Self:
        lowest = self.lubricant.cavitation_pressure
        if self.boundary.inlet.ram_factor and self.lubricant.density is None:
            raise ValueError(
                f"boundary.inlet.ram_factor: got {self.boundary.inlet.ram_factor:g} without lubricant.density, by "
                "which the ram pressure is determined; give the density"
            )
        inlet = self.inlet_pressure if self.boundary.inlet.theta is None else None
        places = {"inlet": inlet, "outlet": self.boundary.outlet.pressure}
        sides = {"sides.low": self.boundary.sides.low, "sides.high": self.boundary.sides.high}
        for place, given in (places | (sides if self.wide is False else {})).items():
            if given is not None and given < lowest:
                ram = " with the ram pressure" if place == "inlet" and self.boundary.inlet.ram_factor else ""
                raise ValueError(
                    f"boundary.{place}.pressure: got {given!r} Pa{ram}; it must be at least the cavitation pressure, "
                    f"{lowest!r} Pa"
                )
        theta = self.boundary.inlet.theta
        if theta is not None and theta > 1:
            try:
                self.lubricant.compressibility.pressure_at(theta)
            except InputError as error:
                raise ValueError(f"boundary.inlet.{error}") from None
        self._can_be_supplied()
        temperatures = {f"supply.{number}.temperature": one.temperature for number, one in enumerate(self.supply)}
        temperatures["boundary.inlet.temperature"] = self.boundary.inlet.temperature
        start = None if self.body is None else self.body.start
        temperatures["body.start.temperature"] = None if start is None else start.temperature
        check_heat(self.lubricant, self.heat, temperatures)
        if isinstance(self.geometry, Ring) and self.geometry.endless:
            self._can_be_joined("joined pads")
        elif isinstance(self.geometry, Lobes) and self.geometry.joined:
            self._can_be_joined("lobes without gaps")
        elif isinstance(self.geometry, Lobes) and not self.geometry.single:
            self._can_have_gaps()
        if self.wide and self.boundary.sides != Sides():
            raise ValueError("boundary.sides: got pressures for an infinitely wide bearing; remove them or add a width")
        law, least = self.lubricant.piezoviscosity, math.exp(-LOG_VISCOSITY)
        if isinstance(law, Roelands) and self.lubricant.viscosity <= least:
            raise ValueError(
                f"lubricant.piezoviscosity: got roelands for {self.lubricant.viscosity!r} Pa s; that law needs more "
                f"than {least:.2g} Pa s, take barus or constant"
            )
        if self.lubricant.shear_thinning is not None:
            self.lubricant.shear_thinning.check(self.lubricant.viscosity)
        if self.asperities is not None:
            self._can_touch(self.asperities)
        if self.motion.approach and isinstance(self.geometry, MovingWall):
            pad = isinstance(self.geometry, Tilting)
            moves, remedy = ("pad that tilts", "") if pad else ("shaft in lobes", ", and take roughfilm march for it")
            raise ValueError(
                f"motion.approach: got {self.motion.approach!r} m/s for a {moves}, which moves in several directions; "
                f"leave it out{remedy}"
            )
        film, over_time = self.geometry.film, self.motion.over_time
        check_motion(self.geometry, over_time, self.body, loaded=self.load is not None)
        if self.load is not None:
            self._can_be_loaded(self.load)
        elif (
            (film is None or (isinstance(self.geometry, Tilting) and self.geometry.slopes is None))
            and over_time is not None
            and over_time.places_or_loads
        ):
            pass  # a march has its load or its path over time
        elif film is None:
            key = "eccentricity" if isinstance(self.geometry, Shaft) else "film"
            raise ValueError(f"geometry.{key}: is missing; give it, or a load ([load] force or pressure)")
        elif isinstance(self.geometry, Tilting) and self.geometry.slopes is None:
            raise ValueError("geometry.slopes: are missing; give them, or a load ([load] force or pressure)")
        elif isinstance(self.roughness, Sinusoid) and self.roughness.amplitude >= film:
            raise ValueError(
                f"roughness.amplitude: got {self.roughness.amplitude!r} m; it must be below film, "
                f"{film!r} m, or the walls touch"
            )
        (self.geometry if film is not None else self.geometry.at_film(self.geometry.widest)).film_shape()
        return self

    def _can_be_loaded(self, load: BearingLoad) -> None:
        if load.force is not None and self.wide:
            raise ValueError(
                "load.force: got a force for an infinitely wide bearing; give force_per_width or pressure, or a width"
            )
        if load.force_per_width is not None and not self.wide:
            raise ValueError("load.force_per_width: got one for a bearing with a width; give force or pressure")
        if load.force is not None and self.pieces is None:
            raise ValueError(
                "load.force: is that of the whole bearing, whose number of pads is unknown; give geometry.pads, or "
                "load.pressure"
            )
        in_time = self.motion.over_time is not None or self.body is not None
        if load.angle != DOWN and not isinstance(self.geometry, Shaft if in_time else Lobes):
            raise ValueError(
                f"load.angle: got one for the shape {self.geometry.shape!r}; only shafts in lobes have one"
            )
        if load.moment_x or load.moment_y:
            self._can_have_moments(load)
        carried = self.asperities is not None or self.supply or in_time
        if self.motion.speed == 0 and self.motion.approach <= 0 and not carried:
            parts = " between walls that part" if self.motion.approach else ""
            raise ValueError(
                f"motion.speed: got 0 m/s under a load; a film without sliding{parts} carries none by its thickness, "
                "give a speed, an approach above 0 m/s, [[supply]] behind restrictors, or [asperities] that touch"
            )

    def _can_be_supplied(self) -> None:
        """Raise ValueError if a supply lies outside of the film, or its pressure is below that of cavitation."""
        lowest = self.lubricant.cavitation_pressure
        for number, supply in enumerate(self.supply):
            if supply.pressure is not None and supply.pressure < lowest:
                raise ValueError(
                    f"supply.{number}.pressure: got {supply.pressure!r} Pa; it must be at least the cavitation "
                    f"pressure, {lowest!r} Pa"
                )
            if supply.orifice is not None and self.lubricant.density is None:
                raise ValueError(
                    f"supply.{number}.orifice: got one without lubricant.density, by which its flow is determined; "
                    "give the density"
                )
        if self.supply and self.asperities is not None:
            raise ValueError("asperities: got a table with [[supply]], inside of which none touch; leave one out")
        patches(self.geometry, self.supply)

    def _can_have_moments(self, load: BearingLoad) -> None:
        geometry = self.geometry
        if not isinstance(geometry, Tilting) or self.wide:
            wide = "infinitely wide " if self.wide else ""
            raise ValueError(
                f"load.moment_{'x' if load.moment_x else 'y'}: got one for the {wide}shape {geometry.shape!r}; pivoted "
                "pads with a width have moments"
            )
        if geometry.slopes is not None:
            raise ValueError(
                f"load.moment_{'x' if load.moment_x else 'y'}: got one beside geometry.slopes, which no moment "
                "changes; leave one of them out"
            )
        if load.moment_x and not geometry.tilts_across:
            raise ValueError("load.moment_x: got one for a pivot with line = true, which takes it; leave it out")

    def _can_touch(self, asperities: AsperityContact) -> None:
        try:
            asperities.friction_at(self.lubricant.temperature)
        except InputError as error:
            raise ValueError(str(error)) from None
        if not isinstance(self.roughness, RoughSurface | StoredTable):
            got = "smooth walls" if self.roughness is None else "sinusoidal ridges"
            raise ValueError(f"asperities: got a table for {got}; give a surface or a table as roughness")
        if isinstance(self.roughness, RoughSurface) and asperities.solid is None:
            raise ValueError("asperities.solid: is missing; give the solid of the rough wall")
        if isinstance(self.roughness, StoredTable) and asperities.solid is not None:
            raise ValueError("asperities.solid: got one, but the stored table has its own solids; leave it out")
        if isinstance(self.roughness, StoredTable) and asperities.solid_heat is not None:
            raise ValueError(
                "asperities.solid_heat: got one, but a stored table has no spots in contact, of which the flash "
                "temperature follows; give the surface as roughness, or leave it out"
            )

    def _can_be_joined(self, pieces: str) -> None:
        boundary, lowest = self.boundary, self.lubricant.cavitation_pressure
        if self.wide and not self.supply:
            raise ValueError(
                f"geometry.width: is missing, but {pieces} are fed through their sides; give a width, or an arc that "
                "leaves gaps"
            )
        if boundary.inlet != Inlet() or boundary.outlet != Outlet():
            raise ValueError(f"boundary: got an inlet or outlet, but {pieces} have none; leave it out")
        fed = self.supply or self.motion.approach > 0 or isinstance(self.geometry, Lobes)  # whose sides refill it
        if max(boundary.sides.low, boundary.sides.high) <= lowest and not fed:
            raise ValueError(
                f"boundary.sides: got no pressure above the cavitation pressure of {lowest!r} Pa; {pieces} are "
                "fed through their sides, raise one of the two, or give [[supply]]"
            )

    def _can_have_gaps(self) -> None:
        theta = self.boundary.inlet.theta
        if theta is not None and theta < 1:
            raise ValueError(
                f"boundary.inlet.theta: got {theta!r} for the gaps between lobes, which are full; give at least 1, "
                "or a pressure"
            )
        if self.boundary.outlet != Outlet():
            raise ValueError(
                "boundary.outlet: got one, but the gaps between lobes have the pressure of boundary.inlet; leave it out"
            )

    @property
    def wide(self) -> bool:
        """Whether the bearing is infinitely wide."""
        return self.geometry.width is None

    @property
    def nominal_area(self) -> float:
        """The area of the film of one piece, m² (m if infinitely wide); of a journal bearing diameter times width."""
        geometry = self.geometry
        length = 2 * geometry.radius if isinstance(geometry, Shaft) else geometry.length
        return length * (1.0 if geometry.width is None else geometry.width)

    @property
    def load_pressure(self) -> float | None:
        """The load over the nominal area, Pa; None without a load."""
        load = self.load
        if load is None:
            return None
        if load.force is not None:
            return load.force / (self.nominal_area * (self.pieces or 1))
        if load.force_per_width is not None:
            return load.force_per_width / self.nominal_area
        return load.pressure

    def at_film(self, film: float) -> Self:
        """The bearing with a given minimum film thickness, m, and without a load."""
        return self.model_copy(update={"geometry": self.geometry.at_film(film), "load": None})

    def moved(self, geometry: AnyShape) -> Self:
        """The bearing with its wall at another place, and without a load."""
        return self.model_copy(update={"geometry": geometry, "load": None})

    def at_speed(self, speed: float) -> Self:
        """The bearing at another sliding speed, m/s."""
        return self.model_copy(update={"motion": self.motion.model_copy(update={"speed": speed})})

    def at_temperature(self, temperature: float) -> Self:
        """The bearing whose film has a temperature, K; what flows through restrictors keeps that of its supply."""
        supplied = self.lubricant.temperature
        supply = tuple(
            one if one.temperature is not None else one.model_copy(update={"temperature": supplied})
            for one in self.supply
        )
        return self.model_copy(update={"lubricant": self.lubricant.at(temperature), "supply": supply})

    def isothermal(self) -> Self:
        """The bearing without temperature: its lubricant has everywhere the viscosity of the supplied one."""
        supply = tuple(one.model_copy(update={"temperature": None}) for one in self.supply)
        boundary = self.boundary.model_copy(
            update={"inlet": self.boundary.inlet.model_copy(update={"temperature": None})}
        )
        lubricant = self.lubricant.model_copy(update={"thermoviscosity": None})
        update = {"lubricant": lubricant, "heat": None, "supply": supply, "boundary": boundary}
        return self.model_copy(update=update)

    @property
    def boundary_friction(self) -> float:
        """The coefficient of boundary friction at the temperature of the lubricant; 0 without asperities.

        Raises
        ------
        InputError
            If that temperature lies outside of the table of the coefficient.
        """
        return 0.0 if self.asperities is None else self.asperities.friction_at(self.lubricant.temperature)

    @property
    def turning_radius(self) -> float | None:
        """The radius at which the speed of a rotating wall is given, m; None if the wall does not rotate."""
        return self.geometry.radius if isinstance(self.geometry, Shaft | Ring) else None

    @property
    def pieces(self) -> int | None:
        """The number of equal pieces of the whole bearing, of which this is one; None if it is unknown."""
        return self.geometry.pieces if isinstance(self.geometry, Ring) else 1

    @property
    def inlet_pressure(self) -> float:
        """The pressure at the inlet above ambient, Pa, with the ram pressure; the cavitation pressure if starved."""
        inlet, lubricant = self.boundary.inlet, self.lubricant
        if inlet.theta is None:
            return (inlet.pressure or 0.0) + inlet.ram_factor * (lubricant.density or 0.0) * self.motion.speed**2 / 2
        above = lubricant.compressibility.pressure_at(inlet.theta) if inlet.theta > 1 else 0.0
        return lubricant.cavitation_pressure + above

    @property
    def ends(self) -> "Ends":
        """The boundary conditions, with pressures above cavitation pressure."""
        from roughfilm.rom.cavitation.discretise import Ends  # slow to import

        lowest, boundary = self.lubricant.cavitation_pressure, self.boundary
        theta = boundary.inlet.theta
        if theta is None:
            inlet: float | None = self.inlet_pressure - lowest
        else:
            inlet = self.lubricant.compressibility.pressure_at(theta) if theta > 1 else None
        sides = (boundary.sides.low - lowest, boundary.sides.high - lowest)
        outlet = boundary.outlet
        if isinstance(self.geometry, Journal) and outlet == Outlet() and boundary.inlet.pressure is not None:
            outlet = Outlet.model_validate({"pressure": with_unit(boundary.inlet.pressure, "Pa")})
        return Ends(
            inlet=inlet,
            theta=1.0 if theta is None else min(theta, 1.0),
            outlet=outlet.pressure - lowest,
            sides=None if self.wide else sides,
        )

    def without_time(self) -> Self:
        """The bearing without what changes in time; InputError if it has loads over time and no other."""
        if self.motion.over_time is None:
            return self
        if self.load is None and self.geometry.film is None:
            raise InputError("load: is missing; a steady film has one load; give [load], or take roughfilm march")
        motion = self.motion.model_copy(update={"over_time": None})
        return self.model_copy(update={"motion": motion, "body": None})

    def check_newtonian(self, what: str) -> None:
        """Raise InputError if the lubricant has a law of shear thinning, which a calculation does not take."""
        law = self.lubricant.shear_thinning
        if law is not None:
            raise InputError(
                f"lubricant.shear_thinning: got {law.law!r}; {what} takes Newtonian lubricants, leave it out and give "
                "the viscosity of the usual shear rate"
            )

    @property
    def supply_patches(self) -> tuple[Patch, ...]:
        """Where the supplies lie in the film."""
        return patches(self.geometry, self.supply)

    @property
    def supplied(self) -> tuple[BearingLubricant, ...]:
        """The lubricant ahead of each supply, at its temperature."""
        lubricant = self.lubricant
        return tuple(lubricant if one.temperature is None else lubricant.at(one.temperature) for one in self.supply)

    @property
    def inflows(self) -> "tuple[Inflow, ...]":
        """The inflows of the supplies."""
        from roughfilm.rom.bearing.supply.restrictors import inflows  # slow to import

        return inflows(
            self.supply_patches,
            self.supply,
            viscosities=[one.viscosity for one in self.supplied],
            densities=[one.density for one in self.supplied],
            cavitation_pressure=self.lubricant.cavitation_pressure,
        )

    def problem(self) -> "Problem":
        """The problem of the film without roughness."""
        from roughfilm.rom.cavitation.problem import Problem  # slow to import

        geometry, lubricant, found = self.geometry, self.lubricant, self.supply_patches
        radius = geometry.radius if isinstance(geometry, Ring) else 1.0
        shape = geometry.film_shape()
        return Problem(
            shape=supplied(shape, found) if found else shape,
            inflows=self.inflows,
            ends=self.ends,
            speed=self.motion.speed / radius,
            viscosity=lubricant.viscosity,
            compressibility=lubricant.compressibility,
            piezoviscosity=lubricant.piezoviscosity,
            opening=self.opening(),
        )

    def opening(self) -> "Thickness | None":
        """∂h/∂t over x and y, m/s; None where the walls do not approach each other."""
        approach, geometry = self.motion.approach, self.geometry
        if approach == 0:
            return None
        if isinstance(geometry, Journal):
            return lambda x, y: approach * np.cos(x / geometry.radius) + 0 * y
        return lambda x, y: np.full(np.broadcast(x, y).shape, -approach)

    @property
    def pressure_unit(self) -> float:
        """The pressure scale of sliding and squeeze, 6 η u L/h² + 12 η V L²/h³, Pa, with the minimum thickness h."""
        return 6 * self.lubricant.viscosity * self.equivalent_speed * self.geometry.length / self.geometry.thinnest**2

    @property
    def equivalent_speed(self) -> float:
        """The mean speeds of sliding and of the squeezed liquid at the ends, u + 2 V L/h, m/s."""
        motion, geometry = self.motion, self.geometry
        squeezed = 2 * abs(motion.approach) * geometry.length / geometry.thinnest if motion.approach else 0.0
        return abs(motion.speed) + squeezed

    @property
    def revolutions(self) -> float:
        """The rotational frequency of the shaft, 1/s."""
        assert isinstance(self.geometry, Shaft)
        return abs(self.motion.speed) / (2 * math.pi * self.geometry.radius)
