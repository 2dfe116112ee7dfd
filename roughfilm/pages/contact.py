"""The page of a rough surface under a series of loads."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.mechanics.load_series import ContactSeries
from roughfilm.contact.mechanics.store import Row
from roughfilm.figures import contact as contact_figures
from roughfilm.figures.spatial.pressed_surface import view_picture
from roughfilm.pages.render import render
from roughfilm.words.contact import number_of
from roughfilm.words.numbers import digits

MODELS = {
    "bearing_area": "heights above a plane are cut off; the pressure there is the hardness, and no other point deforms",
    "greenwood_williamson": "independent spherical asperities, from the moments of the spectrum",
    "persson": "diffusion of the pressures as shorter waves are added, from the spectrum",
    "elastic": "elastic half-space, solved at every point, without a limit of the pressure",
    "elastic_plastic": "elastic half-space, perfectly plastic where the pressure reaches the hardness, "
    "solved at every point",
    "stanley_kato": "elastic half-space, solved at every point by the older algorithm with constant steps",
}

MAX_PICTURED_LOADS = 4
"""Largest number of loads whose contacts are drawn in space."""

COLUMNS = (
    ("load", "MPa", "load", 1e-6),
    ("contact", "%", "area_fraction", 100),
    ("plastic", "%", "plastic_fraction", 100),
    ("mean gap", "µm", "mean_gap", 1e6),
    ("approach", "µm", "approach", 1e6),
    ("largest pressure", "MPa", "pressure_max", 1e-6),
)
"""Title, unit, name and factor of each column of the results."""

NUMERICS = (
    ("load", "MPa", "load", 1e-6),
    ("contact, in pixels", "%", "area_fraction_pixel", 100),
    ("violation over rms height", "10⁻⁹", "complementarity", 1e9),
    ("iterations", "", "iterations", 1),
    ("CPU time", "s", "cpu_s", 1),
)
"""The same of the table of numerics."""

MAX_CARDS = 4
"""Largest number of loads at the top of the page."""

Columns = Sequence[tuple[str, str, str, float]]


def write_page(name: str, entries: Mapping[str, Any], series: ContactSeries, path: Path) -> None:
    """Write the page of a series and of the object of ``--json``; InputError if the file cannot be written."""
    last, settings = series.last, entries["provenance"]["settings"]
    hardness = settings["hardness"] or math.inf
    line = last is not None and 1 in last.heights.shape
    count = 0 if line else min(MAX_PICTURED_LOADS, len(series.gap_maps))
    views = [series.gap_maps[round(place)] for place in np.linspace(0, len(series.gap_maps) - 1, count)]
    picture, missing = view_picture(views) if views else (None, "")
    columns, numerics = _known(COLUMNS, series.rows), _known(NUMERICS, series.rows)
    render(
        "contact.html.j2",
        path,
        name=name,
        settings=settings,
        meaning=MODELS[settings["model"]],
        numerics=entries["numerics"],
        warnings=entries["provenance"]["warnings"],
        cards=[_card(row, series.uncertainties.get(row.load, {})) for row in _spread_out(series)],
        columns=columns,
        rows=[_cells(columns, row, series.uncertainties.get(row.load, {})) for row in series.rows],
        sure=bool(series.uncertainties),
        numeric_columns=numerics,
        numeric_rows=[_cells(numerics, row, {}) for row in series.rows] if len(numerics) > 1 else [],
        load=f"{digits(series.rows[-1].load / 1e6)} MPa",
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


def _known(columns: Columns, rows: Sequence[Row]) -> Columns:
    """The columns of which at least one row has a number."""
    return [column for column in columns if any(getattr(row, column[2]) is not None for row in rows)]


def _cells(columns: Columns, row: Row, uncertainties: Mapping[str, float]) -> list[str]:
    return [number_of(row, name, factor, uncertainties) for _, _, name, factor in columns]


def _spread_out(series: ContactSeries) -> list[Row]:
    """The loads at the top of the page: those with an uncertainty, if there are any, the last among them."""
    rows = [row for row in series.rows if row.load in series.uncertainties] or [*series.rows]
    places = np.linspace(0, len(rows) - 1, min(MAX_CARDS, len(rows))).round().astype(int)
    return [rows[place] for place in places]


def _card(row: Row, uncertainties: Mapping[str, float]) -> dict[str, str]:
    load, area, plastic, gap, *_ = _cells(COLUMNS, row, uncertainties)
    return {"load": load, "area": area, "plastic": plastic, "gap": gap}
