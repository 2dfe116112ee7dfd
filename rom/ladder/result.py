"""The result of a model: quantities with units, fields, numerics and provenance."""

import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import OVERFLOW_REMEDY
from roughfilm.contact.foundation.brief import brief
from roughfilm.contact.foundation.errors import ConvergenceError, UnavailableError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.ladder.gridded import gridded

if TYPE_CHECKING:
    import xarray

SHOWN = 6
"""Number of quantities that the short text of a result shows."""

WIDTH = 100
"""Length at which a line of this text is cut."""

NO_COARSER_GRID = "there is no coarser grid, so the discretisation error is unknown"
"""The warning of a result without uncertainty."""


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

    __repr__ = brief


@dataclass(frozen=True, kw_only=True)
class SolverRun:
    """A run of an iterative solver that contributed to a result.

    Attributes
    ----------
    name : the flow or the grid that it solved; "" where there is only one.
    outcome : how the run ended, in words.
    iterations : number of iterations.
    recipe : changes of the setup after a run that failed, in words; "" for the usual setup.
    residual : residual recomputed after the run; None if it was not recomputed.
    imbalance : imbalance of the forces on the liquid over the force that drives it; None if it was not computed.
    """

    name: str = ""
    outcome: str = "converged"
    iterations: int
    recipe: str = ""
    residual: float | None = None
    imbalance: float | None = None


BOUND = "bound_of_"
"""Beginning of the name of a detail that bounds the error of the model in the quantity with the rest of the name."""


@dataclass(frozen=True, kw_only=True)
class Numerics:
    """The numerics of a result: accuracy, cost and options of the computation.

    Attributes
    ----------
    residual : residual recomputed after the solver has converged, in the sense of the model's ``residual_meaning``.
    iterations : number of iterations.
    cpu_s : CPU time of the solution, s, of this process and its children, without one-time costs.
    wall_s : wall-clock time from the start to the end of the model, s, with the one-time costs in it.
    degrees_of_freedom : number of unknowns.
    resolution : number of cells, points or nodes that the model's ``resolution_meaning`` names.
    tolerance : residual at which the solver stops.
    scheme : advection scheme; "" for a model that offers no choice.
    processes : number of processes.
    runs : the runs of the solver in their order; empty if the model does not report them.
    details : further numbers that describe the computation, by name.
    one_time : CPU time of work that later runs do not repeat, s, by name: "table" of the surface, "compilation",
        "surface" (read or made), "start" (imports, compiled loops and source code that are read), and "errors" (films
        that show the expected errors).
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
    one_time: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class Result:
    """The solution of one scene by one model; the kind of scene names its quantities and fields.

    Attributes
    ----------
    model : name of the model.
    quantities : numbers with units, by name.
    fields : arrays with units, by name.
    numerics : accuracy, cost and options of the computation.
    provenance : scene, versions, commit, machine, sources and time, from which the result can be computed again.
    warnings : one sentence for each way in which the computation is coarse, or its result needs care.
    outside : one sentence for each way in which the scene or its solution is outside the range of the model, with the
        number and its limit. The error of the model is then unknown, and no tolerance is met.
    expected_error : relative error of the model in a quantity by a fitted law, by quantity; empty without a law, and
        outside the range of the model.

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
    outside: tuple[str, ...] = ()
    expected_error: Mapping[str, float] = field(default_factory=dict)

    def __repr__(self) -> str:
        """The main quantities with unit and uncertainty, the fields, the cost and the warnings, in about ten lines."""
        scene = self.provenance.get("scene", {})
        lines = [f"Result of {self.model} on {scene.get('name', 'a scene')!r} ({scene.get('kind', 'of unknown kind')})"]
        shown, width = list(self.quantities)[:SHOWN], max(map(len, self.quantities), default=0)
        for name in shown:
            error = self.expected_error.get(name)
            of_model = "" if error is None else f"  (error of the model: at most {100 * error:.2g} %)"
            lines.append(f"  {name:<{width}}  {self.quantities[name]}{of_model}")
        if others := len(self.quantities) - len(shown):
            lines.append(f"  and {others} more in .quantities")
        shapes = {name: "×".join(map(str, one.values.shape)) for name, one in self.fields.items()}
        lines.append(f"fields: {', '.join(f'{name} {shape}' for name, shape in shapes.items()) or 'none'}")
        lines.append(
            f"cost: {self.numerics.cpu_s:.2g} s CPU, {self.numerics.degrees_of_freedom} unknowns, "
            f"resolution {self.numerics.resolution}, residual {self.numerics.residual:.1e}"
        )
        first = f": {self.warnings[0]}" if self.warnings else ""
        lines.append(f"warnings: {len(self.warnings)}{first}")
        lines += [f"outside the range of the model: {reason}" for reason in self.outside]
        return "\n".join(line if len(line) <= WIDTH else f"{line[: WIDTH - 3]}..." for line in lines)

    def __getitem__(self, name: str) -> Quantity:
        """The quantity with a name, or with that name and ``_per_area`` or ``_per_width``.

        For example, "load" gives the first of ``load``, ``load_per_area`` and ``load_per_width`` that the result has.

        Raises
        ------
        KeyError
            If the result has none of these; the message lists the names that it has.
        """
        for known in (name, f"{name}_per_area", f"{name}_per_width"):
            if known in self.quantities:
                return self.quantities[known]
        raise KeyError(f"{name!r}: is no quantity of this result; it has {', '.join(self.quantities)}")

    def to_xarray(self) -> "xarray.Dataset":
        """The result as a dataset of xarray, an optional library.

        Fields and quantities are variables with the attribute ``units``. Quantities have no dimension, and the
        attributes ``uncertainty`` (95 % half width, in the unit) and ``expected_error`` (of the model, over the size of
        the quantity) where these are known. Positions are coordinates: ``position`` along a wall, ``x`` and ``y`` of a
        grid, ``cell_x``, ``cell_y`` and ``cell_z`` of the centres of cells. The attributes ``model``, ``warnings``,
        ``outside``, ``numerics`` and ``provenance`` of the dataset are texts, the last two as JSON; ``to_netcdf``
        writes them all.

        Raises
        ------
        UnavailableError
            If xarray is not installed.
        """
        try:
            import xarray
        except ImportError:
            raise UnavailableError("xarray: not installed; install it with: pip install 'roughfilm[data]'") from None
        fields, coordinates = gridded({name: (one.values, one.unit) for name, one in self.fields.items()})
        numbers = {}
        for name, one in self.quantities.items():
            known = {"uncertainty": one.uncertainty, "expected_error": self.expected_error.get(name)}
            attributes = {"units": one.unit, **{key: value for key, value in known.items() if value is not None}}
            numbers[name if name not in fields else f"{name}_quantity"] = ((), one.value, attributes)
        return xarray.Dataset(
            {**fields, **numbers},
            coordinates,
            {
                "model": self.model,
                "warnings": "; ".join(self.warnings),
                "outside": "; ".join(self.outside),
                "numerics": json.dumps(asdict(self.numerics), default=np.generic.item),
                "provenance": json.dumps(dict(self.provenance), default=np.generic.item),
            },
        )


