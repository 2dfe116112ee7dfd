"""The page of a prepared surface."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.preparation.prepare import Prepared
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD
from roughfilm.figures import surface as surface_figures
from roughfilm.figures.spatial.relief import surface_picture
from roughfilm.pages.render import render
from roughfilm.words.numbers import in_unit, percent
from roughfilm.words.surface import preparation_steps, scale_limits

MEANINGS = {
    "Sa": "mean distance from the mean plane",
    "Sq": "root mean square height",
    "Sp": "highest point above the mean plane",
    "Sv": "lowest point below it",
    "Sz": "from the lowest point to the highest",
    "Ssk": "skewness: negative for plateaus with valleys",
    "Sku": "kurtosis: 3 for Gaussian heights",
    "Sk": "core height: the line through the flattest 40 % of the bearing curve",
    "Spk": "peaks above the core",
    "Svk": "valleys below the core",
    "Smr1": "bearing ratio where the peaks begin",
    "Smr2": "bearing ratio where the valleys begin",
    "Sal": "shortest distance at which the autocorrelation drops to 0.2",
    "Str": "that distance over the longest one: 0 a lay, 1 none",
    "Std": "direction of the lay from the x axis",
    "St": "the same as Sz",
    "Spm": "mean of the five highest peaks",
    "Svm": "mean of the five lowest valleys",
}


def write_page(
    prepared: Prepared, quantities: Mapping[str, Quantity], provenance: Mapping[str, Any], path: Path
) -> None:
    """Write the page; InputError if the file cannot be written."""
    rows = [
        (name, meaning, *in_unit(quantities[f"raw_{name}"]), in_unit(quantities[name])[0])
        for name, meaning in MEANINGS.items()
    ]
    source = provenance["surface"]
    while "prepared_from" in source:
        source = source["prepared_from"]
    picture, missing = surface_picture(prepared.surface) if min(prepared.surface.shape) > 1 else (None, "")
    render(
        "surface.html.j2",
        path,
        name=source.get("file") or source.get("synthetic", {}).get("kind", "surface"),
        source=source,
        prepared=prepared,
        rows=rows,
        changes={name: _change(quantities, name) for name in ("Sq", "Sa")},
        steps=[line.partition(": ") for line in preparation_steps(prepared)],
        scale=scale_limits(prepared),
        mismatch=prepared.record["periodicity_mismatch"],
        threshold=MISMATCH_THRESHOLD,
        maps=surface_figures.height_maps(prepared),
        picture=picture,
        missing=missing,
        joining=prepared.record["edges"],
        joints=surface_figures.joints(prepared),
        edges=surface_figures.edge_profiles(prepared),
        bearing=surface_figures.bearing_curves(prepared),
        spectrum=surface_figures.power_spectra(prepared),
        provenance=provenance,
    )


def _change(quantities: Mapping[str, Quantity], name: str) -> str:
    """What preparation changed in a parameter, as a part of a sentence."""
    before, after = quantities[f"raw_{name}"].value, quantities[name].value
    return "did not change" if before == after else f"changed by {percent(after / before - 1)}"
