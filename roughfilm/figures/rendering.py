"""Pictures drawn by VTK in a process of their own, because missing graphics libraries make it crash."""

import base64
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from roughfilm.contact.foundation.child_processes import terminate_with_parent
from roughfilm.rom.ladder.model import Availability

if TYPE_CHECKING:
    import pyvista

REMEDY = "install graphics libraries with: sudo apt-get install libegl1 libgl1-mesa-dri libxrender1"
TIME_LIMIT_S = 180

PROBE = """
import pyvista
plotter = pyvista.Plotter(off_screen=True)
plotter.add_mesh(pyvista.Sphere())
plotter.screenshot()
print(pyvista.vtk_version_info)
"""


def embedded(picture: Path) -> str:
    """The address of an image that holds a PNG file itself."""
    return "data:image/png;base64," + base64.b64encode(picture.read_bytes()).decode("ascii")


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
