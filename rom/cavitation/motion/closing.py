"""Cavities that close in a time step: what they lack is taken up in it, and the film is a full one from then on."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_propagation

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.motion.coupled import Drive, Instant
from roughfilm.rom.cavitation.motion.film import MovingFilm
from roughfilm.rom.cavitation.motion.past import Known, weights

FULL = 1e-9
"""Part of its volume up to which a node that lacks it counts as full."""

LEAST_INFLOW = 0.02
"""Flow into a cavity over that through the film up to which its closing is not sought within a step."""


def closed_cavities(film: MovingFilm, past: tuple[Known, ...], instant: Instant) -> NDArray[np.bool_]:
    """The nodes of cavities at the two times before a step of which nothing is left at its end, shape (nx, ny)."""
    now = instant.kind == CAVITY
    were = now | np.any([_lacking(film, known) > 0 for known in past[:2]], axis=0)
    if (were == now).all():
        return np.zeros_like(now)
    copies = 2 if film.problem.shape.joined[0] else 1  # the second one joins the two ends of a ring
    left = binary_propagation(np.tile(now, (copies, 1)), mask=np.tile(were, (copies, 1)))
    return np.asarray(were & ~left.reshape(copies, *now.shape).any(axis=0))


def refilling(film: MovingFilm, past: tuple[Known, ...], size: float, drive: Drive, closed: NDArray[np.bool_]) -> Drive:
    """What acts on a film in a two-step formula's step in which cavities close, with their filling by backward Euler.

    The rate of θh jumps where a cavity is full: before, it takes up what flows into it. The two-step formula
    extrapolates that rate, and would press up to half of what the cavity took up in a step out of the full film, in
    this step and the next. With h by the two-step formula, a h₊ - s, and (θ - 1) h by backward Euler,

        ∂(θh)/∂t ≈ a h₊ - s + ((θ - 1)₊ h₊ - (θ - 1) h)/Δt,

    a cavity takes up what it lacks at the beginning of the step, and nothing later.

    Parameters
    ----------
    past : what is known at the times before the step.
    size : length of the step, s.
    drive : what acts on the film if no cavity closes.
    closed : the nodes of the cavities that close, or closed in the step before.
    """
    rate, near, far = weights(past, size, 2)
    gap, before = (film.gap_at(known.place) for known in past[:2])
    refilled = near * gap - far * before + (past[0].held - gap) / size
    return replace(
        drive,
        storage=(np.where(closed, 1 / size, rate), np.where(closed, refilled, drive.storage[1])),
        of_gap=np.where(closed, rate - 1 / size, 0.0),
    )


def closes_after(film: MovingFilm, past: tuple[Known, ...], instant: Instant, closed: NDArray[np.bool_]) -> float:
    """The time from the beginning of a step to the closing of cavities in it, s, if they fill as in the step before.

    It is infinite for cavities into which hardly anything flows, whose closing changes no pressure, and after closing.
    """
    now, before = (float((film.grid.areas * _lacking(film, known))[closed].sum()) for known in past[:2])
    inflow = (before - now) / (past[0].time - past[1].time)
    through = float(np.abs(instant.balance[instant.network.fixed]).sum()) / 2
    return now / inflow if now > 0 and inflow > LEAST_INFLOW * through else math.inf


def _lacking(film: MovingFilm, known: Known) -> Array:
    """(1 - θ) h at the nodes, m; 0 where they count as full."""
    gap = film.gap_at(known.place)
    return np.where(known.held < (1 - FULL) * gap, gap - known.held, 0.0)
