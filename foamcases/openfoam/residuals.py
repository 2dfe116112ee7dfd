"""The residuals of simpleFoam as its log grows, and what has become of a run that does not converge."""

import math
import re
from dataclasses import dataclass
from pathlib import Path

from roughfilm.contact.foundation.errors import Outcome

PATIENCE = 500
"""Number of iterations without half the residual after which a run is stopped.

One that gets from 1 to 1e-7 within 5000 iterations halves it every 215 on average; the longest pause of any that
converged, over Re = 1e-6 to 5000 and d+ = 1e-6 to 5, was 225.
"""

FIELDS = ("Ux", "Uy", "Uz", "p")


@dataclass(frozen=True, kw_only=True)
class Judged:
    """The criteria of a converged flow.

    Attributes
    ----------
    main : the velocity along the flow, one of ``FIELDS``.
    fields : of ``FIELDS`` those in which there is anything; the others are round-off, in units of itself.
    slack : allowed residuals over the tolerance where another criterion shows that the flow has settled.
    """

    main: str = "Ux"
    fields: tuple[str, ...] = FIELDS
    slack: float = 1.0


_SOLVED = re.compile(rb"Solving for (Ux|Uy|Uz|p), Initial residual = ([^,\s]+),")


class Residuals:
    """The initial residuals of every iteration: ``main`` of the main velocity, and ``greatest`` of all that are judged.

    ``stagnant`` as soon as the greatest has not halved for ``PATIENCE`` iterations.
    An initial residual is how far the fields that one iteration left are from the equations of the next.
    """

    def __init__(self, log: Path, judged: Judged) -> None:
        self.main: list[float] = []
        self.greatest: list[float] = []
        self._log, self._position = log, 0
        self._judged = judged
        self._found: dict[str, float] = {}
        self.stagnant = False
        self._mark, self._marked = math.inf, 0

    def read(self) -> None:
        """Take in what was logged since the last call."""
        with self._log.open("rb") as file:
            file.seek(self._position)
            text = file.read()
        end = 0
        for match in _SOLVED.finditer(text):
            end = match.end()
            name, value = match[1].decode(), float(match[2])
            self._found[name] = value
            if name == "p" and self._judged.main in self._found:  # and not a second corrector's
                self._finish(self._found)
                self._found = {}
        self._position += end

    def _finish(self, residuals: dict[str, float]) -> None:
        """Take in a whole iteration."""
        values = [value for name, value in residuals.items() if name in self._judged.fields]
        self.main.append(residuals[self._judged.main])
        self.greatest.append(max(values) if all(map(math.isfinite, residuals.values())) else math.nan)
        if self.greatest[-1] <= self._mark / 2:
            self._mark, self._marked = self.greatest[-1], len(self.greatest)
        self.stagnant = self.stagnant or len(self.greatest) - self._marked >= PATIENCE

    def outcome(self, tolerance: float) -> Outcome:
        """The outcome of a run that did not converge.

        Bounded fields that go on changing without a trend must swing: the run is unsteady. Where the velocity along the
        film meets the tolerance, only cross flow and pressure do not, mostly because they are round-off: stalled.
        """
        if self.greatest and math.isnan(self.greatest[-1]):
            return Outcome.DIVERGED
        if not self.stagnant:
            return Outcome.UNFINISHED
        return Outcome.STALLED if max(self.main[-PATIENCE // 2 :]) <= tolerance else Outcome.UNSTEADY
