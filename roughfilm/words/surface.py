"""The steps by which a surface was prepared, in words."""

from typing import Any

from roughfilm.contact.preparation.prepare import Prepared
from roughfilm.words.numbers import share


def preparation_steps(prepared: Prepared) -> list[str]:
    """A line for each step that changed something."""
    record: Any = prepared.record
    recipe = prepared.surface.source["recipe"]
    window, grid, cut, edges = record["window"], record["grid"], record["outliers"], record["edges"]
    invalid, filled = record["invalid"]["points"], record["filled"]
    size, width = (
        " x ".join(f"{length * 1e6:.4g}" for length in pair) for pair in (prepared.surface.size, edges["width"])
    )
    joined = "in both directions" if edges["direction"] == "both" else f"along {edges['direction']}"
    spiked = f"{cut['spikes']} points of spikes, {cut['rims']} on rims of invalid regions"
    guessed = f"{filled['points']} points, {share(filled['fraction'])}, of which {invalid} were invalid"
    steps = {
        f"form: {recipe['form']}": recipe["form"] != "none",
        f"spikes: {spiked}": recipe["outliers"]["limit"],
        f"cut: {cut['above']} points above, {cut['below']} below": recipe["outliers"]["points"],
        f"filled: {guessed}": filled["points"],
        f"window: {window['pixels'][0]} x {window['pixels'][1]} pixels from {window['start']}, {size} µm": True,
        f"grid: {grid['points'][0]} x {grid['points'][1]} points": True,
        f"edges: joined {joined} ({edges['reason']}), filter {width} µm wide": edges["direction"] != "none",
        f"smoothing: {recipe['smoothing']} points": recipe["smoothing"] > 1,
    }
    return [line for line, changed in steps.items() if changed]
