"""The three ways a request can fail; every package raises these and no others on purpose.

They live in the lowest package because every package needs them. Each message is one line that names the
place, the value met there and the remedy.
"""

from enum import StrEnum


class Outcome(StrEnum):
    """What became of a solver."""

    CONVERGED = "converged"
    DIVERGED = "diverged"
    """Its numbers grew beyond all bounds."""
    UNSTEADY = "unsteady"
    """It keeps changing without getting nearer."""
    STALLED = "stalled"
    """It hardly changes any more, but its residual stays above the tolerance."""
    UNFINISHED = "unfinished"
    """It was getting nearer when its iterations were used up."""
    FAILED = "failed"
    """Anything else."""


class InputError(ValueError):
    """The error for input that is not understood or out of range: ``place: got value; remedy``, in one line.

    Examples
    --------
    >>> import roughfilm as rf
    >>> try:
    ...     rf.read_scene({"name": "wavy", "kind": "pocketful"})
    ... except rf.InputError as error:
    ...     print(str(error)[:38])
    scene.kind: got 'pocketful'; it must b
    """


class ConvergenceError(RuntimeError):
    """The error for a solver that stopped above its tolerance, or with fields that cannot be trusted.

    ``outcome`` says how, and ``iterations`` after how many of them, where the solver knows.

    Examples
    --------
    >>> error = ConvergenceError("film: stopped at 1e-3", outcome=Outcome.STALLED, iterations=40)
    >>> str(error), str(error.outcome), error.iterations
    ('film: stopped at 1e-3', 'stalled', 40)
    """

    def __init__(self, message: str, *, outcome: Outcome = Outcome.FAILED, iterations: int | None = None) -> None:
        super().__init__(message)
        self.outcome = outcome
        self.iterations = iterations


class UnavailableError(ImportError):
    """The error for a program or library that is not on this machine: which one, and how to get it.

    Examples
    --------
    >>> str(UnavailableError("simpleFoam: not found; install OpenFOAM"))
    'simpleFoam: not found; install OpenFOAM'
    """
