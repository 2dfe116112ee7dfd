"""A finished sweep: what every model says of every case, side by side."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact.errors import InputError
from rom.comparison import LEAST_LOAD
from rom.gap import Array

SOLVED = "solved"
"""The outcome of a row that holds numbers; any other says why it does not."""

QUANTITIES = (
    "load_plus",
    "friction_plus",
    "pressure_max_plus",
    "pressure_min_plus",
    "backflow",
)


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """Cases, what they were given, shape (cases,), and what was found by setting and quantity, NaN for nothing.

    ``given`` holds ``profile`` (texts), ``width_plus`` = w/Lx, ``depth_plus`` = d/Ly, ``shift_plus`` = xd/w,
    ``reynolds_number`` and ``film_plus`` = Ly/Lx. A setting is a model's name and
    what the study chose for it: navier_stokes-240-upwind.
    """

    names: tuple[str, ...]
    given: Mapping[str, NDArray[Any]]
    found: Mapping[str, Mapping[str, Array]]
    cpu_s: Mapping[str, Array]
    failures: tuple[tuple[str, str, str], ...]

    def features(self) -> dict[str, Array]:
        """The numbers of a scene by which errors are ordered: Re, d/Ly, and the slope 2d/w of the steeper side."""
        width, depth = self.given["width_plus"] / self.given["film_plus"], self.given["depth_plus"]
        return {
            "reynolds_number": np.asarray(self.given["reynolds_number"], dtype=float),
            "depth": np.asarray(depth, dtype=float),
            "slope": np.asarray(depth / (width * (0.5 - np.abs(self.given["shift_plus"]))), dtype=float),
        }


def read_sweep(table: Mapping[str, NDArray[Any]]) -> Sweep:
    """The sweep in a table of ``roughfilm batch``; InputError if columns are missing."""
    try:
        cases, first, index = np.unique(table["case"], return_index=True, return_inverse=True)
        settings = table["setting"]
        names = ("profile", "width_plus", "depth_plus", "reynolds_number", "film_plus")
        given = {name: table[name][first] for name in names}
        shift = table["shift_plus"][first] if "shift_plus" in table else np.zeros(cases.size)
        given["shift_plus"] = np.nan_to_num(shift)
        found, cpu_s = {}, {}
        for setting in dict.fromkeys(str(name) for name in settings):
            rows = settings == setting
            found[setting] = {name: _spread(table[name], index, rows, cases.size) for name in QUANTITIES}
            cpu_s[setting] = _spread(table["cpu_s"], index, rows, cases.size)
        failed = np.flatnonzero(table["outcome"] != SOLVED)
        failures = tuple((str(table["case"][i]), str(settings[i]), str(table["outcome"][i])) for i in failed)
    except (KeyError, IndexError) as error:
        raise InputError(f"the table has no column {error}; make it again with roughfilm batch") from None
    return Sweep(
        names=tuple(str(case) for case in cases),
        given=given,
        found=found,
        cpu_s=cpu_s,
        failures=failures,
    )


def relative_error(sweep: Sweep, setting: str, reference: str, quantity: str) -> Array:
    """|difference to the reference| / its size, or / the greatest pressure where there is hardly any load; (cases,)."""
    best = sweep.found[reference]
    size = np.abs(best[quantity])
    if quantity == "load_plus":
        pressure = np.maximum(np.abs(best["pressure_max_plus"]), np.abs(best["pressure_min_plus"]))
        size = np.where(size > LEAST_LOAD * pressure, size, pressure)
    return np.asarray(np.abs(sweep.found[setting][quantity] - best[quantity]) / size)


def _spread(values: NDArray[Any], index: NDArray[np.int64], rows: NDArray[np.bool_], cases: int) -> Array:
    spread = np.full(cases, np.nan)
    spread[index[rows]] = values[rows]
    return spread
