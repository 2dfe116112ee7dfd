"""The grid cut into pieces, one a thread, and the loops run over them."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import Any

import numpy as np

from contact.surface import Array

NUMBERS = 6
"""At most so many numbers a loop returns."""


class Pieces:
    """Ranges of nodes that threads work on side by side; ``ends`` says where each range's list of free nodes ends."""

    def __init__(self, nodes: int, threads: int) -> None:
        bounds = np.linspace(0, nodes, threads + 1).astype(int)
        self.ranges = [(int(low), int(high)) for low, high in pairwise(bounds)]
        self.ends = [high for _, high in self.ranges]
        self._pool = ThreadPoolExecutor(threads) if threads > 1 else None
        self._out = np.zeros((threads, NUMBERS))

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

        if self._pool is None:
            one(0)
        else:
            list(self._pool.map(one, range(len(ranges))))
        return self._out
