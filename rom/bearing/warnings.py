"""Warnings about films outside the range of their grid, their lubricant laws or their scene."""

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.rounding import share
from roughfilm.rom.bearing.corners import CARRIED, PUMPED, infinite_flows, jumps
from roughfilm.rom.bearing.free.lay import StraightFactors
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.quantities import scene_positions
from roughfilm.rom.bearing.roughness import RoughSurface
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.totals.pads import unloaded
from roughfilm.rom.cavitation.balance import CAVITY, FILM
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.homogenization.table.factor_table import FactorTable

MAX_SIDE_PRESSURE = 0.01
"""Largest pressure at a side over the largest pressure of the film that a model without sides leaves out unwarned."""

MAX_THICKNESS = 0.1
"""Largest film thickness over the length or the width of a film up to which it counts as thin."""

MAX_PRESSURE = 3e9
"""Pressure above which no wall is rigid and no oil is liquid, Pa."""

ROUNDING = 1e-9
"""Pressure over the largest one below which it is zero."""


def thickness_warnings(scene: Bearing, solution: Solution) -> list[str]:
    """A warning if the film is not thin beside its length and width."""
    thickest, geometry = float(solution.faces.thickness.max()), scene.geometry
    smaller = min(geometry.length, geometry.width or geometry.length)
    if thickest <= MAX_THICKNESS * smaller:
        return []
    return [
        f"film thickness: up to {thickest:.3g} m, over a tenth of the length or width of {smaller:.3g} m; the "
        "equations of thin films do not hold, check load, film and slopes"
    ]


def pressure_warnings(solution: Solution) -> list[str]:
    """Warnings about pressures above the range of validity of a lubricant law, or above any that rigid walls bear."""
    problem, highest = solution.problem, float(solution.state.pressure.max())
    beyond = [f"pressure: {highest:.3g} Pa; walls deform and oils turn solid above about {MAX_PRESSURE:.0e} Pa"]
    return (beyond if highest > MAX_PRESSURE else []) + [
        f"pressure: {highest:.3g} Pa above cavitation pressure; the law {law.law} is valid up to {law.valid_to:.3g} Pa"
        for law in (problem.compressibility, problem.piezoviscosity)
        if highest > law.valid_to
    ]


def rupture_warnings(pressure: Array) -> list[str]:
    """A warning if a film without cavitation has a pressure above cavitation pressure, Pa, that is negative."""
    lowest, rounding = float(pressure.min()), ROUNDING * float(np.abs(pressure).max())
    if lowest >= -rounding:
        return []
    return [
        f"pressure: falls to {-lowest / 1e3:.4g} kPa below the cavitation pressure: the film ruptures, which this "
        "model leaves out; take reynolds_cavitating"
    ]


def window_warnings(scene: Bearing, solution: Solution) -> list[str]:
    """A warning if the flow factors are means over windows, whose scatter the uncertainty leaves out."""
    table = solution.problem.shape.roughness
    table = table.factors if isinstance(table, StraightFactors) else table
    if not isinstance(table, FactorTable) or all(point.scatter is None for point in table.points):
        return []
    relative = table.scatter_above(scene.geometry.thinnest)
    size = "whose scatter, which is unknown," if relative is None else f"whose scatter of up to {share(relative)}"
    return [f"roughness: the flow factors are means over windows, {size} the uncertainty of the results leaves out"]


def pad_warnings(scene: Bearing, solution: Solution) -> list[str]:
    """A warning for the pads of a journal bearing, at the place of its shaft, that tilt and carry no load."""
    geometry = scene.geometry
    if not isinstance(geometry, Lobes) or geometry.pivot is None:
        return []
    pressure = solution.state.pressure + scene.lubricant.cavitation_pressure
    idle = unloaded(geometry, scene_positions(solution), solution.grid.areas * pressure)
    if not idle:
        return []
    many = len(idle) > 1
    return [
        f"{'pads' if many else 'pad'} {', '.join(map(str, idle))} {'carry' if many else 'carries'} no load, and "
        f"{'rest' if many else 'rests'} where the film just ruptures; such pads may flutter, raise the preload"
    ]


def scene_warnings(scene: Bearing, solution: Solution) -> list[str]:
    """Warnings about boundary conditions.

    They are no film, starved inlets without sliding or below ambient, pressures at sides that the model leaves out, and
    jumps of the pressure.
    """
    ends, lowest = solution.problem.ends, scene.lubricant.cavitation_pressure
    warnings = [*(scene.roughness.warnings() if isinstance(scene.roughness, RoughSurface) else ())]
    if (solution.kind == CAVITY).any() and not (solution.kind == FILM).any():
        warnings.append("no film forms: the inlet flow is smaller than the flow that the narrowest place can carry")
    if scene.motion.speed == 0 and ends.theta < 1:
        warnings.append("the sliding speed is zero; the starved inlet is treated as flooded")
    elif ends.inlet is None and lowest < 0:
        warnings.append(
            f"the inlet with a theta is at the cavitation pressure, {-lowest:.3g} Pa below ambient; if it is open to "
            "ambient air, set lubricant.cavitation_pressure to 0 Pa"
        )
    sides = scene.boundary.sides
    fed, highest = max(abs(sides.low), abs(sides.high)), float(solution.state.pressure.max()) + lowest
    if scene.geometry.width is not None and ends.sides is None and fed > MAX_SIDE_PRESSURE * highest:
        warnings.append(
            f"boundary.sides: one line leaves out the pressure of {fed:.3g} Pa at a side, while the largest one in the "
            f"film is {highest:.3g} Pa; take reynolds_cavitating"
        )
    return warnings + _infinite_flows(scene, solution)


def _infinite_flows(scene: Bearing, solution: Solution) -> list[str]:
    """One warning for all jumps of the pressure at corners of the film, with the flows that they make infinite."""
    found = jumps(solution)
    if not found:
        return []
    lobes = isinstance(scene.geometry, Lobes) and not scene.geometry.single
    corners = {(("gaps" if lobes else jump.end), jump.side): jump.difference for jump in found}
    named = ", ".join(f"{end} and {side} side ({by:+.3g} Pa)" for (end, side), by in corners.items())
    remedy = ", or [[supply]] with grooves that end before the sides" if lobes else ""
    heated = "" if scene.lubricant.lacking else f"; {', '.join((*CARRIED, *PUMPED))} change with them"
    return [
        f"the pressure jumps between {named}: the flows through these edges are infinite, and "
        f"{', '.join(sorted(infinite_flows(solution)))} grow with the logarithm of the cells{heated}; give both "
        f"edges the same pressure{remedy}"
    ]
