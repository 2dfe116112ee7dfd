"""Finer solutions of the models of a scene, extrapolated, as the truth of their own equations."""

import signal
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from functools import cache, partial

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.ladder import models
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model, best_for
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.studies.convergence import converge
from scripts.studies.coverage.answering import judged_resolution
from scripts.studies.coverage.surfaces import refined
from scripts.studies.coverage.truth import Truth

SHARE = 0.2
"""Largest uncertainty of a truth over the uncertainty that it judges."""

MAX_CPU_S = 0.3
"""Largest expected CPU time of one finer solution, s; of the two that are needed at least, ``MAX_NEEDED_S``."""

MAX_NEEDED_S = 3.0

MAX_SOLVE_S = 5.0
"""CPU time after which a finer solution is given up, s."""

MAX_FACTOR = 8
"""Largest number of cells along a side over that of the judged solution."""

SOUGHT = ("load_per_width", "film_min", "friction_per_width", "side_leakage", "pressure_max", "leakage_per_width")
"""Quantities whose truth is to be sharp; a given load or film is."""

GIVEN = 1e-6
"""Relative uncertainty of a quantity below which its truth is sharp in any case, such as that of a given load."""

TOLERANCE_RATIO = 1e-2
"""Tolerance of the residual of the finer solutions over that of the judged one: the grid alone shall differ."""

LEAST = 3
"""Least number of grids, with the judged one."""

Values = Mapping[str, tuple[float, float]]


Solver = Callable[[Model, int], Result]
"""solve(model, factor): the solution on a grid that is finer by a factor than the judged one; raises what models do."""


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Raise ConvergenceError in the body after so much CPU time; in the main thread only."""

    def stop(*_: object) -> None:
        raise ConvergenceError(f"took more than {seconds:g} s of CPU time")

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def finer_truth(scene: Scene) -> Truth:
    """Return the truth of a scene by models at finer resolutions.

    Raises
    ------
    ConvergenceError
        If no model solves the scene on two grids finer than the judged one.
    """

    def solve(model: Model, factor: int) -> Result:
        resolution = judged_resolution(model, scene) * factor
        if resolution > model.offered(scene).most:
            raise ConvergenceError(f"{model.name}: has no resolution {resolution}")
        tolerance = model.tolerance * (TOLERANCE_RATIO if factor > 1 else 1.0)
        return model.solve(scene, Request(resolution=resolution, tolerance=tolerance))

    return _truth(scene, solve, "grids 2 to 8 times finer, extrapolated")


def on_finer_surface(scene: Scene) -> Truth:
    """Return the truth of a scene by models on its surface at more points; raises what :func:`finer_truth` raises."""
    fine = cache(partial(refined, scene))

    def solve(model: Model, factor: int) -> Result:
        return model.solve(fine(factor))

    return _truth(scene, solve, "the surface at 2 and 4 times as many points a side, extrapolated")


def _truth(scene: Scene, solve: Solver, method: str) -> Truth:
    """Return the extrapolated values of every model that runs in this process, those of the best one as the truth.

    Without a limit of the best one, the truth is empty: expected errors are then not judged.
    """
    applying = [model for model in models(scene.kind) if not model.outside and model.applies(scene).applies]
    solved = {model.name: finer_runs(scene, model, solve) for model in applying}
    own = {name: limits(runs) if len(runs) >= LEAST else {} for name, runs in solved.items()}
    if not any(own.values()):
        raise ConvergenceError("no model solves the scene on finer grids")
    top = own[best_for(scene, applying).name]
    return Truth(
        values={name: value for name, (value, _) in top.items()},
        uncertainty={name: bar for name, (_, bar) in top.items()},
        method=method,
        own=own,
        finer={name: {run.numerics.resolution: _values(run) for run in runs} for name, runs in solved.items() if runs},
    )


def finer_runs(scene: Scene, model: Model, solve: Solver) -> list[Result]:
    """Return the solutions on finer and finer grids, the judged one first; empty if two finer ones take too long.

    The grid is refined until the uncertainty is ``SHARE`` of the one that the judged solution states for the quantities
    in ``SOUGHT``, or until ``MAX_CPU_S`` or ``MAX_FACTOR``.
    """
    base = judged_resolution(model, scene)
    factor, runs = 1, list[Result]()
    if model.cost(scene, base * 2 ** (LEAST - 1)) > MAX_NEEDED_S:
        return runs
    while factor <= MAX_FACTOR:
        if factor > 1 and model.cost(scene, base * factor) > (MAX_CPU_S if len(runs) >= LEAST else MAX_NEEDED_S):
            break
        try:
            with limited(MAX_SOLVE_S) if factor > 1 else nullcontext():  # the first one may compile
                runs.append(solve(model, factor))
        except (ConvergenceError, InputError):
            break
        factor *= 2
        if len(runs) >= LEAST:
            found = limits(runs)
            if all(_sharp(runs[0], name, found[name][1]) for name in SOUGHT if name in found):
                break
    return runs


def _values(run: Result) -> dict[str, float]:
    return {name: one.value for name, one in run.quantities.items()}


def _sharp(judged: Result, name: str, bar: float) -> bool:
    stated = judged.quantities[name].uncertainty
    return stated is None or bar <= max(SHARE * stated, GIVEN * abs(judged.quantities[name].value))


def limits(runs: Sequence[Result]) -> dict[str, tuple[float, float]]:
    """Return the limit of fine grids of each quantity that all runs have, with its uncertainty."""
    found = {}
    for name in runs[0].quantities:
        if not all(name in run.quantities for run in runs):
            continue
        values = [run.quantities[name].value for run in runs]
        limit = converge(
            [run.numerics.resolution for run in runs],
            values,
            formal_order=2,
            noise=runs[-1].numerics.residual * abs(values[-1]),
        )
        found[name] = (limit.value, limit.uncertainty)
    return found
