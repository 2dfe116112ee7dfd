"""The page of flow factors."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.read import HeightMap
from roughfilm.figures import factors as factors_figures
from roughfilm.pages.render import render
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.homogenization.flow_factors import Estimated
from roughfilm.rom.homogenization.table.factor_table import FactorTable
from roughfilm.words.numbers import with_error

COLUMNS = ("A11", "A12", "A22", "B1", "B2", "d", "e")


def write_page(
    name: str,
    told: Mapping[str, Any],
    rough: HeightMap,
    path: Path,
    gap: Array,
    found: Estimated,
    table: FactorTable | None,
) -> None:
    """Write the page of what ``--json`` told: of a table, or of one gap; ``found`` is what the gap that it draws has.

    Raises InputError if the file cannot be written.
    """
    pressed = table is not None and any(point.load for point in table.points)
    render(
        "factors.html.j2",
        path,
        name=name,
        told=told,
        columns=COLUMNS,
        rows=[_row(point, pressed=pressed) for point in told.get("points", [_flat(told)])],
        one=None if table is not None else told["quantities"],
        shown={"mean_gap": found.factors.mean_gap, "contact": found.contact, "sealed": found.factors.sealed},
        maps=factors_figures.maps(gap, rough.spacing, found.correctors, found.factors.sealed),
        sq=float(rough.heights.std()),
        curves=None if table is None else factors_figures.curves(table),
        pressed=factors_figures.pressures(AsperityTable(factors=table)) if table is not None and pressed else None,
    )


def _flat(told: Mapping[str, Any]) -> dict[str, Any]:
    return {key: entry if "uncertainty" in entry else entry["value"] for key, entry in told["quantities"].items()}


def _row(point: Mapping[str, Any], *, pressed: bool) -> list[str]:
    shut = " ".join(axis for axis in "xy" if point[f"sealed_{axis}"])
    cells = [_cell(point[name]) for name in COLUMNS]
    under = [f"{1e6 * point['separation']:.4g}", f"{point['load'] / 1e6:.4g}"] if pressed else []
    return [*under, f"{1e6 * point['mean_gap']:.4g}", f"{100 * point['contact']:.3g}", *cells, shut]


def _cell(entry: Mapping[str, float | None]) -> str:
    value, doubt = entry["value"], entry["uncertainty"]
    assert value is not None
    return with_error(value, math.inf if doubt is None else doubt)
