"""The page of flow factors."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rom.homogenization.conductance import FaceRule
from rom.homogenization.flow_factors import Estimated, flow_factors
from rom.homogenization.separation import Separations
from rom.homogenization.table import FactorTable
from scripts import factors_figures
from scripts.pages import render
from scripts.rough_surface import Rough

SHOWN_CONTACT = 0.2
"""The flow is drawn at the point of a table whose contact is nearest to this."""

COLUMNS = ("A11", "A12", "A22", "B1", "B2", "d", "e")


def write_page(
    name: str,
    told: Mapping[str, Any],
    rough: Rough,
    path: Path,
    rule: FaceRule,
    *,
    table: FactorTable | None = None,
    found: Estimated | None = None,
    separation: float = 0.0,
) -> None:
    """Write the page of what ``--json`` told: of a table, or of one gap that was ``found`` at a separation, m.

    Raises InputError if the file cannot be written.
    """
    body = Separations(heights=rough.heights)
    if table is not None:
        shown = min(table.points, key=lambda point: (any(point.factors.sealed), abs(point.contact - SHOWN_CONTACT)))
        separation = shown.separation
        found = flow_factors(body.gap(separation), rough.spacing, rule=rule)
    assert found is not None
    render(
        "factors.html.j2",
        path,
        name=name,
        told=told,
        columns=COLUMNS,
        rows=[_row(point) for point in told.get("points", [_flat(told)])],
        one=None if table is not None else told["quantities"],
        shown={"mean_gap": found.factors.mean_gap, "contact": found.contact, "sealed": found.factors.sealed},
        maps=factors_figures.maps(body.gap(separation), rough.spacing, found.correctors, found.factors.sealed),
        sq=body.rms,
        curves=None if table is None else factors_figures.curves(table),
    )


def _flat(told: Mapping[str, Any]) -> dict[str, Any]:
    return {key: entry if "uncertainty" in entry else entry["value"] for key, entry in told["quantities"].items()}


def _row(point: Mapping[str, Any]) -> list[str]:
    shut = " ".join(axis for axis in "xy" if point[f"sealed_{axis}"])
    cells = [_cell(point[name]) for name in COLUMNS]
    return [f"{1e6 * point['mean_gap']:.4g}", f"{100 * point['contact']:.3g}", *cells, shut]


def _cell(entry: Mapping[str, float | None]) -> str:
    value, doubt = entry["value"], entry["uncertainty"]
    return f"{value:.4g}" + (" ± ?" if doubt is None else f" ± {doubt:.1g}" if doubt else "")
