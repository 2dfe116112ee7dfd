"""Estimate the memory that a mesh needs before the mesh is made."""

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.limits import memory_available

RUN_BYTES = 1700.0
"""Peak memory of simpleFoam per cell, bytes, measured at 0.4 and 2 million cells."""

WRITE_BYTES = 900.0
"""Peak memory per cell while a case is written, bytes, measured at 0.4 and 2 million cells."""

BASE_BYTES = 2.5e8
"""Memory of a process whose mesh has no cells, bytes."""


def memory_estimate(columns: int, layers: int, *, run: bool = True) -> float:
    """The peak memory of writing a case, and of running it if ``run``, bytes.

    The estimate is ``BASE_BYTES`` plus the number of cells, columns times layers, times the larger memory per cell.

    Parameters
    ----------
    columns : number of columns of the mesh, all over the plane.
    layers : number of cells across the gap.
    run : whether the case is run too.
    """
    return BASE_BYTES + columns * layers * max(WRITE_BYTES, RUN_BYTES if run else 0.0)


def check_memory(columns: tuple[int, int], layers: int, *, run: bool) -> None:
    """Raise InputError, with the estimate, for a mesh that does not fit into the available memory."""
    needed, there = memory_estimate(columns[0] * columns[1], layers, run=run), memory_available()
    if needed > there:
        raise InputError(
            f"resolution: a mesh of {columns[0]} × {columns[1]} × {layers} cells would take about "
            f"{needed / 2**30:.3g} GiB of memory to be {'run' if run else 'written'}, and {there / 2**30:.3g} GiB are "
            "available; take fewer nodes or layers, or another machine"
        )
