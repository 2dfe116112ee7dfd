"""Curves over speed and load: Stribeck curves, leakage of a seal; and the effects of a bearing one by one."""

import os
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path

from roughfilm import ladder
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.mechanics.checks import not_negative, positive
from roughfilm.interface.rows import Rows
from roughfilm.rom.bearing.effects.analysis import EffectAnalysis, analyse_effects
from roughfilm.rom.bearing.mixed import stribeck as mixed
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.rom.seal.leakage.curve import chosen_loads, columns_of, seal_setup, sealing, solved
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.scene import Seal

WIDE_CELLS, CELLS = 1024, 128
"""Default cells along the sliding of infinitely wide bearings and of others."""

FEWEST_CELLS, MOST_WIDE_CELLS, MOST_CELLS = 16, 65_536, 1024


def stribeck(
    scene: Scene,
    speeds: Sequence[float],
    loads: Sequence[float],
    *,
    resolution: int = mixed.RESOLUTION,
    progress: Progress = silent,
) -> tuple[mixed.StribeckCurve, ...]:
    """Compute Stribeck curves of a bearing whose rough walls may touch: friction and film over speed at each load.

    At each speed u the separation is found at which film and asperities carry the load, W = W_film + W_contact; the
    friction coefficient is (F_film + μ W_contact)/W.

    Parameters
    ----------
    scene : a bearing with roughness and asperities; its own speed, film and load do not count.
    speeds : of the sliding wall, m/s, 0 or more.
    loads : mean pressures over the nominal area, Pa.
    resolution : cells along and across, 16 to 1024.
    progress : called with the done fraction and a few words.

    Returns
    -------
    tuple of StribeckCurve
        One for each load: its ``points`` with ``speed``, ``friction_coefficient``, ``separation``, ``contact_share``
        and their ``uncertainty`` where it was estimated, and the ``lift_off`` speed.

    Raises
    ------
    InputError
        For a scene without asperities, or speeds and loads out of range.
    ConvergenceError
        If a film does not come into balance.

    References
    ----------
    F. Sahlin, Luleå 2008, paper E; doi:10.1016/j.triboint.2007.02.021.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/rough_washer.toml", set={
    ...     "roughness.surface.points": [24, 24], "roughness.surface.correlation_length": "0.4 mm",
    ...     "roughness.surface.anisotropy": 1})
    >>> (curve,) = rf.stribeck(scene, speeds=[0.01, 10.0], loads=[1e6], resolution=16)
    >>> slow, fast = curve.points
    >>> slow.friction_coefficient > fast.friction_coefficient, slow.contact_share > fast.contact_share
    (True, True)
    """
    if not isinstance(scene, Bearing):
        raise InputError(f"scene: got {_kind(scene)}; give a bearing with roughness and asperities")
    return mixed.stribeck(
        scene,
        [not_negative("speeds", speed) for speed in speeds],
        [positive("loads", load) for load in loads],
        resolution=resolution,
        progress=progress,
    )


@dataclass(frozen=True, kw_only=True)
class LeakageCurve:
    """Leakage of a seal over the load.

    Attributes
    ----------
    rows : one for each load: a dict from column to number, ready for pandas.DataFrame; ``rows.units`` has the units.
    sealing : by direction and method, the load, Pa, and contact area at which the seal closes.
    """

    rows: Rows
    sealing: Mapping[str, Threshold]


