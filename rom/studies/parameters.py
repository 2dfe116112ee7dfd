"""The entries that vary in a sweep, in the units in which the study file gives them."""

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.units import is_unit, to_si
from roughfilm.rom.studies.table import Column

_WRITTEN = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,3})?)\s*(.*?)\s*")

LOG_DECADES = 1.5
"""Decades of values from which on an axis may be logarithmic."""

LOG_EVENNESS = 3.0
"""Largest ratio of the widest to the narrowest step of values that count as even in the logarithm."""

ABSENT = "-"
"""The text of an entry that a case does not have."""


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """An entry that varies in a sweep.

    Attributes
    ----------
    name : short name of the entry.
    values : its value in every case, shape (cases,): numbers in ``unit``, NaN where a case has none, or texts.
    unit : unit as the study file gives it, such as "µm" or "× film"; "" for a number without unit and for texts.
    along : names of the entries that vary together with this one.
    """

    name: str
    values: NDArray[Any]
    unit: str
    along: tuple[str, ...] = ()

    @property
    def numeric(self) -> bool:
        """Whether the values are numbers."""
        return self.values.dtype.kind == "f"

    @property
    def label(self) -> str:
        """The name with its unit, for an axis."""
        more = f" (with {', '.join(self.along)})" if self.along else ""
        name = f"{self.name}{more}".replace("_", " ")
        return f"{name}, {self.unit}" if self.unit else name

    @property
    def distinct(self) -> list[Any]:
        """The different values: numbers in ascending order, texts in the order of the cases."""
        if self.numeric:
            return [float(value) for value in np.unique(self.values[~np.isnan(self.values)])]
        return list(dict.fromkeys(map(str, self.values)))

    @property
    def logarithmic(self) -> bool:
        """Whether the values span more than ``LOG_DECADES`` decades in steps that are even in the logarithm."""
        if not self.numeric or not self.distinct or self.distinct[0] <= 0:
            return False
        powers = np.log10(self.distinct)
        if np.ptp(powers) <= LOG_DECADES:
            return False
        steps = np.diff(powers)
        return bool(steps.max() <= LOG_EVENNESS * steps.min())

    def text(self, case: int) -> str:
        """The value in a case with its unit."""
        return self.text_of(self.values[case])

    def text_of(self, value: Any) -> str:
        """A value with its unit."""
        if not self.numeric:
            return str(value)
        return ABSENT if np.isnan(value) else f"{value:.6g} {self.unit}".strip()

    def codes(self) -> NDArray[np.int64]:
        """The number of the different value of every case, shape (cases,)."""
        texts = [ABSENT if self.numeric and np.isnan(value) else str(value) for value in self.values]
        places = {text: place for place, text in enumerate(dict.fromkeys(texts))}
        return np.array([places[text] for text in texts])


def parameters(
    varied: Mapping[str, Sequence[Any]], table: Mapping[str, Column] | None = None, rows: Sequence[int] = ()
) -> tuple[Parameter, ...]:
    """The entries of a sweep that take more than one value, in the order of the study.

    Entries that vary together, so that one fixes the other, are one parameter with the name of the first numeric one.

    Parameters
    ----------
    varied : the values by name in every case as the study file contains them; None where a case has none.
    table : columns of the batch in SI units, for values in different units.
    rows : row of the table of every case.
    """
    found = []
    for name, written in varied.items():
        column = (table or {}).get(name)
        si = None if column is None or not rows else [column.values[row] for row in rows]
        one = _parameter(name, written, si, "" if column is None else column.unit)
        if len(set(one.codes())) > 1:
            found.append(one)
    return _merged(found)


def _merged(found: Sequence[Parameter]) -> tuple[Parameter, ...]:
    groups: dict[tuple[int, ...], list[Parameter]] = {}
    for one in found:
        groups.setdefault(tuple(one.codes()), []).append(one)
    merged = []
    for group in groups.values():
        first = next((one for one in group if one.numeric and not np.isnan(one.values).any()), group[0])
        others = tuple(one.name for one in group if one is not first)
        merged.append(Parameter(name=first.name, values=first.values, unit=first.unit, along=others))
    return tuple(merged)


def _parameter(name: str, written: Sequence[Any], si: Sequence[Any] | None, base: str) -> Parameter:
    parts = [_parts(value) for value in written]
    units = {unit for number, unit in filter(None, parts) if not np.isnan(number)}
    if all(part is not None for part in parts):
        numbers = [number for number, _ in filter(None, parts)]
        if len(units) == 1:
            return Parameter(name=name, values=np.array(numbers), unit=_shown(units.pop()))
        first = next((unit for number, unit in filter(None, parts) if not np.isnan(number)), "")
        if si is not None and base not in ("", "1") and all(not isinstance(value, str) for value in si):
            unit = first if is_unit(first) and not first.startswith("×") else base
            try:
                return Parameter(
                    name=name, values=np.array(si, dtype=float) / to_si(f"1 {unit}", base), unit=_shown(unit)
                )
            except ValueError:
                return Parameter(name=name, values=np.array(si, dtype=float), unit=base)
    return Parameter(name=name, values=np.array([_text(value) for value in written], dtype=str), unit="")


def _shown(unit: str) -> str:
    """A unit with "µ" for micro, or "× film" for a multiple of another entry."""
    return re.sub(r"\bu(?=[a-zA-Z])", "µ", unit) if not unit or is_unit(unit) else f"× {unit}"


def _parts(value: Any) -> tuple[float, str] | None:
    """The number and unit of a value; NaN for None; None for a text or a table."""
    if value is None:
        return np.nan, ""
    if isinstance(value, bool):
        return None
    if isinstance(value, int | float):
        return float(value), ""
    match = _WRITTEN.fullmatch(value) if isinstance(value, str) else None
    return None if match is None else (float(match[1]), match[2])


def _text(value: Any) -> str:
    if value is None:
        return ABSENT
    return value if isinstance(value, str) else json.dumps(value)
