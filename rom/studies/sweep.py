"""The results of a finished sweep: the quantities of every case by every model."""

from collections.abc import Mapping, Sequence
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

SETTING_COLUMNS = ("case", "kind", "sought", "setting", "model", "scheme", "resolution")
"""The first columns of a table, which name the case and the setting of a row."""

NUMERICS = ("residual", "iterations", "cpu_s", "warnings")
"""The last columns of a table."""


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
    sought : the quantity that every scene asks for by a table of its own, such as the film under a load; empty if the
        scenes do not.
    outside : by setting, the ways in which each case is outside the range of the model; "" where it is inside.
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
    sought: str = ""
    outside: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def features(self) -> dict[str, Array]:
        """The numbers by name that order the errors, shape (cases,); empty where the cases do not have them."""
        judged = kind_of_name(self.kind).sweeping
        if judged is None or not set(judged.given) <= set(self.given):
            return {}
        found = {name: np.asarray(values, dtype=float) for name, values in judged.features(self.given).items()}
        return {} if any(np.isnan(values).all() for values in found.values()) else found


def restricted(sweep: Sweep, mask: NDArray[np.bool_]) -> Sweep:
    """The sweep of the cases in a mask of shape (cases,)."""

    def chosen(table: Mapping[str, Mapping[str, Array]]) -> dict[str, dict[str, Array]]:
        return {setting: {name: one[mask] for name, one in values.items()} for setting, values in table.items()}

    def columns(table: Mapping[str, Array]) -> dict[str, Array]:
        return {setting: values[mask] for setting, values in table.items()}

    names = tuple(name for name, kept in zip(sweep.names, mask, strict=True) if kept)
    return Sweep(
        kind=sweep.kind,
        names=names,
        given={name: values[mask] for name, values in sweep.given.items()},
        found=chosen(sweep.found),
        cpu_s=columns(sweep.cpu_s),
        failures=tuple(failure for failure in sweep.failures if failure[0] in names),
        uncertainty=chosen(sweep.uncertainty),
        expected_error=chosen(sweep.expected_error),
        resolution=columns(sweep.resolution),
        residual=columns(sweep.residual),
        sought=sweep.sought,
        outside={
            setting: tuple(one for one, kept in zip(words, mask, strict=True) if kept)
            for setting, words in sweep.outside.items()
        },
    )


def kind_of_sweep(sweep: Sweep) -> Kind:
    """The kind of the scenes of a sweep, with the quantities that are compared for these scenes."""
    return kind_of_name(sweep.kind).seeking(sweep.sought)


def sweeping(kind: Kind) -> Sweeping:
    """The properties of a kind of scene by which the errors of sweeps are ordered; InputError if it has none."""
    if kind.sweeping is None:
        raise InputError(f"the table holds {kind.name} scenes; there are no numbers that order their errors yet")
    return kind.sweeping


def read_sweep(table: Mapping[str, NDArray[Any]], kind: str) -> Sweep:
    """The sweep in a table that ``roughfilm batch`` wrote; its cases are in the order of the table.

    Parameters
    ----------
    table : columns by name, as ``read_table`` returns them.
    kind : name of the kind of the scenes.

    Raises
    ------
    InputError
        If a column is missing, or no case is solved.
    """
    judged, sought = kind_of_name(kind).sweeping, _sought(table)
    try:
        names = list(dict.fromkeys(str(name) for name in table["case"]))
        settings, outcomes = table["setting"], table["outcome"]
        failed = np.flatnonzero(outcomes != SOLVED)
        failures = tuple((str(table["case"][i]), str(settings[i]), str(outcomes[i])) for i in failed)
        if failed.size == outcomes.size:
            case, setting, reason = failures[0]
            raise InputError(f"no case of the batch is solved; the first is {case} by {setting}: {reason}")
        places = {name: place for place, name in enumerate(names)}
        index = np.array([places[str(name)] for name in table["case"]])
        first = np.unique(index, return_index=True)[1]
        rows = {setting: settings == setting for setting in dict.fromkeys(str(name) for name in settings)}
        inputs, quantities = _inputs(table), quantity_columns(table)
        defaults = {} if judged is None else {name: value for name, value in judged.given.items() if value is not None}
        needed = (*kind_of_name(kind).seeking(sought).compared, *(() if judged is None else judged.quantities))
        lacking = tuple(name for name in dict.fromkeys(needed) if name not in quantities)
        given = {name: _given(table, name, defaults.get(name))[first] for name in (*inputs, *defaults)}

        def column(name: str) -> dict[str, Array]:
            return {setting: _spread(table[name], index, own, len(names)) for setting, own in rows.items()}

        def columns(suffix: str = "") -> dict[str, dict[str, Array]]:
            """The quantities by setting, or their columns with a suffix, which are NaN if the table lacks them."""
            missing = np.full(settings.size, np.nan)
            return {
                setting: {
                    name: _spread(table.get(f"{name}{suffix}", missing), index, own, len(names))
                    for name in (*quantities, *lacking)
                }
                for setting, own in rows.items()
            }

        found, cpu_s, resolution, residual = columns(), column("cpu_s"), column("resolution"), column("residual")
        uncertainty, expected_error = columns("_uncertainty"), columns("_expected_error")
    except (KeyError, IndexError) as error:
        raise InputError(f"the table has no column {error}; make it again with roughfilm batch") from None
    return Sweep(
        kind=kind,
        names=tuple(names),
        given=given,
        found=found,
        cpu_s=cpu_s,
        failures=failures,
        uncertainty=uncertainty,
        expected_error=expected_error,
        resolution=resolution,
        residual=residual,
        sought=sought,
        outside=_outside(table, index, rows, len(names)),
    )


