"""The iterations of simpleFoam: a first try, and a second one with stronger settings if the first does not converge."""

import math
import shutil
import signal
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

from roughfilm.contact.foundation.errors import Outcome
from roughfilm.foamcases.openfoam.dictionaries import START_SCHEME, START_TOLERANCE, change_scheme, strengthen
from roughfilm.foamcases.openfoam.program import SEE_LOG, Ended, execute, failure, succeed
from roughfilm.foamcases.openfoam.residuals import Judged, Residuals
from roughfilm.rom.ladder.model import Progress

CONVERGED = "SIMPLE solution converged in"
"""Words of a log of simpleFoam whose residuals met the tolerance."""

RECIPE = (
    f"started by {START_SCHEME} up to a residual of {START_TOLERANCE:g}, then with one corrector for skewed cells and "
    "velocity solved to round-off"
)
"""Description of the second try. The relaxation stays the same, because the result depends on it slightly.

In ten runs the first try did not converge although the flow was not round-off (Re = 160 to 5000, d+ = 1e-6 to 5, 30 to
240 columns). The second try converged in eight of them; each of its changes alone converged in three at most, and a
lower relaxation factor (0.5 to 0.9) in one.
"""

RETRIED = {Outcome.DIVERGED, Outcome.UNSTEADY, Outcome.STALLED}
"""Outcomes of a first try after which there is a second one."""

FLOATING_POINT = {-signal.SIGFPE, 128 + signal.SIGFPE}
"""Exit codes of a program, and of mpirun, after a floating-point exception."""


STOP = "STOP"
"""Name of a file that makes a running case write its fields and end, if its settings look for it."""

Settled = Callable[[Residuals], bool]
"""Function settled(residuals): whether a run may end before simpleFoam's residual control ends it."""


class Asked(Protocol):
    """The settings of a run: the residual at which it ends, a key of ``ADVECTION``, and the number of processes."""

    @property
    def tolerance(self) -> float: ...  # noqa: D102
    @property
    def scheme(self) -> str: ...  # noqa: D102
    @property
    def processes(self) -> int: ...  # noqa: D102


@dataclass(frozen=True, kw_only=True)
class Try:
    """A try to converge a flow.

    Attributes
    ----------
    recipe : changes of the settings in words; "" for the usual settings.
    outcome : how the try ended.
    iterations : number of iterations.
    residual : greatest initial residual of the last iteration; NaN if there was none.
    cpu_s : CPU time, s.
    log : the log of simpleFoam.
    """

    recipe: str
    outcome: Outcome
    iterations: int
    residual: float
    cpu_s: float
    log: str

    def __str__(self) -> str:
        recipe = f"second try ({self.recipe}): " if self.recipe else ""
        return f"{recipe}{self.outcome} after {self.iterations} iterations, residual {self.residual:.0e}"


def iterate(
    directory: Path, asked: Asked, judged: Judged, progress: Progress, settled: Settled | None = None
) -> tuple[Try, ...]:
    """Run simpleFoam on a new case, and a second time by ``RECIPE`` if the first try has an outcome in ``RETRIED``.

    A try ends when all residuals meet the tolerance, or earlier when the flow is ``settled``.

    Parameters
    ----------
    directory : the directory of the case.
    asked : tolerance, advection scheme and number of processes.
    judged : the criteria of a converged flow.
    progress : called with the done fraction and a few words.
    settled : a further test that ends a run; None for none.

    Returns
    -------
    tuple[Try, ...]
        The one or two tries; the fields on disk are those of the last.

    Raises
    ------
    ConvergenceError
        If a program stops in error.
    """
    first = _simple_foam(directory, asked, judged, "log.simpleFoam", progress, settled)
    if first.outcome not in RETRIED:
        return (first,)
    for path in directory.iterdir():
        made = path.name.startswith("processor") or path.name == "postProcessing"
        if made or (path.name.isdigit() and path.name != "0"):
            shutil.rmtree(path)
    strengthen(directory)
    change_scheme(directory, scheme=START_SCHEME, tolerance=START_TOLERANCE)
    start, rest = _simple_foam(directory, asked, judged, "log.start", progress), None
    if start.outcome is Outcome.CONVERGED:
        change_scheme(directory, scheme=asked.scheme, tolerance=asked.tolerance)
        rest = _simple_foam(directory, asked, judged, "log.retry", progress, settled, decomposed=True)
    return (first, second(start, rest))


def _simple_foam(
    directory: Path,
    asked: Asked,
    judged: Judged,
    log_name: str,
    progress: Progress,
    settled: Settled | None = None,
    *,
    decomposed: bool = False,
) -> Try:
    """Run simpleFoam from the latest fields until it converges or is stopped because its residuals stagnate."""
    cpu, command = 0.0, ["simpleFoam"]
    if asked.processes > 1:
        command = ["mpirun", "-np", str(asked.processes), "simpleFoam", "-parallel"]
        if not decomposed:
            cpu = succeed(directory, ["decomposePar"], "log.decomposePar").cpu_s
    (directory / STOP).unlink(missing_ok=True)
    residuals = Residuals(directory / log_name, judged)

    seen, stopping = 0, False

    def given_up() -> bool:
        nonlocal seen, stopping
        residuals.read()
        if settled is not None and not stopping and len(residuals.greatest) > seen and settled(residuals):
            (directory / STOP).touch()
            stopping = True
        seen = len(residuals.greatest)
        if residuals.greatest and residuals.greatest[-1] > 0:
            done = math.log(residuals.greatest[-1]) / math.log(asked.tolerance)
            progress(min(max(done, 0.0), 1.0), f"simpleFoam, residual {residuals.greatest[-1]:.0e}")
        return residuals.stagnant

    ended = execute(directory, command, log_name, given_up)
    residuals.read()
    return replace(tried(ended, residuals, asked.tolerance, settled=stopping), cpu_s=cpu + ended.cpu_s)


def tried(ended: Ended, residuals: Residuals, tolerance: float, *, settled: bool) -> Try:
    """The try that a run of simpleFoam was.

    Parameters
    ----------
    ended : the end of simpleFoam.
    residuals : the residuals of its log.
    tolerance : the residual at which it was to end.
    settled : whether it was ended because the flow had settled.

    Raises
    ------
    ConvergenceError
        If simpleFoam stopped in error.
    """
    if (settled and ended.code == 0) or CONVERGED in ended.log:
        outcome = Outcome.CONVERGED
    elif ended.code in FLOATING_POINT:
        outcome = Outcome.DIVERGED
    elif ended.code == 0 or residuals.stagnant:
        outcome = residuals.outcome(tolerance)
    else:
        raise failure(f"simpleFoam stopped with code {ended.code}; {SEE_LOG}", ended.log)
    return Try(
        recipe="",
        outcome=outcome,
        iterations=len(residuals.greatest),
        residual=residuals.greatest[-1] if residuals.greatest else math.nan,
        cpu_s=ended.cpu_s,
        log=ended.log,
    )


def second(start: Try, rest: Try | None) -> Try:
    """The second try of a flow, which ``RECIPE`` describes, from its start and, if that converged, its rest."""
    if rest is None:
        return replace(start, recipe=RECIPE)
    return replace(rest, iterations=start.iterations + rest.iterations, cpu_s=start.cpu_s + rest.cpu_s, recipe=RECIPE)
