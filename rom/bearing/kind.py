"""Bearings: load and friction of a film that may rupture."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from roughfilm.contact.foundation.entries import Part
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.toml import Location, in_one_line, known_keys, unknown_key
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.numbers import bearing_numbers
from roughfilm.rom.bearing.roughness import ROUGHNESSES
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shapes import SHAPES
from roughfilm.rom.ladder.kind import Kind, Omission
from roughfilm.rom.ladder.sweeping import Columns, Powers, Sweeping
from roughfilm.rom.lubricants.laws import LAWS

NEVER_COMPRESSED = 1e-12
"""p dθ/dp that stands for an incompressible lubricant."""

COLUMNS = {
    "compression": "compression",
    "width_ratio": "slenderness",
    "roughness_ratio": "roughness_ratio",
    "roughness_period": "roughness_period",
}
"""Columns of a table of many cases, and the numbers of the scene that stand in them."""

LOAD, LEAST_LOAD = "load_per_width", 1e-3
"""A load below this part of the friction is as good as none."""

SYMBOLS = {"compression": "ϑ", "starvation": "θ", "slenderness": "B/L"}


CHOSEN: Mapping[tuple[str, ...], Mapping[str, type[Part]]] = {
    ("geometry",): SHAPES,
    ("lubricant", "compressibility"): LAWS,
    ("lubricant", "piezoviscosity"): LAWS,
    ("roughness",): ROUGHNESSES,
}
"""Tables that say by one key what else is in them."""


def scale(values: Mapping[str, Any], quantity: str) -> Any:
    """The size of a quantity; of the load at least ``LEAST_LOAD`` of the friction."""
    size = np.abs(values[quantity])
    return np.maximum(size, LEAST_LOAD * np.abs(values["friction_per_width"])) if quantity == LOAD else size


def columns(scene: Bearing) -> dict[str, Quantity | str]:
    """The shape, how dense the inlet is, 6ηuL/h², how much that compresses, width over length if there is one.

    Of a rough wall also rms height over film, and the period over the length.
    """
    numbers = bearing_numbers(scene)
    return {
        "shape": scene.geometry.shape,
        "pressure_unit": Quantity(value=scene.pressure_unit, unit="Pa"),
        "inlet_theta": _one(numbers.get("starvation", 1.0)),
        **{name: _one(numbers[key]) for name, key in COLUMNS.items() if key in numbers},
    }


def _one(number: float) -> Quantity:
    return Quantity(value=float(f"{number:.12g}"), unit="1")


def features(given: Columns) -> dict[str, NDArray[Any]]:
    """θ of the inlet, ϑ at 6ηuL/h², and B/L; ``given`` as in :func:`columns`."""
    return {
        "starvation": given["inlet_theta"],
        "compression": np.maximum(given["compression"], NEVER_COMPRESSED),
        "slenderness": given["width_ratio"],
    }


def worth(values: Columns) -> NDArray[np.bool_]:
    """Every case with a film."""
    return np.asarray(values["pressure_max"] > 0)


def words(powers: Powers) -> str:
    """A product of powers as people write it."""
    return " · ".join(SYMBOLS[name] if power == 1 else f"({SYMBOLS[name]})^{power:g}" for name, power in powers.items())


def _without_tags(path: Location) -> tuple[list[int | str], type[Part] | None]:
    """Where a fault stands in the file, and the shape or law whose table that is, if it is one."""
    for place, classes in CHOSEN.items():
        depth = len(place)
        if tuple(path[:depth]) == place and len(path) > depth and path[depth] in classes:
            return [*place, *path[depth + 1 :]], classes[str(path[depth])]
    return list(path), None


def told(error: ValidationError, _entries: Mapping[str, Any]) -> str:
    """The first fault in one line; keys of a table that chooses a shape or a law are known by what it chooses."""
    found = sorted(error.errors(include_url=False), key=lambda fault: fault["type"] != "extra_forbidden")[0]
    chosen = _without_tags(found["loc"])[1]

    def unknown(location: Location) -> str:
        *path, key = location
        inner = next((path[len(place) :] for place in CHOSEN if tuple(path[: len(place)]) == place), None)
        return unknown_key(
            key, known_keys(Bearing, path) if chosen is None or inner is None else known_keys(chosen, inner)
        )

    return in_one_line(error, "scene", unknown, lambda path: _without_tags(path)[0])


NUMBERS = {
    "slenderness": "B/L",
    "convergence": "rise/h",
    "thickness_ratio": "h_max/h",
    "divergence": "widening/h",
    "starvation": "θ",
    "cavitation_number": "(p_amb - p_cav) h²/(6ηuL)",
    "compression": "p/β",
    "piezoviscous": "αp",
    "pressure_dependence": "p/β + αp",
    "roughness_ratio": "Sq/h",
    "peak_ratio": "Sp/h",
    "roughness_period": "period/L",
    "finest": "shortest feature/L",
    "texture_density": "texture density",
    "pocket_depth_ratio": "d/h",
    "pocket_length_ratio": "l/L",
    "reynolds_number": "Re",
    "reduced_reynolds_number": "Re·h/L",
}
"""How people write the numbers of a bearing, p being 6ηuL/h²."""


def omitted(scene: Bearing, quantity: str) -> Omission | None:
    """Inertia, to first order, of a lubricant whose density is told; None where a film does not come into balance."""
    from roughfilm.rom.bearing.omission import inertia_omitted  # whose films take long to import

    try:
        return inertia_omitted(scene, quantity)
    except ConvergenceError:
        return None


def composed(scene: Bearing) -> tuple[str, ...]:
    """By which model each effect is told, and why; and of a load, that rungs take the film as it is given."""
    from roughfilm.rom.bearing.effects.explanation import treatments  # as above

    told = [f"{one.effect}: {one.model}, {one.why}" for one in treatments(scene)]
    if scene.load is not None:
        told.append("load: all of this is of the film as given; roughfilm effects finds the film under its load")
    return tuple(told)


KIND = Kind(
    name="bearing",
    scene=Bearing,
    summary="a film between a shaped wall and a sliding one, which may rupture",
    compared={"load_per_width": "load", "friction_per_width": "friction"},
    scale=scale,
    columns=columns,
    numbers=bearing_numbers,
    symbols=NUMBERS,
    composed=composed,
    omitted=omitted,
    files=frozenset({"table", "surface", "thickness"}),
    lists=frozenset({("roughness", "spacing"), ("roughness", "surface", "size"), ("roughness", "surface", "points")}),
    told=told,
    replaces={
        "lubricant.compressibility.law": ("bulk_modulus", "c1", "c2", "table", "fit"),
        "lubricant.piezoviscosity.law": ("pressure_coefficient", "index"),
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
        "roughness.surface": ("digest", "spacing"),
        "roughness.table": ("digest",),
        "geometry.thickness": ("digest",),
        "boundary.inlet.theta": ("pressure",),
        "boundary.inlet.pressure": ("theta",),
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
