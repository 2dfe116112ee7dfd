"""The thrust washer of Paper E over speed and load, by homogenized factors and by Patir and Cheng's."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.mechanics.solid import composite_modulus
from roughfilm.contact.preparation.prepare import prepare
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.mixed.curves import Wall, resumed_curves, wall_of
from roughfilm.rom.bearing.mixed.patir_cheng_table import patir_cheng_table
from roughfilm.rom.bearing.mixed.resume import resumed_table
from roughfilm.rom.bearing.mixed.stribeck import StribeckCurve
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.ladder.provenance import code
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.terminal.console import make_directory
from scripts.studies.paper_e.made import POINTS, TABLE, made, oblique, turned
from scripts.studies.paper_e.windows import MILLED, STEEL

SCENE = Path(__file__).parents[2] / "examples" / "scenes" / "washer.toml"

LOADS = (0.5e6, 1e6, 2e6)
"""Pa over the nominal area, as in Fig. E.29."""

SPEEDS = (0.0, *(float(speed) for speed in np.geomspace(3, 800, 26)))
"""Turns a minute; 30 and 300, of Figs. E.25 to E.27, are added."""

SHOWN = (30.0, 300.0)

GROUND, GROUND_WINDOW = "ground_striated.x3p", ("50 um", "120 um")
"""The window is the one of at least this size that repeats best."""

SCALED = TABLE["surface 3"].rms
"""Sq, m, to which the ground surface is scaled, in the plane as well, so that its slopes stay."""

SEEDS = (0, 11)
"""Added to those of surface 3, for how much one sample of a texture differs from the next."""

FEW_SPEEDS = (0.0, 10.0, 50.0, 200.0)
"""Turns a minute, of curves of which only lift-off is asked."""

CELLS = 48
FRICTION = 0.1


@dataclass(frozen=True, kw_only=True)
class Washer:
    """Curves on one surface, by load; ``boxed`` are those with Patir and Cheng's factors, () where not asked.

    ``wall`` and ``boxes`` are what the asperities do, and what the other method makes of it.
    """

    scene: Bearing
    wall: Wall
    boxes: AsperityTable | None
    curves: tuple[StribeckCurve, ...]
    boxed: tuple[StribeckCurve, ...]

    def lift(self, *, boxed: bool = False) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
        """Lift-off in turns a minute and its uncertainty, shape (loads, 2)."""
        curves = self.boxed if boxed else self.curves
        return np.array([(curve.lift_off.speed, curve.lift_off.uncertainty) for curve in curves]) * self.turns

    @property
    def turns(self) -> float:
        """Turns a minute at 1 m/s."""
        return 1 / speed_of(self.scene, 1.0)

    def apart(self) -> float:
        """The largest part by which the film of the one method is above or below that of the other."""
        return max(
            abs(box.separation / cell.separation - 1)
            for one, other in zip(self.curves, self.boxed, strict=True)
            for cell, box in zip(one.points, other.points, strict=True)
        )


def speed_of(scene: Bearing, turns: float) -> float:
    """m/s at the mean radius."""
    radius = scene.turning_radius
    assert radius is not None
    return turns * 2 * np.pi / 60 * radius


def surfaces(folder: Path | None, points: int = POINTS) -> dict[str, Surface]:
    """The three of Table E.2 as they were made, and those measured ones that are in a folder."""
    found = {name: made(name, points) for name in TABLE}
    recipe = {"grid": {"points": [points, points]}}
    if folder is not None and (folder / MILLED).is_file():
        found["milled"] = prepare(read_surface(folder / MILLED), read_recipe(recipe)).surface
    if folder is not None and (folder / GROUND).is_file():
        cut = read_recipe(recipe | {"window": {"size": list(GROUND_WINDOW)}})
        ground = turned(prepare(read_surface(folder / GROUND), cut).surface)
        factor = SCALED / float(ground.heights.std())
        dx, dy = ground.spacing
        found["ground"] = Surface(
            heights=ground.heights * factor, spacing=(dx * factor, dy * factor), source=ground.source
        )
    return found


def lays(points: int = POINTS) -> dict[str, Surface]:
    """Surface 3 with its ridges along the sliding, across it (along the leakage) and oblique; surface 1 across.

    Names end with the seed. At +45° ridges that go along with the sliding wall lead outwards, at -45° inwards.
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
    """Curves on a surface; table and points stay in the folder and are found again."""
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
    boxes = _boxes(surface, wall.asperities, folder / "patir_cheng.h5")
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
