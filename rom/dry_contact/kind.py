"""Dry contacts: real area and mean gap of a rough surface under load."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.kind import Kind
from roughfilm.rom.ladder.sweeping import Columns, Powers, Sweeping
from roughfilm.rom.parts.pressed_surface import RoughContact

LEAST_GAP = 1e-3
"""A mean gap below this part of the rms height is as good as closed; an error in it is divided by that part."""

NEVER_PLASTIC = 10.0
"""H/(E* g') that stands for a solid without hardness: its pressures hardly exceed 2 E* g'."""

SYMBOLS = {"pressure": "P/(E* g')", "hardness": "H/(E* g')", "breadth": "α"}


def scale(values: Mapping[str, Any], quantity: str) -> Any:
    """The size of a quantity; of the mean gap at least ``LEAST_GAP`` of the rms height."""
    size = np.abs(values[quantity])
    return np.maximum(size, LEAST_GAP * values["rms_height"]) if quantity == "mean_gap" else size


def columns(scene: RoughContact) -> dict[str, Quantity | str]:
    """The surface's name, P/(E* g'), H/(E* g') where there is a hardness, and Nayak's α where the surface is rough."""
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
    """P/(E* g'), H/(E* g') and α; ``given`` as in :func:`columns`."""
    return {"pressure": given["pressure_ratio"], "hardness": given["hardness_ratio"], "breadth": given["nayak"]}


def worth(values: Columns) -> NDArray[np.bool_]:
    """Every case that touches."""
    return np.asarray(values["area_fraction"] > 0)


def words(powers: Powers) -> str:
    """A product of powers as people write it; P/H where pressure and hardness are over each other."""
    left = dict(powers)
    told = []
    if left.get("pressure") == 1 and left.get("hardness") == -1:
        del left["pressure"], left["hardness"]
        told.append("P/H")
    told += [SYMBOLS[name] if power == 1 else f"({SYMBOLS[name]})^{power:g}" for name, power in left.items()]
    return " · ".join(told)


NUMBERS = {
    "pressure": "P/(E* g')",
    "hardness": "H/(E* g')",
    "plasticity": "P/H",
    "breadth": "α",
    "waves": "side/λ",
}
"""How people write the numbers of a contact."""


def numbers(scene: RoughContact) -> dict[str, float]:
    """λ = 2π Sq/g'; P/H and H/(E* g') as if H were ten times E* g' without one.

    A flat surface has none of them.
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


KIND = Kind(
    name="dry_contact",
    scene=DryContact,
    summary="a rough surface pressed on a flat one",
    compared={"area_fraction": "contact area", "mean_gap": "mean gap"},
    scale=scale,
    columns=columns,
    numbers=numbers,
    symbols=NUMBERS,
    files=frozenset({"surface"}),
    replaces={"geometry.surface": ("digest", "spacing")},
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
        words=words,
    ),
)
