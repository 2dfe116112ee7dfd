"""The kind of scene ``dry_contact``: real area and mean gap of a rough surface under load."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.mechanics.solid import beyond_elasticity
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.kind import Kind
from roughfilm.rom.ladder.model import Effect, Model
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.sweeping import Columns, Powers, Sweeping
from roughfilm.rom.parts.prepared import error_of_preparation
from roughfilm.rom.parts.pressed_surface import RoughContact
from roughfilm.rom.parts.surface_geometry import replaced_by

MIN_GAP_SCALE = 1e-3
"""Mean gap over the rms height below which errors are relative to this value."""

NEVER_PLASTIC = 10.0
"""H/(E* g') that stands for a solid without hardness, whose pressures hardly exceed 2 E* g'."""

SYMBOLS = {"pressure": "P/(E* g')", "hardness": "H/(E* g')", "breadth": "α"}


def scale(values: Mapping[str, Any], quantity: str) -> Any:
    """The magnitude of a quantity, for the mean gap at least ``MIN_GAP_SCALE`` times the rms height."""
    size = np.abs(values[quantity])
    return np.maximum(size, MIN_GAP_SCALE * values["rms_height"]) if quantity == "mean_gap" else size


def columns(scene: RoughContact) -> dict[str, Quantity | str]:
    """The name of the surface, P/(E* g'), H/(E* g') of a plastic solid, and Nayak's α of a rough surface."""
    spectrum = scene.spectrum()
    numbers = {"pressure_ratio": scene.load.pressure / scene.pressure_unit}
    if scene.solid.hardness is not None:
        numbers["hardness_ratio"] = scene.solid.hardness / scene.pressure_unit
    if spectrum is not None:
        numbers["nayak"] = spectrum.moments.nayak
    return {
        "rough_surface": scene.geometry.name,
        **{name: Quantity(value=float(f"{number:.12g}"), unit="1") for name, number in numbers.items()},
    }


def features(given: Columns) -> dict[str, NDArray[Any]]:
    """The numbers P/(E* g'), H/(E* g') and α from :func:`columns` of many scenes."""
    return {"pressure": given["pressure_ratio"], "hardness": given["hardness_ratio"], "breadth": given["nayak"]}


def worth(values: Columns) -> NDArray[np.bool_]:
    """Whether each case has contact."""
    return np.asarray(values["area_fraction"] > 0)


def product_text(powers: Powers) -> str:
    """A product of powers as text, with P/H for pressure over hardness."""
    left = dict(powers)
    factors = []
    if left.get("pressure") == 1 and left.get("hardness") == -1:
        del left["pressure"], left["hardness"]
        factors.append("P/H")
    factors += [SYMBOLS[name] if power == 1 else f"({SYMBOLS[name]})^{power:g}" for name, power in left.items()]
    return " · ".join(factors)


NUMBERS = {
    "pressure": "P/(E* g')",
    "hardness": "H/(E* g')",
    "plasticity": "P/H",
    "breadth": "α",
    "waves": "side/λ",
}
"""Symbols of the numbers of a contact."""


def numbers(scene: RoughContact) -> dict[str, float]:
    """The dimensionless numbers of a contact, with λ = 2π Sq/g', and H = 10 E* g' without a hardness.

    A flat surface has none.
    """
    spectrum = scene.spectrum()
    if spectrum is None:
        return {}
    surface, pressure = scene.surface(), scene.load.pressure / scene.pressure_unit
    hardness = NEVER_PLASTIC if scene.solid.hardness is None else scene.solid.hardness / scene.pressure_unit
    wavelength = 2 * np.pi * spectrum.moments.m0**0.5 / spectrum.moments.rms_slope
    return {
        "pressure": pressure,
        "hardness": hardness,
        "plasticity": pressure / hardness,
        "breadth": spectrum.moments.nayak,
        "waves": max(surface.size) / wavelength,
    }


def outside(scene: RoughContact, model: Model[Any], result: Result | None) -> tuple[str, ...]:
    """The sentence on a peak pressure beyond linear elasticity, or on the mean pressure where no peak is known."""
    if Effect.DEFORMATION not in model.keeps:
        return ()
    peak = None if result is None else result.quantities.get("pressure_max")
    if peak is None:
        return beyond_elasticity(scene.load.pressure, scene.composite_modulus, "mean pressure")
    return beyond_elasticity(peak.value, scene.composite_modulus)


KIND = Kind(
    name="dry_contact",
    scene=DryContact,
    summary="a rough surface pressed on a flat one",
    window=DryContact.surface,
    compared={"area_fraction": "contact area", "mean_gap": "mean gap"},
    others={"mean_contact_pressure": "mean contact pressure", "pressure_max": "peak pressure", "approach": "approach"},
    reported={
        "area_fraction": "contact area over nominal area",
        "mean_gap": "mean gap",
        "mean_contact_pressure": "mean contact pressure",
        "pressure_max": "peak pressure",
        "approach": "approach",
        "plastic_fraction": "plastic area over nominal area",
        "area_fraction_pixel": "contact area by points in contact",
        "rms_height": "rms height",
    },
    scale=scale,
    columns=columns,
    numbers=numbers,
    samples={"small_surface": frozenset()},
    of_input=error_of_preparation,
    outside=outside,
    symbols=NUMBERS,
    excluded="friction, adhesion and hardening",
    replaces={"geometry.surface": replaced_by},
    lists=frozenset({("geometry", "spacing"), ("geometry", "surface", "size"), ("geometry", "surface", "points")}),
    sweeping=Sweeping(
        given={"rough_surface": None, "pressure_ratio": None, "hardness_ratio": NEVER_PLASTIC, "nayak": None},
        quantities=("area_fraction", "plastic_fraction", "mean_gap", "rms_height"),
        features=features,
        worth=worth,
        candidates={
            "P/(E* g')": {"pressure": 1},
            "H/(E* g')": {"hardness": 1},
            "P/H": {"pressure": 1, "hardness": -1},
            "α": {"breadth": 1},
        },
        fitted=("pressure", "hardness", "breadth"),
        words=product_text,
    ),
)
