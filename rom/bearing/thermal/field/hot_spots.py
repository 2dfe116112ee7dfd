"""The uncertainty of the largest temperature of lubricant that circulates around a bore."""

import math
from collections.abc import Sequence

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.thermal.field.films import HeatedSolution
from roughfilm.rom.bearing.thermal.field.heated import start_of
from roughfilm.rom.cavitation.evaluation.grids import GRID_SAFETY_FACTOR, ORDERS, cells_of
from roughfilm.rom.cavitation.solve import Solution
from roughfilm.rom.temperature.dissipation import film_flows

GRIDS = 3
"""Largest number of grids from which the temperature of a node is extrapolated."""

MAX_TURNS = 1.0
"""Flow around a bore over the net flow out of its sides above which no grid resolves the largest temperature.

It is the mean number of turns of the lubricant; what leaves through a side beside a place where as much enters does not
count, since streamlines between them close. With 0.2 to 0.7 turns the uncertainties of five bores held on 32 cells;
with 1.2, 2.4 and 2.9 turns the largest temperature still grew by 3 to 8 K from 64 to 128 cells.
"""


def circulating_uncertainty(levels: Sequence[Solution]) -> float:
    """The uncertainty of the largest temperature by places that no grid resolves, K; 0 of films that do not circulate.

    Beside an open side, lubricant that circulates around a full bore leaves the film slowly. Its temperature rises with
    the cells there, and may become the largest one on a finer grid (:func:`warmer_elsewhere`). It is unknown, infinite,
    where lubricant turns around many times and no heat leaves it (:func:`keeps_its_heat`).

    Parameters
    ----------
    levels : the films on their grids, the finest first.
    """
    heated = [one for one in levels[:GRIDS] if isinstance(one, HeatedSolution)]
    if len(heated) < 2 or not heated[0].network.periodic[0] or heated[0].problem.shape.idle:
        return 0.0
    finest = heated[0]
    if keeps_its_heat(finest):
        return math.inf
    fields = [start_of(one.heated, finest) for one in heated]
    return warmer_elsewhere([one for one in fields if one is not None], [cells_of(one) for one in heated])


def keeps_its_heat(solution: HeatedSolution) -> bool:
    """Whether lubricant turns around a bore more than ``MAX_TURNS`` times before it leaves, and no wall takes its heat.

    Without heat conduction in the plane no heat leaves a closed streamline, so that its temperature grows with the
    refinement of the grid, which alone mixes the lubricant of neighbouring streamlines. A turning shaft takes heat from
    warm streamlines and gives it to others, even if it takes none in sum.
    """
    if not solution.network.periodic[0] or solution.problem.shape.idle:
        return False
    heated = solution.heated
    if heated.shaft is not None or heated.to_fixed_wall or heated.to_sliding_wall:
        return False
    flows = film_flows(solution)
    out = [max(-float(flows.entering[:, side].sum()), 0.0) for side in (0, -1)]
    return float(flows.along.sum(axis=1).min()) > MAX_TURNS * sum(out)


def warmer_elsewhere(temperatures: Sequence[Array], cells: Sequence[float]) -> float:
    """By how much another node may become warmer than the warmest one, beyond the uncertainty of that one, K.

    A node whose temperature T rises from the coarser grid by d may rise by e = s d/((n/n₁)^p - 1) more, with the safety
    factor s, and the order p observed on three grids within ``ORDERS``; the lowest one with two grids and with changes
    of different signs. The result is the largest T + e less that of the warmest node.

    Parameters
    ----------
    temperatures : the temperatures on two or more grids at the nodes of the finest one, K, from fine to coarse.
    cells : numbers of cells along a side of these grids.

    Source: Roache 1994, doi:10.1115/1.2910291.
    """
    here, change = temperatures[0], temperatures[0] - temperatures[1]
    order = np.full(here.shape, ORDERS[0])
    if len(temperatures) > 2:
        before = temperatures[1] - temperatures[2]
        same = change * before > 0
        order[same] = np.clip(np.log(before[same] / change[same]) / np.log(cells[0] / cells[1]), *ORDERS)
    bound = here + GRID_SAFETY_FACTOR * np.maximum(change, 0.0) / ((cells[0] / cells[1]) ** order - 1)
    return max(float(bound.max() - bound.flat[int(here.argmax())]), 0.0)
