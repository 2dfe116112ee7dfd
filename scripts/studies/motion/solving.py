"""Answers of the commands on a grid with what they state, and truths by finer grids of other shapes."""

import math
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.ladder import find
from roughfilm.rom.bearing.dynamics.point import GridPoint, finished, grid_point, rotation_of
from roughfilm.rom.bearing.dynamics.sweep import dynamics
from roughfilm.rom.bearing.free.equilibrium import equilibrium, refined
from roughfilm.rom.bearing.free.evaluated import evaluated
from roughfilm.rom.bearing.free.film import FreeFilm, free_film
from roughfilm.rom.bearing.free.solve import FreeSolution
from roughfilm.rom.bearing.march.course import Duty
from roughfilm.rom.bearing.march.series import run
from roughfilm.rom.bearing.march.solve import march_bearing, numerics_of
from roughfilm.rom.bearing.march.summary import summary_of
from roughfilm.rom.bearing.quantities import FILM_OUTPUTS
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.motion.coupled import Instant
from roughfilm.rom.ladder.request import Request

MODEL = "reynolds_cavitating"
"""Model whose equilibria are judged."""

TOLERANCE = 1e-10
"""Residual at which the films of a truth are solved."""

HEATED_RATIOS = ((2.0, 2.0), (4.0, 4.0))
"""The same as ``RATIOS`` of a film with temperatures."""

RATIOS = ((2.0, 2.0), (2.7, 4.0), (4.0, 4.0))
"""Cells along and across of the grids of a truth over those of the answer; the second one shares few of its nodes."""

MARCH_RATIOS = ((1.5, 1.5), (2.2, 2.2))
"""The same of a march."""

TIGHTER = 8.0
"""Error of a step of the answer over that of a truth, whose largest step is √8 times shorter too."""

TURNS: Mapping[str, float] = {"attitude_angle": 360.0, "film_min_angle": 360.0, "film_start": 1.0, "rupture": 1.0}
"""Period of quantities that are places around a full bore."""

Values = dict[str, float]
"""Value of each quantity in its unit."""


@dataclass(frozen=True, kw_only=True)
class Stated:
    """An answer: its quantities, and the uncertainties of those that state one."""

    values: Values
    uncertainty: Values
    warned: bool
    cpu_s: float


@dataclass(frozen=True, kw_only=True)
class Truth:
    """The truth of an answer: the quantities, and their uncertainties."""

    values: Values
    uncertainty: Values


def solve_answer(scene: Bearing, cells: int, model: str = MODEL) -> Stated:
    """Return the film of a bearing on a grid, as ``roughfilm solve`` states it."""
    result = find("bearing", model).solve(scene, Request(resolution=cells))
    return Stated(
        values={name: one.value for name, one in result.quantities.items()},
        uncertainty={name: one.uncertainty for name, one in result.quantities.items() if one.uncertainty is not None},
        warned=bool(result.warnings),
        cpu_s=result.numerics.cpu_s,
    )


def dynamics_answer(scene: Bearing, cells: int) -> Stated:
    """Return stiffness, damping and whirl of a bearing on a grid, as ``roughfilm dynamics`` states them."""
    assert scene.load_pressure is not None
    point = dynamics(scene, [abs(scene.motion.speed)], [scene.load_pressure], resolution=cells)[0].points[0]
    return Stated(
        values=_finite(point.numbers),
        uncertainty=_finite(point.uncertainty),
        warned=False,
        cpu_s=point.cpu_s,
    )


def truths(scene: Bearing, cells: int) -> tuple[Truth, Truth]:
    """Return the truths of equilibrium, and of stiffness and damping, from grids finer than ``cells``.

    Raises
    ------
    InputError, ConvergenceError
        If one of the grids has no equilibrium.
    """
    statics: list[Values] = []
    points: list[GridPoint] = []
    for film, instant in _settled(scene, cells):
        alone = FreeSolution(films=(film,), instants=(instant,), solved=())
        statics.append({name: one.value for name, one in evaluated(alone, FILM_OUTPUTS).levels[0][1].items()})
        points.append(grid_point(film, instant, 1.0))
    rotation = rotation_of(scene, scene.motion.speed)
    numbers = [_finite(finished([point], rotation)[0]) for point in points]
    return extrapolated(statics, RATIOS), extrapolated(numbers, RATIOS)


