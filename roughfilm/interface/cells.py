"""Sets of windows as arguments: surfaces in memory, and scenes with each of them from a file."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.interface.scenes import with_entries
from roughfilm.rom.ladder.kind import Scene


class CellSet(Protocol):
    """Windows with their cells, such as what :func:`roughfilm.windows` returns or a directory holds."""

    @property
    def cells(self) -> tuple[Surface, ...]:
        """The periodic cells."""
        ...

    @property
    def independent(self) -> float:
        """The effective number of independent windows."""
        ...


Windows = CellSet | Sequence[Surface]


@dataclass(frozen=True, kw_only=True)
class CheckedWindows:
    """Periodic cells of one shape and spacing, and the effective number of independent ones."""

    cells: tuple[Surface, ...]
    independent: float


def checked_windows(windows: object) -> CheckedWindows:
    """The cells of a set of windows, or of a sequence of surfaces, which count as independent.

    Raises
    ------
    InputError
        If there are none, something is no surface, has invalid points, or another shape or spacing than the first.
    """
    if isinstance(windows, Sequence) and not isinstance(windows, str | bytes):
        cells, independent = tuple(windows), float(len(windows))
    else:
        cells, independent = tuple(getattr(windows, "cells", ())), float(getattr(windows, "independent", 0.0))
    if not cells:
        raise InputError(f"windows: got {type(windows).__name__}; give a set of windows, or a list of surfaces")
    checked: list[Surface] = []
    for number, cell in enumerate(cells):
        if not isinstance(cell, Surface):
            raise InputError(f"windows: got {type(cell).__name__} at {number}; give surfaces")
        if cell.invalid.any():
            raise InputError(f"windows: the surface at {number} has invalid points; fill them by prepare()")
        checked.append(cell)
        first = checked[0]
        if (cell.shape, cell.spacing) != (first.shape, first.spacing):
            raise InputError(
                f"windows: the surface at {number} has {cell.shape} points of {cell.spacing} m, the first one "
                f"{first.shape} of {first.spacing} m; give windows of one size"
            )
    return CheckedWindows(cells=tuple(checked), independent=independent)


@contextmanager
def scenes_with(scene: Scene, key: str, windows: CheckedWindows) -> Iterator[list[Scene]]:
    """Yield the scene with each window in place of its surface, from files that are removed at the end.

    Parameters
    ----------
    key : key of the surface, such as "geometry.surface".
    """
    with scratch_directory() as place:
        scenes = []
        for number, cell in enumerate(windows.cells):
            path = Path(place) / f"{number + 1:04d}.h5"
            save_surface(cell, path)
            scenes.append(with_entries(scene, {key: str(path)}))
        yield scenes
