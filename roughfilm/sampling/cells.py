"""The files of the cells of a set of windows, and scenes with each of them as the rough surface."""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from roughfilm.contact.surfaces.periodicity import MISMATCH_THRESHOLD, joint_mismatch
from roughfilm.contact.windows.scatter import MIN_INDEPENDENT
from roughfilm.contact.windows.store import cell_path, read_windows
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.scene import load_scene

SceneT = TypeVar("SceneT", bound=Scene)

PLACES = "windows"
"""The directory of the results of the windows, with a subdirectory for each."""


@dataclass(frozen=True, kw_only=True)
class Cells:
    """The cells of a set of windows.

    Attributes
    ----------
    paths : the file of each cell.
    size : length of a cell along x and y, m.
    independent : effective number of independent windows.
    source : the surface of the windows, as entries for JSON.
    mismatches : periodicity mismatch at the joint of each cell that was cut from a measurement.
    """

    paths: tuple[Path, ...]
    size: tuple[float, float]
    independent: float
    source: dict[str, Any]
    mismatches: tuple[float, ...]

    @property
    def warnings(self) -> list[str]:
        """The warnings about windows that are too few for a scatter, and about joints that do not fit."""
        warnings = []
        if self.independent < MIN_INDEPENDENT:
            warnings.append(
                f"{len(self.paths)} windows are worth {self.independent:.3g} independent ones: too few for the "
                "scatter, which is unknown; take three or more"
            )
        bad = [one for one in self.mismatches if one > MISMATCH_THRESHOLD]
        if bad:
            warnings.append(
                f"{len(bad)} of {len(self.paths)} windows have a periodicity mismatch above {MISMATCH_THRESHOLD}, up "
                f"to {max(bad):.2f}: ridges or steps end at the joint, which throttles flow; take other or larger "
                "windows"
            )
        return warnings

    def entries(self) -> dict[str, Any]:
        """The entries for the provenance of a result."""
        return {
            "count": len(self.paths),
            "independent": self.independent,
            "size": list(self.size),
            "source": self.source,
        }


def read_cells(directory: Path) -> Cells:
    """The cells of the set of windows in a directory; InputError if it holds none, or they are damaged."""
    windows = read_windows(directory)
    paths = tuple(directory / cell_path(number) for number in range(len(windows.cells)))
    return Cells(
        paths=paths,
        size=windows.cells[0].size,
        independent=windows.independent,
        source=dict(windows.source),
        mismatches=tuple(joint_mismatch(cell) for cell in windows.cells if "prepared_from" in cell.source),
    )


def scenes_of(
    scene: Path, overrides: Sequence[str], key: str, cells: Cells, checked: Callable[[Scene], SceneT]
) -> list[SceneT]:
    """The scene with each cell in place of its surface.

    Parameters
    ----------
    scene : the scene file.
    overrides : texts of the form ``key=value``.
    key : key of the surface, such as "geometry.surface".
    cells : the cells.
    checked : checked(scene), the scene if it is of the right kind, else InputError.
    """
    return [checked(load_scene(scene, [*overrides, f"{key}={json.dumps(str(path))}"])) for path in cells.paths]


def place_of(directory: Path, cell: Path) -> Path:
    """The directory of the results of a cell."""
    return directory / PLACES / cell.stem
