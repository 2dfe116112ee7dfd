"""The card of a pocket's case: the options with which it was written, which are needed to run it and read it back."""

import math
from dataclasses import dataclass, field
from pathlib import Path

from roughfilm.foamcases.openfoam.iterate import Settled
from roughfilm.foamcases.openfoam.relaxation import velocity_relaxation
from roughfilm.foamcases.openfoam.residuals import FIELDS, PLANE, Judged
from roughfilm.foamcases.openfoam.settling import settled_within

LAYERS_PER_COLUMN = 1 / 5
"""Number of cells across the film over the number along it."""

MIN_LAYERS = 4

PLAN_RELAXATION = (2.0, 5.0)
"""Numbers a and b of the relaxation 1 - a/sqrt(N² + b/lx² + b/ly²) in plan, with which runs need nearly the fewest
iterations on 24 and 48 columns of 0.2 to 1.4 film thicknesses and 96 of 0.35."""

MIN_PLAN_RELAXATION = 0.7
"""Least relaxation of velocity in a cell in plan."""


def layers_of(resolution: int) -> int:
    """The number of layers of a mesh with so many columns along the film."""
    return max(MIN_LAYERS, round(resolution * LAYERS_PER_COLUMN))


@dataclass(frozen=True, kw_only=True)
class Card:
    """The options with which a case was written.

    Attributes
    ----------
    columns, layers : numbers of cells along and across the film.
    rows : number of rows of cells across a cell in plan, those left out by symmetry among them; 0 for grooves.
    steps : mean lengths lx and ly of the columns of a cell in plan, in film thicknesses.
    mirrored : whether only the half y > 0 of a cell in plan is solved.
    judged : the entries of ``FIELDS`` that are neither constant nor round-off.
    slack : residual over the tolerance at which a run may end whose mean velocity has settled.
    """

    columns: int
    layers: int
    reynolds_number: float
    resolution: int
    tolerance: float
    scheme: str
    processes: int
    dialect: str
    rows: int = field(default=0, metadata={"may_be_zero": True})
    steps: tuple[float, float] = (1.0, 1.0)
    mirrored: bool = field(default=False, metadata={"may_be_zero": True})
    judged: tuple[str, ...] = FIELDS
    slack: float = 1.0

    @property
    def relaxation(self) -> float:
        """The relaxation of velocity in SIMPLEC, which is nearer to 1 for smaller cells."""
        if self.rows:
            a, b = PLAN_RELAXATION
            size = math.sqrt(self.layers**2 + sum(b / step**2 for step in self.steps))
            return max(MIN_PLAN_RELAXATION, 1 - a / size)
        return velocity_relaxation(self.columns)

    @property
    def criteria(self) -> Judged:
        """The criteria of convergence."""
        return Judged(fields=self.judged, slack=self.slack)

    @property
    def settles(self) -> bool:
        """Whether the run ends by its mean velocity, since residuals of some fields are round-off.

        Cards of grooves may name a velocity across the plane of the flow too, which is not solved for.
        """
        return not set(self.judged) >= set(FIELDS if self.rows else PLANE)

    def settled(self, directory: Path) -> Settled | None:
        """The test that ends the run of the case in a directory; None if residuals end it."""
        return settled_within(self.tolerance, directory, self.criteria) if self.settles else None
