"""Stribeck curves of a scene with files for the table and the points, from which a stopped sweep continues."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol, TypeVar

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, joint_mismatch
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.mixed.asperities import Asperities
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.mixed.film import MixedFilm
from roughfilm.rom.bearing.mixed.kept import kept_asperities
from roughfilm.rom.bearing.mixed.store import known_points, save_points
from roughfilm.rom.bearing.mixed.stribeck import StribeckCurve, stribeck
from roughfilm.rom.bearing.mixed.tabulate import tabulate_pressed
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.roughness import RoughSurface
from roughfilm.rom.bearing.scene import Bearing, BearingLoad
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.resume import regular_saves, resumed_table
from roughfilm.rom.homogenization.table.store import load_table_and_source
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.provenance import code
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.parts.solids import composite_modulus, hardness

MATCH_TOLERANCE = 1e-9
"""Relative difference up to which the surface and solids of a table match those of the scene."""

EXTENSION_FACTOR = 1.3
"""Largest load of an extended table over the estimated load that is needed."""

MAX_EXTENSIONS = 12
"""Largest number of extensions of a table."""

CLOSURE_RATIO = 1.02
"""Ratio of the load that closes the gap to the largest load of the table below which the table is not extended."""

IRRELEVANT = ("name", "motion.speed", "geometry.film", "geometry.eccentricity")
"""Entries of a scene on which the curves do not depend."""


class OperatingPoint(Protocol):
    """A point of a sweep over speed and load."""

    @property
    def pressure(self) -> float:
        """The load over the nominal area, Pa."""
        ...

    @property
    def speed(self) -> float:
        """The sliding speed, m/s."""
        ...


PointT = TypeVar("PointT", bound=OperatingPoint)


@dataclass(frozen=True, kw_only=True)
class Wall:
    """The asperities of a scene and the origin of their table.

    Attributes
    ----------
    asperities : flow factors and contact pressures over the separation.
    warnings : sentences about an extended table or a surface that is not periodic.
    points : number of points of the table.
    known_points : number of those that were already in a file.
    source : input of the table as JSON entries.
    """

    asperities: Asperities
    warnings: tuple[str, ...]
    points: int
    known_points: int
    source: Mapping[str, Any]


def wall_of(scene: Bearing, largest: float, table: Path | None, out: Path, progress: Progress, cells: int) -> Wall:
    """The asperities of a scene, from a given table or from its surface.

    Parameters
    ----------
    largest : largest load over the nominal area, Pa; a table that does not reach it is extended if the scene has the
        surface.
    table : path of a given table; None to compute one.
    out : path where a computed table is stored.
    cells : number of cells along a side of the film.

    Raises
    ------
    InputError
        If the table belongs to another surface or other solids or cannot be extended, or if no table of the surface
        carries the load.
    """
    surface = scene.roughness if isinstance(scene.roughness, RoughSurface) else None
    warnings: list[str] = []
    if surface is not None and not surface.read().periodic:
        mismatch = joint_mismatch(surface.read())
        if mismatch > MISMATCH_THRESHOLD:
            warnings.append(
                f"{surface.name} is not periodic (edge mismatch {mismatch:.2g}): steps at its edges restrict the flow; "
                "prepare it with roughfilm surface"
            )
    if table is not None:
        given: AsperityTable | None = AsperityTable(factors=_given(table, surface, scene))
    else:
        given = None if surface is not None else asperities_of(scene, progress)
    if given is not None and (surface is None or _capacity(scene, given, cells) >= largest):
        _check_capacity(scene, given, largest, cells)
        count = len(given.factors.points)
        source: Mapping[str, Any] = {"table": _digest(given)}
        return Wall(asperities=given, warnings=tuple(warnings), points=count, known_points=count, source=source)
    assert surface is not None
    made, known, source = _tabulated(scene, surface, given, largest, out, progress, cells)
    if given is not None:
        warnings.append(
            f"{table} has contact pressures of up to {given.largest_pressure / 1e6:.4g} MPa, too little for "
            f"{largest / 1e6:.4g} MPa over the nominal area: extended to {made.largest_pressure / 1e6:.4g} MPa"
        )
    points = len(made.factors.points)
    return Wall(asperities=made, warnings=tuple(warnings), points=points, known_points=known, source=source)


def _tabulated(
    scene: Bearing,
    surface: RoughSurface,
    given: AsperityTable | None,
    largest: float,
    out: Path,
    progress: Progress,
    cells: int,
) -> tuple[AsperityTable, int, Mapping[str, Any]]:
    """The table of the scene's surface, the number of its points that were in the file, and its source."""
    stiffness, bound = _solids(scene)
    settings = {
        "rule": FaceRule.LINEAR.value,
        "offset": 0.0,
        "mean_gap": None,
        "composite_modulus": stiffness,
        "hardness": bound if np.isfinite(bound) else None,
        "code": code(),
    }
    heights, spacing = surface.scaled_heights(), surface.scaled_spacing()
    inputs = Inputs(heights=heights, spacing=spacing, settings=settings)

    def work(known: Sequence[Point], keep: Callable[[Point], None]) -> FactorTable:
        def up_to(load: float, made: AsperityTable | None) -> AsperityTable:
            own = () if made is None else made.factors.points
            if given is None:
                return kept_asperities(
                    heights,
                    spacing,
                    stiffness,
                    bound,
                    surface=surface.name,
                    required_load=load,
                    known=own,
                    foreign=known,
                    keep=keep,
                    progress=progress,
                )
            return tabulate_pressed(
                heights,
                spacing,
                stiffness,
                hardness=bound,
                required_load=load,
                known=[*given.factors.points, *known, *own],
                keep=keep,
                threads=checked_threads(None),
                progress=progress,
            )

        made, closing = up_to(0.0, None), bound
        for _ in range(MAX_EXTENSIONS):
            capacity = _capacity(scene, made, cells)
            if capacity >= largest or closing < CLOSURE_RATIO * made.largest_pressure:
                break
            load = min(EXTENSION_FACTOR * made.largest_pressure * largest / capacity, closing)
            try:
                made = up_to(load, made)
            except InputError:  # the load closes the gap everywhere
                closing = math.sqrt(made.largest_pressure * load)
        _check_capacity(scene, made, largest, cells)
        return made.factors

    table, count = resumed_table(out, inputs, work)
    return AsperityTable(factors=table), count, {"table": inputs.digest}


