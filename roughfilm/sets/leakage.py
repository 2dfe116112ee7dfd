"""The leakage of a seal whose surface is known in several windows."""

from collections.abc import Sequence
from pathlib import Path

from roughfilm.batch.each import for_each
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.seal.leakage.windows import (
    SealOfWindows,
    SealWindow,
    common_loads,
    seal_of_windows,
    window_leakage,
    window_thresholds,
)
from roughfilm.rom.seal.scene import Seal


def leakage_of_windows(
    scenes: Sequence[Seal],
    places: Sequence[Path],
    loads: tuple[float, ...] | None,
    independent: float,
    *,
    processes: int,
    threads: int,
    progress: Progress,
) -> tuple[SealOfWindows, list[SealWindow]]:
    """The seal over all windows, and each window on its own, at common loads.

    Parameters
    ----------
    scenes : the seal with each window as its surface.
    places : directory of the files of each window.
    loads : mean pressures, Pa, in increasing order; None for a series from light contact of the first window to where
        the last one seals, and the load of the scene.
    independent : effective number of independent windows.
    processes, threads : number of processes, and of gaps whose flow one solves at the same time.
    progress : called with the done fraction and a few words.

    Raises
    ------
    InputError
        If a file of a window was damaged, holds other data or cannot be written.
    ConvergenceError
        If the contact of a window does not converge; finished loads are kept.
    """
    pairs = [*zip(scenes, places, strict=True)]
    own = scenes[0].load.pressure
    thresholds = for_each(
        window_thresholds, pairs, processes, lambda done, words: progress(0.3 * done, words), "sealing loads"
    )
    series = loads or tuple(sorted({own, *common_loads(*pairs[0], thresholds)}))
    load = own if own in series else series[-1]
    windows = for_each(
        window_leakage,
        [(*pair, series, load, threads) for pair in pairs],
        processes,
        lambda done, words: progress(0.3 + 0.7 * done, words),
        "windows",
    )
    return seal_of_windows(scenes[0], windows, scenes[0].surface().size, independent), windows
