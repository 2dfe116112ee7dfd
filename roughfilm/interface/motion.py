"""Bearings in time."""

import os

from roughfilm.contact.foundation.arrays import finite_arithmetic
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.regular import named_path
from roughfilm.rom.bearing.march.solve import CELLS, ERROR, March, march_bearing
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Progress, silent


def march(
    scene: Scene,
    end: float | None = None,
    *,
    error: float = ERROR,
    steps: int | None = None,
    cells: tuple[int, int] = CELLS,
    fields: int = 0,
    uncertainty: bool = True,
    file: str | os.PathLike[str] | None = None,
    progress: Progress = silent,
) -> March:
    """March a bearing in time, under loads and speeds that change.

    The film, ∂(θh)/∂t + (u/2) ∂(θh)/∂x - ∇·(θh³/12η ∇p) = 0, and the body, M q̈ = F + W(t), are solved together at every
    step; steps have second order in time. The scene gives speed, load or path over time in ``[motion.over_time]``, and
    mass, unbalance, inertia and start in ``[body]``.

    Parameters
    ----------
    scene : a bearing of any shape but "journal": shafts in lobes, pads, sectors and washers, also about a pivot.
    end : last time, s; by default that of the table, five of its periods, or 20 turns.
    error : largest error of a step over the motion in the longest one, up to 1.
    steps : number of equal steps, in place of steps by their error.
    cells : cells along and across, 8 to 512 each.
    fields : number of times, evenly spaced, at which fields are kept.
    uncertainty : whether two marches on a coarser grid give the uncertainty.
    file : HDF5 file of the steps, from which a stopped march goes on; by default nothing is kept.
    progress : called with the done fraction and a few words.

    Returns
    -------
    March
        ``time`` and numbers of every step, ``march["film_min"]``, whose units are ``march.series.units``;
        ``quantities`` holds extremes and means with uncertainties from ``first`` to ``last``, the last period or all of
        the time; ``state`` says how the march ends, and ``settled`` whether the last two periods agree.

    Raises
    ------
    InputError
        For another scene, or an option out of range.
    ConvergenceError
        If the walls touch, or a step does not converge.

    References
    ----------
    Elrod 1981, doi:10.1115/1.3251669.

    Examples
    --------
    >>> import roughfilm as rf
    >>> scene = rf.load_scene("scripts/examples/scenes/unbalanced_rotor.toml")
    >>> march = rf.march(scene, end=0.02, cells=(24, 8), uncertainty=False)
    >>> bool(march["film_min"].min() > 0), march.series.units["film_min"]
    (True, 'm')
    """
    if not isinstance(scene, Bearing):
        got = f"a scene of kind {scene.kind!r}" if isinstance(scene, Scene) else type(scene).__name__
        raise InputError(f"scene: got {got}; give a bearing")
    if not isinstance(uncertainty, bool):
        raise InputError(f"uncertainty: got {repr(uncertainty)[:60]}; give True or False")
    with finite_arithmetic("march"):
        return march_bearing(
            scene,
            end=end,
            error=error,
            steps=steps,
            cells=cells,
            fields=fields,
            uncertain=uncertainty,
            path=None if file is None else named_path("file", file),
            progress=progress,
        )
