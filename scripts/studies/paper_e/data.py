"""Solutions of the thrust washer of Paper E over speed and load, by homogenized and by Patir and Cheng's factors."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.solid import composite_modulus
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.mixed.curves import Wall, resumed_curves, wall_of
from roughfilm.rom.bearing.mixed.patir_cheng_table import patir_cheng_table
from roughfilm.rom.bearing.mixed.stribeck import StribeckCurve
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.resume import resumed_table
from roughfilm.rom.ladder.provenance import code
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.terminal.console import make_directory
from scripts.studies.paper_e.made import POINTS, TABLE, made, oblique, turned
from scripts.studies.paper_e.windows import MILLED, STEEL
from scripts.studies.thesis_clipping import prepare_as_in_the_thesis

SCENE = Path(__file__).parents[2] / "examples" / "scenes" / "washer.toml"

LOADS = (0.5e6, 1e6, 2e6)
"""Loads over the nominal area, as in Fig. E.29, Pa."""

SPEEDS = (0.0, *(float(speed) for speed in np.geomspace(3, 800, 26)))
"""Speeds, revolutions per minute; the speeds ``SHOWN`` are added."""

SHOWN = (30.0, 300.0)
"""Speeds of Figs. E.25 to E.27, revolutions per minute."""

GROUND, GROUND_WINDOW = "ground_striated.x3p", ("50 um", "120 um")
"""File of the ground surface, and least size of its window, whose place is the one with the best periodicity."""

SCALED = TABLE["surface 3"].rms
"""Sq to which the ground surface is scaled, m; its lengths are scaled as well, so that the slopes do not change."""

SEEDS = (0, 11)
"""Numbers added to the seeds of surface 3, to show the differences between samples of one texture."""

FEW_SPEEDS = (0.0, 10.0, 50.0, 200.0)
"""Speeds of curves that give only the lift-off speed, revolutions per minute."""

CELLS = 48
FRICTION = 0.1


def _asperities(wall: Wall) -> AsperityTable:
    assert isinstance(wall.asperities, AsperityTable)
    return wall.asperities


@dataclass(frozen=True, kw_only=True)
class Washer:
    """The Stribeck curves of a washer on one surface.

    Attributes
    ----------
    scene : scene of the washer.
    wall : flow factors and contact pressures of the surface over the separation.
    boxes : asperities by Patir and Cheng's method, None if it is not computed.
    curves : curves by homogenized factors, one for each load.
    boxed : curves by Patir and Cheng's factors, one for each load; () if they are not computed.
    """

    scene: Bearing
    wall: Wall
    boxes: AsperityTable | None
    curves: tuple[StribeckCurve, ...]
    boxed: tuple[StribeckCurve, ...]

    @property
    def asperities(self) -> AsperityTable:
        """The flow factors and contact pressures of the surface over the separation."""
        return _asperities(self.wall)

    def lift(self, *, boxed: bool = False) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
        """Return the lift-off speed and its uncertainty, revolutions per minute, shape (loads, 2)."""
        curves = self.boxed if boxed else self.curves
        return np.array([(curve.lift_off.speed, curve.lift_off.uncertainty) for curve in curves]) * self.turns

    @property
    def turns(self) -> float:
        """The revolutions per minute at a sliding speed of 1 m/s."""
        return 1 / speed_of(self.scene, 1.0)

    def apart(self) -> float:
        """Return the largest relative difference of the separations by both methods."""
        return max(
            abs(box.separation / cell.separation - 1)
            for one, other in zip(self.curves, self.boxed, strict=True)
            for cell, box in zip(one.points, other.points, strict=True)
        )


def speed_of(scene: Bearing, turns: float) -> float:
    """Return the sliding speed at the mean radius, m/s, for a speed in revolutions per minute."""
    radius = scene.turning_radius
    assert radius is not None
    return turns * 2 * np.pi / 60 * radius


def surfaces(folder: Path | None, points: int = POINTS) -> dict[str, Surface]:
    """Return the three synthetic surfaces of Table E.2, and the measured ones that are in a folder."""
    found = {name: made(name, points) for name in TABLE}
    recipe = {"grid": {"points": [points, points]}, "edges": {"method": "blended"}}
    if folder is not None and (folder / MILLED).is_file():
        found["milled"] = prepare_as_in_the_thesis(read_surface(folder / MILLED), read_recipe(recipe)).surface
    if folder is not None and (folder / GROUND).is_file():
        cut = read_recipe(recipe | {"window": {"size": list(GROUND_WINDOW)}})
        ground = turned(prepare_as_in_the_thesis(read_surface(folder / GROUND), cut).surface)
        factor = SCALED / float(ground.heights.std())
        dx, dy = ground.spacing
        found["ground"] = Surface(
            heights=ground.heights * factor, spacing=(dx * factor, dy * factor), source=ground.source
        )
    return found


def lays(points: int = POINTS) -> dict[str, Surface]:
    """Return surface 3 with ridges along the sliding, across it (along the leakage) and oblique; surface 1 across.

    The names of surface 3 end with the seed. Ridges lead outwards in the sliding direction at +45°, inwards at -45°.
    """
    found = {"surface 1, across": turned(made("surface 1", points))}
    for seed in SEEDS:
        along = made("surface 3", points, seed)
        found |= {
            f"along, {seed}": along,
            f"across, {seed}": turned(along),
            f"+45°, {seed}": oblique(points, seed, 45.0),
            f"-45°, {seed}": oblique(points, seed, -45.0),
        }
    return found


def washer(
    surface: Surface,
    folder: Path,
    *,
    boxed: bool,
    speeds: Sequence[float] = SPEEDS,
    cells: int = CELLS,
    advance: Callable[[str], None] = lambda _words: None,
) -> Washer:
    """Compute the curves on a surface; table and points are stored in the folder and used again."""
    make_directory(folder)
    save_surface(surface, folder / "surface.h5")
    scene = load_scene(
        SCENE,
        [
            "roughness.kind=surface",
            f"roughness.surface={folder.resolve() / 'surface.h5'}",
            f"asperities.friction={FRICTION}",
            f"asperities.solid.modulus={STEEL.modulus} Pa",
            f"asperities.solid.poisson={STEEL.poisson}",
            f"asperities.solid.hardness={STEEL.hardness} Pa",
        ],
    )
    assert isinstance(scene, Bearing)

    def report(_part: float, words: str) -> None:
        advance(f"{folder.name}: {words}")

    asked = sorted({speed_of(scene, turns) for turns in (*speeds, *SHOWN)})
    wall = wall_of(scene, LOADS[-1], None, folder / "table.h5", report, cells)
    curves, _ = resumed_curves(scene, asked, LOADS, wall, folder / "stribeck.h5", cells, report)
    if not boxed:
        return Washer(scene=scene, wall=wall, boxes=None, curves=curves, boxed=())
    boxes = _boxes(surface, _asperities(wall), folder / "patir_cheng.h5")
    other = Wall(
        asperities=boxes, warnings=(), points=0, known_points=0, source={**wall.source, "factors": "Patir and Cheng"}
    )
    found, _ = resumed_curves(scene, asked, LOADS, other, folder / "patir_cheng_curves.h5", cells, report)
    return Washer(scene=scene, wall=wall, boxes=boxes, curves=curves, boxed=found)


def _boxes(surface: Surface, table: AsperityTable, path: Path) -> AsperityTable:
    heights = surface.heights - surface.heights.mean()
    press = Press(heights, surface.spacing, composite_modulus(STEEL), hardness=STEEL.hardness)
    inputs = Inputs(
        heights=heights,
        spacing=surface.spacing,
        settings={"factors": "Patir and Cheng", "points": len(table.factors.points), "code": code()},
    )

    def work(known: Sequence[Point], keep: Callable[[Point], None]) -> FactorTable:
        before = {point.mean_gap: point for point in known}
        return patir_cheng_table(table, press, known=before, keep=keep).factors

    return AsperityTable(factors=resumed_table(path, inputs, work)[0])
