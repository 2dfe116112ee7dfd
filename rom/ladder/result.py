"""The result of a model: quantities with units, fields, numerics and provenance."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.units import Quantity


@dataclass(frozen=True, kw_only=True)
class Field:
    """An array with its unit.

    Examples
    --------
    >>> pressure = Field(values=np.array([0.0, 2e5]), unit="Pa")
    >>> float(pressure.values.max()), pressure.unit
    (200000.0, 'Pa')
    """

    values: NDArray[np.float64]
    unit: str


@dataclass(frozen=True, kw_only=True)
class SolverRun:
    """One run of an iterative solver within a result.

    Attributes
    ----------
    name : the flow or the grid that it solved; "" where there is only one.
    outcome, iterations : how it ended, and after how many iterations.
    recipe : how the solver was set up differently after a run that failed; "" for the usual setup.
    residual : recomputed after the run; None if it was not.
    imbalance : mismatch of the forces on the liquid, relative to the force that drives it; None if it was not computed.
    """

    name: str = ""
    outcome: str = "converged"
    iterations: int
    recipe: str = ""
    residual: float | None = None
    imbalance: float | None = None


@dataclass(frozen=True, kw_only=True)
class Numerics:
    """The numerics of a result.

    ``residual`` is recomputed after the solver claims success; what it measures is the model's ``residual_meaning``.
    ``cpu_s`` counts this process and its children; ``scheme`` is the advection scheme, "" where there is no choice.
    ``runs`` are the runs of the solver in their order, where it reports them; ``details`` are further numbers that
    describe the computation, by name.
    """

    residual: float
    iterations: int
    cpu_s: float
    wall_s: float
    degrees_of_freedom: int
    resolution: int
    tolerance: float
    scheme: str
    processes: int = 1
    runs: tuple[SolverRun, ...] = ()
    details: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Result:
    """The solution of one scene by one model; the kind of scene names its quantities and fields.

    Attributes
    ----------
    provenance : where the result comes from: scene, versions, commit, machine, sources, times.
    warnings : where the model leaves its range or the computation is coarse, one sentence each.
    expected_error : relative error of the model in a quantity by a fitted law; empty where there is no law.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
    >>> result = rf.solve(scene, model="film_slope")
    >>> result["load"].unit, result["load_plus"].unit, result.fields["pressure"].values.shape
    ('Pa', '1', (399,))
    """

    model: str
    quantities: Mapping[str, Quantity]
    fields: Mapping[str, Field]
    numerics: Numerics
    provenance: Mapping[str, Any] = field(repr=False)
    warnings: tuple[str, ...] = ()
    expected_error: Mapping[str, float] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Quantity:
        """The quantity of that name, or per area or width where it is given so; KeyError with the names that there are.

        "load" is ``load``, ``load_per_area`` or ``load_per_width``, whichever the result has.
        """
        for known in (name, f"{name}_per_area", f"{name}_per_width"):
            if known in self.quantities:
                return self.quantities[known]
        raise KeyError(f"{name!r}: is no quantity of this result; it has {', '.join(self.quantities)}")


def with_uncertainties(quantities: Mapping[str, Quantity], uncertainties: Mapping[str, float]) -> dict[str, Quantity]:
    """The quantities with their uncertainties, in their units; one that is missing or not finite is unknown."""
    return {
        name: replace(quantity, uncertainty=uncertainties[name])
        if math.isfinite(uncertainties.get(name, math.inf))
        else quantity
        for name, quantity in quantities.items()
    }
