"""The kind of scene ``pocket``: load and friction of a film over grooves or dimples."""

from collections.abc import Mapping
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from roughfilm.contact.foundation.entries import Part
from roughfilm.contact.foundation.faults import Fault, faults_of, known_keys, unknown_key
from roughfilm.contact.foundation.line_numbers import Location
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.kind import Kind, Omission
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.ladder.sweeping import Columns, Sweeping
from roughfilm.rom.parts.gas import compressibility_of_gas
from roughfilm.rom.parts.laminar import shear_turbulence
from roughfilm.rom.pocket.geometry import PROFILES, PocketGeometry
from roughfilm.rom.pocket.plan.dimples import SHAPES
from roughfilm.rom.pocket.plan.geometry import PlanGeometry
from roughfilm.rom.pocket.scene import GROOVES, IN_PLAN, LAWS_IN_PLAN, TITLES, Pocket, in_plan
from roughfilm.rom.pocket.validity.bounds import bounded
from roughfilm.rom.pocket.validity.numbers import MIN_LOAD_SCALE, SYMBOLS, numbers

COMPARED = ("load_plus", "friction_plus")
"""The quantities by which models are compared."""

FULL_INERTIA = ("film", "film_slope")
"""The thin-film models whose load shows whether effects cancel that the laws, to first order in Re, add."""

REPORTED = {
    "load_per_area": "load per area",
    "load_from_corner_per_area": "load per area, pressure zero at the corner",
    "friction_per_area": "friction per area",
    **{name: f"{title}, dimensionless" for name, title in TITLES.items() if name != "backflow"},
    "backflow": "reverse flow over sliding speed",
    "cavitated_fraction": "cavitated fraction",
    "theta_min": "least density ratio",
}
"""The titles of the quantities of a pocket, in the order of tables."""

EXTREMES = ("pressure_min_plus", "pressure_max_plus")

MIN_JUDGED_LOAD = 0.05
"""Load over the largest pressure below which load is a difference of larger numbers, and its error has no law."""

MIN_PRESSURE_SCALE = 0.1
"""Ratio of the peak or least pressure to the largest magnitude of the pressure below which errors have this scale."""

FEATURE_SYMBOLS = {"reynolds_number": "Re", "depth": "d/Ly", "aspect": "2d/w", "slope": "slope"}
"""Symbols of the numbers of a sweep; ``slope`` is that of the steeper side of a groove, 2d/w for a symmetric one."""

RATIOS = {
    "film_plus": ("film", "length"),
    "width_plus": ("width", "length"),
    "depth_plus": ("depth", "film"),
    "shift_plus": ("shift", "width"),
}
"""The dimensionless numbers of a groove as ratios of lengths: w+, d+ and xd+ of doi:10.1115/1.1828067."""


def largest_pressure(values: Mapping[str, Any]) -> Any:
    """The largest magnitude of the pressure p+, a number or of the shape of the values."""
    return np.maximum(np.abs(values["pressure_max_plus"]), np.abs(values["pressure_min_plus"]))


def scale(values: Mapping[str, Any], quantity: str) -> Any:
    """The magnitude of a quantity; the largest pressure for a negligible load, a tenth of it for a small pressure."""
    size = np.abs(values[quantity])
    if quantity in ("pressure_max_plus", "pressure_min_plus"):
        return np.maximum(size, MIN_PRESSURE_SCALE * largest_pressure(values))
    if quantity not in ("load_plus", "load_from_corner_plus"):
        return size
    pressure = largest_pressure(values)
    return np.where(size > MIN_LOAD_SCALE * pressure, size, pressure)


def columns(scene: Pocket) -> dict[str, Quantity | str]:
    """The Reynolds number, the dimensionless numbers of a single groove or of dimples, and their shape."""
    if isinstance(scene.geometry, PlanGeometry):
        shape, numbers = _of_dimples(scene, scene.geometry)
    else:
        geometry = scene_entries(scene)["geometry"]
        shape = geometry.get("profile", "several grooves")
        numbers = {
            plus: float(f"{_length(geometry[one]) / _length(geometry[other]):.12g}")
            for plus, (one, other) in RATIOS.items()
            if one in geometry and other in geometry
        }
    numbers["reynolds_number"] = scene.reynolds_number
    return {"profile": shape, **{name: Quantity(value=number, unit="1") for name, number in numbers.items()}}


