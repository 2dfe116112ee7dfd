"""The grid cut into pieces, one for each member of a team, and the loops run over them."""

from collections.abc import Callable
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.threads import Team
from roughfilm.contact.mechanics.kernels import WORD

NUMBERS = 6
"""At most so many numbers a loop returns."""


class Pieces:
    """Ranges of nodes that a team works on side by side; ``ends`` says where each range's list of free nodes ends."""

    def __init__(self, nodes: int, team: Team) -> None:
        self.ranges = team.ranges(nodes, WORD)
        self.ends = [low for low, _ in self.ranges]
        self._team = team
        self._out = np.zeros((team.members, NUMBERS))

    def over_all(self, kernel: Callable[..., None], *arguments: Any, out: bool = False) -> Array:
        """Run a loop over every node; the numbers of each piece, a row each, if it returns some."""
        return self._run(kernel, self.ranges, arguments, out)

    def over_free(self, kernel: Callable[..., None], *arguments: Any, out: bool = False) -> Array:
        """Run a loop over the free nodes."""
        places = [(low, end) for (low, _), end in zip(self.ranges, self.ends, strict=True)]
        return self._run(kernel, places, arguments, out)

    def _run(
        self, kernel: Callable[..., None], ranges: list[tuple[int, int]], arguments: tuple[Any, ...], out: bool
    ) -> Array:
        def one(piece: int) -> None:
            kernel(*ranges[piece], *arguments, *((self._out[piece],) if out else ()))

        self._team.share(one)
        return self._out
