"""What a report over many cases must know of a kind of scene: which numbers a case has, and what may order errors."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

Columns = Mapping[str, NDArray[Any]]
"""Arrays of shape (cases,) by name."""

Powers = Mapping[str, float]
"""A product of powers of features."""


@dataclass(frozen=True, kw_only=True)
class Sweeping:
    """How sweeps over one kind of scene are judged.

    Attributes
    ----------
    given : columns of a table that tell the cases apart; with a number where a table, or a case, may lack it.
    quantities : what is read of every result.
    features : features(given): the numbers by which errors are ordered.
    worth : worth(values): which cases of the reference have enough of all compared quantities to divide by.
    candidates : numbers that an engineer would try, by what they are called.
    fitted : the features whose powers are fitted where no candidate will do.
    words : words(powers): a product as people write it.
    """

    given: Mapping[str, float | None]
    quantities: tuple[str, ...]
    features: Callable[[Columns], dict[str, NDArray[Any]]]
    worth: Callable[[Columns], NDArray[Any]]
    candidates: Mapping[str, Powers]
    fitted: tuple[str, ...]
    words: Callable[[Powers], str]
