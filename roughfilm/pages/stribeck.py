"""The page of Stribeck curves."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures import stribeck as stribeck_figures
from roughfilm.figures.base import svg
from roughfilm.figures.shafts.angles import Along, along_of
from roughfilm.figures.stribeck import Drawn
from roughfilm.pages.render import render
from roughfilm.rom.bearing.geometry.ring import Ring
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.film import MixedState
from roughfilm.rom.bearing.mixed.search.heated import with_temperature
from roughfilm.rom.bearing.mixed.store import numbers_of
from roughfilm.rom.bearing.mixed.stribeck import (
    LOAD_TOLERANCE,
    StribeckCurve,
    StribeckPoint,
    curve_search,
)
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.words.average import count_in_words
from roughfilm.words.stribeck import SpeedScale, flash_of, lift_off, number_of, own_point, speed_scale

DRAWN_CONTACT_SHARE = 0.3
"""The first film drawn is the one whose asperities carry nearest to this fraction of the load."""

COLUMNS = (
    ("friction, coefficient", "", "friction_coefficient", 1.0),
    ("least film (mean gap)", "µm", "least_gap", 1e6),
    ("carried, by contact", "%", "contact_share", 100.0),
    ("film, pressure, largest", "MPa", "pressure_max", 1e-6),
    ("contact, pressure, largest", "MPa", "contact_pressure_max", 1e-6),
    ("cavitated", "%", "cavitated_fraction", 100.0),
    ("temperature, film", "°C", "temperature", 1.0),
    ("temperature, outlet", "°C", "outlet_temperature", 1.0),
    ("spots, in contact, hotter by", "K", "flash_temperature", 1.0),
)
"""Title, unit, name and factor of each column of the table of numbers."""

OF_CONTACT = ("contact_share", "contact_pressure_max")
"""Columns of a bearing with asperities."""


def write_page(
    scene: Bearing,
    entries: Mapping[str, Any],
    curves: Sequence[StribeckCurve],
    asperities: Asperities | None,
    resolution: int,
    path: Path,
) -> None:
    """Write the page of curves and of the object of ``--json``; InputError if the file cannot be written."""
    scale, along = speed_scale(scene), along_of(scene)
    unit, factor = scale.unit, scale.factor
    middle = curves[len(curves) // 2]
    speeds, pressures = [point.speed for point in middle.points], [curve.pressure for curve in curves]
    search = with_temperature(curve_search(scene, asperities, speeds, pressures, resolution, LOAD_TOLERANCE))
    heated = middle.points[0].temperature is not None
    drawn = [
        drawn_film(
            search.again(point.speed, point.pressure, point.separation), f"{factor * point.speed:.4g} {unit}", along
        )
        for point in shown_points(middle, own_point(scene, middle))
    ]
    columns = [column for column in COLUMNS if asperities is not None or column[2] not in OF_CONTACT]
    columns = [column for column in columns if column[2] in numbers_of(middle.points)]
    touching = None if asperities is None else asperities.touching
    render(
        "stribeck.html.j2",
        path,
        name=scene.name or "bearing",
        entries=entries,
        windows=_windows(entries),
        unit=unit,
        own=f"{factor * abs(scene.motion.speed):.4g} {unit}",
        friction=scene.boundary_friction,
        answers=[_answer(scene, curve, scale) for curve in curves],
        shown=f"{middle.pressure / 1e6:.4g} MPa",
        columns=columns,
        rows={
            f"{curve.pressure / 1e6:.4g} MPa": [
                (
                    point is own_point(scene, curve),
                    [f"{factor * point.speed:.4g}", *_row(point, columns)],
                )
                for point in curve.points
                if point.uncertainty
            ]
            for curve in curves
        },
        curves=svg(stribeck_figures.curves(curves, scale, touching, abs(scene.motion.speed))),
        films=svg(stribeck_figures.films(drawn)),
        contact=any(one.contact.any() for one in drawn),
        along=None if isinstance(scene.geometry, Ring) else along,
        table=None if asperities is None else svg(stribeck_figures.asperity_table(asperities)),
        touching=touching,
        heated=heated,
    )


def _windows(entries: Mapping[str, Any]) -> str:
    """The number of windows in words; "" for one surface."""
    windows = entries.get("windows")
    return "" if windows is None else count_in_words(windows["count"], windows["independent"])


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What the page begins with under one load: friction, film and contact at the speed of the scene, "" without it."""

    load: str
    lift: str
    friction: str
    film: str
    contact: str
    least: str
    temperature: str


def _answer(scene: Bearing, curve: StribeckCurve, scale: SpeedScale) -> Answer:
    own = own_point(scene, curve)
    least = min(curve.points, key=lambda point: point.friction_coefficient)
    return Answer(
        load=f"{curve.pressure / 1e6:.4g} MPa",
        lift=lift_off(curve, scale),
        friction="" if own is None else number_of(own, "friction_coefficient"),
        film="" if own is None else number_of(own, "least_gap", 1e6),
        contact="" if own is None else number_of(own, "contact_share", 100.0),
        temperature="" if own is None or own.temperature is None else number_of(own, "temperature"),
        least=f"{least.friction_coefficient:.3g} at {scale.factor * least.speed:.4g} {scale.unit}",
    )


def shown_points(curve: StribeckCurve, own: StribeckPoint | None) -> list[StribeckPoint]:
    """The points whose films are drawn: a mixed film and the first without contact, or that of the scene's speed."""
    if own is not None and all(point.contact_load == 0 for point in curve.points):
        return [own]
    mixed = [point for point in curve.points if point.contact_load > 0 and point.speed > 0]
    parted = [point for point in curve.points if point.contact_load == 0]
    nearest = min(mixed, key=lambda point: abs(point.contact_share - DRAWN_CONTACT_SHARE)) if mixed else curve.points[0]
    last = parted[0] if parted else curve.points[-1]
    return [nearest, last] if last is not nearest else [nearest]


def drawn_film(mixed: MixedState, title: str, along: Along | None = None) -> Drawn:
    """Pressures of film and contact at the nodes; a closed ring repeats its first line after the last."""
    grid, geometry = mixed.solution.grid, mixed.scene.geometry
    pressure = mixed.solution.state.pressure + mixed.scene.lubricant.cavitation_pressure
    contact = mixed.contact.force / grid.areas
    fraction = mixed.contact_load / mixed.load
    title += f", {100 * fraction:.3g} % by contact" if fraction > 0 else ", no contact"
    x, y = np.meshgrid(grid.x, grid.y, indexing="ij")
    if not isinstance(geometry, Ring):
        return Drawn(title=title, x=x, y=y, film=pressure, contact=contact, along=along)
    if geometry.endless:
        x = np.vstack([x, x[:1] + geometry.turn])
        y, pressure, contact = (_closed(values) for values in (y, pressure, contact))
    middle = x - geometry.turn / 2
    return Drawn(title=title, x=y * np.sin(middle), y=y * np.cos(middle), film=pressure, contact=contact)


def _closed(values: Array) -> Array:
    return np.vstack([values, values[:1]])


def _row(point: StribeckPoint, columns: Sequence[tuple[str, str, str, float]]) -> list[str]:
    return [
        flash_of(point) if name == "flash_temperature" else number_of(point, name, factor, lines=True)
        for _, _, name, factor in columns
    ]
