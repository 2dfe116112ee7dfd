"""Curves of a bearing and of a seal, over speed and load, and the effects in a bearing one by one."""

import os
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path

from roughfilm import ladder
from roughfilm.contact.foundation.arrays import finite_arithmetic
from roughfilm.contact.foundation.errors import InputError, unwritable
from roughfilm.contact.foundation.ranges import in_range, whole_in_range
from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.interface.cells import CheckedWindows, Windows, checked_windows, scenes_with
from roughfilm.interface.rows import Rows
from roughfilm.rom.bearing.dynamics import sweep
from roughfilm.rom.bearing.effects.analysis import EffectAnalysis, analyse_effects
from roughfilm.rom.bearing.mixed import stribeck as mixed
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.rom.seal.leakage.curve import chosen_loads, columns_of, seal_setup, sealing, solved
from roughfilm.rom.seal.leakage.percolation import Threshold
from roughfilm.rom.seal.leakage.windows import SealOfWindows, columns_of_windows
from roughfilm.rom.seal.scene import Seal

WIDE_CELLS, CELLS = 1024, 128
"""Default cells along the sliding of infinitely wide bearings and of others."""

FEWEST_CELLS, MOST_WIDE_CELLS, MOST_CELLS = 16, 65_536, 1024


def stribeck(
    scene: Scene,
    speeds: Sequence[float],
    loads: Sequence[float] | None = None,
    *,
    windows: Windows | None = None,
    resolution: int = mixed.RESOLUTION,
    processes: int = 1,
    progress: Progress = silent,
) -> tuple[mixed.StribeckCurve, ...]:
    """Compute Stribeck curves, friction and film over speed at given loads, of a bearing.

    At each speed u the separation of the walls is computed at which the film and the asperities together carry the
    load, W = W_film + W_contact. The friction coefficient is (F_film + μ W_contact)/W. Without asperities the film
    carries the load alone, and speeds at which none does are left out. If the lubricant has ``thermoviscosity``,
    ``density`` and ``heat_capacity``, each film has the one temperature at which its heat is balanced;
    ``scene.isothermal()`` is the scene without temperature.

    Parameters
    ----------
    scene : a bearing; its own speed and film are ignored.
    speeds : speeds u of the sliding wall, m/s, 0 or more, without asperities above 0.
    loads : mean pressures over the nominal area, Pa; by default the load of the scene.
    windows : several windows in place of the surface of the scene, as :func:`roughfilm.windows` returns them, or a list
        of surfaces.
    resolution : number of cells along and across the bearing, 16 to 1024.
    processes : number of processes that solve windows; 1 is this process.
    progress : called with the done fraction and a few words.

    Returns
    -------
    tuple of StribeckCurve
        One curve for each load. Its ``points`` hold ``speed``, ``friction_coefficient``, ``separation``,
        ``contact_share`` (contact load over load) and ``uncertainty`` where it was estimated; ``lift_off`` is the
        speed, m/s, above which the film alone carries the load. With ``windows`` the values are those of a wall that
        has all of them; points also have ``scatter``, the half width of the 95 % confidence interval from how the
        windows differ, by quantity, and ``window_interval``, the 95 % interval for a wall that repeats one window.

    Raises
    ------
    InputError
        For another kind of scene, speeds and loads out of range, or no loads where the scene has none.
    ConvergenceError
        If no separation balances the load.

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
        raise InputError(f"scene: got {_kind(scene)}; give a bearing")
    own = scene.load_pressure
    if loads is None and own is None:
        raise InputError("loads: are missing; give them, or a scene with a load")
    given = [own] if loads is None and own is not None else [in_range("loads", load, "Pa") for load in loads or ()]
    wanted = [in_range("speeds", speed, "m/s", zero=True) for speed in speeds]
    if windows is not None:
        from roughfilm.sampling.stribeck import curves_over_windows, rough_bearing  # multiprocessing is slow to import

        cells = checked_windows(windows)
        with (
            finite_arithmetic("stribeck"),
            scenes_with(rough_bearing(scene), "roughness.surface", cells) as scenes,
            scratch_directory() as place,
        ):
            curves, _, _ = curves_over_windows(
                [rough_bearing(one) for one in scenes],
                [Path(place) / f"{number}" for number in range(len(scenes))],
                wanted,
                given,
                cells.independent,
                Path(place) / "stribeck.h5",
                resolution=resolution,
                processes=processes,
                progress=progress,
            )
        return curves
    with finite_arithmetic("stribeck"):
        return mixed.stribeck(scene, wanted, given, resolution=resolution, progress=progress)


def dynamics(
    scene: Scene,
    speeds: Sequence[float],
    loads: Sequence[float] | None = None,
    *,
    resolution: int = sweep.RESOLUTION,
    frequency_ratio: float = 1.0,
    mass: float | None = None,
    progress: Progress = silent,
) -> tuple[sweep.DynamicCurve, ...]:
    """Compute equilibrium, stiffness and damping of a bearing over speed, and the stability of its rotor.

    The film exerts the force δF = -K δq - B δq' on a shaft that moves by δq = (δx, δy) from its equilibrium. A rigid
    rotor is stable up to the critical mass M in the bearing; above it, it whirls at the frequency ν with

        Mν² = k = (Kxx Byy + Kyy Bxx - Kxy Byx - Kyx Bxy)/(Bxx + Byy),
        ν² = ((Kxx - k)(Kyy - k) - Kxy Kyx)/det B,

    where K and B are those of motions of this frequency: cavities follow them with a delay.

    If the lubricant has ``thermoviscosity``, ``density`` and ``heat_capacity``, each film has the one temperature at
    which its heat is balanced, and K and B are those of motions at this temperature, which changes much slower than a
    rotor vibrates; ``scene.isothermal()`` is the scene without temperature.

    Parameters
    ----------
    scene : a bearing whose shaft or pad moves freely; its eccentricity is ignored, and its speed gives the direction.
    speeds : speeds of the sliding wall, m/s, above 0.
    loads : mean pressures over the nominal area, Pa; by default the load of the scene.
    resolution : number of cells along the film, 32 to 512; half as many are across.
    frequency_ratio : frequency of the motion over that of the rotation, of stiffness and damping: cavities, and pads
        that tilt, without mass, follow the shaft with a delay; 0, slow motions, to 10.
    mass : mass of a rotor in the bearing, kg, whose onset of instability is sought; by default that of the scene.
    progress : called with the done fraction and a few words.

    Returns
    -------
    tuple of DynamicCurve
        One curve for each load. Its ``points`` have ``stiffness`` and ``damping``, arrays of N/m and N s/m whose rows
        are forces, and quantities by their names, ``point["whirl_ratio"]``, ``point["critical_mass"]``,
        ``point["eccentricity"]``, with a temperature ``point["temperature"]`` and ``point["outlet_temperature"]``, °C,
        and of walls with asperities ``point["contact_share"]``, with uncertainties from two coarser grids, and from
        flow factors and contact pressures. Speeds without an equilibrium are in ``omitted``;
        ``onset`` is the rotational speed, rad/s, at which the rotor of a mass becomes unstable.

    Raises
    ------
    InputError
        For another kind of scene or shape, numbers out of range, no loads where the scene has none, or a load that no
        speed carries.
    ConvergenceError
        If no film converges.

    References
    ----------
    J. W. Lund, J. Tribology 109 (1987) 37-41, doi:10.1115/1.3261324.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/grooved_journal.toml")
    >>> (curve,) = rf.dynamics(scene, speeds=[5.0, 20.0], resolution=32)
    >>> slow, fast = curve.points
    >>> slow.stiffness.shape, slow["critical_mass"].value > fast["critical_mass"].value
    ((2, 2), True)
    """
    if not isinstance(scene, Bearing):
        raise InputError(f"scene: got {_kind(scene)}; give a bearing")
    scene = sweep.free_bearing(scene)
    own = scene.load_pressure
    if loads is None and own is None:
        raise InputError("loads: are missing; give them, or a scene with a load")
    given = [own] if loads is None and own is not None else [in_range("loads", load, "Pa") for load in loads or ()]
    with finite_arithmetic("dynamics"):
        return sweep.dynamics(
            scene,
            [in_range("speeds", speed, "m/s") for speed in speeds],
            given,
            resolution=whole_in_range("resolution", resolution, sweep.MIN_CELLS, sweep.MAX_CELLS),
            frequency_ratio=frequency_ratio,
            mass=sweep.mass_of(scene) if mass is None else mass,
            progress=progress,
        )


@dataclass(frozen=True, kw_only=True)
class LeakageCurve:
    """Leakage of a seal over the load.

    Attributes
    ----------
    rows : one dict from column to number for each load, as pandas.DataFrame accepts them; ``rows.units`` has the units.
    sealing : by method and direction, the load, Pa, and the contact area fraction at which the seal closes; empty for
        several windows.
    windows : the seal over several windows, with the distribution of their sealing loads; None for one surface.
    """

    rows: Rows
    sealing: Mapping[str, Threshold]
    windows: SealOfWindows | None = None


def leakage_curve(
    scene: Scene,
    loads: Sequence[float] | None = None,
    *,
    windows: Windows | None = None,
    directory: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    processes: int = 1,
    progress: Progress = silent,
) -> LeakageCurve:
    """Compute the leakage of a seal in x and y over the load, with the flow solved directly and homogenized.

    The mass flow per width is q = ρ K Δp/(12 η L), kg/(s m), with the density ρ, the viscosity η, the pressure drop Δp
    over the length L, and the permeability K, m³, of the gap under load; a smooth gap h has K = h³.

    Parameters
    ----------
    scene : a scene of kind "seal".
    loads : mean pressures over the nominal area, Pa; the default is a series from light contact to the sealed gap.
    windows : several windows in place of the surface of the scene, as :func:`roughfilm.windows` returns them, or a list
        of surfaces.
    directory : directory of the contacts and rows, from which a stopped series continues; by default nothing is kept.
    threads : number of gaps whose flow is solved at the same time; by default 2, or 1 on a machine with one core.
    processes : number of processes that solve windows; 1 is this process.
    progress : called with the done fraction and a few words.

    Returns
    -------
    LeakageCurve
        ``rows`` with "load" (Pa), "area_fraction", "mean_gap" (m), permeabilities "direct_x", ... (m³) with
        "direct_x_uncertainty", and "leakage_direct_x", ... (kg/(m s)); ``sealing`` with the
        loads at which the gap seals. With ``windows`` the rows are means over them, as a seal of very many windows
        beside each other has; "direct_x_scatter" is the half width of their 95 % confidence interval, and
        "direct_x_window_low" and "direct_x_window_high" are the ends of the 95 % interval for one window.

    Raises
    ------
    InputError
        For another kind of scene, a load out of range, or a directory that cannot be used.
    ConvergenceError
        If the contact at a load does not converge; the directory keeps the loads below it.

    References
    ----------
    F. Sahlin, Lubrication, contact mechanics and leakage between rough surfaces, Luleå 2008, paper F.

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
    asked = None if loads is None else tuple(sorted(in_range("loads", load, "Pa") for load in loads))
    if asked is not None and (not asked or asked[-1] > scene.hardness):
        raise InputError(f"loads: got {asked!r:.60}; give at least one, up to the hardness of {scene.hardness:g} Pa")
    kept = nullcontext(directory) if directory is not None else scratch_directory()
    with finite_arithmetic("leakage_curve"), kept as place:
        try:
            Path(place).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise unwritable(f"directory: {place}", error, done="made") from error
        if windows is not None:
            return _leakage_of_windows(
                scene, checked_windows(windows), asked, Path(place), checked_threads(threads), processes, progress
            )
        body = seal_setup(scene, Path(place))
        found = sealing(body, lambda done, words: progress(0.2 * done, words))
        series = chosen_loads(body, found) if asked is None else asked
        pressed, _ = solved(
            body, series, checked_threads(threads), lambda done, words: progress(0.2 + 0.8 * done, words)
        )
    return LeakageCurve(rows=_rows(columns_of(scene, list(pressed.values()))), sealing=found)


