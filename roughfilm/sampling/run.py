"""The rows of all windows of a plan: stored ones are read, the others computed and stored one by one."""

from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

from roughfilm.batch.execute import CHUNK_S, Workers, answered, lost, refuse_lost
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.ladder.provenance import code, versions
from roughfilm.sampling.asked import Asked
from roughfilm.sampling.plan import Plan
from roughfilm.sampling.quantities import Row, row_of, rows_of
from roughfilm.sampling.rows import identity_of, remove_other_rows, store_row, stored_row

COST_S = {"": (1e-2, 2e-6), "dry_contact": (2e-2, 6e-7), "seal": (3e-2, 2e-6), "bearing": (20.0, 3e-4)}
"""Expected CPU time of a window by the kind of scene: that of none, and that of each point, s."""


@dataclass(frozen=True, kw_only=True)
class Rows:
    """The rows of all windows.

    Attributes
    ----------
    by_group : rows of each group of the plan, in the order of its windows.
    found : number of rows that were stored before.
    cpu_s : CPU time of the rows that were not found, s.
    """

    by_group: tuple[tuple[Row, ...], ...]
    found: int
    cpu_s: float


def expected_cost(cell: Surface, asked: Asked) -> float:
    """The expected CPU time of a window, s."""
    fixed, each = COST_S[asked.kind]
    return fixed + each * cell.heights.size


def examined(
    plan: Plan,
    asked: Asked,
    *,
    directory: Path | None,
    place: AbstractContextManager[Workers | None],
    progress: Progress,
) -> Rows:
    """The rows of all windows; each new row is stored as soon as it is there.

    Parameters
    ----------
    plan : the windows.
    asked : what is computed for each.
    directory : directory of the rows; None keeps none.
    place : context manager of the workers, or of None for this process; it is entered only if rows are
        missing.
    progress : called with the done fraction and a few words.

    Raises
    ------
    InputError
        If a row cannot be written; stored rows are kept, and the same call continues with the missing ones.
    UnavailableError
        If the scheduler of the workers stops, all workers are gone, or one dies twice on the same window.
    """
    cells = [cell for group in plan.groups for cell in group.cells]
    identities = [identity_of(cell, asked) for cell in cells]
    rows: dict[int, Row] = {}
    if directory is not None:
        for number, identity in enumerate(identities):
            row = stored_row(identity, directory)
            if row is not None:
                rows[number] = row
    found, missing = len(rows), [number for number in range(len(cells)) if number not in rows]
    costs = {number: expected_cost(cells[number], asked) for number in missing}
    total, done = sum(costs.values()) or 1.0, 0.0

    def keep(number: int, row: Row) -> None:
        nonlocal done
        rows[number] = row
        if directory is not None:
            store_row(row, identities[number], directory)
        done += costs[number]
        progress(done / total, f"{len(rows)} of {len(cells)} windows")

    progress(0.0, f"{found} of {len(cells)} windows")
    try:
        if missing:
            with place as workers:
                for number, row in _computed(missing, costs, cells, asked, workers):
                    keep(number, row)
    except (KeyboardInterrupt, SystemExit) as stop:
        if directory is not None:
            stop.add_note(f"stopped at {len(rows)} of {len(cells)} windows; the same command goes on")
        raise
    refuse_lost([row.failure for row in rows.values() if row.failure is not None], len(cells), "windows")
    if directory is not None:
        remove_other_rows(identities, directory)
    ordered = iter([rows[number] for number in range(len(cells))])
    return Rows(
        by_group=tuple(tuple(next(ordered) for _ in group.cells) for group in plan.groups),
        found=found,
        cpu_s=sum(rows[number].cpu_s for number in missing),
    )


def _computed(
    missing: list[int], costs: dict[int, float], cells: list[Surface], asked: Asked, workers: Workers | None
) -> Iterator[tuple[int, Row]]:
    """Send the windows in chunks, the most expensive first; without workers this process computes them."""
    if workers is None:
        yield from ((number, row_of(cells[number], asked)) for number in missing)
        return
    origin = (code(), versions())

    def chunks() -> Iterator[list[int]]:
        chunk: list[int] = []
        for number in sorted(missing, key=lambda number: -costs[number]):
            chunk.append(number)
            if sum(costs[one] for one in chunk) >= CHUNK_S:
                yield chunk
                chunk = []
        if chunk:
            yield chunk

    def send(chunk: list[int], _again: bool) -> Future[list[Row]]:
        return workers.executor().submit(rows_of, [cells[one] for one in chunk], asked, origin)

    no_row: Callable[[BaseException], Row] = lambda error: Row(quantities={}, failure=lost(error))  # noqa: E731
    yield from answered(chunks(), send, no_row, workers)
