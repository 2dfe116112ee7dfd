"""The criterion by which a flow has settled, from its mean velocity and its residuals in each iteration."""

from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.foundation.reading.regular import read_text
from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.iterate import STOP, Settled
from roughfilm.foamcases.openfoam.residuals import Judged, Residuals

MEAN_VELOCITY = "flow"
"""Name of the OpenFOAM function that logs the mean velocity of all cells in each iteration."""

MAIN = {"Ux": 0, "Uy": 1}
"""Component of the mean velocity that belongs to each main velocity."""

MAX_RECORD_BYTES = 100_000_000
"""Largest size of a record of the mean velocity that is read, bytes."""

REMEDY = "run the case again"

WINDOW = 10
"""Number of iterations over which the change of the flow is measured."""

MIN_VELOCITY = 1e-6
"""Least mean velocity, over that of a smooth gap, to which the change of a flow is compared."""

MAX_STEP_RATIO = 0.98
"""Largest ratio of successive steps in the extrapolation, which stays finite where steps of round-off do not shrink."""


ALL_CELLS = {"select": "all", "cellZone": "all"}
"""The two names, by release, of the entry that selects all cells; ``select`` is openfoam.org's from 11 on,
``cellZone`` from 13 on."""


def functions(dialect: Dialect) -> dict[str, dict[str, Any]]:
    """The functions of ``system/controlDict`` that log the mean velocity, and end a run when the file ``STOP`` appears.

    A function that ends a run looks for a file of its own name in the directory of the case.
    """
    return {
        MEAN_VELOCITY: {
            "type": "volFieldValue",
            "libs": ['"libfieldFunctionObjects.so"'],
            "fields": ["U"],
            "operation": "volAverage",
            "regionType": "all",
            **ALL_CELLS,
            "writeFields": False,
            "writePrecision": 12,
            "log": False,
        },
        STOP: {
            "type": dialect.stop,
            "libs": ['"libutilityFunctionObjects.so"'],
            "action": "writeNow",
        },
    }


def settled_within(tolerance: float, case: Path, judged: Judged) -> Settled:
    """A function that tests whether a running case has settled.

    A case has settled if it has done at least 2 ``WINDOW`` iterations, its greatest residual is ``judged.slack`` times
    the tolerance or less, and the remaining relative change of the mean velocity is at most the tolerance.
    """

    def settled(residuals: Residuals) -> bool:
        if len(residuals.greatest) < 2 * WINDOW or not residuals.greatest[-1] <= judged.slack * tolerance:
            return False
        return unsettled(mean_velocity(case)[:, MAIN[judged.main]]) <= tolerance

    return settled


def mean_velocity(case: Path) -> Array:
    """The mean velocity of all cells in each logged iteration of a case, in V, shape (iterations, 3).

    After a complete run, the last iteration is the one that verified the fields.

    Raises
    ------
    ConvergenceError
        If the record of the case is missing or damaged.
    """
    try:
        folders = sorted((case / "postProcessing" / MEAN_VELOCITY).iterdir(), key=lambda folder: float(folder.name))
        lines = [
            line
            for folder in folders
            for line in read_text(folder / "volFieldValue.dat", MAX_RECORD_BYTES, REMEDY).splitlines(keepends=True)
            if not line.startswith("#") and line.endswith("\n")
        ]
        rows = np.array([[float(word.strip("()")) for word in line.split()[1:]] for line in lines]).reshape(-1, 3)
        if len(rows) != len(lines):
            raise ValueError("a line has no three numbers")
    except (OSError, ValueError) as error:
        raise ConvergenceError(f"{case}: has no whole record of the mean velocity; {REMEDY}") from error
    return rows


def unsettled(values: Array) -> float:
    """The remaining change of a series over its last value, if its steps keep shrinking at their present rate.

    The remaining change is d r/(1 - r), where d is the largest of the last ``WINDOW`` steps, d' the largest of as many
    steps before, and r = (d/d')^(1/``WINDOW``), at most ``MAX_STEP_RATIO``. The steps of a shorter series are split in
    half. The last value counts as at least ``MIN_VELOCITY``.
    """
    steps = np.abs(np.diff(values))
    window = min(WINDOW, steps.size // 2)
    if not window:
        return 0.0
    last, before = steps[-window:].max(), steps[-2 * window : -window].max()
    rate = min((last / before) ** (1 / window) if before > 0 else 1.0, MAX_STEP_RATIO)
    return float(last * rate / (1 - rate) / max(abs(values[-1]), MIN_VELOCITY)) if last > 0 else 0.0
