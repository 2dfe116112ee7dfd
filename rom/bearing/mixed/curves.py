"""A sweep of speeds and loads whose table and points stay in a directory: what was finished is found again."""

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, periodicity_mismatch
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.mixed.curves_store import known_points, save_points
from roughfilm.rom.bearing.mixed.film import MixedFilm
from roughfilm.rom.bearing.mixed.resume import EVERY_S, kept_table
from roughfilm.rom.bearing.mixed.stribeck import StribeckCurve, StribeckPoint, stribeck
from roughfilm.rom.bearing.mixed.tabulate import tabulate_pressed
from roughfilm.rom.bearing.mixed.wall import asperities_of
from roughfilm.rom.bearing.roughness import RoughSurface
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.homogenization.conductance import FaceRule
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.store import load_table_and_source
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.provenance import code
from roughfilm.rom.ladder.scene import scene_entries
from roughfilm.rom.parts.solids import composite_modulus, hardness

SAME = 1e-9
"""How near what is told of a table's surface and solids has to be to those of the scene, as a part of it."""

SPARE, TURNS = 1.3, 12
"""By how much more than is needed a table is extended, and how often at most."""

NEAR = 1.02
"""How near, as a factor, a table reaches to a load that closes the gap everywhere."""

UNCOUNTED = ("name", "motion.speed", "geometry.film", "geometry.eccentricity", "lubricant.density", "load.pressure")
"""Entries of a scene that curves do not depend on: loads and speeds take their place."""


@dataclass(frozen=True, kw_only=True)
class Wall:
    """What the asperities of a scene do, and how that is known.

    Attributes
    ----------
    asperities : over the separation.
    told : sentences: how far a table was extended, a surface that is not periodic.
    points, found : of the table, and how many of them were there already.
    source : what the table was computed from, as entries that JSON can hold.
    """

    asperities: AsperityTable
    told: tuple[str, ...]
    points: int
    found: int
    source: Mapping[str, Any]


def wall_of(scene: Bearing, largest: float, table: Path | None, out: Path, progress: Progress, cells: int) -> Wall:
    """The asperities' table: the one given, or that of the scene's surface, which is kept in ``out``.

    A table that does not reach the largest load, Pa over the nominal area, is extended, if the scene tells the surface.

    Raises
    ------
    InputError
        If the table is of another surface or of other solids, or cannot be extended; if no table of the surface
        carries the load.
    """
    surface = scene.roughness if isinstance(scene.roughness, RoughSurface) else None
    told: list[str] = []
    if surface is not None and not surface.read().periodic:
        mismatch = periodicity_mismatch(surface.read())
        if mismatch > MISMATCH_THRESHOLD:
            told.append(
                f"{surface.name} is not periodic (mismatch {mismatch:.2g}): its edges meet in steps, which throttle "
                "the flow; prepare it by roughfilm surface"
            )
    if table is not None:
        given: AsperityTable | None = AsperityTable(factors=_given(table, surface, scene))
    else:
        given = None if surface is not None else asperities_of(scene, progress)
    if given is not None and (surface is None or _carried(scene, given, cells) >= largest):
        _refuse_too_much(scene, given, largest, cells)
        known = len(given.factors.points)
        return Wall(asperities=given, told=tuple(told), points=known, found=known, source={"table": _digest(given)})
    assert surface is not None
    made, found, source = _tabulated(scene, surface, given, largest, out, progress, cells)
    if given is not None:
        told.append(
            f"{table} reaches {given.largest_pressure / 1e6:.4g} MPa of contact, too little for "
            f"{largest / 1e6:.4g} MPa over the nominal area: extended to {made.largest_pressure / 1e6:.4g} MPa"
        )
    return Wall(asperities=made, told=tuple(told), points=len(made.factors.points), found=found, source=source)


def _tabulated(
    scene: Bearing,
    surface: RoughSurface,
    given: AsperityTable | None,
    largest: float,
    out: Path,
    progress: Progress,
    cells: int,
) -> tuple[AsperityTable, int, Mapping[str, Any]]:
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
    before = () if given is None else tuple(given.factors.points)

    def at_least(reach: float, known: Sequence[Point], keep: Callable[[Point], None]) -> AsperityTable:
        return tabulate_pressed(
            heights,
            spacing,
            stiffness,
            hardness=bound,
            reach=reach,
            known=known,
            keep=keep,
            threads=checked_threads(None),
            progress=progress,
        )

    def work(known: Sequence[Point], keep: Callable[[Point], None]) -> FactorTable:
        made, most = at_least(0.0, [*before, *known], keep), bound
        for _ in range(TURNS):
            carried = _carried(scene, made, cells)
            if carried >= largest or most < NEAR * made.largest_pressure:
                break
            reach = min(SPARE * made.largest_pressure * largest / carried, most)
            try:
                made = at_least(reach, made.factors.points, keep)
            except InputError:  # so much closes the gap everywhere
                most = math.sqrt(made.largest_pressure * reach)
        _refuse_too_much(scene, made, largest, cells)
        return made.factors

    found, count = kept_table(out, inputs, work)
    return AsperityTable(factors=found), count, {"table": inputs.digest}


