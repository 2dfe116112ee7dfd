"""Ranges of nodes and rows of the grid, one for each thread, and loops over them."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics import kernels

MAX_RESULTS = 6
"""Largest number of results of a loop."""


Results = list[list[float]]
"""Each result of a loop, for each range."""


class Pieces:
    """Ranges of nodes, rows and free nodes that threads process in parallel.

    Attributes
    ----------
    nodes, rows : ranges [low, high) of nodes and rows.
    capacity : number of entries that each range of nodes has in the lists of free nodes.
    firsts : the first entry of each range of nodes in these lists.
    free : ranges [first, end) of the entries of free nodes.
    """

    def __init__(self, shape: tuple[int, int], team: Team) -> None:
        self.nodes, self.rows = team.ranges(shape[0] * shape[1], kernels.WORD), team.ranges(shape[0])
        self._team = team
        self._out = np.zeros((team.members, MAX_RESULTS))
        self.reserve(0)

    def reserve(self, capacity: int) -> None:
        """Set the number of entries that each range of nodes has in the lists of free nodes, which are empty then."""
        self.capacity = capacity
        self.firsts = [capacity * piece for piece in range(self._team.members)]
        self.set_counts([0] * self._team.members)

    def set_counts(self, counts: list[int]) -> None:
        """Set the number of free nodes in each range of nodes."""
        self.free = [(first, first + count) for first, count in zip(self.firsts, counts, strict=True)]

    def over_nodes(self, kernel: Callable[..., None], *arguments: Any, out: bool = False) -> Results:
        """Run a loop over all nodes; returns its results if ``out``."""
        return self.over(self.nodes, kernel, *arguments, out=out)

    def over_rows(self, kernel: Callable[..., None], *arguments: Any, out: bool = False) -> Results:
        """Run a loop over all rows; returns as `over_nodes`."""
        return self.over(self.rows, kernel, *arguments, out=out)

    def over_free(self, kernel: Callable[..., None], *arguments: Any, out: bool = False) -> Results:
        """Run a loop over the lists of free nodes; returns as `over_nodes`."""
        return self.over(self.free, kernel, *arguments, out=out)

    def scatter_alone(self, index: Array, values: Array, grid: Array) -> None:
        """Copy values of the free nodes to the flat grid, and set its other nodes to 0."""
        places = [(*nodes, *entries) for nodes, entries in zip(self.nodes, self.free, strict=True)]
        self.over(places, kernels.scatter_alone, index, values, grid)

    def over(
        self, places: Sequence[tuple[int, ...]], kernel: Callable[..., None], *arguments: Any, out: bool = False
    ) -> Results:
        """Run a loop with the integers of its place as first arguments; returns as `over_nodes`."""

        def one(piece: int) -> None:
            kernel(*places[piece], *arguments, *((self._out[piece],) if out else ()))

        self._team.share(one)
        return self._out.T.tolist() if out else []
