"""Read the residuals of simpleFoam from its growing log, and classify a run that does not converge."""

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import Outcome
from roughfilm.contact.foundation.reading.regular import opened

MAX_ASPECT = 1000.0
"""Length of a cell over its thickness above which the velocity across the film is not judged.

Pressure over a cell's length is then so much larger than over its thickness that its round-off moves this velocity. On
cells 4000 long the residual of that velocity ends at 2e-7, and grows with the square of their length.
"""

ROUND_OFF = 1e-15
"""Round-off of the residual of the pressure on cells as long as thick."""

PATIENCE = 500
"""Number of iterations in which the residual must halve at least once; otherwise the run is stopped.

A residual that falls from 1 to 1e-7 within 5000 iterations halves every 215 on average. Among the runs that converged
at Re = 1e-6 to 5000 and d+ = 1e-6 to 5, the residual never took more than 225 iterations to halve.
"""

FIELDS = ("Ux", "Uy", "Uz", "p")
"""Names of the fields that simpleFoam solves for."""

PLANE = ("Ux", "Uy", "p")
"""Those of a plane flow."""


@dataclass(frozen=True, kw_only=True)
class Judged:
    """The criteria of a converged flow.

    Attributes
    ----------
    main : the velocity along the flow, one of ``FIELDS``.
    fields : the entries of ``FIELDS`` that are not constant; the normalized residuals of the others are round-off.
    slack : allowed residual over the tolerance where another criterion shows that the flow has settled.
    """

    main: str = "Ux"
    fields: tuple[str, ...] = FIELDS
    slack: float = 1.0


_SOLVED = re.compile(rb"Solving for (Ux|Uy|Uz|p), Initial residual = ([^,\s]+),")


def judged_fields(fields: tuple[str, ...], along: Array, across: Array) -> tuple[str, ...]:
    """The fields whose residuals are judged in a film: all but the velocity across it if cells are flat.

    Parameters
    ----------
    fields : the fields that are not constant, of which the pressure is the last and the velocity across the one before.
    along, across : lengths of cells along the film and across it, in one unit.
    """
    return (*fields[:-2], fields[-1]) if along.max() > MAX_ASPECT * across.min() else fields


def flat_slack(along: Array, across: Array, tolerance: float) -> float:
    """The residual over the tolerance at which a flow of flat cells ends whose mean velocity has settled.

    The pressure, whose mean is a small difference of its peaks, settles after the velocity: it is a tenth where the
    round-off of its residual, about ``ROUND_OFF`` times the square of a cell's length over its thickness, is smaller.
    """
    return float(np.clip(ROUND_OFF * (along.max() / across.min()) ** 2 / tolerance, 0.1, 1.0))


class Residuals:
    """The initial residuals of every iteration, read from a log that grows.

    An initial residual is the normalized error of the fields of one iteration in the equations of the next.

    Attributes
    ----------
    main : initial residual of the main velocity in each iteration.
    greatest : greatest initial residual of the judged fields in each iteration; NaN where one is not finite.
    stagnant : whether the greatest residual has not halved for ``PATIENCE`` iterations, now or at an earlier time.
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
        """Read the part of the log that was written since the last call."""
        with opened(self._log, "run the case again") as file:
            file.seek(self._position)
            text = file.read()
        end = 0
        for match in _SOLVED.finditer(text):
            end = match.end()
            name = match[1].decode()
            self._found[name] = _number(match[2])
            if name == "p" and self._judged.main in self._found:  # else it is the pressure of a second corrector
                self._finish(self._found)
                self._found = {}
        self._position += end

    def _finish(self, residuals: dict[str, float]) -> None:
        """Append the residuals of a complete iteration."""
        values = [value for name, value in residuals.items() if name in self._judged.fields]
        self.main.append(residuals[self._judged.main])
        self.greatest.append(max(values) if all(map(math.isfinite, residuals.values())) else math.nan)
        if self.greatest[-1] <= self._mark / 2:
            self._mark, self._marked = self.greatest[-1], len(self.greatest)
        self.stagnant = self.stagnant or len(self.greatest) - self._marked >= PATIENCE

    def outcome(self, tolerance: float) -> Outcome:
        """The outcome of a run that did not converge.

        A residual that is not finite means DIVERGED, and one that still falls means UNFINISHED. A stagnant run is
        STALLED if the main velocity meets the tolerance: only cross flow and pressure do not, mostly because they are
        round-off. Otherwise the fields are bounded and keep changing without a trend: the run is UNSTEADY.
        """
        if self.greatest and math.isnan(self.greatest[-1]):
            return Outcome.DIVERGED
        if not self.stagnant:
            return Outcome.UNFINISHED
        return Outcome.STALLED if max(self.main[-PATIENCE // 2 :]) <= tolerance else Outcome.UNSTEADY


def _number(word: bytes) -> float:
    """The number of a word of a log; NaN for a word that is none."""
    try:
        return float(word)
    except ValueError:
        return math.nan
