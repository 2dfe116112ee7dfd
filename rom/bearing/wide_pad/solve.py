"""The thin film of an infinitely wide pad as a result, with its uncertainty from coarser grids."""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.rounding import round_off
from roughfilm.contact.foundation.timing import working_time
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.outside import channel_outside
from roughfilm.rom.bearing.quantities import EXACT
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.totals.reported import in_order
from roughfilm.rom.bearing.totals.rounding import NO_LOAD
from roughfilm.rom.bearing.warnings import rupture_warnings
from roughfilm.rom.bearing.wide_pad.gap import pad_gap
from roughfilm.rom.bearing.wide_pad.quantities import pad_quantities
from roughfilm.rom.cavitation.evaluation.grids import GRID_SAFETY_FACTOR, MAX_GRID_RATIO, ORDERS
from roughfilm.rom.cavitation.shape import CELLS_PER_FEATURE
from roughfilm.rom.ladder.model import Effect, Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import NO_COARSER_GRID, Field, Numerics, Result, SolverRun, with_uncertainties
from roughfilm.rom.thin_film import newton, thin_film
from roughfilm.rom.thin_film.basis import gauss_basis, sliding_wall_slope
from roughfilm.rom.thin_film.newton import MODES, ThinFilm
from roughfilm.rom.thin_film.thin_film import Strip, StripFlow

GRIDS = (0.4, 0.62, 1.0)
"""Cells of the solved grids over those of the request: halved cells would not show the error of a place in its cell."""

MIN_CELLS = 12
"""Smallest number of cells of a coarser grid."""


@dataclass(frozen=True, kw_only=True)
class _Level:
    """The film of a pad on one grid; pressures above ambient at the faces and shear stresses in the cells, Pa.

    ``through`` is the flow through the pad, m²/s.
    """

    strip: Strip
    film: ThinFilm
    pressure: Array
    shear: Array
    through: float
    quantities: dict[str, Quantity]


def solve(solver: Model[Bearing], scene: Bearing, request: CheckedRequest, progress: Progress) -> Result:
    """Solve the thin-film Navier-Stokes equations between the ends of a pad on successively finer grids.

    The flow on each grid is the start of the search on the next one.

    Raises
    ------
    ConvergenceError
        If Newton's method does not converge on the finest grid.
    """
    wall, cpu = time.perf_counter(), working_time()
    levels: list[_Level] = []
    for cells in sorted({max(MIN_CELLS, round(part * request.resolution)) for part in GRIDS}):
        try:
            levels.append(_level(scene, cells, request.tolerance, solver, progress, levels[-1] if levels else None))
        except ConvergenceError:
            if cells == request.resolution:
                raise
    finest, *coarser = reversed(levels)
    warnings = [
        *_grid_warnings(scene, finest.strip),
        *rupture_warnings(finest.pressure - scene.lubricant.cavitation_pressure),
        *newton.mode_warnings(finest.film.state.amplitudes, newton.MODES),
    ]
    if finest.quantities["load_per_width"].value == 0:
        warnings.append(NO_LOAD)
    uncertainty = _uncertainty([finest, *coarser])
    if not uncertainty:
        warnings.append(NO_COARSER_GRID)
    return Result(
        model=solver.name,
        quantities=in_order(scene, with_uncertainties(finest.quantities, uncertainty)),
        fields=_fields(scene, finest),
        numerics=Numerics(
            residual=finest.film.residual,
            iterations=sum(level.film.steps for level in levels),
            cpu_s=working_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=finest.film.state.amplitudes.size + 1,
            resolution=request.resolution,
            tolerance=request.tolerance,
            scheme=request.scheme,
            runs=tuple(SolverRun(name=str(level.strip.lengths.size), iterations=level.film.steps) for level in levels),
        ),
        provenance=provenance(scene, model=solver.name, keeps=tuple(solver.keeps), sources=solver.sources),
        warnings=tuple(warnings),
        outside=channel_outside(
            scene, finest.strip.thickness * scene.geometry.thinnest, finest.through, finest.pressure
        ),
    )


def _reynolds_number(scene: Bearing) -> float:
    lubricant = scene.lubricant
    return (lubricant.density or 0.0) * abs(scene.motion.speed) * scene.geometry.thinnest / lubricant.viscosity


