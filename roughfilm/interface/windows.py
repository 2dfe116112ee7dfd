"""Many windows of a measured surface, or seeds of a described one: scatter, effect of their size, and number."""

import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from roughfilm.batch.executors import MOST_PROCESSES, workers
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.ranges import in_range, whole_in_range
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.contact.surfaces import files
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.checks import number_between
from roughfilm.interface.recipes import steps_of
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Progress, silent
from roughfilm.sampling.answer import Answer, answer_of
from roughfilm.sampling.asked import Asked, asked_of
from roughfilm.sampling.plan import COUNT, planned
from roughfilm.sampling.run import examined

TOLERANCES = math.nextafter(0.0, 1.0), math.nextafter(1.0, 0.0)
"""Smallest and largest tolerance of a mean."""


def windows(
    surface: Surface | str | Path,
    scene: Scene | str | Path | None = None,
    *,
    count: int = COUNT,
    size: float | None = None,
    sizes: Sequence[float] | None = None,
    recipe: str | Path | Mapping[str, Any] | None = None,
    gap: float | None = None,
    sealing: bool = False,
    tolerance: float = 0.05,
    processes: int = 1,
    progress: Progress = silent,
) -> Answer:
    """Take many windows of a surface, compute the quantities of each, and say how they scatter.

    With the mean x̄ and the deviation s over windows that are worth nₑ independent ones, the mean is known to ± t s/√nₑ
    and a further window lies within x̄ ± t s √(1 + 1/nₑ), both with 95 %; positive quantities are those of their
    logarithms or cube roots. The mean over windows of several sides L is extrapolated to the whole surface by a + b/L.

    Parameters
    ----------
    surface : measured surface or its file, or the TOML file of a description, whose seeds are varied.
    scene : a dry contact, a seal, or a bearing with a roughness of the kind surface, or its file; each window replaces
        its surface. Without one the roughness parameters are computed.
    count : number of windows, or seeds, of each size.
    size : side of the largest windows, m; by default five decay lengths Sal or, if it is more, the side of the largest
        squares of which ``count`` fit, up to half of the measurement; for a description its size.
    sizes : further sides, m, none if empty; by default a half and a quarter of ``size``.
    recipe : TOML file or nested entries of the preparation, as for :func:`roughfilm.prepare`; windows keep the pixels
        of the measurement by default.
    gap : mean gap, m, at which flow factors are added without a scene.
    sealing : whether the load is sought at which each window of a seal closes.
    tolerance : relative tolerance of the mean for which ``needed`` counts windows.
    processes : number of processes; 1 computes in this one.
    progress : called with the done fraction and a few words.

    Returns
    -------
    Answer
        Its ``quantities`` by name have ``scatter`` (``values``, ``mean``, ``mean_uncertainty``, ``interval``),
        ``numerical`` (uncertainty by the grids), ``trend`` (``limit`` of the whole surface, ``part`` due to the size)
        and ``needed`` (number of independent windows). ``independent`` is nₑ, ``cells`` are the periodic cells of the
        largest windows, and ``warnings`` are sentences.

    Raises
    ------
    InputError
        If an argument is out of range, a window cannot be prepared, or none has an answer for such a reason.
    ConvergenceError
        If no window has an answer.

    Notes
    -----
    Below three independent windows no interval is given, and where Sq still grows with the window nothing is
    extrapolated.

    Examples
    --------
    >>> import roughfilm as rf
    >>> surface = rf.read_surface("scripts/examples/surfaces/self_affine.toml")
    >>> found = rf.windows(surface, count=12, size=0.25e-3, sizes=[0.125e-3])
    >>> sq = found.quantities["Sq"].scatter
    >>> sq.interval[0] < sq.mean < sq.interval[1], found.count
    (True, 12)
    """
    if not isinstance(surface, Surface | str | os.PathLike):
        raise InputError(f"surface: got {type(surface).__name__}; give a Surface or the name of its file")
    if not isinstance(scene, Scene | str | os.PathLike | None):
        raise InputError(f"scene: got {type(scene).__name__}; give a scene, such as load_scene() returns, or its file")
    tolerance = number_between("tolerance", tolerance, *TOLERANCES, "it must be above 0 and below 1")
    processes = whole_in_range("processes", processes, 1, MOST_PROCESSES)
    gap = None if gap is None else in_range("gap", gap, "m")
    steps = steps_of(recipe)
    given: Surface | Path
    if isinstance(surface, Surface):
        given, name = surface, str(surface.source.get("file", "surface"))
    else:
        path, read = Path(surface), steps.read
        described = path.suffix.lower() == ".toml"
        if described and recipe is not None:
            raise InputError(f"recipe: {path} is described and periodic; leave the recipe out")
        name = path.name
        given = path if described else files.read_surface(path, **dict(read))
    plan = planned(given, steps, count=count, size=size, sizes=sizes, name=name, progress=progress)
    with scratch_directory() as scratch:
        asked = Asked(gap=gap)
        if scene is not None:
            if gap is not None:
                raise InputError(f"gap: got {gap!r} with a scene, whose load determines the gap; leave one out")
            first = scratch / "first.h5"
            save_surface(plan.groups[0].cells[0], first)
            asked = asked_of(scene if isinstance(scene, Scene) else Path(scene), first, sealing=sealing)
        if sealing and asked.kind != "seal":
            raise InputError("sealing: got True; it needs a scene of the kind seal")
        rows = examined(plan, asked, directory=None, place=workers(processes, scratch), progress=progress)
    return answer_of(plan, asked, rows, tolerance)
