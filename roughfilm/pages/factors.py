"""The page of flow factors."""

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.read import HeightMap
from roughfilm.figures import factors as factors_figures
from roughfilm.pages.render import render
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.homogenization.flow_factors import Estimated
from roughfilm.rom.homogenization.table.factor_table import FactorTable
from roughfilm.rom.homogenization.table.windows import POSITIVE
from roughfilm.words.average import rounded
from roughfilm.words.numbers import with_error

BY_PRESSURE = {"A11": "along x", "A22": "along y", "A12": "crossed"}
"""Names of the pressure flow factors."""

BY_SLIDING = {
    "B1": "flow along x",
    "B2": "flow along y",
    "d": "friction, mean of 1/h",
    "e": "friction by deflected flow",
}
"""Names of the factors of the flow and of the friction by sliding along x."""

CARDS = {
    "A11": "times the flow of a smooth film, by pressure along x",
    "A22": "times that flow, by pressure along y",
    "B1": "times the flow that sliding along x drags",
}
"""The factors at the top of the page, in words."""


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
    asked = points[0] if table is None else min(points, key=lambda point: (point["contact"], point["mean_gap"]))
    render(
        "factors.html.j2",
        path,
        name=name,
        entries=entries,
        windows=entries.get("windows", {}).get("count", 0),
        asked=f"{1e6 * asked['mean_gap']:.4g}",
        cards={words: _factor(asked, factor) for factor, words in CARDS.items()},
        touching=asked["contact"],
        first=table is not None,
        tables={
            "Flow by pressure": (BY_PRESSURE, [_row(point, BY_PRESSURE, pressed=pressed) for point in points]),
            "Flow and friction by sliding along x": (
                BY_SLIDING,
                [_row(point, BY_SLIDING, pressed=pressed) for point in points],
            ),
        },
        loaded=pressed,
        shown={"mean_gap": factors.factors.mean_gap, "contact": factors.contact, "sealed": factors.factors.sealed},
        maps=factors_figures.maps(gap, rough.spacing, factors.correctors, factors.factors.sealed),
        sq=float(rough.heights.std()),
        curves=None if table is None else factors_figures.curves(table),
        pressed=factors_figures.pressures(AsperityTable(factors=table)) if table is not None and pressed else None,
    )


def _row(point: Mapping[str, Any], names: Iterable[str], *, pressed: bool) -> list[str]:
    loaded = [f"{point['load'] / 1e6:.4g}"] if pressed else []
    return [
        *loaded,
        f"{1e6 * point['mean_gap']:.4g}",
        f"{100 * point['contact']:.3g}",
        *(_factor(point, name, "\n± ") for name in names),
    ]


def _factor(point: Mapping[str, Any], name: str, joint: str = " ± ") -> str:
    """A factor with its uncertainty, and behind ``joint`` the scatter of a mean over windows; or "sealed"."""
    if (name == "A11" and point["sealed_x"]) or (name == "A22" and point["sealed_y"]):
        return "sealed"
    value, uncertainty = point[name]["value"], point[name]["uncertainty"]
    text = with_error(value, math.inf if uncertainty is None else uncertainty).replace("-", "−")
    if "scatter" not in point[name]:
        return text
    size = value if name in POSITIVE else math.inf  # the others may be near 0
    return f"{text}{joint}{rounded(point[name]['scatter'], size)}"