def with_uncertainties(quantities: Mapping[str, Quantity], uncertainties: Mapping[str, float]) -> dict[str, Quantity]:
    """The quantities with uncertainties in their units; uncertainties that are not finite are left out.

    One that a quantity has already, by its round-off, remains if it is larger, unless the uncertainty is unknown.
    """
    return {
        name: replace(quantity, uncertainty=max(uncertainties[name], quantity.uncertainty or 0.0))
        if math.isfinite(uncertainties.get(name, math.inf))
        else replace(quantity, uncertainty=None)
        for name, quantity in quantities.items()
    }


def beyond_round_off(quantity: Quantity, rounding: float) -> Quantity:
    """The quantity, or 0 ± its round-off, in its unit, if it is not larger than that."""
    if abs(quantity.value) > rounding:
        return quantity
    return Quantity(value=0.0, unit=quantity.unit, uncertainty=max(rounding, quantity.uncertainty or 0.0))


def with_finite_numbers(result: Result) -> Result:
    """The result without the uncertainties, expected errors and details that are not finite: those are unknown.

    Raises
    ------
    ConvergenceError
        If a quantity, the residual or a field is not finite.
    """

    def refuse(what: str) -> None:
        raise ConvergenceError(f"{result.model}: {what} is not a finite number; {OVERFLOW_REMEDY}")

    for name, quantity in result.quantities.items():
        if not math.isfinite(quantity.value):
            refuse(name)
    if not math.isfinite(result.numerics.residual):
        refuse("the residual")
    for name, one in result.fields.items():
        if not np.isfinite(one.values).all():
            refuse(f"the field {name}")
    uncertainties = {name: one.uncertainty for name, one in result.quantities.items() if one.uncertainty is not None}
    bare = {name: replace(one, uncertainty=None) for name, one in result.quantities.items()}
    return replace(
        result,
        quantities=with_uncertainties(bare, uncertainties),
        expected_error=_finite(result.expected_error),
        numerics=replace(
            result.numerics,
            details=_finite(result.numerics.details),
            runs=tuple(_with_known_numbers(run) for run in result.numerics.runs),
        ),
    )


def _finite(numbers: Mapping[str, float]) -> dict[str, float]:
    return {name: number for name, number in numbers.items() if math.isfinite(number)}


def _with_known_numbers(run: SolverRun) -> SolverRun:
    known = _finite({name: getattr(run, name) for name in ("residual", "imbalance") if getattr(run, name) is not None})
    return replace(run, residual=known.get("residual"), imbalance=known.get("imbalance"))
