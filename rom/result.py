"""What a model returns: quantities with units, fields, how it was computed and from what."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact.units import Quantity
from rom.scene import Scene


@dataclass(frozen=True, kw_only=True)
class Field:
    """An array with its unit."""

    values: NDArray[np.float64]
    unit: str


@dataclass(frozen=True, kw_only=True)
class Numerics:
    """How a result was computed.

    ``residual`` is recomputed after the solver claims success; what it measures is the model's ``residual_meaning``.
    ``cpu_s`` counts this process and its children; ``scheme`` is the advection scheme, "" where there is no choice.
    """

    residual: float
    iterations: int
    cpu_s: float
    wall_s: float
    degrees_of_freedom: int
    resolution: int
    tolerance: float
    scheme: str


@dataclass(frozen=True, kw_only=True)
class Result:
    """What one model says of one scene.

    ``fields`` of a pocket scene, all along the sliding (upper) wall: ``position``, ``film_thickness`` (m), ``pressure``
    and ``shear_stress`` (Pa). Models that resolve the film add ``vertices`` (nx+1, ny+1, 2), ``cell_velocity``
    (nx, ny, 2) and ``cell_pressure`` (nx, ny).
    """

    model: str
    quantities: Mapping[str, Quantity]
    fields: Mapping[str, Field]
    numerics: Numerics
    provenance: Mapping[str, Any] = field(repr=False)


def pocket_quantities(
    scene: Scene, *, load: float, friction: float, pressure_max: float, pressure_min: float, backflow: float
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