def _solids(scene: Bearing) -> tuple[float, float]:
    """E* and H, Pa, of a scene with a surface; H is infinite without plasticity."""
    assert scene.asperities is not None
    assert scene.asperities.solid is not None
    return composite_modulus(scene.asperities.solid, scene.asperities.counter), hardness(scene.asperities.solid)


def _given(path: Path, surface: RoughSurface | None, scene: Bearing) -> FactorTable:
    """The stored table; raises InputError if it belongs to another surface or other solids than those of the scene."""
    table, source = load_table_and_source(path)
    if surface is None:
        return table
    (dx, dy), (stiffness, bound) = surface.scaled_spacing(), _solids(scene)
    compared = (
        ("a highest point", table.peak, surface.peak, "m"),
        ("an rms height", table.rms, surface.rms, "m"),
        ("a spacing along x", source.spacing[0], dx, "m"),
        ("a spacing along y", source.spacing[1], dy, "m"),
        ("a composite modulus", source.solids.composite_modulus or math.inf, stiffness, "Pa"),
        ("a hardness", source.solids.hardness or math.inf, bound, "Pa"),
    )
    for name, there, here, unit in compared:
        if not math.isclose(there, here, rel_tol=MATCH_TOLERANCE):
            what = "surface" if unit == "m" else "pair of solids"
            raise InputError(
                f"table {path}: belongs to another {what}, with {name} of {there:.6g} {unit}; the scene has "
                f"{here:.6g} {unit}, leave the table out or take another scene"
            )
    return table


