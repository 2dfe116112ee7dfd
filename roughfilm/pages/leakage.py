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
from roughfilm.figures.spatial.pressed_surface import view_picture
from roughfilm.pages.render import render
from roughfilm.rom.seal.at_load import SealAtLoad
from roughfilm.rom.seal.leakage.curve import SealSetup
from roughfilm.rom.seal.leakage.effective_medium import effective_medium
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.series import SOUGHT, Row
from roughfilm.rom.seal.scene import Seal
from roughfilm.words.leakage import in_words, leakage_scale, leaks, scatter_in_words
from roughfilm.words.numbers import digits
from roughfilm.words.scales import Scale

KINDS = ("direct", "homogenized")
"""The flow through one period between reservoirs, and that of the periodic surface."""

DRAWN_LOADS = 4
"""Largest number of loads whose gaps are drawn."""


def write_page(
    scene: Seal,
    body: SealSetup,
    rows: Mapping[float, Row],
    thresholds: Mapping[str, Threshold],
    answer: SealAtLoad,
    entries: Mapping[str, Any],
    directory: Path,
) -> None:
    """Write report.html of a series and of the object of ``--json``; InputError if the file cannot be written."""
    ordered, spectrum, stiffness = list(rows.values()), scene.spectrum(), scene.composite_modulus
    scale, gap = leakage_scale(answer), Scale(factor=1e-6, unit="µm")
    leak = answer.leakage_per_width
    depth = _valley_depth(body) if np.ptp(body.surface.heights) > 0 else 0.0
    estimated = {}
    if spectrum is not None:
        films = {load: effective_medium(spectrum, composite_modulus=stiffness, load=load) for load in rows}
        estimated = {load: film.permeability for load, film in films.items()}
    shown = _shown(ordered, scene.axis, answer.load)
    contacts = [load_contact(body.contacts, load) for load in shown]
    picture, why = view_picture([gap_map(contact) for contact in contacts])
    render(
        "leakage.html.j2",
        directory / "report.html",
        scene=scene,
        entries=entries,
        warnings=entries["provenance"]["warnings"],
        answer=answer,
        leak="sealed" if answer.sealed else scale.text(leak.value, leak.uncertainty),
        unit=scale.unit,
        area=Scale(factor=0.01, unit="%").text(answer.area_fraction.value, answer.area_fraction.uncertainty),
        gap=gap.text(answer.mean_gap.value, answer.mean_gap.uncertainty),
        sealing=thresholds[SOUGHT[scene.axis]],
        thresholds={axis: [in_words(thresholds[f"{kind}_{axis}"]) for kind in KINDS] for axis in "xy"},
        scatter=scatter_in_words(body.spread) if np.ptp(body.surface.heights) > 0 else "",
        periods=scene.flow.length / body.surface.size[scene.axis],
        ratio=_ratio(ordered, scene.flow.direction),
        areas=leakage_figures.areas(ordered, thresholds, answer),
        leakages=leakage_figures.leakages(scene, ordered, thresholds, estimated, answer, scale),
        scaled=leakage_figures.scaled(ordered, depth, stiffness) if any(map(_leaks, ordered)) else None,
        valley_depth=depth,
        paths=leakage_figures.paths(contacts, scene.axis) if any(one.gap.any() for one in contacts) else None,
        picture=picture,
        why=why,
        shown=shown,
        rows=[
            (
                row.load == answer.load,
                [
                    *map(digits, (row.load * 1e-6, row.area_fraction * 100, row.mean_gap * 1e6)),
                    *(leaks(scene, row, name, scale) for name in SOUGHT),
                ],
            )
            for row in ordered
        ],
    )


def _valley_depth(body: SealSetup) -> float:
    apart = decay_lengths(autocorrelation(body.surface), body.surface.spacing).shortest
    return float(lowest_valleys(body.surface, apart).mean())


def _shown(rows: Sequence[Row], axis: int, load: float) -> tuple[float, ...]:
    """Four loads that are drawn: that of the answer, and some of those around the load at which the seal closes."""
    name = SOUGHT[axis]
    opened = [row.load for row in rows if not getattr(row, f"{name}_sealed")]
    closed = [row.load for row in rows if getattr(row, f"{name}_sealed")]
    between = [opened[4 * len(opened) // 5], opened[len(opened) // 2]] if opened else []
    chosen = dict.fromkeys([load, *opened[-1:], *closed[:1], *between, *closed[-1:]])
    return tuple(sorted([*chosen][:DRAWN_LOADS]))


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
