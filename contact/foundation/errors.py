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
    """What was asked cannot be understood or is out of range: ``place: got value; remedy``."""


class ConvergenceError(RuntimeError):
    """A solver stopped before it met its tolerance, or with fields that cannot be trusted.

    ``outcome`` says how, and ``iterations`` after how many of them, where the solver knows.
    """

    def __init__(self, message: str, *, outcome: Outcome = Outcome.FAILED, iterations: int | None = None) -> None:
        super().__init__(message)
        self.outcome = outcome
        self.iterations = iterations


class UnavailableError(ImportError):
    """Something this model needs is not on this machine: what, and how to get it."""
