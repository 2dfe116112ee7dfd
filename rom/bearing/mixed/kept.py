"""Tables of flow factors and contact pressures that are kept in the cache."""

import math
from collections.abc import Callable, Sequence

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.threads import checked_threads
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.mixed.tabulate import tabulate_pressed
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.kept import kept_table, table_inputs
from roughfilm.rom.ladder.model import Progress


def kept_asperities(
    heights: Array,
    spacing: tuple[float, float],
    composite_modulus: float,
    hardness: float,
    *,
    surface: str,
    required_load: float = 0.0,
    known: Sequence[Point] = (),
    foreign: Sequence[Point] = (),
    keep: Callable[[Point], None] = lambda _point: None,
    progress: Progress,
) -> AsperityTable:
    """The table of :func:`roughfilm.rom.bearing.mixed.tabulate.tabulate_pressed`, from the cache or made and kept.

    Parameters
    ----------
    heights : heights of one period, shape (nx, ny), m, upward, towards the flat wall.
    spacing : (dx, dy), m.
    composite_modulus, hardness : E* and H, Pa.
    surface : name of the surface for people.
    required_load : load that the table includes, Pa.
    known, foreign : points that are not solved again, see
        :func:`roughfilm.rom.homogenization.table.kept.kept_table`.
    keep : called with each new point.
    progress : called with the done fraction and a few words.
    """
    inputs = table_inputs(
        heights,
        spacing,
        "rom.bearing.mixed.tabulate",
        composite_modulus=composite_modulus,
        hardness=hardness if math.isfinite(hardness) else None,
        required_load=required_load,
    )

    def shown(done: float, words: str) -> None:
        progress(done, f"table of {surface}: {words}")

    def work(known: Sequence[Point], keep: Callable[[Point], None]) -> FactorTable:
        return tabulate_pressed(
            heights,
            spacing,
            composite_modulus,
            hardness=hardness,
            required_load=required_load,
            known=known,
            keep=keep,
            threads=checked_threads(None),
            progress=shown,
        ).factors

    about = {"surface": surface, "kind": "flow factors and contact"}
    return AsperityTable(
        factors=kept_table(inputs, work, about=about, known=known, foreign=foreign, keep=keep, progress=shown)
    )
