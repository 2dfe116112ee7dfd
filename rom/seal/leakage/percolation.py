"""At which load and contact area a gap stops leaking: bisection between an open and a sealed contact."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.rom.homogenization.paths import sealed, sealed_between_ends
from roughfilm.rom.ladder.model import Progress, silent

STEP = 1.4
"""From load to load while a bracket is sought."""

PRECISION = 0.01
"""Of a threshold's load: the two ends of its bracket are that close."""

LIGHTEST = 1e-9
"""Of the first load: a gap that is sealed there still is sealed at every load."""

Look = Callable[[Array], tuple[bool, ...]]


@dataclass(frozen=True, kw_only=True)
class Side:
    """One end of a bracket: a contact, at a load, Pa, with its real area over the nominal one."""

    load: float
    area_fraction: float


@dataclass(frozen=True, kw_only=True)
class Threshold:
    """Where a direction seals.

    Attributes
    ----------
    open : the greatest load, below the threshold, at which a path was seen; None if there is none at any load.
    sealed : the least at which none was; None if there always is one, up to the largest load that was tried.
    """

    open: Side | None
    sealed: Side | None

    @property
    def found(self) -> bool:
        """Whether it has two sides."""
        return self.open is not None and self.sealed is not None

    @property
    def load(self) -> float:
        """In the middle of the bracket, Pa; 0 if sealed at any load, inf if at none."""
        return self._between("load")

    @property
    def area_fraction(self) -> float:
        """In the middle of the bracket; 0 if sealed at any load, and 1, that of full contact, if at none tried."""
        return min(self._between("area_fraction"), 1.0)

    def _between(self, name: str) -> float:
        if self.open is None:
            return 0.0
        if self.sealed is None:
            return math.inf
        return math.sqrt(getattr(self.open, name) * getattr(self.sealed, name))


def ends_and_cell(gap: Array) -> tuple[bool, bool, bool, bool]:
    """Whether a gap is sealed between ends in x, in y (sides joined), and on and on, as its cell is, in x, in y."""
    return sealed_between_ends(gap, joined=True), sealed_between_ends(gap.T, joined=True), *sealed(gap)


def thresholds(
    at: Callable[[float, Contact | None], Contact],
    begin: float,
    most: float,
    *,
    look: Look = ends_and_cell,
    precision: float = PRECISION,
    progress: Progress = silent,
) -> tuple[Threshold, ...]:
    """The loads at which a surface seals, by bisection, each contact begun from the one nearest in load.

    Parameters
    ----------
    at : the contact at a load, from another if that helps, as ``Press.at`` gives it.
    begin : the first load, Pa; loads are sought upward from it until all that is looked for is sealed, and downward
        until all is open.
    most : the largest load that is tried, Pa: the hardness, or what the solid is expected to bear.
    look : what is sealed in a gap: a threshold is found for each of its answers.
    precision : of the load, as a part of it.

    Raises
    ------
    InputError
        For loads that are not above 0, or a precision outside 0 to 1.
    ConvergenceError
        If a contact does not converge.

    Contact that grows may open a path here and there as it shifts load: where open and sealed loads alternate, the
    threshold is the least sealed load and the greatest open one below it.
    """
    if not (0 < begin < math.inf and begin <= most):
        raise InputError(f"percolation: got loads from {begin:g} to {most:g} Pa; give 0 < first <= largest")
    if not 0 < precision < 1:
        raise InputError(f"percolation: got a precision of {precision:g}; it must be above 0 and below 1")
    seen: dict[float, tuple[Side, tuple[bool, ...]]] = {}
    last: Contact | None = None

    def see(load: float) -> tuple[bool, ...]:
        nonlocal last
        if load not in seen:
            progress(min(0.95, len(seen) / 25), f"{load:.4g} Pa, where it seals")
            last = at(load, last)
            seen[load] = Side(load=load, area_fraction=last.area_fraction), look(last.gap)
        return seen[load][1]

    load = begin
    while not all(see(load)) and load < most:
        load = min(load * STEP, most)
    load, factor = begin, STEP
    while any(see(load)) and load > LIGHTEST * begin:
        load, factor = load / factor, min(factor**1.5, 1e3)

    def bracket(which: int) -> Threshold:
        shut = [load for load, (_, answers) in seen.items() if answers[which]]
        high = min(shut, default=math.inf)
        low = max((load for load, (_, answers) in seen.items() if load < high and not answers[which]), default=0.0)
        return Threshold(open=seen[low][0] if low > 0 else None, sealed=seen[high][0] if math.isfinite(high) else None)

    count = len(seen[begin][1])
    for which in range(count):
        while True:
            found = bracket(which)
            if found.open is None or found.sealed is None or found.sealed.load <= (1 + precision) * found.open.load:
                break
            see(float(np.sqrt(found.open.load * found.sealed.load)))
    progress(1.0, "where it seals")
    return tuple(bracket(which) for which in range(count))
