"""What Patir and Cheng's factors make of a table: the same gaps and contacts, each in a box with closed sides."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.bearing.mixed.asperity_table import AsperityTable
from roughfilm.rom.bearing.mixed.tabulate import gap_of
from roughfilm.rom.homogenization.patir_cheng import patir_cheng
from roughfilm.rom.homogenization.table.factor_table import Point
from roughfilm.rom.ladder.model import Progress, silent


def patir_cheng_table(
    table: AsperityTable,
    press: Press,
    *,
    keep: Callable[[Point], object] = lambda _point: None,
    known: dict[float, Point] | None = None,
    progress: Progress = silent,
) -> AsperityTable:
    """The table with φ₁ĥ³ and φ₂ĥ³ in the place of A, without A₁₂, and with ĥ + σφ_s in that of B, without B₂.

    Friction and contact pressures stay: Patir and Cheng's model is compared by what flows alone (Sahlin 2008, E.3.2).
    What the homogenized factors say of grids and interpolation is taken over.

    Parameters
    ----------
    table : of homogenized factors.
    press : the surface that it is of, with its solids.
    known : points by mean gap that need not be solved again.
    keep : called with every new point.

    Raises
    ------
    ConvergenceError
        If a box or a contact does not converge.
    """
    points = []
    for number, point in enumerate(table.factors.points):
        progress(number / len(table.factors.points), f"Patir and Cheng, {number} of {len(table.factors.points)} points")
        made = (known or {}).get(point.mean_gap)
        if made is None:
            made = _in_a_box(point, press)
            keep(made)
        points.append(made)
    return replace(table, factors=replace(table.factors, points=tuple(points)))


def _in_a_box(point: Point, press: Press) -> Point:
    box = patir_cheng(gap_of(point, press), press.spacing)
    scale = point.mean_gap / box.mean_gap
    factors = replace(
        point.factors,
        pressure=np.diag(box.pressure) * scale**3,
        shear=np.array([box.shear * scale, 0.0]),
        sealed=box.sealed,
    )
    return replace(point, factors=factors, iterations=box.iterations, residual=box.residual)
