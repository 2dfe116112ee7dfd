"""The page of a prepared surface."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.parameters.definitions import AREAL, GROUPS
from roughfilm.contact.preparation.prepare import Prepared
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD
from roughfilm.figures import surface as surface_figures
from roughfilm.figures.spatial.relief import surface_picture
from roughfilm.pages.render import render
from roughfilm.words.numbers import in_unit, percent
from roughfilm.words.surface import preparation_steps, scale_limits


def write_page(
    prepared: Prepared, quantities: Mapping[str, Quantity], provenance: Mapping[str, Any], path: Path
) -> None:
    """Write the page; InputError if the file cannot be written."""
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
        heights={name: _row(quantities, name) for name in ("Sq", "Sa")},
        groups=[
            (heading, [(one, _row(quantities, one.name)) for one in AREAL.values() if one.group == group])
            for group, heading in GROUPS.items()
        ],
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


def _row(quantities: Mapping[str, Quantity], name: str) -> tuple[str, str, str]:
    """A parameter of the measured and of the prepared surface, "–" where it has none, and the unit."""
    raw, value = (in_unit(quantities[one]) if one in quantities else ("–", "") for one in (f"raw_{name}", name))
    return raw[0], value[0], raw[1] or value[1]


def _change(quantities: Mapping[str, Quantity], name: str) -> str:
    """What preparation changed in a parameter, as a part of a sentence."""
    before, after = quantities[f"raw_{name}"].value, quantities[name].value
    return "did not change" if before == after else f"changed by {percent(after / before - 1)}"
