"""What the numbers in a file are computed from."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array


@dataclass(frozen=True, kw_only=True)
class Inputs:
    """Heights and all else that numbers depend on; a file that keeps the numbers is keyed by the digest.

    Attributes
    ----------
    heights : of the undeformed surface z, shape (nx, ny), m.
    spacing : (dx, dy), m.
    settings : all else that the numbers depend on, as entries that JSON can hold.
    """

    heights: Array
    spacing: tuple[float, float]
    settings: Mapping[str, Any]

    @property
    def digest(self) -> str:
        """Of all inputs: equal digests give equal numbers."""
        told = json.dumps([self.heights.shape, self.spacing, self.settings], sort_keys=True, allow_nan=False)
        return hashlib.sha256(told.encode() + np.ascontiguousarray(self.heights).tobytes()).hexdigest()

    def difference(self, settings: str) -> str:
        """What the inputs of a file differ in, in words; ``settings`` as it holds them, as JSON."""
        there = json.loads(settings)
        for name in sorted(there.keys() | self.settings.keys()):
            mine, its = self.settings.get(name), there.get(name)
            if mine != its:
                return "of another version of roughfilm" if name == "code" else f"with {name} {its}, not {mine}"
        return "of another surface"
