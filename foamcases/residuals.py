"""The residuals of simpleFoam as its log grows, and what has become of a run that does not converge."""

import math
import re
from pathlib import Path

from contact.errors import Outcome

PATIENCE = 500
"""Iterations without half the residual after which a run is given up.

One that gets from 1 to 1e-7 within 5000 iterations halves it every 215 on average; the longest pause of any that
converged, over Re = 1e-6 to 5000 and d+ = 1e-6 to 5, was 225.
"""

_ITERATION = re.compile(
    rb"Solving for Ux, Initial residual = ([^,\s]+),.*\n"
    rb".*Solving for Uy, Initial residual = ([^,\s]+),.*\n"
    rb".*Solving for p, Initial residual = ([^,\s]+),"
)


class Residuals:
    """The initial residuals of every iteration: ``along`` the film (of its velocity), and ``greatest`` of all.

    ``stagnant`` as soon as the greatest has not halved for ``PATIENCE`` iterations.
    An initial residual is how far the fields that one iteration left are from the equations of the next.
    """

    def __init__(self, log: Path) -> None:
        self.along: list[float] = []
        self.greatest: list[float] = []
        self._log, self._position = log, 0
        self.stagnant = False
        self._mark, self._marked = math.inf, 0

    def read(self) -> None:
        """Take in what was logged since the last call."""
        with self._log.open("rb") as file:
            file.seek(self._position)
            text = file.read()
        end = 0
        for match in _ITERATION.finditer(text):
            values = [float(value) for value in match.groups()]
            self.along.append(values[0])
            self.greatest.append(max(values) if all(map(math.isfinite, values)) else math.nan)
            if self.greatest[-1] <= self._mark / 2:
                self._mark, self._marked = self.greatest[-1], len(self.greatest)
            self.stagnant = self.stagnant or len(self.greatest) - self._marked >= PATIENCE
            end = match.end()
        self._position += end

    def outcome(self, tolerance: float) -> Outcome:
        """What has become of a run that did not converge.

        Bounded fields that go on changing without a trend must swing: the run is unsteady. Where the velocity along the
        film meets the tolerance, only cross flow and pressure do not, mostly because they are round-off: stalled.
        """
        if self.greatest and math.isnan(self.greatest[-1]):
            return Outcome.DIVERGED
        if not self.stagnant:
            return Outcome.UNFINISHED
        return Outcome.STALLED if max(self.along[-PATIENCE // 2 :]) <= tolerance else Outcome.UNSTEADY
