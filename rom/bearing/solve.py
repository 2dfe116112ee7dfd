"""What the rungs of a bearing share: the grid they work on, their quantities, fields and bookkeeping."""

import math
import time
from collections.abc import Callable, Mapping
from functools import cache

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.model import RESOLVED, Reading, Values
from roughfilm.rom.bearing.quantities import density_ratio, nominal_area
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.balance import CAVITY, FILM
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.cavitation.solve import solve as balance
from roughfilm.rom.ladder.model import Model, Progress
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Field, Numerics, Result, SolverRun, with_uncertainties
from roughfilm.rom.pocket.validity import NO_COARSER_GRID

WARM_UP = 40
"""Cells of a film on which every loop is run once."""

PLACES = ("film_start", "rupture", "cavitated_fraction")
"""Quantities that follow the nodes."""

BALANCED = 0.01
"""How near a given film's load is to that of the scene, as a part of it, not to be told."""

SAFETY = 3.0
"""Of an error estimated from two grids: Roache 1994, doi:10.1115/1.2910291."""


def solve(
    solver: Model[Bearing],
    scene: Bearing,
    request: CheckedRequest,
    progress: Progress,
    *,
    film: Callable[[Bearing], Problem],
    ruptures: bool,
    reading: Reading,
) -> Result:
    """Solve a bearing's film on ``resolution`` cells, and on half as many to say how far off it is.

    Raises
    ------
    InputError
        For a scene to which the model does not apply.
    ConvergenceError
        If the film does not come into balance.
    """
    model, keeps, sources = solver.name, solver.keeps, solver.sources
    cells, tolerance, scheme = request.resolution, request.tolerance, request.scheme
    fits = solver.applies(scene)
    if not fits.applies:
        raise InputError(f"model: got {model!r}; {fits.reason}")
    problem = film(scene)
    load_loops(problem.shape.wide)
    wall, cpu = time.perf_counter(), time.process_time()
    found = balance(problem, (cells, cells), tolerance=tolerance, ruptures=ruptures, progress=progress)
    quantities = reading.quantities(scene, found)
    warnings = [*unresolved(found), *beyond(found), *odd(scene, found), *unbalanced(scene, found, quantities)]
    uncertainty = uncertainties(scene, found, quantities, reading)
    if not uncertainty:
        warnings.append(NO_COARSER_GRID)
    if unknown := [name for name, bar in uncertainty.items() if not math.isfinite(bar)]:
        warnings.append(f"{', '.join(unknown)}: {NO_COARSER_GRID}, as the roughness has too few points")
    return Result(
        model=model,
        quantities=with_uncertainties(quantities, uncertainty),
        fields=_fields(scene, found, reading.fields(scene, found)),
        numerics=Numerics(
            residual=found.residual,
            iterations=sum(level.iterations for level in found.levels),
            cpu_s=time.process_time() - cpu,
            wall_s=time.perf_counter() - wall,
            degrees_of_freedom=found.state.pressure.size,
            resolution=cells,
            tolerance=tolerance,
            scheme=scheme,
            runs=tuple(
                SolverRun(name=" x ".join(map(str, level.shape)), iterations=level.iterations) for level in found.levels
            ),
        ),
        provenance=provenance(scene, model=model, keeps=tuple(keeps), sources=sources),
        warnings=tuple(warnings),
    )


def unresolved(found: Solution) -> list[str]:
    """What must be known of a grid that is too coarse for the wall's features."""
    shape, grid = found.problem.shape, found.grid
    told = []
    for name, feature, spacing in zip(("along", "across"), shape.finest, (grid.spacing_x, grid.spacing_y), strict=True):
        cells = feature / spacing.max() if spacing.max() > 0 else math.inf
        if cells < 0.99 * RESOLVED:
            told.append(
                f"the shortest feature of the wall {name} the sliding has {cells:.2g} cells; take at least "
                f"{RESOLVED / cells:.2g} times the resolution"
            )
    return told


def beyond(found: Solution) -> list[str]:
    """What must be known of pressures for which a law of the lubricant is not meant."""
    problem, greatest = found.problem, float(found.state.pressure.max())
    return [
        f"pressure reaches {greatest:.3g} Pa above that of cavitation; the law {law.law} is meant for up to "
        f"{law.valid_to:.3g} Pa"
        for law in (problem.compressibility, problem.piezoviscosity)
        if greatest > law.valid_to
    ]