def _level(
    scene: Bearing, cells: int, tolerance: float, solver: Model[Bearing], progress: Progress, before: _Level | None
) -> _Level:
    """The film on a grid; ``before`` is that on the next coarser one."""
    gap, inlet = pad_gap(scene), scene.inlet_pressure
    pascal = scene.lubricant.viscosity * abs(scene.motion.speed) / gap.film
    strip = thin_film.strip(gap, cells, pressure_difference=(scene.boundary.outlet.pressure - inlet) / pascal)
    film = newton.solve(
        strip,
        _reynolds_number(scene),
        tolerance=tolerance,
        with_slope=Effect.SLOPE in solver.keeps,
        progress=progress,
        start=None if before is None else _on(strip, before),
    )
    across = gauss_basis(MODES)
    pressure = inlet + film.pressure * pascal
    shear = pascal * (1 + thin_film.all_amplitudes(strip, across, film.state) @ sliding_wall_slope(MODES))
    shear /= strip.thickness
    parts = float(np.abs(pressure).max()) + 6 * pascal * float((strip.lengths / strip.thickness**2).sum())
    metre, flow = strip.lengths * gap.film, film.state.flow * abs(scene.motion.speed) * gap.film
    return _Level(
        strip=strip,
        film=film,
        pressure=pressure,
        shear=shear,
        through=flow,
        quantities=pad_quantities(
            scene,
            load=float(metre @ (pressure[1:] + pressure[:-1]) / 2),
            friction=float(metre @ shear),
            inlet_flow=flow,
            outlet_flow=flow,
            pressure_max=float(pressure.max()),
            rounding=round_off(parts, cells) + parts * cells * film.residual,
        ),
    )


def _on(strip: Strip, before: _Level) -> StripFlow:
    """The flow on a coarser grid, interpolated to the cells of another one."""
    known, flow = before.strip.centres, before.film.uncorrected
    return StripFlow(
        amplitudes=np.stack([np.interp(strip.centres, known, one) for one in flow.amplitudes.T], axis=1),
        flow=flow.flow,
    )


def _uncertainty(levels: Sequence[_Level]) -> dict[str, float]:
    """The uncertainty of each quantity in its unit, from those on coarser grids; empty without one.

    It is ``GRID_SAFETY_FACTOR`` times the largest error that the differences give at the lowest order: along smooth
    walls contributions to the error cancel on some grids, so that an order that is observed there may be too high.
    """
    used = levels[:1]
    for level in levels[1:]:
        if level.strip.lengths.size <= MAX_GRID_RATIO * used[-1].strip.lengths.size:
            used = [*used, level]
    finest, *coarser = used
    finer = [(finest.strip.lengths.size / level.strip.lengths.size) ** ORDERS[0] - 1 for level in coarser]
    found = {}
    for name, quantity in finest.quantities.items() if coarser else ():
        others = [level.quantities[name].value for level in coarser if name in level.quantities]
        errors = [abs(quantity.value - other) / ratio for other, ratio in zip(others, finer, strict=False)]
        if len(errors) == len(coarser):
            found[name] = 0.0 if name in EXACT else GRID_SAFETY_FACTOR * max(errors)
    return found


def _grid_warnings(scene: Bearing, strip: Strip) -> list[str]:
    """A warning about a grid that is too coarse for the pockets or the waves of the wall."""
    shape, length = scene.geometry.film_shape(), scene.geometry.length
    if shape.finest[0] >= length:
        return []
    texture, faces = getattr(scene.geometry, "texture", None), strip.faces * scene.geometry.thinnest
    starts = shape.breaks[:-1] if texture is None else [start for start, _ in texture.spans]
    if scene.motion.speed < 0:
        faces = length - faces[::-1]
    cells = min(int(np.ptp(np.searchsorted(faces, [start, start + shape.finest[0]]))) for start in starts)
    if cells >= CELLS_PER_FEATURE:
        return []
    return [
        f"the shortest feature of the wall along the sliding direction has {cells} cells; take at least "
        f"{CELLS_PER_FEATURE / max(cells, 1):.2g} times the resolution"
    ]


def _fields(scene: Bearing, level: _Level) -> dict[str, Field]:
    """The fields in the cells, shape (cells, 1), with x in the coordinates of the scene for either direction."""
    strip, film = level.strip, scene.geometry.thinnest
    pressure = (level.pressure[1:] + level.pressure[:-1]) / 2
    values = {
        "x": (strip.centres * film, "m"),
        "y": (np.zeros_like(pressure), "m"),
        "film_thickness": (strip.thickness * film, "m"),
        "pressure": (pressure, "Pa"),
        "density_ratio": (np.ones_like(pressure), "1"),
        "shear_stress": (level.shear, "Pa"),
    }
    if scene.motion.speed < 0:
        values = {name: (field[::-1], unit) for name, (field, unit) in values.items()}
        values["x"] = (scene.geometry.length - values["x"][0], "m")
    return {name: Field(values=np.ascontiguousarray(one[:, None]), unit=unit) for name, (one, unit) in values.items()}
