"""The page of Stribeck curves."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures import stribeck as stribeck_figures
from roughfilm.figures.base import svg
from roughfilm.figures.stribeck import Drawn
from roughfilm.pages.render import render
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.film import MixedFilm
from roughfilm.rom.bearing.mixed.stribeck import LOAD_TOLERANCE, StribeckCurve, StribeckPoint, curve_film
from roughfilm.rom.bearing.ring import Ring
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.words.numbers import with_error
from roughfilm.words.stribeck import lift_off, speed_scale

DRAWN_CONTACT_SHARE = 0.3
"""The first film drawn is the one whose asperities carry nearest to this fraction of the load."""

MAX_ROWS = 9
"""Largest number of points of a curve in the table of numbers."""


def write_page(
    scene: Bearing,
    entries: Mapping[str, Any],
    curves: Sequence[StribeckCurve],
    asperities: Asperities | None,
    resolution: int,
    path: Path,
) -> None:
    """Write the page of curves and of the object of ``--json``; InputError if the file cannot be written."""
    scale = speed_scale(scene)
    unit, factor = scale.unit, scale.factor
    middle = curves[len(curves) // 2]
    speeds, pressures = [point.speed for point in middle.points], [curve.pressure for curve in curves]
    film = curve_film(scene, asperities, speeds, pressures, resolution, LOAD_TOLERANCE)
    drawn = [drawn_film(film, point, f"{factor * point.speed:.3g} {unit}") for point in shown_points(middle)]
    render(
        "stribeck.html.j2",
        path,
        name=scene.name or "bearing",
        entries=entries,
        unit=unit,
        factor=factor,
        friction=scene.asperities.friction if scene.asperities is not None else 0.0,
        pressures=[curve.pressure for curve in curves],
        lifts=[(curve, lift_off(curve, scale)) for curve in curves],
        shown=f"{middle.pressure / 1e6:.4g} MPa",
        rows=[_row(point, factor) for curve in curves for point in _few(curve.points)],
        curves=svg(stribeck_figures.curves(curves, scale, None if asperities is None else asperities.touching)),
        films=svg(stribeck_figures.films(drawn)),
        table=None if asperities is None else svg(stribeck_figures.asperity_table(asperities)),
        touching=None if asperities is None else asperities.touching,
    )


def shown_points(curve: StribeckCurve) -> list[StribeckPoint]:
    """The points whose films are drawn: a mixed film and the first without contact, as far as there are any."""
    mixed = [point for point in curve.points if point.contact_load > 0 and point.speed > 0]
    parted = [point for point in curve.points if point.contact_load == 0]
    nearest = min(mixed, key=lambda point: abs(point.contact_share - DRAWN_CONTACT_SHARE)) if mixed else curve.points[0]
    last = parted[0] if parted else curve.points[-1]
    return [nearest, last] if last is not nearest else [nearest]


def drawn_film(film: MixedFilm, point: StribeckPoint, title: str) -> Drawn:
    """Pressures of film and contact at the nodes; a closed ring repeats its first line after the last."""
    solution = film.at(point.separation + film.dip, point.speed)
    grid, geometry = solution.solution.grid, film.scene.geometry
    pressure = solution.solution.state.pressure + film.scene.lubricant.cavitation_pressure
    contact = solution.contact.force / grid.areas
    fraction = point.contact_share
    title += f", {100 * fraction:.3g} % by contact" if fraction > 0 else ", no contact"
    x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
    if not isinstance(geometry, Ring):
        return Drawn(title=title, x=x, y=y, film=pressure, contact=contact)
    if geometry.endless:
        x = np.vstack([x, x[:1] + geometry.turn])
        y, pressure, contact = (_closed(values) for values in (y, pressure, contact))
    middle = x - geometry.turn / 2
    return Drawn(title=title, x=y * np.sin(middle), y=y * np.cos(middle), film=pressure, contact=contact)


def _closed(values: Array) -> Array:
    return np.vstack([values, values[:1]])


def _few(points: Sequence[StribeckPoint]) -> list[StribeckPoint]:
    places = np.unique(np.linspace(0, len(points) - 1, min(MAX_ROWS, len(points))).round().astype(int))
    return [points[place] for place in places]


def _row(point: StribeckPoint, factor: float) -> list[str]:
    def cell(name: str, scale: float = 1.0) -> str:
        return with_error(scale * getattr(point, name), scale * point.uncertainty.get(name, 0.0))

    return [
        f"{point.pressure / 1e6:.4g}",
        f"{factor * point.speed:.4g}",
        cell("friction_coefficient"),
        cell("separation", 1e6),
        cell("least_gap", 1e6),
        cell("contact_share", 100),
        cell("pressure_max", 1e-6),
        cell("contact_pressure_max", 1e-6),
        cell("cavitated_fraction", 100),
    ]
