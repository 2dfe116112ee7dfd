"""The inputs of a computation, and the digest that identifies them in a file of results."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Inputs:
    """The heights, spacing and settings that determine a result; their digest identifies a file of results.

    Attributes
    ----------
    heights : height z of the undeformed surface, shape (nx, ny), m.
    spacing : (dx, dy), m.
    settings : all other inputs of the result, as entries that JSON can hold.
    """

    heights: Array
    spacing: tuple[float, float]
    settings: Mapping[str, Any]

    @cached_property
    def digest(self) -> str:
        """The SHA-256 digest of all inputs, in hexadecimal; equal digests mean equal results."""
        text = json.dumps([self.heights.shape, self.spacing, self.settings], sort_keys=True, allow_nan=False)
        return hashlib.sha256(text.encode() + np.ascontiguousarray(self.heights).tobytes()).hexdigest()

    def difference(self, stored: Mapping[str, Any]) -> str:
        """The first difference from the inputs of a file, in words that end a sentence.

        Parameters
        ----------
        stored : the settings in the file.
        """
        name, other, own = _first_difference(stored, self.settings) or ("", None, None)
        if not name:
            return "of another surface"
        return "of another version of roughfilm" if name == "code" else f"with {name} {other!s:.60}, not {own!s:.60}"


def _first_difference(stored: Mapping[str, Any], wanted: Mapping[str, Any]) -> tuple[str, Any, Any] | None:
    """The first key, dotted in nested tables, that has another entry, with its entry in each; None if all agree."""
    for name in sorted(stored.keys() | wanted.keys()):
        one, other = stored.get(name), wanted.get(name)
        if one == other:
            continue
        if not (isinstance(one, Mapping) and isinstance(other, Mapping)):
            return name, one, other
        if (inner := _first_difference(one, other)) is not None:
            return f"{name}.{inner[0]}", inner[1], inner[2]
    return None