def _of_dimples(scene: Pocket, geometry: PlanGeometry) -> tuple[str, dict[str, float]]:
    """The shape of the dimples of a cell, with their numbers; of several the least extent and the greatest depth."""
    first, *others = geometry.dimples
    width = geometry.narrowest if others else first.extents[0]
    numbers = {
        "film_plus": geometry.film / geometry.length,
        "width_plus": width / geometry.length,
        "depth_plus": scene.depth,
        "cell_breadth": geometry.breadth / geometry.length,
        "covered": geometry.covered,
    }
    shapes = {one.shape for one in geometry.dimples}
    shape = first.shape if len(shapes) == 1 else "several dimples"
    return shape, {name: float(f"{number:.12g}") for name, number in numbers.items()}


def features(given: Columns) -> dict[str, NDArray[Any]]:
    """The numbers Re, d/Ly, 2d/w and mean slope of the steeper side, from :func:`columns` of many scenes."""
    width, depth = given["width_plus"] / given["film_plus"], given["depth_plus"]
    return {
        "reynolds_number": given["reynolds_number"],
        "depth": depth,
        "aspect": 2 * depth / width,
        "slope": depth / (width * (0.5 - np.abs(given["shift_plus"]))),
    }


def product_text(powers: Mapping[str, float]) -> str:
    """A product of powers as text, such as ``Re · 2d/w``."""

    def factor(symbol: str, power: float) -> str:
        return symbol if power == 1 else f"{symbol if symbol.isalpha() else f'({symbol})'}^{power:g}"

    left = dict(powers)
    ratio = []
    if left.get("aspect") and left.get("aspect") == -left.get("depth", 0):
        ratio = [factor("2Ly/w", left.pop("aspect"))]
        del left["depth"]
    return " · ".join([*(factor(FEATURE_SYMBOLS[name], power) for name, power in left.items()), *ratio])


def worth(values: Columns) -> NDArray[np.bool_]:
    """Whether each case has a load above ``MIN_JUDGED_LOAD`` times the largest pressure."""
    return np.asarray(np.abs(values["load_plus"]) > MIN_JUDGED_LOAD * largest_pressure(values))


THIN = 0.1
"""2d/w of a groove or dimple up to which the film in it is thin."""

ZERO_IN_PLAN = "pressures count from their mean over the edges x = ±L/2 of the cell on the sliding wall"
"""The place where the pressure of a cell in plan is zero, in words."""


def remarks(entries: Mapping[str, Any], _quantities: Mapping[str, Quantity]) -> tuple[str, ...]:
    """The place where the pressure of a cell in plan is zero, on which its load depends."""
    return (ZERO_IN_PLAN,) if "dimples" in entries["geometry"] else ()


def omitted(scene: Pocket, model: Any, quantity: str) -> Omission | None:
    """The effect that a model leaves out where the film ruptures, and inertia for one that keeps cavitation."""
    from roughfilm.rom.pocket.cavitating.omission import omission  # slow to import

    return omission(scene, model, quantity)


def missing(scene: Pocket, model: Any) -> float:
    """The relative change of the load by the effects among inertia and cavitation that a model leaves out."""
    from roughfilm.rom.pocket.cavitating.omission import missing  # slow to import

    return missing(scene, model)


def outside_laws(scene: Pocket, result: Result, quantity: str) -> str:
    """The reason for which the laws of the load do not hold for a film whose effects cancel in it; empty if they do."""
    from roughfilm.rom.pocket.validity.warnings import cancellations

    if scene.in_plan or quantity != "load_plus" or result.model not in FULL_INERTIA:
        return ""
    load, lowest, highest = (result.quantities[name].value for name in ("load_plus", *EXTREMES))
    return next(iter(cancellations(scene, load=load, lowest=lowest, highest=highest)), "")


def outside(scene: Pocket, _model: Any, result: Result | None) -> tuple[str, ...]:
    """The sentences on a flow that is not laminar, or on a gas that is taken as a liquid.

    The film of the Reynolds number is the thickest one, with the depth of grooves or dimples that are thin films, too.
    """
    turbulent = shear_turbulence(scene.reynolds_number * (1 + (scene.depth if scene.aspect <= THIN else 0.0)))
    if result is None:
        return turbulent
    lubricant, ambient = scene.lubricant, scene.boundary.ambient_pressure
    pressures = [result.quantities[name].value for name in EXTREMES if name in result.quantities]
    largest = max(map(abs, pressures), default=0.0) / scene.plus_factor * scene.pressure_unit
    number = 6 * scene.pressure_unit * scene.geometry.length / scene.geometry.film / ambient
    return (*turbulent, *compressibility_of_gas(lubricant.density, lubricant.viscosity, largest, ambient, number))


