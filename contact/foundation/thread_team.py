"""Threads that share loops and transforms, all of which leave the interpreter to the others while they run."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise


class Team:
    """So many threads, the calling one among them."""

    def __init__(self, members: int) -> None:
        self.members = members
        self._others = ThreadPoolExecutor(members - 1) if members > 1 else None

    def ranges(self, count: int, unit: int = 1) -> list[tuple[int, int]]:
        """``count`` things cut into a range [low, high) for each member, at whole units."""
        bounds = [count * member // (self.members * unit) * unit for member in range(self.members)]
        return list(pairwise([*bounds, count]))

    def share(self, work: Callable[[int], None]) -> None:
        """Let every member, 0 and on, do its work; over when all have."""
        if self._others is None:
            work(0)
            return
        begun = [self._others.submit(work, member) for member in range(1, self.members)]
        try:
            work(0)
        finally:
            for other in begun:
                other.result()
