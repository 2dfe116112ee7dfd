"""The page of a march."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roughfilm.figures.base import svg
from roughfilm.figures.motion import march as figures
from roughfilm.figures.shafts.angles import along_of
from roughfilm.pages.render import render
from roughfilm.rom.bearing.march.solve import March
from roughfilm.words.march import headline, rows_of


def left_out(march: March) -> str:
    """The effects of roughness and of solids that a march leaves out, in words."""
    scene = march.scene
    if scene.asperities is not None:
        return "deformation of the walls as a whole; roughness is averaged, and asperities touch"
    return "deformation" if scene.roughness is not None else "deformation; walls are smooth"


def write_page(march: March, entries: Mapping[str, Any], path: Path) -> None:
    """Write the page of a march and of the object of ``--json``; InputError if the file cannot be written."""
    series, along = march.series, along_of(march.placed)
    late = [number for number, time in enumerate(series.time) if time >= march.first]
    least = min(late, key=lambda number: float(series["film_min"][number]))
    near = min(series.snapshots, key=lambda one: abs(one.time - series.time[least]), default=None)
    render(
        "march.html.j2",
        path,
        name=march.scene.name or "bearing",
        entries=entries,
        headline=headline(march.quantities),
        march=march,
        rows=list(rows_of(march.quantities, march.titles)),
        least=f"{series.time[least]:.4g}",
        left_out=left_out(march),
        orbit=svg(figures.orbit(march)) if "eccentricity_x" in series.units else None,
        over_time=svg(figures.over_time(march)),
        film=None if near is None else svg(figures.film(march, near)),
        gaps=bool(along.gaps),
        pivots=bool(along.pivots),
        drawn="" if near is None else f"{near.time:.4g}",
        ends=f"{series.time[0]:.4g} s to {series.time[-1]:.4g} s",
        window=f"{march.first:.4g} s to {march.last:.4g} s",
    )
