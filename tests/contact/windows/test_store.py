"""A set of windows is read as it was written; a damaged one is refused in one line."""

import json

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.preparation.window import Window
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.windows.store import LIST, WindowSet, read_windows, save_windows


@pytest.fixture
def written(tmp_path):
    rng = np.random.default_rng(1)
    cells = tuple(Surface(heights=rng.normal(size=(8, 6)), spacing=(1e-6, 2e-6), periodic=True) for _ in range(3))
    places = tuple(Window(start=(x, 1), shape=(8, 6)) for x in (0, 8, 16))
    given = WindowSet(
        cells=cells, windows=places, size=8e-6, independent=2.5, source={"file": "m.opd"}, answers={"warnings": []}
    )
    save_windows(given, tmp_path)
    return given, tmp_path


def test_a_set_is_read_as_it_was_written(written):
    given, directory = written
    found = read_windows(directory)
    assert [np.array_equal(a.heights, b.heights) for a, b in zip(found.cells, given.cells, strict=True)] == [True] * 3
    assert (found.windows, found.size, found.independent) == (given.windows, 8e-6, 2.5)
    assert (found.source, found.answers) == ({"file": "m.opd"}, {"warnings": []})


def test_a_damaged_list_is_refused(written, tmp_path):
    _, directory = written
    path = directory / LIST
    entries = json.loads(path.read_text())
    path.write_text(json.dumps(entries | {"size": "wide"}))
    with pytest.raises(InputError, match=r"windows.json: size: .*; write the set again$"):
        read_windows(directory)
    path.write_text(json.dumps(entries | {"cells": ["../other.h5"]}))
    with pytest.raises(InputError, match=r"names '\.\./other.h5' in place of cells/0001.h5; write the set"):
        read_windows(directory)
    path.write_text(json.dumps(entries | {"cells": entries["cells"][:2], "independent": 2}))
    with pytest.raises(InputError, match="got 3 places of 2 cells"):
        read_windows(directory)
    for change, message in (
        ({"size": float("nan")}, "size: got nan m of cells of 8e-06 m"),
        ({"size": -1.0}, "size: got -1 m of cells"),
        ({"independent": 4.0}, "independent: got 4; it must be 1 to the number of windows, 3"),
        ({"windows": [[[-1, 0], [8, 6]]] * 3}, "a place begins at a pixel below 0"),
        ({"cells": [], "windows": []}, "got no cells"),
    ):
        path.write_text(json.dumps(entries | change))
        with pytest.raises(InputError, match=rf"windows.json: .*{message}.*; write the set again$"):
            read_windows(directory)
    path.write_text(json.dumps(entries))
    odd = Surface(heights=np.eye(4), spacing=(1e-6, 2e-6), periodic=True)
    save_surface(odd, directory / entries["cells"][2], overwrite=True)
    with pytest.raises(InputError, match=r"cell 3 has \(4, 4\) points .*; give windows of one size; write the set"):
        read_windows(directory)
    (directory / entries["cells"][1]).unlink()
    with pytest.raises(InputError, match=r"0002[.]h5"):
        read_windows(directory)
    with pytest.raises(InputError, match=r"holds no windows[.]json"):
        read_windows(tmp_path / "cells")
