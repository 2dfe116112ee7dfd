"""The scenes of published tables with a lubricant that heats and keeps its viscosity, by models with temperature.

Heat does not change such a film: each quantity of the isothermal model, with its uncertainty, and each of its fields
must be the same to the last bit.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.ladder import find
from roughfilm.rom.bearing.dynamics.point import DynamicPoint
from roughfilm.rom.bearing.dynamics.sweep import MIN_CELLS, dynamics
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.validation import journal
from roughfilm.validation.reading import published
from roughfilm.validation.sources import lund_thomsen

MODELS = ("heat_balance", "adiabatic")
"""The models with temperature whose isoviscous limit is the isothermal film."""

HEATED = {
    "temperature": "40 degC",
    "density": "860 kg/m^3",
    "heat_capacity": "20000 J/(kg*K)",
    "thermoviscosity": {"law": "exponential", "temperature_coefficient": "0 1/K"},
}
"""Entries of a lubricant that heats and whose viscosity has no slope over the temperature.

Its heat capacity is ten times that of oil, so that the thinnest films of the tables heat by less than 500 K.
"""


@dataclass(frozen=True, kw_only=True)
class TableRow:
    """The bearing of one row of a table.

    Attributes
    ----------
    source : name of the table.
    case : the row, in words.
    entries : the scene, without temperature.
    isothermal : name of the isothermal model.
    pressure : load over the nominal area, Pa, at which the table has stiffness and damping; None where it has none.
    """

    source: str
    case: str
    entries: dict[str, Any]
    isothermal: str
    pressure: float | None = None


def table_rows() -> Iterator[TableRow]:
    """The rows of all tables of journal bearings whose scenes models with temperature take.

    The squeezed journals of negative eccentricity are left out: their film begins at the narrowest place, which no
    scene describes.
    """
    for name, motion in (
        ("butenschoen", journal.TURNING),
        ("raimondi_boyd", journal.TURNING),
        ("squeeze_butenschoen", journal.APPROACHING),
    ):
        for line in published(name):
            eccentricity, width = float(line["eccentricity_ratio [1]"]), float(line["width_over_diameter [1]"])
            if eccentricity >= 0:
                yield TableRow(
                    source=name,
                    case=f"ε = {eccentricity:g}, B/D = {width:.3g}",
                    entries=journal.entries(eccentricity, width, motion),
                    isothermal="reynolds_incompressible",
                )
    for line in published("lund_thomsen"):
        bore, number = line["bore"], float(line["S [1]"])
        yield TableRow(
            source="lund_thomsen",
            case=f"{bore}, S = {number:g}",
            entries=lund_thomsen.entries(number, lund_thomsen.PRELOADS[bore]),
            isothermal="reynolds_cavitating",
            pressure=lund_thomsen.mean_pressure(number),
        )


@dataclass(frozen=True, kw_only=True)
class IsoviscousLimit:
    """The film of a model with temperature beside the isothermal one.

    Attributes
    ----------
    compared : number of quantities and fields, each quantity with its uncertainty.
    changed : names of those that differ in a bit.
    reason : why there is no film with a temperature; "" where there is one.
    """

    compared: int = 0
    changed: tuple[str, ...] = ()
    reason: str = ""


def isoviscous_limits(row: TableRow, cells: int) -> dict[str, IsoviscousLimit]:
    """The films of a row with a lubricant that heats, by the names of the models, on so many cells along and across.

    ``dynamics`` is added where the table has stiffness and damping, on at least as many cells as it takes.
    """
    request = Request(resolution=cells)
    cold, heated = read_scene(row.entries), read_scene(row.entries | {"lubricant": row.entries["lubricant"] | HEATED})
    plain = find("bearing", row.isothermal).solve(cold, request)
    limits = {}
    for model in MODELS:
        try:
            hot = find("bearing", model).solve(heated, request)
        except (ConvergenceError, InputError) as error:
            limits[model] = IsoviscousLimit(reason=str(error))
            continue
        changed = [name for name, one in plain.quantities.items() if hot.quantities[name] != one]
        changed += [name for name, one in plain.fields.items() if not _same(hot.fields[name].values, one.values)]
        limits[model] = IsoviscousLimit(compared=len(plain.quantities) + len(plain.fields), changed=tuple(changed))
    if row.pressure is not None:
        size = max(cells, MIN_CELLS)
        one, other = (_point(scene, row.pressure, size) for scene in (cold, heated))
        moved = [
            name
            for name, value in one.numbers.items()
            if (other.numbers[name], other.uncertainty[name]) != (value, one.uncertainty[name])
        ]
        limits["dynamics"] = IsoviscousLimit(compared=len(one.numbers), changed=tuple(moved))
    return limits


def _point(scene: Scene, pressure: float, cells: int) -> DynamicPoint:
    """Equilibrium, stiffness and damping of a bearing at its speed."""
    assert isinstance(scene, Bearing)
    (curve,) = dynamics(scene, [scene.motion.speed], [pressure], resolution=cells)
    return curve.points[0]


def _same(one: Any, other: Any) -> bool:
    return np.array_equal(one, other, equal_nan=True)
