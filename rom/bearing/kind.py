"""The kind of scene "bearing": load and friction of a film with cavitation."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from roughfilm.contact.foundation.entries import Part
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.faults import Fault, faults_of, known_keys, unknown_key
from roughfilm.contact.foundation.line_numbers import Location
from roughfilm.contact.foundation.units import ZERO_CELSIUS, Quantity, to_si
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.bearing.effects.absent import absent_effects
from roughfilm.rom.bearing.equilibrium.expected import expected_scene
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.geometry.shapes import SHAPES
from roughfilm.rom.bearing.moving.over_time import UNITS as COLUMNS_OVER_TIME
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.roughness import ROUGHNESSES, RoughSurface
from roughfilm.rom.bearing.scene import Bearing, BearingMotion
from roughfilm.rom.bearing.supply.tables import SUPPLIES
from roughfilm.rom.bearing.thermal.outside import heat_that_stays, outside_of_lubricant
from roughfilm.rom.bearing.thermal.tables import WALLS
from roughfilm.rom.bearing.totals.reported import REPORTED
from roughfilm.rom.ladder.kind import InTime, Kind, Omission
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.sweeping import Columns, Powers, Sweeping
from roughfilm.rom.lubricants.laws import LAWS, THERMAL_LAWS
from roughfilm.rom.lubricants.shear_thinning import THINNING_LAWS
from roughfilm.rom.parts.surface_geometry import replaced_by

NEVER_COMPRESSED = 1e-12
"""Compression that stands for an incompressible lubricant in fits."""

COLUMNS = {
    "compression": "compression",
    "width_ratio": "slenderness",
    "roughness_ratio": "roughness_ratio",
    "roughness_period": "roughness_period",
}
"""Columns of a table of cases, with the names of their dimensionless numbers."""

MIN_LOAD_OVER_FRICTION = 1e-3
"""Load over friction below which errors of the load are related to the friction."""

DEGREES = {name: REPORTED[name] for name in ("temperature_max", "temperature_mean", "outlet_temperature")}
"""The temperatures that models are compared by, with their titles."""

LEAST_SIZES = {"attitude_angle": 10.0, "eccentricity": 0.1, **dict.fromkeys(DEGREES, 1.0)}
"""Attitude angle, degrees, eccentricity and rises of temperatures, K, below which their errors are related to these
sizes: all may be 0."""

SYMBOLS = {"compression": "ϑ", "starvation": "θ", "slenderness": "B/L"}

CHOSEN: Mapping[tuple[str | None, ...], Mapping[str, type[Part]]] = {
    ("geometry",): SHAPES,
    ("lubricant", "compressibility"): LAWS,
    ("lubricant", "piezoviscosity"): LAWS,
    ("lubricant", "shear_thinning"): THINNING_LAWS,
    ("lubricant", "thermoviscosity"): THERMAL_LAWS,
    ("roughness",): ROUGHNESSES,
    ("supply", None): SUPPLIES,
    ("heat", "fixed_wall"): WALLS,
    ("heat", "sliding_wall"): WALLS,
}
"""Tables of a scene whose classes depend on one of their keys; None is the number of a table in a list."""

MOVING = frozenset(name for name, shape in SHAPES.items() if issubclass(shape, MovingWall))
"""The shapes whose wall moves freely."""


def scale(values: Mapping[str, Any], quantity: str) -> Any:
    """The magnitude of a quantity; for the load at least ``MIN_LOAD_OVER_FRICTION`` times the friction.

    That of a place of a shaft is at least the one in ``LEAST_SIZES``.
    """
    size = np.maximum(np.abs(values[quantity]), LEAST_SIZES.get(quantity, 0.0))
    if quantity != "load_per_width":
        return size
    return np.maximum(size, MIN_LOAD_OVER_FRICTION * np.abs(values["friction_per_width"]))


def origin(entries: Mapping[str, Any], quantity: str) -> float:
    """The temperature of the supplied lubricant for a temperature, °C, whose errors are over its rise; else 0."""
    given = entries["lubricant"].get("temperature") if quantity in DEGREES else None
    return 0.0 if given is None else to_si(given, "K") - ZERO_CELSIUS


def columns(scene: Bearing) -> dict[str, Quantity | str]:
    """The columns of a table of cases: shape, 6ηuL/h², θ of the inlet, and the numbers in ``COLUMNS`` that exist."""
    numbers = bearing_numbers(scene)
    return {
        "shape": scene.geometry.shape,
        "pressure_unit": Quantity(value=expected_scene(scene).pressure_unit, unit="Pa"),
        "inlet_theta": _one(numbers.get("starvation", 1.0)),
        **{name: _one(numbers[key]) for name, key in COLUMNS.items() if key in numbers},
    }


def _one(number: float) -> Quantity:
    return Quantity(value=float(f"{number:.12g}"), unit="1")


def features(given: Columns) -> dict[str, NDArray[Any]]:
    """The features of a fit, θ of the inlet, ϑ at 6ηuL/h² and B/L, from the columns of :func:`columns`."""
    return {
        "starvation": given["inlet_theta"],
        "compression": np.maximum(given["compression"], NEVER_COMPRESSED),
        "slenderness": given["width_ratio"],
    }


def worth(values: Columns) -> NDArray[np.bool_]:
    """Whether each case has a film."""
    return np.asarray(values["pressure_max"] > 0)


def words(powers: Powers) -> str:
    """The formula of a product of powers."""
    return " · ".join(SYMBOLS[name] if power == 1 else f"({SYMBOLS[name]})^{power:g}" for name, power in powers.items())


def _without_tags(path: Location) -> tuple[list[int | str], type[Part] | None]:
    """The place of an error in the file, and the class of its table if the table is a shape or a law."""
    for place, classes in CHOSEN.items():
        depth = len(place)
        if _lies_in(path, place) and len(path) > depth and path[depth] in classes:
            return [*path[:depth], *path[depth + 1 :]], classes[str(path[depth])]
    return list(path), None


def _lies_in(path: Location, place: tuple[str | None, ...]) -> bool:
    return len(path) >= len(place) and all(b in (None, a) for a, b in zip(path, place, strict=False))


def validation_faults(error: ValidationError, _entries: Mapping[str, Any]) -> list[Fault]:
    """The faults of a scene; unknown keys of a shape or a law are compared with those of its class."""

    def unknown(place: Location) -> tuple[str, str]:
        (*path, key), chosen = _without_tags(place)
        inner = next((path[len(place) :] for place in CHOSEN if _lies_in(path, place)), None)
        return unknown_key(
            key, known_keys(Bearing, path) if chosen is None or inner is None else known_keys(chosen, inner)
        )

    return faults_of(error, unknown, lambda path: _without_tags(path)[0])


NUMBERS = {
    "slenderness": "B/L",
    "piece_slenderness": "B/L of a lobe or pad",
    "convergence": "rise/h",
    "thickness_ratio": "h_max/h",
    "divergence": "widening/h",
    "starvation": "θ",
    "cavitation_number": "(p_amb - p_cav) h²/(6ηuL)",
    "suction": "suction over suction and ambient pressure",
    "compression": "p/β",
    "piezoviscous": "αp",
    "pressure_dependence": "p_B/β + αp_B",
    "roughness_ratio": "Sq/h",
    "peak_ratio": "Sp/h",
    "roughness_period": "period/L",
    "finest": "shortest feature/L",
    "texture_density": "texture density",
    "pocket_depth_ratio": "d/h",
    "pocket_length_ratio": "l/L",
    "squeeze_number": "2VL/(uh)",
    "reynolds_number": "Re",
    "reduced_reynolds_number": "Re·h/L",
    "heating_number": "βΔT without heat to the walls",
    "thermal_peclet_number": "ρcuh²/(kL)",
    "nahme_number": "βηu²/k",
    "brinkman_number": "ηu²/(kΔT of a wall)",
}
"""The symbols of the dimensionless numbers; p = 6ηuL/h², p_B = p/(1 + (L/B)²) plus the largest pressure at an edge."""


def remarks(entries: Mapping[str, Any], quantities: Mapping[str, Quantity]) -> tuple[str, ...]:
    """The approach of the walls, the pressure at which the film ruptures, and the part that the quantities hold for."""
    return (
        *_approach(entries),
        *_rupture(entries, quantities),
        *_of_the_whole(entries, quantities),
        *_flash(entries, quantities),
    )


def _flash(entries: Mapping[str, Any], quantities: Mapping[str, Quantity]) -> tuple[str, ...]:
    """What the flash temperature is, or why a scene with ``asperities.solid_heat`` has none."""
    if "flash_temperature" in quantities:
        return (
            "flash_temperature is an estimate: it has no uncertainty, but a range from its low to its high estimate",
        )
    contact = entries.get("asperities")
    given = contact.get("solid_heat") if isinstance(contact, Mapping) else getattr(contact, "solid_heat", None)
    if given is None or "contact_pressure_max" not in quantities:
        return ()
    return ("no asperities touch, so that there is no flash temperature",)


def squeezed(entries: Mapping[str, Any]) -> bool:
    """Whether the walls of a scene approach each other or part; the error laws do not hold then."""
    motion = entries["motion"]
    return (motion.approach if isinstance(motion, BearingMotion) else _velocity(motion)) != 0


def _moves_freely(entries: Mapping[str, Any]) -> bool:
    """Whether the wall of a scene is a shaft in lobes or a pad about a pivot."""
    geometry = entries["geometry"]
    return (geometry["shape"] if isinstance(geometry, Mapping) else geometry.shape) in MOVING


def free(entries: Mapping[str, Any]) -> bool:
    """Whether the place of a wall that moves freely is sought under a load."""
    return _moves_freely(entries) and entries.get("load") is not None


def placed(entries: Mapping[str, Any]) -> bool:
    """Whether the place of a wall that moves freely is given."""
    return _moves_freely(entries) and entries.get("load") is None


def _velocity(motion: Mapping[str, Any]) -> float:
    """The approach in the entries of a motion, m/s."""
    return to_si(motion["approach"], "m/s") if "approach" in motion else 0.0


def _approach(entries: Mapping[str, Any]) -> tuple[str, ...]:
    """The velocity at which the walls approach each other, with what the filling of cavities does."""
    approach = _velocity(entries["motion"])
    if approach == 0:
        return ()
    speed = f"at {abs(approach):.4g} m/s"
    if entries["geometry"]["shape"] == "journal":
        moves = f"the shaft moves {'towards' if approach > 0 else 'away from'} its narrowest place {speed}"
    else:
        moves = f"the walls {'approach each other' if approach > 0 else 'part'} {speed}"
    return (f"{moves} (motion.approach); the numbers hold at this film, and the filling of cavities does not change",)


def _rupture(entries: Mapping[str, Any], quantities: Mapping[str, Quantity]) -> tuple[str, ...]:
    """The cavitation pressure, on which the flows of a film with cavities depend."""
    if "cavitated_fraction" not in quantities or quantities["cavitated_fraction"].value == 0:
        return ()
    given = to_si(entries["lubricant"]["cavitation_pressure"], "Pa") / 1e3
    place = "ambient pressure" if given == 0 else f"{abs(given):.4g} kPa {'below' if given < 0 else 'above'} ambient"
    return (f"the film ruptures at {place} (lubricant.cavitation_pressure), on which the flows depend",)


def _of_the_whole(entries: Mapping[str, Any], quantities: Mapping[str, Quantity]) -> tuple[str, ...]:
    """The part of the whole bearing for which the quantities hold, if they do not hold for all of it."""
    geometry, whole = entries["geometry"], quantities.get("bearing_load")
    if geometry["shape"] not in ("sector", "washer"):
        return ()
    count = geometry.get("pockets", geometry.get("pads"))
    if count is None and whole is not None:
        count = round(2 * math.pi / to_si(geometry["angle"], "rad"))  # joined pads fill the ring
    if count is None and to_si(geometry["angle"], "rad") <= math.pi:
        return ("one pad of the bearing; geometry.pads, their number, gives the numbers of the whole bearing",)
    if count in (None, 1):
        return ()  # the piece is the whole bearing
    line = f"one of {count} equal pieces"
    if whole is None:
        return (line,)
    carried = f"{whole.value / 1e3:.4g} kN" if abs(whole.value) >= 1e3 else f"{whole.value:.4g} N"
    return (f"{line}; the whole bearing carries {carried}",)


def omitted(scene: Bearing, model: Any, quantity: str) -> Omission | None:
    """The effects that a model leaves out and the laws do not count; None if they are unknown, or no film converges."""
    from roughfilm.rom.bearing.omission import omission  # slow to import

    try:
        return omission(scene, model, quantity)
    except ConvergenceError:
        return None


def missing(scene: Bearing, model: Any) -> float:
    """The relative change of the load by the effects among inertia, cavitation and heating that a model leaves out."""
    from roughfilm.rom.bearing.omission import missing  # slow to import

    return missing(scene, model)


def outside(scene: Bearing, model: Any, result: Result | None) -> tuple[str, ...]:
    """The sentences on a scene that is surely outside the range of a model, or whose temperatures are."""
    if result is not None:
        return outside_of_lubricant(scene, result)  # each model judges the film that it has found
    from roughfilm.rom.bearing.outside import scene_outside  # slow to import

    return (*outside_of_lubricant(scene), *heat_that_stays(scene, model), *scene_outside(scene, model))


def steady(scene: Bearing) -> Bearing:
    """The scene at the time by which models are judged, if it changes in time; else the scene."""
    if scene.motion.over_time is None:
        return scene
    from roughfilm.rom.bearing.march.in_time import steady  # slow to import

    return steady(scene)


def in_time(scene: Bearing, within: float) -> InTime | None:
    """What a motion in time means for a scene; None for a scene without one."""
    if scene.motion.over_time is None and not scene.motion.approach:
        return None
    from roughfilm.rom.bearing.march.in_time import in_time  # slow to import

    return in_time(scene, within)


def window(scene: Bearing) -> Surface | None:
    """The rough surface of one of the walls; None if the roughness is another one."""
    return scene.roughness.read() if isinstance(scene.roughness, RoughSurface) else None


def excluded(scene: Bearing) -> str:
    """The effects that no model of a bearing includes, in words."""
    heat = ", heat and" if scene.lubricant.lacking else " and"
    return f"inertia{heat} deformation of the bodies as a whole"


def composed(scene: Bearing) -> tuple[str, ...]:
    """A line for each effect with its model and the reason, and one for the film under a load."""
    from roughfilm.rom.bearing.effects.explanation import effect_models  # slow to import

    lines = [f"{one.effect}: {one.model}, {one.why}" for one in effect_models(scene)]
    if scene.load is not None:
        film, given = expected_scene(scene).geometry.thinnest, scene.geometry.film
        first = "" if given is None else f"; the given film of {1e6 * given:.3g} µm is the first value of the search"
        lines.append(f"load: the film is sought that carries it, about {1e6 * film:.3g} µm{first}")
    return tuple(lines)


KIND = Kind(
    name="bearing",
    scene=Bearing,
    summary="a film between a shaped wall and a sliding one, with cavitation",
    window=window,
    compared={"load_per_width": "load", "friction_per_width": "friction"},
    compared_with={"load": {"film_min": "least film thickness", "friction_per_width": "friction"}},
    others={
        "film_min": "least film thickness",
        "pressure_max": "peak pressure",
        "inlet_flow_per_width": "flow in",
        "side_leakage": "side leakage",
        "friction_coefficient": "friction coefficient",
        "cavitated_fraction": "cavitated fraction",
        "eccentricity": "eccentricity",
        "attitude_angle": "attitude angle",
        "contact_load_per_width": "load by contact",
        "film_load_per_width": "load by the film",
        "least_gap": "least gap",
        **DEGREES,
    },
    reported=REPORTED,
    remarks=remarks,
    alike={"friction_per_width": "power loss"},
    ratios={"friction_coefficient": ("friction_per_width", "load_per_width")},
    scale=scale,
    origin=origin,
    columns=columns,
    numbers=bearing_numbers,
    symbols=NUMBERS,
    excluded=excluded,
    absent=absent_effects,
    composed=composed,
    variants={"free_bearing": free, "placed_bearing": placed},
    samples={"heated_bearing": frozenset({"heat_balance", "adiabatic", "across"}), "hot_wedge": frozenset()},
    steady=steady,
    without_time=Bearing.without_time,
    in_time=in_time,
    lawless=squeezed,
    omitted=omitted,
    outside=outside,
    missing=missing,
    lists=frozenset(
        {
            ("roughness", "spacing"),
            ("roughness", "surface", "size"),
            ("roughness", "surface", "points"),
            ("lubricant", "thermoviscosity", "points"),
            ("lubricant", "thermoviscosity", "table"),
            ("lubricant", "heat_capacity", "table"),
            ("asperities", "friction", "table"),
            *(("motion", "over_time", name) for name in COLUMNS_OVER_TIME),
        }
    ),
    faults=validation_faults,
    replaces={
        "lubricant.compressibility.law": ("bulk_modulus", "c1", "c2", "table", "fit"),
        "lubricant.piezoviscosity.law": ("pressure_coefficient", "index"),
        "lubricant.shear_thinning.law": (
            "index",
            "critical_stress",
            "relaxation_time",
            "exponent",
            "infinite_shear_viscosity",
        ),
        "lubricant.shear_thinning.critical_stress": ("relaxation_time",),
        "lubricant.shear_thinning.relaxation_time": ("critical_stress",),
        "lubricant.thermoviscosity.law": (
            "temperature_coefficient",
            "index",
            "a",
            "b",
            "c",
            "points",
            "grade",
            "viscosity_index",
            "table",
            "valid_from",
            "valid_to",
        ),
        "lubricant.heat_capacity.constant": ("table",),
        "lubricant.heat_capacity.table": ("constant",),
        "asperities.friction.constant": ("table",),
        "asperities.friction.table": ("constant",),
        "roughness.kind": (
            "amplitude",
            "wavelength",
            "direction",
            "phase",
            "surface",
            "spacing",
            "scale",
            "stretch",
            "table",
        ),
        "roughness.surface": replaced_by,
        "roughness.table": ("digest",),
        "geometry.thickness": ("digest",),
        "motion.over_time.file": ("digest",),
        "load.pressure": ("force", "force_per_width"),
        "load.force": ("pressure", "force_per_width"),
        "load.force_per_width": ("pressure", "force"),
        "boundary.inlet.theta": ("pressure", "ram_factor"),
        "boundary.inlet.pressure": ("theta",),
        "boundary.inlet.ram_factor": ("theta",),
    },
    sweeping=Sweeping(
        given={"shape": None, "inlet_theta": 1.0, "compression": NEVER_COMPRESSED, "width_ratio": 1e3},
        quantities=("load_per_width", "friction_per_width", "pressure_max"),
        features=features,
        worth=worth,
        candidates={
            "θ": {"starvation": 1},
            "ϑ": {"compression": 1},
            "B/L": {"slenderness": 1},
        },
        fitted=("starvation", "compression", "slenderness"),
        words=words,
    ),
)
