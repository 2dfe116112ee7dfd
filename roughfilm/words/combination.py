"""Two combined surfaces in words: the quantities with their meanings, the steps, and the answer."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.registration.combine import Combined
from roughfilm.words.numbers import share
from roughfilm.words.units import EXACT, in_engineering_unit

MEANINGS = {
    "worn_volume_per_area": ("worn volume per area", "mean of before − after above the plane of the unworn points"),
    "largest_depth": ("largest depth", "at the deepest place, by a quadratic fit of 9 x 9 points"),
    "worn_fraction": ("worn fraction", "part of the common points that are deeper than noise"),
    "noise": ("noise", "standard deviation of the difference of the unworn points"),
    "Sq_first": ("Sq of the first wall", "root mean square height over the common points"),
    "Sq_second": ("Sq of the second wall", "root mean square height over the common points"),
    "Sq_sum": ("Sq of the sum", "of uncorrelated walls the root of the sum of both squares"),
    "shift_x": ("shift along x", "position of the second surface on the first"),
    "shift_y": ("shift along y", "position of the second surface on the first"),
    "correlation": ("correlation", "correlation coefficient over the common points; a difference leaves out worn ones"),
    "common_fraction": ("common points", "valid points of both over those of the smaller surface"),
}


ROUNDING = 1e-9
"""Length over the range of the heights, or over a pixel, that is not above rounding."""


def combination_rows(combined: Combined) -> list[tuple[str, str, str, str, str]]:
    """Title, value, uncertainty, unit and meaning of each quantity, as texts."""
    rows = []
    for name, quantity in combined.quantities.items():
        title, meaning = MEANINGS[name]
        rows.append((title, *in_engineering_unit(_above_rounding(combined, name, quantity)), meaning))
    return rows


def _above_rounding(combined: Combined, name: str, quantity: Quantity) -> Quantity:
    """The quantity, with 0 in place of a length or an uncertainty that rounding makes, such as of equal files."""
    if quantity.unit != "m":
        return quantity
    steps = ("shift_x", "shift_y")
    least = ROUNDING * (min(combined.first.spacing) if name in steps else float(np.ptp(combined.first.heights)))
    value = quantity.value if abs(quantity.value) > least else 0.0
    bar = quantity.uncertainty
    return Quantity(value=value, unit="m", uncertainty=0.0 if bar is not None and bar <= least else bar)


def combination_steps(combined: Combined) -> list[str]:
    """A line for each step that changed something."""
    record: Any = combined.record
    grid, scale = record["grid"], record["steps"][0]["scale"]
    spacing = " x ".join(f"{step * 1e6:.4g}" for step in grid["spacing"])
    indices = {name: scale[key] for key, name in (("s_filter", "S-filter"), ("l_filter", "L-filter")) if scale[key]}
    peak = record["shift"]["peak"]
    chance = "" if peak is None else f"; probability of a false match at most {peak['false_probability']:.1g}"
    steps = {
        f"form: {scale['form']}": scale["form"] != "none",
        **{f"{name}: nesting index {index * 1e6:.4g} µm": True for name, index in indices.items()},
        f"mirrored: {record.get('mirror')} of the second wall": record.get("mirror", "none") != "none",
        f"shift: {'by cross-correlation' if record['shift']['registered'] else 'as given'}{chance}": True,
        f"grid: {grid['points'][0]} x {grid['points'][1]} points of {spacing} µm": True,
        f"level: plane through the {record.get('level')} points": combined.operation == "difference",
    }
    return [line for line, changed in steps.items() if changed]


def answer(combined: Combined, names: Sequence[str]) -> str:
    """The result in one sentence."""
    main = "Sq_sum" if combined.operation == "sum" else "worn_volume_per_area"
    value, uncertainty, unit = in_engineering_unit(_above_rounding(combined, main, combined.quantities[main]))
    common = share(combined.quantities["common_fraction"].value)
    if combined.operation == "sum":
        return f"{names[0]} on {names[1]}: composite Sq {value} {unit} over {common} of the smaller surface"
    bar = "" if uncertainty in (EXACT, "unknown") else f" ± {uncertainty}"
    return f"{names[0]} to {names[1]}: worn volume per area {value}{bar} {unit}"
