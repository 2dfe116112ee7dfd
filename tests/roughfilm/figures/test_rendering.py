"""A picture and the scene that turns in its place are one PNG file."""

import base64
import io
import json
import struct
import zipfile
import zlib

import numpy as np
import pytest
from matplotlib.image import imread, imsave

from roughfilm.figures import rendering
from roughfilm.figures.rendering import SCENE_CHUNK, embedded, probe, write_picture


class Drawn:
    """Stands for a plotter of a picture."""

    def screenshot(self, path):
        imsave(path, np.zeros((2, 3, 3)), format="png")


def chunks(held):
    """The type and the content of each chunk, whose checksums are right."""
    at = 8
    while at < len(held):
        (size,) = struct.unpack(">I", held[at : at + 4])
        name, content = held[at + 4 : at + 8], held[at + 8 : at + 8 + size]
        assert struct.unpack(">I", held[at + 8 + size : at + 12 + size]) == (zlib.crc32(name + content),)
        yield name, content
        at += 12 + size


def test_a_scene_is_a_chunk_of_the_picture(tmp_path, monkeypatch):
    monkeypatch.setattr(rendering, "_scene", lambda plotter: b"what turns")
    write_picture(Drawn(), tmp_path / "still.png")
    write_picture(Drawn(), tmp_path / "turning.png", Drawn())
    found = [*chunks((tmp_path / "turning.png").read_bytes())]
    assert (SCENE_CHUNK, b"what turns") in found
    assert found[-1][0] == b"IEND"
    assert [one for one in found if one[0] != SCENE_CHUNK] == [*chunks((tmp_path / "still.png").read_bytes())]
    assert imread(tmp_path / "turning.png").shape[:2] == (2, 3)
    kinds = [embedded(tmp_path / name).partition(",") for name in ("still.png", "turning.png")]
    assert [kind for kind, _, _ in kinds] == ["data:image/png;base64", "data:image/png;scene=turns;base64"]
    assert base64.b64decode(kinds[1][2]) == (tmp_path / "turning.png").read_bytes()


def test_a_fine_surface_turns_with_at_most_a_megabyte(tmp_path):
    here = probe()
    if not here.available:
        pytest.skip(here.detail)
    x, y = np.meshgrid(np.linspace(0, 30, 700), np.linspace(0, 30, 700), indexing="ij")
    np.savez(tmp_path / "s.npz", heights=1e-7 * np.sin(x) * np.cos(y + x / 3), spacing=[1e-7, 1e-7])
    drawn = rendering.draw_apart("roughfilm.figures.spatial.relief", tmp_path / "s.npz", tmp_path / "s.png")
    assert drawn.available, drawn.detail
    scene = dict(chunks((tmp_path / "s.png").read_bytes()))[SCENE_CHUNK]
    assert len(scene) < 1e6
    with zipfile.ZipFile(io.BytesIO(scene)) as file:
        held = json.loads(file.read("index.json"))
    assert held["scene"]["type"].endswith("RenderWindow")
    assert {entry["vtk"] for entry in held["hashes"].values()} >= {"vtkPoints", "vtkCellArray"}
