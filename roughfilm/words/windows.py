"""Scatter between windows in words, in numbers, and as entries for JSON."""

from dataclasses import asdict
from typing import Any

import numpy as np

from roughfilm.contact.windows.scatter import Scatter
from roughfilm.contact.windows.size_trend import Verdict
from roughfilm.rom.ladder.kind import kind_of_name
from roughfilm.sampling.answer import Answer, WindowQuantity
from roughfilm.words.numbers import SURFACE_UNITS, finite_entries, share
from roughfilm.words.scales import PERCENT, Scale, scale_for
from roughfilm.words.units import EXACT

PLAIN = {
    "friction_coefficient": "friction coefficient",
    "friction": "friction",
    "contact_share": "share of the load on asperities",
    "contact_area": "contact area",
    "sealing_load": "sealing load",
    "rms_height": "rms height",
    "separation": "separation",
    "mean_contact_pressure": "mean contact pressure",
    "pressure_max": "greatest pressure",
    "plastic_fraction": "plastic area",
    "approach": "approach",
    "A11": "pressure flow factor A11",
    "A22": "pressure flow factor A22",
    "B1": "shear flow factor B1",
}
"""Names in a sentence of quantities that a kind of scene does not name."""

DENSITIES = ("1/m", "1/m^2")
"""Units that only roughness parameters have, which are shown in 1/mm and 1/mm²."""

LARGE, TOO_LARGE = 0.5, 100
"""Relative uncertainty from which on it is given as a factor, and the largest factor that is given as a number."""


def title_of(name: str, kind: str) -> str:
    """The name of a quantity in a sentence, in a scene of a kind; "" without a scene."""
    titles = {**PLAIN, **(kind_of_name(kind).titles if kind else {})}
    return titles.get(name, name.replace("_", " ") if len(name) > 4 else name)


def scale_of_quantity(name: str, one: WindowQuantity) -> Scale:
    """The unit in which a quantity is shown."""
    if name in PERCENT:
        return Scale(factor=0.01, unit="%", negligible=1e-9)
    if one.unit in DENSITIES:
        factor, unit = SURFACE_UNITS[one.unit]
        return Scale(factor=factor, unit=unit)
    return scale_for(one.unit, abs(one.scatter.mean))


def ends(found: Scatter, scale: Scale) -> str:
    """The interval of one further window, such as "1.2 to 1.9"; "unknown" if it is unknown."""
    if found.interval is None:
        return "unknown"
    low, high = found.interval
    return f"{scale.number(low)} to {scale.number(high)}"


def headline(answer: Answer, kind: str) -> str:
    """The answer in one line: the mean, one window, how well the mean is known, and how many windows it takes."""
    name = answer.headline
    one = answer.quantities[name]
    scale, found = scale_of_quantity(name, one), one.scatter
    mean = scale.number(found.mean)
    unit = f" {scale.unit}" if scale.unit else ""
    parts = [f"{answer.name}: {title_of(name, kind)} {mean}{unit}"]
    side = f"one window of {1e6 * answer.size:.4g} µm"
    if found.mean == 0:
        parts[0] = f"{answer.name}: {title_of(name, kind)} 0 in all {answer.count} windows"
    elif found.interval is None:
        parts.append(f"the scatter between windows of {1e6 * answer.size:.4g} µm is unknown (too few are independent)")
    else:
        parts.append(f"{side} {ends(found, scale)} (95 %)")
        if found.relative is not None:
            needed = f"; {one.needed} windows for {share(answer.tolerance)}" if one.needed is not None else ""
            parts.append(f"mean known to {known_to(found, scale)}{needed}")
    return ", ".join(parts)


def known_to(found: Scatter, scale: Scale) -> str:
    """The uncertainty of a mean in words: per cent; where it is large, a factor of a positive mean, else its value."""
    if found.relative is None or found.mean_uncertainty is None:
        return "unknown"
    if found.relative == 0:
        return EXACT
    if found.relative <= LARGE:
        return share(found.relative)
    if not found.positive:
        return f"± {scale.number(found.mean_uncertainty)}"
    return f"a factor of {1 + found.relative:.2g}" if found.relative < TOO_LARGE else f"a factor above {TOO_LARGE}"


def size_part(one: WindowQuantity, scale: Scale) -> str:
    """The part of the mean that is due to the size of the windows."""
    trend = one.trend
    if trend.part is None or trend.part_uncertainty is None:
        return "unknown"
    if trend.verdict is Verdict.NOT_RESOLVED:
        return f"below {scale.number(abs(trend.part) + trend.part_uncertainty)}"
    return scale.number(trend.part, trend.part_uncertainty)


def whole_surface(one: WindowQuantity, scale: Scale) -> str:
    """The value on the whole surface, or why there is none."""
    trend = one.trend
    if trend.limit is not None:
        return scale.number(trend.limit, trend.limit_uncertainty)
    return {
        Verdict.NO_PLATEAU: "no plateau",
        Verdict.TOO_STRONG: "trend too strong",
    }.get(trend.verdict, "unknown")


def heads(tolerance: float) -> tuple[str, ...]:
    """The heads of the table of quantities, whose rows are `quantity_cells`."""
    return (
        "quantity",
        "mean",
        "known to",
        "one window (95 %)",
        "numerical ±",
        "due to size",
        "whole surface",
        f"windows for {share(tolerance)}",
    )


def quantity_cells(name: str, one: WindowQuantity, kind: str) -> tuple[str, ...]:
    """The row of a quantity: mean with the uncertainty of the mean, one window, and what else is known."""
    scale, found = scale_of_quantity(name, one), one.scatter
    return (
        scale.label(title_of(name, kind)),
        scale.number(found.mean),
        known_to(found, scale),
        ends(found, scale),
        "unknown" if one.numerical is None else scale.number(one.numerical),
        size_part(one, scale),
        whole_surface(one, scale),
        "unknown" if one.needed is None else str(one.needed),
    )


def entries_of(answer: Answer) -> dict[str, Any]:
    """The answer as entries that JSON can hold."""
    entries: dict[str, Any] = finite_entries(
        {
            "surface": answer.name,
            "headline": answer.headline,
            "size": answer.size,
            "windows": answer.count,
            "independent": answer.independent,
            "tolerance": answer.tolerance,
            "quantities": {name: _quantity_entries(one) for name, one in answer.quantities.items()},
        }
    )
    return entries


def _quantity_entries(one: WindowQuantity) -> dict[str, Any]:
    trend = {name: _listed(value) for name, value in asdict(one.trend).items()}
    return {
        "value": one.scatter.mean,
        "unit": one.unit,
        "uncertainty": one.scatter.mean_uncertainty,
        "numerical_uncertainty": one.numerical,
        "windows_needed": one.needed,
        "windows_lacking": one.lacking,
        "drift_by_chance": one.drift,
        "scatter": _scatter_entries(one.scatter),
        "trend": trend,
        "by_size": [{"size": size, **_scatter_entries(found)} for size, found in one.by_size.items()],
    }


def _scatter_entries(found: Scatter) -> dict[str, Any]:
    return {name: _listed(value) for name, value in vars(found).items()} | {"mean_uncertainty": found.mean_uncertainty}


def _listed(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else value
