"""Tables with the flow factors of Patir and Cheng, computed in boxes with closed sides."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.mixed.tabulate import gap_of
from roughfilm.rom.homogenization.patir_cheng import patir_cheng
from roughfilm.rom.homogenization.table.factor_table import UNKNOWN_SLOPES, Point
from roughfilm.rom.ladder.model import Progress, silent


def patir_cheng_table(
    table: AsperityTable,
    press: Press,
    *,
    keep: Callable[[Point], object] = lambda _point: None,
    known: dict[float, Point] | None = None,
    progress: Progress = silent,
) -> AsperityTable:
    """Replace the homogenized flow factors of a table by those of Patir and Cheng (Sahlin 2008, E.3.2).

    A₁₁ and A₂₂ become φ₁ĥ³ and φ₂ĥ³, B₁ becomes ĥ + σφ_s, and A₁₂ and B₂ become 0. Friction factors, contact pressures,
    uncertainties and interpolation errors remain those of the homogenized table.

    Parameters
    ----------
    table : table of homogenized factors.
    press : the surface of the table, with its solids.
    known : points by mean gap that are not solved again.
    keep : called with each new point.

    Raises
    ------
    ConvergenceError
        If a box or a contact does not converge.
    """
    points = []
    for number, point in enumerate(table.factors.points):
        progress(number / len(table.factors.points), f"Patir and Cheng, {number} of {len(table.factors.points)} points")
        replaced = (known or {}).get(point.mean_gap)
        if replaced is None:
            replaced = _in_box(point, press)
            keep(replaced)
        points.append(replaced)
    return replace(table, factors=replace(table.factors, points=tuple(points)))


def _in_box(point: Point, press: Press) -> Point:
    """The point with the flow factors of Patir and Cheng."""
    box = patir_cheng(gap_of(point, press), press.spacing)
    scale = point.mean_gap / box.mean_gap
    factors = replace(
        point.factors,
        pressure=np.diag(box.pressure) * scale**3,
        shear=np.array([box.shear * scale, 0.0]),
        sealed=box.sealed,
    )
    return replace(point, factors=factors, slopes=UNKNOWN_SLOPES, iterations=box.iterations, residual=box.residual)
