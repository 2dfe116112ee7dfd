"""The data of a kind of scene for a report over many cases."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

Columns = Mapping[str, NDArray[Any]]
"""Arrays of shape (cases,) by name."""

Powers = Mapping[str, float]
"""A product of powers of features, as the exponents by the names of the features."""


@dataclass(frozen=True, kw_only=True)
class Sweeping:
    """The columns, quantities and features by which sweeps over one kind of scene are judged.

    Attributes
    ----------
    given : columns of a table that identify the cases, with the value of missing entries, or None.
    quantities : names of the quantities that are read from every result.
    features : features(given), the numbers by which errors are ordered, shape (cases,) each.
    worth : worth(values), the mask of the cases whose reference quantities are large enough to divide by.
    candidates : products of powers that are tried first, by name.
    fitted : names of the features whose powers are fitted if no candidate orders the errors.
    words : words(powers), the text of a product of powers.
    """

    given: Mapping[str, float | None]
    quantities: tuple[str, ...]
    features: Callable[[Columns], dict[str, NDArray[Any]]]
    worth: Callable[[Columns], NDArray[Any]]
    candidates: Mapping[str, Powers]
    fitted: tuple[str, ...]
    words: Callable[[Powers], str]
