"""Patir and Cheng's factors in the place of the cell's, on the same open and pressed gaps of a table."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from contact.mechanics.contact import Contact
from contact.mechanics.press import Press
from rom.gap import Array
from rom.homogenization.factors import FlowFactors
from rom.homogenization.patir_cheng import PatirCheng, patir_cheng
from rom.homogenization.separation import Separations
from rom.homogenization.table import Point
from rom.mixed.asperity_table import AsperityTable
from rom.mixed.tabulate import COMPLEMENTARITY


def with_boxes(
    table: AsperityTable,
    heights: Array,
    spacing: tuple[float, float],
    composite_modulus: float,
    hardness: float,
    advance: Callable[[str], None] = lambda _words: None,
) -> AsperityTable:
    """The table with φ₁ĥ³, φ₂ĥ³ and ĥ + σφ_s for A₁₁, A₂₂ and B₁, and 0 for A₁₂ and B₂.

    Contact pressures, d and e stay those of the cell: the method has factors of its own for friction, which differ from
    these where B₂ counts, and the source compares flow alone.

    Parameters
    ----------
    heights, spacing, composite_modulus, hardness : what the table was made of.
    """
    body = Separations(heights=np.asarray(heights, dtype=np.float64))
    press = Press(body.heights, spacing, composite_modulus, hardness=hardness)
    points: list[Point] = []
    before: Contact | None = None
    for point in sorted(table.factors.points, key=lambda point: point.load):
        advance(f"Patir and Cheng, {len(points)} of {len(table.factors.points)} points")
        if point.load > 0:
            near = before if before is not None and before.load > point.load / 4 else None
            before = press.at(point.load, tolerance=COMPLEMENTARITY, start=near)
        points.append(_boxed(point, body.gap(point.separation) if before is None else before.gap, spacing))
    ordered = tuple(sorted(points, key=lambda point: point.mean_gap))
    return AsperityTable(factors=replace(table.factors, points=ordered))


def _boxed(point: Point, gap: Array, spacing: tuple[float, float]) -> Point:
    dx, dy = spacing
    box, coarse = patir_cheng(gap, spacing), patir_cheng(gap[::2, ::2], (2 * dx, 2 * dy))
    doubt = replace(
        point.uncertainty,
        pressure=np.diag(np.abs(box.pressure - coarse.pressure)),
        shear=np.array([abs(box.shear - coarse.shear), 0.0]),
    )
    return replace(point, factors=_factors(point.factors, box), uncertainty=doubt)


def _factors(cell: FlowFactors, box: PatirCheng) -> FlowFactors:
    return replace(cell, pressure=np.diag(box.pressure), shear=np.array([box.shear, 0.0]), sealed=box.sealed)