def _outside(
    table: Mapping[str, NDArray[Any]], index: NDArray[np.intp], rows: Mapping[str, NDArray[np.bool_]], count: int
) -> dict[str, tuple[str, ...]]:
    """By setting, the ways in which each case is outside the range of the model, of tables that have them."""
    found = {}
    for setting, own in rows.items() if "outside" in table else ():
        words = dict(zip(index[own].tolist(), map(str, table["outside"][own]), strict=True))
        found[setting] = tuple(words.get(place, "") for place in range(count))
    return found


def _sought(table: Mapping[str, NDArray[Any]]) -> str:
    """The quantity that all scenes of a table ask for; empty if they do not, or ask for several."""
    names = set(map(str, table.get("sought", ())))
    return names.pop() if len(names) == 1 else ""


def quantity_columns(table: Mapping[str, Any]) -> tuple[str, ...]:
    """The names of the quantities in a table, which stand between the outcome and the numerics."""
    names = [*table]
    behind = names[names.index("outcome") + 1 :]
    end = next((place for place, name in enumerate(behind) if name in NUMERICS), len(behind))
    suffixes = ("_uncertainty", "_expected_error")
    return tuple(name for name in behind[:end] if not any(_is_suffixed(name, end, behind) for end in suffixes))


def _is_suffixed(name: str, suffix: str, names: Sequence[str]) -> bool:
    return name.endswith(suffix) and name.removesuffix(suffix) in names


def _inputs(table: Mapping[str, Any]) -> tuple[str, ...]:
    """The names of the inputs of the cases, which stand before the outcome."""
    names = [*table]
    return tuple(name for name in names[: names.index("outcome")] if name not in SETTING_COLUMNS)


def loaded(sweep: Sweep, reference: str) -> NDArray[np.bool_]:
    """The mask of the cases whose compared quantities are large enough to divide by, shape (cases,)."""
    judged, values = kind_of_name(sweep.kind).sweeping, sweep.found[reference]
    if judged is None or any(np.isnan(values[name]).all() for name in judged.quantities if name in values):
        return np.isfinite(sweep.cpu_s[reference])
    return np.asarray(judged.worth(values))


def relative_error(sweep: Sweep, setting: str, reference: str, quantity: str) -> Array:
    """The relative error |q - q_ref| / s of a setting in a quantity, shape (cases,).

    The kind of scene gives the scale s, which is mostly the size of the reference value q_ref. The result is NaN where
    one of the values is missing.
    """
    best = sweep.found[reference]
    scale = kind_of_sweep(sweep).scale(best, quantity)
    return np.asarray(np.abs(sweep.found[setting][quantity] - best[quantity]) / scale)


def _given(table: Mapping[str, NDArray[Any]], name: str, default: float | None) -> NDArray[Any]:
    if default is None or (name in table and np.asarray(table[name]).dtype.kind != "f"):
        return table[name]
    values = table[name] if name in table else np.full(table["case"].size, default)
    return np.where(np.isnan(values), default, values)


def _spread(values: NDArray[Any], index: NDArray[np.int64], rows: NDArray[np.bool_], cases: int) -> Array:
    spread = np.full(cases, np.nan)
    spread[index[rows]] = values[rows]
    return spread
