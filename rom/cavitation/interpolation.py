"""Interpolation of a state from one grid to another."""

import numpy as np
from numpy.typing import NDArray

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.network import State


def carried(state: State, coarse: Grid, fine: Grid, joined: tuple[bool, bool]) -> State:
    """The state on the fine grid, linear in pressure and filling fraction; nodes with pressure above zero are film."""
    pressure, fill = _interpolated((state.pressure, state.fill), coarse, fine, joined)
    return State(pressure=pressure, fill=np.where(pressure > 0, 1.0, fill))


def _interpolated(fields: tuple[Array, ...], known: Grid, wanted: Grid, joined: tuple[bool, bool]) -> list[Array]:
    x = between(known.x, known.spacing_x, wanted.x, joined=joined[0])
    y = between(known.y, known.spacing_y, wanted.y, joined=joined[1])
    return [np.ascontiguousarray(_spread(_spread(values, *x).T, *y).T) for values in fields]


def between(
    known: Array, spacing: Array, wanted: Array, *, joined: bool
) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
    """The two known neighbours of every wanted position, and its relative distance from the first to the second."""
    if known.size == 1:
        nothing = np.zeros(wanted.size, dtype=np.intp)
        return nothing, nothing, np.zeros(wanted.size)
    ends = np.append(known, known[-1] + spacing[-1]) if joined else known
    left = np.clip(np.searchsorted(ends, wanted, side="right") - 1, 0, ends.size - 2)
    part = (wanted - ends[left]) / (ends[left + 1] - ends[left])
    return left, (left + 1) % known.size, np.clip(part, 0.0, 1.0)


def _spread(values: Array, left: NDArray[np.intp], right: NDArray[np.intp], part: Array) -> Array:
    weight = part.reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(values[left] * (1 - weight) + values[right] * weight)
