"""An allowance of work for films that only show what another one may be.

Work is steps of Newton's method times nodes rather than seconds, so that no answer depends on the machine.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from roughfilm.contact.foundation.errors import ConvergenceError, Outcome


@dataclass
class Allowance:
    """The work that is left, in steps times nodes; below 0 it is spent."""

    left: float

    @property
    def spent(self) -> bool:
        """Whether more work was asked for than was allowed."""
        return self.left < 0


_allowance: ContextVar[Allowance | None] = ContextVar("_allowance", default=None)


@contextmanager
def allowance(work: float) -> Iterator[Allowance]:
    """Let the films in the block do so much work; each one beyond it ends with a ConvergenceError at its next step."""
    given = Allowance(work)
    before = _allowance.set(given)
    try:
        yield given
    finally:
        _allowance.reset(before)


def spend(nodes: int) -> None:
    """Count a step of Newton's method on so many nodes.

    Raises
    ------
    ConvergenceError
        If the allowance of a block around is spent.
    """
    given = _allowance.get()
    if given is None:
        return
    given.left -= nodes
    if given.spent:
        raise ConvergenceError("film: the work that is allowed is spent", outcome=Outcome.UNFINISHED)