def _solids(scene: Bearing) -> tuple[float, float]:
    """E* and H, Pa, of a scene that tells its surface; H is infinite where nothing yields."""
    assert scene.asperities is not None
    assert scene.asperities.solid is not None
    return composite_modulus(scene.asperities.solid, scene.asperities.counter), hardness(scene.asperities.solid)


def _given(path: Path, surface: RoughSurface | None, scene: Bearing) -> FactorTable:
    """A stored table; InputError if it is not of the scene's surface and solids."""
    table, source = load_table_and_source(path)
    if surface is None:
        return table
    (dx, dy), (stiffness, bound) = surface.scaled_spacing(), _solids(scene)
    its = source.settings
    told = (
        ("a highest point", table.peak, surface.peak, "m"),
        ("an rms height", table.rms, surface.rms, "m"),
        ("a spacing along x", source.spacing[0], dx, "m"),
        ("a spacing along y", source.spacing[1], dy, "m"),
        ("a composite modulus", its.get("composite_modulus") or math.inf, stiffness, "Pa"),
        ("a hardness", its.get("hardness") or math.inf, bound, "Pa"),
    )
    for name, there, here, unit in told:
        if not math.isclose(there, here, rel_tol=SAME):
            what = "surface" if unit == "m" else "pair of solids"
            raise InputError(
                f"table {path}: is of another {what}, with {name} of {there:.6g} {unit}, where the scene has "
                f"{here:.6g} {unit}; leave the table out, or take another scene"
            )
    return table


def _carried(scene: Bearing, asperities: AsperityTable, cells: int) -> float:
    """What the asperities alone carry where the walls are closest, Pa over the nominal area."""
    film = MixedFilm(scene=scene, asperities=asperities, cells=cells)
    return film.contact_load(film.closest) / film.area


def _refuse_too_much(scene: Bearing, asperities: AsperityTable, largest: float, cells: int) -> None:
    carried = _carried(scene, asperities, cells)
    if carried < largest:
        raise InputError(
            f"loads: got {largest / 1e6:.6g} MPa over the nominal area; at rest the surface carries at most "
            f"{carried / 1e6:.6g} MPa, where its table ends; lower the load"
        )


def _digest(asperities: AsperityTable) -> str:
    rows = np.array([(one.load, one.separation, one.mean_gap) for one in asperities.factors.points])
    return Inputs(heights=rows, spacing=(1.0, 1.0), settings={}).digest


def swept(
    scene: Bearing,
    speeds: Sequence[float],
    loads: Sequence[float],
    wall: Wall,
    out: Path,
    resolution: int,
    progress: Progress,
) -> tuple[tuple[StribeckCurve, ...], int]:
    """The curves, and how many of their points were in the file; what was finished is kept whenever this ends.

    Raises
    ------
    InputError
        If the file cannot be read or written, was damaged, or holds other curves; if a load cannot be carried.
    ConvergenceError
        If a film does not come into balance.
    """
    settings = {**_flat(scene_entries(scene)), **wall.source, "resolution": resolution, "code": code()}
    for name in UNCOUNTED:
        settings.pop(name, None)
    inputs = Inputs(heights=np.zeros((0, 0)), spacing=(1.0, 1.0), settings=settings)
    known = known_points(out, inputs)
    found = {(point.pressure, point.speed): point for point in known}
    kept = time.monotonic()

    def keep(point: StribeckPoint) -> None:
        nonlocal kept
        found[point.pressure, point.speed] = point
        if time.monotonic() - kept > EVERY_S:
            save_points(out, inputs, tuple(found.values()))
            kept = time.monotonic()

    try:
        curves = stribeck(
            scene,
            speeds,
            loads,
            asperities=wall.asperities,
            resolution=resolution,
            known=known,
            keep=keep,
            progress=progress,
        )
    except ConvergenceError:
        save_points(out, inputs, tuple(found.values()))
        raise
    except (KeyboardInterrupt, SystemExit) as stop:
        save_points(out, inputs, tuple(found.values()))
        stop.add_note(f"stopped: {len(found)} points; the same command goes on")
        raise
    save_points(out, inputs, tuple(found.values()), curves)
    asked = {(point.pressure, point.speed) for curve in curves for point in curve.points}
    return curves, len(asked & {(point.pressure, point.speed) for point in known})


def _flat(entries: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """Entries of nested tables by their dotted keys."""
    flat: dict[str, Any] = {}
    for name, entry in entries.items():
        if isinstance(entry, dict):
            flat |= _flat(entry, f"{before}{name}.")
        else:
            flat[f"{before}{name}"] = entry
    return flat
