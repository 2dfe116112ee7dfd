"""The three exceptions that the packages raise deliberately.

Each message is one line that names the place, the value, the allowed range and the remedy.
"""

from enum import StrEnum


class Outcome(StrEnum):
    """The way in which a solver ended."""

    CONVERGED = "converged"
    DIVERGED = "diverged"
    """The residual or the fields grew without bound."""
    UNSTEADY = "unsteady"
    """The solution keeps changing and the residual does not fall."""
    STALLED = "stalled"
    """The solution hardly changes, but the residual stays above the tolerance."""
    UNFINISHED = "unfinished"
    """The residual was falling when the maximum number of iterations was reached."""
    FAILED = "failed"
    """The solver failed for another reason."""


class InputError(ValueError):
    """An input cannot be read or is out of range; the message reads ``place: got value; remedy``.

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
    """A solver stopped above its tolerance, or its fields are invalid.

    Attributes
    ----------
    outcome : how the solver ended.
    iterations : number of iterations done; None if the solver does not count them.

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
    """A program or package that a model needs is not installed; the message says how to install it.

    Examples
    --------
    >>> str(UnavailableError("simpleFoam: not found; install OpenFOAM"))
    'simpleFoam: not found; install OpenFOAM'
    """
