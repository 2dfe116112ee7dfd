"""The truth of a cell in plan: Navier-Stokes flow by OpenFOAM on three grids, extrapolated.

The models that run in this process are judged by their own equations on finer grids (``finer.py``).
"""

from dataclasses import replace

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.ladder import find, models
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.studies.convergence import converge
from scripts.studies.coverage.finer import finer_truth
from scripts.studies.coverage.truth import Truth

REFERENCE = "navier_stokes"

FINEST = 2
"""Number of the finest grids that are extrapolated at second order where all of them do not converge."""


def truth(scene: Pocket) -> Truth:
    """Return the quantities of a cell by Navier-Stokes flow, and the models' own equations on finer grids.

    Raises
    ------
    ConvergenceError
        If :func:`whole` raises it, or no model solves the scene on two finer grids.
    """
    return replace(whole(scene), own=finer_truth(scene).own)


def whole(scene: Pocket) -> Truth:
    """Return the quantities of a cell by Navier-Stokes flow, by which no model's own equations are judged.

    Raises
    ------
    ConvergenceError
        If OpenFOAM is not on this machine, or the flow does not converge on two grids.
    """
    runs = runs_of(scene)
    found = {name: converged(runs, name) for name in runs[-1].quantities}
    return Truth(
        values={name: value for name, (value, _) in found.items()},
        uncertainty={name: uncertainty for name, (_, uncertainty) in found.items()},
        method=f"{REFERENCE} on {', '.join(str(run.numerics.resolution) for run in runs)} columns, extrapolated",
        own={model.name: {} for model in models(scene.kind)},
        warnings=runs[-1].warnings,
        by=REFERENCE,
        runs={run.numerics.resolution: {name: one.value for name, one in run.quantities.items()} for run in runs},
    )


def runs_of(scene: Pocket) -> list[Result]:
    """Return the results of the reference on the resolutions of its series, from coarse to fine."""
    model, runs = find(scene.kind, REFERENCE), []
    for resolution in model.resolutions_of(scene):
        try:
            runs.append(model.solve(scene, Request(resolution=resolution)))
        except (ConvergenceError, InputError):
            continue
        except UnavailableError as error:
            raise ConvergenceError(str(error)) from error
    if len(runs) < FINEST:
        raise ConvergenceError(f"{REFERENCE} converges on {len(runs)} grids; {FINEST} are needed")
    return runs


def converged(runs: list[Result], name: str) -> tuple[float, float]:
    """Return the extrapolated value of a quantity and its uncertainty, at least that which the finest run states.

    Of all grids at their observed order and of the finest ones at second order, the narrower estimate is taken: the
    coarsest grid often does not resolve narrow walls, and its values do not converge then.
    """
    last = runs[-1]
    limits = [
        converge(
            [run.numerics.resolution for run in used],
            [run.quantities[name].value for run in used],
            formal_order=2,
            noise=last.numerics.residual * abs(last.quantities[name].value),
        )
        for used in (runs, runs[-FINEST:])
    ]
    limit = min(limits, key=lambda one: one.uncertainty)
    return limit.value, max(limit.uncertainty, last.quantities[name].uncertainty or 0.0)
