"""The kind of scene ``seal``: leakage between a rough surface and a flat one."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.dry_contact import kind as dry_contact
from roughfilm.rom.ladder.kind import Kind
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.sweeping import Columns, Sweeping
from roughfilm.rom.parts.gas import leakage_of_gas
from roughfilm.rom.parts.laminar import pressure_turbulence
from roughfilm.rom.parts.surroundings import ATMOSPHERE
from roughfilm.rom.seal.scene import Seal

MIN_LEAKAGE = 1e-4
"""Leakage over that of a smooth gap of the rms height below which a case does not count in a report over many cases."""

SEALED = 1e-9
"""Leakage over that of a smooth gap of the rms height below which the seal counts as sealed."""


def scale(values: Mapping[str, Any], quantity: str) -> Any:
    """The magnitude of a quantity, of leakage and permeability at least ``SEALED`` times that of a smooth gap.

    The smooth gap is as high as the rms height. Other quantities are those of a dry contact.
    """
    if quantity == "leakage_per_width":
        return np.maximum(np.abs(values[quantity]), SEALED * values["smooth_leakage"])
    if quantity == "permeability":
        return np.maximum(np.abs(values[quantity]), SEALED * values["rms_height"] ** 3)
    return dry_contact.scale(values, quantity)


def columns(scene: Seal) -> dict[str, Quantity | str]:
    """The columns of a dry contact, and the direction of the flow."""
    return {**dry_contact.columns(scene), "direction": scene.flow.direction}


def worth(values: Columns) -> NDArray[np.bool_]:
    """Whether the leakage of each case is not negligible."""
    return np.asarray(values["leakage_per_width"] > MIN_LEAKAGE * values["smooth_leakage"])


def numbers(scene: Seal) -> dict[str, float]:
    """The numbers of a dry contact, and the length of the seal over the side of the surface along the flow."""
    own = dry_contact.numbers(scene)
    return {**own, "length": scene.flow.length / scene.surface().size[scene.axis]} if own else {}


def outside(scene: Seal, model: Any, result: Result | None) -> tuple[str, ...]:
    """The sentences on a leakage that is not laminar, on a gas taken as a liquid, and on a load beyond elasticity."""
    leakage = 0.0 if result is None else result.quantities["leakage_per_width"].value
    return *dry_contact.outside(scene, model, result), *leakage_outside(scene, leakage)


def leakage_outside(scene: Seal, leakage: float) -> tuple[str, ...]:
    """The same of a leakage per width, kg/(m s), whose Re = ρq/η is the leakage over the viscosity."""
    liquid = scene.liquid
    gas = leakage_of_gas(liquid.density, liquid.viscosity, scene.flow.pressure_drop, ATMOSPHERE)
    return (*pressure_turbulence(leakage / liquid.viscosity), *gas)


def remarks(entries: Mapping[str, Any], _quantities: Mapping[str, Quantity]) -> tuple[str, ...]:
    """The key that the leakage of the whole seal needs, if it is missing."""
    if "width" in entries["flow"]:
        return ()
    return ("flow.width, the circumference of a ring, gives the leakage of the whole seal",)


KIND = Kind(
    name="seal",
    scene=Seal,
    summary="a liquid that leaks between a rough surface and a flat one",
    window=Seal.surface,
    compared={"leakage_per_width": "leakage", "area_fraction": "contact area"},
    others={"mean_gap": "mean gap", "permeability": "permeability"},
    remarks=remarks,
    of_input=dry_contact.KIND.of_input,
    outside=outside,
    reported={
        "leakage": "leakage, whole seal",
        "leakage_per_width": "leakage per width",
        "sealed": "sealed: 1, open: 0",
        "area_fraction": "contact area over nominal area",
        "mean_gap": "mean gap",
        "permeability": "permeability",
        "smooth_leakage": "smooth gap of the rms height",
        "dimensionless_leakage": "dimensionless leakage",
        "rms_height": "rms height",
    },
    scale=scale,
    columns=columns,
    numbers=numbers,
    symbols={**dry_contact.NUMBERS, "length": "length/side"},
    excluded="inertia and deformation by the pressure of the liquid",
    replaces=dry_contact.KIND.replaces,
    lists=dry_contact.KIND.lists,
    sweeping=Sweeping(
        given={
            "rough_surface": None,
            "pressure_ratio": None,
            "hardness_ratio": dry_contact.NEVER_PLASTIC,
            "nayak": None,
        },
        quantities=("leakage_per_width", "area_fraction", "smooth_leakage", "sealed"),
        features=dry_contact.features,
        worth=worth,
        candidates={"P/(E* g')": {"pressure": 1}, "α": {"breadth": 1}},
        fitted=("pressure", "breadth"),
        words=dry_contact.product_text,
    ),
)
