"""The results of a finished sweep: the quantities of every case by every model."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.ladder.kind import Kind, kind_of_name
from roughfilm.rom.ladder.sweeping import Sweeping

SOLVED = "solved"
"""The outcome of a row that holds numbers; any other outcome is the reason for a missing result."""


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """The cases of a sweep with their inputs and results.

    A setting is the name of a model with the resolution and the scheme that the study chooses, such as
    navier_stokes-240-upwind.

    Attributes
    ----------
    kind : name of the kind of the scenes.
    names : names of the cases.
    given : inputs of the cases by name, shape (cases,).
    found : computed quantities by setting and name, shape (cases,); NaN without a result.
    uncertainty : numerical uncertainties, as ``found``; NaN where unknown.
    expected_error : relative errors by the fitted laws, as ``found``; NaN where unknown.
    resolution, residual : resolution and residual by setting, shape (cases,); NaN without a result.
    cpu_s : CPU time by setting, s, shape (cases,); NaN without a result.
    failures : case, setting and reason of each missing result.
    """

    kind: str
    names: tuple[str, ...]
    given: Mapping[str, NDArray[Any]]
    found: Mapping[str, Mapping[str, Array]]
    cpu_s: Mapping[str, Array]
    failures: tuple[tuple[str, str, str], ...]
    uncertainty: Mapping[str, Mapping[str, Array]] = field(default_factory=dict)
    expected_error: Mapping[str, Mapping[str, Array]] = field(default_factory=dict)
    resolution: Mapping[str, Array] = field(default_factory=dict)
    residual: Mapping[str, Array] = field(default_factory=dict)

    def features(self) -> dict[str, Array]:
        """The numbers by name that order the errors, shape (cases,)."""
        return {
            name: np.asarray(values, dtype=float)
            for name, values in sweeping(kind_of_name(self.kind)).features(self.given).items()
        }


def sweeping(kind: Kind) -> Sweeping:
    """The properties of a kind of scene that sweeps need; InputError if it has none."""
    if kind.sweeping is None:
        raise InputError(f"the table holds {kind.name} scenes; there is no report over many of them yet")
    return kind.sweeping


def read_sweep(table: Mapping[str, NDArray[Any]], kind: str) -> Sweep:
    """The sweep in a table that ``roughfilm batch`` wrote.

    Parameters
    ----------
    table : columns by name, as ``read_table`` returns them.
    kind : name of the kind of the scenes.

    Raises
    ------
    InputError
        If a column is missing, or the kind of scene has no properties for sweeps.
    """
    judged = sweeping(kind_of_name(kind))
    try:
        cases, first, index = np.unique(table["case"], return_index=True, return_inverse=True)
        settings = table["setting"]
        given = {name: _given(table, name, default)[first] for name, default in judged.given.items()}
        rows = {setting: settings == setting for setting in dict.fromkeys(str(name) for name in settings)}

        def column(name: str) -> dict[str, Array]:
            return {setting: _spread(table[name], index, own, cases.size) for setting, own in rows.items()}

        def columns(suffix: str = "") -> dict[str, dict[str, Array]]:
            """The quantities by setting, or their columns with a suffix, which are NaN if the table lacks them."""
            missing = np.full(settings.size, np.nan)
            return {
                setting: {
                    name: _spread(
                        table.get(f"{name}{suffix}", missing) if suffix else table[name], index, own, cases.size
                    )
                    for name in judged.quantities
                }
                for setting, own in rows.items()
            }

        found, cpu_s, resolution, residual = columns(), column("cpu_s"), column("resolution"), column("residual")
        uncertainty, expected_error = columns("_uncertainty"), columns("_expected_error")
        failed = np.flatnonzero(table["outcome"] != SOLVED)
        failures = tuple((str(table["case"][i]), str(settings[i]), str(table["outcome"][i])) for i in failed)
    except (KeyError, IndexError) as error:
        raise InputError(f"the table has no column {error}; make it again with roughfilm batch") from None
    return Sweep(
        kind=kind,
        names=tuple(str(case) for case in cases),
        given=given,
        found=found,
        cpu_s=cpu_s,
        failures=failures,
        uncertainty=uncertainty,
        expected_error=expected_error,
        resolution=resolution,
        residual=residual,
    )


def loaded(sweep: Sweep, reference: str) -> NDArray[np.bool_]:
    """The mask of the cases whose compared quantities are large enough to divide by, shape (cases,)."""
    return np.asarray(sweeping(kind_of_name(sweep.kind)).worth(sweep.found[reference]))


def relative_error(sweep: Sweep, setting: str, reference: str, quantity: str) -> Array:
    """The relative error |q - q_ref| / s of a setting in a quantity, shape (cases,).

    The kind of scene gives the scale s, which is mostly the size of the reference value q_ref. The result is NaN where
    one of the values is missing.
    """
    best = sweep.found[reference]
    scale = kind_of_name(sweep.kind).scale(best, quantity)
    return np.asarray(np.abs(sweep.found[setting][quantity] - best[quantity]) / scale)


def _given(table: Mapping[str, NDArray[Any]], name: str, default: float | None) -> NDArray[Any]:
    if default is None:
        return table[name]
    values = table[name] if name in table else np.full(table["case"].size, default)
    return np.where(np.isnan(values), default, values)


def _spread(values: NDArray[Any], index: NDArray[np.int64], rows: NDArray[np.bool_], cases: int) -> Array:
    spread = np.full(cases, np.nan)
    spread[index[rows]] = values[rows]
    return spread
