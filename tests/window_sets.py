"""Small sets of windows: seeds of the description of the small scenes."""

import tomllib
from collections.abc import Sequence
from pathlib import Path

from small_scenes import SURFACE

from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_entries
from roughfilm.contact.windows.store import WindowSet, save_windows


def surface_of_seed(seed: int, points: int = 32) -> Surface:
    """The surface of the small scenes with another seed."""
    return make(read_entries({**tomllib.loads(SURFACE), "seed": seed, "points": [points, points]}))


def write_set(directory: Path, cells: Sequence[Surface]) -> Path:
    """Write a set of independent cells and return its directory."""
    windows = WindowSet(
        cells=tuple(cells), windows=(), size=min(cells[0].size), independent=float(len(cells)), source={"seeds": "some"}
    )
    save_windows(windows, directory)
    return directory