def uncertainties(
    scene: Bearing, found: Solution, quantities: Mapping[str, Quantity], reading: Reading
) -> dict[str, float]:
    """How far off each quantity may be, in its unit, from the two grids before; nothing without a coarser grid.

    SAFETY/3 times the larger of the last step and a quarter of the step before, as is right for second order; where a
    film begins or ends at least a cell, and with what the residual may add up to along the film; where roughness is
    averaged, with what its factors may be off.
    """
    before = found.coarser
    if before is None or before.grid.x.size > 0.75 * found.grid.x.size:
        return {}
    cells = found.grid.x.size
    one, two = reading.quantities(scene, before), None
    if before.coarser is not None and before.coarser.grid.x.size <= 0.75 * before.grid.x.size:
        two = reading.quantities(scene, before.coarser)
    doubt = {} if found.problem.shape.roughness is None else reading.doubt(scene, found, quantities)
    told = {}
    for name, quantity in quantities.items():
        if name in one:
            step = abs(quantity.value - one[name].value)
            if two is not None and name in two:
                step = max(step, abs(one[name].value - two[name].value) / 4)
            least = 1 / cells if name in PLACES else 0.0
            told[name] = max(SAFETY * step / 3, least) + abs(quantity.value) * found.residual * cells
            told[name] += doubt.get(name, 0.0)
    return told


def odd(scene: Bearing, found: Solution) -> list[str]:
    """What else must be known of a film."""
    told, ends = [], found.problem.ends
    if (found.kind == CAVITY).any() and not (found.kind == FILM).any():
        told.append("no film forms: the inlet brings less than the narrowest place lets through")
    if scene.motion.speed == 0 and ends.theta < 1:
        told.append("the wall does not slide, so that nothing is brought: the starved inlet is taken as full")
    if ends.sides is not None and not found.problem.shape.joined[0]:
        jumps = {ends.inlet or 0.0, ends.outlet} - set(ends.sides)
        if jumps:
            told.append("pressure jumps at the corners: flows through the ends grow with the logarithm of the cells")
    return told


def unbalanced(scene: Bearing, found: Solution, quantities: Mapping[str, Quantity]) -> list[str]:
    """What must be known of a film that is given where the scene says a load."""
    if scene.load is None:
        return []
    width = 1.0 if found.problem.shape.wide else scene.geometry.width or 1.0
    carried = quantities["load_per_width"].value * width / nominal_area(scene, found.grid)
    if abs(carried - scene.load.pressure) <= BALANCED * scene.load.pressure:
        return []
    return [
        f"the film is taken as given: it carries {carried:.4g} Pa over the nominal area, and not the "
        f"{scene.load.pressure:.4g} Pa of the scene; roughfilm effects finds the film under its load"
    ]


@cache
def load_loops(wide: bool) -> None:
    """Have numba compile or read the loops, once in a process: no film's clock should run meanwhile."""
    shape = Shape(thickness=lambda x, y: 1e-6 * (2 - x) + 0 * y, breaks=(0.0, 1.0), wide=wide)
    ends = Ends(sides=None if wide else (0.0, 0.0))
    balance(Problem(shape=shape, ends=ends, speed=1.0, viscosity=1.0), (WARM_UP, WARM_UP))


def _fields(scene: Bearing, found: Solution, more: Values) -> dict[str, Field]:
    """Over the grid, shape (nx, ny); x as the scene counts it, whichever way the wall slides."""
    shape = found.problem.shape
    places = np.meshgrid(found.grid.x, found.grid.y, indexing="ij")
    values: Values = {
        "x": (places[0], "rad" if shape.polar else "m"),
        "y": (places[1], "m"),
        "film_thickness": (found.faces.thickness, "m"),
        "pressure": (found.state.pressure + scene.lubricant.cavitation_pressure, "Pa"),
        "density_ratio": (density_ratio(found), "1"),
        **more,
    }
    if found.turned:
        x, unit = values["x"]
        values = {name: (field[::-1], told) for name, (field, told) in values.items()}
        values["x"] = (shape.breaks[0] + shape.breaks[-1] - x[::-1], unit)
    return {name: Field(values=np.ascontiguousarray(field), unit=unit) for name, (field, unit) in values.items()}
