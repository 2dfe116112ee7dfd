"""Ranges of nodes of the grid, one for each thread, and loops over them."""

from collections.abc import Callable
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics.kernels import WORD

MAX_RESULTS = 6
"""Largest number of results of a loop."""


class Pieces:
    """Ranges of nodes that threads process in parallel; ``ends`` holds the end of the free nodes of each range."""

    def __init__(self, nodes: int, team: Team) -> None:
        self.ranges = team.ranges(nodes, WORD)
        self.ends = [low for low, _ in self.ranges]
        self._team = team
        self._out = np.zeros((team.members, MAX_RESULTS))

    def over_all(self, kernel: Callable[..., None], *arguments: Any, out: bool = False) -> Array:
        """Run a loop over all nodes; returns its results if ``out``, a row for each range."""
        return self._run(kernel, self.ranges, arguments, out)

    def over_free(self, kernel: Callable[..., None], *arguments: Any, out: bool = False) -> Array:
        """Run a loop over the free nodes; returns as `over_all`."""
        places = [(low, end) for (low, _), end in zip(self.ranges, self.ends, strict=True)]
        return self._run(kernel, places, arguments, out)

    def _run(
        self, kernel: Callable[..., None], ranges: list[tuple[int, int]], arguments: tuple[Any, ...], out: bool
    ) -> Array:
        def one(piece: int) -> None:
            kernel(*ranges[piece], *arguments, *((self._out[piece],) if out else ()))

        self._team.share(one)
        return self._out
