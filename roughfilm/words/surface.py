"""The steps by which a surface was prepared and the waves that its parameters include, in words."""

from collections.abc import Mapping
from typing import Any

from roughfilm.contact.preparation.prepare import Prepared
from roughfilm.words.numbers import share


def preparation_steps(prepared: Prepared) -> list[str]:
    """A line for each step that changed something."""
    record: Any = prepared.record
    recipe = prepared.surface.source["recipe"]
    window, grid, cut, edges = record["window"], record["grid"], record["outliers"], record["edges"]
    invalid, filled = record["invalid"]["points"], record["filled"]
    size = " x ".join(f"{length * 1e6:.4g}" for length in prepared.surface.size)
    spiked = f"{cut['spikes']} points of spikes, {cut['rims']} on rims of invalid regions"
    guessed = f"{filled['points']} points, {share(filled['fraction'])}, of which {invalid} were invalid"
    shortened = " x ".join(map(str, edges["shortened"]))
    steps = {
        f"form: {recipe['form']}": recipe["form"] != "none",
        f"spikes: {spiked}": recipe["outliers"]["limit"],
        f"clipped: {cut['above']} points above, {cut['below']} below": recipe["outliers"]["quantile"],
        **{f"{name}: nesting index {index * 1e6:.4g} µm": True for name, index in _filters(record["scale"]).items()},
        f"filled: {guessed}": filled["points"],
        f"window: {window['pixels'][0]} x {window['pixels'][1]} pixels from {window['start']}, {size} µm": True,
        f"grid: {grid['points'][0]} x {grid['points'][1]} points": True,
        f"overlap: the window is shortened by {shortened} pixels, at which edges are joined": any(edges["shortened"]),
        **dict.fromkeys(_edges(edges), edges["changed"] != "none"),
        f"smoothing: {recipe['smoothing']} points": recipe["smoothing"] > 1,
    }
    return [line for line, changed in steps.items() if changed]


def _edges(edges: Mapping[str, Any]) -> tuple[str, str]:
    joined = "in both directions" if edges["changed"] == "both" else f"along {edges['changed']}"
    width = " x ".join(f"{length * 1e6:.4g}" for length in edges["width"])
    means = "along seams" if edges["method"] == "seams" else f"by a filter {width} µm wide"
    other = "others beside a seam" if edges["method"] == "seams" else "a smooth copy"
    blended, weight = (share(edges[name]) for name in ("blended_fraction", "mean_weight"))
    return (
        f"edges: joined {joined} ({edges['reason']}), {means}",
        f"blended: {blended} of the points with {other}; the mean weight over the cell is {weight}",
    )


def scale_limits(prepared: Prepared) -> str:
    """The sentence on the nesting indices of the parameters, of this preparation and those before it."""
    scales = []
    source: Mapping[str, Any] = prepared.surface.source
    while "prepared_from" in source:
        scales.append(source["record"].get("scale", {"form": source["recipe"]["form"]}))
        source = source["prepared_from"]
    form = ", ".join(scale["form"] for scale in reversed(scales) if scale["form"] != "none") or "none"
    short = max((scale.get("s_filter") or 0.0 for scale in scales), default=0.0)
    long = min((scale["l_filter"] for scale in scales if scale.get("l_filter")), default=0.0)
    indices = f"S {_micro(short)}, L {_micro(long)}, F {form}"
    if short and long:
        return f"S-L surface: {indices}"
    if short and form != "none":
        return f"S-F surface: {indices}"
    return f"not scale-limited: {indices}; values without nesting indices are not comparable between laboratories"


def _filters(scale: Mapping[str, Any]) -> dict[str, float]:
    return {name: scale[key] for key, name in (("s_filter", "S-filter"), ("l_filter", "L-filter")) if scale[key]}


def _micro(length: float) -> str:
    return f"{length * 1e6:.4g} µm" if length else "none"