def _leakage_of_windows(
    scene: Seal,
    windows: CheckedWindows,
    loads: tuple[float, ...] | None,
    directory: Path,
    threads: int,
    processes: int,
    progress: Progress,
) -> LeakageCurve:
    """The leakage over several windows, whose results are kept in subdirectories."""
    from roughfilm.sampling.leakage import leakage_of_windows  # multiprocessing is slow to import

    with scenes_with(scene, "geometry.surface", windows) as scenes:
        seals = [one for one in scenes if isinstance(one, Seal)]
        seal, _ = leakage_of_windows(
            seals,
            [directory / f"{number + 1:04d}" for number in range(len(seals))],
            loads,
            windows.independent,
            processes=processes,
            threads=threads,
            progress=progress,
        )
    return LeakageCurve(rows=_rows(columns_of_windows(scene, seal)), sealing={}, windows=seal)


def _rows(columns: Mapping[str, tuple[str, list[float]]]) -> Rows:
    """The rows of columns with their units."""
    rows = Rows()
    rows.units = {name: unit for name, (unit, _) in columns.items()}
    for numbers in zip(*(values for _, values in columns.values()), strict=True):
        rows.append(dict(zip(columns, numbers, strict=True)))
    return rows


def effects(scene: Scene, *, resolution: int | None = None, progress: Progress = silent) -> EffectAnalysis:
    """Compute the contribution of each effect in a bearing to load, friction, flow and film.

    Parameters
    ----------
    scene : a bearing; if it has a load, the effects under this load are analysed too.
    resolution : number of cells along and across; by default 128, or 1024 for an infinitely wide bearing.
    progress : called with the done fraction and a few words.

    Returns
    -------
    EffectAnalysis
        ``at_film.contributions`` holds for each effect, by quantity, the change when it is added after the effects
        before it (``on``) and when it is added to all others (``alone``), each with its uncertainty. ``under_load``
        holds the same at the load; it is None without a load.

    Raises
    ------
    InputError
        For another kind of scene, or a resolution out of range.
    ConvergenceError
        If no film carries the load.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/parabolic_slider.toml")
    >>> [one.name for one in rf.effects(scene, resolution=64).at_film.contributions]
    ['cavitation', 'pressure dependence']
    """
    if not isinstance(scene, Bearing):
        raise InputError(f"scene: got {_kind(scene)}; give a bearing")
    with finite_arithmetic("effects"):
        return analyse_effects(scene, checked_cells(scene, resolution), ladder.models(), progress)


def checked_cells(scene: Bearing, resolution: int | None) -> int:
    """The number of cells along a side for an analysis of effects; InputError if it is out of range."""
    most = MOST_WIDE_CELLS if scene.wide else MOST_CELLS
    cells = (WIDE_CELLS if scene.wide else CELLS) if resolution is None else resolution
    if isinstance(cells, bool) or not isinstance(cells, int) or not FEWEST_CELLS <= cells <= most:
        raise InputError(f"resolution: got {cells}; it must be {FEWEST_CELLS} to {most} cells along a side")
    return cells


def _kind(scene: object) -> str:
    return f"a scene of kind {scene.kind!r}" if isinstance(scene, Scene) else type(scene).__name__
