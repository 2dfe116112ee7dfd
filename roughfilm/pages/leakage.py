"""The page of the leakage of a seal over the load."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.mechanics.gap_map import gap_map
from roughfilm.contact.mechanics.store import load_contact
from roughfilm.contact.parameters.autocorrelation import autocorrelation, decay_lengths
from roughfilm.contact.parameters.peaks import lowest_valleys
from roughfilm.figures import leakage as leakage_figures
from roughfilm.figures.pressed_surface import view_picture
from roughfilm.pages.render import render
from roughfilm.rom.seal.leakage.curve import SealSetup
from roughfilm.rom.seal.leakage.effective_medium import effective_medium
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.series import SOUGHT, Row
from roughfilm.rom.seal.scene import Seal
from roughfilm.words.leakage import WORDS, in_words, leaks, scatter_in_words
from roughfilm.words.numbers import digits


def write_page(
    scene: Seal,
    body: SealSetup,
    rows: Mapping[float, Row],
    thresholds: Mapping[str, Threshold],
    entries: Mapping[str, Any],
    directory: Path,
) -> None:
    """Write report.html of a series and of the object of ``--json``; InputError if the file cannot be written."""
    ordered, spectrum, stiffness = list(rows.values()), scene.spectrum(), scene.composite_modulus
    depth = _valley_depth(body) if np.ptp(body.surface.heights) > 0 else 0.0
    estimated = {}
    if spectrum is not None:
        films = {load: effective_medium(spectrum, composite_modulus=stiffness, load=load) for load in rows}
        estimated = {load: film.permeability for load, film in films.items()}
    shown = _shown(ordered, scene.axis)
    contacts = [load_contact(body.contacts, load) for load in shown]
    picture, why = view_picture([gap_map(contact) for contact in contacts])
    render(
        "leakage.html.j2",
        directory / "report.html",
        scene=scene,
        entries=entries,
        warnings=entries["provenance"]["warnings"],
        thresholds={WORDS[name]: in_words(threshold) for name, threshold in thresholds.items()},
        cards=[(axis, thresholds[f"direct_{axis}"]) for axis in "xy"],
        scatter=scatter_in_words(body.spread) if np.ptp(body.surface.heights) > 0 else "",
        first=ordered[0],
        first_leak=leaks(scene, ordered[0], SOUGHT[scene.axis]),
        periods=scene.flow.length / body.surface.size[scene.axis],
        ratio=_ratio(ordered, scene.flow.direction),
        areas=leakage_figures.areas(ordered, thresholds),
        leakages=leakage_figures.leakages(scene, ordered, thresholds, estimated),
        scaled=leakage_figures.scaled(ordered, depth, stiffness) if any(map(_leaks, ordered)) else None,
        valley_depth=depth,
        paths=leakage_figures.paths(contacts, scene.axis) if any(one.gap.any() for one in contacts) else None,
        picture=picture,
        why=why,
        shown=shown,
        rows=[
            [
                *map(digits, (row.load * 1e-6, row.area_fraction * 100, row.mean_gap * 1e6)),
                *(leaks(scene, row, name) for name in SOUGHT),
                *(_relative_uncertainty(row, name) for name in SOUGHT[:2]),
            ]
            for row in ordered
        ],
    )


def _valley_depth(body: SealSetup) -> float:
    apart = decay_lengths(autocorrelation(body.surface), body.surface.spacing).shortest
    return float(lowest_valleys(body.surface, apart).mean())


def _shown(rows: Sequence[Row], axis: int) -> tuple[float, ...]:
    """Four loads that are drawn: two that leak along the flow, the last that leaks, the first that is sealed."""
    name = SOUGHT[axis]
    opened = [row.load for row in rows if not getattr(row, f"{name}_sealed")]
    closed = [row.load for row in rows if getattr(row, f"{name}_sealed")]
    middle = [opened[len(opened) // 2], opened[min(len(opened) - 1, 4 * len(opened) // 5)]] if opened else []
    return tuple(sorted({*opened[-1:], *closed[:1], *middle, *([] if opened else closed[-1:])}))


def _ratio(rows: Sequence[Row], axis: str) -> float | None:
    """Median ratio of the direct leakage to the averaged one, over the loads at which both flow."""
    both = [
        getattr(row, f"direct_{axis}") / getattr(row, f"homogenized_{axis}")
        for row in rows
        if getattr(row, f"homogenized_{axis}") > 0
    ]
    return float(np.median(both)) if both else None


def _leaks(row: Row) -> bool:
    return row.direct_x > 0 or row.direct_y > 0


def _relative_uncertainty(row: Row, name: str) -> str:
    """The uncertainty over the value."""
    value, uncertainty = getattr(row, name), getattr(row, f"{name}_uncertainty")
    return "–" if value == 0 else f"{100 * uncertainty / value:.2g} %"
