"""What a model returns: quantities with units, fields, how it was computed and from what."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.units import Quantity


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
    """What one model says of one scene; which quantities and fields, the kind of scene says."""

    model: str
    quantities: Mapping[str, Quantity]
    fields: Mapping[str, Field]
    numerics: Numerics
    provenance: Mapping[str, Any] = field(repr=False)