def _length(text: str) -> float:
    return float(text.partition(" ")[0])


def _location(path: Location, entries: Mapping[str, Any]) -> tuple[list[int | str], type[Part] | None]:
    """The location of a fault in the file, and the class of its groove or dimple; None outside of them."""
    location = list(path)
    if location[:1] != ["geometry"] or len(location) < 2:
        return location, None
    tag = location.pop(1)
    if location[1:2] not in (["grooves"], ["dimples"]) or len(location) < 3:
        return location, None
    shape = (SHAPES if tag == IN_PLAN else PROFILES).get(str(location.pop(3))) if len(location) > 3 else None
    if tag == GROOVES and "grooves" not in entries["geometry"]:
        del location[1:3]
    return location, shape


def pocket_faults(error: ValidationError, entries: Mapping[str, Any]) -> list[Fault]:
    """The faults, with the keys of the groove's profile or the dimple's shape."""

    def unknown(place: Location) -> tuple[str, str]:
        (*path, key), shape = _location(place, entries)
        geometry = PlanGeometry if list(place[:2]) == ["geometry", IN_PLAN] else PocketGeometry
        known = [*shape.model_fields] if shape else known_keys(Pocket, path) if path != ["geometry"] else []
        if path == ["geometry"]:
            known = [*dict.fromkeys([*geometry.model_fields, *(shape.model_fields if shape else ())])]
        if shape and any(key in other.model_fields for other in (*PROFILES.values(), *SHAPES.values())):
            own = shape.model_fields
            name = next(str(get_args(own[one].annotation)[0]) for one in ("profile", "shape") if one in own)
            return f"no key of {'shape' if 'shape' in own else 'profile'} {name!r}; known here: {', '.join(known)}", ""
        return unknown_key(key, known)

    return faults_of(error, unknown, lambda path: _location(path, entries)[0])


KIND = Kind(
    name="pocket",
    scene=Pocket,
    summary="grooves or dimples under a sliding wall",
    compared={name: TITLES[name] for name in COMPARED},
    others={
        **{name: title for name, title in TITLES.items() if name not in COMPARED},
        "cavitated_fraction": REPORTED["cavitated_fraction"],
    },
    reported=REPORTED,
    remarks=remarks,
    scale=scale,
    columns=columns,
    numbers=numbers,
    symbols=SYMBOLS,
    excluded="heat and deformation",
    omitted=omitted,
    missing=missing,
    bounded=bounded,
    outside_laws=outside_laws,
    outside=outside,
    variants={LAWS_IN_PLAN: in_plan},
    samples={"deep_dimples": frozenset(), "plane_grooves": frozenset()},
    replaces={
        "motion.speed": ("reynolds_number",),
        "motion.reynolds_number": ("speed",),
        "geometry.points": ("width", "depth", "shift"),
    },
    faults=pocket_faults,
    sweeping=Sweeping(
        given={
            "profile": None,
            "width_plus": None,
            "depth_plus": None,
            "reynolds_number": None,
            "film_plus": None,
            "shift_plus": 0.0,
        },
        quantities=("load_plus", "friction_plus", "pressure_max_plus", "pressure_min_plus", "backflow"),
        features=features,
        worth=worth,
        candidates={
            "Re": {"reynolds_number": 1},
            "d/Ly": {"depth": 1},
            "2d/w": {"aspect": 1},
            "slope": {"slope": 1},
            "2Ly/w": {"depth": -1, "aspect": 1},
            "Re 2Ly/w": {"reynolds_number": 1, "depth": -1, "aspect": 1},
            "Re 2d/w": {"reynolds_number": 1, "aspect": 1},
            "Re slope": {"reynolds_number": 1, "slope": 1},
            "Re (2d/w)²": {"reynolds_number": 1, "aspect": 2},
            "2d²/(w Ly)": {"depth": 1, "aspect": 1},
        },
        fitted=("reynolds_number", "depth", "aspect"),
        words=product_text,
    ),
)
