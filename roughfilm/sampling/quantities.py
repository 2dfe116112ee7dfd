"""The quantities of one window, computed from its periodic cell in a process of its own."""

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from roughfilm.batch.execute import CHUNK_S, ONE_AT_A_TIME, refuse_other_code
from roughfilm.batch.jobs import Failure, failure_of
from roughfilm.contact.foundation.arrays import Array, finite_arithmetic
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.timing import stopwatch
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.foundation.writing.scratch import scratch_directory
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.ladder import find
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import silent
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.seal.scene import Seal
from roughfilm.sampling.asked import Asked, with_cell

LEFT_OUT = ("Std", "sealed", "smooth_leakage", "dimensionless_leakage", "area_fraction_pixel", "A21")
"""Quantities that are left out: angles do not average, sealed windows leak nothing, and the others follow from some."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """The answer for one cell.

    Attributes
    ----------
    quantities : quantities with their numerical uncertainties, by name; empty after a failure.
    warnings : sentences about this window.
    failure : reason if there is no answer.
    cpu_s : CPU time, s.
    """

    quantities: Mapping[str, Quantity]
    warnings: tuple[str, ...] = ()
    failure: Failure | None = None
    cpu_s: float = 0.0


def rows_of(cells: Sequence[Surface], asked: Asked, origin: tuple[str, dict[str, Any]]) -> list[Row]:
    """The rows of cells in order, in a worker; other calls in its process wait.

    After twice the time of a chunk no further cell is started, so that the result may be shorter than the input.

    Raises UnavailableError if the worker's code or libraries are not those of ``origin``.
    """
    refuse_other_code(origin)
    rows: list[Row] = []
    with ONE_AT_A_TIME:
        end = time.monotonic() + 2 * CHUNK_S
        for cell in cells:
            if rows and time.monotonic() > end:
                break
            rows.append(row_of(cell, asked))
    return rows


def row_of(cell: Surface, asked: Asked) -> Row:
    """The row of one cell; an error is its failure."""
    spent = stopwatch()
    try:
        with finite_arithmetic("windows"):
            quantities, warnings = _quantities(cell, asked)
        finite = {
            name: quantity
            for name, quantity in quantities.items()
            if name not in LEFT_OUT and math.isfinite(quantity.value)
        }
        return Row(quantities=finite, warnings=warnings, cpu_s=spent()["cpu_s"])
    except Exception as error:  # any error of a window is a failure of this window alone
        return Row(quantities={}, failure=failure_of(error), cpu_s=spent()["cpu_s"])


def _quantities(cell: Surface, asked: Asked) -> tuple[Mapping[str, Quantity], tuple[str, ...]]:
    if not asked.scene:
        return _parameters(cell, asked.gap), ()
    with scratch_directory() as place:
        path = place / "cell.h5"
        save_surface(cell, path)
        scene = with_cell(asked, path)
        match scene:
            case DryContact():
                found, warnings = _dry_contact(scene)
            case Seal():
                found, warnings = _seal(scene, asked.sealing)
            case Bearing():
                found, warnings = _bearing(scene, place, asked.resolution)
            case _:
                raise InputError(f"scene: kind: got {scene.kind!r}")
    return {"rms_height": Quantity(value=float(cell.heights.std()), unit="m"), **found}, warnings


def _parameters(cell: Surface, gap: float | None) -> dict[str, Quantity]:
    """The roughness parameters of the cell and, at a mean gap, the flow factors against a smooth wall."""
    from roughfilm.contact.parameters.roughness_parameters import parameters
    from roughfilm.rom.homogenization.conductance import FaceRule
    from roughfilm.rom.homogenization.factors import relative_quantities
    from roughfilm.rom.homogenization.flow_factors import flow_factors
    from roughfilm.rom.homogenization.table.separation import Separations

    own = parameters(cell)
    if gap is None:
        return own
    walls = Separations(heights=cell.heights)
    cut = flow_factors(walls.gap(walls.at_mean_gap(gap)), cell.spacing, rule=FaceRule.LINEAR)
    return {"Sq": own["Sq"], **relative_quantities(cut.factors, cut.uncertainty), **own}


def _dry_contact(scene: DryContact) -> tuple[Mapping[str, Quantity], tuple[str, ...]]:
    result = _solved(scene, "elastic" if scene.solid.hardness is None else "elastic_plastic")
    return result.quantities, (*result.outside, *result.warnings)


def _seal(scene: Seal, sealing: bool) -> tuple[Mapping[str, Quantity], tuple[str, ...]]:
    """Contact, leakage, the flow factors of the gap under load and, if asked, the load at which the seal closes."""
    result = _solved(scene, "direct_leakage")
    gap = result.fields["gap"].values
    factors = _factors(gap, scene.surface().spacing, result.quantities["mean_gap"].uncertainty) if gap.any() else {}
    more = {"sealing_load": _sealing_load(scene)} if sealing else {}
    return {**result.quantities, **more, **factors}, (*result.outside, *result.warnings)


def _solved(scene: Scene, model: str) -> Result:
    return find(scene.kind, model).solve(scene, Request())


def _factors(gap: Array, spacing: tuple[float, float], of_gap: float | None) -> dict[str, Quantity]:
    """The flow factors of a gap; the uncertainty of its mean gap adds to those of A11 and A22 in squares."""
    from roughfilm.rom.homogenization.factors import relative_quantities
    from roughfilm.rom.homogenization.flow_factors import flow_factors
    from roughfilm.rom.homogenization.flux import widening

    found = flow_factors(gap, spacing)
    own, mean = relative_quantities(found.factors, found.uncertainty), found.factors.mean_gap
    for axis, name in enumerate(("A11", "A22")):
        half = own[name].uncertainty
        if of_gap is None or half is None:
            own[name] = replace(own[name], uncertainty=None)
        elif not found.factors.sealed[axis]:
            rate = widening(gap, spacing, found.correctors[axis], axis) / mean**3 - 3 * own[name].value / mean
            own[name] = replace(own[name], uncertainty=math.hypot(half, of_gap * rate))
    return own


def _sealing_load(scene: Seal) -> Quantity:
    """The load at which the seal closes along its flow; infinite if it closes at none."""
    from roughfilm.contact.mechanics.press import Press
    from roughfilm.rom.homogenization.paths import sealed_between_ends
    from roughfilm.rom.seal.leakage.curve import LIGHT_CONTACT_RATIO, START_AREA
    from roughfilm.rom.seal.leakage.percolation import thresholds

    surface = scene.surface()
    press = Press(surface.heights, surface.spacing, scene.composite_modulus, hardness=scene.hardness)
    most = min(press.hardness, press.composite_modulus)
    begin = min(START_AREA / LIGHT_CONTACT_RATIO * scene.pressure_unit, most / 2)

    def closed(gap: Array) -> tuple[bool]:
        return (sealed_between_ends(gap if scene.axis == 0 else gap.T, joined=True),)

    (found,) = thresholds(lambda load, start: press.at(load, start=start), begin, most, look=closed)
    half = 0.0
    if found.open is not None and found.sealed is not None:
        half = 0.5 * (found.sealed.load - found.open.load)
    return Quantity(value=found.load, unit="Pa", uncertainty=half)


def _bearing(scene: Bearing, place: Path, resolution: int) -> tuple[Mapping[str, Quantity], tuple[str, ...]]:
    """The point of the Stribeck curve at the speed and load of the scene."""
    from roughfilm.rom.bearing.mixed.curves import wall_of
    from roughfilm.rom.bearing.mixed.store import UNITS
    from roughfilm.rom.bearing.mixed.stribeck import UNCERTAIN, stribeck

    pressure = scene.load_pressure
    if pressure is None:
        raise InputError("scene.load: is missing; windows are compared at one load")
    wall = None
    if scene.asperities is not None:
        wall = wall_of(scene, pressure, None, place / "table.h5", silent, resolution)
    speed = abs(scene.motion.speed)
    asperities = None if wall is None else wall.asperities
    (curve,) = stribeck(scene, [speed], [pressure], asperities=asperities, resolution=resolution)
    (point,) = curve.points
    found = {
        name: Quantity(value=getattr(point, name), unit=UNITS.get(name, "1"), uncertainty=point.uncertainty.get(name))
        for name in UNCERTAIN
    }
    if wall is None:  # a film without asperities has no contact
        return {name: quantity for name, quantity in found.items() if not name.startswith("contact_")}, ()
    return found, wall.warnings