def leakage_curve(
    scene: Scene,
    loads: Sequence[float] | None = None,
    *,
    directory: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    progress: Progress = silent,
) -> LeakageCurve:
    """Press a seal at a series of loads and compute its leakage along x and y, directly and homogenized.

    The mass flow per width is q = ρ K Δp/(η L) with the permeability K, m³, of the deformed gap.

    Parameters
    ----------
    scene : of kind "seal".
    loads : mean pressures over the nominal area, Pa; by default from light contact until it is sealed.
    directory : where contacts and rows are kept, so that a stopped series goes on; nothing is kept by default.
    threads : gaps whose flow is solved at once; two by default where there are two cores.
    progress : called with the done fraction and a few words.

    Returns
    -------
    LeakageCurve
        ``rows`` with "load" (Pa), "area_fraction", "mean_gap" (m), permeabilities "direct_x", ... (m³) with
        "direct_x_uncertainty", and "leakage_direct_x", ... (kg/(m s)); and where it is ``sealing``.

    Raises
    ------
    InputError
        For another kind of scene, a load out of range, or a directory that cannot be used.
    ConvergenceError
        If a contact does not converge; loads below it stay in the directory.

    References
    ----------
    F. Sahlin, Luleå 2008, paper F.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/seal.toml")
    >>> curve = rf.leakage_curve(scene, loads=[1e4, 1e5])
    >>> light, heavy = curve.rows
    >>> light["leakage_direct_x"] > heavy["leakage_direct_x"], curve.rows.units["leakage_direct_x"]
    (True, 'kg/(m*s)')
    """
    if not isinstance(scene, Seal):
        raise InputError(f"scene: got {_kind(scene)}; give a scene of kind 'seal'")
    asked = None if loads is None else tuple(sorted(positive("loads", load) for load in loads))
    if asked is not None and (not asked or asked[-1] > scene.hardness):
        raise InputError(f"loads: got {asked!r:.60}; give at least one, up to the hardness of {scene.hardness:g} Pa")
    with nullcontext(directory) if directory is not None else tempfile.TemporaryDirectory() as place:
        try:
            Path(place).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"directory: {place} cannot be made ({error.strerror}); choose another place") from error
        body = seal_setup(scene, Path(place))
        found = sealing(body, lambda done, words: progress(0.2 * done, words))
        series = chosen_loads(body, found) if asked is None else asked
        pressed, _ = solved(
            body, series, checked_threads(threads), lambda done, words: progress(0.2 + 0.8 * done, words)
        )
    rows = Rows()
    columns = columns_of(scene, list(pressed.values()))
    rows.units = {name: unit for name, (unit, _) in columns.items()}
    for numbers in zip(*(values for _, values in columns.values()), strict=True):
        rows.append(dict(zip(columns, numbers, strict=True)))
    return LeakageCurve(rows=rows, sealing=found)


def effects(scene: Scene, *, resolution: int | None = None, progress: Progress = silent) -> EffectAnalysis:
    """Switch the effects of a bearing on one at a time: what each adds to load, friction, flow and film.

    Parameters
    ----------
    scene : a bearing; with a load its effects under that load are analysed too.
    resolution : cells along and across; 128 by default, 1024 of an infinitely wide bearing.
    progress : called with the done fraction and a few words.

    Returns
    -------
    EffectAnalysis
        ``at_film.contributions``: for each effect, by quantity, what it adds when switched on after the ones before it
        (``on``) and to all the others (``alone``), each with uncertainty; ``under_load`` likewise, None without a load.

    Raises
    ------
    InputError
        For another kind of scene, or a resolution out of range.
    ConvergenceError
        If a film does not come into balance.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/parabolic_slider.toml")
    >>> [one.name for one in rf.effects(scene, resolution=64).at_film.contributions]
    ['cavitation', 'pressure dependence']
    """
    if not isinstance(scene, Bearing):
        raise InputError(f"scene: got {_kind(scene)}; give a bearing")
    return analyse_effects(scene, checked_cells(scene, resolution), ladder.models(), progress)


def checked_cells(scene: Bearing, resolution: int | None) -> int:
    """Cells along a side for an analysis of effects; InputError if they are out of range."""
    most = MOST_WIDE_CELLS if scene.wide else MOST_CELLS
    cells = (WIDE_CELLS if scene.wide else CELLS) if resolution is None else resolution
    if isinstance(cells, bool) or not isinstance(cells, int) or not FEWEST_CELLS <= cells <= most:
        raise InputError(f"resolution: got {cells}; it must be {FEWEST_CELLS} to {most} cells along a side")
    return cells


def _kind(scene: object) -> str:
    return f"a scene of kind {scene.kind!r}" if isinstance(scene, Scene) else type(scene).__name__
