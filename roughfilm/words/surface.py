"""The steps by which a surface was prepared, in words."""

from collections.abc import Mapping
from typing import Any

from roughfilm.contact.preparation.prepare import Prepared


def preparation_steps(prepared: Prepared) -> list[str]:
    """A line for each step that changed something."""
    record: Any = prepared.record
    recipe = prepared.surface.source["recipe"]
    window, grid, cut, edges = record["window"], record["grid"], record["outliers"], record["edges"]
    size = " x ".join(f"{length * 1e6:.4g}" for length in prepared.surface.size)
    shortened = " x ".join(map(str, edges["shortened"]))
    steps = {
        f"form: {recipe['form']}": recipe["form"] != "none",
        f"filled: {record['invalid']['points']} invalid points": record["invalid"]["points"],
        f"cut: {cut['above']} points above, {cut['below']} below": recipe["outliers"]["points"],
        f"window: {window['pixels'][0]} x {window['pixels'][1]} pixels from {window['start']}, {size} µm": True,
        f"grid: {grid['points'][0]} x {grid['points'][1]} points": True,
        f"overlap: the window is shortened by {shortened} pixels, at which edges are joined": any(edges["shortened"]),
        **dict.fromkeys(_edges(edges), edges["direction"] != "none"),
        f"smoothing: {recipe['smoothing']} points": recipe["smoothing"] > 1,
    }
    return [line for line, changed in steps.items() if changed]


def _edges(edges: Mapping[str, Any]) -> tuple[str, str]:
    joined = "in both directions" if edges["direction"] == "both" else f"along {edges['direction']}"
    width = " x ".join(f"{length * 1e6:.4g}" for length in edges["width"])
    means = "along seams" if edges["method"] == "seams" else f"by a filter {width} µm wide"
    other = "others beside a seam" if edges["method"] == "seams" else "a smooth copy"
    blended, weight = (f"{100 * edges[name]:.2g} %" for name in ("blended_fraction", "mean_weight"))
    return (
        f"edges: joined {joined} ({edges['reason']}), {means}",
        f"blended: {blended} of the points with {other}; the mean weight over the cell is {weight}",
    )
