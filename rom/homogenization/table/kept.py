"""Tables of surfaces that are kept in the cache, complete or not, and taken from it by all who need them."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.cache import alone_with, entry_path, trim, use, warn
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.timing import one_time, working_time
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.resume import Work, grown_table, key_of, table_of
from roughfilm.rom.homogenization.table.store import Making, kept_part, save_table
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.provenance import imported_code, machine, versions

LIBRARIES = ("python", "numpy", "scipy", "numba", "pyfftw")
"""Libraries whose versions may change the last digits of a table."""

SHOWN_DIGITS = 16
"""Number of digits of a digest in provenance."""


def table_inputs(heights: Array, spacing: tuple[float, float], module: str, **settings: Any) -> Inputs:
    """The inputs that determine a table to the last digit, whose digest is the name of its entry in the cache.

    Parameters
    ----------
    heights : heights of one period, m, shape (nx, ny).
    spacing : (dx, dy), m.
    module : dotted name, within ``roughfilm``, of the module that makes the table.
    **settings : solids, range and tolerances of the table, as entries for JSON.
    """
    circumstances = {
        "code": imported_code(f"roughfilm.{module}"),
        "versions": {name: versions()[name] for name in LIBRARIES},
        "processor": machine()["processor"],
    }
    return Inputs(heights=heights, spacing=spacing, settings={**settings, **circumstances})


def kept_table(
    inputs: Inputs,
    work: Work,
    *,
    about: Mapping[str, str],
    progress: Progress,
    known: Sequence[Point] = (),
    foreign: Sequence[Point] = (),
    keep: Callable[[Point], None] = lambda _point: None,
) -> FactorTable:
    """The table of these inputs from the cache, or the one that ``work(known, keep)`` makes, which is then kept.

    The table is the same to the last digit, kept or made. Its points are kept while it is made, so that a run after a
    killed one goes on. Where another process makes the same table, this one waits for it. A damaged entry is removed
    and made again. The CPU time counts as the one-time cost "table".

    Parameters
    ----------
    inputs : all that determines the table, see :func:`table_inputs`.
    work : makes the table.
    about : entries for people: the name of the "surface" and the "kind" of the table.
    progress : called with the done fraction and a few words while another process makes the table.
    known : points of other tables of these heights and solids, made under the same circumstances.
    foreign : points from elsewhere, such as a file of the user; a table that needs them is not kept.
    keep : called with each new point.

    Raises
    ------
    InputError, ConvergenceError
        Those of ``work``.
    """
    with one_time("table"):
        path = entry_path("tables", inputs.digest)
        if (found := _complete(path, inputs)) is not None:
            return found
        if path is None:
            return _with_origin(work([*known, *foreign], keep), inputs, kept=False, stored=False)
        with alone_with(path, lambda: progress(0.0, "waiting for another process that makes it")):
            return _complete(path, inputs) or _made(path, inputs, work, about, known, foreign, keep)


def _complete(path: Path | None, inputs: Inputs) -> FactorTable | None:
    """The complete table of an entry; None if there is none."""
    table, making = _part(path)
    if path is None or table is None or making is None or not making.complete:
        return None
    use(path)
    return _with_origin(table, inputs, kept=True, stored=True, cpu_s=making.cpu_s)


def _part(path: Path | None) -> tuple[FactorTable | None, Making | None]:
    """The points of an entry so far, and how they were made; a damaged file is removed."""
    if path is None or not path.is_file():
        return None, None
    try:
        return kept_part(path)
    except InputError:
        with suppress(OSError):
            path.unlink()
        return None, None


def _made(
    path: Path,
    inputs: Inputs,
    work: Work,
    about: Mapping[str, str],
    known: Sequence[Point],
    foreign: Sequence[Point],
    keep: Callable[[Point], None],
) -> FactorTable:
    """The table, made from the points of its entry so far and kept in it."""
    part, making = _part(path)
    before = [*(() if part is None else part.points), *known]
    spent, started = 0.0 if making is None else making.cpu_s, working_time()
    here = {key_of(point) for point in before}
    more = [point for point in foreign if key_of(point) not in here]
    writable = not more

    def cpu_s() -> float:
        return float(spent + working_time() - started)

    def save(table: FactorTable, complete: bool) -> None:
        nonlocal writable
        if not writable:
            return
        try:
            save_table(path, inputs, table, Making(**about, complete=complete, cpu_s=cpu_s()))
        except InputError as error:
            writable = False
            warn(str(error))

    def kept_work(known: Sequence[Point], own: Callable[[Point], None]) -> FactorTable:
        def both(point: Point) -> None:
            own(point)
            keep(point)

        return work(known, both)

    table, _ = grown_table(
        [*before, *more],
        kept_work,
        lambda points: save(table_of(points, inputs), False),
        "points; the same command goes on",
    )
    save(table, True)
    with suppress(InputError):
        trim()
    return _with_origin(table, inputs, kept=False, stored=writable, cpu_s=cpu_s())


def _with_origin(table: FactorTable, inputs: Inputs, **entries: Any) -> FactorTable:
    """The table with the entries for provenance: whether it was ``kept`` before, is ``stored`` now, and its cost."""
    return replace(table, origin={"digest": inputs.digest[:SHOWN_DIGITS], "points": len(table.points), **entries})