def heated_truth(scene: Bearing, cells: int, model: str) -> Truth:
    """Return the truth of a film with temperatures from grids finer than ``cells``.

    Raises
    ------
    InputError, ConvergenceError
        If the film or its temperatures do not converge on one of the grids.
    """
    levels = [solve_answer(scene, round(along * cells), model).values for along, _ in HEATED_RATIOS]
    return extrapolated(levels, HEATED_RATIOS)


def heated_dynamics_truth(scene: Bearing, cells: int) -> Truth:
    """Return the truth of stiffness and damping with the heat balanced, from grids finer than ``cells``.

    Raises
    ------
    InputError, ConvergenceError
        If there is no equilibrium on one of the grids.
    """
    levels = [dynamics_answer(scene, round(along * cells)).values for along, _ in HEATED_RATIOS]
    return extrapolated(levels, HEATED_RATIOS)


def _settled(scene: Bearing, cells: int) -> Iterator[tuple[FreeFilm, Instant]]:
    """Solve for the equilibrium on each grid of a truth; each starts from the one before."""
    before: tuple[FreeFilm, Instant] | None = None
    for along, across in RATIOS:
        film = free_film(scene, (round(along * cells), round(across * cells / 2)))
        start = None if before is None else refined(*before, film)
        with np.errstate(all="ignore"):
            before = film, equilibrium(film, start, tolerance=TOLERANCE)
        yield before


def extrapolated(levels: list[Values], ratios: tuple[tuple[float, float], ...]) -> Truth:
    """Return values extrapolated from the first and the last grid with the second order.

    The uncertainty is the largest difference of the truth from the finest grid and from those between.

    Parameters
    ----------
    levels : the quantities on each grid, from coarse to fine.
    ratios : cells of these grids along and across; the first and the last one have one shape.
    """
    first, *others = levels
    last = others[-1]
    ratio = ratios[-1][0] / ratios[0][0]
    values, uncertainty = {}, {}
    for name in first.keys() & last.keys():
        known = [nearest(name, one[name], last[name]) for one in levels if name in one]
        values[name] = known[-1] + (known[-1] - known[0]) / (ratio**2 - 1)
        uncertainty[name] = max(abs(values[name] - one) for one in known[1:])
    return Truth(values=values, uncertainty=uncertainty)


def nearest(name: str, value: float, place: float) -> float:
    """Return a value, that of a place around a bore by the turn that is nearest to another one."""
    turn = TURNS.get(name)
    return value if turn is None else place + math.remainder(value - place, turn)


def march_answer(scene: Bearing, end: float, cells: int) -> Stated:
    """Return the answer of a march on a grid, as ``roughfilm march`` states it."""
    begun = time.process_time()
    march = march_bearing(scene, end=end, cells=(cells, cells // 2))
    return Stated(
        values={name: one.value for name, one in march.quantities.items()},
        uncertainty={name: one.uncertainty for name, one in march.quantities.items() if one.uncertainty is not None},
        warned=bool(march.warnings),
        cpu_s=time.process_time() - begun,
    )


def march_truth(scene: Bearing, end: float, cells: int, error: float) -> Truth:
    """Return the truth of a march, on finer grids with steps of a smaller error.

    Parameters
    ----------
    error : error of a step of the answer; that of the truth is ``TIGHTER`` times smaller.
    """
    duty, levels = Duty(scene=scene), []
    for along, across in MARCH_RATIOS:
        grid = (2 * round(along * cells / 2), 2 * round(across * cells / 4))
        given = numerics_of(duty, end=end, error=error / TIGHTER, steps=None, cells=grid, fields=0)
        series = run(duty, replace(given, step=given.step / math.sqrt(TIGHTER)))
        levels.append({name: one.value for name, one in summary_of(duty, series).quantities.items()})
    return extrapolated(levels, MARCH_RATIOS)


def _finite(values: Mapping[str, float]) -> Values:
    return {name: value for name, value in values.items() if math.isfinite(value)}
