"""The three exceptions that the packages raise deliberately.

Each message is one line that names the place, the value, the allowed range and the remedy.
"""

import errno
import re
from collections.abc import Iterator
from contextlib import contextmanager
from enum import StrEnum
from pathlib import Path

from roughfilm.contact.foundation.brief import short_message


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

    def __init__(self, message: str) -> None:
        super().__init__(short_message(message))


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
        super().__init__(short_message(message))
        self.outcome = outcome
        self.iterations = iterations


class UnavailableError(ImportError):
    """A program or package that a model needs is not installed; the message says how to install it.

    Examples
    --------
    >>> str(UnavailableError("simpleFoam: not found; install OpenFOAM"))
    'simpleFoam: not found; install OpenFOAM'
    """

    def __init__(self, message: str) -> None:
        super().__init__(short_message(message))


BESIDE = re.compile(r"(?<=/)\.roughfilm-[0-9a-f]{8}-[0-9a-f]{8}/")
"""The hidden scratch directory in the path of a file that is not at its final place yet."""

REMEDIES = {
    errno.ENOSPC: "free some space there or ",
    errno.EDQUOT: "free some of your quota there or ",
    errno.EFBIG: "raise the limit of the size of a file (ulimit -f) or ",
}
"""Beginnings of remedies by the number of an error of the system."""


def unwritable(
    place: Path | str, error: OSError, *, done: str = "written", remedy: str = "choose another place"
) -> InputError:
    """The error for a place that the system refused to write, or what ``done`` says, with the reason and the remedy.

    >>> str(unwritable("r.h5", OSError(errno.ENOSPC, "No space left on device")))
    'r.h5: cannot be written (No space left on device); free some space there or choose another place'
    """
    first = REMEDIES.get(error.errno or 0, "")
    final = BESIDE.sub("", str(place))
    return InputError(f"{final}: cannot be {done} ({error.strerror or error}); {first}{remedy}")


@contextmanager
def writing(place: Path | str, *, remedy: str = "choose another place") -> Iterator[None]:
    """Turn each error of the system in the block into the one of ``unwritable`` for a place."""
    try:
        yield
    except OSError as error:
        raise unwritable(place, error, remedy=remedy) from error
