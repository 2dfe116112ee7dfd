"""The page of flow factors."""

import math
from collections.abc import Mapping, Sequence
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
    entries: Mapping[str, Any],
    points: Sequence[Mapping[str, Any]],
    rough: HeightMap,
    path: Path,
    gap: Array,
    factors: Estimated,
    table: FactorTable | None,
) -> None:
    """Write the page of a table of flow factors, or of those at one mean gap.

    Parameters
    ----------
    entries, points : the object of ``--json``, and its points.
    gap, factors : the gap whose flow is drawn, m, and its flow factors.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    pressed = table is not None and any(point.load for point in table.points)
    render(
        "factors.html.j2",
        path,
        name=name,
        entries=entries,
        columns=COLUMNS,
        rows=[_row(point, pressed=pressed) for point in points],
        one=None if table is not None else entries["quantities"],
        shown={"mean_gap": factors.factors.mean_gap, "contact": factors.contact, "sealed": factors.factors.sealed},
        maps=factors_figures.maps(gap, rough.spacing, factors.correctors, factors.factors.sealed),
        sq=float(rough.heights.std()),
        curves=None if table is None else factors_figures.curves(table),
        pressed=factors_figures.pressures(AsperityTable(factors=table)) if table is not None and pressed else None,
    )


def _row(point: Mapping[str, Any], *, pressed: bool) -> list[str]:
    sealed = " ".join(axis for axis in "xy" if point[f"sealed_{axis}"])
    cells = [_cell(point[name]) for name in COLUMNS]
    loaded = [f"{1e6 * point['separation']:.4g}", f"{point['load'] / 1e6:.4g}"] if pressed else []
    return [*loaded, f"{1e6 * point['mean_gap']:.4g}", f"{100 * point['contact']:.3g}", *cells, sealed]


def _cell(entry: Mapping[str, float | None]) -> str:
    value, uncertainty = entry["value"], entry["uncertainty"]
    assert value is not None
    return with_error(value, math.inf if uncertainty is None else uncertainty)
