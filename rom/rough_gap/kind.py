"""The kind of scene ``rough_gap``: flow through one period of the gap between two walls."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.kind import Kind, Omission
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.sweeping import Columns, Powers, Sweeping
from roughfilm.rom.parts.gas import leakage_of_gas
from roughfilm.rom.parts.laminar import pressure_turbulence, shear_turbulence
from roughfilm.rom.parts.surface_geometry import replaced_by
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.walls import TOUCHING

MIN_FLOW = 1e-4
"""Flow over that through a smooth gap below which it is negligible."""

SYMBOLS = {"slope": "g'", "height": "Sq/h̄", "reynolds_number": "Re", "shortness": "h̄/λ"}


def scale(values: Mapping[str, Any], quantity: str) -> Any:
    """The magnitude of a coefficient, at least ``MIN_FLOW``."""
    return np.maximum(np.abs(values[quantity]), MIN_FLOW)


def columns(scene: RoughGap) -> dict[str, Quantity | str]:
    """The name of the surface, Sq/h̄, g', h̄/λ with λ = 2π Sq/g', and Re."""
    numbers = {
        "height_ratio": scene.rms_height / scene.mean_gap,
        "rms_slope": scene.rms_slope,
        "gap_over_wavelength": scene.gap_over_wavelength,
        "reynolds_number": scene.reynolds_number,
    }
    return {
        "rough_surface": scene.geometry.name,
        **{name: Quantity(value=float(f"{number:.12g}"), unit="1") for name, number in numbers.items()},
    }


def features(given: Columns) -> dict[str, NDArray[Any]]:
    """The numbers g', Sq/h̄, Re and h̄/λ from :func:`columns` of many scenes."""
    return {
        "slope": given["rms_slope"],
        "height": given["height_ratio"],
        "reynolds_number": given["reynolds_number"],
        "shortness": given["gap_over_wavelength"],
    }


def worth(values: Columns) -> NDArray[np.bool_]:
    """Whether each case has flow in both directions."""
    return np.asarray((values["A11"] > MIN_FLOW) & (values["A22"] > MIN_FLOW))


def product_text(powers: Powers) -> str:
    """A product of powers as text, such as ``Re · (g')^2``."""
    return " · ".join(SYMBOLS[name] if power == 1 else f"({SYMBOLS[name]})^{power:g}" for name, power in powers.items())


NUMBERS = {
    "slope": "g'",
    "height": "Sq/h̄",
    "shortness": "h̄/λ",
    "reynolds_number": "Re",
    "roughness_reynolds_number": "Re·g'",
    "waves": "side/λ",
    "least_gap": "h_min/h̄",
}
"""Symbols of the numbers of a rough gap."""

MIN_GAP_RATIO = 1e-3
"""Smallest gap over the mean gap that stands for walls in contact."""


def numbers(scene: RoughGap) -> dict[str, float]:
    """The dimensionless numbers of a rough gap, with λ = 2π Sq/g'; side/λ is 0 for flat walls.

    Sq/h̄ is that of the undeformed walls, or of the gap if a load presses the walls together.
    """
    surface = scene.surface()
    walls = scene.walls(max(surface.shape))
    height = scene.rms_height if scene.load is None else float(walls.gap.std())
    waves = max(surface.size) * scene.rms_slope / (2 * np.pi * scene.rms_height) if scene.rms_height > 0 else 0.0
    return {
        "slope": scene.rms_slope,
        "height": height / scene.mean_gap,
        "shortness": scene.gap_over_wavelength,
        "reynolds_number": scene.reynolds_number,
        "roughness_reynolds_number": scene.reynolds_number * scene.rms_slope,
        "waves": waves,
        "least_gap": max(float(walls.gap.min()) / scene.mean_gap, MIN_GAP_RATIO),
    }


def outside(scene: RoughGap, _model: Any, _result: Result | None) -> tuple[str, ...]:
    """The sentences on a flow by pressure, or by sliding as fast, that is not laminar, and on a gas taken as a liquid.

    The pressure drop is that over the longer side of the period; the pressures under sliding scale with it, too, since
    6ηuL/h̄² = G L.
    """
    sliding = scene.density * scene.sliding_speed * scene.mean_gap / scene.viscosity
    drop = scene.pressure_gradient * max(scene.surface().size)
    return (
        *pressure_turbulence(scene.reynolds_number),
        *shear_turbulence(sliding),
        *leakage_of_gas(scene.density, scene.viscosity, drop, scene.boundary.ambient_pressure),
    )


def omitted(scene: RoughGap, _model: Any, quantity: str) -> Omission | None:
    """The effect of cavitation; None if the film does not rupture."""
    from roughfilm.rom.rough_gap.omission import rupture_omitted  # slow to import

    return rupture_omitted(scene, quantity)


def outside_laws(_scene: RoughGap, result: Result, quantity: str) -> str:
    """The reason for which the laws of friction do not hold where the walls touch; empty if they do."""
    contact = result.quantities.get("contact_area")
    return TOUCHING if quantity == "friction" and contact is not None and contact.value > 0 else ""


KIND = Kind(
    name="rough_gap",
    scene=RoughGap,
    summary="a liquid in a narrow gap between two walls, one or both rough",
    compared={"A11": "flow along x", "A22": "flow along y"},
    others={
        "B1": "flow by sliding along x",
        "B2": "flow by sliding along y",
        "friction": "friction",
        "mean_gap": "mean gap",
        "contact_area": "contact area",
    },
    reported={
        "A11": "flow factor along x (A11)",
        "A22": "flow factor along y (A22)",
        "friction": "friction over that of a smooth gap",
        "flow_per_width_x": "flow per width along x",
        "flow_per_width_y": "flow per width along y",
        "B1": "flow by sliding along x (B1)",
        "B2": "flow by sliding along y (B2)",
        "A12": "flow along x by gradient along y (A12)",
        "A21": "flow along y by gradient along x (A21)",
        "mean_gap": "mean gap",
        "contact_area": "contact area over nominal area",
        "rms_height": "rms height",
        "A11_over_reynolds": "A11 over that without inertia",
        "A22_over_reynolds": "A22 over that without inertia",
    },
    scale=scale,
    columns=columns,
    numbers=numbers,
    symbols=NUMBERS,
    excluded="cavitation, heat and deformation by the pressure of the liquid",
    omitted=omitted,
    outside=outside,
    outside_laws=outside_laws,
    replaces={
        "geometry.surface": lambda surface: (*replaced_by(surface), "amplitude", "wavelength"),
        "flow.pressure_gradient": ("reynolds_number",),
        "flow.reynolds_number": ("pressure_gradient",),
    },
    lists=frozenset({("geometry", "spacing"), ("geometry", "surface", "size"), ("geometry", "surface", "points")}),
    sweeping=Sweeping(
        given={
            "rough_surface": None,
            "height_ratio": None,
            "rms_slope": None,
            "gap_over_wavelength": None,
            "reynolds_number": None,
        },
        quantities=("A11", "A22"),
        features=features,
        worth=worth,
        candidates={
            "Re": {"reynolds_number": 1},
            "Sq/h̄": {"height": 1},
            "g'": {"slope": 1},
            "Re g'": {"reynolds_number": 1, "slope": 1},
            "Re g' Sq/h̄": {"reynolds_number": 1, "slope": 1, "height": 1},
            "h̄/λ": {"shortness": 1},
        },
        fitted=("slope", "height", "reynolds_number"),
        words=product_text,
    ),
)
