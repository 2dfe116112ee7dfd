"""The page of a rough surface under a series of loads."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.mechanics.load_series import ContactSeries
from roughfilm.figures import contact as contact_figures
from roughfilm.figures.pressed_surface import view_picture
from roughfilm.pages.render import render
from roughfilm.words.numbers import digits

MODELS = {
    "bearing_area": "Heights above a plane are cut off; the pressure there is the hardness. Others do not deform.",
    "greenwood_williamson": "Independent spherical asperities, from the moments of the spectrum.",
    "persson": "Diffusion of the pressures as shorter waves are added, from the spectrum.",
    "elastic": "Elastic half-space, solved at every point, without a limit of the pressure.",
    "elastic_plastic": "Elastic half-space, perfectly plastic where the pressure reaches the hardness, "
    "solved at every point.",
    "stanley_kato": "The same contact by the older algorithm with constant steps, for comparison.",
}

MAX_PICTURED_LOADS = 4
"""Largest number of loads whose contacts are drawn in space."""

COLUMNS = (
    ("load", "MPa", "load", 1e-6),
    ("area", "%", "area_fraction", 100),
    ("in pixels", "%", "area_fraction_pixel", 100),
    ("plastic", "%", "plastic_fraction", 100),
    ("mean gap", "µm", "mean_gap", 1e6),
    ("approach", "µm", "approach", 1e6),
    ("p max", "MPa", "pressure_max", 1e-6),
    ("violation", "rms heights", "complementarity", 1),
    ("iterations", "", "iterations", 1),
    ("CPU", "s", "cpu_s", 1),
)


def write_page(name: str, entries: Mapping[str, Any], series: ContactSeries, path: Path) -> None:
    """Write the page of a series and of the object of ``--json``; InputError if the file cannot be written."""
    last, settings = series.last, entries["provenance"]["settings"]
    hardness = settings["hardness"] or math.inf
    shown = [column for column in COLUMNS if any(getattr(row, column[2]) is not None for row in series.rows)]
    line = last is not None and 1 in last.heights.shape
    count = 0 if line else min(MAX_PICTURED_LOADS, len(series.gap_maps))
    views = [series.gap_maps[round(place)] for place in np.linspace(0, len(series.gap_maps) - 1, count)]
    picture, missing = view_picture(views) if views else (None, "")
    render(
        "contact.html.j2",
        path,
        name=name,
        settings=settings,
        meaning=MODELS[settings["model"]],
        quantities=entries["quantities"],
        numerics=entries["numerics"],
        warnings=entries["provenance"]["warnings"],
        columns=[(head, unit) for head, unit, _, _ in shown],
        rows=[[_cell(getattr(row, field), factor) for _, _, field, factor in shown] for row in series.rows],
        last=series.rows[-1],
        line=line,
        section_at=None if last is None or line else contact_figures.section_row(last) * last.spacing[1],
        areas=contact_figures.areas(series.rows),
        gaps=contact_figures.mean_gaps(series.rows),
        maps=None if last is None or line else contact_figures.maps(last),
        picture=picture,
        missing=missing,
        pressures=contact_figures.pressures(series.densities, hardness),
        section=None if last is None else contact_figures.section(last),
        provenance=entries["provenance"],
    )


def _cell(value: float | None, factor: float) -> str:
    return "–" if value is None else digits(value * factor)
