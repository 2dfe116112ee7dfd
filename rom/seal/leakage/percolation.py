"""Load and contact area at which a gap seals, computed by bisection between open and sealed contacts."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.rom.homogenization.paths import sealed, sealed_between_ends
from roughfilm.rom.ladder.model import Progress, silent

LOAD_RATIO = 1.4
"""Ratio of successive loads in the search for a bracket."""

THRESHOLD_PRECISION = 0.01
"""Default relative width of the bracket of a threshold's load."""

MIN_LOAD = 1e-9
"""Ratio of a load to the first load; a gap that is sealed at this ratio counts as sealed under any load."""

Look = Callable[[Array], tuple[bool, ...]]


@dataclass(frozen=True, kw_only=True)
class Side:
    """One end of a bracket: the load of a contact, Pa, and its real area over the nominal one."""

    load: float
    area_fraction: float


@dataclass(frozen=True, kw_only=True)
class Threshold:
    """The bracket of the load at which a gap seals.

    Attributes
    ----------
    open : largest load below the threshold with an open path; None if there is no open path at any load.
    sealed : smallest load without an open path; None if there is an open path up to the largest load.
    """

    open: Side | None
    sealed: Side | None

    @property
    def bracketed(self) -> bool:
        """Whether the bracket has both ends."""
        return self.open is not None and self.sealed is not None

    @property
    def load(self) -> float:
        """The geometric mean of the loads of the bracket, Pa; 0 if sealed at every load, inf if sealed at none."""
        return self._between("load")

    @property
    def area_fraction(self) -> float:
        """The geometric mean of the area fractions of the bracket; 0 if sealed at every load, 1 if sealed at none."""
        return min(self._between("area_fraction"), 1.0)

    def _between(self, name: str) -> float:
        if self.open is None:
            return 0.0
        if self.sealed is None:
            return math.inf
        return math.sqrt(getattr(self.open, name) * getattr(self.sealed, name))


def ends_and_cell(gap: Array) -> tuple[bool, bool, bool, bool]:
    """Whether a gap is sealed between its ends in x and in y (with periodic sides), and as a periodic cell."""
    return sealed_between_ends(gap, joined=True), sealed_between_ends(gap.T, joined=True), *sealed(gap)


def thresholds(
    at: Callable[[float, Contact | None], Contact],
    begin: float,
    most: float,
    *,
    look: Look = ends_and_cell,
    precision: float = THRESHOLD_PRECISION,
    progress: Progress = silent,
) -> tuple[Threshold, ...]:
    """Compute the loads at which a surface seals, by bisection.

    Growing contact may open a path as it redistributes load. Where open and sealed loads alternate, the threshold lies
    between the smallest sealed load and the largest open one below it.

    Parameters
    ----------
    at : at(load, start), the contact at a load from the solution at another, as ``Press.at`` returns it.
    begin : first load, Pa; loads increase from it until the gap is sealed in all cases, and decrease until it is open.
    most : largest load, Pa.
    look : look(gap), whether the gap is sealed in each case, such as a direction of flow; the default is
        `ends_and_cell`.
    precision : relative width of the bracket of the load, between 0 and 1.
    progress : called with the done fraction and a few words.

    Returns
    -------
    tuple of Threshold
        One threshold for each case of ``look``.

    Raises
    ------
    InputError
        If a load is not above 0, or the precision is not between 0 and 1.
    ConvergenceError
        If a contact does not converge.
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
            progress(min(0.95, len(seen) / 25), f"sealing load, {load:.4g} Pa")
            last = at(load, last)
            seen[load] = Side(load=load, area_fraction=last.area_fraction), look(last.gap)
        return seen[load][1]

    load = begin
    while not all(see(load)) and load < most:
        load = min(load * LOAD_RATIO, most)
    load, factor = begin, LOAD_RATIO
    while any(see(load)) and load > MIN_LOAD * begin:
        load, factor = load / factor, min(factor**1.5, 1e3)

    def bracket(which: int) -> Threshold:
        shut = [load for load, (_, answers) in seen.items() if answers[which]]
        high = min(shut, default=math.inf)
        low = max((load for load, (_, answers) in seen.items() if load < high and not answers[which]), default=0.0)
        return Threshold(open=seen[low][0] if low > 0 else None, sealed=seen[high][0] if math.isfinite(high) else None)

    count = len(seen[begin][1])
    for which in range(count):
        while True:
            ends = bracket(which)
            if ends.open is None or ends.sealed is None or ends.sealed.load <= (1 + precision) * ends.open.load:
                break
            see(float(np.sqrt(ends.open.load * ends.sealed.load)))
    progress(1.0, "sealing load")
    return tuple(bracket(which) for which in range(count))
