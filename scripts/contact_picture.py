"""A rough surface under growing load in three dimensions, by pyvista: python -m scripts.contact_picture IN OUT."""

import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from contact.files import replacing
from contact.mechanics.press import Press
from contact.mechanics.solid import Solid, composite_modulus
from contact.surface import Array, Surface
from rom.ladder import Availability
from scripts.rendering import draw_module_apart

WINDOW = (1500, 520)
"""Pixels."""

RELIEF = 0.16
"""How high the undeformed surface is drawn, over its longer side."""

MOST = 160
"""Nodes along a side that are drawn."""

TOLERANCE = 1e-6
TOUCHING = "#c1272d"


def contact_picture(surface: Surface, solid: Solid, loads: Sequence[float], picture: Path) -> Availability:
    """Draw the surface under each load beside the others into a PNG, in a process of its own.

    Parameters
    ----------
    surface : periodic.
    solid : of the surface; the flat wall is rigid.
    loads : Pa over the nominal area.

    Returns
    -------
    Whether it was drawn, and if not, why.
    """
    press = Press(surface.heights, surface.spacing, composite_modulus(solid), hardness=solid.hardness)
    contacts = [press.at(load, tolerance=TOLERANCE) for load in loads]
    return draw_gaps([(one.gap, f"{one.load / 1e6:.4g} MPa") for one in contacts], surface, picture)


def draw_gaps(gaps: Sequence[tuple[Array, str]], surface: Surface, picture: Path) -> Availability:
    """The same of gaps that are known, m, each with a title."""
    step = max(1, -(-max(surface.shape) // MOST))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "gaps.npz"
        np.savez(
            file,
            gaps=np.array([gap[::step, ::step] for gap, _ in gaps]),
            titles=np.array([title for _, title in gaps]),
            spacing=step * np.array(surface.spacing),
            relief=np.ptp(surface.heights),
        )
        return draw_module_apart("scripts.contact_picture", file, picture)


def draw(file: Path, picture: Path) -> None:
    """Draw one PNG: the surface seen from above through the wall, coloured by the gap, red where it touches."""
    import pyvista

    with np.load(file) as held:
        gaps, titles = held["gaps"], [str(title) for title in held["titles"]]
        spacing, relief = held["spacing"], float(held["relief"])
    plotter = pyvista.Plotter(off_screen=True, window_size=list(WINDOW), shape=(1, len(gaps)), border=False)
    side = float((np.array(gaps.shape[1:]) * spacing).max())
    stretch = RELIEF * side / relief
    x, y = (np.arange(count) * step for count, step in zip(gaps.shape[1:], spacing, strict=True))
    for number, (gap, title) in enumerate(zip(gaps, titles, strict=True)):
        plotter.subplot(0, number)
        plotter.background_color = "white"  # type: ignore[assignment]
        grid = pyvista.StructuredGrid(*np.meshgrid(x, y, indexing="ij"), -gap * stretch)
        grid["gap, µm"] = np.where(gap > 0, 1e6 * gap, -1.0).ravel(order="F")
        plotter.add_mesh(
            grid,
            scalars="gap, µm",
            cmap="cividis_r",
            clim=(0.0, 1e6 * relief),
            below_color=TOUCHING,
            smooth_shading=False,
            show_scalar_bar=number == len(gaps) - 1,
            scalar_bar_args={"n_labels": 4, "color": "#222222", "below_label": "", "label_font_size": 18},
        )
        touched = float((gap == 0).mean())
        plotter.add_text(f"{title}, {100 * touched:.2g} % touches", font_size=11, color="#222222")
        plotter.view_vector((-0.75, -1.0, 0.9), viewup=(0, 0, 1))  # type: ignore[arg-type]
        plotter.camera.zoom(1.35)  # type: ignore[no-untyped-call]
    with replacing(picture) as scratch:
        plotter.screenshot(str(scratch))


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]))