def _capacity(scene: Bearing, asperities: AsperityTable, cells: int) -> float:
    """The load of the asperities over the nominal area at the smallest known separation, Pa."""
    film = MixedFilm(scene=scene, asperities=asperities, cells=cells)
    return film.contact_load(film.closest) / film.area


def _check_capacity(scene: Bearing, asperities: AsperityTable, largest: float, cells: int) -> None:
    """Raise InputError if the asperities cannot carry a load over the nominal area, Pa."""
    capacity = _capacity(scene, asperities, cells)
    if capacity < largest:
        raise InputError(
            f"loads: got {largest / 1e6:.6g} MPa over the nominal area; at rest the surface carries at most "
            f"{capacity / 1e6:.6g} MPa, at the end of its table; lower the load"
        )


def _digest(asperities: AsperityTable) -> str:
    rows = np.array([(one.load, one.separation, one.mean_gap) for one in asperities.factors.points])
    return Inputs(heights=rows, spacing=(1.0, 1.0), settings={}).digest


def curve_inputs(scene: Bearing, wall: Wall | None, resolution: int, **more: Any) -> Inputs:
    """The inputs of the file of curves: all entries on which they depend, and more as entries for JSON."""
    entries = {name: entry for name, entry in scene_entries(scene).items() if name != "load"}
    source = {} if wall is None else wall.source
    settings = {**_flat(entries), **source, **more, "resolution": resolution, "code": code()}
    for name in IRRELEVANT:
        settings.pop(name, None)
    if isinstance(scene.geometry, MovingWall):
        load = scene.load or BearingLoad.model_construct()
        settings |= {"angle": load.angle, "moment_x": load.moment_x, "moment_y": load.moment_y}
    return Inputs(heights=np.zeros((0, 0)), spacing=(1.0, 1.0), settings=settings)


@contextmanager
def keeping(points: dict[tuple[float, float], PointT], save: Callable[[], None]) -> Iterator[Callable[[PointT], None]]:
    """Keep each new point of a sweep beside those known, by load and speed, and save them regularly and at the end."""
    with regular_saves(save, lambda: f"stopped: {len(points)} points; the same command goes on") as save_regularly:

        def keep(point: PointT) -> None:
            points[point.pressure, point.speed] = point
            save_regularly()

        yield keep


def by_operation(points: Iterable[PointT]) -> dict[tuple[float, float], PointT]:
    """The points of a sweep by their load, Pa, and speed, m/s."""
    return {(point.pressure, point.speed): point for point in points}


def resumed_curves(
    scene: Bearing,
    speeds: Sequence[float],
    loads: Sequence[float],
    wall: Wall | None,
    out: Path,
    resolution: int,
    progress: Progress,
) -> tuple[tuple[StribeckCurve, ...], int]:
    """The Stribeck curves of a scene, and the number of their points that were in the file.

    Parameters
    ----------
    speeds, loads : sliding speeds, m/s, and loads over the nominal area, Pa.
    wall : the asperities; None of a scene without asperities.
    out : path of the file, which holds all finished points even if the sweep is stopped.
    resolution : number of cells along a side.

    Raises
    ------
    InputError
        If the file cannot be read or written, is damaged, or holds other curves; if a load cannot be carried.
    ConvergenceError
        If a film does not converge.
    """
    inputs = curve_inputs(scene, wall, resolution)
    known = known_points(out, inputs)
    points = by_operation(known)
    with keeping(points, lambda: save_points(out, inputs, tuple(points.values()))) as keep:
        curves = stribeck(
            scene,
            speeds,
            loads,
            asperities=None if wall is None else wall.asperities,
            resolution=resolution,
            known=known,
            keep=keep,
            progress=progress,
        )
    save_points(out, inputs, tuple(points.values()), curves)
    requested = by_operation(point for curve in curves for point in curve.points)
    return curves, len(requested.keys() & by_operation(known).keys())


def _flat(entries: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """The entries of nested tables by dotted keys."""
    flat: dict[str, Any] = {}
    for name, entry in entries.items():
        if isinstance(entry, dict):
            flat |= _flat(entry, f"{before}{name}.")
        else:
            flat[f"{before}{name}"] = entry
    return flat
