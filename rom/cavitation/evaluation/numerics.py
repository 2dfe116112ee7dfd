"""The numerics of the result of a film that was solved on successively finer grids."""

from collections.abc import Mapping, Sequence

from roughfilm.rom.cavitation.solve import Level, Solution
from roughfilm.rom.ladder.request import CheckedRequest
from roughfilm.rom.ladder.result import Numerics, SolverRun


def numerics_of(
    solution: Solution,
    solved: Sequence[Level],
    request: CheckedRequest,
    *,
    cpu_s: float,
    wall_s: float,
    details: Mapping[str, float] | None = None,
) -> Numerics:
    """The numerics of a result.

    Parameters
    ----------
    solution : the film on the finest grid.
    solved : cells and iterations of all solves.
    request : the numerical options.
    cpu_s, wall_s : times of all solves, s.
    details : further numbers of the model.
    """
    return Numerics(
        residual=solution.residual,
        iterations=sum(level.iterations for level in solved),
        cpu_s=cpu_s,
        wall_s=wall_s,
        degrees_of_freedom=solution.state.pressure.size,
        resolution=request.resolution,
        tolerance=request.tolerance,
        scheme=request.scheme,
        runs=tuple(SolverRun(name=" x ".join(map(str, level.shape)), iterations=level.iterations) for level in solved),
        details=dict(details or {}),
    )
