"""Pictures drawn by VTK in a process of their own, because missing graphics libraries make it crash."""

import base64
import gzip
import importlib.util
import io
import json
import struct
import subprocess
import sys
import zipfile
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughfilm.contact.foundation.child_processes import terminate_with_parent
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.writing.kinds import PICTURE
from roughfilm.rom.ladder.model import Availability

if TYPE_CHECKING:
    import pyvista

REMEDY = "install graphics libraries with: sudo apt-get install libegl1 libgl1-mesa-dri libxrender1"
TIME_LIMIT_S = 180

SCENE_CHUNK = b"scEn"
"""Type of the chunk of a PNG file that holds a scene: ancillary, private, safe to copy."""

END_OF_PNG = 12
"""Bytes of the chunk that ends a PNG file."""

PROBE = """
import pyvista
plotter = pyvista.Plotter(off_screen=True)
plotter.add_mesh(pyvista.Sphere())
plotter.screenshot()
print(pyvista.vtk_version_info)
"""


def embedded(picture: Path) -> str:
    """The address of an image that holds a PNG file itself, and says whether the file holds a scene that turns."""
    held = picture.read_bytes()
    turns = ";scene=turns" if SCENE_CHUNK in held else ""
    return f"data:image/png{turns};base64," + base64.b64encode(held).decode("ascii")


def write_picture(plotter: "pyvista.Plotter", picture: Path, turning: "pyvista.Plotter | None" = None) -> None:
    """Write what a plotter shows as a PNG file, with what another shows as the scene that turns in its place.

    The scene is in a private chunk of the PNG file (``SCENE_CHUNK``), so that both stay together.
    """
    with replacing(picture, PICTURE) as scratch:
        plotter.screenshot(str(scratch))
        if turning is not None:
            held, scene = scratch.read_bytes(), SCENE_CHUNK + _scene(turning)
            chunk = struct.pack(">I", len(scene) - len(SCENE_CHUNK)) + scene + struct.pack(">I", zlib.crc32(scene))
            scratch.write_bytes(held[:-END_OF_PNG] + chunk + held[-END_OF_PNG:])


def _scene(plotter: "pyvista.Plotter") -> bytes:
    """What a plotter shows as ``static_viewer.html`` of trame-vtk reads it: the window and its arrays in a ZIP file."""
    from trame_vtk.modules.vtk import serializers as vtk_js

    vtk_js.initialize_serializers()
    context = vtk_js.SynchronizationContext()
    window: Any = plotter.render_window
    window.Render()
    camera = plotter.renderer.GetActiveCamera()
    state = vtk_js.serialize(None, window, vtk_js.reference_id(window), context, 1)
    state["extra"] = {
        "vtkRefId": vtk_js.reference_id(window),
        "centerOfRotation": camera.GetFocalPoint(),
        "camera": vtk_js.reference_id(camera),
    }
    hashes = {
        entry["hash"]: {**entry, "content": context.get_cached_data_array(entry["hash"])}
        for entry in vtk_js.extract_array_hash(state)
    }
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", compression=zipfile.ZIP_DEFLATED, compresslevel=9) as file:
        file.writestr("index.json", json.dumps({"hashes": hashes, "scene": state}))
    return held.getvalue()


def viewer() -> str:
    """The page of trame-vtk that turns a scene, compressed by gzip, in base64."""
    found = importlib.util.find_spec("trame_vtk")
    page = Path(str(found and found.origin)).parent / "tools" / "static_viewer.html"
    return base64.b64encode(gzip.compress(page.read_bytes(), mtime=0)).decode("ascii")


def scalar_bar(
    place: tuple[float, float],
    extent: tuple[float, float],
    *,
    labels: int,
    digits: int = 1,
    size: int = 18,
) -> "pyvista.ScalarBarArgs":
    """The options of a horizontal colour bar in pyvista; its place and extent are fractions of the window."""
    return {
        "title": "",
        "n_labels": labels,
        "fmt": f"%.{digits}f",
        "color": "#222222",
        "label_font_size": size,
        "vertical": False,
        "position_x": place[0],
        "position_y": place[1],
        "width": extent[0],
        "height": extent[1],
    }


def draw_apart(module: str, file: Path, picture: Path) -> Availability:
    """Draw the content of a file into a PNG by a module that runs in a process of its own, and say whether it did."""
    return _apart("-m", module, str(file), str(picture))


def probe() -> Availability:
    """Whether pictures can be drawn on this machine."""
    drawn = _apart("-c", PROBE)
    if not drawn.available:
        return drawn
    return Availability(available=True, detail="pyvista draws, VTK " + drawn.detail.strip("()").replace(", ", "."))


def _apart(*arguments: str) -> Availability:
    try:
        run = subprocess.run(
            [*terminate_with_parent(), sys.executable, "-P", *arguments],
            capture_output=True,
            text=True,
            timeout=TIME_LIMIT_S,
            check=False,
        )
    except (OSError, subprocess.SubprocessError) as error:
        return Availability(available=False, detail=f"drawing did not end ({error}); {REMEDY}")
    if run.returncode != 0:
        crashed = run.returncode < 0
        last = next(iter(run.stderr.strip().splitlines()[::-1]), "no word")
        detail = f"VTK crashes here (exit code {run.returncode}); {REMEDY}" if crashed else f"drawing failed ({last})"
        return Availability(available=False, detail=detail)
    lines = run.stdout.strip().splitlines()
    return Availability(available=True, detail=lines[-1] if lines else "")
