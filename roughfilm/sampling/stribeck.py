"""Stribeck curves of a bearing whose roughness is known in several windows."""

from collections.abc import Sequence
from pathlib import Path

from roughfilm.batch.each import for_each
from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.mixed.curves import Wall, curve_inputs, resumed_curves
from roughfilm.rom.bearing.mixed.store import save_points
from roughfilm.rom.bearing.mixed.stribeck import StribeckCurve
from roughfilm.rom.bearing.mixed.windows import common_wall, curves_of_windows, window_curves
from roughfilm.rom.bearing.roughness import RoughSurface
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Progress


def rough_bearing(scene: Scene) -> Bearing:
    """The scene, if it is a bearing with a surface as its roughness; InputError otherwise."""
    if not isinstance(scene, Bearing):
        raise InputError(f"scene.kind: got {scene.kind!r}; curves over speed are those of a bearing")
    if not isinstance(scene.roughness, RoughSurface):
        raise InputError("scene.roughness: has no surface whose place windows can take; give kind = 'surface'")
    return scene


def _without_flash(scene: Bearing) -> Bearing:
    """The bearing without the estimate of flash temperatures, which is that of the spots of one surface."""
    if scene.asperities is None or scene.asperities.solid_heat is None:
        return scene
    asperities = scene.asperities.model_copy(update={"solid_heat": None, "counter_heat": None})
    return scene.model_copy(update={"asperities": asperities})


def curves_over_windows(
    scenes: Sequence[Bearing],
    places: Sequence[Path],
    speeds: Sequence[float],
    loads: Sequence[float],
    independent: float,
    stored: Path,
    *,
    resolution: int,
    processes: int,
    progress: Progress,
) -> tuple[tuple[StribeckCurve, ...], Wall | None, int]:
    """The curves over all windows with their scatter, the wall that has all of them, and the number of known points.

    Flash temperatures, of the spots of one surface, are left out.

    Parameters
    ----------
    scenes : the bearing with each window as its surface.
    places : directory of the files of each window.
    speeds, loads : sliding speeds, m/s, and loads over the nominal area, Pa.
    independent : effective number of independent windows.
    stored : file of the points of the wall with all windows, from which a stopped sweep continues.
    resolution : number of cells along a side.
    processes : number of processes.
    progress : called with the done fraction and a few words.

    Raises
    ------
    InputError
        If a file cannot be read or written, is damaged, or holds other curves; if a load cannot be carried.
    ConvergenceError
        If a film does not converge.
    """
    scenes = [_without_flash(scene) for scene in scenes]
    windows = for_each(
        window_curves,
        [(scene, place, speeds, loads, resolution) for scene, place in zip(scenes, places, strict=True)],
        processes,
        lambda done, words: progress(0.8 * done, words),
        "windows",
    )
    wall, known = common_wall(windows), min(window.known for window in windows)
    if wall is None:
        whole, inputs = None, curve_inputs(scenes[0], None, resolution, windows=len(scenes))
    else:
        inputs = curve_inputs(scenes[0], wall, resolution)
        whole, known = resumed_curves(
            scenes[0], speeds, loads, wall, stored, resolution, lambda done, words: progress(0.8 + 0.2 * done, words)
        )
    curves = curves_of_windows(whole, windows, independent)
    save_points(stored, inputs, [point for curve in curves for point in curve.points], curves)
    return curves, wall, known
